/* See promise.h. The parts: rehearsals (promise_rehearse.c), how the budget is shared out (promise_share.c); here the
   plans, and what is told. Nothing here reads a clock but for the report: the same scene is given the same knobs
   everywhere. */
#include "pipeline/promise.h"

#include <math.h>

#include "base/stopwatch.h"
#include "num/real.h"
#include "pipeline/inputs.h"
#include "pipeline/promise_parts.h"
#include "scene/accuracy.h"
#include "scene/keys.h"

static double decibel(double x) { return 20 * real_log10(x); }

static double amplitude(double db) { return real_exp10(db / 20); }

/* ------------------------------------------------------------------ plans */

static bool plan(struct promise_making *m, struct err *e)
{
    m->parts = render_parts_make(m->kept, "", m->arena);
    if (!render_parts_plan(&m->parts, e)) return false;
    m->sounds = m->parts.asked & ITEM_BIT(ITEM_SOUND);
    for (int i = 0; i < m->kept->n_contacts; i++)
        m->used |= plan_knobs(&m->parts.parts[i].plan);
    return true;
}

static void begin_cheaply(struct promise_making *m)
{
    for (int k = 0; k < KNOBS; k++)
        if (!promise_said(m, k)) accuracy_turn(&m->kept->accuracy, (enum knob)k, keys_knobs[k].preset[0]);
}

/* ------------------------------------------------------------------ telling */

static void part_add(struct promise *p, int knob, bool fixed, double value, double error)
{
    if (error > 0) p->parts[p->n++] = (struct promise_part){(enum knob)knob, fixed, value, error};
}

static void tell_parts(struct promise_making *m)
{
    struct promise *p = m->to;
    double sum = 0;
    p->n = 0;
    for (int k = 0; k < KNOBS; k++) {
        double value = accuracy_knob(&m->kept->accuracy, (enum knob)k);
        if (promise_used(m, k)) part_add(p, k, promise_said(m, k), value, promise_curve_error(&m->curves[k], value));
    }
    for (int i = 0; i < p->n; i++)
        sum += p->parts[i].error * p->parts[i].error;
    p->predicted = sum > 0 ? decibel(sqrt(sum)) : -HUGE_VAL;
}

static const char *part_text(struct arena *a, const struct promise_part *p)
{
    return arena_format(a, "%s %.6g %.1f dB%s", keys_knobs[p->knob].name, p->value, decibel(p->error),
                        p->said ? " (said)" : "");
}

static const char *tell_text(struct arena *a, const struct promise *p)
{
    const char *text = arena_format(a, "accuracy: %.6g dB asked, ", p->error);
    if (isnan(p->predicted)) return arena_format(a, "%severy knob is said: nothing is chosen or predicted", text);
    if (p->n == 0) return arena_format(a, "%sno knob leaves an error", text);
    text = arena_format(a, "%s%.1f dB predicted: ", text, p->predicted);
    for (int i = 0; i < p->n; i++)
        text = arena_format(a, "%s%s%s", text, i ? ", " : "", part_text(a, &p->parts[i]));
    return text;
}

/* What is in the way, and what could be had: every free knob at its finest. */
static bool refuse(struct promise_making *m, struct err *e)
{
    struct promise *p = m->to;
    const struct promise_part *worst = p->parts;
    if (promise_rehearse_chaos(m, true, e)) return false;
    for (int k = 0; k < KNOBS; k++)
        if (promise_used(m, k) && !promise_said(m, k))
            accuracy_turn(&m->kept->accuracy, (enum knob)k, promise_curve_best(&m->curves[k]));
    tell_parts(m);
    for (int i = 0; i < p->n; i++)
        worst = p->parts[i].error > worst->error ? &p->parts[i] : worst;
    double best = ceil(p->predicted + PROMISE_MARGIN);
    err_about(e, NULL, "accuracy.error");
    if (worst->said)
        return err_set(e, ERR_SCENE,
                       "accuracy.error: %.6g dB cannot be promised: accuracy.%s is %.6g, which alone leaves %.1f dB; "
                       "take it out, or ask for %.0f dB at most",
                       p->error, keys_knobs[worst->knob].name, worst->value, decibel(worst->error), best);
    return err_set(e, ERR_SCENE,
                   "accuracy.error: %.6g dB cannot be promised: %s stands in the way, of which at its finest, %.6g, no "
                   "less than %.1f dB is promised; the best that can be promised here is %.0f dB",
                   p->error, keys_knobs[worst->knob].name, worst->value, decibel(worst->error), best);
}

/* ------------------------------------------------------------------ choosing */

/* That an error cannot be kept is believed when all is rehearsed, and not before. */
static bool choose(struct promise_making *m, struct err *e)
{
    return promise_rehearse(m, m->whole, e) &&
           (promise_share(m) || (promise_rehearse(m, 0, e) && (promise_share(m) || refuse(m, e))));
}

/* The engines are chosen: they need not be again. */
static void keep_choices(struct promise_making *m)
{
    struct contact *c = ARENA_TAKE(m->arena, struct contact, m->kept->n_contacts);
    for (int i = 0; i < m->kept->n_contacts; i++)
        c[i] = *m->parts.parts[i].plan.contact;
    m->kept->contacts = c;
}

static bool make(struct promise_making *m, struct err *e)
{
    begin_cheaply(m);
    if (!plan(m, e) || !choose(m, e)) return false;
    tell_parts(m);
    keep_choices(m);
    return true;
}

bool promise_keep(const struct scene *asked, struct arena *a, struct scene *kept, struct promise *p, struct err *e)
{
    struct promise own;
    struct promise_making m = {.asked = asked,
                               .kept = kept,
                               .arena = a,
                               .to = p ? p : &own,
                               .whole = amplitude(asked->accuracy.error - PROMISE_MARGIN)};
    double start = stopwatch_cpu();
    *kept = *asked;
    *m.to = (struct promise){.asked = !isnan(asked->accuracy.error), .error = asked->accuracy.error, .predicted = NAN};
    if (!m.to->asked) return true;
    m.to->chosen = asked->accuracy.said != (1u << KNOBS) - 1;
    if (m.to->chosen && (!inputs_check(asked, a, e) || !make(&m, e))) return false;
    m.to->text = tell_text(a, m.to);
    m.to->cpu = stopwatch_cpu() - start;
    return true;
}
