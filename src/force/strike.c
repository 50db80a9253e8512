/* `contact.model: strike`. What strikes has the scraper's mass m and arrives with the speed v; the struck body is taken
   as immovable while they touch, and gravity and the weight at rest as nothing beside the impact's force. Pulses:
   below.

   Repeated impacts are all alike: T_n = first + n interval. A bounce train of restitution e under gravity g:

     v_{n+1} = e v_n,    T_{n+1} = T_n + t_c(v_n) + 2 e v_n / g          contact time, then flight

   An impact with restitution e hands over the momentum m v (1 + e): the elastic pulse's shape and contact time are
   kept, and its force is taken times (1 + e) / 2. (What loses energy also skews the pulse; that is left out.)

   The train is over when `count` impacts are done (0: one, or as many as there is room for), when the next one would
   not be over by the motion's end, or when the flight is shorter than the contact after it: then the ball has come to
   rest. */
#include "force/strike.h"

#include <math.h>

#include "force/approach.h"
#include "force/hertz.h"
#include "num/real.h"
#include "num/vecmath.h"
#include "scene/rows.h"
#include "scene/scene_part.h"
#include "stage.h"
#include "trajectory/motion.h"
#include "trajectory/trajectory.h"

/* ------------------------------------------------------------------ parameters */

#define STRIKE "contact.model=strike"

static const struct choice pulses[] = {
    [PULSE_HALF_SINE] = {"half_sine", "a linear spring: f = k x, which gives half a sine"},
    [PULSE_HERTZ] = {"hertz", "a sphere on a flat: f = k x^1.5"},
    {NULL, NULL}};

static const struct key keys[] = {
    {ROW_CHOICE(strike, pulse, "contact.strike.pulse"), KEY_NONE, 0, 0, "hertz", STRIKE,
     "what springs back in an impact", pulses},
    {ROW_NUMBER(strike, speed, "contact.strike.speed"), KEY_SPEED, 1e-6, 100, NULL, STRIKE,
     "speed at which the first impact arrives", .shown = "1 m/s"},
    {ROW_NUMBER(strike, stiffness, "contact.strike.stiffness"), KEY_STIFFNESS, 1e-3, 1e15, "", STRIKE,
     "stiffness of the contact, N/m of half_sine and N/m^1.5 of hertz; left out: hertz takes it from scraper.radius "
     "and both materials",
     .shown = "1e8 N/m^1.5"},
    {ROW_NUMBER(strike, first, "contact.strike.first"), KEY_TIME, 0, 3600, "20 ms", STRIKE,
     "when the first impact begins, after the contact's start; 20 ms is clear of output.ramp"},
    {ROW_COUNT(strike, count, "contact.strike.count"), KEY_NONE, 0, 1000000, "0", STRIKE,
     "how many impacts, at most; 0: one, or with interval or restitution as many as the motion has time for"},
    {ROW_NUMBER(strike, interval, "contact.strike.interval"), KEY_TIME, 1e-5, 3600, "", STRIKE,
     "time from impact to impact, all alike", .shown = "0.5 s"},
    {ROW_NUMBER(strike, restitution, "contact.strike.restitution"), KEY_NONE, 0.01, 1, "", STRIKE,
     "speed after over speed before an impact: the impacts are a bounce train under contact.gravity", .shown = "0.7"},
    {.path = NULL}};

/* The unit, where one is written, says which pulse the figure is meant for. */
static void unit_check(const struct scene_part *p, const struct strike *s)
{
    static const char *const units[] = {[PULSE_HALF_SINE] = "N/m", [PULSE_HERTZ] = "N/m^1.5"};
    const char *path = "contact.strike.stiffness";
    const struct yaml_node *node = yaml_find(p->map, path);
    int other = s->pulse == PULSE_HERTZ ? PULSE_HALF_SINE : PULSE_HERTZ;
    if (!isnan(s->stiffness) && hertz_unit(node, s->pulse != PULSE_HERTZ))
        diag_add(p->yaml->diag, node->at,
                 arena_format(p->yaml->arena, "give it in %s, or set contact.strike.pulse to %s", units[s->pulse],
                              pulses[other].word),
                 "%s of a %s pulse is in %s, not '%s'", scene_part_label(p, path), pulses[s->pulse].word,
                 units[s->pulse], diag_shown(p->yaml->diag, node->text));
}

static void stiffness_check(const struct scene_part *p, const struct contact *c, const struct strike *s)
{
    if (scene_part_given(p, "contact.strike.stiffness")) return;
    if (s->pulse == PULSE_HALF_SINE) {
        scene_part_missing(p, "contact.strike.stiffness", "2 MN/m", ": a half_sine pulse needs it");
        return;
    }
    scene_part_missing(p, "scraper.radius", "5 mm",
                       ": the stiffness of the impact follows from it, unless contact.strike.stiffness is given");
    hertz_check(p, c, "the stiffness of the impact follows from it, unless contact.strike.stiffness is given");
}

static void train_check(const struct scene_part *p, const struct contact *c, const struct strike *s)
{
    const char *count = "contact.strike.count", *first = "contact.strike.first", *gravity = "contact.gravity",
               *bounce = "contact.strike.restitution";
    double lasts = motion_lasts(&c->motion);
    if (s->count > 1 && !scene_part_given(p, "contact.strike.interval") && !scene_part_given(p, bounce))
        scene_part_refuse(p, count, count, "add for instance: interval: 0.5 s; or restitution: 0.7 for a bounce train",
                          " is %d, and nothing says when the second impact comes", s->count);
    if (!isnan(s->restitution) && s->count != 1 && c->contact.gravity == 0)
        scene_part_refuse(p, gravity, bounce,
                          "raise contact.gravity, or give contact.strike.interval in place of restitution",
                          " is 0: what bounces never comes back");
    if (s->first >= lasts)
        scene_part_refuse(p, first, "motion.duration", "lower contact.strike.first, or let the motion last longer",
                          ": the first impact comes at %.4g s, and the motion lasts %.4g s", s->first, lasts);
}

static void check(const struct scene_part *p, const struct contact *c, const void *own)
{
    if (!scene_part_known(p, "contact.strike.pulse")) return;
    unit_check(p, own);
    stiffness_check(p, c, own);
    train_check(p, c, own);
}

static bool strikes(const struct contact *c) { return c->contact.model == CONTACT_STRIKE; }

static const struct params strike_params = {
    .section = "contact.strike",
    .size = sizeof(struct strike),
    .keys = keys,
    .alternative = {.most = 1, .paths = {"contact.strike.interval", "contact.strike.restitution"}},
    .check = check,
    .given = strikes,
};

static const struct strike *strike_of(const struct contact *c) { return params_of(c, &strike_params); }

/* ------------------------------------------------------------------ the impacts */

bool strike_stiffness(const struct contact *c, double *stiffness, struct err *e)
{
    *stiffness = strike_of(c)->stiffness;
    return !isnan(*stiffness) || hertz_stiffness(c, stiffness, e);
}

static bool strike_can(const struct contact *c, const struct strike_train *s, struct err *e)
{
    double lasts = strike_pulse_lasts(&s->shape, s->mass, s->stiffness, s->speed);
    if (s->most != 1 && s->interval < lasts)
        return err_set(e, ERR_SCENE,
                       "contact '%s': contact.strike.interval, %.4g s, is shorter than an impact, %.4g s: give a "
                       "longer one, or raise "
                       "contact.strike.stiffness",
                       c->name, s->interval, lasts);
    return s->first + lasts <= s->end || err_about(e, c->name, "motion.duration") ||
           err_set(e, ERR_SCENE,
                   "contact '%s': the first impact comes at %.4g s and lasts %.4g s, but the motion is over at %.4g s: "
                   "raise "
                   "motion.duration",
                   c->name, s->first, lasts, s->end);
}

bool strike_make(const struct contact *c, double duration, struct strike_train *s, struct err *e)
{
    const struct strike *given = strike_of(c);
    bool several = !isnan(given->interval) || !isnan(given->restitution);
    *s = (struct strike_train){.shape = strike_pulse_make(given->pulse),
                               .mass = c->scraper.mass,
                               .gravity = c->contact.gravity,
                               .end = duration,
                               .restitution = isnan(given->restitution) ? 1 : given->restitution,
                               .bounces = !isnan(given->restitution),
                               .first = given->first,
                               .interval = given->interval,
                               .most = given->count || several ? given->count : 1,
                               .time = given->first,
                               .speed = given->speed,
                               .flight = HUGE_VAL};
    return strike_stiffness(c, &s->stiffness, e) && strike_can(c, s, e);
}

bool strike_next(struct strike_train *s, struct strike_impact *i)
{
    double after = s->restitution * s->speed;
    *i = (struct strike_impact){s->time, s->speed, strike_pulse_lasts(&s->shape, s->mass, s->stiffness, s->speed),
                                s->mass * (s->speed + after)};
    if (s->over == STRIKE_GOES_ON)
        s->over = s->most && s->number == s->most ? STRIKE_COUNT
                  : s->flight < i->lasts          ? STRIKE_RESTS
                  : i->start + i->lasts > s->end  ? STRIKE_TIME
                                                  : STRIKE_GOES_ON;
    if (s->over != STRIKE_GOES_ON) return false;
    s->number++;
    if (s->bounces) {
        s->flight = 2 * after / s->gravity;
        s->time += i->lasts + s->flight;
        s->speed = after;
    } else
        s->time = s->first + (double)s->number * s->interval; /* NAN after a single one: it was the last */
    return true;
}

/* ------------------------------------------------------------------ the stage */

/* The stage that lays impacts on the board. The mean of a sub-interval is the momentum handed over in it, exactly
   (below), so that all of it arrives at any sample rate and oversampling, also when an impact is over within a
   fraction of a sub-interval. Times are counted from the sub-interval in which an impact begins: an hour into a scene
   they are as fine as at its start.

   The decimator spreads what is shorter than a sample to both sides, and folds what would come before the contact's
   start into the first samples (num/filter.h): an impact hands over all of its momentum wherever it begins.
   strike.first is 20 ms unless the scene says otherwise, so that output.ramp does not fade it in. */

struct striking {
    struct strike_train train;
    struct strike_impact now;
    bool any;           /* `now` is still to come, or going on               */
    double from, after; /* number of the sub-interval in which it begins; when in it, 0 to 1 */
    double length;      /* sub-intervals                                     */
    double share;       /* of its momentum handed over so far                */
};

static void striking_next(struct striking *s, double per_second)
{
    s->any = strike_next(&s->train, &s->now);
    s->from = floor(s->now.start * per_second);
    s->after = s->now.start * per_second - s->from;
    s->length = s->now.lasts * per_second;
    s->share = 0;
}

static double stage_work(const struct contact *c, const struct scene *s)
{
    (void)c;
    return 4 * s->accuracy.oversampling;
}

/* Impacts that were asked for and do not take place. */
static void warn_missing(struct stage_run *r, const struct strike_train *whole)
{
    struct strike_train s = *whole;
    struct strike_impact i;
    while (s.most > 0 && strike_next(&s, &i))
        continue;
    if (s.number < s.most)
        board_warn(r->board,
                   arena_format(r->arena, "contact '%s': %ld of %ld impacts take place: %s", r->contact->name, s.number,
                                s.most,
                                s.over == STRIKE_RESTS ? "what bounces has then come to rest"
                                                       : "the next one would not be over by the motion's end"));
}

static bool stage_open(struct stage_run *r, struct err *e)
{
    struct striking *s = ARENA_TAKE(r->arena, struct striking, 1);
    if (!strike_make(r->contact, r->board->trajectory->duration, &s->train, e)) return false;
    warn_missing(r, &s->train);
    approach_warn(r, "the first impact", s->train.first);
    striking_next(s, r->board->rate * r->board->over);
    r->state = s;
    return true;
}

/* Momentum over sub-interval k times the sub-rate: its mean force. */
static double striking_mean(struct striking *s, double k, double per_second)
{
    double force = 0;
    while (s->any) {
        double q = (k + 1 - s->from - s->after) / s->length, share = strike_pulse_share(&s->train.shape, q);
        force += s->now.momentum * per_second * (share - s->share);
        s->share = share;
        if (q < 1) break;
        striking_next(s, per_second);
    }
    return force;
}

static bool stage_fill(struct stage_run *r, long from, long to, struct err *e)
{
    struct striking *s = r->state;
    const struct board *b = r->board;
    double *force = board_at(b, ITEM_SUBFORCE, from), first = (double)(from * b->over);
    (void)e;
    for (long i = 0; i < (to - from) * b->over; i++)
        force[i] =
            s->any && first + (double)i + 1 > s->from ? striking_mean(s, first + (double)i, b->rate * b->over) : 0;
    return true;
}

const struct stage strike_stage = {
    .name = "strike",
    .does = "contact force of impacts",
    .paper = "",
    .idle = "contact.model is not strike",
    .params = &strike_params,
    .needs = ITEM_BIT(ITEM_MOTION), /* its duration */
    .gives = ITEM_BIT(ITEM_SUBFORCE),
    .knobs = KNOB_BIT(oversampling),
    .work = stage_work,
    .open = stage_open,
    .run = stage_fill,
};

/* Pulses of elastic impacts on a body that does not give way. With x the penetration, v the speed of arrival, m the
   mass, k the stiffness:

     half_sine   m x'' = -k x         f = v sqrt(k m) sin(t sqrt(k/m))       contact time t_c = pi sqrt(m/k)
     hertz       m x'' = -k x^1.5     x_m = (5 m v^2 / (4 k))^(2/5)          contact time t_c = 2.9432752 x_m / v
                                      largest force k x_m^1.5                2.9432752 = (4/5) B(2/5, 1/2), B Euler's
                                        beta function

   (H. Hertz 1882; K. Johnson, Contact Mechanics, 1985, section 11.4.) Either way the speed is reversed and the momentum
   handed over is 2 m v. What is wanted is exact means of the force over any interval: differences of the momentum
   handed over so far, m (v - x'). Its share of the whole is p = (1 - x'/v) / 2, a function of q = t / t_c alone:

     half_sine   p = sin^2(pi q / 2)
     hertz       y = x / x_m, s = t v / x_m:  y'' = -(5/4) y^1.5, y = s G(z), z = s^2.5, G analytic: the equation gives
                 G's series

       g_0 = 1,   g_{n+1} a (1 + a) = -(5/4) h_n,  a = 5 (n + 1) / 2,   sum h_n z^n = (sum g_n z^n)^1.5   (Miller's
         recurrence)
       p = -1/2 sum over n >= 1 of g_n (1 + 5 n / 2) z^n    for q <= 1/2;   p(q) = 1 - p(1 - q) beyond

   At q = 1/2, where it converges most slowly, terms fall by 11 and more; the first one left out is 2e-24. No power but
   s^2 sqrt(s) is taken. */

static void hertz_series(double term[PULSE_TERMS])
{
    double g[PULSE_TERMS + 1] = {1}, h[PULSE_TERMS + 1] = {1};
    for (int n = 1; n <= PULSE_TERMS; n++) {
        double a = 2.5 * n, sum = 0;
        g[n] = -1.25 * h[n - 1] / (a * (1 + a));
        for (int k = 1; k <= n; k++)
            sum += (2.5 * k - n) * g[k] * h[n - k];
        h[n] = sum / n;
        term[n - 1] = -0.5 * g[n] * (1 + a);
    }
}

struct pulse_shape strike_pulse_make(int kind)
{
    struct pulse_shape p = {.kind = kind, .scale = kind == PULSE_HERTZ ? 2.94327518432470455 : REAL_PI};
    if (kind == PULSE_HERTZ) hertz_series(p.term);
    return p;
}

double strike_pulse_lasts(const struct pulse_shape *p, double mass, double stiffness, double speed)
{
    if (p->kind == PULSE_HALF_SINE) return p->scale * sqrt(mass / stiffness);
    return p->scale * real_pow(1.25 * mass * speed * speed / stiffness, 0.4) / speed;
}

/* q <= 1/2 */
static double share_early(const struct pulse_shape *p, double q)
{
    double s = p->scale * q, z = s * s * sqrt(s), sum = 0;
    if (p->kind == PULSE_HALF_SINE) {
        s = real_sinpi(0.5 * q);
        return s * s;
    }
    for (int n = PULSE_TERMS - 1; n >= 0; n--)
        sum = (sum + p->term[n]) * z;
    return sum;
}

double strike_pulse_share(const struct pulse_shape *p, double q)
{
    if (q <= 0 || q >= 1) return q >= 1;
    return q <= 0.5 ? share_early(p, q) : 1 - share_early(p, 1 - q);
}

/* ------------------------------------------------------------------ raised cosines */

/* The covered area of a raised cosine, phi = (1 + cos(2 pi q)) / 2 on -1/2 < q < 1/2, over the whole, 1/2:

     share(q) = q + 1/2 + sin(2 pi q) / (2 pi). */

double strike_pulse_cosine(double q)
{
    if (q <= -0.5 || q >= 0.5) return q >= 0.5;
    return 0.5 + (q + real_sinpi(2 * q) / (2 * REAL_PI));
}

void strike_pulse_cosines(int n, double *q)
{
    double sine[PULSE_COSINES], unused[PULSE_COSINES];
    if (n < 1) return;
    for (int i = 0; i < n; i++) {
        q[i] = q[i] < -0.5 ? -0.5 : q[i] < 0.5 ? q[i] : 0.5; /* where the sine is 0 exactly */
        sine[i] = 2 * q[i];
    }
    vecmath_sincospi((size_t)n, sine, sine, unused);
    for (int i = 0; i < n; i++)
        q[i] = 0.5 + (q[i] + sine[i] / (2 * REAL_PI));
}
