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
#include "trajectory/series.h"

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

static bool anchors_needs(double value, const char *key, struct err *e)
{
    return !isnan(value) ||
           err_set(e, ERR_SCENE,
                   "contact.impacts.%s is missing: prototype custom takes nothing from elsewhere; give it", key);
}

static bool anchors_complete(const struct impacts *m, struct err *e)
{
    return anchors_needs(m->amplitude.mean, "amplitude.mean", e) &&
           anchors_needs(m->interval.mean, "interval.mean", e) && anchors_needs(m->zeta, "duration.zeta", e) &&
           (m->amplitude.distribution == DISTRIBUTION_TABLE ||
            anchors_needs(m->amplitude.deviation, "amplitude.deviation", e)) &&
           (m->interval.distribution == DISTRIBUTION_TABLE ||
            anchors_needs(m->interval.deviation, "interval.deviation", e));
}

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
    if (custom && !anchors_complete(m, e)) return false;
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
    const struct impacts *m = &c->contact.impacts;
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
    const struct impacts *m = &c->contact.impacts;
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
    const struct impacts *m = &c->contact.impacts;
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

static bool law_marginal(const struct contact *c, const struct impact_law *l, struct err *e)
{
    static const char *const words[IMPACT_SERIES] = {"amplitude", "interval"};
    for (int s = 0; s < IMPACT_SERIES && l->lognormal; s++) {
        double mean, variance;
        int kind = l->density[l->alone][s]->kind;
        impact_law_stationary(l, s, &l->anchor[l->alone], &mean, &variance);
        if (!(mean > 0) || kind == IMPACT_DENSITY_EXPONENTIAL || kind == IMPACT_DENSITY_TABLE)
            return err_set(e, ERR_SCENE,
                           "%s: contact.impacts.marginal: lognormal needs contact.impacts.%s.mean above 0 and "
                           "distribution: gaussian",
                           c->name, words[s]);
    }
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
    const struct impacts *m = &c->contact.impacts;
    *l = (struct impact_law){
        .unit_force = m->unit_force, .least_interval = m->least_interval, .two = m->processes == PROCESSES_TWO};
    if (!anchors_make(c, a, l, e)) return false;
    l->lognormal = l->alone == IMPACT_ROLL && m->marginal == MARGINAL_LOGNORMAL;
    for (int k = 0; k < IMPACT_ANCHORS; k++)
        if (l->density[k][IMPACT_AMPLITUDE] && !law_floor(c, k, l, e)) return false;
    if (!law_marginal(c, l, e)) return false;
    for (int k = 0; k < IMPACT_ANCHORS && l->alone < 0; k++)
        l->anchor[k].rate = l->anchor[IMPACT_ROLL].rate; /* its phase goes on where its depth is 0 */
    if (l->alone < 0 && !walk_make(c, duration, a, l, e)) return false;
    l->longest = law_longest(l);
    return true;
}
