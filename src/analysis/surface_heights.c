/* See surface_heights.h. Sums go row by row, then over the rows. Rounding to a step q is noise of variance q^2/12 at
   each sample; the second difference (1, -2, 1) has 6 times the variance, over pitch^2. The spline through such samples
   has at its knots 2.45 times the second difference's noise. */
#include "analysis/surface_heights.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "file/heightfile.h"
#include "num/fft.h"
#include "num/real.h"

enum { STEPS_MOST = 1 << 20 };

/* Sum over the heights of (z - mean)^power (power 0: of z, and how many), absolute for power 1. */
static double heights_sum(const struct heightfile *h, double mean, int power, double *count)
{
    double total = 0, n = 0;
    for (size_t j = 0; j < h->rows; j++) {
        double row = 0;
        for (size_t i = 0; i < h->columns; i++) {
            double z = h->z[j * h->columns + i], d = z - mean, d2 = d * d;
            if (isnan(z)) continue;
            n += 1;
            row += power == 0 ? z : power == 1 ? fabs(d) : power == 2 ? d2 : power == 3 ? d2 * d : d2 * d2;
        }
        total += row;
    }
    if (count) *count = n;
    return total;
}

/* Root mean square of first and second differences; `next` is the distance of neighbours in z. Those that touch a hole
 * are left out. */
static void heights_differences(const struct heightfile *h, bool down, double *slope, double *curvature)
{
    size_t n = down ? h->rows : h->columns, lines = down ? h->columns : h->rows, next = down ? h->columns : 1,
           line = down ? 1 : h->columns;
    double pitch = down ? h->pitch_y : h->pitch_x, s1 = 0, s2 = 0, n1 = 0, n2 = 0;
    for (size_t j = 0; j < lines; j++) {
        const double *z = h->z + j * line;
        double r1 = 0, r2 = 0;
        for (size_t i = 1; i < n; i++) {
            double d = z[i * next] - z[(i - 1) * next], c = i + 1 < n ? z[(i + 1) * next] - z[i * next] - d : NAN;
            r1 += isnan(d) ? 0 : d * d;
            n1 += !isnan(d);
            r2 += isnan(c) ? 0 : c * c;
            n2 += !isnan(c);
        }
        s1 += r1;
        s2 += r2;
    }
    *slope = n1 > 0 ? sqrt(s1 / n1) / pitch : NAN;
    *curvature = n2 > 0 ? sqrt(s2 / n2) / (pitch * pitch) : NAN;
}

void surface_heights(const struct heightfile *h, struct surface_heights *s)
{
    double n;
    *s = (struct surface_heights){.low = HUGE_VAL, .high = -HUGE_VAL, .slope_y = NAN, .curvature_y = NAN};
    s->mean = heights_sum(h, 0, 0, &n) / n;
    for (size_t i = 0; i < h->rows * h->columns; i++) {
        s->low = fmin(s->low, h->z[i]);
        s->high = fmax(s->high, h->z[i]);
    }
    s->sz = s->high - s->low;
    if (s->sz == 0) s->mean = s->low; /* without the rounding of the sum */
    s->sa = heights_sum(h, s->mean, 1, NULL) / n;
    s->sq = sqrt(heights_sum(h, s->mean, 2, NULL) / n);
    s->ssk = s->sz > 0 ? heights_sum(h, s->mean, 3, NULL) / n / (s->sq * s->sq * s->sq) : NAN;
    s->sku = s->sz > 0 ? heights_sum(h, s->mean, 4, NULL) / n / (s->sq * s->sq * s->sq * s->sq) : NAN;
    heights_differences(h, false, &s->slope, &s->curvature);
    if (h->rows > 1) heights_differences(h, true, &s->slope_y, &s->curvature_y);
}

/* ------------------------------------------------------------------ steps */

/* The first million heights that are there, sorted. */
static double *heights_sorted(const struct heightfile *h, struct arena *a, size_t *n)
{
    size_t all = h->rows * h->columns;
    double *z = ARENA_TAKE(a, double, all < STEPS_MOST ? all : STEPS_MOST);
    *n = 0;
    for (size_t i = 0; i < all && *n < STEPS_MOST; i++)
        if (!isnan(h->z[i])) z[(*n)++] = h->z[i];
    gsl_sort(z, 1, *n);
    return z;
}

void surface_heights_steps(const struct heightfile *h, struct surface_heights_steps *s)
{
    struct arena *own = arena_open();
    size_t n;
    const double *z = heights_sorted(h, own, &n);
    double gap = HUGE_VAL,
           least = n ? 1e-9 * (z[n - 1] - z[0]) : 0; /* levels nearer than that are one, with rounding errors */
    *s = (struct surface_heights_steps){.looked_at = n, .levels = n > 0, .step = h->quantum};
    for (size_t i = 1; i < n; i++)
        if (z[i] - z[i - 1] > least) {
            s->levels++;
            gap = fmin(gap, z[i] - z[i - 1]);
        }
    if (n >= 16 && s->levels > 1 && s->levels <= n / 2 && gap > s->step) s->step = gap;
    s->noise = s->step * sqrt(6.0 / 12) / (h->pitch_x * h->pitch_x);
    arena_close(own);
}

/* ------------------------------------------------------------------ surface ends */

enum { PERIOD_MOST = 1 << 22 };

struct ends {
    const struct heightfile *h;
    size_t n, lines, next, line;
    double pitch;
};

static double ends_square(double sum, double n) { return n > 0 ? sqrt(sum / n) : NAN; }

/* Root mean square over the lines of z[i] - z[j]. */
static double ends_between(const struct ends *s, size_t i, size_t j)
{
    double sum = 0, n = 0;
    for (size_t k = 0; k < s->lines; k++) {
        double d = s->h->z[k * s->line + i * s->next] - s->h->z[k * s->line + j * s->next];
        sum += isnan(d) ? 0 : d * d;
        n += !isnan(d);
    }
    return ends_square(sum, n);
}

/* From the end (back = false: from the start) how many samples until steps are never again out of the ordinary. */
static size_t ends_fall(const struct ends *s, const double *step, double ordinary, bool last, size_t margin)
{
    for (size_t i = margin; i > 0; i--)
        if (step[last ? s->n - 1 - i : i - 1] > 1.5 * ordinary) return i;
    return 0;
}

static void ends_falls(const struct ends *s, const double *step, struct surface_heights_ends *r)
{
    size_t margin = s->n / 8 < 64 ? s->n / 8 : 64;
    double ordinary = 0;
    for (size_t i = margin; i + 1 + margin < s->n; i++)
        ordinary = fmax(ordinary, step[i]);
    for (int last = 0; last < 2 && ordinary > 0; last++) {
        size_t fall = ends_fall(s, step, ordinary, last, margin);
        r->fall[last] = fall;
        r->drop[last] = fall ? ends_between(s, last ? s->n - 1 - fall : 0, last ? s->n - 1 : fall) : 0;
    }
}

void surface_heights_ends(const struct heightfile *h, bool down, struct surface_heights_ends *r)
{
    struct ends s = {h,
                     down ? h->rows : h->columns,
                     down ? h->columns : h->rows,
                     down ? h->columns : 1,
                     down ? 1 : h->columns,
                     down ? h->pitch_y : h->pitch_x};
    struct arena *own = arena_open();
    double *step = ARENA_TAKE(own, double, s.n), sum = 0, n = 0;
    *r = (struct surface_heights_ends){.jump = ends_between(&s, 0, s.n - 1)};
    for (size_t i = 0; i + 1 < s.n; i++) {
        step[i] = ends_between(&s, i + 1, i);
        sum += isnan(step[i]) ? 0 : step[i] * step[i];
        n += !isnan(step[i]);
    }
    r->step = ends_square(sum, n);
    r->kink = 2 * sqrt(0.5 * (step[0] * step[0] + step[s.n - 2] * step[s.n - 2])) / s.pitch;
    ends_falls(&s, step, r);
    arena_close(own);
}

/* ------------------------------------------------------------------ period */

/* r[lag] for lags below n: the product of the two overlapping parts over the root of their squares, so that |r| <= 1.
 */
static void period_normalise(double *r, const double *x, size_t n)
{
    double before = 0, after = 0, least;
    for (size_t i = 0; i < n; i++)
        before += x[i] * x[i];
    after = before;
    least = 1e-12 * before;
    for (size_t lag = 0; lag < n; lag++) {
        r[lag] = before > least && after > least ? r[lag] / sqrt(before * after) : 0;
        before -= x[n - 1 - lag] * x[n - 1 - lag];
        after -= x[lag] * x[lag];
    }
}

static double *period_correlation(const struct heightfile *h, size_t n, struct arena *a)
{
    size_t size = fft_good_size(2 * n);
    struct heightfile part = {
        .columns = n, .rows = 1, .pitch_x = NAN, .pitch_y = NAN, .z = ARENA_TAKE(a, double, size)};
    double *re = ARENA_TAKE(a, double, size / 2 + 1), *im = ARENA_TAKE(a, double, size / 2 + 1),
           *r = ARENA_TAKE(a, double, size);
    struct fft *f = fft_open(size);
    for (size_t i = 0; i < n; i++)
        part.z[i] = h->z[i];
    heightfile_level(&part, HEIGHTFILE_LEVEL_PLANE);
    fft_forward(f, part.z, re, im);
    for (size_t k = 0; k <= size / 2; k++) {
        re[k] = (re[k] * re[k] + im[k] * im[k]) / (double)size;
        im[k] = 0;
    }
    fft_inverse(f, re, im, r);
    fft_close(f);
    period_normalise(r, part.z, n);
    return r;
}

/* To both sides of the peak half of it is lost within `width`. */
static bool period_narrow(const double *r, size_t lag, size_t width)
{
    bool left = false, right = false;
    for (size_t i = 1; i <= width && i <= lag; i++) {
        left = left || r[lag - i] < 0.5 * r[lag];
        right = right || r[lag + i] < 0.5 * r[lag];
    }
    return left && right;
}

void surface_heights_period(const struct heightfile *h, struct surface_heights_period *p)
{
    struct arena *own = arena_open();
    size_t n = h->columns < PERIOD_MOST ? h->columns : PERIOD_MOST, half = 0;
    *p = (struct surface_heights_period){.peak = NAN, .others = NAN};
    const double *r = h->rows == 1 && h->holes == 0 ? period_correlation(h, n, own) : NULL;
    while (r && half < n / 2 && r[half] > 0.5)
        half++;
    size_t from = 10 * half, to = n / 2;
    double sum = 0;
    for (size_t i = from; r && half > 0 && i < to; i++) {
        sum += r[i] * r[i];
        if (p->lag == 0 || r[i] > r[p->lag]) p->lag = i;
    }
    if (p->lag > 0) {
        p->correlation = half;
        p->peak = r[p->lag];
        p->others = sqrt(sum / (double)(to - from));
        p->stands_out = p->peak >= 0.2 && p->peak >= 5 * p->others && period_narrow(r, p->lag, 3 * half);
    }
    arena_close(own);
}

/* ------------------------------------------------------------------ surface band */

/* Density of a segment x[n] under the window w: 2 pitch |X_k|^2 / sum w^2; the median of an
   exponentially distributed figure is ln 2 of its mean. The window is Nuttall's with a continuous first derivative
   (IEEE ASSP 29, 1981, table II). Bins are averaged over twelfths of an octave before levels are compared. */
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

static void band_floor(const struct band *b, struct surface_heights_band *r)
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
static void band_limit(const struct band *b, struct surface_heights_band *r)
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
static void band_beyond(const struct band *b, struct surface_heights_band *r)
{
    double all = 0, beyond = 0;
    for (size_t i = 1; i + 1 < b->nodes; i++) {
        double k2 = b->k[i] * b->k[i], part = k2 * k2 * b->p[i] * (b->k[i + 1] - b->k[i - 1]);
        all += part;
        beyond += b->k[i] > r->limit ? part : 0;
    }
    r->beyond = all > 0 && !isnan(r->limit) ? beyond / all : NAN;
}

static void band_exponent(const struct band *b, struct surface_heights_band *r)
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

void surface_heights_band(const struct heightfile *h, bool down, struct surface_heights_band *r)
{
    struct arena *own = arena_open();
    struct band b = band_make(h, down, own);
    *r = (struct surface_heights_band){.segment = b.n,
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
