/* Complex numbers without the tests for infinities that C's own products make. */
#ifndef ANALYSIS_MODAL_COMPLEX_H
#define ANALYSIS_MODAL_COMPLEX_H
#include "num/real.h"

typedef struct cplx {
    double re, im;
} cplx;

static inline cplx cplx_add(cplx a, cplx b) { return (cplx){a.re + b.re, a.im + b.im}; }
static inline cplx cplx_sub(cplx a, cplx b) { return (cplx){a.re - b.re, a.im - b.im}; }
static inline cplx cplx_mul(cplx a, cplx b) { return (cplx){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re}; }
static inline cplx cplx_scale(double k, cplx a) { return (cplx){k * a.re, k * a.im}; }
static inline cplx cplx_conj(cplx a) { return (cplx){a.re, -a.im}; }
static inline double cplx_square(cplx a) { return a.re * a.re + a.im * a.im; }
static inline double cplx_abs(cplx a) { return sqrt(cplx_square(a)); }
static inline cplx cplx_div(cplx a, cplx b) { return cplx_scale(1.0 / cplx_square(b), cplx_mul(a, cplx_conj(b))); }

/* e^(a t) */
static inline cplx cplx_exp(cplx a, double t)
{
    double size = real_exp(a.re * t);
    return (cplx){size * real_cos(a.im * t), size * real_sin(a.im * t)};
}

#endif
