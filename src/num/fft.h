/* Real FFTs through FFTW, planned with FFTW_ESTIMATE | FFTW_NO_SIMD so that bits repeat from run to run and CPU to CPU.
   Unnormalised both ways, as FFTW: inverse(forward(x)) = n x. */
#ifndef NUM_FFT_H
#define NUM_FFT_H
#include <stdbool.h>
#include <stddef.h>

struct fft; /* a plan of one size with its work space; not to be shared by threads */

/* n: even, >= 2. Ends the program with exit code 71 if there is no memory. */
struct fft *fft_open(size_t n);
void fft_close(struct fft *f);

/* true: plans made from here on stay for all who ask for the same size, up to 64 of them. false: they are given up; no
 * struct fft that came in between is open. */
void fft_cache_plans(bool on);

/* x[n] -> re[n/2+1], im[n/2+1] (split); x is left as it was. */
void fft_forward(struct fft *f, const double *x, double *re, double *im);

/* re, im [n/2+1] -> x[n]; re and im are left as they were. */
void fft_inverse(struct fft *f, const double *re, const double *im, double *x);

/* Smallest even 2^a 3^b 5^c that is >= n. */
size_t fft_good_size(size_t n);

#endif
