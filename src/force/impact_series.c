/* A series of impacts. From impact to impact, with P of the instant (impact_law.h), of amplitudes and intervals alike

     E_n = F^-1(W_n),   X_n = -a1 X_(n-1) + E_n + b1 E_(n-1),   value = mean + X_n

   W_n is number n of one uniform process, which drives both (`processes: two`: each has its own). Then, in this order:

     marginal   lognormal: with M, V the mean and variance of the stationary series, which is Gaussian, value = M exp(s
                Z - s^2/2), Z = X_n / sqrt(V),
                s^2 = ln(1 + V/M^2): the same M and V. Correlations become (exp(s^2 r_k) - 1)/(exp(s^2) - 1) of r_k, a
                  little less
     floors     a value below is raised to it, and told so; X_n stays what it was
     modulation the amplitude times 1 + m sin(2 pi phase); the phase grows by nu times the interval: continuous whatever
       moves
     duration   zeta max(|A|, shortest)^-theta, of the modulated amplitude; then the amplitude becomes newtons

   The start. The series has no beginning: it is begun so long before time 0 that nothing of that beginning is left,
   with P of time 0, and run until the first impact that is not over at 0. The state is begun at its mean and has then
   seen about ln(1e-17)/ln |a1| impacts and half as many again. The clock begins at minus that number times (mean +
   standard deviation) of the intervals, which the mean of floored ones does not surpass, minus a uniform number of 64
   mean intervals: however regular the intervals, the phase of the first impact is that of an endless series looked at
   at any instant. So a long interval is more likely to lie across time 0 than a short one, as it should. */
#include "force/impact_series.h"

#include <jansson.h>
#include <math.h>

#include "file/json_value.h"
#include "num/real.h"
#include "stage.h"
#include "trajectory/trajectory.h"

#define MEETING 1e-9 /* of the mean duration */

enum { OVER = 64 }; /* mean intervals over which the beginning is spread */

/* ------------------------------------------------------------------ one impact */

/* X_n of one series. */
static double series_step(struct impact_series *s, enum impact_series_of which, const struct impact_parameters *p,
                          double w)
{
    double white = impact_law_draw(s->law, which, p, w);
    s->x[which] = -p->a1[which] * s->x[which] + white + p->b1[which] * s->white[which];
    s->white[which] = white;
    return s->x[which];
}

static double series_value(const struct impact_series *s, enum impact_series_of which,
                           const struct impact_parameters *p, double x)
{
    double mean, variance;
    if (!s->law->lognormal) return p->mean[which] + x;
    impact_law_stationary(s->law, which, p, &mean, &variance);
    double square = real_log1p(variance / (mean * mean));
    return variance > 0 ? mean * real_exp(sqrt(square / variance) * x - 0.5 * square) : mean;
}

static double raised(double value, double least, unsigned flag, unsigned *limited)
{
    if (!(value < least)) return value;
    *limited |= flag;
    return least;
}

static double lasts(const struct impact_parameters *p, double amplitude)
{
    return p->theta > 0 ? p->zeta * real_pow(fmax(fabs(amplitude), p->shortest), -p->theta) : p->zeta;
}

void impact_series_next(struct impact_series *s, struct impact *i)
{
    const struct impact_law *l = s->law;
    struct impact_parameters p;
    impact_law_at(l, s->time, &p);
    double w = noise_uniform(s->noise, (uint64_t)s->number, 0),
           other = l->two ? noise_uniform(s->noise, (uint64_t)s->number, 1) : w;
    double amplitude = series_value(s, IMPACT_AMPLITUDE, &p, series_step(s, IMPACT_AMPLITUDE, &p, w));
    double interval = series_value(s, IMPACT_INTERVAL, &p, series_step(s, IMPACT_INTERVAL, &p, other));
    *i = (struct impact){.time = s->time};
    amplitude = raised(amplitude, p.least_amplitude, IMPACT_LIMITED_AMPLITUDE, &i->limited);
    i->interval = raised(interval, l->least_interval, IMPACT_LIMITED_INTERVAL, &i->limited);
    if (p.depth > 0) amplitude *= 1 + p.depth * real_sinpi(2 * s->phase);
    i->duration = lasts(&p, amplitude);
    i->amplitude = l->unit_force * amplitude;
    s->phase += p.rate * i->interval;
    s->phase -= floor(s->phase);
    s->time += i->interval;
    s->number++;
}

bool impact_series_overlap(double distance, double before, double now, double grain)
{
    return distance + grain < 0.5 * (before + now) * (1 - MEETING);
}

/* ------------------------------------------------------------------ the start */

static void series_begin(struct impact_series *s)
{
    const struct impact_law *l = s->law;
    struct impact_parameters p;
    double most = 0, mean, variance, white[2];
    impact_law_at(l, 0, &p);
    for (int k = 0; k < IMPACT_SERIES; k++) {
        impact_law_moments(l, k, &p, &white[0], &white[1]);
        s->white[k] = white[0];
        s->x[k] = white[0] * (1 + p.b1[k]) / (1 + p.a1[k]);
        most = fmax(most, fabs(p.a1[k]));
    }
    impact_law_stationary(l, IMPACT_INTERVAL, &p, &mean, &variance);
    mean = fmax(mean, l->least_interval);
    double before = OVER + (most > 0 ? ceil(1.5 * 39.2 / -real_log(most)) : 0), interval = mean + sqrt(variance);
    before += ceil(0.5 * l->longest / interval);
    s->number = -(int64_t)before - OVER;
    s->time = -before * interval - OVER * mean * noise_uniform(s->noise, 0, 2);
    s->phase = p.rate * s->time;
    s->phase -= floor(s->phase);
}

void impact_series_open(const struct impact_law *l, uint64_t seed, const char *contact, struct arena *a,
                        struct impact_series *s)
{
    struct impact_series next;
    struct impact i;
    *s = (struct impact_series){.law = l, .noise = noise_make(seed, arena_format(a, "impacts/%s", contact))};
    series_begin(s);
    for (next = *s;; *s = next) {
        impact_series_next(&next, &i);
        if (i.time + 0.5 * i.duration > 0) return;
    }
}

/* ------------------------------------------------------------------ the impacts that take place */

/* An impact takes place if its middle comes before the motion's end and it is not over before the contact's start. */

#define IMPACT_LONGEST 10.0 /* s: half of it is how far the force must look ahead */

static void train_look(struct impact_train *t)
{
    impact_series_next(&t->series, &t->next);
    t->any = t->next.time < t->end;
}

bool impact_series_train(const struct stage_run *r, struct impact_train *t, struct err *e)
{
    const struct contact *c = r->contact;
    *t = (struct impact_train){.end = r->board->trajectory->duration};
    if (!impact_law_make(c, t->end, r->arena, &t->law, e)) return false;
    if (!(t->law.longest <= IMPACT_LONGEST))
        return err_set(e, ERR_SCENE,
                       "contact '%s': contact.impacts.duration.zeta: an impact of the least amplitude would last %.4g "
                       "s, and at most %g s make sense: lower "
                       "zeta or theta, or raise contact.impacts.floor.amplitude",
                       c->name, t->law.longest, IMPACT_LONGEST) ||
               err_about(e, c->name, "contact.impacts.duration.zeta");
    t->report.time = t->end;
    t->before[0] = HUGE_VAL;
    impact_series_open(&t->law, r->scene->seed, c->name, r->arena, &t->series);
    train_look(t);
    return true;
}

static void train_report(struct impact_train *t, const struct impact *i)
{
    struct impact_report *o = &t->report;
    o->count++;
    o->limited_amplitude += (i->limited & IMPACT_LIMITED_AMPLITUDE) != 0;
    o->limited_interval += (i->limited & IMPACT_LIMITED_INTERVAL) != 0;
    o->overlaps += impact_series_overlap(t->before[0], t->before[1], i->duration, 0);
    o->longest = fmax(o->longest, i->duration);
    t->sums[0] += i->amplitude;
    t->sums[1] += i->interval;
    o->mean_amplitude = t->sums[0] / (double)o->count;
    o->mean_interval = t->sums[1] / (double)o->count;
    t->before[0] = i->interval;
    t->before[1] = i->duration;
}

struct impact impact_series_take(struct impact_train *t)
{
    struct impact now = t->next;
    train_report(t, &now);
    train_look(t);
    return now;
}

/* ------------------------------------------------------------------ the report */

#define LIMITED_OFTEN 5.0 /* per cent of the draws */
#define IMPACT_LONG 0.1   /* s */

static double percent(long some, long all) { return all > 0 ? 100 * (double)some / (double)all : 0; }

static const char *impacted(const struct impact_report *o, struct arena *a)
{
    return arena_format(a,
                        "%ld impact%s, %.*g a second, of %.4g N on average; %ld amplitude%s (%.3g %%) and %ld "
                        "interval%s (%.3g %%) raised to their floors; %ld overlap%s (%.3g %%)",
                        o->count, o->count == 1 ? "" : "s", (double)o->count < 1e4 * o->time ? 4 : 6,
                        (double)o->count / o->time, o->mean_amplitude, o->limited_amplitude,
                        o->limited_amplitude == 1 ? "" : "s", percent(o->limited_amplitude, o->count),
                        o->limited_interval, o->limited_interval == 1 ? "" : "s",
                        percent(o->limited_interval, o->count), o->overlaps, o->overlaps == 1 ? "" : "s",
                        percent(o->overlaps, o->count));
}

static json_t *impacts_json(const struct impact_report *o)
{
    return json_pack("{s:I, s:o, s:I, s:I, s:I, s:o, s:o, s:o}", "count", (json_int_t)o->count, "per_second",
                     json_value_number((double)o->count / o->time), "limited_amplitudes",
                     (json_int_t)o->limited_amplitude, "limited_intervals", (json_int_t)o->limited_interval, "overlaps",
                     (json_int_t)o->overlaps, "mean_amplitude_n", json_value_number(o->mean_amplitude),
                     "mean_interval_s", json_value_number(o->mean_interval), "longest_s",
                     json_value_number(o->longest));
}

/* NULL: there are few of them. */
static const char *limited_warning(const char *what, long limited, long all, struct arena *a)
{
    if (!(percent(limited, all) > LIMITED_OFTEN)) return NULL;
    return arena_format(a,
                        "%.3g %% of the %ss were drawn below contact.impacts.floor.%s and raised to it: the series has "
                        "other statistics than were asked for; lower the deviation, or set contact.impacts.marginal "
                        "to lognormal",
                        percent(limited, all), what, what);
}

struct stage_report impact_series_report(const struct impact_report *o, struct arena *a)
{
    struct stage_report r = {.key = "impacts", .value = impacts_json(o), .note = impacted(o, a)};
    const char *warnings[STAGE_WARNINGS] = {
        limited_warning("amplitude", o->limited_amplitude, o->count, a),
        limited_warning("interval", o->limited_interval, o->count, a),
        o->longest > IMPACT_LONG ? arena_format(a,
                                                "an impact lasts %.4g s: lower contact.impacts.duration.zeta, or raise "
                                                "the least amplitude",
                                                o->longest)
                                 : NULL,
        o->count == 0 ? arena_format(a, "no impact comes within the motion's %.4g s", o->time) : NULL};
    for (int i = 0, n = 0; i < STAGE_WARNINGS; i++)
        if (warnings[i]) r.warnings[n++] = warnings[i];
    return r;
}
