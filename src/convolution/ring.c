/* Total response: surface + eta x scraper (papers/000 section 2.4: the scraper's response is "weighted by eta"; its equation 11 omits it), heard at
   each listening place. */
#include "convolution/ring.h"

#include <math.h>
#include <string.h>

#include "convolution/alias.h"
#include "convolution/gammatone.h"
#include "convolution/ring_alias.h"
#include "convolution/ring_along.h"
#include "convolution/ring_reach.h"
#include "response/object.h"
#include "scene/ball.h"
#include "scene/rules.h"
#include "trajectory/trajectory.h"

/* ------------------------------------------------------------------ voices */

static const struct response *ring_given(const struct contact *c, enum ring_body body)
{
    return body == RING_SURFACE ? &c->surface.response : &c->scraper.response;
}

/* A surface's object heard at other places of it than the one that is touched has modes of its own for each (ask->listen is then set). */
static const struct modes *voice_modes(const struct ring *g, struct stage_run *r, struct listener_ask *ask)
{
    const struct modes *m = &g->choice->modes;
    double *place = ARENA_TAKE(r->arena, double, 2);
    if (g->body != RING_SURFACE || !m->object || !listener_place(ask, m->object, r->arena, place))
        return m;
    struct modes *own = ARENA_TAKE(r->arena, struct modes, 1);
    object_modes(m->object, ask->origin, place, m->object->n, r->arena, own);
    modes_drop_above(own, r->board->rate);
    ask->listen = place;
    return own;
}

static bool voice_open(struct ring *g, struct stage_run *r, int channel, struct err *e)
{
    struct ring_voice *v = &g->voices[channel];
    const double *origin = ring_given(r->contact, g->body)->object.origin;
    struct listener_ask ask = {.output = &r->scene->output, .channel = channel, .origin = origin, .rate = r->board->rate};
    v->modes = voice_modes(g, r, &ask);
    if (!(v->listener = listener_make(r->arena, &ask, v->modes, e)))
        return err_at(e, "contact '%s': %s", r->contact->name, g->key);
    v->n = v->modes->n + listener_extra(v->listener);
    v->delay = listener_delay(v->listener);
    v->frequency = ARENA_TAKE(r->arena, double, v->n);
    v->decay = ARENA_TAKE(r->arena, double, v->n);
    v->end = modes_point_make(r->arena, v->n);
    memcpy(v->frequency, v->modes->frequency, (size_t)v->modes->n * sizeof *v->frequency);
    memcpy(v->decay, v->modes->decay, (size_t)v->modes->n * sizeof *v->decay);
    listener_poles(v->listener, v->frequency + v->modes->n, v->decay + v->modes->n);
    v->alias = ring_alias_make(g, v, r->arena);
    g->delay = v->delay > g->delay ? v->delay : g->delay;
    return true;
}

/* ------------------------------------------------------------------ what the board is told */

/* All that is summed is of one quantity; what is recorded does not say its own, and goes with any. */
static bool note_quantity(const struct ring *g, struct board *b, struct err *e)
{
    int quantity = listener_quantity(g->voices[0].listener);
    if (b->quantity >= 0 && b->quantity != quantity)
        return err_set(e, ERR_SCENE,
                       "%s: this response gives %s, but the surface's gives %s: they cannot be summed; use tables of one quantity, or choose one "
                       "by output.quantity", g->choice->modes.name, modes_quantity_name(quantity), modes_quantity_name(b->quantity));
    b->quantity = quantity;
    return true;
}

static void note_ring(const struct ring *g, const struct response *given, struct board *b)
{
    double ring = modes_ring_time(&g->choice->modes, gammatone_decibel(g->choice->gamma, 80)) + (double)g->delay / b->rate;
    b->ring = fmax(b->ring, isnan(given->length) ? ring : fmin(ring, given->length));
}

/* The sound ends 60 s after the last force where output.tail is auto (pipeline/render_parts.c). */
static void note_endless(const struct ring *g, const struct response *given, struct stage_run *r)
{
    double falls = gammatone_decibel(g->choice->gamma, 80), ring = modes_ring_time(&g->choice->modes, falls);
    if (isnan(r->scene->output.tail) && isnan(r->scene->output.duration) && isnan(given->length) && ring > 60)
        board_warn(r->board, arena_format(r->arena, "%s: its slowest mode has fallen by %.3g dB only when the sound ends, 60 s after the motion: set output.tail, or "
                                          "give the mode more decay", g->choice->modes.name, gammatone_fallen(g->choice->gamma, falls * 60 / ring)));
}

static void note_warnings(const struct ring *g, struct stage_run *r)
{
    if (g->choice->note)
        board_warn(r->board, g->choice->note);
    if (g->choice->high)
        board_warn(r->board, arena_format(r->arena, "%s: %d of its %d strongest modes lie%s above %g Hz, 0.45 of the sample rate, and do%s not ring: raise output.sample_rate, "
                                          "or end the key band there", g->choice->modes.name, g->choice->high, g->choice->chosen, g->choice->high == 1 ? "s" : "",
                                          MODES_TOP * g->board->rate, g->choice->high == 1 ? "es" : ""));
}

bool ring_open(struct ring *g, struct stage_run *r, enum ring_body body, struct err *e)
{
    bool surface = body == RING_SURFACE;
    const struct response *given = ring_given(r->contact, body);
    *g = (struct ring){.body = body, .choice = given->choice, .board = r->board, .contact = r->contact, .key = surface ? "surface" : ball_tool(r->contact),
                       .out = surface ? ITEM_SURFACE_SOUND : ITEM_SCRAPER_SOUND, .weight = surface ? 1 : r->contact->scraper.weight,
                       .moves = given->choice->moves, .morph_error = r->scene->accuracy.morph_error,
                       .stays = given->choice->reading == MOVING_GLIDE || given->choice->reading == MOVING_READOUT, .channels = r->board->channels};
    r->seconds += g->choice->cpu;
    g->voices = ARENA_TAKE(r->arena, struct ring_voice, g->channels);
    g->y = ARENA_TAKE(r->arena, double, STAGE_BLOCK);
    if (g->choice->recorded)
        return true;
    for (int k = 0; k < g->channels; k++)
        if (!voice_open(g, r, k, e))
            return err_about(e, r->contact->name, ring_choice_about(r->contact, body));
    note_ring(g, given, r->board);
    note_warnings(g, r);
    note_endless(g, given, r);
    r->back = (int)g->delay + (g->choice->reading == MOVING_READOUT ? ALIAS_REACH : 0);
    r->ahead = ALIAS_REACH;
    bool ok = note_quantity(g, r->board, e) && (!surface || ring_reach(&g->choice->modes, r, e));
    return ok || err_about(e, r->contact->name, ring_choice_about(r->contact, body));
}

/* ------------------------------------------------------------------ a voice at work */

void ring_point_in(const struct ring *g, const struct ring_voice *v, const struct modes_where *where, const struct modes_point *p)
{
    modes_at(v->modes, where, &(struct modes_point){v->frequency, v->decay, p->re, p->im});
    listener_apply(v->listener, v->frequency, v->decay, &(struct modes_point){NULL, NULL, p->re, p->im});
    for (int i = 0; g->weight != 1 && i < v->n; i++) {
        p->re[i] *= g->weight;
        p->im[i] *= g->weight;
    }
    if (g->choice->gamma > 1) {
        gammatone_gains(g->choice->gamma, v->modes->n, v->decay, p);
        for (int i = v->modes->n; i < v->n; i++)
            p->re[i] = p->im[i] = 0;
    }
    if (p->frequency) {
        memcpy(p->frequency, v->frequency, (size_t)v->n * sizeof *p->frequency);
        memcpy(p->decay, v->decay, (size_t)v->n * sizeof *p->decay);
    }
}

void ring_point_at(const struct ring *g, const struct ring_voice *v, double frame, const struct modes_point *p)
{
    struct modes_where where = {v->modes->home[0], v->modes->home[1], 0};
    const struct trajectory *tr = g->board->trajectory;
    double last = tr->duration, t = (frame - (double)v->delay) / g->board->rate, end = t < 0 ? 0 : last;
    if (g->stays)
        t = fmin(fmax(t, 0), last);
    if (g->body == RING_SURFACE && g->moves && (t < 0 || t > last)) {
        struct modes_where inside = ring_along_where(tr, fmin(fmax(2 * end - t, 0), last));
        ring_point_in(g, v, &inside, p);
        if (ring_along_returns(v->modes, tr, t))
            return;
        where = ring_along_where(tr, end);
        ring_point_in(g, v, &where, &v->end);
        ring_along_mirror(v->n, &v->end, p);
        return;
    }
    if (g->body == RING_SURFACE)
        where = g->moves ? ring_along_where(tr, t) : ring_along_first(g->contact, tr);
    ring_point_in(g, v, &where, p);
}

double *ring_component_hops(const struct ring *g, const struct ring_voice *v, struct arena *a)
{
    const struct ring_choice *c = g->choice;
    double *all = ARENA_TAKE(a, double, v->n), least = c->hops[0];
    for (int i = 1; i < c->modes.n; i++)
        least = fmin(least, c->hops[i]);
    for (int i = 0; i < v->n; i++)
        all[i] = v->modes == &c->modes && i < c->modes.n ? c->hops[i] : least;
    return all;
}

void ring_put(const struct ring *g, int channel, long from, long to)
{
    double *out = board_at(g->board, g->out, from) + channel;
    if (!g->choice->recorded)
        ring_alias_add(g->voices[channel].alias, g, &g->voices[channel], g->y, from, to);
    if (g->channels == 1)
        memcpy(out, g->y, (size_t)(to - from) * sizeof *out);
    for (long n = 0; g->channels > 1 && n < to - from; n++)
        out[n * g->channels] = g->y[n];
}

const double *ring_force(const struct ring *g, const struct ring_voice *v, long from)
{
    return board_at(g->board, ITEM_FORCE, from - v->delay);
}
