/* Short-time Fourier transform with the periodic Hann window w[i] = (1 - cos(2 pi i / n)) / 2 of n samples, n the
   smallest even 2^a 3^b 5^c of at least 20 ms:

     A_k = 2 |sum over i of w[i] x[i] exp(-2 pi j i k / n)| / sum of w            dB = 20 log10 A_k

   so that a sine of amplitude 1 on the frequency of a bin gives 0 dB there (and -1.42 dB half-way between two bins). A
   column that is wider than half a window is the mean power of windows at most half a window apart, so that nothing
   between two columns is missed. */
#include "output/spectrogram.h"

#include <math.h>

#include "num/fft.h"
#include "num/real.h"

struct windows { /* what the columns share */
    struct fft *fft;
    size_t n;
    double *hann, *x, *re, *im, *power; /* [n], [n], [n/2 + 1] three times */
};

/* Adds the power of the window around a frame. The window's samples add up to n/2. */
static void windows_add(struct windows *w, const struct spectrogram_of *of, double centre)
{
    double scale = 4 / (double)w->n;
    long first = (long)rint(centre) - (long)(w->n / 2);
    for (size_t i = 0; i < w->n; i++) {
        long at = first + (long)i;
        w->x[i] = at >= 0 && at < (long)of->frames ? w->hann[i] * of->x[at] : 0;
    }
    fft_forward(w->fft, w->x, w->re, w->im);
    for (size_t k = 0; k <= w->n / 2; k++)
        w->power[k] += scale * w->re[k] * (scale * w->re[k]) + scale * w->im[k] * (scale * w->im[k]);
}

void spectrogram_make(const struct spectrogram_of *of, struct arena *a, struct spectrogram *g)
{
    size_t n = fft_good_size((size_t)ceil(0.02 * of->rate));
    struct windows w = {.fft = fft_open(n), .n = n, .hann = ARENA_TAKE(a, double, n), .x = ARENA_TAKE(a, double, n)};
    w.re = ARENA_TAKE(a, double, n / 2 + 1);
    w.im = ARENA_TAKE(a, double, n / 2 + 1);
    w.power = ARENA_TAKE(a, double, n / 2 + 1);
    for (size_t i = 0; i < n; i++)
        w.hann[i] = 0.5 - 0.5 * real_cospi(2 * (double)i / (double)n);
    *g = (struct spectrogram){
        .columns = of->columns, .bins = (int)(w.n / 2) + 1, .window = w.n, .bin_hz = of->rate / (double)w.n};
    g->db = ARENA_TAKE(a, double, (size_t)g->bins *(size_t)g->columns);
    for (int c = 0; c < of->columns; c++) {
        double width = (of->to - of->from) * of->rate / of->columns, first = of->from * of->rate + c * width;
        int some = (int)fmax(ceil(width / (double)(w.n / 2)), 1);
        for (int k = 0; k < g->bins; k++)
            w.power[k] = 0;
        for (int i = 0; i < some; i++)
            windows_add(&w, of, first + (i + 0.5) / some * width);
        for (int k = 0; k < g->bins; k++)
            g->db[(size_t)k * (size_t)g->columns + (size_t)c] =
                w.power[k] > 0 ? 10 * real_log10(w.power[k] / some) : -HUGE_VAL;
    }
    fft_close(w.fft);
}
