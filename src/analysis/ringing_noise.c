/* The level of noise around a frequency, from what is left of the response: the mean of the periodogram |R_k|^2/n over at least BINS bins (of a short response fewer, a 25th of all, not below FEWEST) and as far as the component's own
   width, times bins/(bins - what the components there have taken of it: two each). What is not noise but rings still counts as noise, so that a fit that lacks something is not
   trusted more than it deserves. Where the channel was recorded with nothing ringing, its level there (Welch, 50 % overlap, Hann) counts if it is greater: a hum is no
   mode. So does the response's own error, where strikes say how large that is: what they do not agree on is no property of the object. No level is taken for less than rounding's, be it of the numbers here or of the file. */
#include "analysis/ringing_noise.h"

#include <math.h>

#include "num/fft.h"
#include "num/real.h"

enum { BINS = 48, FEWEST = 16, WELCH = 4096 };

static void welch(const double *x, long n, long size, struct arena *a, double *level)
{
    struct fft *fft = fft_open((size_t)size);
    double *re = ARENA_TAKE(a, double, size / 2 + 1), *im = ARENA_TAKE(a, double, size / 2 + 1), *y = ARENA_TAKE(a, double, size), sum = 0, frames = 0;
    for (long i = 0; i < size; i++)
        sum += real_sinpi((double)i / (double)size) * real_sinpi((double)i / (double)size) * real_sinpi((double)i / (double)size) * real_sinpi((double)i / (double)size);
    for (long at = 0; at + size <= n; at += size / 2, frames++) {
        for (long i = 0; i < size; i++) {
            double s = real_sinpi((double)i / (double)size);
            y[i] = x[at + i] * s * s;
        }
        fft_forward(fft, y, re, im);
        for (long k = 0; k <= size / 2; k++)
            level[k] += (re[k] * re[k] + im[k] * im[k]) / sum;
    }
    for (long k = 0; k <= size / 2; k++)
        level[k] /= frames;
    fft_close(fft);
}

/* Samples of the periodogram: as many as transform well. */
static long good_size(long n)
{
    n -= n % 2;
    while (n > 2 && (long)fft_good_size((size_t)n) != n)
        n -= 2;
    return n;
}

void ringing_noise_open(const struct ringing *r, struct arena *a, struct ringing_noise *s)
{
    long size = WELCH;
    *s = (struct ringing_noise){.places = r->places, .bins = good_size(r->n) / 2, .unsure = r->unsure, .doubt = 1, .unsure_bins = r->n / 2};
    s->width = r->rate / (double)(2 * s->bins);
    s->fft = fft_open((size_t)(2 * s->bins));
    while (size > r->noise_n / 4 && size > 16)
        size /= 2;
    s->least = ARENA_TAKE(a, double, r->places);
    for (int p = 0; p < r->places; p++) {
        for (long i = 0; i < r->n; i++)
            s->least[p] += r->h[p][i] * r->h[p][i] / (double)r->n;
        s->least[p] = fmax(s->least[p] * RINGING_FIT_ROUNDING * RINGING_FIT_ROUNDING, 1e-290);
        if (r->rounding)
            s->least[p] = fmax(s->least[p], r->rounding[p] * r->rounding[p]);
    }
    if (!r->noise || r->noise_n < 64)
        return;
    s->given_bins = size / 2;
    s->given_width = r->rate / (double)size;
    s->given = ARENA_TAKE(a, double, r->places * (size / 2 + 1));
    for (int p = 0; p < r->places; p++)
        welch(r->noise[p], r->noise_n, size, a, s->given + p * (size / 2 + 1));
}

void ringing_noise_close(struct ringing_noise *s)
{
    fft_close(s->fft);
}

struct span {
    long first, last;    /* bins */
    double taken;
};

static void span_make(const struct ringing_noise *s, const struct ringing_fit *f, int i, struct span *at)
{
    long bins = s->bins / 25 < FEWEST ? FEWEST : s->bins / 25 < BINS ? s->bins / 25 : BINS;
    double centre = f->omega[i] / (2 * REAL_PI * s->width), half = fmax((double)(bins / 2), f->decay[i] / (REAL_PI * s->width));
    for (int tries = 0; tries < 20; tries++, half *= 1.5) {
        at->first = (long)fmax(1, rint(centre - half));
        at->last = (long)fmin((double)(s->bins - 1), rint(centre + half));
        if (at->last - at->first < bins && half < (double)s->bins)
            continue;
        at->taken = 0;
        for (int k = 1; k < f->m; k++) {
            double there = f->omega[k] / (2 * REAL_PI * s->width), spread = f->decay[k] / (2 * REAL_PI * s->width) + 0.5;
            double share = (real_atan2((double)at->last - there, spread) - real_atan2((double)at->first - there, spread)) / REAL_PI;
            at->taken += 2 * share;
        }
        if (at->taken < 0.5 * (double)(at->last - at->first + 1) || half > (double)s->bins)
            return;
    }
}

double ringing_noise_given(const struct ringing_noise *s, int place, double hertz)
{
    const double *level = s->given + place * (s->given_bins + 1);
    long k = (long)fmin((double)s->given_bins, rint(hertz / s->given_width)), from = k > 0 ? k - 1 : k, to = k < s->given_bins ? k + 1 : k;
    double sum = 0;
    for (long i = from; i <= to; i++)
        sum += level[i];
    return sum / (double)(to - from + 1);
}

static double unsure_level(const struct ringing_noise *s, int place, const struct span *at)
{
    double sum = 0;
    for (long k = at->first; k <= at->last; k++)
        sum += s->unsure[place][k * s->unsure_bins / s->bins];
    return sum / (double)(at->last - at->first + 1);
}

void ringing_noise_levels(const struct ringing_noise *s, const struct ringing_fit *f, double *variance, double *freedom)
{
    struct arena *a = arena_open();
    double *re = ARENA_TAKE(a, double, s->bins + 1), *im = ARENA_TAKE(a, double, s->bins + 1);
    for (int p = 0; p < s->places; p++) {
        fft_forward(s->fft, f->residual + p * f->r->n, re, im);
        for (int i = 0; i < f->m; i++) {
            struct span at = {0};
            double sum = 0;
            span_make(s, f, i, &at);
            for (long k = at.first; k <= at.last; k++)
                sum += re[k] * re[k] + im[k] * im[k];
            double left = fmax((double)(at.last - at.first + 1) - at.taken, 1), level = sum / (left * 2 * (double)s->bins);
            if (s->unsure)
                level = fmax(level, s->doubt * unsure_level(s, p, &at));
            if (s->given)
                level = fmax(level, ringing_noise_given(s, p, f->omega[i] / (2 * REAL_PI)));
            variance[p * f->m + i] = fmax(level, s->least[p]);
            freedom[i] = 2 * left;
        }
    }
    arena_close(a);
}

double ringing_noise_energy(const double *x, long n, double rate, const double band[2])
{
    struct arena *a = arena_open();
    size_t size = (size_t)(n - n % 2);
    struct fft *fft = fft_open(size);
    double *re = ARENA_TAKE(a, double, size / 2 + 1), *im = ARENA_TAKE(a, double, size / 2 + 1), sum = 0;
    fft_forward(fft, x, re, im);
    for (size_t k = 0; k <= size / 2; k++) {
        double hertz = (double)k * rate / (double)size;
        if (hertz >= band[0] && hertz <= band[1])
            sum += (re[k] * re[k] + im[k] * im[k]) * (k == 0 || k == size / 2 ? 1 : 2) / (double)size;
    }
    fft_close(fft);
    arena_close(a);
    return sum;
}
