/* The force of one step of coupled_gradient.c, with which the step ends where the force says:

     xi+ = A - B f(xi+),  f = DV max(0, 1 + mu (xi+ - xi) / h),  DV = (V(xi+) - V(xi)) / (xi+ - xi),  V = (2/5) k max(0, xi)^2.5,

   A the penetration without force, m; B > 0 what 1 N takes off it. V is convex, so f never falls as xi+ rises and there is one root. Only + - * / sqrt. */
#ifndef CONVOLUTION_COUPLED_PINCH_H
#define CONVOLUTION_COUPLED_PINCH_H
#include <stdbool.h>

struct coupled_pinch {
    double stiffness;      /* (2/5) k                                   */
    double rate;           /* mu / h                                    */
    double from, root;     /* xi and, if it is above 0, its square root; 0 */
    double to, to_root;    /* xi+                                       */
    double gradient, force;
    int passes;
};

/* Fills to, to_root, gradient (DV), force and passes; guess: of xi+, where both are in contact. False: no root found, or a value is not finite. */
bool coupled_pinch(struct coupled_pinch *k, double a, double b, double guess);

#endif
