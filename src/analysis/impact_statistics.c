/* Statistics of impacts, papers/002 section IV-E: mean, filter (arma.c), whitened series (whiteness.c), its
   distribution (distribution_fit.c), for amplitudes, after what modulates them was divided out (modulation.c), and for
   intervals T_(n+1) - T_n.

   95 % intervals, each checked over 200 seeds and more (evidence/impacts.md):
   - a1, b1: 1.96 errors to each side, kept within -1 and 1; where any a1 = b1 fits, all of -1 to 1.
   - deviation s of the white process: s exp(+- 1.96 e), e^2 = (kurtosis - 1)/(4 n).
   - mean: s/sqrt(sum U^2), which tends to s |1 + b1|/(|1 + a1| sqrt(n)); 1 + a1 is 0.03 for smooth rolling and known to
     a fifth of itself after 2000 impacts.
     So Student's t takes the place of 1.96, with 2/var(ln error^2) degrees of freedom (Satterthwaite, Biometrics Bull.
       2, 1946, 110), at least 3; the variance follows from
     the errors of a1, b1 and s. */
#include "analysis/impact_statistics.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <string.h>

#include "analysis/arma.h"
#include "analysis/distribution_fit.h"
#include "analysis/impact_warnings.h"
#include "analysis/modulation.h"
#include "analysis/whiteness.h"
#include "num/real.h"

#define NORMAL 1.959963984540054

enum { BOX_LAGS = 20 };

static struct estimate symmetric(double value, double error, double by)
{
    return (struct estimate){value, error, value - by * error, value + by * error};
}

static struct estimate of_filter(double value, double variance, bool cancelled)
{
    double error = fmin(sqrt(variance), 1);
    struct estimate e = symmetric(value, error, NORMAL);
    e.low = cancelled ? -1 : fmax(e.low, -1);
    e.high = cancelled ? 1 : fmin(e.high, 1);
    return e;
}

static struct estimate of_mean(const struct arma *f, int n, double kurtosis)
{
    const double *g = f->slope, *c = f->covariance;
    double spread =
        (kurtosis - 1) / n + (f->white ? 0 : g[0] * g[0] * c[0] + 2 * g[0] * g[1] * c[1] + g[1] * g[1] * c[2]);
    double freedom = fmax(3, fmin(2 / spread, 1e6));
    return symmetric(f->mean, sqrt(f->mean_variance), gsl_cdf_tdist_Pinv(0.975, freedom));
}

static struct estimate of_deviation(double deviation, int n, double kurtosis)
{
    double e = sqrt(fmax(kurtosis - 1, 0) / (4 * (double)n));
    return (struct estimate){deviation, deviation * e, deviation * real_exp(-NORMAL * e),
                             deviation * real_exp(NORMAL * e)};
}

static void series_flat(double value, struct arena *a, struct series_statistics *s)
{
    double none[2] = {value, value};
    s->flat = true;
    s->mean = symmetric(value, 0, 0);
    s->whiteness_p = 1;
    s->correlation[0] = s->white_correlation[0] = 1;
    distribution_fit(none, 2, a, &s->itself);
    s->white = s->itself;
}

/* x[n]; `grain`: how far values that are alike may be apart by rounding. white[n] gets them whitened. */
static void series_make(const double *x, int n, double grain, struct arena *a, struct series_statistics *s,
                        double *white)
{
    double least = x[0], most = x[0], variance = 0;
    struct arma f;
    for (int i = 0; i < n; i++) {
        least = fmin(least, x[i]);
        most = fmax(most, x[i]);
    }
    if (most - least <= grain + 1e-9 * fmax(fabs(least), fabs(most))) {
        series_flat(0.5 * (least + most), a, s);
        return;
    }
    arma_fit(x, n, &f);
    for (int i = 0; i < n; i++) {
        white[i] = x[i] - f.mean;
        variance += white[i] * white[i] / n;
    }
    arma_whiten(white, n, f.a1, f.b1, white);
    distribution_fit(x, n, a, &s->itself);
    distribution_fit(white, n, a, &s->white);
    s->variance = variance;
    s->mean = of_mean(&f, n, s->white.kurtosis);
    s->deviation = of_deviation(f.deviation, n, s->white.kurtosis);
    s->a1 = of_filter(f.a1, f.covariance[0], f.white);
    s->b1 = of_filter(f.b1, f.covariance[2], f.white);
    s->ridge = f.white || !(fabs(f.a1 - f.b1) > 2 * sqrt(f.covariance[0] - 2 * f.covariance[1] + f.covariance[2]));
    s->iterations = f.iterations;
    whiteness_correlation(x, n, STATISTICS_LAGS, s->correlation);
    whiteness_correlation(white, n, STATISTICS_LAGS, s->white_correlation);
    s->whiteness = whiteness_box(s->white_correlation, n, BOX_LAGS, f.white ? 0 : 2, &s->whiteness_p);
}

static bool both_signs(const struct impact_events *v)
{
    int below = 0;
    for (int i = 0; i < v->n; i++)
        below += v->amplitude[i] < 0;
    return fmin(below, v->n - below) > 0.1 * v->n;
}

static void demodulate(const struct impact_events *v, bool wanted, struct arena *a, struct impact_statistics *s)
{
    struct modulation m;
    memcpy(s->demodulated, v->amplitude, v->n * sizeof *v->amplitude);
    s->modulation.probability = 1;
    if (!wanted || both_signs(v)) return;
    modulation_find(v->time, v->amplitude, v->n, a, &m);
    s->modulation =
        (struct impact_modulation){m.depth, m.rate, m.depth_error, m.rate_error, m.probability, m.found, true};
    if (m.found) modulation_divide(&m, v->time, v->amplitude, v->n, s->demodulated);
}

static bool check(const struct impact_events *v, struct err *e)
{
    if (v->n < STATISTICS_LEAST)
        return err_set(
            e, ERR_SCENE,
            "%d impacts are too few for statistics: at least %d are needed, and 2000 for errors worth having", v->n,
            STATISTICS_LEAST);
    for (int i = 0; i < v->n; i++) {
        if (!isfinite(v->time[i]) || !isfinite(v->amplitude[i]))
            return err_set(e, ERR_SCENE, "impact %d: its time or amplitude is not a number", i + 1);
        if (i && !(v->time[i] > v->time[i - 1]))
            return err_set(e, ERR_SCENE,
                           "impact %d, at %.9g s, is not after the one before, at %.9g s: times have to rise", i + 1,
                           v->time[i], v->time[i - 1]);
    }
    return true;
}

bool impact_statistics_make(const struct impact_events *v, bool demodulate_them, struct arena *a,
                            struct impact_statistics *s, struct err *e)
{
    memset(s, 0, sizeof *s);
    if (!check(v, e)) return false;
    int n = v->n;
    double *interval = ARENA_TAKE(a, double, n), grain = impact_events_grain(v);
    s->n = n;
    s->demodulated = ARENA_TAKE(a, double, n);
    for (int i = 0; i < STATISTICS_SERIES; i++)
        s->white[i] = ARENA_TAKE(a, double, n);
    for (int i = 0; i + 1 < n; i++)
        interval[i] = v->time[i + 1] - v->time[i];
    demodulate(v, demodulate_them, a, s);
    struct series_statistics *both = s->series;
    series_make(s->demodulated, n, 0, a, &both[STATISTICS_AMPLITUDE], s->white[STATISTICS_AMPLITUDE]);
    series_make(interval, n - 1, grain, a, &both[STATISTICS_INTERVAL], s->white[STATISTICS_INTERVAL]);
    whiteness_cross(s->demodulated, interval, n - 1, STATISTICS_LAGS, s->cross);
    whiteness_cross(s->white[0], s->white[1], n - 1, STATISTICS_LAGS, s->white_cross);
    s->one_process = whiteness_ranks(s->white[0], s->white[1], n - 1, a);
    impact_warnings(v, interval, a, s);
    return true;
}
