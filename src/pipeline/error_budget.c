/* See error_budget.h. The parts: pilot runs (error_curve.h), how the budget is shared out; here the
   plans, and what is reported. Nothing here reads a clock but for the report: the same scene is given the same knobs
   everywhere. */
#include "pipeline/error_budget.h"

#include <math.h>
#include <string.h>

#include "base/stopwatch.h"
#include "convolution/ring_choice.h"
#include "num/real.h"
#include "pipeline/error_curve.h"
#include "pipeline/inputs.h"
#include "pipeline/render.h"
#include "pipeline/run.h"
#include "pipeline/segments.h"
#include "pipeline/stages.h"
#include "scene/accuracy.h"
#include "scene/keys.h"

struct budgeting {
    const struct scene *asked;
    struct scene *chosen;
    struct arena *arena;
    struct error_budget *to;
    double whole; /* relative rms: asked, less the margin */
    struct render_parts parts;
    unsigned used;             /* set of knobs                         */
    struct segments *segments; /* [n_contacts] */
    double **force[2];         /* [n_contacts] of the last pilot run and, [1], the one before */
    double **first;            /* [n_contacts] of the pilot run with every knob at `draft`, once it has been */
    bool began;                /* it has                               */
    bool sounds;               /* some contact sounds; else forces are promised about */
    struct error_curve curves[KNOBS];
};

/* Does the scene itself give the knob? */
static inline bool is_users(const struct budgeting *m, int knob) { return m->asked->accuracy.by_user & 1u << knob; }

/* Does it turn the scene, so that its error is piloted? */
static inline bool budget_used(const struct budgeting *m, int knob) { return m->used & 1u << knob; }

/* ------------------------------------------------------------------ pilot runs */

/* Pilot runs: what a knob's error is along the scene's own motion. That of each knob has all others at `draft`, those
   that the scene says as it says them: so the first one, where a knob is at `draft` itself, is the same for all, and is
   run once.

   A coupled ball's steps are contact_steps in a contact or `oversampling` in a sample, whichever are more. So its
   oversampling is piloted with contact_steps two doublings finer than these were piloted themselves: else its error
   would be that of the steps.

   What it costs. Values double, so that all pilot runs of a knob cost about twice the last, which is at most two
   doublings coarser than what is chosen. Where an error cannot be kept, curves that are not settled (error_curve.h)
   are piloted anew until they are: up to 64 times the first value, of contact_steps perhaps more. Measured, refusals
   of shipped scenes: 1.2 s (circle, basswood_scrape), 9 s (roll_coupled), 11 s (round_tip, most of it tip_heights).
   What is reported as the best is so the same whatever was asked.

   A ramp of gains is piloted up to the sound, over the whole motion, two values side by side: what it misses lies at
   kinks, and grows with what rings.

   What comes in its order is piloted in its beginning only. A coupled ball's error grows with time, as its place
   drifts, up to linearly: measured over 10 times what is piloted, by 16 dB. So much is added, in proportion to the
   time (segments.h: drift). */

#define FIRST 0.5    /* s of what comes in its order, to begin with */
#define LONGEST 60.0 /* s of what rings */

static bool coupled(const struct budgeting *m)
{
    for (int i = 0; i < m->asked->n_contacts; i++)
        if (m->asked->contacts[i].contact.model == CONTACT_ROLL_COUPLED) return true;
    return false;
}

static bool is_audible(const struct budgeting *m, int contact)
{
    unsigned targets = m->parts.parts[contact].plan.targets;
    return m->sounds ? targets & ITEM_BIT(ITEM_SOUND) : targets != 0;
}

static bool make_segments(struct budgeting *m, double first, struct err *e)
{
    for (int i = 0; i < m->chosen->n_contacts; i++) {
        const struct contact *c = m->parts.parts[i].plan.contact;
        bool moves = c && c->surface.response.choice && c->surface.response.choice->moves;
        if (!is_audible(m, i)) continue;
        if (!segments_make(m->chosen, c, first, moves, m->arena, &m->segments[i], e)) return false;
        for (int k = 0; k < 2; k++)
            m->force[k][i] = ARENA_TAKE(m->arena, double, m->segments[i].frames);
        m->first[i] = ARENA_TAKE(m->arena, double, m->segments[i].frames);
        m->began = false;
    }
    return true;
}

/* Does every contact take the knob at that value? Else *e says which does not, and why. */
static bool can(struct budgeting *m, int knob, double value, struct err *e)
{
    struct accuracy set = m->chosen->accuracy;
    bool ok = true;
    accuracy_turn(&set, (enum knob)knob, value);
    for (int i = 0; ok && i < m->chosen->n_contacts; i++)
        ok = !is_audible(m, i) || segments_can(&m->segments[i], &set, e);
    return ok;
}

/* The finest whole value that can be had, of one that can and one, finer, that the table allows. */
static double finest(struct budgeting *m, int knob, double had, double end)
{
    struct err refused = {0};
    if (can(m, knob, end, &refused) || refused.kind != ERR_SCENE)
        return end; /* what else is wrong a pilot run will tell */
    for (double not = end; fabs(not -had) > 1;) {
        double middle = floor((had + not ) / 2);
        refused = (struct err){0};
        *(can(m, knob, middle, &refused) ? &had : &not ) = middle;
    }
    return had;
}

static bool pilot_at(struct budgeting *m, int knob, double value, struct err *e)
{
    struct accuracy set = m->chosen->accuracy;
    bool first = accuracy_knob(&set, (enum knob)knob) == value;
    accuracy_turn(&set, (enum knob)knob, value);
    if (knob == KNOB_oversampling && m->curves[KNOB_contact_steps].n > 0 && !is_users(m, KNOB_contact_steps)) {
        const struct error_curve *steps = &m->curves[KNOB_contact_steps];
        accuracy_turn(&set, KNOB_contact_steps,
                      error_curve_value(steps, steps->n + 2) < steps->end ? error_curve_value(steps, steps->n + 2)
                                                                          : steps->end);
        first = false;
    }
    for (int i = 0; i < m->chosen->n_contacts; i++) {
        double *older = m->force[1][i];
        m->force[1][i] = m->force[0][i];
        m->force[0][i] = older;
        if (!is_audible(m, i)) continue;
        if (first && m->began)
            memcpy(m->force[0][i], m->first[i], (size_t)m->segments[i].frames * sizeof(double));
        else if (!segments_run(&m->segments[i], &set, m->force[0][i], e))
            return false;
        if (first) memcpy(m->first[i], m->force[0][i], (size_t)m->segments[i].frames * sizeof(double));
    }
    m->began = m->began || first;
    return true;
}

/* Of the last pilot run, or ([1]) of what is in the place of the one before: their difference. */
static double energy(const struct budgeting *m, bool difference)
{
    double sum = 0;
    for (int i = 0; i < m->chosen->n_contacts; i++) {
        double drift = difference ? m->segments[i].drift : 1;
        sum += is_audible(m, i) ? drift * drift * segments_energy(&m->segments[i], m->force[difference][i]) : 0;
    }
    return sum;
}

/* What comes in its order may begin with silence: longer beginnings, until something is heard. */
static bool begin_pilot(struct budgeting *m, int knob, double value, struct err *e)
{
    long before = -1, frames = 0;
    for (double first = FIRST; frames != before; first *= 4) {
        before = frames;
        frames = 0;
        if ((first > FIRST && !make_segments(m, first, e)) || !pilot_at(m, knob, value, e)) return false;
        if (energy(m, false) > 0) break;
        for (int i = 0; i < m->chosen->n_contacts; i++)
            frames += is_audible(m, i) ? m->segments[i].frames : 0;
    }
    return true;
}

/* Adds the energies of a contact's sound at the second of two ramps and of its difference from the first, until 40 dB
 * after the motion's end. */
static bool compare_ramps(const struct budgeting *m, int contact, const double ramp[2], double *all, double *distance,
                          struct err *e)
{
    struct contact own = *m->parts.parts[contact].plan.contact;
    struct arena *a = arena_open();
    struct scene set[2];
    struct plan p;
    struct run r[2];
    int open = 0;
    bool ok = true;
    for (int k = 0; k < 2; k++) {
        set[k] = *m->chosen;
        set[k].contacts = &own;
        set[k].n_contacts = 1;
        set[k].output.stems = NULL;
        set[k].output.diagnostics.given = false;
        set[k].output.impacts = LISTING_NONE;
        accuracy_turn(&set[k].accuracy, KNOB_gain_ramp, ramp[k]);
    }
    for (ok = plan_make(stages_table, &own, set, a, &p, e); ok && open < 2; open += ok)
        ok = run_open(&r[open], &p, &set[open], NULL, e);
    long frames = ok ? r[0].board.moving + (long)(0.5 * fmin(r[0].board.ring, LONGEST) * r[0].board.rate) : 0;
    for (long from = 0, to; ok && from < frames; from = to) {
        to = from + STAGE_BLOCK < frames ? from + STAGE_BLOCK : frames;
        ok = run_block(&r[0], to, e) && run_block(&r[1], to, e);
        const double *x = ok ? board_at(&r[0].board, ITEM_SOUND, from) : NULL,
                     *y = ok ? board_at(&r[1].board, ITEM_SOUND, from) : NULL;
        for (long i = 0; ok && i < (to - from) * r[0].board.channels; i++) {
            *all += y[i] * y[i];
            *distance += (x[i] - y[i]) * (x[i] - y[i]);
        }
    }
    for (int k = 0; k < open; k++)
        run_close(&r[k]);
    arena_close(a);
    return ok;
}

static bool pilot_knob(struct budgeting *m, int knob, double error, struct err *e)
{
    const struct key_knob *k = &keys_knobs[knob];
    struct error_curve *c = &m->curves[knob];
    bool down = k->scale == KEY_SAMPLES, fixed = is_users(m, knob);
    double low = fixed ? accuracy_knob(&m->asked->accuracy, (enum knob)knob) : k->preset[0],
           end = finest(m, knob, low, down ? k->low : k->high);
    if (fixed && (down ? low < 2 * end : low > end / 2)) low = floor(down ? 2 * end : end / 2);
    *c = (struct error_curve){.order = k->order, .low = low, .down = down, .end = end};
    bool ramp = knob == KNOB_gain_ramp && !coupled(m);
    if (!ramp && !begin_pilot(m, knob, low, e)) return false;
    while (!error_curve_enough(c, error) && !(fixed && c->n == 2)) {
        const double values[2] = {error_curve_value(c, c->n), error_curve_value(c, c->n + 1)};
        double all = 0, distance = 0;
        for (int i = 0; ramp && i < m->chosen->n_contacts; i++)
            if (is_audible(m, i) && !compare_ramps(m, i, values, &all, &distance, e)) return false;
        if (!ramp && !pilot_at(m, knob, values[1], e)) return false;
        if (!ramp) {
            all = energy(m, false);
            for (int i = 0; i < m->chosen->n_contacts; i++)
                for (long n = 0; is_audible(m, i) && n < m->segments[i].frames; n++)
                    m->force[1][i][n] -= m->force[0][i][n];
            distance = energy(m, true);
        }
        c->distance[c->n++] = all > 0 ? sqrt(distance / all) : 0;
    }
    return true;
}

/* True, with an error: a coupled ball bounces or, where the promise cannot be kept anyway (failed), leaves the surface.
 */
static bool run_chaos_pilot(const struct budgeting *m, bool failed, struct err *e)
{
    for (int i = 0; i < m->chosen->n_contacts; i++) {
        const struct segments *x = &m->segments[i];
        if (!is_audible(m, i) || x->contact.contact.model != CONTACT_ROLL_COUPLED ||
            (failed ? x->lift_offs : x->bounces) == 0)
            continue;
        err_about(e, NULL, "accuracy.error");
        err_set(e, ERR_SCENE,
                "accuracy.error: contact '%s': no error of a ball that bounces can be promised: it leaves the surface "
                "%ld times in its first %.3g s, and each time "
                "whatever two renders differ by grows, until they follow each other no more; take accuracy.error out, "
                "choose a preset, and compare statistics (rasp accuracy)",
                m->chosen->contacts[i].name, x->lift_offs, (double)x->frames / m->chosen->output.sample_rate);
        return true;
    }
    return false;
}

/* The curves of all knobs whose errors are piloted, each until it tells which value has at most that error; 0: until
   all of them are settled. ERR_SCENE: of a ball that bounces; else those of stages. */
static bool run_pilot(struct budgeting *m, double error, struct err *e)
{
    static const int first = KNOB_contact_steps; /* oversampling asks for it */
    if (!m->segments) {
        m->segments = ARENA_TAKE(m->arena, struct segments, m->chosen->n_contacts);
        m->force[0] = ARENA_TAKE(m->arena, double *, m->chosen->n_contacts);
        m->force[1] = ARENA_TAKE(m->arena, double *, m->chosen->n_contacts);
        m->first = ARENA_TAKE(m->arena, double *, m->chosen->n_contacts);
        if (!make_segments(m, FIRST, e)) return false;
    }
    for (int i = -1; i < KNOBS; i++) {
        int k = i < 0 ? first : i;
        bool known = error_curve_converged(&m->curves[k]) && !(k == KNOB_oversampling && coupled(m));
        if (i != first && !known && budget_used(m, k) && (!pilot_knob(m, k, error, e) || run_chaos_pilot(m, false, e)))
            return false;
    }
    return true;
}

/* ------------------------------------------------------------------ sharing */

/* The budget is shared in tenths of its square between the knobs that are free; the shares whose values cost the least,
 * by the plans' predicted work, are taken. Where tenths are too coarse to keep the error, every knob is as fine as
 * helps. */

enum { SOURCES = 4, TENTHS = 10 };

struct sources { /* what is free to be chosen */
    int n, knob[SOURCES], tenths[SOURCES], best[SOURCES];
    double cost, left; /* left: of the budget's square, share that what is said does not use */
};

/* Sets the knobs for shares of what is left; false: one has no such value. */
static bool take(const struct budgeting *m, const struct sources *s, const int *tenths, struct accuracy *set,
                 double *spent)
{
    *spent = 0;
    for (int i = 0; i < s->n; i++) {
        double square = s->left * tenths[i] / TENTHS;
        double value = error_curve_least(&m->curves[s->knob[i]], m->whole * sqrt(square));
        if (isnan(value)) return false;
        double error = error_curve_error(&m->curves[s->knob[i]], value) / m->whole;
        *spent += error * error;
        accuracy_turn(set, (enum knob)s->knob[i], value);
    }
    return true;
}

/* Are these shares cheaper, by the plans' predicted work, than all before? */
static void try_shares(const struct budgeting *m, struct sources *s)
{
    struct scene set = *m->chosen;
    double spent, cost = 0;
    if (!take(m, s, s->tenths, &set.accuracy, &spent)) return;
    for (int i = 0; i < set.n_contacts; i++) {
        const struct plan *p = &m->parts.parts[i].plan;
        for (int k = 0; k < p->n; k++)
            cost += p->rows[k].verdict == PLAN_RUNS ? stages_work(p->rows[k].stage, p->contact, &set) : 0;
    }
    if (cost >= s->cost) return;
    s->cost = cost;
    memcpy(s->best, s->tenths, sizeof s->best);
}

/* All ways to share out what is left among the sources from i on, a tenth at least to each. */
static void share(const struct budgeting *m, struct sources *s, int i, int left)
{
    if (i == s->n - 1) {
        s->tenths[i] = left;
        try_shares(m, s);
        return;
    }
    for (s->tenths[i] = 1; s->tenths[i] <= left - (s->n - 1 - i); s->tenths[i]++) {
        int chosen = s->tenths[i];
        share(m, s, i + 1, left - chosen);
        s->tenths[i] = chosen;
    }
}

/* Every knob as fine as helps, however the budget is then shared. */
static bool take_best(const struct budgeting *m, const struct sources *s, struct accuracy *set, double *spent)
{
    *spent = 0;
    for (int i = 0; i < s->n; i++) {
        const struct error_curve *c = &m->curves[s->knob[i]];
        double value = error_curve_best(c), error = error_curve_error(c, value) / m->whole;
        *spent += error * error;
        accuracy_turn(set, (enum knob)s->knob[i], value);
    }
    return *spent < s->left;
}

/* Sets the knobs that the scene leaves open. False: there are no such values. */
static bool share_budget(struct budgeting *m)
{
    struct sources s = {.cost = HUGE_VAL, .left = 1};
    double spent = 0;
    for (int k = 0; k < KNOBS; k++)
        if (budget_used(m, k) && is_users(m, k)) { /* what knobs that are said leave of the budget's square */
            double error =
                error_curve_error(&m->curves[k], accuracy_knob(&m->asked->accuracy, (enum knob)k)) / m->whole;
            s.left -= error * error;
        } else if (budget_used(m, k) && s.n < SOURCES)
            s.knob[s.n++] = k;
    if (s.n == 0) /* nothing is free: the margin is no matter */
        return s.left >= 1 - real_exp10(ERROR_BUDGET_MARGIN / 10);
    if (s.left > 0) share(m, &s, 0, TENTHS);
    struct accuracy set = m->chosen->accuracy;
    if (!(isfinite(s.cost) ? take(m, &s, s.best, &set, &spent) : take_best(m, &s, &set, &spent))) return false;
    m->chosen->accuracy = set;
    return true;
}

static double decibel(double x) { return 20 * real_log10(x); }

/* ------------------------------------------------------------------ telling */

static void parts_text(struct budgeting *m)
{
    struct error_budget *p = m->to;
    double sum = 0;
    p->n = 0;
    for (int k = 0; k < KNOBS; k++) {
        double value = accuracy_knob(&m->chosen->accuracy, (enum knob)k);
        double error = budget_used(m, k) ? error_curve_error(&m->curves[k], value) : 0;
        if (error > 0) p->parts[p->n++] = (struct error_budget_part){(enum knob)k, is_users(m, k), value, error};
    }
    for (int i = 0; i < p->n; i++)
        sum += p->parts[i].error * p->parts[i].error;
    p->predicted = sum > 0 ? decibel(sqrt(sum)) : -HUGE_VAL;
}

static const char *budget_text(struct arena *a, const struct error_budget *p)
{
    const char *text = arena_format(a, "accuracy: %.6g dB asked, ", p->error);
    if (isnan(p->predicted)) return arena_format(a, "%severy knob is said: nothing is chosen or predicted", text);
    if (p->n == 0) return arena_format(a, "%sno knob leaves an error", text);
    text = arena_format(a, "%s%.1f dB predicted: ", text, p->predicted);
    for (int i = 0; i < p->n; i++)
        text = arena_format(a, "%s%s%s %.6g %.1f dB%s", text, i ? ", " : "", keys_knobs[p->parts[i].knob].name,
                            p->parts[i].value, decibel(p->parts[i].error), p->parts[i].by_user ? " (said)" : "");
    return text;
}

/* What is in the way, and what could be had: every free knob at its finest. */
static bool refuse(struct budgeting *m, struct err *e)
{
    struct error_budget *p = m->to;
    const struct error_budget_part *worst = p->parts;
    if (run_chaos_pilot(m, true, e)) return false;
    for (int k = 0; k < KNOBS; k++)
        if (budget_used(m, k) && !is_users(m, k))
            accuracy_turn(&m->chosen->accuracy, (enum knob)k, error_curve_best(&m->curves[k]));
    parts_text(m);
    for (int i = 0; i < p->n; i++)
        worst = p->parts[i].error > worst->error ? &p->parts[i] : worst;
    double best = ceil(p->predicted + ERROR_BUDGET_MARGIN);
    err_about(e, NULL, "accuracy.error");
    if (worst->by_user)
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

/* From the cheapest values of all knobs on. That an error cannot be kept is believed when all is piloted, and not
   before. The engines are chosen then, and need not be again. */
static bool make(struct budgeting *m, struct err *e)
{
    for (int k = 0; k < KNOBS; k++)
        if (!is_users(m, k)) accuracy_turn(&m->chosen->accuracy, (enum knob)k, keys_knobs[k].preset[0]);
    m->parts = render_parts_make(m->chosen, m->arena);
    if (!render_parts_plan(&m->parts, e)) return false;
    m->sounds = m->parts.asked & ITEM_BIT(ITEM_SOUND);
    for (int i = 0; i < m->chosen->n_contacts; i++)
        m->used |= plan_knobs(&m->parts.parts[i].plan);
    if (!run_pilot(m, m->whole, e) || !(share_budget(m) || (run_pilot(m, 0, e) && (share_budget(m) || refuse(m, e)))))
        return false;
    parts_text(m);
    struct contact *c = ARENA_TAKE(m->arena, struct contact, m->chosen->n_contacts);
    for (int i = 0; i < m->chosen->n_contacts; i++)
        c[i] = *m->parts.parts[i].plan.contact;
    m->chosen->contacts = c;
    return true;
}

bool error_budget_apply(const struct scene *asked, struct arena *a, struct scene *chosen, struct error_budget *p,
                        struct err *e)
{
    struct error_budget own;
    struct budgeting m = {.asked = asked,
                          .chosen = chosen,
                          .arena = a,
                          .to = p ? p : &own,
                          .whole = real_exp10((asked->accuracy.error - ERROR_BUDGET_MARGIN) / 20)};
    double start = stopwatch_cpu();
    *chosen = *asked;
    *m.to =
        (struct error_budget){.asked = !isnan(asked->accuracy.error), .error = asked->accuracy.error, .predicted = NAN};
    if (!m.to->asked) return true;
    m.to->chosen = asked->accuracy.by_user != (1u << KNOBS) - 1;
    if (m.to->chosen && (!inputs_check(asked, a, e) || !make(&m, e))) return false;
    m.to->text = budget_text(a, m.to);
    m.to->cpu = stopwatch_cpu() - start;
    return true;
}
