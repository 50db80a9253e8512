/* See error_budget.h. Differences of settings are measured by error_pilot.h, those of ramps here. Nothing here reads a
   clock but for the report: the same scene is given the same knobs everywhere. */
#include "pipeline/error_budget.h"

#include <math.h>
#include <string.h>

#include "base/stopwatch.h"
#include "convolution/ring_choice.h"
#include "num/real.h"
#include "pipeline/error_pilot.h"
#include "pipeline/inputs.h"
#include "pipeline/render.h"
#include "pipeline/run.h"
#include "pipeline/stages.h"
#include "scene/accuracy.h"
#include "scene/keys.h"

struct found { /* of a knob */
    double value;
    double energy; /* that its error is at most taken to have                 */
    double least;  /* of the energies by which values are accepted, the least */
    double best;   /* the value that has it                                   */
    double end;    /* the finest that can be had                              */
};

struct ramp_sound {
    double *x, *next; /* sound at the finer of the last two ramps; next: the same, or NULL where it is too long */
};

struct budgeting {
    const struct scene *asked;
    struct scene *chosen;
    struct arena *arena;
    struct error_budget *to;
    struct render_parts parts;
    bool sampled;              /* for a preset, not for accuracy.error */
    unsigned used;             /* set of knobs                         */
    struct error_pilot *pilot; /* [n_contacts] */
    bool sounds;               /* some contact sounds; else forces are promised about */
    struct ramp_sound *ramps;  /* [n_contacts] */
    double energy;             /* of all that is heard */
    struct found found[KNOBS];
};

/* Does the scene itself give the knob? */
static bool is_users(const struct budgeting *m, int knob) { return m->asked->accuracy.by_user & 1u << knob; }

/* Does it turn the scene, so that its error is piloted? */
static bool budget_used(const struct budgeting *m, int knob) { return m->used & 1u << knob; }

/* ------------------------------------------------------------------ pilot runs */

/* A knob's error at a value K is told from d, the energy of the difference between the sounds at K and at 2K. An error
   that falls by 6 dB a doubling, as at a kink, is twice the difference: so 4 d is what it is taken to be, and K is
   accepted where that is within the knob's share. The first value has no history that shows whether K and 2K agree by
   accident: there it is 10 times the greater of d and, of steps and unless d is far below the share, the next value's.
   Of the last value, which has no finer one, the error is at most the difference from the one before it, if it falls by
   6 dB or more: 2 d. Of ramps the next value is not 2K but ramp_after, whose difference is nearer to the error.

   That of each knob has all others at `draft`, those that the scene says as it says them. A coupled ball's steps are
   contact_steps in a contact or `oversampling` in a sample, whichever are more. So its oversampling is piloted with
   contact_steps two doublings finer than what was accepted: else its error would be that of the steps. Under a round
   tip it is piloted with the tip_heights that were accepted: ground that is read more finely has more to be averaged.

   A ramp of gains is piloted up to the sound, over the whole motion, two values side by side: what it misses lies at
   kinks, and grows with what rings. For a preset it is piloted over the fastest stretch only.

   A coupled ball is piloted in its beginning only, its ramps in the force, too. Its error grows with time, as its place
   drifts, up to linearly: measured over 10 times what is piloted, by 16 dB. So much is added, in proportion to the time
   (error_pilot.h: drift). For a preset only contact_steps is chosen of a scene with such a ball, from the preset's own
   on, and where it bounces nothing is. */

#define HAND 4.0         /* energy of an error over that of a difference that it is taken to have */
#define HAND_FIRST 10.0  /* the same, of the first value */
#define FAR 10000.0      /* a first difference so far below its share needs no look at the next: 40 dB */
#define HAND_SAMPLED 8.0 /* as HAND, of a preset's steps */
#define HAND_RAMPS 40.0  /* and of its ramps: a stretch says less of the whole, and a finer ramp costs little */
#define SLOWEST 0.25     /* by which a preset's difference is taken to fall at a doubling, where it was not run: 6 dB */
#define FASTEST 0.015625 /* at most: 18 dB */
#define HAND_LAST 2.0    /* the same, of the last value, beside the difference from the one before */
#define FLOOR 1e-15 /* of a difference that is none of 0: the filters' ripple and rounding are no powers; -150 dB */
#define FIRST 0.5   /* s of a coupled ball, to begin with; half of it of a sampled force that begins at 0 only */
#define FADE 2048   /* frames over which the force of a stretch in the middle rises */
#define RAMPS 4096  /* frames, a multiple of the ramps that are chosen */
#define SOUND_MOST (1L << 20) /* samples of a sound that is kept in memory, at most */

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

/* Does every contact take the knob at that value? Else *e says which does not, and why. */
static bool can(struct budgeting *m, int knob, double value, struct err *e)
{
    struct accuracy set = m->chosen->accuracy;
    bool ok = true;
    accuracy_turn(&set, (enum knob)knob, value);
    for (int i = 0; ok && i < m->chosen->n_contacts; i++)
        ok = !is_audible(m, i) || error_pilot_can(&m->pilot[i], &set, e);
    return ok;
}

/* The finest whole value that can be had, of one that can and one, finer, that the table allows. */
static double finest(struct budgeting *m, int knob, double had, double end)
{
    struct err refused = {0};
    if (knob == KNOB_oversampling || knob == KNOB_gain_ramp || can(m, knob, end, &refused) || refused.kind != ERR_SCENE)
        return end; /* what else is wrong a pilot run will tell */
    for (double not = end; fabs(not -had) > 1;) {
        double middle = floor((had + not ) / 2);
        refused = (struct err){0};
        *(can(m, knob, middle, &refused) ? &had : &not ) = middle;
    }
    return had;
}

/* What the scene has, with the knob at a value. */
static struct accuracy turned(const struct budgeting *m, int knob, double value)
{
    struct accuracy set = m->chosen->accuracy;
    accuracy_turn(&set, (enum knob)knob, value);
    if (knob == KNOB_oversampling && m->found[KNOB_contact_steps].value > 0 && !is_users(m, KNOB_contact_steps))
        accuracy_turn(&set, KNOB_contact_steps,
                      fmin(4 * m->found[KNOB_contact_steps].value, m->found[KNOB_contact_steps].end));
    if (knob == KNOB_oversampling && m->found[KNOB_tip_heights].value > 0) /* a finer ground has more to be averaged */
        accuracy_turn(&set, KNOB_tip_heights, m->found[KNOB_tip_heights].value);
    return set;
}

#define SHOWN 60.0 /* predicted cycles of a sample of a channel that is compared or measured */

/* Share of a contact's sound, in energy and to 40 dB after the motion's end, that output.ramp leaves. */
static bool shown_share(struct budgeting *m, int i, double *share, struct err *e)
{
    struct contact own = *m->parts.parts[i].plan.contact;
    struct scene scene = *m->chosen;
    struct arena *a = arena_open();
    struct plan p;
    struct run r;
    double all = 0, left = 0;
    error_pilot_alone(&scene, &own);
    bool ok = plan_make(stages_table, &own, &scene, a, &p, e) && run_open(&r, &p, &scene, NULL, e), open = ok;
    const struct board *b = &r.board;
    long frames = ok ? b->moving + (long)(0.5 * fmin(b->ring, PILOT_LONGEST) * b->rate) : 0;
    for (long from = 0, to; ok && from < frames; from = to) {
        to = from + STAGE_BLOCK < frames ? from + STAGE_BLOCK : frames;
        ok = run_block(&r, to, e);
        stopwatch_spend(SHOWN * (double)((to - from) * b->channels));
        const double *x = ok ? board_at(b, ITEM_SOUND, from) : NULL;
        for (long k = 0; ok && k < (to - from) * b->channels; k++) {
            double shown = error_pilot_shown(&scene, m->pilot[i].start + from + k / b->channels) * x[k];
            all += x[k] * x[k];
            left += shown * shown;
        }
    }
    if (open) run_close(&r);
    arena_close(a);
    *share = all > 0 ? left / all : 1;
    return ok;
}

/* The first survey of a contact, of oversampling where that is open, tells its energy.
   What comes in its order may begin with silence: longer beginnings, until something is heard. */
static bool begin(struct budgeting *m, int i, struct err *e)
{
    const struct contact *c = m->parts.parts[i].plan.contact;
    bool moves = c->surface.response.choice && c->surface.response.choice->moves;
    struct error_pilot *p = &m->pilot[i];
    double over = m->chosen->accuracy.oversampling, finer = fmin(2 * over, keys_knobs[KNOB_oversampling].high);
    struct accuracy set = m->chosen->accuracy, next = turned(m, KNOB_oversampling, finer);
    long before = -1;
    for (double some = m->sampled ? FIRST / 2 : FIRST; p->some != before; some *= 4) {
        before = p->some;
        if (!error_pilot_make(m->chosen, c, some, moves, m->sampled, m->arena, p, e)) return false;
        bool over_used = p->knobs & KNOB_BIT(oversampling) && c->contact.model != CONTACT_ROLL_COUPLED;
        if (!error_pilot_run(p, &set, over_used && finer > over ? &next : NULL, false, e)) return false;
        if (p->energy > 0) break;
    }
    double share = p->energy > 0 ? p->shown / p->energy : 1; /* at least: what is struck rings on, and the ramp opens */
    if (m->sounds && share < 0.5 && !shown_share(m, i, &share, e)) return false;
    m->energy += share * p->energy;
    return true;
}

/* Adds the energies of a contact's sound at the second of two ramps and of its difference from the first, until 40 dB
   after the motion's end. A short sound is kept for the next pair, which begins with it (going). */
static bool compare_ramps(const struct budgeting *m, int contact, const double ramp[2], bool going, double *all,
                          double *distance, struct err *e)
{
    struct ramp_sound *finer = &m->ramps[contact];
    struct contact own = *m->parts.parts[contact].plan.contact;
    struct arena *a = arena_open();
    struct scene set[2];
    struct plan p;
    struct run r[2];
    bool open[2] = {false, false}, ok;
    if (!going) finer->x = NULL;
    error_pilot_drop_residual(&own, a); /* it has no ramps */
    for (int k = 0; k < 2; k++) {
        set[k] = *m->chosen;
        error_pilot_alone(&set[k], &own);
        accuracy_turn(&set[k].accuracy, KNOB_gain_ramp, ramp[k]);
    }
    ok = plan_make(stages_table, &own, set, a, &p, e);
    bool depends = ok && plan_knobs(&p) & KNOB_BIT(gain_ramp);
    for (int k = finer->x || !depends; ok && k < 2; k++)
        ok = open[k] = run_open(&r[k], &p, &set[k], NULL, e);
    const struct board *b = &r[1].board;
    const struct ring_choice *choice = own.surface.response.choice;
    bool stretch = m->sampled && !(choice && ring_choice_glides(choice)); /* what is retuned drifts off as it rings */
    long first = stretch ? m->pilot[contact].fastest / RAMPS * RAMPS : 0,
         frames = ok ? b->moving + (long)(0.5 * fmin(b->ring, PILOT_LONGEST) * b->rate) - first : 0;
    if (stretch && frames > PILOT_STRETCH) frames = PILOT_STRETCH;
    if (ok && own.contact.model == CONTACT_ROLL_COUPLED && b->moving > m->pilot[contact].some)
        frames = m->pilot[contact].some; /* its beginning */
    long room = frames * (ok ? b->channels : 0);
    for (int k = 0; first > 0 && k < 2; k++)
        if (open[k]) run_skip(&r[k], first, FADE);
    if (depends && !finer->next && room <= SOUND_MOST) finer->next = ARENA_TAKE(m->arena, double, room);
    for (long from = first, to; ok && from < first + frames; from = to) {
        to = from + STAGE_BLOCK < first + frames ? from + STAGE_BLOCK : first + frames;
        ok = (!open[0] || run_block(&r[0], to, e)) && run_block(&r[1], to, e);
        if (!ok) break;
        stopwatch_spend(SHOWN * (double)((to - from) * b->channels));
        const double *y = board_at(b, ITEM_SOUND, from), *x = open[0]   ? board_at(&r[0].board, ITEM_SOUND, from)
                                                              : depends ? finer->x + (from - first) * b->channels
                                                                        : y;
        for (long i = 0; i < (to - from) * b->channels; i++) {
            double shown = error_pilot_shown(m->chosen, m->pilot[contact].start + from + i / b->channels),
                   sound = shown * y[i], off = shown * (x[i] - y[i]);
            *all += sound * sound;
            *distance += off * off;
        }
        if (finer->next)
            memcpy(finer->next + (from - first) * b->channels, y, (size_t)((to - from) * b->channels) * sizeof *y);
    }
    for (int k = 0; k < 2; k++)
        if (open[k]) run_close(&r[k]);
    arena_close(a);
    finer->x = finer->next;
    return ok;
}

static bool ramps_distance(const struct budgeting *m, const double ramp[2], bool going, double *distance, struct err *e)
{
    double all = 0, sum = 0;
    for (int i = 0; i < m->chosen->n_contacts; i++)
        if (is_audible(m, i) && !compare_ramps(m, i, ramp, going, &all, &sum, e)) return false;
    *distance = all > 0 ? m->energy * sum / all : 0;
    return true;
}

/* Energy of the difference between a value and a finer one, which follow others (going) or begin; [1]: as it is,
   without history. */
static bool knob_distance(struct budgeting *m, int knob, const double value[2], bool going, double distance[2],
                          struct err *e)
{
    struct accuracy set = turned(m, knob, value[0]), finer = turned(m, knob, value[1]);
    distance[0] = distance[1] = 0;
    if (knob == KNOB_gain_ramp) {
        if (!ramps_distance(m, value, going, distance, e)) return false;
        distance[1] = distance[0];
        if (!coupled(m)) return true;
    }
    for (int i = 0; i < m->chosen->n_contacts; i++) {
        struct error_pilot *p = &m->pilot[i];
        if (!is_audible(m, i) || !(p->knobs & 1u << knob)) continue;
        bool begun = knob == KNOB_oversampling && !going && p->contact.contact.model != CONTACT_ROLL_COUPLED &&
                     value[0] == m->chosen->accuracy.oversampling && value[1] == 2 * value[0] &&
                     set.tip_heights == m->chosen->accuracy.tip_heights && p->runs == 1; /* by begin */
        if (!begun && !error_pilot_run(p, &set, &finer, going, e)) return false;
        distance[0] += error_pilot_distance(p, going);
        distance[1] += error_pilot_distance(p, false);
    }
    return true;
}

/* True, with an error: a coupled ball bounces or, where the promise cannot be kept anyway (failed), leaves the surface.
 */
static bool run_chaos_pilot(const struct budgeting *m, bool failed, struct err *e)
{
    for (int i = 0; i < m->chosen->n_contacts; i++) {
        const struct error_pilot *x = &m->pilot[i];
        if (!is_audible(m, i) || x->contact.contact.model != CONTACT_ROLL_COUPLED ||
            (failed ? x->lift_offs : x->bounces) == 0)
            continue;
        err_about(e, NULL, "accuracy.error");
        err_set(e, ERR_SCENE,
                "accuracy.error: contact '%s': no error of a ball that bounces can be promised: it leaves the surface "
                "%ld times in its first %.3g s, and each time "
                "whatever two renders differ by grows, until they follow each other no more; take accuracy.error out, "
                "choose a preset, and compare statistics (rasp accuracy)",
                m->chosen->contacts[i].name, x->lift_offs, (double)x->some / m->chosen->output.sample_rate);
        return true;
    }
    return false;
}

/* ------------------------------------------------------------------ sharing */

/* The ramp after this one: odd, at most 0.4 of it, and no factor is in both. What ramps leave repeats with them, and
   the k-th harmonic of a ramp is as strong as the first of one k times as short: of two ramps that share a harmonic a
   mode at that frequency responds alike to both, and they agree by accident; and even ones all leave the same at half
   the rate. 256, 101, 39, 11, 3, 1. Presets, which halve, compare such ramps. */
static double ramp_after(double value)
{
    long next = (long)fmax(0.4 * value, 1), a, b, rest;
    for (next -= next % 2 == 0;; next -= 2) {
        for (a = (long)value, b = next; b > 0; a = b, b = rest)
            rest = a % b;
        if (a == 1) break;
    }
    return value > 1 ? (double)next : 0;
}

/* The coarsest value whose error is within the share, from the first on by doublings, of ramps by ramp_after; false
   without an error: none. A knob that the scene says has the value that it says. */
static bool climb(struct budgeting *m, int knob, double share, bool *had, struct err *e)
{
    const struct key_knob *k = &keys_knobs[knob];
    struct found *f = &m->found[knob];
    bool down = k->scale == KEY_SAMPLES, fixed = is_users(m, knob), looks_back = false;
    double value = fixed ? accuracy_knob(&m->asked->accuracy, (enum knob)knob) : k->preset[0], distance[2] = {0, 0},
           end = finest(m, knob, value, down ? k->low : k->high);
    double ahead[2] = {0, 0}; /* of the next value */
    *f = (struct found){.least = HUGE_VAL, .end = end};
    for (int step = 0;; step++) {
        double next = down ? ramp_after(value) : 2 * value, hand = step ? HAND : HAND_FIRST, d;
        bool last = down ? next < end : next > end, looks = !fixed && !down && 2 * next <= end;
        if (fixed) {
            double pair[2] = {value, last ? end : next};
            if (value == end) pair[0] = down ? 2 * end : fmax(floor(end / 2), k->low);
            if (!knob_distance(m, knob, pair, false, distance, e)) return false;
            hand = value == end ? HAND_LAST : HAND;
        } else if (last)
            hand = HAND_LAST;
        else if (step == 1 && looks_back)
            memcpy(distance, ahead, sizeof distance);
        else if (!knob_distance(m, knob, (double[2]){value, next}, step > 0, distance, e))
            return false;
        if (run_chaos_pilot(m, false, e)) return false;
        d = distance[last];
        if (step == 0 && looks &&
            !(d > 0 && FAR * d <= share)) { /* one that grows from here on was small by accident */
            if (!knob_distance(m, knob, (double[2]){next, 2 * next}, true, ahead, e)) return false;
            d = fmax(d, ahead[1]);
            looks_back = true;
        }
        d = d > 0 ? fmax(d, FLOOR * m->energy) : 0;
        f->value = value;
        f->energy = (hand == HAND_FIRST ? HAND : hand) * d;
        if (hand * d < f->least) {
            f->least = hand * d;
            f->best = value;
        }
        *had = hand * d <= share;
        if (*had || last || fixed) break;
        value = next;
    }
    return true;
}

/* The same for a preset: what the next doubling will bring is extrapolated from the two before it, where that is
   enough. Where no value keeps the error, that which comes nearest. */
static bool climb_sampled(struct budgeting *m, int knob, double share, bool *had, struct err *e)
{
    const struct key_knob *k = &keys_knobs[knob];
    struct found *f = &m->found[knob];
    bool down = k->scale == KEY_SAMPLES, going = false;
    double hand = knob == KNOB_gain_ramp ? HAND_RAMPS : HAND_SAMPLED;
    double value = accuracy_knob(&m->chosen->accuracy, (enum knob)knob),
           most = down ? k->low : fmin(k->high, fmax(k->preset[3], 4 * value)), end = finest(m, knob, value, most),
           before = 0, d = 0;
    *f = (struct found){.end = end};
    for (int step = 0;; step++) {
        double next = down ? floor(value / 2) : 2 * value, distance[2],
               falls = step > 1 && before > 0 ? fmin(fmax(d / before, FASTEST), SLOWEST) : SLOWEST;
        bool last = down ? next < end : next > end;
        before = d;
        d = step ? falls * d : 0;
        if (!last && (step == 0 || hand * d > share)) {
            if (!knob_distance(m, knob, (double[2]){value, next}, going, distance, e)) return false;
            d = distance[0] > 0 ? fmax(distance[0], FLOOR * m->energy) : 0;
            going = true;
        }
        if (step == 0 || hand * d < f->energy) {
            f->value = value;
            f->energy = hand * d;
        }
        *had = (step ? 1 : HAND_FIRST / HAND) * hand * d <= share;
        if (*had || last) return true;
        value = next;
    }
}

/* In which order knobs are chosen: oversampling, for which contact_steps are known by then, has what the others
   leave. */
static const int order[] = {KNOB_contact_steps, KNOB_gain_ramp, KNOB_tip_heights, KNOB_oversampling};

enum { ORDER = sizeof order / sizeof *order };
static_assert((int)ORDER == (int)KNOBS, "each knob has its place");

/* Each knob that is open has an equal share of what is left; what it does not use the next ones have. */
static bool share_budget(struct budgeting *m, double budget, bool *had, struct err *e)
{
    double left = budget;
    int open = 0;
    bool one, missed = false;
    *had = true;
    for (int k = 0; k < ORDER; k++) {
        if (!budget_used(m, order[k])) continue;
        if (!is_users(m, order[k])) {
            open++;
            continue;
        }
        if (!climb(m, order[k], left, &one, e)) return false;
        left -= m->found[order[k]].energy;
        *had = *had && left >= 0;
    }
    for (int k = 0; *had && k < ORDER; k++) {
        if (!budget_used(m, order[k]) || is_users(m, order[k])) continue;
        if (!(m->sampled ? climb_sampled : climb)(m, order[k], fmax(left, 0) / open--, had, e)) return false;
        left -= *had || !m->sampled ? m->found[order[k]].energy : 0; /* for one that is missed no other need be finer */
        missed = missed || !*had;
        *had = *had || m->sampled;
    }
    m->to->missed = m->sampled && missed;
    for (int k = 0; *had && k < ORDER; k++)
        if (budget_used(m, order[k]) && !is_users(m, order[k]))
            accuracy_turn(&m->chosen->accuracy, (enum knob)order[k], m->found[order[k]].value);
    return true;
}

static double decibel(double power) { return power > 0 ? 10 * real_log10(power) : -HUGE_VAL; }

/* ------------------------------------------------------------------ telling */

static void parts_text(struct budgeting *m)
{
    struct error_budget *p = m->to;
    double sum = 0;
    p->n = 0;
    for (int k = 0; k < KNOBS; k++) {
        double error = budget_used(m, k) && m->energy > 0 ? m->found[k].energy / m->energy : 0;
        sum += error;
        if (error > 0)
            p->parts[p->n++] = (struct error_budget_part){(enum knob)k, is_users(m, k), m->found[k].value, sqrt(error)};
    }
    p->predicted = p->diverges ? NAN : decibel(sum);
}

static const char *budget_text(struct arena *a, const char *preset, const struct error_budget *p)
{
    const char *text = p->asked ? arena_format(a, "accuracy: %.6g dB asked, ", p->error)
                                : arena_format(a, "accuracy: %s aims at %.6g dB, ", preset, p->error);
    if (p->diverges)
        return arena_format(a, "%sbut a ball bounces: renders of it diverge, and the knobs are the preset's own", text);
    if (isnan(p->predicted)) return arena_format(a, "%severy knob is said: nothing is chosen or predicted", text);
    if (p->n == 0) return arena_format(a, "%sno knob leaves an error", text);
    text = arena_format(a, "%s%.1f dB predicted: ", text, p->predicted);
    for (int i = 0; i < p->n; i++)
        text = arena_format(a, "%s%s%s %.6g %.1f dB%s", text, i ? ", " : "", keys_knobs[p->parts[i].knob].name,
                            p->parts[i].value, decibel(p->parts[i].error * p->parts[i].error),
                            p->parts[i].by_user ? " (said)" : "");
    return text;
}

/* What is in the way, and what could be had: every knob that is open at its best. */
static bool refuse(struct budgeting *m, struct err *e)
{
    struct error_budget *p = m->to;
    double most = 0, fixed = 0;
    int open = 0;
    bool had;
    if (run_chaos_pilot(m, true, e)) return false;
    for (int k = 0; k < ORDER; k++) {
        struct found *f = &m->found[order[k]];
        if (!budget_used(m, order[k])) continue;
        if (is_users(m, order[k])) {
            fixed += f->energy;
            continue;
        }
        if (!climb(m, order[k], -1, &had, e)) return false;
        f->value = f->best;
        f->energy = f->least;
        most = fmax(most, f->least);
        open++;
    }
    parts_text(m);
    const struct error_budget_part *worst = p->parts;
    for (int i = 0; i < p->n; i++)
        worst = p->parts[i].error > worst->error ? &p->parts[i] : worst;
    double best = ceil(decibel((fixed + open * most) / m->energy) + 1e-6), alone = decibel(worst->error * worst->error);
    err_about(e, NULL, "accuracy.error");
    if (worst->by_user)
        return err_set(e, ERR_SCENE,
                       "accuracy.error: %.6g dB cannot be promised: accuracy.%s is %.6g, which alone leaves %.1f dB; "
                       "take it out, or ask for %.0f dB at most",
                       p->error, keys_knobs[worst->knob].name, worst->value, alone, best);
    return err_set(e, ERR_SCENE,
                   "accuracy.error: %.6g dB cannot be promised: %s stands in the way, of which at its best, %.6g, no "
                   "less than %.1f dB is promised; the best that can be promised here is %.0f dB",
                   p->error, keys_knobs[worst->knob].name, worst->value, alone, best);
}

/* ------------------------------------------------------------------ choosing */

/* From the cheapest values of all knobs on. The engines are chosen then, and need not be again. */
static bool make(struct budgeting *m, struct err *e)
{
    bool had;
    bool ball = m->sampled && coupled(m);
    unsigned open = ~m->asked->accuracy.by_user & (ball ? KNOB_BIT(contact_steps) : ~0u);
    for (int k = 0; k < KNOBS; k++)
        if (open & 1u << k && !ball) accuracy_turn(&m->chosen->accuracy, (enum knob)k, keys_knobs[k].preset[0]);
    m->parts = render_parts_make(m->chosen, m->arena);
    double start = stopwatch_cpu(), spent = stopwatch_cycles();
    if (!render_parts_plan(&m->parts, e)) return false;
    m->to->read[0] = stopwatch_cpu() - start;
    m->to->read[1] = stopwatch_cycles() - spent;
    m->sounds = m->parts.asked & ITEM_BIT(ITEM_SOUND);
    m->pilot = ARENA_TAKE(m->arena, struct error_pilot, m->chosen->n_contacts);
    m->ramps = ARENA_TAKE(m->arena, struct ramp_sound, m->chosen->n_contacts);
    for (int i = 0; i < m->chosen->n_contacts; i++) {
        m->used |= plan_knobs(&m->parts.parts[i].plan);
        if (is_audible(m, i) && !begin(m, i, e)) return false;
    }
    if (m->sampled) m->used &= open;
    for (int i = 0; m->sampled && i < m->chosen->n_contacts; i++)
        if (m->pilot[i].bounces > 0) { /* which no step follows for long: what the preset has */
            m->chosen->accuracy = m->asked->accuracy;
            m->used = 0;
            m->to->diverges = true;
        }
    if ((!m->sampled && run_chaos_pilot(m, false, e)) ||
        !share_budget(m, real_exp10(m->to->error / 10) * m->energy, &had, e) || !(had || refuse(m, e)))
        return false;
    parts_text(m);
    struct contact *c = ARENA_TAKE(m->arena, struct contact, m->chosen->n_contacts);
    for (int i = 0; i < m->chosen->n_contacts; i++)
        c[i] = *m->parts.parts[i].plan.contact;
    m->chosen->contacts = c;
    return true;
}

/* For a preset an ablated scene has the knobs of the whole one: what it leaves out is then all that is different. */
static const struct scene *whole_scene(const struct scene *asked, struct arena *a)
{
    bool ablated = false;
    for (int i = 0; i < asked->n_contacts; i++)
        ablated = ablated || asked->contacts[i].ablation.given;
    if (!ablated) return asked;
    struct scene *whole = ARENA_TAKE(a, struct scene, 1);
    struct contact *c = ARENA_TAKE(a, struct contact, asked->n_contacts);
    *whole = *asked;
    whole->contacts = c;
    for (int i = 0; i < asked->n_contacts; i++) {
        c[i] = asked->contacts[i];
        c[i].ablation = (struct ablation){.place = {NAN, NAN}};
    }
    return whole;
}

bool error_budget_apply(const struct scene *asked, struct arena *a, struct scene *chosen, struct error_budget *p,
                        struct err *e)
{
    struct error_budget own;
    struct budgeting m = {.asked = asked, .chosen = chosen, .arena = a, .to = p ? p : &own};
    double start = stopwatch_cpu(), spent = stopwatch_cycles();
    bool strict = !isnan(asked->accuracy.error);
    *m.to = (struct error_budget){
        .asked = strict, .error = strict ? asked->accuracy.error : accuracy_target(&asked->accuracy), .predicted = NAN};
    m.sampled = !strict;
    if (m.sampled) m.asked = whole_scene(asked, a);
    *chosen = *m.asked;
    if (isnan(m.to->error)) {
        *chosen = *asked;
        return true;
    }
    m.to->chosen = asked->accuracy.by_user != (1u << KNOBS) - 1;
    if (m.to->chosen && !inputs_check(asked, a, e)) return false;
    bool ok = !m.to->chosen || make(&m, e);
    if (!ok && m.asked != asked && e->kind == ERR_SCENE) { /* what is ablated may be what cannot be had */
        *e = (struct err){0};
        m = (struct budgeting){.asked = asked, .chosen = chosen, .arena = a, .to = m.to, .sampled = true};
        *chosen = *asked;
        ok = make(&m, e);
    }
    if (!ok) return false;
    if (m.asked != asked) {
        struct accuracy set = chosen->accuracy;
        *chosen = *asked;
        chosen->accuracy = set;
    }
    chosen->accuracy.by_user = (1u << KNOBS) - 1;
    m.to->text = budget_text(a, asked->accuracy.preset, m.to);
    m.to->cpu = stopwatch_cpu() - start;
    m.to->cycles = stopwatch_cycles() - spent;
    return true;
}
