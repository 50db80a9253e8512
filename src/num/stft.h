/* Short-time spectra of a whole sound, and the sound from them: Hann's window both ways, four frames over each sample,
   about 23 ms long. What stft_forward makes stft_inverse turns back into the same samples, to rounding. */
#ifndef NUM_STFT_H
#define NUM_STFT_H
#include "base/arena.h"

enum { STFT_OVERLAP = 4, STFT_ONSET = STFT_OVERLAP - 1 }; /* frame STFT_ONSET is the first that begins at sample 0 */

struct fft;

struct stft {
    struct fft *fft;
    long n;                /* samples */
    int size, hop;         /* samples of a frame, and from frame to frame */
    int padded, bins;      /* points of a transform; padded/2 + 1 */
    int frames;            /* frame m begins at sample (m - STFT_ONSET) hop: the first hold the sound's onset */
    double *window, *work; /* [size] */
};

/* Window of the rate (Hz): a power of two, 1024 at 44.1 and 48 kHz, padded with zeros to `pad` times that, for bins
   that are as much denser. To be closed. */
struct stft *stft_open(long n, double rate, int pad, struct arena *a);
void stft_close(struct stft *s);

/* x[n] to re, im [frames][bins]; phases are those at a frame's first sample. */
void stft_forward(const struct stft *s, const double *x, double *re, double *im);

/* And back; of spectra that are no sound's the least squares' nearest. re and im are left as they were. */
void stft_inverse(const struct stft *s, const double *re, const double *im, double *x);

/* |X|^2 to power[count], frames times bins. */
void stft_power(const double *re, const double *im, long count, double *power);

#endif
