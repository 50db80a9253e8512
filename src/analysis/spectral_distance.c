/* Third-octave levels of the whole (distance.h), and the log-spectral distance: over Hann windows of 2048 samples, half
   overlapping,

       sqrt(mean over windows and bins in the band of (10 log10 P_a/P_b)^2) ,

   both powers no lower than the noise and than 60 dB below the greatest of a: what cannot be heard does not count (Gray
   and Markel, Distance Measures for Speech Processing, IEEE Trans. ASSP 24, 1976, has it without a floor). */
#include "analysis/spectral_distance.h"

#include <math.h>
#include <string.h>

#include "analysis/distance.h"
#include "num/fft.h"
#include "num/real.h"

enum { WINDOW = 2048, BINS = WINDOW / 2 + 1 };

struct frames {
    struct fft *fft;
    double window[WINDOW], x[WINDOW], re[BINS], im[BINS];
};

static void frame_power(struct frames *f, const double *x, long from, long n, double power[BINS])
{
    for (long i = 0; i < WINDOW; i++)
        f->x[i] = from + i >= 0 && from + i < n ? f->window[i] * x[from + i] : 0.0;
    fft_forward(f->fft, f->x, f->re, f->im);
    for (int k = 0; k < BINS; k++)
        power[k] = f->re[k] * f->re[k] + f->im[k] * f->im[k];
}

static double loudest(struct frames *f, const double *x, long n, int from, int to)
{
    double power[BINS], most = 0.0;
    for (long at = -WINDOW / 2; at < n; at += WINDOW / 2) {
        frame_power(f, x, at, n, power);
        for (int k = from; k < to; k++)
            most = fmax(most, power[k]);
    }
    return most;
}

static double spectral_distance_log(const double *a, const double *b, long n, const struct spectral_distance_band *in)
{
    struct arena *arena = arena_open();
    struct frames *f = ARENA_TAKE(arena, struct frames, 1);
    double p[BINS], q[BINS], sum = 0.0, count = 0.0;
    int from = (int)ceil(in->low / in->rate * WINDOW), to = (int)(in->high / in->rate * WINDOW) + 1;
    f->fft = fft_open(WINDOW);
    for (int i = 0; i < WINDOW; i++)
        f->window[i] = (0.5 - 0.5 * real_cospi(2.0 * (i + 0.5) / WINDOW)) / sqrt(0.375 * WINDOW);
    to = to > BINS ? BINS : to;
    double floor = fmax(in->floor, 1e-6 * loudest(f, a, n, from, to));
    for (long at = -WINDOW / 2; at < n && floor > 0.0; at += WINDOW / 2) {
        frame_power(f, a, at, n, p);
        frame_power(f, b, at, n, q);
        for (int k = from; k < to; k++) {
            double d = p[k] > floor || q[k] > floor ? 10.0 * real_log10(fmax(p[k], floor) / fmax(q[k], floor)) : 0.0;
            sum += d * d;
            count += p[k] > floor || q[k] > floor;
        }
    }
    fft_close(f->fft);
    arena_close(arena);
    return count > 0.0 ? sqrt(sum / count) : 0.0;
}

static void third_octaves(const double *a, const double *b, long n, const struct spectral_distance_band *in,
                          struct spectral_distance *d)
{
    struct arena *arena = arena_open();
    double la[DISTANCE_BANDS], lb[DISTANCE_BANDS], most = -INFINITY;
    struct wav w = {.rate = in->rate, .channels = 1, .frames = (size_t)n, .x = ARENA_TAKE(arena, double, n)};
    memcpy(w.x, a, (size_t)n * sizeof *a);
    distance_band_levels(&w, arena, la);
    memcpy(w.x, b, (size_t)n * sizeof *b);
    distance_band_levels(&w, arena, lb);
    for (int k = 0; k < DISTANCE_BANDS; k++)
        most = fmax(most, la[k]);
    for (int k = 0; k < DISTANCE_BANDS; k++) {
        double centre = distance_band_centre(k), off = fabs(la[k] - lb[k]);
        if (centre * real_exp10(-0.05) < in->low || centre * real_exp10(0.05) > in->high || la[k] < most - 40.0)
            continue;
        d->bands++;
        d->third_octave_mean += off;
        if (off > d->third_octave_worst) {
            d->third_octave_worst = off;
            d->worst_at = distance_band_nominal(k);
        }
    }
    d->third_octave_mean /= d->bands ? d->bands : 1;
    arena_close(arena);
}

struct spectral_distance spectral_distance(const double *a, const double *b, long n,
                                           const struct spectral_distance_band *in)
{
    struct spectral_distance d = {0};
    third_octaves(a, b, n, in, &d);
    d.log_spectral = spectral_distance_log(a, b, n, in);
    return d;
}

/* ------------------------------------------------------------------ log spectral */

/* How far apart two spectrograms are, as a whole:

     d = mean over resolutions of sqrt(mean over channels, windows and bins of (10 log10(P_a / P_b))^2)

   P powers in Hann windows that overlap by half, of the powers of two nearest to 5, 20 and 80 ms: the short ones see
   when something happens, the long ones at what frequency. Powers below the floor, 60 dB under the greatest bin of a at
   that resolution, are raised to it, and what lies below in both is left out of the mean: what is not heard beside the
   rest does not count. Gray and Markel, Distance Measures for Speech Processing, IEEE Trans. ASSP 24, 1976, has the
   distance without a floor and at one resolution. */
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

double spectral_distance_sounds(const struct wav *a, const struct wav *b)
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
