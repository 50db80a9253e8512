/* See surface_ends.h. */
#include "analysis/surface_ends.h"

#include <math.h>

#include "file/heightfile.h"
#include "num/fft.h"

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

static void ends_falls(const struct ends *s, const double *step, struct surface_ends *r)
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

void surface_ends(const struct heightfile *h, bool down, struct surface_ends *r)
{
    struct ends s = {h,
                     down ? h->rows : h->columns,
                     down ? h->columns : h->rows,
                     down ? h->columns : 1,
                     down ? 1 : h->columns,
                     down ? h->pitch_y : h->pitch_x};
    struct arena *own = arena_open();
    double *step = ARENA_TAKE(own, double, s.n), sum = 0, n = 0;
    *r = (struct surface_ends){.jump = ends_between(&s, 0, s.n - 1)};
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

void surface_ends_period(const struct heightfile *h, struct surface_ends_period *p)
{
    struct arena *own = arena_open();
    size_t n = h->columns < PERIOD_MOST ? h->columns : PERIOD_MOST, half = 0;
    *p = (struct surface_ends_period){.peak = NAN, .others = NAN};
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
