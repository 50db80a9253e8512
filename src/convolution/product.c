/* See convolution/product.h. */
#include "convolution/product.h"

#include "num/lanes.h"

LANES_CLONES
void product_multiply(size_t n, struct product_spectrum a, struct product_spectrum b)
{
    const double *restrict ar = a.re, *restrict ai = a.im;
    double *restrict br = b.re, *restrict bi = b.im;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double re = ar[i] * br[i] - ai[i] * bi[i];
        bi[i] = ar[i] * bi[i] + ai[i] * br[i];
        br[i] = re;
    }
}

LANES_CLONES
void product_add(size_t n, struct product_spectrum a, struct product_spectrum b, struct product_spectrum c)
{
    const double *restrict ar = a.re, *restrict ai = a.im, *restrict br = b.re, *restrict bi = b.im;
    double *restrict cr = c.re, *restrict ci = c.im;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        cr[i] += ar[i] * br[i] - ai[i] * bi[i];
        ci[i] += ar[i] * bi[i] + ai[i] * br[i];
    }
}

bool product_nothing(const double *x, int n)
{
    for (int i = 0; i < n; i++)
        if (x[i] != 0.0)
            return false;
    return true;
}
