/* Which engine makes a body ring. What the scene leaves open (surface.moving: auto, surface.convolution: auto) is decided here, where the response
   has been read: poles that are the same everywhere make `fixed`, exact and cheapest; separate ones `launch`, by the cheapest engine that keeps
   accuracy.morph_error (predicted from what is measured, see below). */
#include "convolution/ring_choice.h"

#include <math.h>

#include "convolution/launch.h"
#include "num/real.h"
#include "response/object.h"
#include "response/space.h"
#include "scene/rules.h"
#include "trajectory/trajectory.h"

/* Cycles, measured by tests/bench on one core (Zen 5, gcc, any number of modes): */
#define RESONATOR 0.8          /* a mode and sample, poles fixed                   */
#define GLIDING 1.2            /* ... poles ramped                                 */
#define DRIVEN 0.8             /* a mode, sample and node under force              */
#define LAUNCHED 0.1           /* a node that rings and sample                     */
#define EVALUATED 40.0         /* a mode where the contact is                      */
#define LONGEST_HOP 1.0        /* s                                                */
#define TRANSFORM 150.0        /* three FFTs, per sample of them                   */
#define SAMPLED 0.7            /* a mode and sample of an impulse response         */
#define PARTITION (1 / 110.0)  /* a sample of a response that is convolved as it is */

struct choosing {
    const struct contact *contact;
    const struct scene *scene;
    const struct response *given;
    const char *key;
    struct arena *arena;
    struct ring_choice *to;
    struct trajectory trajectory;
};

/* ------------------------------------------------------------------ reading */

static bool read_object(struct choosing *c, const struct modes_ask *ask, struct err *e)
{
    struct object *o = ARENA_TAKE(c->arena, struct object, 1);
    struct object_ask what = {.key = arena_format(c->arena, "%s.object", c->key), .top = 0.499 * ask->rate, .most = 4 * ask->strongest};
    if (!object_make(&c->given->object, &what, c->arena, o, &c->to->note, e))
        return err_at(e, "contact '%s'", c->contact->name);
    object_modes(o, c->given->object.origin, NULL, ask->strongest, c->arena, &c->to->modes);
    return true;
}

static bool read_modes(struct choosing *c, struct err *e)
{
    double rate = c->scene->output.sample_rate;
    struct modes_ask ask = {.strongest = c->given->modes, .pairing = c->given->pairing, .rate = rate};
    struct modes *m = &c->to->modes;
    if (c->given->object.given ? !read_object(c, &ask, e)
        : c->given->space.given ? !space_modes(&c->given->space, &ask, c->arena, m, e)
                                : !modes_table(c->given->file, &ask, c->arena, m, e))
        return false;
    c->to->note = c->to->note ? c->to->note : m->note;
    c->to->high = modes_drop_above(m, rate);
    return m->n > 0 || err_set(e, ERR_SCENE, "%s: all of its modes lie above %.6g Hz (0.499 times output.sample_rate), and nothing would ring: raise "
                                             "output.sample_rate, or check that frequency_hz is in Hz", m->name, 0.499 * rate);
}

/* ------------------------------------------------------------------ readings */

static bool moves(const struct choosing *c, enum ring_body body)
{
    const struct modes *m = &c->to->modes;
    return body == RING_SURFACE && ((m->moves && c->contact->motion.path != PATH_STILL) || m->travels);
}

static bool choose_reading(struct choosing *c, enum ring_body body, struct err *e)
{
    const struct modes *m = &c->to->modes;
    int asked = body == RING_SURFACE ? c->given->moving : MOVING_AUTO;
    c->to->moves = moves(c, body);
    c->to->reading = asked != MOVING_AUTO ? asked : m->shared ? MOVING_FIXED : m->travels ? MOVING_GLIDE : MOVING_LAUNCH;
    if (asked == MOVING_FIXED && !m->shared && c->to->moves)
        return err_set(e, ERR_SCENE, "contact '%s': surface.moving: fixed needs poles that are the same everywhere, and those of %s differ from place to "
                                     "place; leave surface.moving out, or choose launch, glide or readout", c->contact->name, m->name);
    if (!c->to->moves)
        c->to->reading = MOVING_FIXED;
    return true;
}

static bool engine_clash(const struct choosing *c, const char *engine, struct err *e)
{
    static const char *const readings[] = {"auto", "fixed", "launch", "glide", "readout"};
    static const char *const can[] = {"", "resonators, overlap_add or nodes", "resonators, overlap_add or nodes", "resonators", "overlap_add"};
    return err_set(e, ERR_SCENE, "contact '%s': %s.convolution: %s cannot do surface.moving: %s, which goes by %s; leave %s.convolution out",
                   c->contact->name, c->key, engine, readings[c->to->reading], can[c->to->reading], c->key);
}

/* ------------------------------------------------------------------ engines */

static double frames(const struct choosing *c, double seconds)
{
    return fmax(floor(seconds * c->scene->output.sample_rate), 1);
}

/* Seconds of an impulse response that is computed. */
static double response_seconds(const struct choosing *c)
{
    double cut = c->given->length;
    return isnan(cut) ? fmin(modes_ring_time(&c->to->modes, 140), 60) : cut;
}

static double target(const struct choosing *c)
{
    double db = c->scene->accuracy.morph_error;
    return db < 0 ? real_exp10(db / 20) : 0;
}

/* One hop for all modes: the accuracy asked, but at most overlap_hop; morph_error 0: overlap_hop alone. */
static void choose_hop(struct choosing *c)
{
    const struct accuracy *a = &c->scene->accuracy;
    double hop = a->overlap_hop;
    c->to->order = (int)a->overlap_order;
    if (target(c) > 0)
        hop = ring_survey_hop(&c->to->survey, c->to->order, target(c), hop);
    c->to->hop = (int)frames(c, hop);
    c->to->error = ring_survey_error(&c->to->survey, c->to->order, c->to->hop / c->scene->output.sample_rate);
}

static double overlap_work(const struct choosing *c, double hop)
{
    double length = response_seconds(c) * c->scene->output.sample_rate, whole = length + hop * c->scene->accuracy.overlap_order;
    return (TRANSFORM * whole + SAMPLED * c->to->modes.n * length) / hop;
}

/* Nodes that ring at a time: under force, and until they have decayed by the error asked and 20 dB. Hops are the error's alone (it counts the gains'
   movement too), unless none is asked for. */
static double launch_work(struct choosing *c)
{
    const struct modes *m = &c->to->modes;
    const struct accuracy *a = &c->scene->accuracy;
    double rate = c->scene->output.sample_rate, db = a->morph_error < 0 ? 20 - a->morph_error : 140, shortest = HUGE_VAL, ringing = 0;
    double *hops = c->to->hops = ARENA_TAKE(c->arena, double, m->n);
    ring_survey_hops(&c->to->survey, (int)a->overlap_order, target(c) > 0 ? target(c) : HUGE_VAL, target(c) > 0 ? LONGEST_HOP : a->overlap_hop, hops);
    for (int i = 0; i < m->n; i++) {
        hops[i] = frames(c, hops[i]);
        shortest = fmin(shortest, hops[i]);
        ringing += db / 8.686 / fmax(m->slowest[i], 1e-3) * rate / hops[i];
    }
    return m->n * (DRIVEN * a->overlap_order + 3 + 2 * EVALUATED / shortest) + LAUNCHED * ringing;
}

static void engine_set(struct choosing *c, enum ring_engine engine, double work)
{
    c->to->engine = engine;
    c->to->work = work;
}

static void choose_launch(struct choosing *c)
{
    double by_nodes = isnan(c->given->length) ? launch_work(c) : HUGE_VAL;
    choose_hop(c);
    double by_overlap = overlap_work(c, c->to->hop);
    bool overlap = c->given->convolution == ENGINE_OVERLAP_ADD || (c->given->convolution == ENGINE_AUTO && by_overlap < by_nodes);
    engine_set(c, overlap ? RING_OVERLAP : RING_LAUNCH, overlap ? by_overlap : by_nodes);
    if (!overlap)
        c->to->error = target(c);
}

/* A response at each node, each convolved whole. */
static bool choose_nodes(struct choosing *c, struct err *e)
{
    double error = target(c) > 0 ? target(c) : 1e-7;
    if (c->to->modes.shared || c->to->modes.travels)
        return err_set(e, ERR_SCENE, "contact '%s': surface.convolution: nodes is for poles that differ from place to place, and those of %s %s; leave it out",
                       c->contact->name, c->to->modes.name, c->to->modes.shared ? "are the same everywhere" : "change over time");
    if (!c->trajectory.straight)
        return err_set(e, ERR_SCENE, "contact '%s': surface.convolution: nodes needs a straight motion; leave it out, or choose overlap_add", c->contact->name);
    if (!ring_nodes(&c->to->modes, &c->trajectory, error, c->arena, &c->to->nodes))
        return err_set(e, ERR_SCENE, "contact '%s': surface.convolution: nodes would need %d nodes or more for an accuracy.morph_error of %g dB; choose "
                                     "resonators or overlap_add", c->contact->name, c->to->nodes.n, 20 * real_log10(error));
    engine_set(c, RING_PANNED, 100 + c->to->nodes.n * response_seconds(c) * c->scene->output.sample_rate * PARTITION);
    c->to->error = error;
    return true;
}

static bool choose_engine(struct choosing *c, struct err *e)
{
    int asked = c->given->convolution, reading = c->to->reading;
    double n = c->to->modes.n;
    if (asked == ENGINE_NODES && c->to->moves && (reading == MOVING_FIXED || reading == MOVING_LAUNCH))
        return choose_nodes(c, e);
    if (reading == MOVING_GLIDE && asked != ENGINE_AUTO && asked != ENGINE_RESONATORS)
        return engine_clash(c, asked == ENGINE_NODES ? "nodes" : "overlap_add", e);
    if (reading == MOVING_READOUT && asked != ENGINE_AUTO && asked != ENGINE_OVERLAP_ADD)
        return engine_clash(c, asked == ENGINE_NODES ? "nodes" : "resonators", e);
    bool cut = !isnan(c->given->length);
    if (reading == MOVING_GLIDE || (reading == MOVING_FIXED && asked != ENGINE_OVERLAP_ADD && !cut)) {
        engine_set(c, RING_RESONATORS, 10 + n * (reading == MOVING_GLIDE ? GLIDING : RESONATOR));
    } else if (reading == MOVING_LAUNCH) {
        choose_launch(c);
    } else if (reading == MOVING_READOUT) {
        choose_hop(c);
        engine_set(c, RING_READOUT, overlap_work(c, c->to->hop));
    } else {
        if (c->to->moves)
            choose_hop(c);
        engine_set(c, RING_OVERLAP, c->to->moves ? overlap_work(c, c->to->hop) : 100 + response_seconds(c) * c->scene->output.sample_rate * PARTITION);
    }
    return true;
}

static bool choose_modal(struct choosing *c, enum ring_body body, struct err *e)
{
    if (!read_modes(c, e) || !choose_reading(c, body, e))
        return false;
    bool bank = c->to->reading == MOVING_FIXED && (c->given->convolution == ENGINE_AUTO || c->given->convolution == ENGINE_RESONATORS);
    if (c->to->moves && !(bank && isnan(c->given->length))) {
        if (!trajectory_make(&c->contact->motion, trajectory_seed(c->scene, c->contact), c->arena, &c->trajectory, e))
            return err_at(e, "contact '%s'", c->contact->name);
        ring_survey(&(struct ring_survey_ask){&c->to->modes, c->contact->contact.model == CONTACT_SCRAPE, c->to->reading == MOVING_READOUT}, &c->trajectory, c->arena, &c->to->survey);
    }
    return choose_engine(c, e);
}

static void choose_recorded(struct choosing *c, enum ring_body body)
{
    double seconds = isnan(c->given->length) ? 1 : c->given->length, rate = c->scene->output.sample_rate;
    bool folder = rules_is_folder(c->given);
    c->to->recorded = true;
    c->to->reading = MOVING_FIXED;
    c->to->moves = folder && body == RING_SURFACE && c->contact->motion.path != PATH_STILL;
    engine_set(c, folder ? RING_PANNED : RING_OVERLAP, 100 + (folder ? 8 : 1) * seconds * rate * PARTITION);
}

static const struct response *given_of(const struct contact *c, enum ring_body body)
{
    return body == RING_SURFACE ? &c->surface.response : &c->scraper.response;
}

bool ring_choice_make(const struct contact *c, const struct scene *s, enum ring_body body, struct arena *a, const struct ring_choice **choice,
                 struct err *e)
{
    const struct response *given = given_of(c, body);
    *choice = NULL;
    if (!rules_responds(given) || (body == RING_SCRAPER && c->scraper.weight == 0))
        return true;
    struct ring_choice *to = ARENA_TAKE(a, struct ring_choice, 1);
    struct choosing me = {.contact = c, .scene = s, .given = given, .key = body == RING_SURFACE ? "surface" : "scraper", .arena = a, .to = to};
    *choice = to;
    if (given->file && !rules_is_table(given)) {
        choose_recorded(&me, body);
        return true;
    }
    return choose_modal(&me, body, e);
}

enum ring_engine ring_choice_engine(const struct contact *c, enum ring_body body)
{
    const struct ring_choice *choice = given_of(c, body)->choice;
    return choice ? choice->engine : RING_NONE;
}

double ring_choice_work(const struct contact *c, enum ring_body body)
{
    const struct ring_choice *choice = given_of(c, body)->choice;
    return choice ? choice->work : 0;
}
