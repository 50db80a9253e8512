/* The surface's and the scraper's modes as resonators (convolution/resonators.h): exact for poles that do not move
   (`fixed`), and the definition of `glide` for those that do. Gains and poles are evaluated every accuracy.gain_ramp
   samples, at multiples of it, and ramped linearly between; a ramp is always run as a whole, so that nothing depends on
   where blocks end.

   A surface whose poles differ from place to place, every force sample launching the response of its own place
   (`launch`), by resonators at nodes along the motion (convolution/launch.h). */
#include <math.h>
#include <string.h>

#include "convolution/gammatone.h"
#include "convolution/launch.h"
#include "convolution/resonators.h"
#include "convolution/ring.h"
#include "num/real.h"

struct bank {
    struct resonators *bank; /* or, of a soft onset,                       */
    struct gammatone_bank *tones;
    struct modes_point to; /* at the ramp's end                          */
    double *y;             /* [ramp] sound of the present ramp           */
};

struct ring_bank {
    struct ring ring;
    struct bank *banks; /* [channels]                                 */
    int ramp;
    long ramp_end; /* frame; the ramp began at ramp_end - ramp   */
};

static void bank_run(const struct bank *b, const double *f, double *y, int frames)
{
    if (b->tones)
        gammatone_bank_run(b->tones, f, y, frames, &b->to);
    else
        resonators_run(b->bank, f, y, frames, &b->to);
}

static void bank_open(struct ring_bank *s, struct stage_run *r, int channel)
{
    const struct ring_output *v = &s->ring.outputs[channel];
    struct bank *b = &s->banks[channel];
    b->to = modes_point_make(r->arena, v->n);
    b->y = ARENA_TAKE(r->arena, double, s->ramp);
    ring_point_at(&s->ring, v, s->ring.moves ? -1 : 0, &b->to); /* the frame before the first ramp */
    if (s->ring.choice->gamma > 1) {
        struct gammatone_bank_ask tones = {.n = v->n,
                                           .gamma = s->ring.choice->gamma,
                                           .rate = r->board->rate,
                                           .frequency = b->to.frequency,
                                           .decay = b->to.decay};
        b->tones = gammatone_bank_make(r->arena, &tones);
        gammatone_bank_set(b->tones, &b->to);
        return;
    }
    struct resonators_ask ask = {.n = v->n,
                                 .quantity = listener_quantity(v->listener),
                                 .rate = r->board->rate,
                                 .frequency = b->to.frequency,
                                 .decay = b->to.decay,
                                 .glides = ring_choice_glides(s->ring.choice),
                                 .ramp = s->ramp};
    b->bank = resonators_make(r->arena, &ask);
    resonators_set(b->bank, &b->to);
}

static bool ring_bank_open(struct stage_run *r, enum ring_body body, struct err *e)
{
    struct ring_bank *s = ARENA_TAKE(r->arena, struct ring_bank, 1);
    r->state = s;
    if (!ring_open(&s->ring, r, body, e)) return false;
    s->ramp = s->ring.moves ? s->ring.ramp : 1;
    s->banks = ARENA_TAKE(r->arena, struct bank, s->ring.channels);
    for (int k = 0; k < s->ring.channels; k++)
        bank_open(s, r, k);
    r->ahead = r->ahead > s->ramp - 1 ? r->ahead : s->ramp - 1;
    return true;
}

/* The next ramp's sound of every voice. */
static void ring_next_ramp(struct ring_bank *s)
{
    long from = s->ramp_end;
    s->ramp_end += s->ramp;
    for (int k = 0; k < s->ring.channels; k++) {
        const struct ring_output *v = &s->ring.outputs[k];
        struct bank *b = &s->banks[k];
        ring_point_at(&s->ring, v, (double)(s->ramp_end - 1), &b->to);
        memset(b->y, 0, (size_t)s->ramp * sizeof *b->y);
        bank_run(b, ring_force(&s->ring, v, from), b->y, s->ramp);
    }
}

static void ring_moving(struct ring_bank *s, long from, long to)
{
    for (long n = from, end; n < to; n = end) {
        if (n == s->ramp_end) ring_next_ramp(s);
        end = s->ramp_end < to ? s->ramp_end : to;
        for (int k = 0; k < s->ring.channels; k++) {
            memcpy(s->ring.y, s->banks[k].y + s->ramp - (s->ramp_end - n), (size_t)(end - n) * sizeof *s->ring.y);
            ring_put(&s->ring, k, n, end);
        }
    }
}

static void ring_bank_skip(struct stage_run *r, long frame)
{
    struct ring_bank *s = r->state;
    ring_skip(r, frame);
    s->ramp_end = frame;
    for (int k = 0; s->ring.moves && k < s->ring.channels; k++) {
        struct bank *b = &s->banks[k];
        ring_point_at(&s->ring, &s->ring.outputs[k], (double)(frame - 1), &b->to);
        if (b->tones)
            gammatone_bank_set(b->tones, &b->to);
        else
            resonators_set(b->bank, &b->to);
    }
}

static bool ring_bank_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct ring_bank *s = r->state;
    (void)e;
    if (s->ring.moves)
        ring_moving(s, from, to);
    else
        for (int k = 0; k < s->ring.channels; k++) {
            memset(s->ring.y, 0, (size_t)(to - from) * sizeof *s->ring.y);
            bank_run(&s->banks[k], ring_force(&s->ring, &s->ring.outputs[k], from), s->ring.y, (int)(to - from));
            ring_put(&s->ring, k, from, to);
        }
    return true;
}

/* ------------------------------------------------------------------ launch */

struct launching { /* one voice */
    const struct ring *ring;
    const struct ring_output *voice;
    struct launch *engine;
};

struct ring_launch {
    struct ring ring;
    struct launching *outputs; /* [channels] */
};

static void launching_point(void *self, double frame, const struct modes_point *p)
{
    const struct launching *s = self;
    ring_point_at(s->ring, s->voice, (double)s->ring->first + frame, p);
}

static bool ring_launch_open(struct stage_run *r, struct err *e)
{
    struct ring_launch *s = ARENA_TAKE(r->arena, struct ring_launch, 1);
    r->state = s;
    if (!ring_open(&s->ring, r, RING_SURFACE, e)) return false;
    s->outputs = ARENA_TAKE(r->arena, struct launching, s->ring.channels);
    for (int k = 0; k < s->ring.channels; k++) {
        const struct ring_output *v = &s->ring.outputs[k];
        s->outputs[k] = (struct launching){.ring = &s->ring, .voice = v};
        struct launch_ask ask = {.n = v->n,
                                 .rate = r->board->rate,
                                 .hop = ring_choice_hop(s->ring.choice, &r->scene->accuracy),
                                 .floor = RING_CHOICE_NODE_FLOOR,
                                 .quantity = listener_quantity(v->listener)};
        s->outputs[k].engine = launch_open(&ask, launching_point, &s->outputs[k]);
    }
    return true;
}

static bool ring_launch_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct ring_launch *s = r->state;
    (void)e;
    for (int k = 0; k < s->ring.channels; k++) {
        memset(s->ring.y, 0, (size_t)(to - from) * sizeof *s->ring.y);
        launch_run(s->outputs[k].engine, ring_force(&s->ring, s->outputs[k].voice, from), s->ring.y, to - from);
        ring_put(&s->ring, k, from, to);
    }
    return true;
}

static void ring_launch_close(struct stage_run *r)
{
    const struct ring_launch *s = r->state;
    for (int k = 0; s && s->outputs && k < s->ring.channels; k++)
        if (s->outputs[k].engine) launch_close(s->outputs[k].engine);
}

static bool ring_launch_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return ring_choice_engine(c, RING_SURFACE) == RING_LAUNCH;
}

/* ------------------------------------------------------------------ the stages */

static bool surface_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return ring_choice_engine(c, RING_SURFACE) == RING_RESONATORS;
}

static bool scraper_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return ring_choice_engine(c, RING_SCRAPER) == RING_RESONATORS;
}

static bool surface_open(struct stage_run *r, struct err *e) { return ring_bank_open(r, RING_SURFACE, e); }

static bool scraper_open(struct stage_run *r, struct err *e) { return ring_bank_open(r, RING_SCRAPER, e); }

const struct stage ring_resonators_surface_stage = {
    .name = "surface_resonators",
    .does = "the surface's modes ring, one exact recursion each, gains (and poles that glide) following the contact",
    .paper = "000 eq. 10, 13",
    .idle = "the surface has no modes, or they go by another engine",
    .needs = ITEM_BIT(ITEM_FORCE),
    .gives = ITEM_BIT(ITEM_SURFACE_SOUND),
    .wanted = surface_wanted,
    .turns = ring_choice_surface_turns,
    .work = ring_choice_surface_work,
    .open = surface_open,
    .run = ring_bank_run,
    .skip = ring_bank_skip,
};

const struct stage ring_resonators_scraper_stage = {
    .name = "scraper_resonators",
    .does = "the scraper's or ball's modes ring, one exact recursion each",
    .paper = "000 eq. 11",
    .idle = "scraper or ball is damped (weight 0), has no modes, or they go by overlap-add",
    .needs = ITEM_BIT(ITEM_FORCE),
    .gives = ITEM_BIT(ITEM_SCRAPER_SOUND),
    .wanted = scraper_wanted,
    .turns = ring_choice_scraper_turns,
    .work = ring_choice_scraper_work,
    .open = scraper_open,
    .run = ring_bank_run,
    .skip = ring_bank_skip,
};

const struct stage ring_resonators_launch_stage = {
    .name = "surface_launch",
    .does = "the surface's modes ring from nodes along the motion, each place launching its own response",
    .paper = "000 eq. 10, 13",
    .idle = "the surface's poles are the same everywhere, or they go by another engine",
    .needs = ITEM_BIT(ITEM_FORCE),
    .gives = ITEM_BIT(ITEM_SURFACE_SOUND),
    .turns = ring_choice_surface_turns,
    .wanted = ring_launch_wanted,
    .work = ring_choice_surface_work,
    .open = ring_launch_open,
    .run = ring_launch_run,
    .skip = ring_skip,
    .close = ring_launch_close,
};
