/* Warnings of `rasp analyse`: each says what was seen, what it does to the estimates, and where there is a remedy, which. */
#include "analysis/impact_warnings.h"

#include <math.h>

#include "analysis/frequency_polygon.h"

enum { FEW = 500, KURTOSIS_MOST = 5 };

static const char *const names[STATISTICS_SERIES] = {"amplitudes", "intervals"};
static const char *const keys[STATISTICS_SERIES] = {"amplitude", "interval"};

struct list {
    struct impact_statistics *s;
    struct arena *a;
    int count;
};

#define WARN(l, ...) ((l)->s->warnings[(l)->count++] = arena_format((l)->a, __VA_ARGS__))

/* Draws raised to a floor are all equal: more values are the least one than could be by chance, and more than the next. */
static void floors(struct list *l, int which, const double *x, int n)
{
    double least = HUGE_VAL, next = HUGE_VAL, most = -HUGE_VAL;
    int at_least = 0, at_next = 0;
    for (int i = 0; i < n; i++) {
        least = fmin(least, x[i]);
        most = fmax(most, x[i]);
    }
    double grain = 1e-6 * (most - least);
    for (int i = 0; i < n; i++)
        if (x[i] > least + grain)
            next = fmin(next, x[i]);
    for (int i = 0; i < n; i++) {
        at_least += x[i] <= least + grain;
        at_next += fabs(x[i] - next) <= grain;
    }
    if (at_least >= 3 && at_least >= 3 * at_next)
        WARN(l, "%.3g %% of the %s are the smallest one, %.4g: draws were raised to a floor. What lay below is lost: the mean comes out too high, the deviation and a1's memory wrong",
             100.0 * at_least / n, names[which], least);
}

static void filters(struct list *l, int which)
{
    const struct series_statistics *s = &l->s->series[which];
    bool white = s->a1.value == 0 && s->b1.value == 0;
    if (s->flat)
        return;
    if (s->ridge && white)
        WARN(l, "%s: white as they are. Any a1 = b1 would do, as a pole and a zero at one place cancel; both are set to 0", names[which]);
    else if (s->ridge)
        WARN(l, "%s: a1 = %.3f lies within 2 errors of b1 = %.3f. A pole and a zero at one place cancel, so neither is known well by itself", names[which], s->a1.value, s->b1.value);
    if (fabs(s->a1.value) + s->a1.error >= 1 && fabs(s->a1.value) > 0.5 && !white)
        WARN(l, "%s: a1 = %.4f is not told from %d: they drift, or there are too few of them; the mean and its error mean little", names[which], s->a1.value, s->a1.value < 0 ? -1 : 1);
    if (s->whiteness_p < 0.001)
        WARN(l, "%s: not white after one pole and one zero (Q = %.0f over 20 lags, probability %.1g): the model does not hold, and neither do its errors", names[which], s->whiteness, s->whiteness_p);
    if (frequency_polygon_needed(s->white.gaussian_distance, l->s->n - 1))
        WARN(l, "%s: the white process is not Gaussian (distance %.2f, skewness %.2f, kurtosis %.1f where a Gaussian has 0 and 3): a table is nearer (contact.impacts.%s.distribution)", names[which],
             s->white.gaussian_distance, s->white.skewness, s->white.kurtosis, keys[which]);
    else if (s->white.kurtosis > KURTOSIS_MOST)
        WARN(l, "%s: the white process has outliers (kurtosis %.1f where a Gaussian has 3), as impacts that merged or were missed make them: its deviation comes out too large", names[which],
             s->white.kurtosis);
}

/* An impact that begins before the one before is over cannot always be told from it. */
static void merged(struct list *l, const struct impact_events *v)
{
    int known = 0, over = 0;
    for (int i = 0; i + 1 < v->n; i++)
        if (isfinite(v->duration[i]) && isfinite(v->duration[i + 1])) {
            double apart = v->time[i + 1] - v->time[i], both = 0.5 * (v->duration[i] + v->duration[i + 1]);
            known++;
            over += apart < both * (1 - 1e-6);
        }
    if (known && over > 0.005 * known)
        WARN(l, "%.3g %% of the impacts begin before the one before is over: in a force such impacts merge, so that short intervals are missed (their mean comes out too long) and amplitudes add",
             100.0 * over / known);
}

static void modulated(struct list *l)
{
    const struct impact_modulation *m = &l->s->modulation;
    if (m->found)
        WARN(l, "amplitudes are modulated, m = %.3f at %.4g Hz, and were divided by it: durations follow from the modulated ones. What is left is biased by the errors of m and the rate, and impacts near a "
             "floor stay there", m->depth, m->rate);
}

/* From STATISTICS_ONE_PROCESS on a scene takes one process, which ties amplitudes and intervals wholly. */
static void processes(struct list *l)
{
    double r = l->s->one_process;
    if (r < STATISTICS_ONE_PROCESS)
        WARN(l, "amplitudes and intervals are not driven by one process (correlation of ranks %.2f): contact.impacts.processes: two draws them apart", r);
    else if (r < 0.9)
        WARN(l, "amplitudes and intervals are driven by one process only in part (correlation of ranks %.2f, where one makes it 1 and two make it 0): contact.impacts.processes: one is nearer", r);
}

void impact_warnings(const struct impact_events *v, const double *interval, struct arena *a, struct impact_statistics *s)
{
    struct list l = {s, a, 0};
    if (s->n < FEW)
        WARN(&l, "only %d impacts: intervals of confidence hold from about %d on", s->n, FEW);
    modulated(&l);
    if (!s->series[STATISTICS_AMPLITUDE].flat)
        floors(&l, STATISTICS_AMPLITUDE, v->amplitude, s->n);
    if (!s->series[STATISTICS_INTERVAL].flat)
        floors(&l, STATISTICS_INTERVAL, interval, s->n - 1);
    merged(&l, v);
    for (int i = 0; i < STATISTICS_SERIES; i++)
        filters(&l, i);
    processes(&l);
    s->warnings[l.count] = NULL;
}
