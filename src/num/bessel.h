/* Bessel functions of whole order and real argument, by arithmetic alone (the same bits on every CPU). */
#ifndef NUM_BESSEL_H
#define NUM_BESSEL_H

/* j[0] = J_n(x), j[1] = J_{n+1}(x); n >= 0, x >= 0. Absolute error <= 1e-14, relative 1e-12 away from zeros
 * (tests/unit/test_bessel.c: x <= 500). */
void bessel_j(int n, double x, double j[2]);

/* i[0] = e^-x I_n(x), i[1] = e^-x I_{n+1}(x); n >= 0, x >= 0. Relative error <= 1e-13. */
void bessel_i(int n, double x, double i[2]);

#endif
