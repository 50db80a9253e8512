/* What a ball's stage, of either model, says of a whole render: how it lay in its contact, how often it left it, and of
   the coupled model how well energy is kept. */
#include <jansson.h>
#include <math.h>

#include "file/json_value.h"
#include "force/roll.h"

static const char *times(long n, struct arena *a) { return n == 1 ? "once" : arena_format(a, "%ld times", n); }

/* Of the coupled model: how long contacts are, and how well energy is kept. */
static const char *rolled_steps(const struct roll_report *o, struct arena *a)
{
    const char *hertz = o->hertz > 0 ? arena_format(a, "Hertz's depth %.3g m and ", o->hertz) : "";
    if (!o->steps)
        return isnan(o->roughness) ? "" : arena_format(a, " (from %sa ground of %.3g m rms)", hertz, o->roughness);
    const char *lasts = isnan(o->contact_samples[0])
                            ? ""
                            : arena_format(a, "; a contact lasts %.3g audio samples, the shortest %.3g",
                                           o->contact_samples[0], o->contact_samples[1]);
    const char *fastest = o->fastest > 0 ? arena_format(a, ", the fastest impact %.3g m/s", o->fastest) : "";
    return arena_format(a, "%s%s; energy balances to %.1e of its greatest", lasts, fastest, o->residual);
}

static const char *rolled(const struct roll_report *o, struct arena *a)
{
    const char *rests =
        o->rest > 0 ? arena_format(a, "; stiffness %.4g N/m^1.5, %.3g m deep at rest", o->stiffness, o->rest) : "";
    const char *rings =
        o->resonance > 0 ? arena_format(a, "; on its contact it resonates at %.3g Hz", o->resonance) : "";
    double share = o->time > 0 ? 100 * o->contact / o->time : 0;
    const char *touches =
        o->contact > 0 || o->lift_offs ? arena_format(a, "in contact %.4g %% of the time", share) : "never in contact";
    if (o->lift_offs)
        touches = arena_format(a, "%s, lifts off %s", touches, times(o->lift_offs, a));
    else if (o->contact > 0)
        touches = arena_format(a, "%s, never lifts off", touches);
    if (o->lift_offs && o->steps)
        touches = arena_format(a, "%s (for longer than an audio sample %s)", touches,
                               o->bounces > 0 ? times(o->bounces, a) : "never");
    return arena_format(a, "%s%s%s%s", touches, rests, rolled_steps(o, a), rings);
}

static json_t *roll_json(const struct roll_report *o)
{
    json_t *r = json_value_object("contact_share:n contact_s:n lift_offs:l stiffness:n rest_penetration_m:n",
                                  o->time > 0 ? o->contact / o->time : NAN, o->contact, (long)o->lift_offs,
                                  o->stiffness, o->rest);
    if (o->resonance > 0) json_value_set(r, "resonance_hz:n", o->resonance);
    if (!isnan(o->roughness)) json_value_set(r, "hertz_penetration_m:n roughness_rms_m:n", o->hertz, o->roughness);
    if (o->steps)
        json_value_set(r,
                       "bounces:l step_s:n steps:l contact_samples_mean_least:a fastest_impact_m_per_s:n "
                       "energy_residual:n iterations_mean_most:a",
                       (long)o->bounces, o->step, (long)o->steps, o->contact_samples, 2, o->fastest, o->residual,
                       o->iterations, 2);
    return r;
}

struct stage_report roll_report(const struct stage_run *r, struct arena *a)
{
    const struct roll_report *o = &r->board->roll;
    if (!r->board->rolls) return (struct stage_report){.key = NULL};
    return (struct stage_report){"roll", roll_json(o), rolled(o, a), {NULL}};
}
