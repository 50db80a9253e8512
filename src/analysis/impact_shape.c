/* Shapes, with t in samples:

     raised cosine    G (1 + cos(2 pi (t - at)/D))/2,   |t - at| <= D/2
     Meixner window   G w(t - at),   w(n) = sqrt((1 - xi^2)^b Gamma(n + b)/(Gamma(b) n!)) xi^n

   The window is the Meixner function of order 0, as parametric audio coders use it for transients (E. Schuijers, W.
   Oomen, B. den Brinker, J. Breebaart, "Advances in parametric coding for high-quality audio", 114th AES Convention,
   2003: reference 39 of papers/002; ISO/IEC 14496-3, subpart 8, computes it as w(0) = (1 - xi^2)^(b/2), w(n + 1) = w(n)
   xi sqrt((n + b)/(n + 1))); Lagrange, Scavone and Depalle took it for impacts. There n counts samples from the onset;
   here the onset need not fall on a sample, and n! is Gamma(n + 1), so that w begins at n = -1, where it is 0. w^2 is a
   negative binomial distribution, of mean m = b xi^2/(1 - xi^2) and variance m/(1 - xi^2): it cannot be narrower than
   Poisson's, to which it tends for large b and small xi (what is symmetric is fitted there; 1 - xi^2 <= 1 - 3e-7), and
   how well it fits depends on the sample rate.

   Least squares by Nelder and Mead's simplex (GSL) over (at, log D) or (at, log m, log((1 - xi^2)/xi^2)), begun again
   at its result once; the gain, which is linear, is solved for. R^2 = 1 - sum of squared errors / sum of squares about
   the mean, over the samples from where the force has risen to `quiet` to where it has fallen to it, and one more on
   each side. */
#include "analysis/impact_shape.h"

#include <gsl/gsl_multimin.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>

#include "num/filter.h"
#include "num/real.h"
#include "num/vecmath.h"

enum { PARAMETERS = 3, ROUNDS = 2, STEPS = 400 };

struct problem {
    const double *y;
    double *w; /* [n] the shape without its gain */
    int n;
    enum impact_shape_kind kind;
    double total;    /* sum of squares about the mean */
    double gain, r2; /* of the last shape             */
};

/* ------------------------------------------------------------------ shapes */

static void cosine_shape(double *w, int n, double at, double duration)
{
    for (int i = 0; i < n; i++) {
        double q = (i - at) / duration;
        w[i] = fabs(q) < 0.5 ? 0.5 * (1 + real_cospi(2 * q)) : 0;
    }
}

/* Scaled to a greatest value of 1; by logarithms, since w spans many powers of ten. */
static void meixner_shape(double *w, int n, double at, const double b_xi[2])
{
    int first = (int)fmin(fmax(floor(at - 1) + 1, 0), n);
    double b = b_xi[0], step = real_log(b_xi[1]), top = -HUGE_VAL, sum = 0;
    for (int i = 0; i < first; i++)
        w[i] = 0;
    for (int i = first; i < n; i++) {
        double k = i - at; /* > -1 */
        w[i] = fmax(k + b, 1e-300) / (k + 1);
    }
    vecmath_log((size_t)(n - first), w + first, w + first);
    for (int i = first; i < n; i++) {
        double next = sum + step + 0.5 * w[i];
        w[i] = sum; /* from first on; k + 1 may be tiny there: w is 0 at k = -1 */
        top = fmax(top, sum);
        sum = next;
    }
    for (int i = first; i < n; i++)
        w[i] -= top;
    vecmath_exp((size_t)(n - first), w + first, w + first);
}

static void shape_of(const struct problem *p, const gsl_vector *x)
{
    double at = gsl_vector_get(x, 0), first = real_exp(gsl_vector_get(x, 1));
    if (p->kind == IMPACT_SHAPE_COSINE)
        cosine_shape(p->w, p->n, at, first);
    else {
        double odds = real_exp(gsl_vector_get(x, 2)); /* (1 - xi^2)/xi^2 */
        meixner_shape(p->w, p->n, at, (const double[2]){first * odds, sqrt(1 / (1 + odds))});
    }
}

/* 1 - R^2, finite. */
static double misfit(const gsl_vector *x, void *self)
{
    struct problem *p = self;
    double yw = 0, ww = 0, errors = 0;
    for (size_t k = 0; k < x->size; k++)
        if (!(fabs(gsl_vector_get(x, k)) < (double[]){1e9, 40, 15}[k])) return 1e9;
    shape_of(p, x);
    for (int i = 0; i < p->n; i++) {
        yw += p->y[i] * p->w[i];
        ww += p->w[i] * p->w[i];
    }
    p->gain = ww > 0 ? yw / ww : 0;
    for (int i = 0; i < p->n; i++) {
        double e = p->y[i] - p->gain * p->w[i];
        errors += e * e;
    }
    p->r2 = 1 - errors / p->total;
    return isfinite(p->r2) ? 1 - p->r2 : 1e9;
}

/* ------------------------------------------------------------------ fit */

void impact_shape_guess(const double *y, int n, enum impact_shape_kind kind, struct impact_shape_fit *fit)
{
    double sum = 0, mean = 0, variance = 0;
    for (int i = 0; i < n; i++) {
        sum += y[i] * y[i];
        mean += i * y[i] * y[i];
    }
    mean = sum > 0 ? mean / sum : 0.5 * n;
    for (int i = 0; i < n; i++)
        variance += (i - mean) * (i - mean) * y[i] * y[i];
    variance = sum > 0 ? fmax(variance / sum, 0.1) : n;
    double width = sqrt(variance); /* of a raised cosine squared, cos^4: 0.1414 D */
    *fit = (struct impact_shape_fit){.at = mean, .duration = width / 0.141};
    if (kind == IMPACT_SHAPE_MEIXNER) {
        double m = fmax(0.7 * variance, fmin(mean, 3 * width));
        double rest = fmin(fmax(m / variance, 1e-4), 0.9); /* 1 - xi^2 */
        fit->at = mean - m;
        fit->xi = sqrt(1 - rest);
        fit->b = m * rest / (1 - rest);
    }
}

static void vector_from(const struct impact_shape_fit *fit, enum impact_shape_kind kind, gsl_vector *x,
                        gsl_vector *step)
{
    double square = fit->xi * fit->xi, odds = (1 - square) / square, m = fit->b / odds;
    bool cosine = kind == IMPACT_SHAPE_COSINE;
    gsl_vector_set(x, 0, fit->at);
    gsl_vector_set(x, 1, real_log(cosine ? fit->duration : m));
    gsl_vector_set(step, 0, fmax(0.2, 0.05 * (cosine ? fit->duration : 3 * sqrt(m / (1 - square)))));
    gsl_vector_set(step, 1, cosine ? 0.1 : 0.3);
    if (!cosine) {
        gsl_vector_set(x, 2, real_log(odds));
        gsl_vector_set(step, 2, 0.5);
    }
}

static void fit_from(const struct problem *p, const gsl_vector *x, struct impact_shape_fit *fit)
{
    double first = real_exp(gsl_vector_get(x, 1));
    fit->at = gsl_vector_get(x, 0);
    fit->gain = p->gain;
    fit->r2 = p->r2;
    if (p->kind == IMPACT_SHAPE_COSINE)
        fit->duration = first;
    else {
        double odds = real_exp(gsl_vector_get(x, 2));
        fit->xi = sqrt(1 / (1 + odds));
        fit->b = first * odds;
    }
}

static void simplex_run(struct problem *p, gsl_vector *x, gsl_vector *step)
{
    gsl_multimin_fminimizer *m = gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, x->size);
    gsl_multimin_function f = {misfit, x->size, p};
    gsl_multimin_fminimizer_set(m, &f, x, step);
    for (int i = 0; i < STEPS && gsl_multimin_fminimizer_iterate(m) == 0 && gsl_multimin_fminimizer_size(m) > 1e-7; i++)
        continue;
    gsl_vector_memcpy(x, m->x);
    gsl_multimin_fminimizer_free(m);
}

void impact_shape_fit(const double *y, int n, enum impact_shape_kind kind, struct impact_shape_fit *fit, double *model)
{
    gsl_vector *w = gsl_vector_alloc((size_t)n);
    struct problem p = {.y = y, .w = w->data, .n = n, .kind = kind};
    double values[PARAMETERS], steps[PARAMETERS], mean = 0;
    size_t parameters = kind == IMPACT_SHAPE_COSINE ? 2 : 3;
    gsl_vector_view x = gsl_vector_view_array(values, parameters), step = gsl_vector_view_array(steps, parameters);
    for (int i = 0; i < n; i++)
        mean += y[i] / n;
    for (int i = 0; i < n; i++)
        p.total += (y[i] - mean) * (y[i] - mean);
    for (int round = 0; round < ROUNDS; round++) {
        vector_from(fit, kind, &x.vector, &step.vector);
        simplex_run(&p, &x.vector, &step.vector);
        misfit(&x.vector, &p);
        fit_from(&p, &x.vector, fit);
    }
    for (int i = 0; model && i < n; i++)
        model[i] = p.gain * p.w[i];
    gsl_vector_free(w);
}

/* ------------------------------------------------------------------ all impacts */

struct ratios {
    double *r2[IMPACT_SHAPE_KINDS], *b, *xi, *stretch;
};

static int samples_of(const struct impact_signal *s, const struct impact_found *f, long k, long *first)
{
    long from = (long)fmax(floor(f->from[k]) - 1, 0), to = (long)fmin(ceil(f->to[k]) + 1, (double)s->n - 1);
    *first = from;
    return (int)(to - from + 1);
}

static void fit_one(const struct impact_signal *s, const struct impact_found *f, long k, struct ratios *r, long number)
{
    long first;
    int n = samples_of(s, f, k, &first);
    for (int kind = 0; kind < IMPACT_SHAPE_KINDS; kind++) {
        struct impact_shape_fit fit;
        impact_shape_guess(s->force + first, n, (enum impact_shape_kind)kind, &fit);
        impact_shape_fit(s->force + first, n, (enum impact_shape_kind)kind, &fit, NULL);
        r->r2[kind][number] = fit.r2;
        if (kind == IMPACT_SHAPE_COSINE)
            r->stretch[number] = fit.duration / (f->events.duration[k] * s->rate);
        else {
            r->b[number] = fit.b;
            r->xi[number] = fit.xi;
        }
    }
}

static void mean_add(const struct impact_signal *s, const struct filter_between *b, const struct impact_found *f,
                     long k, struct impact_shape *h)
{
    const struct impact_events *v = &f->events;
    for (int j = 0; j < IMPACT_SHAPE_POINTS; j++) {
        double at = (v->time[k] - s->start + h->q[j] * v->duration[k]) * s->rate;
        double y = filter_between_at(b, s->force, s->n, (long)rint(at * BETWEEN_PHASES)) / v->amplitude[k];
        h->mean[j] += y;
        h->deviation[j] += y * y;
    }
}

static void mean_end(struct impact_shape *h)
{
    double n = (double)h->fitted;
    for (int j = 0; j < IMPACT_SHAPE_POINTS; j++) {
        h->mean[j] /= n;
        h->deviation[j] = sqrt(fmax(h->deviation[j] / n - h->mean[j] * h->mean[j], 0));
    }
    for (int kind = 0; kind < IMPACT_SHAPE_KINDS; kind++) {
        impact_shape_guess(h->mean, IMPACT_SHAPE_POINTS, (enum impact_shape_kind)kind, &h->of_mean[kind]);
        impact_shape_fit(h->mean, IMPACT_SHAPE_POINTS, (enum impact_shape_kind)kind, &h->of_mean[kind], h->model[kind]);
    }
}

static double median(double *x, long n)
{
    gsl_sort(x, 1, (size_t)n);
    return gsl_stats_median_from_sorted_data(x, 1, (size_t)n);
}

static void ratios_end(struct ratios *r, struct impact_shape *h)
{
    static const double shares[3] = {0.05, 0.5, 0.95};
    for (int kind = 0; kind < IMPACT_SHAPE_KINDS; kind++) {
        gsl_sort(r->r2[kind], 1, (size_t)h->fitted);
        for (int j = 0; j < 3; j++)
            h->r2[kind][j] = gsl_stats_quantile_from_sorted_data(r->r2[kind], 1, (size_t)h->fitted, shares[j]);
    }
    h->b = median(r->b, h->fitted);
    h->xi = median(r->xi, h->fitted);
    h->stretch = median(r->stretch, h->fitted);
}

/* Those that can be fitted; their number is returned. */
static long fit_list(const struct impact_signal *s, const struct impact_found *f, long *list, struct impact_shape *h)
{
    long n = 0, first;
    for (long k = 0; k < f->events.n; k++) {
        if (!f->events.alone[k]) continue;
        int samples = samples_of(s, f, k, &first);
        if (samples < IMPACT_SHAPE_LEAST)
            h->brief++;
        else if (samples > IMPACT_SHAPE_LONGEST) /* a contact that does not part, rather than an impact */
            h->lengthy++;
        else
            list[n++] = k;
    }
    return n;
}

void impact_shape_make(const struct impact_signal *s, const struct impact_found *f, struct arena *a,
                       struct impact_shape *h)
{
    long *list = ARENA_TAKE(a, long, f->events.n);
    struct ratios r;
    struct filter_between b = filter_between_make(a);
    *h = (struct impact_shape){.fitted = 0};
    long n = fit_list(s, f, list, h);
    h->fitted = n < IMPACT_SHAPE_MOST ? n : IMPACT_SHAPE_MOST;
    if (h->fitted == 0) return;
    for (int j = 0; j < IMPACT_SHAPE_POINTS; j++)
        h->q[j] = (j - IMPACT_SHAPE_POINTS / 2) / 64.0;
    double *room = ARENA_TAKE(a, double, 5 * h->fitted);
    r = (struct ratios){{room, room + h->fitted}, room + 2 * h->fitted, room + 3 * h->fitted, room + 4 * h->fitted};
    for (long i = 0; i < h->fitted; i++) {
        long k = list[i * n / h->fitted];
        fit_one(s, f, k, &r, i);
        mean_add(s, &b, f, k, h);
    }
    ratios_end(&r, h);
    mean_end(h);
}
