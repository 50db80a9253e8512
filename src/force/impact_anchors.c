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
#include "force/impact_anchors.h"

#include <math.h>

#include "force/impact_density.h"

static const double table_1[2][IMPACT_SERIES][4] = {
    /* [rho][series]: deviation, a1, b1, mean; 1 and s */
    {{0.04, -0.97, 0.07, 0.43}, {0.19e-3, -0.97, -0.34, 3.1e-3}},
    {{0.04, -0.93, 0.32, 0.27}, {0.85e-3, -0.93, 0.35, 6.4e-3}},
};

static double given_or(double given, double otherwise) { return isnan(given) ? otherwise : given; }

/* ------------------------------------------------------------------ rolling and custom */

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

/* ------------------------------------------------------------------ rubbing and scratching */

static void anchors_grain(const struct impact_grain *g, int anchor, struct arena *a, struct impact_law *l)
{
    l->density[anchor][IMPACT_AMPLITUDE] = impact_density_gaussian(g->deviation, a);
    l->density[anchor][IMPACT_INTERVAL] =
        anchor == IMPACT_RUB ? impact_density_point(g->interval, a) : impact_density_exponential(g->interval, a);
    l->anchor[anchor].zeta = g->duration;
}

bool impact_anchors_make(const struct contact *c, struct arena *a, struct impact_law *l, struct err *e)
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
