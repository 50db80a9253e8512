/* By what means a response that has been read, in a reading that is settled, is made to ring: the engine, its hops or ramps from the error asked
   (ring_hops.h), and what that costs. Where the scene leaves it open the cheapest is taken. Errors reported are those of hops and ramps, as measured
   beforehand, and of what is left out of responses that are not heard to their end. */
#include "convolution/ring_means.h"

#include <math.h>

#include "convolution/gammatone.h"
#include "convolution/panned.h"
#include "convolution/ring_cost.h"
#include "convolution/ring_gammatone.h"
#include "convolution/ring_hops.h"
#include "num/real.h"
#include "response/ir.h"
#include "response/listener.h"
#include "scene/accuracy.h"

#define LONGEST_HOP 1.0 /* s */
#define NODES_BYTES 2e9 /* memory that nodes may take */

static bool engine_clash(const struct ring_choosing *c, const char *engine, struct err *e)
{
    static const char *const readings[] = {"auto", "fixed", "launch", "glide", "readout"};
    static const char *const can[] = {"", "resonators, overlap_add or nodes", "resonators, overlap_add or nodes", "resonators", "resonators or overlap_add"};
    err_about(e, c->contact->name, "surface.convolution");
    return err_set(e, ERR_SCENE, "contact '%s': %s.convolution: %s cannot do surface.moving: %s, which goes by %s; leave %s.convolution out",
                   c->contact->name, c->key, engine, readings[c->to->reading], can[c->to->reading], c->key);
}

double ring_means_knob(const struct ring_choosing *c, enum knob k)
{
    c->to->knobs |= 1u << k;
    return accuracy_knob(&c->scene->accuracy, k);
}

static double frames(const struct ring_choosing *c, double seconds)
{
    return fmax(floor(seconds * c->scene->output.sample_rate), 1);
}

/* What is left out, of a response that is not heard to its end: dB below its beginning. */
static double left_out(const struct ring_choosing *c)
{
    return fmax(140, 20 - ring_means_knob(c, KNOB_morph_error));
}

static double target(const struct ring_choosing *c)
{
    double db = ring_means_knob(c, KNOB_morph_error);
    return db < 0 ? real_exp10(db / 20) : 0;
}

static double both(double error, double other)
{
    return sqrt(error * error + other * other);
}

static struct ring_error_ask measuring(const struct ring_choosing *c, enum ring_error_kind kind, double longest)
{
    return (struct ring_error_ask){.kind = kind, .order = (int)ring_means_knob(c, KNOB_overlap_order), .hop = (int)frames(c, longest),
                                   .rate = c->scene->output.sample_rate, .until = isnan(c->given->length) ? HUGE_VAL : c->given->length, .end = c->heard.most};
}

/* One hop for all modes: the accuracy asked, but at most overlap_hop; morph_error 0: overlap_hop alone. */
static void choose_hop(struct ring_choosing *c)
{
    struct ring_error_ask ask = measuring(c, c->to->reading == MOVING_READOUT ? RING_ERROR_READOUT : RING_ERROR_LAUNCH, ring_means_knob(c, KNOB_overlap_hop));
    c->to->order = ask.order;
    double harder = gammatone_harder(c->to->gamma, ask.order);
    c->to->hop = ring_hops_one(&c->survey, &ask, target(c) > 0 ? target(c) / harder : HUGE_VAL, &c->to->error);
    c->to->error *= harder;
    if (isnan(c->given->length) && c->to->error > 0)
        c->to->error = both(c->to->error, real_exp10(-left_out(c) / 20));
}

/* Samples from one evaluation of gains and poles to the next, at most gain_ramp. */
static void choose_ramp(struct ring_choosing *c)
{
    bool glides = ring_choice_glides(c->to);
    c->to->ramp = 1;
    if (!c->to->moves)
        return;
    struct ring_error_ask ask = {.kind = glides ? RING_ERROR_GLIDE : RING_ERROR_RAMP, .order = 2, .hop = (int)ring_means_knob(c, KNOB_gain_ramp),
                                 .rate = c->scene->output.sample_rate, .until = HUGE_VAL, .end = HUGE_VAL};
    c->to->ramp = target(c) > 0 ? ring_hops_power(&c->survey, &ask, target(c), &c->to->error) : ask.hop;
    if (!(target(c) > 0))
        c->to->error = ring_error_all(&c->survey, &ask);
}

/* Is any mode dropped before the sound ends? A node is dropped by its own decay: the greatest of the way counts, at 65 instants. */
static bool forgets(const struct ring_choosing *c)
{
    const struct modes *m = &c->to->modes;
    struct modes_point at = modes_point_make(c->arena, m->n);
    double fastest = 0;
    for (int k = 0; k <= 64; k++) {
        ring_along_at(&c->survey.along, c->survey.duration * k / 64, &at);
        for (int i = 0; i < m->n; i++)
            fastest = fmax(fastest, m->shared ? m->decay[i] : at.decay[i]);
    }
    return 8.686 * fastest * c->heard.most > c->to->forgotten;
}

/* Hops are the error's alone (it counts the gains' movement too), unless none is asked for. */
static void choose_hops(struct ring_choosing *c, enum ring_error_kind kind)
{
    struct ring_error_ask ask = measuring(c, kind, target(c) > 0 ? LONGEST_HOP : ring_means_knob(c, KNOB_overlap_hop));
    c->to->order = ask.order;
    c->to->hops = ARENA_TAKE(c->arena, double, c->to->modes.n);
    c->to->error = ring_hops_each(&c->survey, &ask, target(c) > 0 ? target(c) : HUGE_VAL, c->to->hops);
    if (c->to->error > 0 || forgets(c))
        c->to->error = both(c->to->error, real_exp10(-c->to->forgotten / 20));
}

/* work: of one listening place. */
static void engine_set(struct ring_choosing *c, enum ring_engine engine, double work)
{
    c->to->engine = engine;
    c->to->work = work * listener_channels(&c->scene->output) + ring_cost_search(c) + ring_cost_listening(c);
}

/* Overlap-add's hop is looked for only where it might be chosen. */
static void choose_launch(struct ring_choosing *c)
{
    int asked = c->given->convolution;
    bool cut = !isnan(c->given->length) || c->to->gamma > 1, overlap = asked == ENGINE_OVERLAP_ADD || cut;
    if (!overlap)
        choose_hops(c, RING_ERROR_LAUNCH);
    double by_nodes = overlap ? HUGE_VAL : ring_cost_launch(c), error = c->to->error;
    if (!overlap && (asked == ENGINE_RESONATORS || by_nodes < ring_cost_overlap(c, frames(c, ring_means_knob(c, KNOB_overlap_hop))))) {
        engine_set(c, RING_LAUNCH, by_nodes);
        return;
    }
    choose_hop(c);
    double by_overlap = ring_cost_overlap(c, c->to->hop);
    overlap = overlap || by_overlap < by_nodes;
    engine_set(c, overlap ? RING_OVERLAP : RING_LAUNCH, overlap ? by_overlap : by_nodes);
    if (!overlap)
        c->to->error = error;
}

/* By resonators, or by impulse responses where they are cheaper, whose cost at the longest hop that might do is known without looking for it. */
static void choose_readout(struct ring_choosing *c)
{
    int asked = c->given->convolution;
    bool cut = !isnan(c->given->length) || c->to->gamma > 1, overlap = asked == ENGINE_OVERLAP_ADD || cut;
    if (!overlap)
        choose_hops(c, RING_ERROR_READOUT);
    double by_modes = overlap ? HUGE_VAL : ring_cost_recall(c), error = c->to->error;
    if (!overlap && (asked == ENGINE_RESONATORS || by_modes < ring_cost_overlap(c, frames(c, ring_means_knob(c, KNOB_overlap_hop))))) {
        engine_set(c, RING_READOUT, by_modes);
        return;
    }
    choose_hop(c);
    double by_overlap = ring_cost_overlap(c, c->to->hop);
    overlap = overlap || by_overlap < by_modes;
    engine_set(c, RING_READOUT, overlap ? by_overlap : by_modes);
    if (overlap)
        c->to->hops = NULL;
    else
        c->to->error = error;
}

/* All nodes are kept: a motion may come back to each, and between two kinks all are at work at once. */
static bool nodes_fit(struct ring_choosing *c, struct err *e)
{
    double rate = c->scene->output.sample_rate, seconds = c->to->seconds;
    c->to->bytes = listener_channels(&c->scene->output) * panned_bytes(c->to->nodes.n, ir_length(rate, seconds));
    if (c->to->bytes <= NODES_BYTES)
        return true;
    return err_set(e, ERR_SCENE, "contact '%s': surface.convolution: nodes would take %.3g GB of memory, and may take %.3g GB: %d responses of %.4g s, 16 bytes a sample; "
                                 "leave it out, or choose resonators or overlap_add, or shorten output.tail or surface.response_length",
                   c->contact->name, c->to->bytes / 1e9, NODES_BYTES / 1e9, c->to->nodes.n * listener_channels(&c->scene->output), seconds);
}

/* A response at each node, each convolved whole. */
static bool choose_nodes(struct ring_choosing *c, struct err *e)
{
    double error = target(c) > 0 ? target(c) : 1e-7;
    if (c->to->modes.shared || c->to->modes.travels)
        return err_set(e, ERR_SCENE, "contact '%s': surface.convolution: nodes is for poles that differ from place to place, and those of %s %s; leave it out",
                       c->contact->name, c->to->modes.name, c->to->modes.shared ? "are the same everywhere" : "change over time");
    if (!c->trajectory.straight)
        return err_set(e, ERR_SCENE, "contact '%s': surface.convolution: nodes needs a straight motion; leave it out, or choose overlap_add", c->contact->name);
    if (!ring_nodes(&(struct ring_nodes_ask){&c->to->modes, &c->trajectory, c->to->seconds, error}, c->arena, &c->to->nodes))
        return err_set(e, ERR_SCENE, "contact '%s': surface.convolution: nodes would need %d nodes or more for an accuracy.morph_error of %g dB; choose "
                                     "resonators or overlap_add", c->contact->name, c->to->nodes.n, 20 * real_log10(error));
    if (!nodes_fit(c, e))
        return false;
    engine_set(c, RING_PANNED, ring_cost_nodes(c));
    c->to->error = error;
    return true;
}

/* How long responses are heard. Resonators for poles that do not move ring on by themselves. */
static void settle_end(struct ring_choosing *c)
{
    double db = ring_means_knob(c, KNOB_morph_error);
    c->to->forgotten = db < 0 ? 20 - db : 140;
    c->to->seconds = isnan(c->given->length) ? modes_ring_time(&c->to->modes, gammatone_decibel(c->to->gamma, left_out(c))) : c->given->length;
    c->to->seconds = fmin(c->to->seconds, c->heard.most + 2 / c->scene->output.sample_rate);
}

bool ring_means_choose(struct ring_choosing *c, struct err *e)
{
    int asked = c->given->convolution, reading = c->to->reading;
    bool cut = !isnan(c->given->length), nodes = asked == ENGINE_NODES && c->to->moves;
    bool rings = reading == MOVING_GLIDE || (reading == MOVING_FIXED && asked != ENGINE_OVERLAP_ADD && !cut && !nodes);
    if (!ring_gammatone_fits(c, e))
        return false;
    if (!rings)
        settle_end(c);
    if (nodes && (reading == MOVING_FIXED || reading == MOVING_LAUNCH))
        return choose_nodes(c, e) || err_about(e, c->contact->name, "surface.convolution");
    if (reading == MOVING_GLIDE && asked != ENGINE_AUTO && asked != ENGINE_RESONATORS)
        return engine_clash(c, asked == ENGINE_NODES ? "nodes" : "overlap_add", e);
    if (reading == MOVING_READOUT && asked == ENGINE_NODES)
        return engine_clash(c, "nodes", e);
    if (rings) {
        choose_ramp(c);
        engine_set(c, RING_RESONATORS, ring_cost_resonators(c));
    } else if (reading == MOVING_LAUNCH) {
        choose_launch(c);
    } else if (reading == MOVING_READOUT) {
        choose_readout(c);
    } else {
        if (c->to->moves)
            choose_hop(c);
        engine_set(c, RING_OVERLAP, c->to->moves ? ring_cost_overlap(c, c->to->hop) : ring_cost_still(c));
    }
    return true;
}
