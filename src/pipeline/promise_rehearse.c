/* Rehearsals: what a knob's error is along the scene's own motion. That of each knob has all others at `draft`, those
   that the scene says as it says them: so the first one, where a knob is at `draft` itself, is the same for all, and is
   run once.

   A coupled ball's steps are contact_steps in a contact or `oversampling` in a sample, whichever are more. So its
   oversampling is rehearsed with contact_steps two doublings finer than these were rehearsed themselves: else its error
   would be that of the steps.

   What it costs. Values double, so that all rehearsals of a knob cost about twice the last, which is at most two
   doublings coarser than what is chosen. Where an error cannot be kept, curves that are not settled (promise_curve.h)
   are rehearsed anew until they are: up to 64 times the first value, of contact_steps perhaps more. Measured, refusals
   of shipped scenes: 1.2 s (circle, basswood_scrape), 9 s (roll_coupled), 11 s (round_tip, most of it tip_heights).
   What is told as the best is so the same whatever was asked.

   A ramp of gains is rehearsed up to the sound, over the whole motion, two values side by side: what it misses lies at
   kinks, and grows with what rings.

   What comes in its order is rehearsed in its beginning only. A coupled ball's error grows with time, as its place
   drifts, up to linearly: measured over 10 times what is rehearsed, by 16 dB. So much is added, in proportion to the
   time (excerpts.h: drift). */
#include <math.h>
#include <string.h>

#include "convolution/ring_choice.h"
#include "pipeline/promise_parts.h"
#include "pipeline/run.h"
#include "pipeline/stages.h"
#include "scene/accuracy.h"
#include "scene/keys.h"

#define FIRST 0.5    /* s of what comes in its order, to begin with */
#define LONGEST 60.0 /* s of what rings */

static bool coupled(const struct promise_making *m)
{
    for (int i = 0; i < m->asked->n_contacts; i++)
        if (m->asked->contacts[i].contact.model == CONTACT_ROLL_COUPLED) return true;
    return false;
}

static bool heard(const struct promise_making *m, int contact)
{
    unsigned targets = m->parts.parts[contact].plan.targets;
    return m->sounds ? targets & ITEM_BIT(ITEM_SOUND) : targets != 0;
}

static bool make_excerpts(struct promise_making *m, double first, struct err *e)
{
    for (int i = 0; i < m->kept->n_contacts; i++) {
        const struct contact *c = m->parts.parts[i].plan.contact;
        bool moves = c && c->surface.response.choice && c->surface.response.choice->moves;
        if (!heard(m, i)) continue;
        if (!excerpts_make(m->kept, c, first, moves, m->arena, &m->excerpts[i], e)) return false;
        for (int k = 0; k < 2; k++)
            m->force[k][i] = ARENA_TAKE(m->arena, double, m->excerpts[i].frames);
        m->first[i] = ARENA_TAKE(m->arena, double, m->excerpts[i].frames);
        m->began = false;
    }
    return true;
}

/* Does every contact take the knob at that value? Else *e says which does not, and why. */
static bool can(struct promise_making *m, int knob, double value, struct err *e)
{
    struct accuracy set = m->kept->accuracy;
    bool ok = true;
    accuracy_turn(&set, (enum knob)knob, value);
    for (int i = 0; ok && i < m->kept->n_contacts; i++)
        ok = !heard(m, i) || excerpts_can(&m->excerpts[i], &set, e);
    return ok;
}

/* The finest whole value that can be had, of one that can and one, finer, that the table allows. */
static double finest(struct promise_making *m, int knob, double had, double end)
{
    struct err refused = {0};
    if (can(m, knob, end, &refused) || refused.kind != ERR_SCENE)
        return end; /* what else is wrong a rehearsal will tell */
    for (double not = end; fabs(not -had) > 1;) {
        double middle = floor((had + not ) / 2);
        refused = (struct err){0};
        *(can(m, knob, middle, &refused) ? &had : &not ) = middle;
    }
    return had;
}

static bool rehearse_at(struct promise_making *m, int knob, double value, struct err *e)
{
    struct accuracy set = m->kept->accuracy;
    bool first = accuracy_knob(&set, (enum knob)knob) == value;
    accuracy_turn(&set, (enum knob)knob, value);
    if (knob == KNOB_oversampling && m->curves[KNOB_contact_steps].n > 0 && !promise_said(m, KNOB_contact_steps)) {
        const struct promise_curve *steps = &m->curves[KNOB_contact_steps];
        accuracy_turn(&set, KNOB_contact_steps,
                      promise_curve_value(steps, steps->n + 2) < steps->end ? promise_curve_value(steps, steps->n + 2)
                                                                            : steps->end);
        first = false;
    }
    for (int i = 0; i < m->kept->n_contacts; i++) {
        double *older = m->force[1][i];
        m->force[1][i] = m->force[0][i];
        m->force[0][i] = older;
        if (!heard(m, i)) continue;
        if (first && m->began)
            memcpy(m->force[0][i], m->first[i], (size_t)m->excerpts[i].frames * sizeof(double));
        else if (!excerpts_run(&m->excerpts[i], &set, m->force[0][i], e))
            return false;
        if (first) memcpy(m->first[i], m->force[0][i], (size_t)m->excerpts[i].frames * sizeof(double));
    }
    m->began = m->began || first;
    return true;
}

/* Of the last rehearsal, or ([1]) of what is in the place of the one before: their difference. */
static double energy(const struct promise_making *m, bool difference)
{
    double sum = 0;
    for (int i = 0; i < m->kept->n_contacts; i++) {
        double drift = difference ? m->excerpts[i].drift : 1;
        sum += heard(m, i) ? drift * drift * excerpts_energy(&m->excerpts[i], m->force[difference][i]) : 0;
    }
    return sum;
}

static void subtract(struct promise_making *m)
{
    for (int i = 0; i < m->kept->n_contacts; i++)
        for (long n = 0; heard(m, i) && n < m->excerpts[i].frames; n++)
            m->force[1][i][n] -= m->force[0][i][n];
}

/* What comes in its order may begin with silence: longer beginnings, until something is heard. */
static bool begin_rehearsal(struct promise_making *m, int knob, double value, struct err *e)
{
    long before = -1, frames = 0;
    for (double first = FIRST; frames != before; first *= 4) {
        before = frames;
        frames = 0;
        if ((first > FIRST && !make_excerpts(m, first, e)) || !rehearse_at(m, knob, value, e)) return false;
        if (energy(m, false) > 0) break;
        for (int i = 0; i < m->kept->n_contacts; i++)
            frames += heard(m, i) ? m->excerpts[i].frames : 0;
    }
    return true;
}

/* Adds the energies of a contact's sound at the second of two ramps and of its difference from the first, until 40 dB
 * after the motion's end. */
static bool compare_ramps(const struct promise_making *m, int contact, const double ramp[2], double *all, double *apart,
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
        set[k] = *m->kept;
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
            *apart += (x[i] - y[i]) * (x[i] - y[i]);
        }
    }
    for (int k = 0; k < open; k++)
        run_close(&r[k]);
    arena_close(a);
    return ok;
}

static bool rehearse_ramp(struct promise_making *m, struct promise_curve *c, struct err *e)
{
    double ramp[2] = {promise_curve_value(c, c->n), promise_curve_value(c, c->n + 1)}, all = 0, apart = 0;
    for (int i = 0; i < m->kept->n_contacts; i++)
        if (heard(m, i) && !compare_ramps(m, i, ramp, &all, &apart, e)) return false;
    c->apart[c->n++] = all > 0 ? sqrt(apart / all) : 0;
    return true;
}

static bool rehearse_knob(struct promise_making *m, int knob, double error, struct err *e)
{
    const struct key_knob *k = &keys_knobs[knob];
    struct promise_curve *c = &m->curves[knob];
    bool down = k->scale == KEY_SAMPLES, fixed = promise_said(m, knob);
    double low = fixed ? accuracy_knob(&m->asked->accuracy, (enum knob)knob) : k->preset[0],
           end = finest(m, knob, low, down ? k->low : k->high);
    if (fixed && (down ? low < 2 * end : low > end / 2)) low = floor(down ? 2 * end : end / 2);
    *c = (struct promise_curve){.order = k->order, .low = low, .down = down, .end = end};
    if (knob == KNOB_gain_ramp && !coupled(m)) {
        while (!promise_curve_enough(c, error) && !(fixed && c->n == 2))
            if (!rehearse_ramp(m, c, e)) return false;
        return true;
    }
    if (!begin_rehearsal(m, knob, low, e)) return false;
    while (!promise_curve_enough(c, error) && !(fixed && c->n == 2)) {
        if (!rehearse_at(m, knob, promise_curve_value(c, c->n + 1), e)) return false;
        double all = energy(m, false);
        subtract(m);
        c->apart[c->n++] = all > 0 ? sqrt(energy(m, true) / all) : 0;
    }
    return true;
}

bool promise_rehearse_chaos(const struct promise_making *m, bool failed, struct err *e)
{
    for (int i = 0; i < m->kept->n_contacts; i++) {
        const struct excerpts *x = &m->excerpts[i];
        if (!heard(m, i) || x->contact.contact.model != CONTACT_ROLL_COUPLED ||
            (failed ? x->lift_offs : x->bounces) == 0)
            continue;
        err_about(e, NULL, "accuracy.error");
        err_set(e, ERR_SCENE,
                "accuracy.error: contact '%s': no error of a ball that bounces can be promised: it leaves the surface "
                "%ld times in its first %.3g s, and each time "
                "whatever two renders differ by grows, until they follow each other no more; take accuracy.error out, "
                "choose a preset, and compare statistics (rasp accuracy)",
                m->kept->contacts[i].name, x->lift_offs, (double)x->frames / m->kept->output.sample_rate);
        return true;
    }
    return false;
}

static bool prepare(struct promise_making *m, struct err *e)
{
    m->excerpts = ARENA_TAKE(m->arena, struct excerpts, m->kept->n_contacts);
    for (int k = 0; k < 2; k++)
        m->force[k] = ARENA_TAKE(m->arena, double *, m->kept->n_contacts);
    m->first = ARENA_TAKE(m->arena, double *, m->kept->n_contacts);
    return make_excerpts(m, FIRST, e);
}

bool promise_rehearse(struct promise_making *m, double error, struct err *e)
{
    static const int first = KNOB_contact_steps; /* oversampling asks for it */
    if (!m->excerpts && !prepare(m, e)) return false;
    for (int i = -1; i < KNOBS; i++) {
        int k = i < 0 ? first : i;
        bool known = promise_curve_settled(&m->curves[k]) && !(k == KNOB_oversampling && coupled(m));
        if (i != first && !known && promise_used(m, k) &&
            (!rehearse_knob(m, k, error, e) || promise_rehearse_chaos(m, false, e)))
            return false;
    }
    return true;
}
