#include "pipeline/plan.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/stopwatch.h"
#include "convolution/ring_choice.h"
#include "output/impact_rows.h"
#include "output/sound.h"
#include "output/stems.h"
#include "pipeline/inputs.h"
#include "pipeline/render.h"
#include "pipeline/stages.h"
#include "response/listener.h"
#include "response/response.h"
#include "scene/accuracy.h"
#include "scene/keys.h"
#include "surface/roughness.h"
#include "trajectory/contact.h"

#define REAL_TIME 62500.0 /* cycles per audio sample of a core of 3 GHz at 48 kHz */

static const char *const plan_names[ITEM_COUNT] = {
    [ITEM_MOTION] = "motion",
    [ITEM_POSITION] = "position",
    [ITEM_VELOCITY] = "velocity",
    [ITEM_ACCELERATION] = "acceleration",
    [ITEM_LOAD] = "load",
    [ITEM_X] = "x",
    [ITEM_Y] = "y",
    [ITEM_VX] = "vx",
    [ITEM_VY] = "vy",
    [ITEM_AX] = "ax",
    [ITEM_AY] = "ay",
    [ITEM_ALPHA] = "alpha",
    [ITEM_SURFACE] = "surface",
    [ITEM_CURVATURE] = "curvature",
    [ITEM_SLOPE] = "slope",
    [ITEM_CURVATURE_Y] = "curvature_y",
    [ITEM_ROLL] = "roll",
    [ITEM_FOLLOWED] = "followed",
    [ITEM_SUBFORCE] = "subforce",
    [ITEM_FORCE] = "force",
    [ITEM_SURFACE_SOUND] = "surface_sound",
    [ITEM_SCRAPER_SOUND] = "scraper_sound",
    [ITEM_SOUND] = "sound",
    [ITEM_TABLE] = "table",
    [ITEM_LISTING] = "listing",
};

const char *plan_item(enum item item) { return plan_names[item]; }

unsigned plan_targets(const struct contact *c, const struct scene *s)
{
    const struct output *o = &s->output;
    unsigned all =
        (o->diagnostics.given ? ITEM_BIT(ITEM_TABLE) : 0) | (impact_rows_listed(c, o) ? ITEM_BIT(ITEM_LISTING) : 0);
    if (c->gain == 0) return all;
    if (response_audible(c, o)) all |= ITEM_BIT(ITEM_SOUND);
    if (stems_asked(o, STEM_FORCE)) all |= ITEM_BIT(ITEM_FORCE);
    if (stems_asked(o, STEM_SURFACE) && response_surface_rings(c)) all |= ITEM_BIT(ITEM_SURFACE_SOUND);
    if (stems_asked(o, contact_rolls(c) ? STEM_BALL : STEM_SCRAPER) && response_tool_rings(c))
        all |= ITEM_BIT(ITEM_SCRAPER_SOUND);
    return all;
}

/* One bit of a set, for a message. */
static const char *first_name(unsigned items)
{
    for (int i = 0; i < ITEM_COUNT; i++)
        if (items & ITEM_BIT(i)) return plan_names[i];
    return "nothing";
}

struct liveness {
    unsigned need, hard,
        done; /* read by something later; of these those without which it cannot run; given by a later stage */
    const char *by[ITEM_COUNT];
};

/* A stage that is needed becomes part of the plan. */
static bool plan_needs(const struct stage *st, const struct contact *c, const struct scene *s, struct liveness *l,
                       struct err *e)
{
    unsigned makes = st->gives & ~st->needs, needs = st->needs | (st->asks ? st->asks(c, s) : 0);
    if (makes & l->done)
        return err_set(e, ERR_SCENE, "contact '%s': two stages give %s: '%s' and one after it", c->name,
                       first_name(makes & l->done), st->name);
    l->done |= makes;
    l->need &= ~makes;
    l->hard &= ~makes;
    l->need |= needs | st->takes;
    l->hard |= needs;
    for (int i = 0; i < ITEM_COUNT; i++)
        if ((needs & ITEM_BIT(i))) l->by[i] = st->name;
    return true;
}

static bool choose_body(const struct contact *c, const struct scene *s, enum ring_body body, struct arena *a,
                        const struct ring_choice **choice, struct err *e)
{
    bool rings = body == RING_SURFACE ? response_surface_rings(c) : response_tool_rings(c);
    return !rings || *choice || ring_choice_make(c, s, body, a, choice, e);
}

bool plan_make(const struct stage *const *table, const struct contact *c, const struct scene *s, struct arena *a,
               struct plan *p, struct err *e)
{
    struct liveness l = {0};
    *p = (struct plan){.contact = c, .targets = plan_targets(c, s)};
    if (!p->targets && !(c->gain == 0 && response_audible(c, &s->output)))
        return err_set(e, ERR_SCENE,
                       "contact '%s': nothing is asked of it: give surface.response (or %s.response) for a sound, or "
                       "output.diagnostics for "
                       "a table of its physics",
                       c->name, contact_tool(c));
    if (p->targets & ITEM_BIT(ITEM_SOUND) && s->output.quantity != QUANTITY_FORCE) {
        struct contact *own = ARENA_TAKE(a, struct contact, 1); /* with its engines chosen, unless they are already */
        *own = *c;
        if (!choose_body(c, s, RING_SURFACE, a, &own->surface.response.choice, e) ||
            !choose_body(c, s, RING_SCRAPER, a, &own->scraper.response.choice, e))
            return false;
        p->contact = c = own;
    }
    while (table[p->n])
        p->n++;
    p->rows = ARENA_TAKE(a, struct plan_row, p->n);
    l.need = l.hard = p->targets;
    for (int i = p->n - 1; i >= 0; i--) {
        const struct stage *st = table[i];
        p->rows[i] = (struct plan_row){.stage = st, .verdict = PLAN_UNWANTED};
        if (!stages_wanted(st, c, s)) continue;
        /* a stage is needed when something reads what it gives, or, making an item a second time, would clash with who
         * gave it */
        p->rows[i].verdict = st->gives & (l.need | (l.done & ~st->needs)) ? PLAN_RUNS : PLAN_UNNEEDED;
        if (p->rows[i].verdict != PLAN_RUNS) continue;
        p->alive |= l.need & st->gives;
        p->rows[i].work = (l.need & st->gives) == ITEM_BIT(ITEM_MOTION)
                              ? 0
                              : stages_work(st, c, s); /* a motion that no stage has laid out costs nothing */
        p->rows[i].knobs = st->knobs | (st->turns ? st->turns(c, s) : 0);
        p->rows[i].reads = st->needs | st->takes | (st->asks ? st->asks(c, s) : 0);
        if (!plan_needs(st, c, s, &l, e)) return false;
    }
    p->alive |= p->targets;
    if (l.hard)
        return err_set(e, ERR_SCENE, "contact '%s': nothing in this scene gives its %s%s%s", c->name,
                       first_name(l.hard), l.by[__builtin_ctz(l.hard)] ? ", which is needed by " : "",
                       l.by[__builtin_ctz(l.hard)] ? l.by[__builtin_ctz(l.hard)] : "");
    return true;
}

bool plan_known(const struct plan *p, struct err *e)
{
    for (int i = 0; i < p->n; i++)
        if (p->rows[i].verdict == PLAN_RUNS && !(p->rows[i].work >= 0 && isfinite(p->rows[i].work)))
            return err_set(e, ERR_NUMBERS,
                           "contact '%s': %g cycles per audio sample are predicted for '%s': this is a fault of rasp, "
                           "not of the scene, which renders all the same",
                           p->contact->name, p->rows[i].work, p->rows[i].stage->name);
    return true;
}

unsigned plan_knobs(const struct plan *p)
{
    unsigned knobs = 0;
    for (int i = 0; i < p->n; i++)
        knobs |= p->rows[i].knobs;
    return knobs;
}

/* ------------------------------------------------------------------ text */

const char *plan_knobs_text(unsigned knobs, struct arena *a)
{
    const char *text = "";
    for (int k = 0; k < KNOBS; k++)
        if (knobs & 1u << k) text = arena_format(a, "%s%s%s", text, *text ? ", " : "", keys_knobs[k].name);
    return *text ? text : "none";
}

static void names_text(unsigned items, char *out, size_t size)
{
    out[0] = '\0';
    for (int i = 0; i < ITEM_COUNT; i++)
        if (items & ITEM_BIT(i))
            snprintf(out + strlen(out), size - strlen(out), "%s%s", out[0] ? " " : "", plan_names[i]);
}

void plan_print(const struct plan *p, FILE *out)
{
    char targets[200];
    double whole = 0, once = 0, work = 0;
    names_text(p->targets, targets, sizeof targets);
    for (int i = 0; i < p->n; i++) {
        whole += plan_row_cycles(&p->rows[i]);
        once += p->rows[i].once;
        work += p->rows[i].work;
    }
    fprintf(out, "contact '%s': %s\n", p->contact->name, p->targets ? targets : "nothing, its gain is 0");
    for (const struct plan_row *r = p->rows; r < p->rows + p->n; r++) {
        char from[200], to[200];
        if (r->verdict != PLAN_RUNS) continue;
        names_text(r->reads & p->alive, from, sizeof from);
        names_text(r->stage->gives & p->alive, to, sizeof to);
        fprintf(out, "  %-20s %5.1f %%  %s%s-> %s\n", r->stage->name, whole > 0 ? 100 * plan_row_cycles(r) / whole : 0,
                from, from[0] ? " " : "", to);
        fprintf(out, "  %-20s          %s%s%s%s\n", "", r->stage->does, r->stage->paper[0] ? " [" : "", r->stage->paper,
                r->stage->paper[0] ? "]" : "");
    }
    fprintf(out, "  about %.0f cycles per audio sample%s, and once %.2g million\n", work,
            work > REAL_TIME ? ": slower than real time" : "", once / 1e6);
    struct arena *a = arena_open();
    fprintf(out, "  turned by accuracy: %s\n", plan_knobs_text(plan_knobs(p), a));
    if (p->alive & ITEM_BIT(ITEM_SURFACE) && roughness_bytes(p->contact) > 0) /* the ground is kept as it is made */
        fprintf(out, "  up to %.0f MB of memory for roughness in the plane\n", roughness_bytes(p->contact) / 1e6);
    const char *ablation = contact_ablation(p->contact, a);
    if (ablation) fprintf(out, "  ablation: %s\n", ablation);
    arena_close(a);
    for (int i = 0; i < p->n; i++)
        if (p->rows[i].verdict == PLAN_UNWANTED)
            fprintf(out, "  not run: %-20s %s\n", p->rows[i].stage->name, p->rows[i].stage->idle);
        else if (p->rows[i].verdict == PLAN_UNNEEDED)
            fprintf(out, "  not run: %-20s nothing that is asked for needs it\n", p->rows[i].stage->name);
}

const char *const plan_beside_does[PLAN_BESIDE] = {
    [PLAN_CHOOSES] = "choosing the knobs",
    [PLAN_READS] = "reading responses, and objects' modes",
    [PLAN_WRITES] = "summing contacts, level, files",
};

double plan_row_cycles(const struct plan_row *r) { return r->once + r->work * r->frames; }

#define FILES 1.6e6  /* cycles of making, hashing and naming the files of a render */
#define ROW 2000.0   /* a row of a table that is hashed and written              */
#define CHANNEL 40.0 /* a sample of a channel that is summed, measured and written   */

/* What the parts, which are open, will do: what works on zeros does not work (run.c). */
static void estimate(const struct render_parts *p, struct arena *a, struct plan_scene_estimate *x)
{
    struct plan *plans = ARENA_TAKE(a, struct plan, p->scene->n_contacts);
    const struct output *o = &p->scene->output;
    x->sounds = p->asked & ITEM_BIT(ITEM_SOUND);
    x->once[PLAN_WRITES] += FILES;
    x->work[PLAN_WRITES] = x->sounds * CHANNEL * listener_channels(&p->scene->output);
    for (int i = 0; i < p->scene->n_contacts; i++) {
        const struct render_part *one = &p->parts[i];
        plans[i] = one->plan;
        if (plans[i].targets & ITEM_BIT(ITEM_TABLE))
            x->once[PLAN_WRITES] += ROW * (double)one->run.board.moving * o->diagnostics.rate / o->sample_rate;
        for (int k = 0, at = 0; k < plans[i].n; k++) {
            struct plan_row *r = &plans[i].rows[k];
            if (r->verdict != PLAN_RUNS || !one->open) continue;
            const struct stage_run *st = &one->run.stages[at];
            r->work = st->work;
            r->once = st->once;
            x->once[PLAN_WRITES] -= st->once;
            r->frames = fmax(0, fmin((double)run_works(&one->run, at++), (double)(x->length.frames - one->start)));
            x->cycles += plan_row_cycles(r);
        }
    }
    for (int k = 0; k < PLAN_BESIDE; k++)
        x->cycles += x->once[k] + x->work[k] * (double)x->length.frames;
    x->plans = plans;
}

/* The parts of a render are planned, opened and closed again; what they write into their tables goes nowhere. What is
   found of all parts goes into x. */
static bool open_parts(struct render_parts *p, struct arena *a, struct plan_scene_estimate *x, struct err *e)
{
    enum { MOST = (int)(sizeof((struct board *)0)->warnings / sizeof((struct board *)0)->warnings[0]) };
    double start = stopwatch_cycles();
    *x = (struct plan_scene_estimate){.quantity = -1};
    if (!inputs_check(p->scene, a, e) || !render_parts_plan(p, e)) return false;
    x->once[PLAN_READS] = stopwatch_cycles() - start;
    start = stopwatch_cycles();
    FILE *nowhere = memory_fopen("/dev/null", "w");
    bool ok = nowhere || err_set(e, ERR_IO, "/dev/null cannot be opened");
    for (int i = 0; ok && i < p->scene->n_contacts; i++) {
        struct render_part *one = &p->parts[i];
        one->rows.stream = one->impacts.stream = nowhere;
        if (!one->plan.targets) continue;
        ok = one->open = run_open(&one->run, &one->plan, p->scene, &(struct run_sinks){&one->rows, &one->impacts}, e);
    }
    ok = ok && render_parts_agree(p, e) && render_parts_length(p, &x->length, e);
    x->quantity = ok ? render_parts_quantity(p) : -1;
    x->warnings = ARENA_TAKE(a, const char *, p->scene->n_contacts *MOST + 1);
    for (int i = 0, n = 0; i < p->scene->n_contacts; i++) {
        const struct board *b = &p->parts[i].run.board;
        for (int k = 0; p->parts[i].open && k < b->n_warnings && k < MOST; k++)
            x->warnings[n++] = arena_text(a, b->warnings[k]); /* the text ends with its run */
    }
    x->once[PLAN_WRITES] = stopwatch_cycles() - start; /* with what the stages have opened, which is taken off */
    if (ok) estimate(p, a, x);
    render_parts_close(p);
    if (nowhere) fclose(nowhere);
    return ok;
}

bool plan_scene_estimate(const struct scene *s, struct arena *a, struct plan_scene_estimate *x, struct err *e)
{
    struct render_parts p = render_parts_make(s, a);
    return open_parts(&p, a, x, e);
}

bool plan_scene(const struct scene *s, struct arena *a, struct plan_scene_estimate *x, struct err *e)
{
    return plan_scene_estimate(s, a, x, e) && (!x->sounds || sound_long_enough(s, x->length.frames, e));
}

static bool add_knobs(const struct scene *s, struct arena *a, unsigned *knobs, struct err *e)
{
    struct render_parts p = render_parts_make(s, a);
    bool ok = render_parts_plan(&p, e);
    for (int i = 0; ok && i < s->n_contacts; i++)
        *knobs |= plan_knobs(&p.parts[i].plan);
    return ok;
}

bool plan_scene_knobs(const struct scene *s, struct arena *a, unsigned *knobs, struct err *e)
{
    *knobs = 0;
    if (!inputs_check(s, a, e) || !add_knobs(s, a, knobs, e)) return false;
    for (int i = 0; keys_presets[i]; i++) {
        struct scene other = *s;
        struct err refused = {0};
        accuracy_preset(&other.accuracy, keys_presets[i]);
        add_knobs(&other, a, knobs, &refused);
    }
    return true;
}
