/* Which distribution do values have?

   Gaussian: as papers/002 figure 9, a histogram's density is fitted with a Gaussian one by least squares (its mean over
   each bin; mean and deviation by Gauss and Newton), gaussian_r2 = 1 - (squares left)/(squares about the mean bin).
   Bins are 3.49 s n^(-1/3) wide (Scott, Biometrika 66, 1979, 605), at least LEAST and at most MOST of them.
   Kolmogorov's distance, the greatest between the two cumulative distributions, is to the Gaussian of the values' own
   mean and deviation.

   Exponential and gamma: as Lagrange, Scavone and Depalle have amplitudes and intervals, by greatest likelihood: the
   mean of the values above 0; ln k - psi(k) = ln(mean) - mean(ln), scale mean/k. Above a shape of LARGE the gamma
   distribution is taken by Wilson and Hilferty's cube root, which is off by 1e-6 at most there, as GSL's series do not
   converge for all. */
#include "analysis/distribution_fit.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <gsl/gsl_sf_psi.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <string.h>

#include "num/real.h"

#define LARGE 1e5

enum { LEAST = 8, MOST = 200, STEPS = 100 };

struct histogram {
    double from, width, density[MOST]; /* of values less their mean over their deviation */
    int bins;
};

static void histogram_make(const double *sorted, int n, double mean, double deviation, struct histogram *h)
{
    double span = (sorted[n - 1] - sorted[0]) / deviation, bins = ceil(span / (3.49 / real_pow(n, 1 / 3.0)));
    h->bins = (int)fmax(LEAST, fmin(bins, MOST));
    h->width = span / h->bins;
    h->from = (sorted[0] - mean) / deviation;
    for (int i = 0; i < n; i++) {
        int bin = (int)(((sorted[i] - mean) / deviation - h->from) / h->width);
        h->density[bin < h->bins ? bin : h->bins - 1] += 1 / (n * h->width);
    }
}

static int histogram_residuals(const gsl_vector *at, void *context, gsl_vector *out)
{
    const struct histogram *h = context;
    double mean = gsl_vector_get(at, 0), deviation = real_exp(gsl_vector_get(at, 1)),
           below = gsl_cdf_ugaussian_P((h->from - mean) / deviation);
    for (int i = 0; i < h->bins; i++) {
        double next = gsl_cdf_ugaussian_P((h->from + (i + 1) * h->width - mean) / deviation);
        gsl_vector_set(out, i, h->density[i] - (next - below) / h->width);
        below = next;
    }
    return GSL_SUCCESS;
}

static double histogram_r2(struct histogram *h)
{
    gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
    gsl_multifit_nlinear_workspace *w = gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, h->bins, 2);
    gsl_multifit_nlinear_fdf problem = {.f = histogram_residuals, .n = h->bins, .p = 2, .params = h};
    double begin[2] = {0, 0}, left = 0, all = 0, mean = 0;
    gsl_vector_view start = gsl_vector_view_array(begin, 2);
    int why;
    gsl_multifit_nlinear_init(&start.vector, &problem, w);
    gsl_multifit_nlinear_driver(STEPS, 1e-8, 1e-10, 0, NULL, NULL, &why, w);
    for (int i = 0; i < h->bins; i++)
        mean += h->density[i] / h->bins;
    for (int i = 0; i < h->bins; i++) {
        double r = gsl_vector_get(gsl_multifit_nlinear_residual(w), i);
        left += r * r;
        all += (h->density[i] - mean) * (h->density[i] - mean);
    }
    gsl_multifit_nlinear_free(w);
    return (all > 0) ? 1 - left / all : 0;
}

enum shape { GAUSSIAN, EXPONENTIAL, GAMMA };

struct law {
    enum shape shape;
    double a, b; /* mean, deviation; mean, -; shape, scale */
};

static double law_below(const struct law *l, double x)
{
    if (l->shape == GAUSSIAN) return gsl_cdf_ugaussian_P((x - l->a) / l->b);
    if (l->shape == EXPONENTIAL) return 1 - real_exp(-x / l->a);
    if (l->a <= LARGE) return gsl_cdf_gamma_P(x, l->a, l->b);
    return gsl_cdf_ugaussian_P((real_pow(x / (l->a * l->b), 1 / 3.0) - 1 + 1 / (9 * l->a)) * 3 * sqrt(l->a));
}

/* Kolmogorov's. */
static double distance(const double *sorted, int n, struct law l)
{
    double most = 0;
    for (int i = 0; i < n; i++) {
        double p = law_below(&l, sorted[i]);
        most = fmax(most, fmax(p - (double)i / n, (i + 1.0) / n - p));
    }
    return most;
}

static void exponential_fit(const double *sorted, int n, struct distribution_fits *f)
{
    int above = 0;
    double sum = 0;
    for (; above < n && sorted[n - 1 - above] > 0; above++)
        sum += sorted[n - 1 - above];
    if (above < LEAST) return;
    f->exponential_mean = sum / above;
    f->exponential_distance = distance(sorted + n - above, above, (struct law){EXPONENTIAL, f->exponential_mean, 0});
}

/* k of ln k - psi(k) = s, from Minka's first guess by Newton's steps. */
static double gamma_shape(double s)
{
    double k = (3 - s + sqrt((s - 3) * (s - 3) + 24 * s)) / (12 * s);
    for (int i = 0; i < STEPS; i++) {
        double step = (real_log(k) - gsl_sf_psi(k) - s) / (1 / k - gsl_sf_psi_1(k));
        k = fmax(k - step, k / 2);
        if (!(fabs(step) > 1e-12 * k)) break;
    }
    return k;
}

static void gamma_fit(const double *sorted, int n, double mean, struct distribution_fits *f)
{
    double logarithm = 0;
    if (!(sorted[0] > 0)) return;
    for (int i = 0; i < n; i++)
        logarithm += (real_log(sorted[i]) - real_log(mean)) / n;
    if (!(logarithm < -1e-12)) /* the values differ by a part of 1e-6: a shape of 1e12 or more */
        return;
    f->gamma_shape = gamma_shape(-logarithm);
    f->gamma_scale = mean / f->gamma_shape;
    f->gamma_distance = distance(sorted, n, (struct law){GAMMA, f->gamma_shape, f->gamma_scale});
}

void distribution_fit(const double *x, int n, struct arena *a, struct distribution_fits *f)
{
    double *sorted = ARENA_TAKE(a, double, n), mean = 0, power[3] = {0},
           unit; /* moments in the values' own unit: no power overflows */
    struct histogram h = {0};
    *f = (struct distribution_fits){NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    memcpy(sorted, x, n * sizeof *x);
    gsl_sort(sorted, 1, n);
    if (!(sorted[n - 1] > sorted[0])) return;
    for (int i = 0; i < n; i++)
        mean += sorted[i] / n;
    unit = sorted[n - 1] - sorted[0];
    for (int i = 0; i < n; i++) {
        double y = (sorted[i] - mean) / unit;
        power[0] += y * y / n;
        power[1] += y * y * y / n;
        power[2] += y * y * y * y / n;
    }
    f->skewness = power[1] / (power[0] * sqrt(power[0]));
    f->kurtosis = power[2] / (power[0] * power[0]);
    histogram_make(sorted, n, mean, sqrt(power[0]) * unit, &h);
    f->gaussian_r2 = histogram_r2(&h);
    f->gaussian_distance = distance(sorted, n, (struct law){GAUSSIAN, mean, sqrt(power[0]) * unit});
    exponential_fit(sorted, n, f);
    gamma_fit(sorted, n, mean, f);
}

/* ------------------------------------------------------------------ frequency polygon */

/* The frequency polygon (D. W. Scott, "Frequency polygons: theory and application", JASA 80, 1985): a histogram's
   heights, joined by straight lines at the middles of its bins. Bins are as wide as Freedman and Diaconis have it, 2
   IQR n^(-1/3), at least 8 and at most 200 of them. A polygon is wider than the sample by about a bin's width; its
   values are moved and scaled so that the mean is 0 and the deviation that asked for. */
enum { BINS_LEAST = 8, BINS_MOST = 200 };

bool distribution_fit_polygon_needed(double distance, int n) { return distance > fmax(1.031 / sqrt(n), 0.02); }

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

void distribution_fit_polygon(const double *x, int n, double deviation, struct arena *a, struct frequency_polygon *t)
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
