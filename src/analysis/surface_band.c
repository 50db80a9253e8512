/* See surface_band.h. Density of a segment x[n] under the window w: 2 pitch |X_k|^2 / sum w^2; the median of an
   exponentially distributed figure is ln 2 of its mean. The window is Nuttall's with a continuous first derivative
   (IEEE ASSP 29, 1981, table II). Bins are averaged over twelfths of an octave before levels are compared. */
#include "analysis/surface_band.h"

#include <stdlib.h>
#include <string.h>

#include "num/fft.h"
#include "num/real.h"

enum { SEGMENT_MOST = 8192, SEGMENT_LEAST = 32, SEGMENTS_MOST = 256 };

struct band {
    const struct heightfile *h;
    size_t length, lines, next, line; /* of the direction: samples, parallel lines, and their distances in z */
    size_t n;                         /* samples of a segment */
    double pitch;
    double *window, *x, *re, *im;
    double *power; /* [segments][n/2 + 1] */
    size_t segments;
    double *k, *p; /* [nodes] cycles/m, m^2 per cycle/m */
    size_t nodes;
    struct fft *fft;
};

/* A profile is cut into at least eight (overlapping) pieces. */
static size_t band_segment(size_t length, size_t lines)
{
    size_t n = SEGMENT_MOST, most = lines < 8 ? 2 * length / 9 : length;
    while (n > most)
        n /= 2;
    return n;
}

static struct band band_make(const struct heightfile *h, bool down, struct arena *a)
{
    struct band b = {
        .h = h, .length = h->columns, .lines = h->rows, .next = 1, .line = h->columns, .pitch = h->pitch_x};
    if (down) {
        b = (struct band){
            .h = h, .length = h->rows, .lines = h->columns, .next = h->columns, .line = 1, .pitch = h->pitch_y};
    }
    b.n = band_segment(b.length, b.lines);
    if (b.n < SEGMENT_LEAST) return b;
    b.window = ARENA_TAKE(a, double, b.n);
    b.x = ARENA_TAKE(a, double, b.n);
    b.re = ARENA_TAKE(a, double, b.n / 2 + 1);
    b.im = ARENA_TAKE(a, double, b.n / 2 + 1);
    b.power = ARENA_TAKE(a, double, SEGMENTS_MOST *(b.n / 2 + 1));
    b.k = ARENA_TAKE(a, double, b.n / 2);
    b.p = ARENA_TAKE(a, double, b.n / 2);
    for (size_t i = 0; i < b.n; i++) {
        double t = 2 * ((double)i + 0.5) / (double)b.n;
        b.window[i] = 0.355768 - 0.487396 * real_cospi(t) + 0.144232 * real_cospi(2 * t) - 0.012604 * real_cospi(3 * t);
    }
    b.fft = fft_open(b.n);
    return b;
}

/* The segment less its least-squares line, under the window; false: it has a hole. */
static bool band_take(struct band *b, const double *z)
{
    double middle = 0.5 * (double)(b->n - 1), mean = 0, tilt = 0, square = 0;
    for (size_t i = 0; i < b->n; i++)
        mean += z[i * b->next] / (double)b->n;
    for (size_t i = 0; i < b->n; i++) {
        double at = (double)i - middle;
        tilt += at * (z[i * b->next] - mean);
        square += at * at;
    }
    for (size_t i = 0; i < b->n; i++)
        b->x[i] = (z[i * b->next] - mean - tilt / square * ((double)i - middle)) * b->window[i];
    return !isnan(mean);
}

static void band_add(struct band *b, const double *z)
{
    double energy = 0, *power = b->power + b->segments * (b->n / 2 + 1);
    if (!band_take(b, z)) return;
    for (size_t i = 0; i < b->n; i++)
        energy += b->window[i] * b->window[i];
    fft_forward(b->fft, b->x, b->re, b->im);
    for (size_t k = 0; k <= b->n / 2; k++)
        power[k] = 2 * b->pitch / energy * (b->re[k] * b->re[k] + b->im[k] * b->im[k]);
    b->segments++;
}

/* All segments there are, or SEGMENTS_MOST of them evenly spread: number s is piece s % pieces of line s / pieces. */
static void band_gather(struct band *b)
{
    size_t pieces = 2 * (b->length / b->n) - 1, all = pieces * b->lines,
           take = all < SEGMENTS_MOST ? all : SEGMENTS_MOST;
    for (size_t t = 0; t < take; t++) {
        size_t s = t * all / take;
        band_add(b, b->h->z + s / pieces * b->line + s % pieces * (b->n / 2) * b->next);
    }
}

static int band_order(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double band_median(struct band *b, size_t k, double *room)
{
    size_t n = b->segments;
    for (size_t s = 0; s < n; s++)
        room[s] = b->power[s * (b->n / 2 + 1) + k];
    qsort(room, n, sizeof *room, band_order);
    double median = n % 2 ? room[n / 2] : 0.5 * (room[n / 2 - 1] + room[n / 2]);
    return n > 2 ? median / 0.69314718055994531 : median;
}

/* Nodes of a twelfth of an octave, at least one bin, from the fourth on: below is the window's main lobe at 0. */
static void band_nodes(struct band *b)
{
    double room[SEGMENTS_MOST], dk = 1 / ((double)b->n * b->pitch);
    for (size_t from = 4, to; from < b->n / 2; from = to) {
        double sum = 0;
        to = (size_t)((double)from * 1.0594630943592953 + 0.5);
        to = to > from ? to : from + 1;
        to = to > b->n / 2 ? b->n / 2 : to;
        for (size_t k = from; k < to; k++)
            sum += band_median(b, k, room);
        b->k[b->nodes] = dk * 0.5 * (double)(from + to - 1);
        b->p[b->nodes++] = sum / (double)(to - from);
    }
}

/* Mean density between two frequencies, in parts of the Nyquist frequency. */
static double band_mean(const struct band *b, double nyquist, double from, double to)
{
    double sum = 0, n = 0;
    for (size_t i = 0; i < b->nodes; i++)
        if (b->k[i] >= from * nyquist && b->k[i] < to * nyquist) {
            sum += b->p[i];
            n += 1;
        }
    return n > 0 ? sum / n : NAN;
}

static double band_highest(const struct band *b)
{
    double most = 0;
    for (size_t i = 0; i < b->nodes; i++)
        most = fmax(most, b->p[i]);
    return most;
}

static void band_floor(const struct band *b, struct surface_band *r)
{
    double lower = band_mean(b, r->nyquist, 0.5, 0.75), upper = band_mean(b, r->nyquist, 0.75, 1),
           most = band_highest(b);
    r->noise = upper > 0 && lower < 1.25 * upper && upper < 1.25 * lower && most > 10 * upper && upper > 1e-8 * most;
    r->floor = r->noise ? upper : NAN;
}

/* For an octave from node i on: nothing within 40 dB of the highest, and at most a quarter of the nodes above the
   threshold. Single weak lines there are artefacts (aliases of resampling, mains hum); strong ones are the harmonics of
   ridges. */
static bool band_stays(const struct band *b, size_t i, double threshold, double most)
{
    size_t above = 0, nodes = 0;
    for (size_t j = i; j < b->nodes && b->k[j] <= 2 * b->k[i]; j++) {
        if (b->p[j] > fmax(threshold, 1e-4 * most)) return false;
        above += b->p[j] > threshold;
        nodes++;
    }
    return 4 * above <= nodes && !(b->p[i] > threshold);
}

/* From the highest node up to the first from which on it stays below; between it and the one before it the crossing, in
 * log-log. */
static void band_limit(const struct band *b, struct surface_band *r)
{
    double most = band_highest(b), threshold = r->noise ? 4 * r->floor : 1e-8 * most;
    size_t i = 0;
    while (b->p[i] < most)
        i++;
    while (i < b->nodes && !band_stays(b, i, threshold, most))
        i++;
    r->limit = NAN;
    if (i == b->nodes || i == 0) return;
    double share = b->p[i] > 0 ? real_log(b->p[i - 1] / threshold) / real_log(b->p[i - 1] / b->p[i]) : 0;
    r->limit = b->k[i - 1] * real_pow(b->k[i] / b->k[i - 1], share);
}

/* Mean square curvature is the integral of (2 pi k)^4 P. */
static void band_beyond(const struct band *b, struct surface_band *r)
{
    double all = 0, beyond = 0;
    for (size_t i = 1; i + 1 < b->nodes; i++) {
        double k2 = b->k[i] * b->k[i], part = k2 * k2 * b->p[i] * (b->k[i + 1] - b->k[i - 1]);
        all += part;
        beyond += b->k[i] > r->limit ? part : 0;
    }
    r->beyond = all > 0 && !isnan(r->limit) ? beyond / all : NAN;
}

static void band_exponent(const struct band *b, struct surface_band *r)
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    r->to = 0.5 * (isnan(r->limit) ? r->nyquist : r->limit);
    r->from = fmax(r->to / 8, b->k[0]);
    for (size_t i = 0; i < b->nodes; i++) {
        if (b->k[i] < r->from || b->k[i] > r->to || !(b->p[i] > 0)) continue;
        double u = real_log(b->k[i] / r->from), v = real_log(b->p[i] / b->p[0]);
        n += 1, x += u, y += v, xx += u * u, xy += u * v;
    }
    r->exponent = n >= 3 ? (n * xy - x * y) / (n * xx - x * x) : NAN;
}

void surface_band(const struct heightfile *h, bool down, struct surface_band *r)
{
    struct arena *own = arena_open();
    struct band b = band_make(h, down, own);
    *r = (struct surface_band){.segment = b.n,
                               .nyquist = 0.5 / b.pitch,
                               .limit = NAN,
                               .floor = NAN,
                               .beyond = NAN,
                               .exponent = NAN,
                               .from = NAN,
                               .to = NAN};
    if (b.fft) {
        band_gather(&b);
        fft_close(b.fft);
    }
    r->segments = b.segments;
    if (b.segments > 0) band_nodes(&b);
    if (b.nodes == 0 || !(band_highest(&b) > 0))
        r->segments = 0;
    else {
        band_floor(&b, r);
        band_limit(&b, r);
        band_beyond(&b, r);
        band_exponent(&b, r);
    }
    arena_close(own);
}
