/* The action space: the set P of papers/004 at an instant. On its disk of actions the share of an
   anchor that lies at theta_k = 0, 2 pi/3, 4 pi/3 (rub, scratch, roll) is

     s_k = (1 - r)/3 + r T(theta - theta_k),   T(t) = 1 - 3 |t| / (2 pi) for |t| < 2 pi/3, t taken round the circle,
                                               else 0     (equations 8 to 11)

   zeta, theta, means and filters are the sums of s_k times the anchors' values; the distributions of the white
   processes are mixtures with the shares (hence of area 1), from which one number of the uniform process draws by the
   inverse of the mixture's distribution function (impact_density.c). All poles stay within the unit circle: a1 is a
   weighted mean of the anchors'. What 004 does not say, and what is taken here:

     theta beyond 2 pi, negative r   taken round the circle; the other side
     modulation (not in 004's P)     its depth is roll's times roll's share; its rate is roll's everywhere
     a floor on amplitudes           002's A is above 0; where roll's share is 1, or for custom if it is asked for.
                                     Elsewhere the signs stay
     |A|^-theta near A = 0           |A| counts as at least 0.01 of the rms amplitude there (of the stationary series),
                                     and at least a tenth of what it
                                     counts as at the quietest anchor; where there is a floor, as the floor times 1 - m,
                                       within 0.001 to 0.01 of the rms amplitude */
#include "force/impact_law.h"

#include <math.h>

#include "force/impact_density.h"
#include "num/real.h"
#include "scene/rows.h"
#include "scene/scene_part.h"
#include "trajectory/series.h"

/* ------------------------------------------------------------------ parameters */

static const struct choice prototypes[] = {
    [PROTOTYPE_ROLL] =
        {"roll", "rolling of Conan et al. (2014a), from size, velocity and roughness (equations 16, 17, table I)"},
    [PROTOTYPE_RUB] = {"rub", "rubbing of Conan et al. (2014b): white signed force, an impact every 1/44100 s"},
    [PROTOTYPE_SCRATCH] =
        {"scratch",
         "scratching of Conan et al. (2014b): like rub, but the impacts come seldom, at exponential intervals"},
    [PROTOTYPE_SPACE] = {"space",
                         "a place on the disk of actions of Conan et al. (2014b), or a way over it: angle and radius"},
    [PROTOTYPE_CUSTOM] = {"custom", "what amplitude, interval, duration and modulation say"},
    {NULL, NULL}};

static const struct choice distributions[] = {
    [DISTRIBUTION_GAUSSIAN] = {"gaussian", "a normal one about 0"},
    [DISTRIBUTION_EXPONENTIAL] = {"exponential", "an exponential one from 0 up; its mean, which is its deviation, adds "
                                                 "to the series' mean"},
    [DISTRIBUTION_TABLE] = {"table", "the density in a CSV, straight between its rows"},
    {NULL, NULL}};

static const struct choice marginals[] = {
    [MARGINAL_AS_DRAWN] = {"as_drawn", "what the filter makes of the white process; draws below the floors are limited "
                                       "and counted"},
    [MARGINAL_LOGNORMAL] = {"lognormal", "log-normal with the same mean and variance, always above 0"},
    {NULL, NULL}};

static const struct choice processes[] = {
    [PROCESSES_ONE] =
        {"one", "one uniform process drives amplitudes and intervals, as Conan et al. (2014a) found in their model"},
    [PROCESSES_TWO] = {"two", "each has its own"},
    {NULL, NULL}};

#define IMPACTS "contact.model=impacts"
#define ROLLING "contact.impacts.prototype=roll|space|custom"
#define ROLL_SPACE "contact.impacts.prototype=roll|space"
#define RUB "contact.impacts.prototype=rub|space"
#define SCRATCH "contact.impacts.prototype=scratch|space"
#define STILL "!contact.impacts.space.walk"

/* Meanings of rows of both series, of both kinds of grains. */
#define ADDED ", to which what the filter makes of the white process is added; left out: the prototype's"
#define DEVIATION "standard deviation of the white process; left out: the prototype's"
#define A1 "a1 of the filter (1 + b1/z)/(1 + a1/z) (equation 13); left out: the prototype's, of custom 0"
#define B1 "b1 of the filter; left out: the prototype's, of custom 0"
#define TABLE "CSV with the columns value (in the unit of the mean) and density, of the white process"
#define NORMAL "standard deviation of the amplitudes, which are Gaussian about 0"
#define DULLER ": longer ones, of a duller force, evoke a bigger object"

static const struct key keys[] = {
    {ROW_CHOICE(impacts, prototype, "contact.impacts.prototype"), KEY_NONE, 0, 0, NULL, IMPACTS,
     "which statistics the impacts have", prototypes, .shown = "roll"},
    {ROW_NUMBER(impacts, size, "contact.impacts.size"), KEY_NONE, 0.1, 1, "0.5", ROLL_SPACE,
     "S of Conan et al. (2014a), the size of what rolls: durations 0.788 ms S A^-0.29 (equation 16)"},
    {ROW_NUMBER(impacts, velocity, "contact.impacts.velocity"), KEY_NONE, 0.1, 1, "0.5", ROLL_SPACE,
     "V of Conan et al. (2014a): the amplitudes are modulated at 3 V/S Hz (equation 17)"},
    {ROW_NUMBER(impacts, roughness, "contact.impacts.roughness"), KEY_NONE, 0, 1, "0.5", ROLL_SPACE,
     "rho of Conan et al. (2014a): the series' statistics between the two columns of their table I"},
    {ROW_NUMBER(impacts, unit_force, "contact.impacts.unit_force"), KEY_FORCE, 1e-12, 1e12, "1 N", IMPACTS,
     "force of an amplitude of 1"},
    {ROW_NUMBER(impacts, amplitude.mean, "contact.impacts.amplitude.mean"), KEY_NONE, -1e6, 1e6, "", ROLLING,
     "mean of the amplitudes" ADDED, .shown = "0.35"},
    {ROW_NUMBER(impacts, amplitude.deviation, "contact.impacts.amplitude.deviation"), KEY_NONE, 0, 1e6, "",
     "contact.impacts.amplitude.distribution=gaussian|exponential", DEVIATION, .shown = "0.04"},
    {ROW_NUMBER(impacts, amplitude.a1, "contact.impacts.amplitude.a1"), KEY_NONE, -0.9999, 0.9999, "", ROLLING, A1,
     .shown = "-0.95"},
    {ROW_NUMBER(impacts, amplitude.b1, "contact.impacts.amplitude.b1"), KEY_NONE, -10, 10, "", ROLLING, B1,
     .shown = "0.2"},
    {ROW_CHOICE(impacts, amplitude.distribution, "contact.impacts.amplitude.distribution"), KEY_NONE, 0, 0, "gaussian",
     ROLLING, "distribution of the white process", distributions},
    {ROW_FILE(impacts, amplitude.table, "contact.impacts.amplitude.table"), KEY_NONE, 0, 0, NULL,
     "contact.impacts.amplitude.distribution=table", TABLE, .shown = "amplitudes.csv"},
    {ROW_NUMBER(impacts, interval.mean, "contact.impacts.interval.mean"), KEY_TIME, -1e6, 1e6, "", ROLLING,
     "mean of the times from impact to impact" ADDED, .shown = "5 ms"},
    {ROW_NUMBER(impacts, interval.deviation, "contact.impacts.interval.deviation"), KEY_TIME, 0, 1e6, "",
     "contact.impacts.interval.distribution=gaussian|exponential", DEVIATION, .shown = "0.5 ms"},
    {ROW_NUMBER(impacts, interval.a1, "contact.impacts.interval.a1"), KEY_NONE, -0.9999, 0.9999, "", ROLLING, A1,
     .shown = "-0.95"},
    {ROW_NUMBER(impacts, interval.b1, "contact.impacts.interval.b1"), KEY_NONE, -10, 10, "", ROLLING, B1, .shown = "0"},
    {ROW_CHOICE(impacts, interval.distribution, "contact.impacts.interval.distribution"), KEY_NONE, 0, 0, "gaussian",
     ROLLING, "distribution of the white process", distributions},
    {ROW_FILE(impacts, interval.table, "contact.impacts.interval.table"), KEY_NONE, 0, 0, NULL,
     "contact.impacts.interval.distribution=table", TABLE, .shown = "intervals.csv"},
    {ROW_NUMBER(impacts, zeta, "contact.impacts.duration.zeta"), KEY_TIME, 1e-7, 10, "", ROLLING,
     "zeta: an impact of amplitude A lasts zeta |A|^-theta (equation 12); left out: the prototype's",
     .shown = "0.4 ms"},
    {ROW_NUMBER(impacts, theta, "contact.impacts.duration.theta"), KEY_NONE, 0, 2, "", ROLLING,
     "theta; 0: all last equally long; left out: the prototype's, of custom 0", .shown = "0.29"},
    {ROW_NUMBER(impacts, depth, "contact.impacts.modulation.depth"), KEY_NONE, 0, 1, "", ROLLING,
     "m of 1 + m sin(2 pi nu t), which multiplies the amplitudes before durations are taken from them; left out: the "
     "prototype's, 0.3 of roll and 0 of custom",
     .shown = "0.3"},
    {ROW_NUMBER(impacts, rate, "contact.impacts.modulation.rate"), KEY_FREQUENCY, 0, 1000, "", ROLLING,
     "nu; left out: the prototype's, 3 V/S Hz of roll", .shown = "3 Hz"},
    {ROW_NUMBER(impacts, least_amplitude, "contact.impacts.floor.amplitude"), KEY_NONE, 0, 1, "", ROLLING,
     "least amplitude, as a share of the mean: draws below it are limited, counted and reported. Left out, it is "
     "0.01 under roll. Under custom, and under space but at roll's own place, amplitudes then keep their sign, and "
     "only durations are taken from at least 0.01 of the rms amplitude",
     .shown = "0.01"},
    {ROW_NUMBER(impacts, least_interval, "contact.impacts.floor.interval"), KEY_TIME, 1e-6, 1, "22.6757 us", IMPACTS,
     "least time from impact to impact (a sample at 44.1 kHz unless given): shorter draws are limited, counted and "
     "reported"},
    {ROW_CHOICE(impacts, marginal, "contact.impacts.marginal"), KEY_NONE, 0, 0, "as_drawn",
     "contact.impacts.prototype=roll|custom", "distribution of amplitudes and intervals themselves", marginals},
    {ROW_CHOICE(impacts, processes, "contact.impacts.processes"), KEY_NONE, 0, 0, "one", IMPACTS,
     "what drives amplitudes and intervals", processes},
    {ROW_NUMBER(impacts, rub.deviation, "contact.impacts.rub.deviation"), KEY_NONE, 0, 1e6, "0.15", RUB, NORMAL},
    {ROW_NUMBER(impacts, rub.interval, "contact.impacts.rub.interval"), KEY_TIME, 1e-6, 10, "22.6757 us", RUB,
     "time from impact to impact: a sample at 44.1 kHz unless given, at any sample rate"},
    {ROW_NUMBER(impacts, rub.duration, "contact.impacts.rub.duration"), KEY_TIME, 1e-6, 0.1, "22.6757 us", RUB,
     "how long an impact lasts (Conan et al. 2014b: one sample; in seconds ours)" DULLER},
    {ROW_NUMBER(impacts, scratch.deviation, "contact.impacts.scratch.deviation"), KEY_NONE, 0, 1e6, "0.15", SCRATCH,
     NORMAL},
    {ROW_NUMBER(impacts, scratch.interval, "contact.impacts.scratch.interval"), KEY_TIME, 1e-6, 10, "10 ms", SCRATCH,
     "mean time from impact to impact, exponentially distributed (ours: seldom enough to hear single impacts, yet near "
     "roll's 3.1 to 6.4 ms)"},
    {ROW_NUMBER(impacts, scratch.duration, "contact.impacts.scratch.duration"), KEY_TIME, 1e-6, 0.1, "22.6757 us",
     SCRATCH, "how long an impact lasts (ours: as rub's)" DULLER},
    {ROW_NUMBER(impacts, angle, "contact.impacts.space.angle"), KEY_ANGLE, -1000, 1000, "0 deg", STILL,
     "place on the disk of actions: rub at 0, scratch at 120, roll at 240 degrees on its rim"},
    {ROW_NUMBER(impacts, radius, "contact.impacts.space.radius"), KEY_NONE, -1, 1, "1", STILL,
     "1: on the rim; 0: the mean of all three; below 0: on the other side"},
    {ROW_NUMBER(impacts, angle_to, "contact.impacts.space.angle_to"), KEY_ANGLE, -1000, 1000, "", STILL,
     "angle at the motion's end, reached evenly; left out: it stays", .shown = "-120 deg"},
    {ROW_NUMBER(impacts, radius_to, "contact.impacts.space.radius_to"), KEY_NONE, -1, 1, "", STILL,
     "radius at the motion's end; left out: it stays", .shown = "0.5"},
    {ROW_FILE(impacts, walk, "contact.impacts.space.walk"), KEY_NONE, 0, 0, "", "contact.impacts.prototype=space",
     "the way over the disk: CSV with the columns time_s, angle_deg, radius, straight between its rows",
     .shown = "walk.csv"},
    {.path = NULL}};

static void draws_missing(const struct scene_part *p, const struct impact_draws *d, const char *series,
                          const char *mean, const char *deviation)
{
    struct arena *a = p->yaml->arena;
    static const char because[] = ": of custom nothing is known that is not given";
    scene_part_missing(p, arena_format(a, "contact.impacts.%s.mean", series), mean, because);
    if (d->distribution != DISTRIBUTION_TABLE &&
        scene_part_known(p, arena_format(a, "contact.impacts.%s.distribution", series)))
        scene_part_missing(p, arena_format(a, "contact.impacts.%s.deviation", series), deviation, because);
}

static void modulation_check(const struct scene_part *p, const struct impacts *m)
{
    const char *rate = "contact.impacts.modulation.rate";
    if (m->depth > 0)
        scene_part_missing(p, rate, "5 Hz", ": contact.impacts.modulation.depth is above 0");
    else if (scene_part_given(p, rate) && !isnan(m->rate))
        scene_part_refuse(
            p, rate, rate, "remove it, or give contact.impacts.modulation.depth",
            " has no effect where contact.impacts.modulation.depth is 0, as it is of custom unless given");
}

static void custom_check(const struct scene_part *p, const struct impacts *m)
{
    draws_missing(p, &m->amplitude, "amplitude", "0.3", "0.05");
    draws_missing(p, &m->interval, "interval", "5 ms", "1 ms");
    scene_part_missing(p, "contact.impacts.duration.zeta", "0.4 ms", ": of custom nothing is known that is not given");
    modulation_check(p, m);
}

/* What the series adds up to on average: its mean, and what the filter makes of the white process'; NAN: the prototype
 * or a file tells. */
static double mean_of(const struct impact_draws *d)
{
    double a1 = isnan(d->a1) ? 0 : d->a1, b1 = isnan(d->b1) ? 0 : d->b1;
    if (d->distribution == DISTRIBUTION_GAUSSIAN) return d->mean;
    return d->distribution == DISTRIBUTION_EXPONENTIAL ? d->mean + d->deviation * (1 + b1) / (1 + a1) : NAN;
}

static void interval_check(const struct scene_part *p, const struct impacts *m)
{
    const char *mean = "contact.impacts.interval.mean", *floor = "contact.impacts.floor.interval";
    double every = mean_of(&m->interval);
    if (every <= 0)
        scene_part_refuse(p, mean, mean, "raise it; write for instance: interval: {mean: 5 ms, deviation: 1 ms}",
                          ": impacts would come every %.4g s on average, and must come at times that rise", every);
    else if (every < m->least_interval)
        scene_part_refuse(p, mean, floor, "raise it, or lower contact.impacts.floor.interval",
                          ": impacts would come every %.4g s on average, and the least interval, %s, is %.4g s", every,
                          scene_part_label(p, floor), m->least_interval);
}

/* Of a rub or a scratch, alone or on the disk. */
static void grain_check(const struct scene_part *p, const struct impacts *m, const char *interval, double every)
{
    const char *floor = "contact.impacts.floor.interval";
    if (every < m->least_interval)
        scene_part_refuse(p, interval, floor, arena_format(p->yaml->arena, "raise %s, or lower %s", interval, floor),
                          ", %.4g s, is below the least interval, %s, %.4g s", every, scene_part_label(p, floor),
                          m->least_interval);
}

static void amplitude_check(const struct scene_part *p, const struct impacts *m)
{
    const char *mean = "contact.impacts.amplitude.mean", *floor = "contact.impacts.floor.amplitude";
    double height = mean_of(&m->amplitude);
    if (!(height <= 0)) return;
    if (m->least_amplitude > 0)
        scene_part_refuse(p, floor, mean, "remove floor.amplitude: amplitudes then keep their sign",
                          " is a share of the mean, and that is %.4g", height);
    else if (m->prototype == PROTOTYPE_ROLL)
        scene_part_refuse(
            p, mean, mean, "raise it, or set contact.impacts.prototype to custom, whose amplitudes may have any sign",
            " must be such that amplitudes are above 0 on average where contact.impacts.prototype is roll");
}

static void lognormal_check(const struct scene_part *p, const struct impact_draws *d, const char *series)
{
    const char *marginal = "contact.impacts.marginal",
               *distribution = arena_format(p->yaml->arena, "contact.impacts.%s.distribution", series);
    const char *mean = arena_format(p->yaml->arena, "contact.impacts.%s.mean", series);
    if (d->distribution != DISTRIBUTION_GAUSSIAN && scene_part_known(p, distribution))
        scene_part_refuse(
            p, distribution, marginal, "leave the distribution out, or set contact.impacts.marginal to as_drawn",
            " must be gaussian where %s is lognormal: a log-normal series is the exponential of a Gaussian one",
            scene_part_label(p, marginal));
    else if (d->mean <= 0)
        scene_part_refuse(p, mean, marginal, "raise it, or set contact.impacts.marginal to as_drawn",
                          " must be above 0 where %s is lognormal", scene_part_label(p, marginal));
}

static void series_check(const struct scene_part *p, const struct impacts *m)
{
    bool custom = m->prototype == PROTOTYPE_CUSTOM, space = m->prototype == PROTOTYPE_SPACE;
    if (custom) custom_check(p, m);
    if (custom || space || m->prototype == PROTOTYPE_ROLL) {
        interval_check(p, m);
        amplitude_check(p, m);
    }
    if (space || m->prototype == PROTOTYPE_RUB) grain_check(p, m, "contact.impacts.rub.interval", m->rub.interval);
    if (space || m->prototype == PROTOTYPE_SCRATCH)
        grain_check(p, m, "contact.impacts.scratch.interval", m->scratch.interval);
    if (m->marginal == MARGINAL_LOGNORMAL && scene_part_known(p, "contact.impacts.marginal")) {
        lognormal_check(p, &m->amplitude, "amplitude");
        lognormal_check(p, &m->interval, "interval");
    }
}

static void check(const struct scene_part *p, const struct contact *c, const void *own)
{
    const char *prototype = "contact.impacts.prototype";
    (void)c;
    if (scene_part_given(p, prototype) && scene_part_known(p, prototype)) series_check(p, own);
}

static bool draws_impacts(const struct contact *c) { return c->contact.model == CONTACT_IMPACTS; }

const struct params impact_law_params = {
    .section = "contact.impacts",
    .size = sizeof(struct impacts),
    .keys = keys,
    .check = check,
    .given = draws_impacts,
};

const struct impacts *impact_law_given(const struct contact *c) { return params_of(c, &impact_law_params); }

/* ------------------------------------------------------------------ the prototypes */

/* Values of the prototypes, times in s, whatever the sample rate:

            amplitude: mean, white process  interval: mean, white process     filters   zeta           theta  m
   rub      0, normal, rub.deviation        0, always rub.interval            none      rub.duration       0  0
   scratch  0, normal, scratch.deviation    0, exponential, scratch.interval  none      scratch.duration   0  0
   roll     002's table I, normal           002's table I, normal             table I   7.88e-4 s S     0.29  0.3
   custom   as given                        as given                          as given  as given              given

   zeta of roll is equation 16, its nu 3 V/S (Hz, equation 17); custom's nu is as given.

   Table I holds its two columns, rho = 0 and 1; between them all is linear in rho, as 002 has it. What a scene gives
   itself of amplitude, interval, duration and modulation takes the place of roll's values.

   004 prints of rub an impact at each sample that lasts one sample, of scratch nothing but that intervals are
   exponential. Ours, the defaults of the keys: rub 22.6757 us, 004's sample at 44.1 kHz, at whatever rate is rendered;
   scratch 10 ms, 100 impacts a second, sparse enough for single impacts to be heard, as 004 asks of scratching, and
   near roll's (1/6.4 to 1/3.1 ms), so that the two differ by order more than by density; deviations 0.15, of the size
   of roll's series (0.18 to 0.14).

   Amplitudes of rub and scratch that are normal about 0 and independent: the spectrum of the force is that of white
   noise, deviation^2 / interval, times |Phi|^2, Phi the spectrum of one impact; no lines, and nothing of a
   sample rate. */

static const double table_1[2][IMPACT_SERIES][4] = {
    /* [rho][series]: deviation, a1, b1, mean; 1 and s */
    {{0.04, -0.97, 0.07, 0.43}, {0.19e-3, -0.97, -0.34, 3.1e-3}},
    {{0.04, -0.93, 0.32, 0.27}, {0.85e-3, -0.93, 0.35, 6.4e-3}},
};

static double given_or(double given, double otherwise) { return isnan(given) ? otherwise : given; }

static struct impact_density *anchors_density(const struct impact_draws *d, double deviation, struct arena *a,
                                              struct err *e)
{
    deviation = given_or(d->deviation, deviation);
    if (d->distribution == DISTRIBUTION_TABLE) return impact_density_table(d->table, a, e);
    return d->distribution == DISTRIBUTION_EXPONENTIAL ? impact_density_exponential(deviation, a)
                                                       : impact_density_gaussian(deviation, a);
}

static bool anchors_roll(const struct impacts *m, struct arena *a, struct impact_law *l, struct err *e)
{
    struct impact_parameters *p = &l->anchor[IMPACT_ROLL];
    bool custom = m->prototype == PROTOTYPE_CUSTOM;
    for (int s = 0; s < IMPACT_SERIES; s++) {
        const struct impact_draws *d = s == IMPACT_AMPLITUDE ? &m->amplitude : &m->interval;
        double row[4] = {0};
        for (int i = 0; i < 4 && !custom; i++)
            row[i] = (1 - m->roughness) * table_1[0][s][i] + m->roughness * table_1[1][s][i];
        l->density[IMPACT_ROLL][s] = anchors_density(d, row[0], a, e);
        if (!l->density[IMPACT_ROLL][s]) return false;
        p->a1[s] = given_or(d->a1, row[1]);
        p->b1[s] = given_or(d->b1, row[2]);
        p->mean[s] = given_or(d->mean, row[3]);
    }
    p->zeta = given_or(m->zeta, 7.88e-4 * m->size);
    p->theta = given_or(m->theta, custom ? 0 : 0.29);
    p->depth = given_or(m->depth, custom ? 0 : 0.3);
    p->rate = given_or(m->rate, custom ? 0 : 3 * m->velocity / m->size);
    return true;
}

static void anchors_grain(const struct impact_grain *g, int anchor, struct arena *a, struct impact_law *l)
{
    l->density[anchor][IMPACT_AMPLITUDE] = impact_density_gaussian(g->deviation, a);
    l->density[anchor][IMPACT_INTERVAL] =
        anchor == IMPACT_RUB ? impact_density_point(g->interval, a) : impact_density_exponential(g->interval, a);
    l->anchor[anchor].zeta = g->duration;
}

static bool anchors_make(const struct contact *c, struct arena *a, struct impact_law *l, struct err *e)
{
    static const int alone[] = {[PROTOTYPE_RUB] = IMPACT_RUB,
                                [PROTOTYPE_SCRATCH] = IMPACT_SCRATCH,
                                [PROTOTYPE_ROLL] = IMPACT_ROLL,
                                [PROTOTYPE_CUSTOM] = IMPACT_ROLL,
                                [PROTOTYPE_SPACE] = -1};
    const struct impacts *m = impact_law_given(c);
    l->alone = alone[m->prototype];
    for (int k = 0; k < IMPACT_ANCHORS; k++)
        l->anchor[k].share[k] = 1;
    if (l->alone < 0 || l->alone == IMPACT_RUB) anchors_grain(&m->rub, IMPACT_RUB, a, l);
    if (l->alone < 0 || l->alone == IMPACT_SCRATCH) anchors_grain(&m->scratch, IMPACT_SCRATCH, a, l);
    if (l->alone < 0 && m->rub.deviation == m->scratch.deviation) /* one distribution: no mixture between them */
        l->density[IMPACT_SCRATCH][IMPACT_AMPLITUDE] = l->density[IMPACT_RUB][IMPACT_AMPLITUDE];
    return (l->alone >= 0 && l->alone != IMPACT_ROLL) || anchors_roll(m, a, l, e);
}

/* ------------------------------------------------------------------ a place that moves */

/* Straight means in angle and radius: from angle 0 to 360 degrees is once round; from radius 1 to -1 is through the
   centre to the other side. Times count from the contact's start. */

static bool walk_read(const char *file, struct arena *a, struct impact_law *l, struct err *e)
{
    static const char *const columns[2] = {"angle_deg", "radius"};
    struct series s;
    if (!series_read(file, columns, a, &s, e)) return false;
    l->steps = (int)s.n;
    l->walk = ARENA_TAKE(a, double, 3 * s.n);
    for (size_t i = 0; i < s.n; i++) {
        if (!(fabs(s.x[1][i]) <= 1))
            return err_set(e, ERR_SCENE, "%s:%d: column 'radius': %.9g lies outside the disk; a radius is in -1 .. 1",
                           file, s.lines[i], s.x[1][i]);
        l->walk[3 * i] = s.time[i];
        l->walk[3 * i + 1] = s.x[0][i] * (REAL_PI / 180);
        l->walk[3 * i + 2] = s.x[1][i];
    }
    return true;
}

static bool walk_make(const struct contact *c, double duration, struct arena *a, struct impact_law *l, struct err *e)
{
    const struct impacts *m = impact_law_given(c);
    if (m->walk) return walk_read(m->walk, a, l, e);
    l->steps = duration > 0 && (!isnan(m->angle_to) || !isnan(m->radius_to)) ? 2 : 1;
    l->walk = ARENA_TAKE(a, double, 6);
    l->walk[1] = m->angle;
    l->walk[2] = m->radius;
    l->walk[3] = duration;
    l->walk[4] = isnan(m->angle_to) ? m->angle : m->angle_to;
    l->walk[5] = isnan(m->radius_to) ? m->radius : m->radius_to;
    return true;
}

static void walk_at(const struct impact_law *l, double t, double *angle, double *radius)
{
    const double *w = l->walk;
    int low = 0, high = l->steps - 1;
    if (t >= w[3 * high]) low = high;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (w[3 * middle] <= t)
            low = middle;
        else
            high = middle;
    }
    w += 3 * low;
    double share = low == high || t <= w[0] ? 0 : (t - w[0]) / (w[3] - w[0]);
    *angle = share > 0 ? w[1] + share * (w[4] - w[1]) : w[1];
    *radius = share > 0 ? w[2] + share * (w[5] - w[2]) : w[2];
}

/* ------------------------------------------------------------------ at a place */

void impact_law_shares(double angle, double radius, double share[IMPACT_ANCHORS])
{
    double third = angle * (3 / (2 * REAL_PI)) + (radius < 0 ? 1.5 : 0), r = fabs(radius); /* thirds of a turn */
    if (fabs(third - rint(third)) <= 1e-12)
        third = rint(third); /* an anchor is an anchor: angles in degrees are rounded */
    third -= 3 * floor(third / 3);
    for (int k = 0; k < IMPACT_ANCHORS; k++) {
        double t = fabs(third - k);
        share[k] = (1 - r) / 3 + r * fmax(1 - fmin(t, 3 - t), 0);
    }
}

static struct impact_mixture law_mixture(const struct impact_law *l, enum impact_series_of which,
                                         const struct impact_parameters *p)
{
    struct impact_mixture m = {0};
    for (int k = 0; k < IMPACT_ANCHORS; k++) {
        int same = 0;
        if (!(p->share[k] > 0)) continue;
        while (same < m.n && m.part[same] != l->density[k][which])
            same++;
        m.part[same] = l->density[k][which];
        m.share[same] += p->share[k];
        m.n += same == m.n;
    }
    return m;
}

double impact_law_draw(const struct impact_law *l, enum impact_series_of which, const struct impact_parameters *p,
                       double w)
{
    for (int k = 0; k < IMPACT_ANCHORS; k++)
        if (p->share[k] == 1) return impact_density_quantile(l->density[k][which], w);
    struct impact_mixture m = law_mixture(l, which, p);
    return m.n == 1 ? impact_density_quantile(m.part[0], w) : impact_density_mixed(&m, w);
}

void impact_law_moments(const struct impact_law *l, enum impact_series_of which, const struct impact_parameters *p,
                        double *mean, double *variance)
{
    struct impact_mixture m = law_mixture(l, which, p);
    impact_density_moments(&m, mean, variance);
}

void impact_law_stationary(const struct impact_law *l, enum impact_series_of which, const struct impact_parameters *p,
                           double *mean, double *variance)
{
    double a1 = p->a1[which], b1 = p->b1[which], white_mean, white_variance;
    impact_law_moments(l, which, p, &white_mean, &white_variance);
    *mean = p->mean[which] + white_mean * (1 + b1) / (1 + a1);
    *variance = white_variance * (1 + b1 * b1 - 2 * a1 * b1) / (1 - a1 * a1);
}

static double law_rms(const struct impact_law *l, const struct impact_parameters *p)
{
    double mean, variance;
    impact_law_stationary(l, IMPACT_AMPLITUDE, p, &mean, &variance);
    return sqrt(mean * mean + variance);
}

/* ------------------------------------------------------------------ at an instant */

/* On the disk, no anchor. */
static void law_between(const struct impact_law *l, struct impact_parameters *p)
{
    double quietest = HUGE_VAL;
    for (int k = 0; k < IMPACT_ANCHORS; k++) {
        const struct impact_parameters *q = &l->anchor[k];
        double share = p->share[k];
        p->zeta += share * q->zeta;
        p->theta += share * q->theta;
        for (int s = 0; s < IMPACT_SERIES; s++) {
            p->mean[s] += share * q->mean[s];
            p->a1[s] += share * q->a1[s];
            p->b1[s] += share * q->b1[s];
        }
        quietest = fmin(quietest, q->shortest);
    }
    p->depth = p->share[IMPACT_ROLL] * l->anchor[IMPACT_ROLL].depth;
    p->rate = l->anchor[IMPACT_ROLL].rate;
    p->least_amplitude = -HUGE_VAL;
    p->shortest = fmax(0.01 * law_rms(l, p), 0.1 * quietest);
}

void impact_law_at(const struct impact_law *l, double t, struct impact_parameters *p)
{
    double angle, radius;
    if (l->alone >= 0) {
        *p = l->anchor[l->alone];
        return;
    }
    *p = (struct impact_parameters){0};
    walk_at(l, fmax(t, 0), &angle, &radius);
    impact_law_shares(angle, radius, p->share);
    for (int k = 0; k < IMPACT_ANCHORS; k++)
        if (p->share[k] == 1) {
            *p = l->anchor[k];
            return;
        }
    law_between(l, p);
}

/* ------------------------------------------------------------------ making */

/* least_amplitude and shortest of anchor k. */
static bool law_floor(const struct contact *c, int k, struct impact_law *l, struct err *e)
{
    const struct impacts *m = impact_law_given(c);
    struct impact_parameters *p = &l->anchor[k];
    double share = isnan(m->least_amplitude) && m->prototype != PROTOTYPE_CUSTOM ? 0.01 : m->least_amplitude, mean,
           variance, rms = law_rms(l, p);
    p->least_amplitude = -HUGE_VAL;
    p->shortest = rms > 0 ? 0.01 * rms : 1;
    if (k != IMPACT_ROLL || isnan(share)) return true;
    impact_law_stationary(l, IMPACT_AMPLITUDE, p, &mean, &variance);
    if (!(mean > 0))
        return err_set(e, ERR_SCENE,
                       "%s: the mean amplitude is %.6g, and contact.impacts.floor.amplitude is a share of it; give a "
                       "mean above 0, or prototype: custom "
                       "without a floor",
                       c->name, mean);
    p->least_amplitude = share * mean;
    if (share > 0) p->shortest = fmax(fmin(p->least_amplitude * (1 - p->depth), 0.01 * rms), 0.001 * rms);
    return true;
}

/* A duration that no impact surpasses: where the place stays its own; else zeta and theta are at most the greatest
   anchor's, and |A| counts as at least a tenth of the least anchor's `shortest`. */
static double law_longest(const struct impact_law *l)
{
    double zeta = 0, theta = 0, shortest = HUGE_VAL;
    if (l->steps <= 1) {
        struct impact_parameters p;
        impact_law_at(l, 0, &p);
        return p.zeta * real_pow(p.shortest, -p.theta) * (1 + 1e-12);
    }
    for (int k = 0; k < IMPACT_ANCHORS; k++) {
        zeta = fmax(zeta, l->anchor[k].zeta);
        theta = fmax(theta, l->anchor[k].theta);
        shortest = fmin(shortest, l->anchor[k].shortest);
    }
    return zeta * fmax(real_pow(0.1 * shortest, -theta), 1) * (1 + 1e-12);
}

bool impact_law_make(const struct contact *c, double duration, struct arena *a, struct impact_law *l, struct err *e)
{
    const struct impacts *m = impact_law_given(c);
    *l = (struct impact_law){
        .unit_force = m->unit_force, .least_interval = m->least_interval, .two = m->processes == PROCESSES_TWO};
    if (!anchors_make(c, a, l, e)) return false;
    l->lognormal = l->alone == IMPACT_ROLL && m->marginal == MARGINAL_LOGNORMAL;
    for (int k = 0; k < IMPACT_ANCHORS; k++)
        if (l->density[k][IMPACT_AMPLITUDE] && !law_floor(c, k, l, e)) return false;
    for (int k = 0; k < IMPACT_ANCHORS && l->alone < 0; k++)
        l->anchor[k].rate = l->anchor[IMPACT_ROLL].rate; /* its phase goes on where its depth is 0 */
    if (l->alone < 0 && !walk_make(c, duration, a, l, e)) return false;
    l->longest = law_longest(l);
    return true;
}
