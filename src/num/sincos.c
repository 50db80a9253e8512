/* The sincos that FFTW finds, see num/sincos.h. */
#include "num/sincos.h"

#include "num/real.h"

/* Declared by <math.h>: sin x and cos x, x in radians, at most 1 ulp. */
void sincos(double x, double *s, double *c)
{
    *s = real_sin(x);
    *c = real_cos(x);
}

void sincos_link(void) {}
