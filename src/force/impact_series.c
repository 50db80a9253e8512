/* A series of impacts. From impact to impact, with P of the instant (impact_law.h), of amplitudes and intervals alike

     E_n = F^-1(W_n),   X_n = -a1 X_(n-1) + E_n + b1 E_(n-1),   value = mean + X_n

   W_n is number n of one uniform process, which drives both (`processes: two`: each has its own). Then, in this order:

     marginal   lognormal: with M, V the mean and variance of the stationary series, which is Gaussian, value = M exp(s
                Z - s^2/2), Z = X_n / sqrt(V),
                s^2 = ln(1 + V/M^2): the same M and V. Correlations become (exp(s^2 r_k) - 1)/(exp(s^2) - 1) of r_k, a
                  little less
     floors     a value below is raised to it, which is reported; X_n stays what it was
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
#include <string.h>

#include "file/json_value.h"
#include "force/strike.h"
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
    struct stage_report r = {.key = "impacts", .note = impacted(o, a)};
    r.value = json_value_object("count:l per_second:n limited_amplitudes:l limited_intervals:l overlaps:l "
                                "mean_amplitude_n:n mean_interval_s:n longest_s:n",
                                (long)o->count, (double)o->count / o->time, (long)o->limited_amplitude,
                                (long)o->limited_interval, (long)o->overlaps, o->mean_amplitude, o->mean_interval,
                                o->longest);
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

/* The stage that lays a series of impacts on the board: f(t) = sum over n of A_n phi_n(t - T_n) (papers/002 equation 5,
   papers/004 equation 2), phi_n a raised cosine (strike.h) that lasts t0_n. The mean of a sub-interval is the momentum
   handed over in it, exactly, by all impacts that touch it:

     mean = (1/h) sum over n of A_n t0_n / 2 (p((t + h - T_n) / t0_n) - p((t - T_n) / t0_n)),   h the sub-interval, p
       the share of strike.h

   so that all momentum arrives at any sample rate and oversampling. Times are counted from the sub-interval in which an
   impact begins: an hour into a scene impacts have the same shapes as at its start.

   The series is drawn until its time is half the longest impact ahead of the block; what is not over waits in a queue,
   in the series' order. So the force does not depend on how frames fall into blocks, and the queue's length on the law
   alone. Of an impact that is under way at time 0 the rest takes place; one that is under way at the motion's end is
   faded by load.release, and without it goes on until it is over. */

struct impact_waiting {
    double from, after; /* number of the sub-interval in which it begins; when in it, 0 to 1 */
    double length;      /* sub-intervals                                                     */
    double momentum;    /* N sub-intervals                                                   */
    double share;       /* of it handed over so far                                          */
};

struct impact_queue {
    struct impact_train train;
    struct impact_waiting *waiting;
    size_t n, room;
};

struct impact_block { /* the sub-intervals being filled */
    double first, end;
    double *force;
};

/* About how many impacts a second, from the keys alone: of papers/002 table I, and of the middle of the disk, some 200.
 */
static double stage_density(const struct impacts *m)
{
    if (m->prototype == PROTOTYPE_RUB) return 1 / m->rub.interval;
    if (m->prototype == PROTOTYPE_SCRATCH) return 1 / m->scratch.interval;
    return m->interval.mean > 0 ? 1 / m->interval.mean : 200;
}

static double stage_work(const struct contact *c, const struct scene *s)
{
    const struct impacts *m = impact_law_given(c);
    double rate = s->output.sample_rate, lasts = m->prototype == PROTOTYPE_RUB       ? m->rub.duration
                                                 : m->prototype == PROTOTYPE_SCRATCH ? m->scratch.duration
                                                                                     : 5e-4;
    return s->accuracy.oversampling +
           stage_density(m) / rate * (500 + 17 * (1 + lasts * rate * s->accuracy.oversampling));
}

static bool stage_open(struct stage_run *r, struct err *e)
{
    struct impact_queue *q = ARENA_TAKE(r->arena, struct impact_queue, 1);
    r->state = q;
    q->room = 64;
    q->waiting = ARENA_TAKE(r->arena, struct impact_waiting, q->room);
    return impact_series_train(r, &q->train, e);
}

/* Room doubles: what the arena keeps of smaller ones is less than the last. */
static void queue_add(struct impact_queue *q, const struct impact_waiting *w, struct arena *a)
{
    if (q->n == q->room) {
        struct impact_waiting *more = ARENA_TAKE(a, struct impact_waiting, 2 * q->room);
        memcpy(more, q->waiting, q->n * sizeof *more);
        q->waiting = more;
        q->room *= 2;
    }
    q->waiting[q->n++] = *w;
}

/* Adds what it does in the block; true when it is over then. */
static bool waiting_lay(struct impact_waiting *w, const struct impact_block *b)
{
    double k = fmax(w->from, b->first), last = fmin(b->end, w->from + ceil(w->after + w->length) + 1),
           share[PULSE_COSINES];
    while (k < last && w->share < 1) {
        double *force = b->force + (long)(k - b->first);
        int n = (int)fmin(last - k, PULSE_COSINES);
        for (int i = 0; i < n; i++)
            share[i] = (k + (i + 1) - w->from - w->after) / w->length - 0.5;
        strike_pulse_cosines(n, share);
        for (int i = 0; i < n; i++) {
            force[i] += w->momentum * (share[i] - w->share);
            w->share = share[i];
        }
        k += n;
    }
    return w->share >= 1;
}

static struct impact_waiting waiting_make(const struct impact *i, double per_second, double first)
{
    double begins = (i->time - 0.5 * i->duration) * per_second, from = floor(begins);
    struct impact_waiting w = {from, begins - from, i->duration * per_second,
                               0.5 * i->amplitude * i->duration * per_second, 0};
    if (from < first) /* only at the contact's start */
        w.share = strike_pulse_cosine((first - w.from - w.after) / w.length - 0.5);
    return w;
}

/* Those that have waited come first, in their order, then the new ones. */
static void queue_lay(struct impact_queue *q, const struct impact_block *b, double per_second, struct arena *a)
{
    size_t left = 0;
    for (size_t i = 0; i < q->n; i++)
        if (!waiting_lay(&q->waiting[i], b)) q->waiting[left++] = q->waiting[i];
    q->n = left;
    while (q->train.any && (q->train.next.time - 0.5 * q->train.law.longest) * per_second < b->end) {
        struct impact now = impact_series_take(&q->train);
        struct impact_waiting w = waiting_make(&now, per_second, b->first);
        if (!waiting_lay(&w, b)) queue_add(q, &w, a);
    }
}

static bool stage_fill(struct stage_run *r, long from, long to, struct err *e)
{
    struct impact_queue *q = r->state;
    struct board *b = r->board;
    long over = b->over;
    struct impact_block block = {(double)(from * over), (double)(to * over), board_at(b, ITEM_SUBFORCE, from)};
    (void)e;
    memset(block.force, 0, (size_t)((to - from) * over) * sizeof *block.force);
    queue_lay(q, &block, b->rate * (double)over, r->arena);
    return true;
}

static struct stage_report stage_reports(const struct stage_run *r, struct arena *a)
{
    const struct impact_queue *q = r->state;
    return impact_series_report(&q->train.report, a);
}

const struct stage impact_series_stage = {
    .name = "impacts",
    .does = "contact force of a series of impacts drawn from its statistics",
    .paper = "002 eq. 5, 6, 9, 12, 13, 16, 17; 004 eq. 2 to 11",
    .idle = "contact.model is not impacts",
    .params = &impact_law_params,
    .needs = ITEM_BIT(ITEM_MOTION), /* its duration */
    .gives = ITEM_BIT(ITEM_SUBFORCE),
    .knobs = KNOB_BIT(oversampling),
    .work = stage_work,
    .open = stage_open,
    .run = stage_fill,
    .report = stage_reports,
};
