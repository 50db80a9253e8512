/* The set P of papers/004 at an instant. On its disk of actions the share of an anchor that lies at theta_k = 0, 2
   pi/3, 4 pi/3 (rub, scratch, roll) is

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

#include "force/impact_anchors.h"
#include "force/impact_density.h"
#include "force/impact_walk.h"
#include "num/real.h"

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
    impact_walk_at(l, fmax(t, 0), &angle, &radius);
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
    if (!impact_anchors_make(c, a, l, e)) return false;
    l->lognormal = l->alone == IMPACT_ROLL && m->marginal == MARGINAL_LOGNORMAL;
    for (int k = 0; k < IMPACT_ANCHORS; k++)
        if (l->density[k][IMPACT_AMPLITUDE] && !law_floor(c, k, l, e)) return false;
    if (!law_marginal(c, l, e)) return false;
    for (int k = 0; k < IMPACT_ANCHORS && l->alone < 0; k++)
        l->anchor[k].rate = l->anchor[IMPACT_ROLL].rate; /* its phase goes on where its depth is 0 */
    if (l->alone < 0 && !impact_walk_make(c, duration, a, l, e)) return false;
    l->longest = law_longest(l);
    return true;
}
