/* Statistics of impacts, papers/002 section IV-E: mean, filter (arma.c), whitened series (whiteness.c), its
   distribution (distribution_fit.c), for amplitudes, after what modulates them was divided out (modulation.c), and for
   intervals T_(n+1) - T_n.

   95 % intervals, each checked over 200 seeds and more (evidence/impacts.md):
   - a1, b1: 1.96 errors to each side, kept within -1 and 1; where any a1 = b1 fits, all of -1 to 1.
   - deviation s of the white process: s exp(+- 1.96 e), e^2 = (kurtosis - 1)/(4 n).
   - mean: s/sqrt(sum U^2), which tends to s |1 + b1|/(|1 + a1| sqrt(n)); 1 + a1 is 0.03 for smooth rolling and known to
     a fifth of itself after 2000 impacts.
     So Student's t takes the place of 1.96, with 2/var(ln error^2) degrees of freedom (Satterthwaite, Biometrics Bull.
     2, 1946, 110), at least 3; the variance follows from the errors of a1, b1 and s. */
#include "analysis/impact_statistics.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <string.h>

#include "analysis/arma.h"
#include "analysis/distribution_fit.h"
#include "analysis/modulation.h"
#include "analysis/whiteness.h"
#include "force/impact_series.h"
#include "num/real.h"

/* ------------------------------------------------------------------ warnings */

/* Warnings of `rasp analyse`, what biases the statistics: each says what was seen, what it does to the estimates, and
 * where there is a remedy, which. */
#define CHANCE 1e-6
#define GRAIN 1e-6 /* of the distance between the quartiles: values so near are alike */

enum { FEW = 500, KURTOSIS_MOST = 5, NEAR = 20 };

static const char *const names[STATISTICS_SERIES] = {"amplitudes", "intervals"};
static const char *const keys[STATISTICS_SERIES] = {"amplitude", "interval"};

struct list {
    struct impact_statistics *s;
    struct arena *a;
    int count;
};

#define WARN(l, ...) ((l)->s->warnings[(l)->count++] = arena_format((l)->a, __VA_ARGS__))

/* How far amplitudes at a floor come apart to each side, as a share of it, where a modulation was divided out that was
   not quite theirs: one error of m sin(2 pi nu t + phi), of which the phase's is about m's over m, and the rate's
   counts most at both ends. */
static double divided(const struct impact_modulation *m, double span)
{
    double depth = m->depth, sway = REAL_PI * m->rate_error * span * depth,
           error = sqrt(2 * m->depth_error * m->depth_error + sway * sway);
    if (!m->found) return 0;
    return isfinite(error) && depth < 1 ? fmin(error / (1 - depth), 0.1) : 0.1;
}

/* How many of x[n], which rise, are the least one, alike within `reach`; 0: no more than by chance, judged by how close
 * the next ones lie, or than are the next. */
static int piled(const double *x, int n, double reach)
{
    int least = 0, next = 0;
    while (least < n && x[least] <= x[0] + reach)
        least++;
    while (least + next < n && x[least + next] <= x[least] + reach)
        next++;
    int beyond = (int)fmin(fmax(least, NEAR), n - 1 - least);
    if (least < 3 || least < 3 * next || beyond < 1) return 0;
    return gsl_cdf_poisson_Q(least - 2, reach * beyond / (x[least + beyond] - x[least])) < CHANCE ? least : 0;
}

/* Draws raised to a floor are all equal. apart: how far equal ones may be apart otherwise, to each side: as a share of
   them, and in themselves; where a modulation was divided out, twice and three times as much is tried too. */
static void floors(struct list *l, int which, const double *series, int n, const double grain[2])
{
    double *x = ARENA_TAKE(l->a, double, n);
    memcpy(x, series, n * sizeof *x);
    gsl_sort(x, 1, n);
    int least = 0, tries = which == STATISTICS_AMPLITUDE && l->s->modulation.found ? 3 : 1;
    for (int k = 1; k <= tries; k++)
        least = (int)fmax(least,
                          piled(x, n, 2 * k * (grain[0] * fabs(x[0]) + grain[1]) + GRAIN * (x[3 * n / 4] - x[n / 4])));
    if (least)
        WARN(l,
             "%.3g %% of the %s are the smallest one, %s%.4g: raised to a floor, as draws below one are%s. What lay "
             "below a floor is lost: the mean comes out too high, the deviation and a1's memory wrong",
             100.0 * least / n, names[which], grain[0] > 0 ? "about " : "", x[least / 2],
             which == STATISTICS_INTERVAL ? " (or drawn alike, as a rub's are)" : "");
}

static void filters(struct list *l, int which)
{
    const struct series_statistics *s = &l->s->series[which];
    bool white = s->a1.value == 0 && s->b1.value == 0;
    if (s->flat) return;
    if (s->ridge && white)
        WARN(l,
             "%s: white as they are. Any a1 = b1 would do, as a pole and a zero at one place cancel; both are set to 0",
             names[which]);
    else if (s->ridge)
        WARN(l,
             "%s: a1 = %.3f lies within 2 errors of b1 = %.3f. A pole and a zero at one place cancel, so neither is "
             "known well by itself",
             names[which], s->a1.value, s->b1.value);
    if (fabs(s->a1.value) + s->a1.error >= 1 && fabs(s->a1.value) > 0.5 && !white)
        WARN(l,
             "%s: a1 = %.4f is not told from %d: they drift, or there are too few of them; the mean and its error mean "
             "little",
             names[which], s->a1.value, s->a1.value < 0 ? -1 : 1);
    if (s->whiteness_p < 0.001)
        WARN(l,
             "%s: not white after one pole and one zero (Q = %.0f over 20 lags, probability %.1g): the model does not "
             "hold, and neither do its errors",
             names[which], s->whiteness, s->whiteness_p);
    if (distribution_fit_polygon_needed(s->white.gaussian_distance, l->s->n - 1))
        WARN(l,
             "%s: the white process is not Gaussian (distance %.2f, skewness %.2f, kurtosis %.1f where a Gaussian has "
             "0 and 3): a table is nearer (contact.impacts.%s.distribution)",
             names[which], s->white.gaussian_distance, s->white.skewness, s->white.kurtosis, keys[which]);
    else if (s->white.kurtosis > KURTOSIS_MOST)
        WARN(l,
             "%s: the white process has outliers (kurtosis %.1f where a Gaussian has 3), as impacts that merged or "
             "were missed make them: its deviation comes out too large",
             names[which], s->white.kurtosis);
}

/* An impact that begins before the one before is over cannot always be told from it. */
static void merged(struct list *l, const struct impact_events *v)
{
    int known = 0, over = 0;
    double grain = impact_events_grain(v);
    for (int i = 0; i + 1 < v->n; i++)
        if (isfinite(v->duration[i]) && isfinite(v->duration[i + 1])) {
            known++;
            over += impact_series_overlap(v->time[i + 1] - v->time[i], v->duration[i], v->duration[i + 1], grain);
        }
    if (known && over > 0.005 * known)
        WARN(l,
             "%.3g %% of the impacts begin before the one before is over: in a force such impacts merge, so that short "
             "intervals are missed (their mean comes out too long) and amplitudes add%s",
             100.0 * over / known,
             v->blur[0] > 0
                 ? ". Weak impacts close together merge first: whether draws were raised to a floor cannot be told here"
                 : "");
}

static void modulated(struct list *l)
{
    const struct impact_modulation *m = &l->s->modulation;
    if (m->found)
        WARN(l,
             "amplitudes are modulated, m = %.3f at %.4g Hz, and were divided by it: durations follow from the "
             "modulated ones. What is left is biased by the errors of m and the rate, and where draws were "
             "raised to a floor by that: the mean is too high, the deviation too small",
             m->depth, m->rate);
}

/* From STATISTICS_ONE_PROCESS on a scene takes one process, which ties amplitudes and intervals wholly. */
static void processes(struct list *l)
{
    double r = l->s->one_process;
    if (r < STATISTICS_ONE_PROCESS)
        WARN(l,
             "amplitudes and intervals are not driven by one process (correlation of ranks %.2f): "
             "contact.impacts.processes: two draws them apart",
             r);
    else if (r < 0.9)
        WARN(l,
             "amplitudes and intervals are driven by one process only in part (correlation of ranks %.2f, where one "
             "makes it 1 and two make it 0): contact.impacts.processes: one is nearer",
             r);
}

/* s->warnings from the rest of s; interval[n - 1]. */
static void impact_warnings(const struct impact_events *v, const double *interval, struct arena *a,
                            struct impact_statistics *s)
{
    struct list l = {s, a, 0};
    if (s->n < FEW) WARN(&l, "only %d impacts: intervals of confidence hold from about %d on", s->n, FEW);
    modulated(&l);
    if (!s->series[STATISTICS_AMPLITUDE].flat)
        floors(&l, STATISTICS_AMPLITUDE, s->demodulated, s->n,
               (const double[2]){v->blur[0] + divided(&s->modulation, v->time[s->n - 1] - v->time[0]), 0});
    if (!s->series[STATISTICS_INTERVAL].flat)
        floors(&l, STATISTICS_INTERVAL, interval, s->n - 1, (const double[2]){0, v->blur[1] + impact_events_grain(v)});
    merged(&l, v);
    for (int i = 0; i < STATISTICS_SERIES; i++)
        filters(&l, i);
    processes(&l);
    s->warnings[l.count] = NULL;
}

/* ------------------------------------------------------------------ statistics */

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
