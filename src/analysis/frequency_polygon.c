/* The frequency polygon (D. W. Scott, "Frequency polygons: theory and application", JASA 80, 1985): a histogram's
   heights, joined by straight lines at the middles of its bins. Bins are as wide as Freedman and Diaconis have it, 2
   IQR n^(-1/3), at least 8 and at most 200 of them. A polygon is wider than the sample by about a bin's width; its
   values are moved and scaled so that the mean is 0 and the deviation that asked for. */
#include "analysis/frequency_polygon.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <string.h>

#include "num/real.h"

enum { BINS_LEAST = 8, BINS_MOST = 200 };

bool frequency_polygon_needed(double distance, int n) { return distance > fmax(1.031 / sqrt(n), 0.02); }

static int bins_for(const double *sorted, int n)
{
    double quarters = gsl_stats_quantile_from_sorted_data(sorted, 1, (size_t)n, 0.75) -
                      gsl_stats_quantile_from_sorted_data(sorted, 1, (size_t)n, 0.25);
    double width = 2 * quarters * real_pow(n, -1.0 / 3), range = sorted[n - 1] - sorted[0];
    return width > 0 ? (int)fmin(fmax(ceil(range / width), BINS_LEAST), BINS_MOST) : BINS_MOST;
}

/* Integral, mean and variance of what is straight between the rows. */
static void polygon_moments(const struct frequency_polygon *t, double m[3])
{
    m[0] = m[1] = m[2] = 0;
    for (int i = 0; i + 1 < t->n; i++) {
        double h = t->value[i + 1] - t->value[i], a = t->density[i], b = t->density[i + 1], x = t->value[i];
        double area = h * (a + b) / 2, first = h * h * (a + 2 * b) / 6,
               second = h * h * h * (a + 3 * b) / 12; /* about x */
        m[0] += area;
        m[1] += x * area + first;
        m[2] += x * x * area + 2 * x * first + second;
    }
    m[1] /= m[0];
    m[2] = m[2] / m[0] - m[1] * m[1];
}

void frequency_polygon_make(const double *x, int n, double deviation, struct arena *a, struct frequency_polygon *t)
{
    double *sorted = ARENA_TAKE(a, double, n), m[3];
    memcpy(sorted, x, (size_t)n * sizeof *x);
    gsl_sort(sorted, 1, (size_t)n);
    int bins = bins_for(sorted, n);
    double width = (sorted[n - 1] - sorted[0]) / bins;
    *t = (struct frequency_polygon){bins + 2, ARENA_TAKE(a, double, bins + 2), ARENA_TAKE(a, double, bins + 2)};
    for (int i = 0; i < t->n; i++)
        t->value[i] = sorted[0] + (i - 0.5) * width;
    for (int i = 0; i < n; i++)
        t->density[1 + (int)fmin((sorted[i] - sorted[0]) / width, bins - 1)]++;
    polygon_moments(t, m);
    double scale = deviation / sqrt(m[2]);
    for (int i = 0; i < t->n; i++) {
        t->value[i] = (t->value[i] - m[1]) * scale;
        t->density[i] /= m[0] * scale;
    }
}
