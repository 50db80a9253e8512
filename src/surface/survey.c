/* See survey.h. */
#include "surface/survey.h"

#include <string.h>

#include "num/fft.h"
#include "num/real.h"

enum { ROWS_MOST = 256, SEGMENT_LEAST = 1024 };

static long segment_of(size_t columns)
{
    size_t n = columns / 8 > SEGMENT_LEAST ? columns / 8 : columns < SEGMENT_LEAST ? columns : SEGMENT_LEAST;
    n -= n % 2;
    while (fft_good_size(n) != n)
        n -= 2;
    return (long)n;
}

/* z less its least-squares line. */
static void levelled(const double *z, size_t n, double *out)
{
    double middle = 0.5 * (double)(n - 1), mean = 0, tilt = 0, square = 0;
    for (size_t i = 0; i < n; i++)
        mean += z[i] / (double)n;
    for (size_t i = 0; i < n; i++) {
        double at = (double)i - middle;
        tilt += at * (z[i] - mean);
        square += at * at;
    }
    for (size_t i = 0; i < n; i++)
        out[i] = z[i] - mean - tilt / square * ((double)i - middle);
}

struct welch {
    long n; /* samples of a segment */
    struct fft *fft;
    double *hann, *x, *re, *im, *power; /* power: [n/2] sums of squared moduli */
    long segments;
};

static void welch_add(struct welch *w, const double *z)
{
    for (long i = 0; i < w->n; i++)
        w->x[i] = z[i] * w->hann[i];
    fft_forward(w->fft, w->x, w->re, w->im);
    for (long k = 0; k < w->n / 2; k++)
        w->power[k] += w->re[k] * w->re[k] + w->im[k] * w->im[k];
    w->segments++;
}

static struct welch welch_of(struct arena *a, const struct survey_grid *g)
{
    long n = segment_of(g->columns);
    struct welch w = {.n = n,
                      .fft = fft_open((size_t)n),
                      .hann = ARENA_TAKE(a, double, n),
                      .x = ARENA_TAKE(a, double, n),
                      .re = ARENA_TAKE(a, double, n / 2 + 1),
                      .im = ARENA_TAKE(a, double, n / 2 + 1),
                      .power = ARENA_TAKE(a, double, n / 2)};
    double *row = ARENA_TAKE(a, double, g->columns);
    size_t rows = g->rows < ROWS_MOST ? g->rows : ROWS_MOST;
    for (long i = 0; i < n; i++)
        w.hann[i] = 0.5 - 0.5 * real_cospi(2 * ((double)i + 0.5) / (double)n);
    for (size_t r = 0; r < rows; r++) {
        levelled(g->z + r * g->rows / rows * g->columns, g->columns, row);
        for (long at = 0; at + n <= (long)g->columns; at += n / 2)
            welch_add(&w, row + at);
    }
    fft_close(w.fft);
    return w;
}

struct spectrum survey_spectrum(struct arena *a, const struct survey_grid *g)
{
    struct welch w = welch_of(a, g);
    double dk = 1 / ((double)w.n * g->pitch), unit = 2 * g->pitch / ((double)w.n * 0.375 * (double)w.segments),
           step = real_exp(real_log(2) / 3);
    struct spectrum s = {.k = ARENA_TAKE(a, double, w.n / 2), .p = ARENA_TAKE(a, double, w.n / 2), .flat = true};
    for (long from = 2, to; from < w.n / 2; from = to) {
        to = (long)((double)from * step + 0.5);
        to = to < from + 3 ? from + 3 : to;
        if (to > w.n / 2) break;
        double sum = 0;
        for (long k = from; k < to; k++)
            sum += w.power[k];
        if (!(sum > 0)) break;
        s.k[s.n] = dk * sqrt(((double)from - 0.5) * ((double)to - 0.5));
        s.p[s.n++] = unit * sum / (double)(to - from);
    }
    return s;
}

enum { OCTAVE = 3 }; /* nodes */

double survey_knee(const struct spectrum *s)
{
    int i = 0;
    while (i + OCTAVE < s->n && (s->k[i + OCTAVE] > 2.2 * s->k[i] || s->p[i + OCTAVE] > 1e-3 * s->p[i]))
        i++;
    if (i + OCTAVE >= s->n) return spectrum_top(s);
    while (s->p[i + 1] > 0.3 * s->p[i])
        i++;
    return s->k[i];
}

double survey_limit(const struct spectrum *s)
{
    double knee = survey_knee(s);
    for (int i = 0; i + 1 < s->n; i++) {
        double least = 1e-3 * spectrum_at(s, knee);
        if (s->k[i] >= knee && s->p[i] >= least && s->p[i + 1] < least)
            return s->k[i] * real_exp(real_log(s->k[i + 1] / s->k[i]) * real_log(least / s->p[i]) /
                                      real_log(s->p[i + 1] / s->p[i]));
    }
    return spectrum_top(s);
}

double survey_fit(const struct spectrum *s, double k, double *density)
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0, slope;
    for (int i = 0; i < s->n; i++)
        if (s->k[i] > 0.24 * k && s->k[i] < 1.01 * k) {
            double u = real_log(s->k[i] / k), v = real_log(s->p[i]);
            n++, x += u, y += v, xx += u * u, xy += u * v;
        }
    if (n < 3) return NAN;
    slope = (n * xy - x * y) / (n * xx - x * x);
    *density = real_exp((y - slope * x) / n);
    return slope;
}

/* ------------------------------------------------------------------ moments */

/* Sums over x and y counted from the middle are independent, so that the least-squares plane has each slope by itself.
 */
static void plane_of(const struct survey_grid *g, double *mean, double tilt[2])
{
    double middle[2] = {0.5 * (double)(g->columns - 1), 0.5 * (double)(g->rows - 1)}, square[2] = {0}, all = 0;
    tilt[0] = tilt[1] = 0;
    for (size_t j = 0; j < g->rows; j++)
        for (size_t i = 0; i < g->columns; i++) {
            double z = g->z[j * g->columns + i], x = (double)i - middle[0], y = (double)j - middle[1];
            all += z;
            tilt[0] += x * z, tilt[1] += y * z;
            square[0] += x * x, square[1] += y * y;
        }
    *mean = all / (double)(g->rows * g->columns);
    for (int k = 0; k < 2; k++)
        tilt[k] = square[k] > 0 ? tilt[k] / square[k] : 0;
}

struct survey_moments survey_heights(const struct survey_grid *g)
{
    double mean, tilt[2], sum[5] = {0}, n = (double)(g->rows * g->columns);
    plane_of(g, &mean, tilt);
    for (size_t j = 0; j < g->rows; j++)
        for (size_t i = 0; i < g->columns; i++) {
            double x = (double)i - 0.5 * (double)(g->columns - 1), y = (double)j - 0.5 * (double)(g->rows - 1);
            double z = g->z[j * g->columns + i] - mean - tilt[0] * x - tilt[1] * y;
            sum[2] += z * z / n, sum[3] += z * z * z / n, sum[4] += z * z * z * z / n;
        }
    return (struct survey_moments){sqrt(sum[2]), sum[3] / (sum[2] * sqrt(sum[2])), sum[4] / (sum[2] * sum[2])};
}
