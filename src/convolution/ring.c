/* Total response: surface + eta x scraper (papers/000 section 2.4: the scraper's response is "weighted by eta"; its
   equation 11 omits it), heard at each listening place. */
#include "convolution/ring.h"

#include <math.h>
#include <string.h>

#include "base/stopwatch.h"
#include "convolution/alias.h"
#include "convolution/gammatone.h"
#include "num/lanes.h"
#include "response/object.h"
#include "response/places.h"
#include "trajectory/contact.h"

/* What sampling folds into a voice's sound is taken out again (alias.h), in the same way for every engine. */

/* Every force sample f(m) adds C_k f(m) to frames m + k, |k| <= ALIAS_REACH, C_k = sum over components of Im(A_i
   kappa_i,k) (alias.c), with A and kappa of the contact's place at frame m; of `readout` at frame m + k, where it is
   heard. That is one filter for all engines: `fixed`, `launch` and their nodes launch each force sample with the
   response of its own place, and the taps are a part of it; of `glide`, which retunes what rings, a sample's taps are
   over after 0.3 ms.

   C is known every accuracy.gain_ramp frames, as gains are, and linear between. What would be heard before the first
   frame at which the contact can be heard, that of the voice's delay, is added to that frame, so that nothing is lost
   at 0 Hz. Pieces and taps stand at fixed frames and are added up in their order: the result does not depend on how the
   sound is cut into calls. */
enum { ROOM = STAGE_BLOCK + 2 * ALIAS_REACH };

struct known {
    long frame;
    double tap[ALIAS_TAPS];
};

struct ring_alias {
    struct alias *fit;
    bool moves, separate; /* the taps change on the way; poles do */
    bool listens;         /* the taps are those of the place at which is heard */
    long piece;
    struct modes_point at;                       /* [n] */
    double (*re)[ALIAS_TAPS], (*im)[ALIAS_TAPS]; /* [n] kappa of poles that stay, where gains move; else [1] */
    struct known start, end;                     /* of the piece at hand; start.frame < 0: there is none */
    long next;                                   /* force frame */
    double sum[ROOM];                            /* of frames from the call's first on */
};

/* ------------------------------------------------------------------ taps */

/* Adds Im(A (re + j im)), A = by_im + j by_re. */
LANES_CLONES
static void taps_of(const double *restrict re, const double *restrict im, double by_im, double by_re,
                    double *restrict to)
{
#pragma omp simd
    for (int k = 0; k < ALIAS_TAPS; k++)
        to[k] = fma(by_im, im[k], fma(by_re, re[k], to[k]));
}

static void taps_at(struct ring_alias *s, const struct ring *g, const struct ring_output *v, long frame,
                    struct known *to)
{
    bool cached = s->moves && !s->separate;
    *to = (struct known){.frame = frame};
    ring_point_at(g, v, (double)frame, &s->at);
    for (int i = 0; i < v->n; i++) {
        if (s->at.re[i] == 0.0 && s->at.im[i] == 0.0) continue;
        if (!s->moves) alias_taps(s->fit, s->at.frequency[i], s->at.decay[i], *s->re, *s->im);
        if (s->moves && s->separate)
            alias_add(s->fit, s->at.frequency[i], s->at.decay[i], (double[2]){s->at.re[i], s->at.im[i]}, to->tap);
        else
            taps_of(s->re[cached ? i : 0], s->im[cached ? i : 0], s->at.re[i], s->at.im[i], to->tap);
    }
}

/* The piece that holds a frame. */
static void find(struct ring_alias *s, const struct ring *g, const struct ring_output *v, long frame)
{
    if (s->start.frame >= 0 && (!s->moves || (frame >= s->start.frame && frame < s->end.frame))) return;
    long from = frame - frame % s->piece;
    if (s->moves && s->end.frame == from && s->start.frame >= 0)
        s->start = s->end;
    else
        taps_at(s, g, v, from, &s->start);
    s->end = s->start;
    if (!s->moves) return;
    taps_at(s, g, v, from + s->piece, &s->end);
}

/* For a voice whose poles and listener are there. */
static struct ring_alias *ring_alias_make(const struct ring *g, const struct ring_output *v, struct arena *a)
{
    struct ring_alias *s = ARENA_TAKE(a, struct ring_alias, 1);
    s->fit = alias_make(a, g->choice->gamma, g->board->rate);
    s->moves = g->moves;
    s->separate = !v->modes->shared;
    s->listens = g->choice->reading == MOVING_READOUT;
    s->piece = g->ramp;
    s->at = modes_point_make(a, v->n);
    s->start.frame = -1;
    bool cached = s->moves && !s->separate;
    s->re = arena_take(a, (size_t)(cached ? v->n : 1), sizeof *s->re);
    s->im = arena_take(a, (size_t)(cached ? v->n : 1), sizeof *s->im);
    for (int i = 0; cached && i < v->n; i++) {
        alias_add(s->fit, v->frequency[i], v->decay[i], (const double[2]){0, 1}, s->re[i]);
        alias_add(s->fit, v->frequency[i], v->decay[i], (const double[2]){1, 0}, s->im[i]);
    }
    return s;
}

/* ------------------------------------------------------------------ at work */

LANES_CLONES
static void scatter(const double *restrict start, const double *restrict end, double u, double f, double *restrict to)
{
#pragma omp simd
    for (int k = 0; k < ALIAS_TAPS; k++)
        to[k] = fma(f, fma(u, end[k] - start[k], start[k]), to[k]);
}

static double share(const struct ring_alias *s, long frame)
{
    return s->moves ? (double)(frame - s->start.frame) / (double)(s->end.frame - s->start.frame) : 0;
}

/* The force f of a frame, to what is heard around it, from frame `begin` on. */
static void launch(struct ring_alias *s, double f, long frame, long from, long begin)
{
    long first = frame - ALIAS_REACH - from, least = begin > from ? begin - from : 0;
    if (first >= least)
        scatter(s->start.tap, s->end.tap, share(s, frame), f, s->sum + first);
    else {
        double early[ALIAS_TAPS] = {0};
        scatter(s->start.tap, s->end.tap, share(s, frame), f, early);
        for (int k = 0; k < ALIAS_TAPS; k++)
            s->sum[first + k > least ? first + k : least] += early[k];
    }
}

/* What is heard in a frame of the force around it, f[0] the frame's own. */
static double hear(struct ring_alias *s, const struct ring *g, const struct ring_output *v, const double *f, long frame)
{
    double sum = 0;
    bool any = false;
    long at = frame > v->delay ? frame : v->delay;
    for (int k = -ALIAS_REACH; k <= ALIAS_REACH; k++)
        any = any || (frame + k >= v->delay && f[k] != 0.0);
    if (!any) return 0;
    find(s, g, v, at);
    double u = share(s, at);
    for (int k = 0; k < ALIAS_TAPS; k++)
        if (frame + ALIAS_REACH - k >= v->delay)
            sum += f[ALIAS_REACH - k] * (s->start.tap[k] + u * (s->end.tap[k] - s->start.tap[k]));
    return sum;
}

static void listen(struct ring_alias *s, const struct ring *g, const struct ring_output *v, double *y, long from,
                   long to)
{
    const double *f = ring_force(g, v, from);
    long begin = v->delay;
    if (to <= begin) return;
    for (long n = from <= begin ? begin - ALIAS_REACH : from; n < to; n++)
        y[(n < begin ? begin : n) - from] += hear(s, g, v, f + (n - from), n);
}

/* Adds to y, of frames [from, to), each call's next to those of the one before. Reads the force ALIAS_REACH frames
   ahead (and, of readout, back). */
static void ring_alias_add(struct ring_alias *s, const struct ring *g, const struct ring_output *v, double *y,
                           long from, long to)
{
    const double *f = ring_force(g, v, from);
    if (s->listens) {
        listen(s, g, v, y, from, to);
        return;
    }
    for (; s->next < to + ALIAS_REACH; s->next++)
        if (f[s->next - from] != 0.0) {
            find(s, g, v, s->next);
            launch(s, f[s->next - from], s->next, from, v->delay);
        }
    for (long n = 0; n < to - from; n++)
        y[n] += s->sum[n];
    memmove(s->sum, s->sum + (to - from), (size_t)(ROOM - (to - from)) * sizeof *s->sum);
    memset(s->sum + ROOM - (to - from), 0, (size_t)(to - from) * sizeof *s->sum);
}

/* ------------------------------------------------------------------ where the contact is */

struct modes_where ring_where(const struct trajectory *tr, double t)
{
    double place[2];
    trajectory_continued(tr, t, place);
    return (struct modes_where){place[0], place[1], tr->duration > 0 ? t / tr->duration : 0};
}

struct modes_where ring_first_place(const struct contact *c, const struct trajectory *tr)
{
    const double *place = c->ablation.place;
    return contact_one_place(c) && !isnan(place[0]) ? (struct modes_where){place[0], place[1], 0} : ring_where(tr, 0);
}

/* The power of two at the larger of two gains: in such units they can be squared and multiplied, whatever their size,
   with the same bits as in any other. */
static double unit_of(const struct modes_point *p, const struct modes_point *q, int i)
{
    double most = fmax(fmax(fabs(p->re[i]), fabs(p->im[i])), fmax(fabs(q->re[i]), fabs(q->im[i])));
    int exponent = 0;
    frexp(most, &exponent);
    return exponent > -1000 && exponent < 1000 ? ldexp(1, exponent) : 1;
}

/* p <- end^2 / p, of n components: what goes on straight in the logarithm beyond the end, where p is as far inside. A
   gain that is nearly zero at the end, or turns by more than a quarter of a turn, has no logarithm to go on in: it goes
   on straight. Poles only if p->frequency is not NULL. */
static void mirror(int n, const struct modes_point *end, const struct modes_point *p)
{
    for (int i = 0; i < n; i++) {
        double unit = unit_of(end, p, i), per = 1 / unit;
        double re = end->re[i] * per, im = end->im[i] * per, x = p->re[i] * per, y = p->im[i] * per,
               square = x * x + y * y, to = re * re + im * im;
        double lean = re * x + im * y, turn = im * x - re * y; /* end / p = (lean + j turn) / square */
        bool steady = square > 1e-6 * to && lean > 0;
        p->re[i] = unit * (steady ? (re * lean - im * turn) / square : 2 * re - x);
        p->im[i] = unit * (steady ? (re * turn + im * lean) / square : 2 * im - y);
        if (p->frequency) {
            p->frequency[i] = p->frequency[i] > 0 ? end->frequency[i] * end->frequency[i] / p->frequency[i] : 0;
            p->decay[i] = p->decay[i] > 0 ? end->decay[i] * end->decay[i] / p->decay[i] : 0;
        }
    }
}

/* Does it go back before the start (t < 0) or after the end? Where the motion rests at its end, as strokes do, it is
   taken to come back as it went: x ~ t^2 goes on without a kink. */
static bool returns(const struct modes *m, const struct trajectory *tr, double t)
{
    return !m->travels && (t < 0 ? tr->starts_at_rest : tr->ends_at_rest);
}

/* The places' hull is convex. A straight motion is inside when its ends are; of a curved one as many instants are
   looked at as show its shape: what is left out between two of them is far less than the distance of two places. */
#define REACH_SLACK 1e-9 /* m */

bool ring_reach(const struct modes *m, const struct stage_run *r, struct err *e)
{
    const struct response *given = &r->contact->surface.response;
    const struct trajectory *tr = r->board->trajectory;
    struct modes_point point = modes_point_make(r->arena, m->n);
    bool one = contact_one_place(r->contact);
    struct modes_where first = ring_first_place(r->contact, tr);
    long steps = one ? 0 : tr->straight ? 1 : tr->detail;
    if (given->extrapolate == EXTRAPOLATE_ERROR) stopwatch_spend((double)steps * (400 + 80.0 * m->n));
    for (long i = 0; i <= steps && given->extrapolate == EXTRAPOLATE_ERROR; i++) {
        double t = one ? 0 : tr->duration * (double)i / (double)steps, p[2] = {first.x, first.y};
        if (tr->straight && !one)
            for (int xy = 0; xy < 2; xy++)
                p[xy] = tr->from[xy] + tr->reach[i] * tr->e[xy];
        else if (!one)
            trajectory_at(tr, 1, &t, (struct trajectory_out){.x = &p[0], .y = &p[1]});
        double out = modes_at(m, &(struct modes_where){p[0], p[1], 0}, &point);
        if (out > REACH_SLACK)
            return err_set(e, ERR_SCENE,
                           "contact '%s': %s: %s [%g m, %g m], %.3g m beyond the places of %s%s%s; move it, or set "
                           "surface.extrapolate: nearest",
                           r->contact->name, ring_choice_about(r->contact, RING_SURFACE),
                           one && !isnan(r->contact->ablation.place[0]) ? "ablation.place is" : "the motion reaches",
                           p[0], p[1], out, m->name, m->places ? ": " : "",
                           m->places ? places_text(m->places, r->arena) : "");
    }
    return true;
}

/* ------------------------------------------------------------------ voices */

static const struct response *ring_given(const struct contact *c, enum ring_body body)
{
    return body == RING_SURFACE ? &c->surface.response : &c->scraper.response;
}

/* A surface's object heard at other places of it than the one that is touched has modes of its own for each
   (ask->listen is then set). */
static const struct modes *voice_modes(const struct ring *g, struct listener_ask *ask)
{
    const struct modes *m = &g->choice->modes;
    struct arena *a = g->choice->arena;
    double *place = ARENA_TAKE(a, double, 2);
    if (g->body != RING_SURFACE || !m->object || !listener_place(ask, m->object, a, place)) return m;
    struct modes *own = ARENA_TAKE(a, struct modes, 1);
    object_modes(m->object, ask->origin, place, m->object->n, a, own);
    modes_drop_above(own, ask->rate);
    ask->listen = place;
    return own;
}

static bool voice_open(struct ring *g, struct stage_run *r, int channel, struct err *e)
{
    struct ring_output *v = &g->outputs[channel];
    const double *origin = ring_given(r->contact, g->body)->object.origin;
    struct listener_ask ask = {
        .output = &r->scene->output, .channel = channel, .origin = origin, .rate = r->board->rate};
    /* A plate's radiation costs as much as a short sound, and pilot runs and the render need the same. Without a
       listening place it is cheap, and is not that of the scene: a pilot run of the force listens nowhere. */
    struct ring_made here = {NULL, NULL}, *made = ask.output->listen.given ? &g->choice->made[channel] : &here;
    if (!made->modes) {
        const struct modes *modes = voice_modes(g, &ask);
        if (channel == 0) stopwatch_spend(listener_cost(ask.output, &g->choice->modes, origin)); /* of all */
        if (!(made->listener = listener_make(g->choice->arena, &ask, modes, e)))
            return err_at(e, "contact '%s': %s", r->contact->name, g->key);
        made->modes = modes;
    }
    v->modes = made->modes;
    v->listener = made->listener;
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

/* ------------------------------------------------------------------ what the board gets */

/* The sound ends 60 s after the last force where output.tail is auto (pipeline/render.c). */
static void note_warnings(const struct ring *g, const struct response *given, struct stage_run *r)
{
    const struct ring_choice *c = g->choice;
    double falls = gammatone_decibel(c->gamma, 80), ring = modes_ring_time(&c->modes, falls);
    if (c->note) board_warn(r->board, c->note);
    if (c->high)
        board_warn(r->board,
                   arena_format(r->arena,
                                "%s: %d of its %d strongest modes lie%s above %g Hz, 0.45 of the sample rate, and do%s "
                                "not ring: raise output.sample_rate, or end the key band there",
                                c->modes.name, c->high, c->chosen, c->high == 1 ? "s" : "", MODES_TOP * g->board->rate,
                                c->high == 1 ? "es" : ""));
    if (isnan(r->scene->output.tail) && isnan(r->scene->output.duration) && isnan(given->length) && ring > 60)
        board_warn(r->board,
                   arena_format(r->arena,
                                "%s: its slowest mode has fallen by %.3g dB only when the sound ends, 60 s after the "
                                "motion: set output.tail, or give the mode more decay",
                                c->modes.name, gammatone_fallen(c->gamma, falls * 60 / ring)));
}

/* All that is summed is of one quantity; what is recorded does not say its own, and goes with any. */
static bool note_quantity(const struct ring *g, struct board *b, struct err *e)
{
    int quantity = listener_quantity(g->outputs[0].listener);
    if (b->quantity >= 0 && b->quantity != quantity)
        return err_set(e, ERR_SCENE,
                       "%s: this response gives %s, but the surface's gives %s: they cannot be summed; use tables of "
                       "one quantity, or choose one "
                       "by output.quantity",
                       g->choice->modes.name, modes_quantity_name(quantity), modes_quantity_name(b->quantity));
    b->quantity = quantity;
    return true;
}

/* Predicted cycles of opening: a listening place, what moves, a mode. */
#define OPENED 1e5
#define FOLLOWED 5e5
#define MODE 6e3

bool ring_open(struct ring *g, struct stage_run *r, enum ring_body body, struct err *e)
{
    bool surface = body == RING_SURFACE;
    const struct response *given = ring_given(r->contact, body);
    *g = (struct ring){.body = body,
                       .choice = given->choice,
                       .board = r->board,
                       .contact = r->contact,
                       .key = surface ? "surface" : contact_tool(r->contact),
                       .out = surface ? ITEM_SURFACE_SOUND : ITEM_SCRAPER_SOUND,
                       .weight = surface ? 1 : r->contact->scraper.weight,
                       .moves = given->choice->moves,
                       .ramp = (int)r->scene->accuracy.gain_ramp,
                       .stays = given->choice->reading == MOVING_GLIDE || given->choice->reading == MOVING_READOUT ||
                                r->board->lingers,
                       .channels = r->board->channels};
    if (surface) r->board->surface_ring = g;
    g->outputs = ARENA_TAKE(r->arena, struct ring_output, g->channels);
    g->y = ARENA_TAKE(r->arena, double, STAGE_BLOCK);
    if (g->choice->recorded) return true;
    stopwatch_spend(OPENED * g->channels + (g->moves ? FOLLOWED : 0) + MODE * g->choice->modes.n);
    for (int k = 0; k < g->channels; k++)
        if (!voice_open(g, r, k, e)) return err_about(e, r->contact->name, ring_choice_about(r->contact, body));
    double ring =
        modes_ring_time(&g->choice->modes, gammatone_decibel(g->choice->gamma, 80)) + (double)g->delay / r->board->rate;
    r->board->ring = fmax(r->board->ring, isnan(given->length) ? ring : fmin(ring, given->length));
    note_warnings(g, given, r);
    r->back = (int)g->delay + (g->choice->reading == MOVING_READOUT ? ALIAS_REACH : 0);
    r->ahead = ALIAS_REACH;
    bool ok = note_quantity(g, r->board, e) && (!surface || ring_reach(&g->choice->modes, r, e));
    return ok || err_about(e, r->contact->name, ring_choice_about(r->contact, body));
}

/* ------------------------------------------------------------------ a voice at work */

void ring_point_in(const struct ring *g, const struct ring_output *v, const struct modes_where *where,
                   const struct modes_point *p)
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

void ring_point_at(const struct ring *g, const struct ring_output *v, double frame, const struct modes_point *p)
{
    struct modes_where where = {v->modes->home[0], v->modes->home[1], 0};
    const struct trajectory *tr = g->board->trajectory;
    double last = tr->duration, t = (frame - (double)v->delay) / g->board->rate, end = t < 0 ? 0 : last;
    if (g->stays) t = fmin(fmax(t, 0), last);
    if (g->body == RING_SURFACE && g->moves && (t < 0 || t > last)) {
        struct modes_where inside = ring_where(tr, fmin(fmax(2 * end - t, 0), last));
        ring_point_in(g, v, &inside, p);
        if (returns(v->modes, tr, t)) return;
        where = ring_where(tr, end);
        ring_point_in(g, v, &where, &v->end);
        mirror(v->n, &v->end, p);
        return;
    }
    if (g->body == RING_SURFACE) where = g->moves ? ring_where(tr, t) : ring_first_place(g->contact, tr);
    ring_point_in(g, v, &where, p);
}

void ring_put(const struct ring *g, int channel, long from, long to)
{
    double *out = board_at(g->board, g->out, from) + channel;
    if (!g->choice->recorded) ring_alias_add(g->outputs[channel].alias, g, &g->outputs[channel], g->y, from, to);
    if (g->channels == 1) memcpy(out, g->y, (size_t)(to - from) * sizeof *out);
    for (long n = 0; g->channels > 1 && n < to - from; n++)
        out[n * g->channels] = g->y[n];
}

const double *ring_force(const struct ring *g, const struct ring_output *v, long from)
{
    return board_at(g->board, ITEM_FORCE, from - v->delay);
}

void ring_skip(struct stage_run *r, long frame)
{
    struct ring *g = r->state;
    g->first = frame;
    for (int k = 0; k < g->channels; k++)
        if (g->outputs[k].alias) g->outputs[k].alias->next = frame;
}
