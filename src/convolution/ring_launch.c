/* A surface whose poles differ from place to place, every force sample launching the response of its own place (`launch`), by resonators at nodes
   along the motion: convolution/launch.h. */
#include <string.h>

#include "convolution/launch.h"
#include "convolution/ring.h"

/* Nodes that ring out are dropped when they have fallen by 100 dB where gain_ramp is 64, by 12 dB more for each halving, as the error of the nodes falls. */
#define FLOOR 2.44e-9

struct launching {              /* one voice */
    const struct ring *ring;
    const struct ring_voice *voice;
    struct launch *engine;
};

struct ring_launch {
    struct ring ring;
    struct launching *voices;   /* [channels] */
};

static void launching_point(void *self, double frame, const struct modes_point *p)
{
    const struct launching *s = self;
    ring_point_at(s->ring, s->voice, frame, p);
}

static bool ring_launch_open(struct stage_run *r, struct err *e)
{
    struct ring_launch *s = ARENA_TAKE(r->arena, struct ring_launch, 1);
    r->state = s;
    if (!ring_open(&s->ring, r, RING_SURFACE, e))
        return false;
    s->voices = ARENA_TAKE(r->arena, struct launching, s->ring.channels);
    for (int k = 0; k < s->ring.channels; k++) {
        const struct ring_voice *v = &s->ring.voices[k];
        s->voices[k] = (struct launching){.ring = &s->ring, .voice = v};
        struct launch_ask ask = {.n = v->n, .rate = r->board->rate, .hop = ring_choice_hop(s->ring.choice, &r->scene->accuracy), .floor = FLOOR * s->ring.ramp * s->ring.ramp,
                                 .quantity = listener_quantity(v->listener)};
        s->voices[k].engine = launch_open(&ask, launching_point, &s->voices[k]);
    }
    return true;
}

static bool ring_launch_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct ring_launch *s = r->state;
    (void)e;
    for (int k = 0; k < s->ring.channels; k++) {
        memset(s->ring.y, 0, (size_t)(to - from) * sizeof *s->ring.y);
        launch_run(s->voices[k].engine, ring_force(&s->ring, s->voices[k].voice, from), s->ring.y, to - from);
        ring_put(&s->ring, k, from, to);
    }
    return true;
}

static void ring_launch_close(struct stage_run *r)
{
    const struct ring_launch *s = r->state;
    for (int k = 0; s && s->voices && k < s->ring.channels; k++)
        if (s->voices[k].engine)
            launch_close(s->voices[k].engine);
}

static bool ring_launch_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return ring_choice_engine(c, RING_SURFACE) == RING_LAUNCH;
}

const struct stage ring_launch_stage = {
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
    .close = ring_launch_close,
};
