/* Real fields on a square grid from their spectra: FFTW's two-dimensional transform, planned as in num/fft.h, so that
 * bits repeat. */
#ifndef NUM_FFT_PLANE_H
#define NUM_FFT_PLANE_H
#include <stddef.h>

struct fft_plane; /* a plan of one size; not to be shared by threads */

/* n x n points, n even. Ends the program with exit code 71 if there is no memory. */
struct fft_plane *fft_plane_open(size_t n);
void fft_plane_close(struct fft_plane *f);

/* re, im [n][n/2+1]: line (j, i) is j cycles down the rows and i along a row, j > n/2 standing for j - n. They lie in
   the plan: fill them, each time anew, then transform to x[n][n], unnormalised. The lines (j, 0) and (-j, 0) must be
   conjugate to each other, so those at n/2. */
double *fft_plane_re(struct fft_plane *f);
double *fft_plane_im(struct fft_plane *f);
const double *fft_plane_inverse(struct fft_plane *f);

#endif
