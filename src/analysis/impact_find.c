/* Impacts are the local maxima of the force (papers/002, section IV-A). What is done beside that:

   Ripples.  A force that was brought to its sample rate by a low-pass has small maxima beside the large ones, and so
   has noise. A maximum counts if it
             rises above the higher of the two valleys beside it (that part towards the next higher maximum on each
               side; its prominence) by at least
             `prominence` of the greatest force within 24 samples, and if it is at least `threshold` of the greatest of
               all. What is left out is counted.
   Place.    The signal is taken as band-limited (num/filter.h): the greatest value in steps of 1/32 of a sample, and a
             parabola through it and those
             a quarter of a sample beside it. Times are right within 0.01 of a sample of forces that rasp brought to
               their rate, and of point samples of
             raised cosines that last 12 or more.
   Alone.    An impact stands alone if on both sides the force falls to `quiet` of its own amplitude before the valley
             that parts it from its
             neighbour. `quiet` is how nearly 0 the force must be, and has to lie above the ripple.
   Duration. Of one that stands alone, its contact time. Near its ends force is taken as A sin^p of the time from there,
   which a raised cosine is with
             p = 2 and Hertz's impact nearly with p = 1.5: the times at which it passes 1/20, 1/10 and 1/5 of A (2, 4
               and 8 times `quiet` where that is
             more) give p and the end. The low-pass blurs the ends: this is right within 0.5 % from 32 samples on (twice
               the width at half height), and within
             1 % from 15 on. Of shorter impacts, and of those that do not stand alone, `stretch` times the width at half
               height, which the low-pass hardly
             touches (within 0.3 % from 6 samples on): `stretch` is the median ratio of the two durations of the impacts
               of 32 samples and more that stand
             alone, if there are IMPACT_FEET_MANY of them and they are a tenth of those of 12 samples and more (fewer
               may all be merged ones); else of
             those of 12 and more; if there is none it is 2. It is 2 of raised cosines, 1.82 of Hertz's impacts. Half
               height may be passed on one side
             only: then twice the half there.
   Merged.   A flank whose slope falls and rises again by more than a tenth of its steepest is one of two impacts that
             made a single maximum: they are
             counted, and taken as one. */
#include "analysis/impact_find.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>

#include "num/filter.h"
#include "num/real.h"

#define BLUR_AMPLITUDE 0.005 /* of them: those of impacts that stand alone are nearer, but tails of neighbours add */
#define BLUR_INTERVAL 0.05   /* samples */

enum { REACH = 24, FEET = 3, FEET_LEAST = 12, FEET_SURE = 32, ARM = BETWEEN_PHASES / 4 };

const struct impact_options impact_find_options = {0.001, 0.02, 0.01, false};

struct search {
    const struct impact_signal *s;
    const struct impact_options *o;
    struct filter_between between;
    struct impact_found *f;
    long n;       /* maxima */
    long *at;     /* [n] samples */
    double *left; /* [n] N, valley before it; later its prominence */
};

/* What is searched for maxima. */
static double height(const struct search *q, long i)
{
    double x = q->s->force[i];
    return q->o->both ? fabs(x) : fmax(x, 0);
}

/* ------------------------------------------------------------------ maxima */

/* Local maxima above 0; of a level one its middle. */
static void maxima_list(struct search *q)
{
    long n = q->s->n;
    for (long i = 0; i < n;) {
        long last = i;
        double h = height(q, i);
        while (last + 1 < n && height(q, last + 1) == h)
            last++;
        if (h > 0 && i > 0 && last + 1 < n && height(q, i - 1) < h && height(q, last + 1) < h)
            q->at[q->n++] = (i + last) / 2;
        i = last + 1;
    }
}

/* Valley of each maximum on the way to the next one that is higher (or, if `equal`, as high), in the order of `step`; 0
 * where there is none. */
static void valleys(const struct search *q, int step, bool equal, double *valley, long *stack)
{
    long top = 0, from = step > 0 ? 0 : q->n - 1, before = from;
    for (long k = from; k >= 0 && k < q->n; before = k, k += step) {
        double h = height(q, q->at[k]), low = h;
        for (long i = q->at[before]; i != q->at[k]; i += step)
            low = fmin(low, height(q, i));
        while (top > 0 && (height(q, q->at[stack[top - 1]]) < h || (!equal && height(q, q->at[stack[top - 1]]) == h)))
            low = fmin(low, valley[stack[--top]]);
        valley[k] = top > 0 ? low : 0;
        stack[top++] = k;
    }
}

static double greatest_near(const struct search *q, long at)
{
    double h = 0;
    for (long i = at > REACH ? at - REACH : 0; i <= at + REACH && i < q->s->n; i++)
        h = fmax(h, fabs(q->s->force[i])); /* also of an impact in the other direction */
    return h;
}

/* Keeps in q->at those that count. */
static void maxima_choose(struct search *q, struct arena *a)
{
    double *right = ARENA_TAKE(a, double, q->n), most = fmax(q->f->greatest, q->o->both ? -q->f->least : 0);
    long *stack = ARENA_TAKE(a, long, q->n), left = 0;
    q->left = ARENA_TAKE(a, double, q->n);
    valleys(q, 1, true, q->left, stack);
    valleys(q, -1, false, right, stack);
    for (long k = 0; k < q->n; k++) {
        double h = height(q, q->at[k]);
        if (h < q->o->threshold * most)
            q->f->low++;
        else if (h - fmax(q->left[k], right[k]) < q->o->prominence * greatest_near(q, q->at[k]))
            q->f->ripples++;
        else
            q->at[left++] = q->at[k];
    }
    q->n = left;
    q->f->events.fewer = q->f->ripples + q->f->low;
}

/* ------------------------------------------------------------------ one impact */

struct one {
    const struct search *q;
    double sign, amplitude, place; /* 1 or -1; N; samples              */
    long at, low, high;            /* samples: its maximum, the valleys beside it */
};

static double between_value(const struct one *p, long k)
{
    return p->sign * filter_between_at(&p->q->between, p->q->s->force, p->q->s->n, k);
}

static void one_place(struct one *p)
{
    long best = 0;
    double y[2 * BETWEEN_PHASES + 1];
    for (long j = 0; j <= 2 * BETWEEN_PHASES; j++) {
        y[j] = between_value(p, (p->at - 1) * BETWEEN_PHASES + j);
        best = y[j] > y[best] ? j : best;
    }
    double bend = 0, shift = 0;
    if (best >= ARM && best <= 2 * BETWEEN_PHASES - ARM) {
        bend = 2 * y[best] - y[best - ARM] - y[best + ARM];
        shift = bend > 0 ? 0.5 * (y[best + ARM] - y[best - ARM]) / bend : 0;
    }
    p->place = (double)(p->at - 1) + ((double)best + shift * ARM) / BETWEEN_PHASES;
    p->amplitude = y[best] + 0.5 * bend * shift * shift;
}

/* Where the force first falls to a level on the way to the valley, in samples from the impact's place outwards; NAN: it
 * does not. */
static double one_crossing(const struct one *p, int step, double level)
{
    const double *x = p->q->s->force;
    long end = step > 0 ? p->high : p->low, i = p->at;
    while (i != end && p->sign * x[i + step] > level)
        i += step;
    if (i == end) return NAN;
    long in = 0, out = BETWEEN_PHASES; /* above the level at in, not at out */
    while (out - in > 1) {
        long middle = (in + out) / 2;
        if (between_value(p, i * BETWEEN_PHASES + step * middle) > level)
            in = middle;
        else
            out = middle;
    }
    double y0 = between_value(p, i * BETWEEN_PHASES + step * in),
           y1 = between_value(p, i * BETWEEN_PHASES + step * out);
    double k = (double)in + (y0 > y1 ? (y0 - level) / (y0 - y1) : 0);
    return step * ((double)i - p->place) + k / BETWEEN_PHASES;
}

static double arc(double share, double p)
{
    double y = real_pow(share, 1 / p);
    return real_atan2(y, sqrt((1 - y) * (1 + y)));
}

/* How far from its maximum the impact ends on one side, in samples; NAN: it cannot be told. */
static double one_end(const struct one *p, int step)
{
    double level[FEET], t[FEET], low = 0.7, high = 10;
    for (int k = 0; k < FEET; k++) {
        level[k] = fmax(0.05, 2 * p->q->o->quiet) * (1 << k);
        t[k] = one_crossing(p, step, level[k] * p->amplitude);
    }
    double ratio = (t[1] - t[2]) / (t[0] - t[1]);
    for (int i = 0; i < 60; i++) { /* the ratio falls with the power */
        double m = 0.5 * (low + high), u0 = arc(level[0], m), u1 = arc(level[1], m), u2 = arc(level[2], m);
        if ((u2 - u1) / (u1 - u0) > ratio)
            low = m;
        else
            high = m;
    }
    if (!isfinite(ratio) || low < 0.701 || high > 9.99) return NAN;
    double u0 = arc(level[0], low), u1 = arc(level[1], low);
    return t[0] + (t[0] - t[1]) * u0 / (u1 - u0);
}

/* The steps from sample to sample along a flank, up to the maximum: does their slope fall and rise again? */
static bool flank_merged(const struct one *p, int step, long end)
{
    const double *x = p->q->s->force;
    double steepest = 0, most = 0, least = HUGE_VAL, dip = 0;
    for (long i = end; i != p->at; i -= step) {
        double slope = p->sign * (x[i - step] - x[i]);
        steepest = fmax(steepest, slope);
        if (slope > most) {
            most = slope;
            least = slope;
        }
        least = fmin(least, slope);
        dip = fmax(dip, fmin(most, slope) - least);
    }
    return dip > 0.1 * steepest;
}

/* ------------------------------------------------------------------ all */

static void one_take(struct one *p, long k, double *width)
{
    const struct search *q = p->q;
    struct impact_found *f = q->f;
    double half[2], quiet[2];
    one_place(p);
    for (int side = 0; side < 2; side++) {
        half[side] = one_crossing(p, side ? 1 : -1, 0.5 * p->amplitude);
        quiet[side] = one_crossing(p, side ? 1 : -1, q->o->quiet * p->amplitude);
    }
    bool alone = !isnan(quiet[0]) && !isnan(quiet[1]);
    f->touching += !alone;
    f->from[k] = isnan(quiet[0]) ? (double)p->low : p->place - quiet[0];
    f->to[k] = isnan(quiet[1]) ? (double)p->high : p->place + quiet[1];
    width[k] = isnan(half[0]) ? 2 * half[1] : isnan(half[1]) ? 2 * half[0] : half[0] + half[1];
    f->merged += flank_merged(p, -1, (long)fmax(f->from[k], 0)) ||
                 flank_merged(p, 1, (long)fmin(f->to[k] + 1, (double)q->s->n - 1));
    f->events.time[k] = q->s->start + p->place / q->s->rate;
    f->events.amplitude[k] = p->sign * p->amplitude;
    f->events.alone[k] = alone;
    f->events.duration[k] = alone && 2 * width[k] >= FEET_LEAST ? (one_end(p, -1) + one_end(p, 1)) / q->s->rate : NAN;
    f->alone += f->events.alone[k];
}

static long valley_between(const struct search *q, long from, long to)
{
    long best = from;
    for (long i = from; i <= to; i++)
        if (height(q, i) < height(q, best)) best = i;
    return best;
}

static void take_all(const struct search *q, double *width)
{
    for (long k = 0; k < q->n; k++) {
        struct one p = {.q = q, .at = q->at[k], .sign = q->s->force[q->at[k]] < 0 ? -1 : 1};
        p.low = k > 0 ? valley_between(q, q->at[k - 1], p.at) : 0;
        p.high = k + 1 < q->n ? valley_between(q, p.at, q->at[k + 1]) : q->s->n - 1;
        one_take(&p, k, width);
    }
}

/* Contact time over width at half height, of those whose ends are known and that last `least` samples; their number is
 * returned. */
static size_t ratios_list(const struct search *q, const double *width, int least, double *ratio)
{
    size_t n = 0;
    for (long k = 0; k < q->n; k++)
        if (!isnan(q->f->events.duration[k]) && 2 * width[k] >= least)
            ratio[n++] = q->f->events.duration[k] * q->s->rate / width[k];
    return n;
}

/* Durations of those whose ends are not known, or not well. */
static void stretch_widths(const struct search *q, const double *width, struct arena *a)
{
    struct impact_found *f = q->f;
    double *ratio = ARENA_TAKE(a, double, q->n);
    size_t sure = ratios_list(q, width, FEET_SURE, ratio), n = ratios_list(q, width, FEET_LEAST, ratio);
    if (sure >= IMPACT_FEET_MANY && 10 * sure >= n) n = ratios_list(q, width, FEET_SURE, ratio);
    gsl_sort(ratio, 1, n);
    f->feet = (long)n;
    f->stretch = n ? gsl_stats_median_from_sorted_data(ratio, 1, n) : 2;
    for (long k = 0; k < q->n; k++) {
        if (isnan(f->events.duration[k]) || 2 * width[k] < FEET_SURE)
            f->events.duration[k] = f->stretch * width[k] / q->s->rate;
        f->unknown += isnan(f->events.duration[k]);
    }
}

static void take_room(struct impact_found *f, long n, double rate, struct arena *a)
{
    f->events.n = (int)n;
    f->events.blur[0] = BLUR_AMPLITUDE;
    f->events.blur[1] = BLUR_INTERVAL / rate;
    f->events.time = ARENA_TAKE(a, double, n);
    f->events.amplitude = ARENA_TAKE(a, double, n);
    f->events.duration = ARENA_TAKE(a, double, n);
    f->events.alone = ARENA_TAKE(a, bool, n);
    f->from = ARENA_TAKE(a, double, n);
    f->to = ARENA_TAKE(a, double, n);
}

bool impact_find(const struct impact_signal *s, const struct impact_options *o, struct arena *a, struct impact_found *f,
                 struct err *e)
{
    struct search q = {.s = s, .o = o, .f = f, .at = ARENA_TAKE(a, long, s->n / 2 + 1)};
    *f = (struct impact_found){.greatest = s->force[0], .least = s->force[0]};
    for (long i = 0; i < s->n; i++) {
        f->greatest = fmax(f->greatest, s->force[i]);
        f->least = fmin(f->least, s->force[i]);
    }
    q.between = filter_between_make(a);
    maxima_list(&q);
    maxima_choose(&q, a);
    if (q.n == 0)
        return err_set(
            e, ERR_SCENE,
            "no impact: the force, from %.6g to %.6g N, has no local maximum above %.6g N that is prominent enough%s",
            f->least, f->greatest, o->threshold * fmax(f->greatest, 0),
            !o->both && f->least < -fmax(f->greatest, 0) ? "; --signed looks for those below 0 too" : "");
    take_room(f, q.n, s->rate, a);
    double *width = ARENA_TAKE(a, double, q.n);
    take_all(&q, width);
    stretch_widths(&q, width, a);
    return true;
}

/* ------------------------------------------------------------------ impact duration */

/* The two steps of papers/002, section IV-E2: outliers (impacts that run into each other) spoil a fit of both
   parameters to rolling, so theta is taken from single impacts and only zeta from the series. Both are least squares of
   log t0, where the law is a line:

     log t0 = log zeta - theta log |A|,     log zeta = mean of (log t0 + theta log |A|) where theta is given.

   R^2 = 1 - sum of squared errors / sum of squares about the mean; of t0 with the law so found, and of log t0. The
   paper does not say which it prints. An R^2 below 0 says that a constant would do better; of durations that are all
   alike there is none. The standard error of theta is that of the scatter: durations measured in a force are right
   within 0.5 % only (impact_find.c), which over a decade of amplitudes moves theta by up to 0.003. */
#define ALIKE 1e-9 /* of their mean: durations that differ by less are all alike, and theta is 0 exactly */

static bool known(const struct impact_events *v, int i, bool only_alone)
{
    return v->duration[i] > 0 && v->amplitude[i] != 0 && (v->alone[i] || !only_alone);
}

static void r2_both(const struct impact_events *v, bool only_alone, const double law[2], double r2[2])
{
    double n = 0, sum[2] = {0}, squares[2] = {0}, errors[2] = {0};
    for (int i = 0; i < v->n; i++)
        if (known(v, i, only_alone)) {
            sum[0] += v->duration[i];
            sum[1] += real_log(v->duration[i]);
            n++;
        }
    for (int i = 0; i < v->n; i++)
        if (known(v, i, only_alone)) {
            double y = real_log(v->duration[i]), fit = real_log(law[0]) - law[1] * real_log(fabs(v->amplitude[i]));
            double d[2] = {v->duration[i] - sum[0] / n, y - sum[1] / n},
                   e[2] = {v->duration[i] - real_exp(fit), y - fit};
            for (int k = 0; k < 2; k++) {
                squares[k] += d[k] * d[k];
                errors[k] += e[k] * e[k];
            }
        }
    double alike = n * (ALIKE * sum[0] / n) * (ALIKE * sum[0] / n);
    for (int k = 0; k < 2; k++)
        r2[k] = squares[0] > alike ? 1 - errors[k] / squares[k] : errors[0] > alike ? -HUGE_VAL : NAN;
}

/* y = c0 + c1 x; error: of c1. False: x are all alike. */
static bool line_fit(const struct impact_events *v, bool only_alone, double c[2], double *error)
{
    double n = 0, mx = 0, my = 0, sxx = 0, sxy = 0, syy = 0;
    for (int i = 0; i < v->n; i++)
        if (known(v, i, only_alone)) {
            double x = real_log(fabs(v->amplitude[i])), y = real_log(v->duration[i]);
            n++;
            double dx = x - mx, dy = y - my; /* running means: no difference of large sums */
            mx += dx / n;
            my += dy / n;
            sxx += dx * (x - mx);
            sxy += dx * (y - my);
            syy += dy * (y - my);
        }
    if (n < IMPACT_DURATION_LEAST || sxx < 4e-4 * n) return false;
    c[1] = syy > ALIKE * ALIKE * n ? sxy / sxx : 0;
    c[0] = my - c[1] * mx;
    *error = sqrt(fmax(syy - c[1] * sxy, 0) / (n - 2) / sxx);
    return true;
}

bool impact_find_duration_single(const struct impact_events *v, bool only_alone, struct impact_duration *d)
{
    double c[2], error, r2[2];
    long n = 0;
    for (int i = 0; i < v->n; i++)
        n += known(v, i, only_alone);
    d->singles = n;
    if (!line_fit(v, only_alone, c, &error)) return false;
    d->theta = d->theta_single = -c[1];
    d->theta_error = error;
    d->zeta_single = real_exp(c[0]);
    r2_both(v, only_alone, (const double[2]){d->zeta_single, d->theta}, r2);
    d->r2_single = r2[0];
    d->r2_single_log = r2[1];
    return true;
}

bool impact_find_duration_series(const struct impact_events *v, struct impact_duration *d)
{
    double sum = 0, r2[2];
    d->n = 0;
    for (int i = 0; i < v->n; i++)
        if (known(v, i, false)) {
            sum += real_log(v->duration[i]) + d->theta * real_log(fabs(v->amplitude[i]));
            d->n++;
        }
    if (d->n == 0) return false;
    d->zeta = real_exp(sum / (double)d->n);
    r2_both(v, false, (const double[2]){d->zeta, d->theta}, r2);
    d->r2 = r2[0];
    d->r2_log = r2[1];
    return true;
}

bool impact_find_duration_constant(const struct impact_events *v, struct arena *a, struct impact_duration *d)
{
    double *duration = ARENA_TAKE(a, double, v->n + 1), r2[2];
    size_t n = 0;
    for (int i = 0; i < v->n; i++)
        if (known(v, i, false)) duration[n++] = v->duration[i];
    d->n = (long)n;
    d->theta = 0;
    if (n == 0) return false;
    gsl_sort(duration, 1, n);
    d->zeta = gsl_stats_median_from_sorted_data(duration, 1, n);
    r2_both(v, false, (const double[2]){d->zeta, 0}, r2);
    d->r2 = r2[0];
    d->r2_log = r2[1];
    return true;
}
