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

/* x[n] -> re[n/2+1], im[n/2+1] (split); x is left as it was. */
void fft_forward(struct fft *f, const double *x, double *re, double *im);

/* re, im [n/2+1] -> x[n]; re and im are left as they were. */
void fft_inverse(struct fft *f, const double *re, const double *im, double *x);

/* Smallest even 2^a 3^b 5^c that is >= n. */
size_t fft_good_size(size_t n);

/* Real fields on a square grid from their spectra: FFTW's two-dimensional transform, planned as the others, so that
   bits repeat. A plan of one size; not to be shared by threads.

   re, im [n][n/2+1]: line (j, i) is j cycles down the rows and i along a row, j > n/2 standing for j - n. Fill them,
   each time anew, then transform to x[n][n], unnormalised. The lines (j, 0) and (-j, 0) must be conjugate to each
   other, so those at n/2. */
struct fft_plane {
    size_t n;
    double *re, *im, *x;
    struct fftw_plan_s *inverse;
};

/* n x n points, n even. Ends the program with exit code 71 if there is no memory. */
struct fft_plane *fft_plane_open(size_t n);
void fft_plane_close(struct fft_plane *f);
void fft_plane_inverse(struct fft_plane *f);

#endif
