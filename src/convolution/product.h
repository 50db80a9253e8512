/* Products of spectra, as real and imaginary parts, and the question whether there is anything to convolve. */
#ifndef CONVOLUTION_PRODUCT_H
#define CONVOLUTION_PRODUCT_H
#include <stdbool.h>
#include <stddef.h>

struct product_spectrum {
    double *re, *im;
};

/* b *= a, n bins each; they may not overlap. */
void product_multiply(size_t n, struct product_spectrum a, struct product_spectrum b);

/* c += a b */
void product_add(size_t n, struct product_spectrum a, struct product_spectrum b, struct product_spectrum c);

/* Are all n values 0? */
bool product_nothing(const double *x, int n);

#endif
