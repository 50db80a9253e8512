/* Responses by fast convolution (overlap_add.h). Recorded: a sound file, or a folder of them recorded at places,
   between which the force is shared linearly. Modes: each place's response is computed, at nodes along the motion,
   launched from there (`launch`, `fixed`) or read out at the present place (`readout`). A response of modes is followed
   for response_length (papers/000 equation 10's t0) or, without, until every mode has decayed by 140 dB. */
#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/stopwatch.h"
#include "convolution/gammatone.h"
#include "convolution/overlap_add.h"
#include "convolution/ring.h"
#include "response/ir.h"
#include "response/places.h"
#include "trajectory/contact.h"

enum { CHUNK = OVERLAP_ADD_BLOCK };

struct overlap_output { /* of recorded responses the only one */
    struct ring_overlap *all;
    const struct ring_output *voice;
    struct ir_sampler *sampler;
    struct modes_point point;
    struct overlap_add *stays; /* one of the two */
    struct overlap_add_moving *moves;
};

struct ring_overlap {
    struct ring ring;
    struct ir_set set; /* recorded */
    struct overlap_output *outputs;
    int n, hop;
    long first, count;      /* frames that mix[] is of */
    double *t, *u, *x, *y;  /* [CHUNK] */
    struct places_mix *mix; /* [CHUNK] */
    bool *used;             /* [set.n]: has the place a share in mix[] */
    struct places_mix *one; /* of the one place that counts; NULL: all do */
};

/* ------------------------------------------------------------------ recorded */

/* first: a frame since the run began */
static void locate(struct ring_overlap *s, long first, int n)
{
    const struct trajectory *tr = s->ring.board->trajectory;
    if (s->first == first && s->count == n) return;
    s->first = first;
    s->count = n;
    for (int i = 0; i < n; i++)
        s->t[i] = (double)(s->ring.first + first + i) / s->ring.board->rate;
    trajectory_at(tr, (size_t)n, s->t, (struct trajectory_out){.u = s->u, .x = s->x, .y = s->y});
    for (int i = 0; i < n; i++) {
        if (s->one) {
            s->mix[i] = *s->one;
            continue;
        }
        double x = tr->straight ? tr->from[0] + s->u[i] * tr->e[0] : s->x[i],
               y = tr->straight ? tr->from[1] + s->u[i] * tr->e[1] : s->y[i];
        places_at(s->set.places, x, y, &s->mix[i]);
    }
    memset(s->used, 0, (size_t)s->set.n * sizeof *s->used);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < s->mix[i].n; j++)
            s->used[s->mix[i].index[j]] |= s->mix[i].weight[j] != 0;
}

static int share_places(void *self, long first, int n, int k, double *w)
{
    struct ring_overlap *s = ((struct overlap_output *)self)->all;
    locate(s, first, n);
    if (!s->used[k]) return 0;
    for (int i = 0; i < n; i++) {
        w[i] = 0;
        for (int j = 0; j < s->mix[i].n; j++)
            if (s->mix[i].index[j] == k) w[i] = s->mix[i].weight[j];
    }
    return 1;
}

static void response_recorded(void *self, long k, double *h, size_t length)
{
    const struct ring_overlap *s = ((struct overlap_output *)self)->all;
    const struct ir *ir = &s->set.ir[k];
    for (size_t i = 0; i < length; i++)
        h[i] = i < ir->length ? s->ring.weight * ir->h[i] : 0;
}

static bool recorded_inside(const struct ring_overlap *s, const struct stage_run *r, struct err *e)
{
    const struct trajectory *tr = r->board->trajectory;
    struct places_mix mix;
    struct modes_where first = ring_first_place(r->contact, tr);
    for (long i = 0; i <= (s->one ? 0 : tr->detail); i++) {
        double t = tr->duration * (double)i / (double)(tr->detail > 0 ? tr->detail : 1), p[2] = {first.x, first.y};
        if (!s->one) trajectory_continued(tr, t, p);
        double out = places_at(s->set.places, p[0], p[1], &mix);
        if (out > 1e-9 && s->set.n > 1)
            return err_set(e, ERR_SCENE,
                           "contact '%s': %s [%g m, %g m], %.3g m beyond the places of %s: %s; move it, or set "
                           "surface.extrapolate: nearest",
                           r->contact->name,
                           s->one && !isnan(r->contact->ablation.place[0]) ? "ablation.place is" : "the motion reaches",
                           p[0], p[1], out, r->contact->surface.response.file, places_text(s->set.places, r->arena));
    }
    return true;
}

static bool read_folder(struct ring_overlap *s, struct stage_run *r, const struct response *given, struct err *e)
{
    if (!ir_set_read(&(struct ir_ask){given->file, r->board->rate, given->length, r->scene->file_cache}, r->arena,
                     &s->set, e))
        return false;
    s->t = ARENA_TAKE(r->arena, double, CHUNK);
    s->u = ARENA_TAKE(r->arena, double, CHUNK);
    s->x = ARENA_TAKE(r->arena, double, CHUNK);
    s->y = ARENA_TAKE(r->arena, double, CHUNK);
    s->mix = ARENA_TAKE(r->arena, struct places_mix, CHUNK);
    s->used = ARENA_TAKE(r->arena, bool, s->set.n);
    s->first = -1;
    if (contact_one_place(r->contact)) {
        struct modes_where first = ring_first_place(r->contact, r->board->trajectory);
        s->one = ARENA_TAKE(r->arena, struct places_mix, 1);
        places_at(s->set.places, first.x, first.y, s->one);
    }
    return given->extrapolate != EXTRAPOLATE_ERROR || recorded_inside(s, r, e) ||
           err_about(e, r->contact->name, "surface.response");
}

static bool read_file(struct ring_overlap *s, struct stage_run *r, const struct response *given, struct err *e)
{
    const char *dot = strrchr(given->file, '.');
    s->set = (struct ir_set){.n = 1, .ir = ARENA_TAKE(r->arena, struct ir, 1)};
    if (ir_read(&(struct ir_ask){given->file, r->board->rate, given->length, r->scene->file_cache}, r->arena,
                &s->set.ir[0], e))
        return true;
    return dot && strcmp(dot, ".wav") == 0
               ? false
               : err_at(e, "a response is a mode table (NAME.csv), a sound file, or a folder of them");
}

static bool open_recorded(struct ring_overlap *s, struct stage_run *r, const struct response *given, struct err *e)
{
    size_t length = 0;
    if (!(s->ring.choice->folder ? read_folder : read_file)(s, r, given, e)) return false;
    for (int k = 0; k < s->set.n; k++)
        length = s->set.ir[k].length > length ? s->set.ir[k].length : length;
    r->board->unstated = true;
    r->board->ring = fmax(r->board->ring, (double)length / r->board->rate);
    s->outputs = ARENA_TAKE(r->arena, struct overlap_output, 1);
    s->outputs[0] = (struct overlap_output){.all = s};
    s->outputs[0].stays = overlap_add_open(&(struct overlap_add_source){.n = s->set.n,
                                                                        .length = length,
                                                                        .share = s->mix ? share_places : NULL,
                                                                        .response = response_recorded,
                                                                        .self = &s->outputs[0]});
    s->n = 1;
    return true;
}

/* ------------------------------------------------------------------ modes */

static void response_modes(void *self, long k, double *h, size_t length)
{
    struct overlap_output *v = self;
    const struct ring *g = &v->all->ring;
    ring_point_at(g, v->voice, (double)g->first + (double)k * v->all->hop, &v->point);
    gammatone_sample(g->choice->gamma, g->board->rate, v->sampler, listener_quantity(v->voice->listener), &v->point, h,
                     length);
}

static void open_modes(struct ring_overlap *s, struct stage_run *r)
{
    const struct ring_choice *c = s->ring.choice;
    size_t length = ir_length(r->board->rate, c->seconds);
    s->hop = ring_choice_hop(c, &r->scene->accuracy);
    s->outputs = ARENA_TAKE(r->arena, struct overlap_output, s->ring.channels);
    for (; s->n < s->ring.channels; s->n++) {
        struct overlap_output *v = &s->outputs[s->n];
        *v = (struct overlap_output){.all = s, .voice = &s->ring.outputs[s->n]};
        v->sampler = ir_sampler_make(r->arena, v->voice->n, r->board->rate);
        v->point = modes_point_make(r->arena, v->voice->n);
        if (s->ring.moves)
            v->moves = overlap_add_moving_open(length, s->hop,
                                               c->reading == MOVING_READOUT ? OVERLAP_ADD_READOUT : OVERLAP_ADD_LAUNCH,
                                               response_modes, v);
        else
            v->stays = overlap_add_open(
                &(struct overlap_add_source){.n = 1, .length = length, .response = response_modes, .self = v});
    }
}

/* ------------------------------------------------------------------ the stages */

#define PART 250000.0 /* cycles of a block of a response: its transform, and that of what rings at last */
#define SAMPLED 3.5   /* of a sample of a mode of a response that stays                                 */

/* Of what stays, the work that does not go with the length of the force. */
static void spend_once(const struct ring_overlap *s, const struct stage_run *r)
{
    double length = (s->ring.choice->recorded ? (double)s->set.ir[0].length : s->ring.choice->seconds * r->board->rate),
           parts = ceil(length / OVERLAP_ADD_BLOCK) + 1;
    for (int k = 0; k < s->n; k++)
        if (s->outputs[k].stays)
            stopwatch_spend(PART * parts * (s->mix ? 2 : 1) +
                            (s->outputs[k].voice ? SAMPLED * s->outputs[k].voice->n * length : 0));
}

static bool ring_overlap_open(struct stage_run *r, enum ring_body body, struct err *e)
{
    struct ring_overlap *s = ARENA_TAKE(r->arena, struct ring_overlap, 1);
    r->state = s;
    if (!ring_open(&s->ring, r, body, e)) return false;
    if (!s->ring.choice->recorded)
        open_modes(s, r);
    else if (!open_recorded(s, r, body == RING_SURFACE ? &r->contact->surface.response : &r->contact->scraper.response,
                            e))
        return false;
    int ahead = s->outputs[0].stays ? OVERLAP_ADD_BLOCK - 1 : overlap_add_moving_ahead(s->outputs[0].moves);
    r->ahead = r->ahead > ahead ? r->ahead : ahead;
    spend_once(s, r);
    r->works = r->board->moving + ahead + 1; /* then force is zero, and what rings is there; but for a readout */
    if (r->board->lingers)
        r->works = LONG_MAX;
    else if (s->ring.choice->reading == MOVING_READOUT)
        r->works += (long)(s->ring.choice->seconds * r->board->rate);
    return true;
}

static bool ring_overlap_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct ring_overlap *s = r->state;
    (void)e;
    for (int k = 0; k < s->n; k++) {
        const struct overlap_output *v = &s->outputs[k];
        const double *f = v->voice ? ring_force(&s->ring, v->voice, from) : board_at(r->board, ITEM_FORCE, from);
        memset(s->ring.y, 0, (size_t)(to - from) * sizeof *s->ring.y);
        if (v->stays)
            overlap_add_run(v->stays, f, s->ring.y, to - from);
        else
            overlap_add_moving_run(v->moves, f, s->ring.y, to - from);
        for (int channel = k; channel < s->ring.channels; channel += s->n)
            ring_put(&s->ring, channel, from, to);
    }
    return true;
}

static void ring_overlap_close(struct stage_run *r)
{
    const struct ring_overlap *s = r->state;
    for (int k = 0; s && k < s->n; k++) {
        if (s->outputs[k].stays) overlap_add_close(s->outputs[k].stays);
        if (s->outputs[k].moves) overlap_add_moving_close(s->outputs[k].moves);
    }
}

static bool surface_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return ring_choice_engine(c, RING_SURFACE) == RING_OVERLAP_ADD;
}

static bool scraper_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return ring_choice_engine(c, RING_SCRAPER) == RING_OVERLAP_ADD;
}

static bool surface_open(struct stage_run *r, struct err *e) { return ring_overlap_open(r, RING_SURFACE, e); }

static bool scraper_open(struct stage_run *r, struct err *e) { return ring_overlap_open(r, RING_SCRAPER, e); }

const struct stage ring_overlap_add_surface_stage = {
    .name = "surface_overlap_add",
    .does = "the surface rings by fast convolution with its impulse responses",
    .paper = "000 eq. 10, 13",
    .idle = "no impulse response for the surface, or its modes go by another engine",
    .needs = ITEM_BIT(ITEM_FORCE),
    .gives = ITEM_BIT(ITEM_SURFACE_SOUND),
    .wanted = surface_wanted,
    .turns = ring_choice_surface_turns,
    .work = ring_choice_surface_work,
    .open = surface_open,
    .run = ring_overlap_run,
    .skip = ring_skip,
    .close = ring_overlap_close,
};

const struct stage ring_overlap_add_scraper_stage = {
    .name = "scraper_overlap_add",
    .does = "the scraper or ball rings by fast convolution with its impulse response",
    .paper = "000 eq. 11",
    .idle = "scraper or ball is damped (weight 0), has no impulse response, or its modes go by resonators",
    .needs = ITEM_BIT(ITEM_FORCE),
    .gives = ITEM_BIT(ITEM_SCRAPER_SOUND),
    .wanted = scraper_wanted,
    .turns = ring_choice_scraper_turns,
    .work = ring_choice_scraper_work,
    .open = scraper_open,
    .run = ring_overlap_run,
    .skip = ring_skip,
    .close = ring_overlap_close,
};
