/* Short-time spectra. With w[j] = sin^2(pi (j + 1/2)/size) the squares of four windows a quarter apart add up to 3/2.
   */
#include "num/stft.h"

#include <string.h>

#include "num/fft.h"
#include "num/real.h"

struct stft *stft_open(long n, double rate, int pad, struct arena *a)
{
    struct stft *s = ARENA_TAKE(a, struct stft, 1);
    *s = (struct stft){.n = n, .size = 64};
    while (s->size < 0.0165 * rate)
        s->size *= 2;
    s->hop = s->size / STFT_OVERLAP;
    s->padded = pad * s->size;
    s->bins = s->padded / 2 + 1;
    s->frames = (int)((n - 1 + s->size - s->hop) / s->hop) + 1;
    s->fft = fft_open((size_t)s->padded);
    s->window = ARENA_TAKE(a, double, s->size);
    s->work = ARENA_TAKE(a, double, s->padded);
    for (int j = 0; j < s->size; j++) {
        double root = real_sinpi((j + 0.5) / s->size);
        s->window[j] = root * root;
    }
    return s;
}

void stft_close(struct stft *s) { fft_close(s->fft); }

static long start(const struct stft *s, int frame) { return (long)(frame - STFT_ONSET) * s->hop; }

void stft_forward(const struct stft *s, const double *x, double *re, double *im)
{
    for (int m = 0; m < s->frames; m++) {
        long at = start(s, m);
        memset(s->work, 0, (size_t)s->padded * sizeof *s->work);
        for (int j = 0; j < s->size; j++)
            s->work[j] = at + j >= 0 && at + j < s->n ? s->window[j] * x[at + j] : 0.0;
        fft_forward(s->fft, s->work, re + (long)m * s->bins, im + (long)m * s->bins);
    }
}

void stft_inverse(const struct stft *s, const double *re, const double *im, double *x)
{
    double scale = 1.0 / (1.5 * s->padded);
    memset(x, 0, (size_t)s->n * sizeof *x);
    for (int m = 0; m < s->frames; m++) {
        long at = start(s, m);
        fft_inverse(s->fft, re + (long)m * s->bins, im + (long)m * s->bins, s->work);
        for (int j = 0; j < s->size; j++)
            if (at + j >= 0 && at + j < s->n) x[at + j] += scale * s->window[j] * s->work[j];
    }
}

void stft_power(const double *re, const double *im, long count, double *power)
{
    for (long i = 0; i < count; i++)
        power[i] = re[i] * re[i] + im[i] * im[i];
}
