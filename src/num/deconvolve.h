/* The response h of a causal system from what went in and what came out: y = f * h.

   h is the one that begins at sample 0 and makes |y - f * h|^2 + weak |h|^2 least, weak = limit max |F|^2. Division of
   the spectra with the same limit has no such beginning: its response rings before sample 0, and cutting that off loses
   up to 5 dB where the sound is long. Here f * h is y wherever |F|^2 is above the limit, and fades below it.

   The normal equations are symmetric Toeplitz: num/toeplitz.h, with the preconditioner 1 over |F|^2 + weak. */
#ifndef NUM_DECONVOLVE_H
#define NUM_DECONVOLVE_H
/* y[n], h[n]; f[m], f[0] at the time of y[0]. limit: of power, > 0. Returns the iterations, at most 500; until the
   normal equations hold to 1e-9. f all 0: h is 0. */
int deconvolve(const double *y, long n, const double *f, long m, double limit, double *h);

#endif
