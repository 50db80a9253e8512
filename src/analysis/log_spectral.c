/* How far apart two spectrograms are, as a whole:

     d = mean over resolutions of sqrt(mean over channels, windows and bins of (10 log10(P_a / P_b))^2)

   P powers in Hann windows that overlap by half, of the powers of two nearest to 5, 20 and 80 ms: the short ones see
   when something happens, the long ones at what frequency. Powers below the floor, 60 dB under the greatest bin of a at
   that resolution, are raised to it, and what lies below in both is left out of the mean: what is not heard beside the
   rest does not count. Gray and Markel, Distance Measures for Speech Processing, IEEE Trans. ASSP 24, 1976, has the
   distance without a floor and at one resolution. */
#include "analysis/log_spectral.h"

#include <math.h>
#include <string.h>

#include "num/fft.h"
#include "num/real.h"

static const double windows[] = {5e-3, 20e-3, 80e-3}; /* s */

struct resolution {
    struct fft *fft;
    long size;
    double *window, *x, *re, *im;
};

static long nearest_power(double samples) { return 1L << (int)fmax(rint(real_log(samples) / real_log(2.0)), 3.0); }

static struct resolution resolve(double samples, struct arena *a)
{
    long n = nearest_power(samples);
    struct resolution r = {.fft = fft_open((size_t)n),
                           .size = n,
                           .window = ARENA_TAKE(a, double, n),
                           .x = ARENA_TAKE(a, double, n),
                           .re = ARENA_TAKE(a, double, n / 2 + 1),
                           .im = ARENA_TAKE(a, double, n / 2 + 1)};
    for (long i = 0; i < n; i++)
        r.window[i] = 0.5 - 0.5 * real_cospi(2.0 * ((double)i + 0.5) / (double)n);
    return r;
}

/* Powers of one window, into r->re. */
static void powers(struct resolution *r, const struct wav *w, int channel, long from)
{
    for (long i = 0; i < r->size; i++)
        r->x[i] =
            from + i >= 0 && from + i < (long)w->frames ? r->window[i] * w->x[(from + i) * w->channels + channel] : 0.0;
    fft_forward(r->fft, r->x, r->re, r->im);
    for (long k = 0; k <= r->size / 2; k++)
        r->re[k] = r->re[k] * r->re[k] + r->im[k] * r->im[k];
}

static double greatest(struct resolution *r, const struct wav *w)
{
    double most = 0.0;
    for (int c = 0; c < w->channels; c++)
        for (long from = -r->size / 2; from < (long)w->frames; from += r->size / 2) {
            powers(r, w, c, from);
            for (long k = 0; k <= r->size / 2; k++)
                most = fmax(most, r->re[k]);
        }
    return most;
}

static double distance(struct resolution *r, const struct wav *a, const struct wav *b, double *p)
{
    double floor = 1e-6 * greatest(r, a), sum = 0.0, count = 0.0;
    long bins = r->size / 2 + 1;
    for (int c = 0; c < a->channels && floor > 0.0; c++)
        for (long from = -r->size / 2; from < (long)a->frames; from += r->size / 2) {
            powers(r, a, c, from);
            memcpy(p, r->re, (size_t)bins * sizeof *p);
            powers(r, b, c, from);
            for (long k = 0; k < bins; k++) {
                if (p[k] <= floor && r->re[k] <= floor) continue;
                double d = 10.0 * real_log10(fmax(p[k], floor) / fmax(r->re[k], floor));
                sum += d * d;
                count++;
            }
        }
    return count > 0.0 ? sqrt(sum / count) : 0.0;
}

double log_spectral(const struct wav *a, const struct wav *b)
{
    enum { N = sizeof windows / sizeof *windows };
    struct wav x = *a, y = *b;
    double mean = 0.0;
    x.frames = y.frames = a->frames < b->frames ? a->frames : b->frames;
    for (int i = 0; i < N; i++) {
        struct arena *arena = arena_open();
        struct resolution r = resolve(windows[i] * a->rate, arena);
        mean += distance(&r, &x, &y, ARENA_TAKE(arena, double, r.size / 2 + 1)) / N;
        fft_close(r.fft);
        arena_close(arena);
    }
    return mean;
}
