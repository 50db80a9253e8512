/* Elementary functions over arrays, for hot loops: branch-free plain C (+ - * / only, no fused multiply-add), so that
   gcc and clang vectorise them for any instruction set with the same bits. Input and output arrays may be the same, not
   overlap. Errors are measured against long double in tests/unit/test_vecmath.c. */
#ifndef NUM_VECMATH_H
#define NUM_VECMATH_H
#include <stddef.h>

/* exp(x): 0 below -708.39 (no subnormals), HUGE_VAL above 709.78; NaN stays NaN; <= 2 ulp between (measured: 0.92). */
void vecmath_exp(size_t n, const double *x, double *y);

/* Natural logarithm, <= 2 ulp (measured: 0.70), of subnormal numbers too. 0 gives -HUGE_VAL, negative gives NaN. */
void vecmath_log(size_t n, const double *x, double *y);

/* x^p for x >= 0 and one finite p: exp(p log x), relative error <= (2 + |p log x|/4) 2^-52 (measured: |p log x|/5.9);
   0^p is 0 for p > 0, 1 for p = 0, HUGE_VAL for p < 0; below DBL_MIN the result is 0; negative x gives NaN. p = 1
   copies and p = 0 gives 1, for any x, like C's pow. */
void vecmath_pow(size_t n, const double *x, double p, double *y);

/* sin(pi x) and cos(pi x), |x| < 2^50, absolute error <= 2e-16 (measured: 1.6e-16); exact at multiples of 1/2. NaN for
   other x. x may be the same array as s or c. */
void vecmath_sincospi(size_t n, const double *x, double *s, double *c);

/* tanh(x), <= 4 ulp (measured: 2.5) however small x is. */
void vecmath_tanh(size_t n, const double *x, double *y);

/* log(1 + exp(-2|x|)): log cosh x = |x| + this - log 2. Relative error <= 8 ulp (measured: 1.6); 0 where exp(-2|x|) is,
   from |x| = 354.195 on. */
void vecmath_softplus2(size_t n, const double *x, double *y);

/* Both of these, the same bits, from one exp(-2|x|). */
void vecmath_tanh_softplus2(size_t n, const double *x, double *t, double *soft);

#endif
