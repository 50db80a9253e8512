/* See surface_heights.h. Sums go row by row, then over the rows. Rounding to a step q is noise of variance q^2/12 at
   each sample; the second difference (1, -2, 1) has 6 times the variance, over pitch^2. The spline through such samples
   has at its knots 2.45 times the second difference's noise. */
#include "analysis/surface_heights.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

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
