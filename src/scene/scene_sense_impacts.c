/* What a series of impacts needs, and values of it that make no sense together. */
#include <math.h>

#include "scene/keys.h"
#include "scene/rules.h"
#include "scene/scene_check.h"
#include "scene/scene_sense_parts.h"

static bool is_given(const struct scene_part *p, const char *path) { return yaml_find(p->map, path) != NULL; }

/* Told at a value that is there. */
static void refuse(const struct scene_part *p, const char *path, const char *cure, const char *says)
{
    diag_add(p->yaml->diag, scene_part_later(p, path, path), cure, "%s %s", scene_part_label(p, path), says);
}

/* ------------------------------------------------------------------ what a custom series needs */

static void draws_missing(const struct scene_part *p, const struct impact_draws *d, const char *series,
                          const char *mean, const char *deviation)
{
    struct arena *a = p->yaml->arena;
    static const char because[] = ": of custom nothing is known that is not given";
    scene_check_missing(p, arena_format(a, "contact.impacts.%s.mean", series), mean, because);
    if (d->distribution != DISTRIBUTION_TABLE &&
        scene_part_known(p, arena_format(a, "contact.impacts.%s.distribution", series)))
        scene_check_missing(p, arena_format(a, "contact.impacts.%s.deviation", series), deviation, because);
}

static void modulation_check(const struct scene_part *p, const struct impacts *m)
{
    const char *rate = "contact.impacts.modulation.rate";
    if (m->depth > 0)
        scene_check_missing(p, rate, "5 Hz", ": contact.impacts.modulation.depth is above 0");
    else if (is_given(p, rate) && !isnan(m->rate))
        refuse(p, rate, "remove it, or give contact.impacts.modulation.depth",
               "has no effect where contact.impacts.modulation.depth is 0, as it is of custom unless given");
}

static void custom_check(const struct scene_part *p, const struct impacts *m)
{
    draws_missing(p, &m->amplitude, "amplitude", "0.3", "0.05");
    draws_missing(p, &m->interval, "interval", "5 ms", "1 ms");
    scene_check_missing(p, "contact.impacts.duration.zeta", "0.4 ms", ": of custom nothing is known that is not given");
    modulation_check(p, m);
}

/* ------------------------------------------------------------------ means and floors */

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
        diag_add(p->yaml->diag, scene_part_later(p, mean, mean),
                 "raise it; write for instance: interval: {mean: 5 ms, deviation: 1 ms}",
                 "%s: impacts would come every %.4g s on average, and must come at times that rise",
                 scene_part_label(p, mean), every);
    else if (every < m->least_interval)
        diag_add(p->yaml->diag, scene_part_later(p, mean, floor), "raise it, or lower contact.impacts.floor.interval",
                 "%s: impacts would come every %.4g s on average, and the least interval, %s, is %.4g s",
                 scene_part_label(p, mean), every, scene_part_label(p, floor), m->least_interval);
}

/* Of a rub or a scratch, alone or on the disk. */
static void grain_check(const struct scene_part *p, const struct impacts *m, const char *interval, double every)
{
    const char *floor = "contact.impacts.floor.interval";
    if (every < m->least_interval)
        diag_add(p->yaml->diag, scene_part_later(p, interval, floor),
                 arena_format(p->yaml->arena, "raise %s, or lower %s", interval, floor),
                 "%s, %.4g s, is below the least interval, %s, %.4g s", scene_part_label(p, interval), every,
                 scene_part_label(p, floor), m->least_interval);
}

static void amplitude_check(const struct scene_part *p, const struct impacts *m)
{
    const char *mean = "contact.impacts.amplitude.mean", *floor = "contact.impacts.floor.amplitude";
    double height = mean_of(&m->amplitude);
    if (!(height <= 0)) return;
    if (m->least_amplitude > 0)
        diag_add(p->yaml->diag, scene_part_later(p, floor, mean),
                 "remove floor.amplitude: amplitudes then keep their sign",
                 "%s is a share of the mean, and that is %.4g", scene_part_label(p, floor), height);
    else if (m->prototype == PROTOTYPE_ROLL)
        refuse(p, mean, "raise it, or set contact.impacts.prototype to custom, whose amplitudes may have any sign",
               "must be such that amplitudes are above 0 on average where contact.impacts.prototype is roll");
}

/* ------------------------------------------------------------------ log-normal series */

static void lognormal_check(const struct scene_part *p, const struct impact_draws *d, const char *series)
{
    const char *marginal = "contact.impacts.marginal",
               *distribution = arena_format(p->yaml->arena, "contact.impacts.%s.distribution", series);
    const char *mean = arena_format(p->yaml->arena, "contact.impacts.%s.mean", series);
    if (d->distribution != DISTRIBUTION_GAUSSIAN && scene_part_known(p, distribution))
        diag_add(p->yaml->diag, scene_part_later(p, distribution, marginal),
                 "leave the distribution out, or set contact.impacts.marginal to as_drawn",
                 "%s must be gaussian where %s is lognormal: a log-normal series is the exponential of a Gaussian one",
                 scene_part_label(p, distribution), scene_part_label(p, marginal));
    else if (d->mean <= 0)
        diag_add(p->yaml->diag, scene_part_later(p, mean, marginal),
                 "raise it, or set contact.impacts.marginal to as_drawn", "%s must be above 0 where %s is lognormal",
                 scene_part_label(p, mean), scene_part_label(p, marginal));
}

/* ------------------------------------------------------------------ a series of impacts */

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

void scene_sense_impacts(const struct scene_part *p, const struct contact *c)
{
    if (c->contact.model == CONTACT_IMPACTS && is_given(p, "contact.impacts.prototype") &&
        scene_part_known(p, "contact.impacts.prototype"))
        series_check(p, &c->contact.impacts);
}
