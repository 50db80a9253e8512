/* The force of one step of coupled_gradient.c, with which the step ends where the force says:

     xi+ = A - B f(xi+),  f = DV max(0, 1 + mu (xi+ - xi) / h),  DV = (V(xi+) - V(xi)) / (xi+ - xi),  V = (2/5) k max(0,
       xi)^2.5,

   A the penetration without force, m; B > 0 what 1 N takes off it. V is convex, so f never falls as xi+ rises and there
   is one root. Only + - * / sqrt. */
#ifndef CONVOLUTION_COUPLED_PINCH_H
#define CONVOLUTION_COUPLED_PINCH_H
#include <math.h>
#include <stdbool.h>

struct coupled_pinch {
    double stiffness;   /* (2/5) k                                   */
    double rate;        /* mu / h                                    */
    double from, root;  /* xi and, if it is above 0, its square root; 0 */
    double to, to_root; /* xi+                                       */
    double gradient, force;
    int passes;
};

/* Fills to, to_root, gradient (DV), force and passes; guess: of xi+, where both are in contact. False: no root found,
 * or a value is not finite. */
bool coupled_pinch(struct coupled_pinch *k, double a, double b, double guess);

/* The same in pieces for steps in contact, so that who has other work can lay it between: each piece is a chain of 30
   to 60 cycles' latency. Where coupled_pinch_stays, x = coupled_pinch_first, then x = coupled_pinch_pass, then
   coupled_pinch_close, or, where that says no, coupled_pinch_on. */

/* Are both penetrations above 0? f(0) = (2/5) k xi^1.5 max(0, least). */
static inline bool coupled_pinch_stays(const struct coupled_pinch *k, double a, double b)
{
    double least = 1 - k->rate * k->from;
    return k->from > 0 && a > (least > 0 ? b * k->stiffness * k->from * k->root * least : 0);
}

static inline double coupled_pinch_first(const struct coupled_pinch *k, double guess)
{
    return guess > 0 ? sqrt(guess) : k->root;
}

/* The polynomial in b = sqrt(xi+) at x, by Halley's method (of third order): what x has to be lowered by; NAN where the
 * force would be cut off. */
static inline double coupled_pinch_pass(const struct coupled_pinch *k, double a, double b, double x)
{
    const double r = k->root, square = k->from, cube = square * r, kb = k->stiffness * b, rate = k->rate;
    double xx = x * x, s = x + r, factor = 1 + rate * (xx - square), n = xx * (xx + r * x + square) + cube * s;
    double n1 = x * (4 * xx + 3 * r * x + 2 * square) + cube, n2 = 12 * xx + 6 * r * x + 2 * square;
    double off = (xx - a) * s + kb * n * factor;
    double slope = 2 * x * s + (xx - a) + kb * (n1 * factor + 2 * rate * n * x);
    double bend = 2 * (s + 2 * x) + kb * (n2 * factor + 2 * rate * (2 * n1 * x + n)); /* off's second derivative */
    return factor > 0 ? off * slope / (slope * slope - 0.5 * off * bend) : NAN;
}

/* x: after the pass that lowered it by change. When that moved it by less than 2^-18 of itself the next one would be
 * below the rounding. False: not settled. */
static inline bool coupled_pinch_close(struct coupled_pinch *k, double x, double change)
{
    const double r = k->root, square = k->from, cube = square * r;
    if (!(x > 0) || !(fabs(change) <= 0x1p-18 * x)) return false;
    double xx = x * x, factor = 1 + k->rate * (xx - square);
    k->gradient = k->stiffness * (xx * (xx + r * x + square) + cube * (x + r)) / (x + r);
    k->force = k->gradient * factor;
    k->to = xx;
    k->to_root = x;
    return factor > 0;
}

/* From an x that is not settled after k->passes passes. */
bool coupled_pinch_on(struct coupled_pinch *k, double a, double b, double x);

#endif
