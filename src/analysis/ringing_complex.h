/* A complex number of two parts, and a product without the test for infinities that C's own makes: C11's CMPLX is not there with every compiler. */
#ifndef ANALYSIS_RINGING_COMPLEX_H
#define ANALYSIS_RINGING_COMPLEX_H
#include <complex.h>
#include <string.h>

static inline double complex ringing_complex(double re, double im)
{
    const double part[2] = {re, im};
    double complex z;
    memcpy(&z, part, sizeof z);
    return z;
}

static inline double complex ringing_complex_product(double complex a, double complex b)
{
    return ringing_complex(creal(a) * creal(b) - cimag(a) * cimag(b), creal(a) * cimag(b) + cimag(a) * creal(b));
}

#endif
