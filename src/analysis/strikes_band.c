/* Where a response divided by a force means something: the force's power, and how far the strikes agree.

   Coherence here is the share of the sound's power that the common response explains, 1 - sum |R|^2 / sum |X|^2 over the strikes' windows, R what is left of the sound X: it
   falls where there is noise, where strikes fell on other places, and where the object is not linear. From the same R comes the error of the response itself,
   sum |R|^2 / ((k - 1) sum |F|^2) for k strikes (Bendat and Piersol, Random Data, 2010, 9.2). */
#include <math.h>
#include <string.h>

#include "analysis/strikes_response.h"
#include "num/fft.h"
#include "num/real.h"

static const double reach = 1e-4;     /* of the greatest power: 40 dB */
static const double above = 10.0;     /* the force's noise */
static const double sounds = 4.0;     /* times the sound's noise */
static const double agree = 1.0 / 3;  /* least coherence of a third octave */

struct spectra {
    long n;               /* size of the transforms */
    double *x, *r;        /* [n/2 + 1] sums of |X|^2 and |R|^2 over strikes */
    double *noise;        /* [n/2 + 1] what of x is noise; NULL: not known  */
};

static void add_window(struct fft *fft, const double *x, long n, long size, double *work, double *power)
{
    double *re = work + size, *im = re + size / 2 + 1;
    memcpy(work, x, (size_t)n * sizeof *x);
    memset(work + n, 0, (size_t)(size - n) * sizeof *x);
    fft_forward(fft, work, re, im);
    for (long i = 0; i <= size / 2; i++)
        power[i] += re[i] * re[i] + im[i] * im[i];
}

static struct spectra spectra(const struct strikes_job *j, long size, struct arena *a)
{
    struct spectra s = {size, ARENA_TAKE(a, double, size / 2 + 1), ARENA_TAKE(a, double, size / 2 + 1), NULL};
    long quiet = j->quiet_to - j->quiet_from < size ? j->quiet_to - j->quiet_from : size, samples = 0;
    struct fft *fft = fft_open((size_t)size);
    double *work = ARENA_TAKE(a, double, 2 * size + 2);
    for (int k = 0; k < j->s->n; k++) {
        const struct strikes_one *v = &j->s->strike[k];
        long n = v->end - v->onset < size ? v->end - v->onset : size;
        if (j->used[k]) {
            add_window(fft, j->r->sound + v->onset, n, size, work, s.x);
            add_window(fft, j->left + v->onset, n, size, work, s.r);
            samples += n;
        }
    }
    if (quiet > 0) {
        s.noise = ARENA_TAKE(a, double, size / 2 + 1);
        add_window(fft, j->r->sound + j->quiet_from, quiet, size, work, s.noise);
        for (long i = 0; i <= size / 2; i++)
            s.noise[i] *= (double)samples / (double)quiet;
    }
    fft_close(fft);
    return s;
}

/* ------------------------------------------------------------------ band */

static double sum(const double *x, long from, long to)
{
    double total = 0.0;
    for (long i = from; i < to; i++)
        total += x[i];
    return total;
}

/* The least of the force's power between two frequencies, of the rate: where a pulse's spectrum has a zero, division makes a mode of the noise. */
static double force_power(const struct strikes_job *j, double low, double high)
{
    long from = (long)(low * (double)j->size), to = (long)(high * (double)j->size) + 1;
    double least = INFINITY;
    for (long i = from; i < to && i <= j->size / 2; i++)
        least = fmin(least, j->system.power[i]);
    return least;
}

/* Does the third octave upwards from f (of the rate) hold enough force and agreement? */
static bool holds(const struct strikes_job *j, const struct spectra *s, double f)
{
    double top = fmin(f * real_exp10(0.1), 0.5);
    long from = (long)(f * (double)s->n), to = (long)(top * (double)s->n) + 1;
    to = to > s->n / 2 + 1 ? s->n / 2 + 1 : to;
    double k = j->h->used, freedom = k > 1.0 ? k / (k - 1.0) : 1.0; /* a fit to k strikes leaves less than there is */
    bool agrees = k < 2.0 || freedom * sum(s->r, from, to) <= (1.0 - agree) * sum(s->x, from, to);
    if (s->noise)
        agrees = sum(s->x, from, to) >= sounds * sum(s->noise, from, to);
    return agrees && force_power(j, f, top) >= fmax(reach * j->most, above * j->floor);
}

/* The farthest third octave that holds on the way by `step`, over gaps of at most one. */
static double farthest(const struct strikes_job *j, const struct spectra *s, double f, double step)
{
    double last = f;
    for (int gap = 0; gap <= 1; gap++) {
        f *= step;
        if (f * j->r->rate < 20.0 || f > 0.499)
            break;
        if (holds(j, s, f)) {
            last = f;
            gap = -1;
        }
    }
    return last;
}

void strikes_band(struct strikes_job *j)
{
    struct arena *a = arena_open();
    double rate = j->r->rate, f = 0.5 * real_exp10(-0.1), step = real_exp10(-0.1), best = 0.0, low, high;
    if (!j->r->force) {
        arena_close(a);
        return;
    }
    struct spectra s = spectra(j, (long)fft_good_size((size_t)j->h->length), a);
    low = high = NAN;
    for (double g = f; g * rate > 20.0; g *= step) { /* from the strongest that holds, both ways */
        double p = holds(j, &s, g) ? sum(s.x, (long)(g * (double)s.n), (long)(g / step * (double)s.n)) : 0.0;
        if (p > best) {
            best = p;
            low = high = g;
        }
    }
    if (!isnan(low)) {
        low = farthest(j, &s, low, step);
        high = farthest(j, &s, high, 1.0 / step);
        j->h->low = low * rate;
        j->h->high = (high / step < 0.499 ? high : 0.5) * rate; /* the last third octave that holds is for the fade */
    }
    arena_close(a);
}

/* ------------------------------------------------------------------ shaping */

static double fade(double f, double high)
{
    double at = (f / high - 1.0) / 0.26;
    return at <= 0.0 ? 1.0 : at >= 1.0 ? 0.0 : 0.5 + 0.5 * real_cos(REAL_PI * at);
}

void strikes_band_fade(const struct strikes_job *j, double *x, long n, bool shaped)
{
    struct arena *a = arena_open();
    long size = (long)fft_good_size((size_t)(n + n / 4 + 2)), bins = size / 2 + 1;
    struct fft *fft = fft_open((size_t)size);
    double *work = ARENA_TAKE(a, double, size), *re = ARENA_TAKE(a, double, bins), *im = ARENA_TAKE(a, double, bins);
    bool fades = j->h->high < 0.45 * j->r->rate;
    memcpy(work, x, (size_t)n * sizeof *x);
    fft_forward(fft, work, re, im);
    for (long i = 0; i < bins; i++) {
        double f = (double)i / (double)size, s = j->system.power[(long)(f * (double)j->size)];
        double factor = (fades ? fade(f * j->r->rate, j->h->high) : 1.0) * (shaped ? sqrt(s) / (s + j->system.ridge) : 1.0) / (double)size;
        re[i] *= factor;
        im[i] *= factor;
    }
    fft_inverse(fft, re, im, work);
    memcpy(x, work, (size_t)n * sizeof *x);
    fft_close(fft);
    arena_close(a);
}

/* ------------------------------------------------------------------ coherence */

/* The variance of H1: what k strikes leave, of k - 1 degrees of freedom, over the force's power. */
static void unsure_make(struct strikes_job *j, const struct spectra *s)
{
    struct strikes_response *h = j->h;
    bool fades = h->high < 0.45 * j->r->rate;
    h->unsure = ARENA_TAKE(j->a, double, h->n / 2 + 1);
    for (long i = 0; i <= h->n / 2; i++) {
        double f = (double)i / (double)h->n, power = j->system.power[(long)(f * (double)j->size)];
        double shape = (fades ? fade(f * j->r->rate, h->high) : 1.0) * j->r->rate / (power + j->system.ridge);
        h->unsure[i] = power * shape * shape * s->r[i] / ((double)(h->used - 1) * (double)h->n);
    }
}

void strikes_band_coherence(struct strikes_job *j)
{
    struct arena *a = arena_open();
    struct strikes_response *h = j->h;
    h->explained = ARENA_TAKE(j->a, double, j->s->n);
    for (int k = 0; k < j->s->n; k++)
        h->explained[k] = j->used[k] ? fmax(0.0, strikes_response_explained(j, &j->s->strike[k])) : NAN;
    if (h->used > 1) {
        struct spectra s = spectra(j, h->n, a);
        h->coherence = ARENA_TAKE(j->a, double, h->n / 2 + 1);
        for (long i = 0; i <= h->n / 2; i++)
            h->coherence[i] = s.x[i] > 0.0 ? fmax(0.0, 1.0 - s.r[i] / s.x[i]) : 0.0;
        unsure_make(j, &s);
    }
    arena_close(a);
}
