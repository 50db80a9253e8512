/* Several impulse responses at once, each with its share of the force (panned.h): responses recorded at places, between which the force is shared
   linearly; or modes sampled at Chebyshev's nodes along a straight motion (nodes.h), a fine way to `launch`: cost depends neither on hops nor on
   speed. */
#include <math.h>
#include <string.h>

#include "convolution/nodes.h"
#include "convolution/panned.h"
#include "convolution/ring.h"
#include "convolution/ring_along.h"
#include "response/ir.h"
#include "response/ir_set.h"
#include "response/places.h"
#include "scene/ablation.h"
#include "trajectory/trajectory.h"

enum { CHUNK = PANNED_BLOCK };

struct panning {                /* one voice; of recorded responses the only one */
    struct ring_panned *all;
    const struct ring_voice *voice;
    struct ir_sampler *sampler;
    struct modes_point point;
    struct panned *engine;
};

struct ring_panned {
    struct ring ring;
    struct ir_set set;          /* recorded                                     */
    struct nodes *nodes;        /* else: along u                                */
    struct panning *voices;     /* [n]                                          */
    int n;
    long first, count;          /* frames of which the following hold           */
    double *t, *u, *x, *y;      /* [CHUNK]                                      */
    struct places_mix *mix;     /* [CHUNK]                                      */
    struct places_mix *one;     /* of the one place that counts; NULL: all do   */
};

/* ------------------------------------------------------------------ where the contact is */

static void locate(struct ring_panned *s, long first, int n)
{
    const struct trajectory *tr = s->ring.board->trajectory;
    if (s->first == first && s->count == n)
        return;
    s->first = first;
    s->count = n;
    for (int i = 0; i < n; i++)
        s->t[i] = (double)(first + i) / s->ring.board->rate;
    if (s->nodes) {
        trajectory_at(tr, (size_t)n, s->t, (struct trajectory_out){.u = s->u});
        nodes_locate(s->nodes, n, s->u);
        return;
    }
    trajectory_at(tr, (size_t)n, s->t, (struct trajectory_out){.u = s->u, .x = s->x, .y = s->y});
    for (int i = 0; i < n; i++) {
        if (s->one) {
            s->mix[i] = *s->one;
            continue;
        }
        double x = tr->straight ? tr->from[0] + s->u[i] * tr->e[0] : s->x[i], y = tr->straight ? tr->from[1] + s->u[i] * tr->e[1] : s->y[i];
        places_at(s->set.places, x, y, &s->mix[i]);
    }
}

static int share_places(void *self, long first, int n, int k, double *w)
{
    struct ring_panned *s = ((struct panning *)self)->all;
    int any = 0;
    locate(s, first, n);
    for (int i = 0; i < n; i++) {
        w[i] = 0;
        for (int j = 0; j < s->mix[i].n; j++)
            if (s->mix[i].index[j] == k && s->mix[i].weight[j] != 0) {
                w[i] = s->mix[i].weight[j];
                any = 1;
            }
    }
    return any;
}

static int share_nodes(void *self, long first, int n, int k, double *w)
{
    const struct panning *p = self;
    locate(p->all, first - p->voice->delay, n);
    return nodes_share(p->all->nodes, k, w);
}

/* ------------------------------------------------------------------ responses */

static void response_recorded(void *self, int k, double *h, size_t length)
{
    const struct ring_panned *s = ((struct panning *)self)->all;
    const struct ir *ir = &s->set.ir[k];
    for (size_t i = 0; i < length; i++)
        h[i] = i < ir->length ? s->ring.weight * ir->h[i] : 0;
}

static void response_modes(void *self, int k, double *h, size_t length)
{
    struct panning *p = self;
    const struct trajectory *tr = p->all->ring.board->trajectory;
    double u = nodes_place(p->all->nodes, k), place[2] = {tr->from[0] + u * tr->e[0], tr->from[1] + u * tr->e[1]};
    ring_point_in(&p->all->ring, p->voice, &(struct modes_where){place[0], place[1], 0}, &p->point);
    ir_sample(p->sampler, listener_quantity(p->voice->listener), &p->point, h, length);
}

/* ------------------------------------------------------------------ recorded */

static bool recorded_inside(const struct ring_panned *s, const struct stage_run *r, struct err *e)
{
    const struct trajectory *tr = r->board->trajectory;
    struct places_mix mix;
    struct modes_where first = ring_along_first(r->contact, tr);
    for (long i = 0; i <= (s->one ? 0 : tr->detail); i++) {
        double t = tr->duration * (double)i / (double)(tr->detail > 0 ? tr->detail : 1), p[2] = {first.x, first.y};
        if (!s->one)
            trajectory_continued(tr, t, p);
        double out = places_at(s->set.places, p[0], p[1], &mix);
        if (out > 1e-9 && s->set.n > 1)
            return err_set(e, ERR_SCENE, "contact '%s': %s [%g m, %g m], %.3g m beyond the places of %s: %s; move it, or set surface.extrapolate: nearest",
                           r->contact->name, s->one && !isnan(r->contact->ablation.place[0]) ? "ablation.place is" : "the motion reaches", p[0], p[1], out, r->contact->surface.response.file,
                           places_told(s->set.places, r->arena));
    }
    return true;
}

static bool open_recorded(struct ring_panned *s, struct stage_run *r, struct err *e)
{
    const struct response *given = &r->contact->surface.response;
    size_t length = 0;
    if (!ir_set_read(&(struct ir_ask){given->file, r->board->rate, given->length, r->scene->shelf}, r->arena, &s->set, e))
        return false;
    if (ablation_one_place(r->contact)) {
        struct modes_where first = ring_along_first(r->contact, r->board->trajectory);
        s->one = ARENA_TAKE(r->arena, struct places_mix, 1);
        places_at(s->set.places, first.x, first.y, s->one);
    }
    if (given->extrapolate == EXTRAPOLATE_ERROR && !recorded_inside(s, r, e))
        return err_about(e, r->contact->name, "surface.response");
    for (int k = 0; k < s->set.n; k++)
        length = s->set.ir[k].length > length ? s->set.ir[k].length : length;
    r->board->unstated = true;
    r->board->ring = fmax(r->board->ring, (double)length / r->board->rate);
    s->voices = ARENA_TAKE(r->arena, struct panning, 1);
    s->voices[0].all = s;
    s->voices[0].engine = panned_open(&(struct panned_source){.n = s->set.n, .length = length, .share = share_places, .response = response_recorded,
                                                              .self = &s->voices[0]});
    s->n = 1;
    return true;
}

/* ------------------------------------------------------------------ nodes */

static bool open_nodes(struct ring_panned *s, struct stage_run *r)
{
    const struct ring_nodes *n = &s->ring.choice->nodes;
    s->nodes = nodes_make(r->arena, n->pieces, n->breaks, n->count);
    size_t length = ir_length(r->board->rate, s->ring.choice->seconds);
    s->voices = ARENA_TAKE(r->arena, struct panning, s->ring.channels);
    for (; s->n < s->ring.channels; s->n++) {
        struct panning *p = &s->voices[s->n];
        *p = (struct panning){.all = s, .voice = &s->ring.voices[s->n]};
        p->sampler = ir_sampler_make(r->arena, p->voice->n, r->board->rate);
        p->point = modes_point_make(r->arena, p->voice->n);
        p->engine = panned_open(&(struct panned_source){.n = nodes_n(s->nodes), .length = length, .share = share_nodes,
                                                        .response = response_modes, .self = p});
    }
    return true;
}

/* ------------------------------------------------------------------ the stage */

static bool ring_panned_open(struct stage_run *r, struct err *e)
{
    struct ring_panned *s = ARENA_TAKE(r->arena, struct ring_panned, 1);
    r->state = s;
    s->first = -1;
    s->t = ARENA_TAKE(r->arena, double, CHUNK);
    s->u = ARENA_TAKE(r->arena, double, CHUNK);
    s->x = ARENA_TAKE(r->arena, double, CHUNK);
    s->y = ARENA_TAKE(r->arena, double, CHUNK);
    if (!ring_open(&s->ring, r, RING_SURFACE, e))
        return false;
    if (s->ring.choice->recorded)
        s->mix = ARENA_TAKE(r->arena, struct places_mix, CHUNK);
    if (!(s->ring.choice->recorded ? open_recorded(s, r, e) : open_nodes(s, r)))
        return false;
    r->ahead = panned_ahead(s->voices[0].engine); /* more than any other reader's */
    return true;
}

static bool ring_panned_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct ring_panned *s = r->state;
    (void)e;
    for (int k = 0; k < s->n; k++) {
        const struct panning *p = &s->voices[k];
        const double *f = p->voice ? ring_force(&s->ring, p->voice, from) : board_at(r->board, ITEM_FORCE, from);
        memset(s->ring.y, 0, (size_t)(to - from) * sizeof *s->ring.y);
        panned_run(p->engine, f, s->ring.y, to - from);
        for (int channel = k; channel < s->ring.channels; channel += s->n)
            ring_put(&s->ring, channel, from, to);
    }
    return true;
}

static void ring_panned_close(struct stage_run *r)
{
    const struct ring_panned *s = r->state;
    for (int k = 0; s && k < s->n; k++)
        if (s->voices[k].engine)
            panned_close(s->voices[k].engine);
}

static bool ring_panned_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return ring_choice_engine(c, RING_SURFACE) == RING_PANNED;
}

const struct stage ring_panned_stage = {
    .name = "surface_panned",
    .does = "the surface rings by fast convolution with several responses, the force shared among those near the contact",
    .paper = "000 eq. 10, 13",
    .idle = "the surface has no folder of responses, and surface.convolution is not nodes",
    .needs = ITEM_BIT(ITEM_FORCE),
    .gives = ITEM_BIT(ITEM_SURFACE_SOUND),
    .turns = ring_choice_surface_turns,
    .wanted = ring_panned_wanted,
    .work = ring_choice_surface_work,
    .open = ring_panned_open,
    .run = ring_panned_run,
    .close = ring_panned_close,
};
