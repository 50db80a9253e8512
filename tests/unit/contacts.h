/* What the tests of strikes and given forces share: one stage that makes a force, at a place that is still, run by
 * hand; and the decimator after it. */
#ifndef TESTS_UNIT_CONTACTS_H
#define TESTS_UNIT_CONTACTS_H
#include "force/given.h"
#include "force/strike.h"
#include "scene/params.h"
#include "stage.h"
#include "trajectory/trajectory.h"
#include "unit.h"

extern const struct stage strike_stage, given_table_stage, given_samples_stage, decimate_stage;

enum { SHOT_MARGIN = 2048 };

struct shot {
    struct arena *arena;
    struct scene scene;
    struct contact contact;
    struct trajectory trajectory;
    struct board board;
    struct stage_run run, decimate;
    struct err e;
};

static double shot_ramp; /* s: output.ramp */

/* Of parameters that a contact is given by hand. */
static inline struct arena *shot_arena(void)
{
    static struct arena *a;
    return a ? a : (a = arena_open());
}

static inline struct strike *shot_strike(struct contact *c)
{
    return params_edit(c, strike_stage.params, shot_arena());
}

static inline struct given_force *shot_given(struct contact *c)
{
    return params_edit(c, given_table_stage.params, shot_arena());
}

static inline struct contact shot_contact(int model, double duration)
{
    struct contact c = {.name = "tap",
                        .motion = {.path = PATH_STILL, .speed = NAN, .duration = duration},
                        .scraper = {.mass = 0.02, .radius = NAN},
                        .contact = {.model = model, .gravity = 9.80665}};
    c.scraper.response.object = c.surface.response.object =
        (struct object_given){.youngs_modulus = NAN, .youngs_modulus_across = NAN, .poisson = NAN};
    *shot_strike(&c) =
        (struct strike){.pulse = PULSE_HERTZ, .speed = 1, .stiffness = 1e8, .interval = NAN, .restitution = NAN};
    *shot_given(&c) = (struct given_force){.channel = 1, .scale = NAN, .rate = NAN, .column = "force_n"};
    return c;
}

static inline void shot_room(struct shot *s, enum item item, int per_frame, long frames)
{
    struct signal *x = &s->board.signals[item];
    *x = (struct signal){per_frame, -SHOT_MARGIN, frames + 2 * SHOT_MARGIN, 0, NULL};
    x->x = ARENA_TAKE(s->arena, double, x->capacity *per_frame + 8);
}

/* Opens the contact's stage; false, with the error in s->e, when it is refused. The caller closes the arena. */
static inline bool shot_open(struct shot *s, const struct stage *stage, const struct contact *c, double rate, int over)
{
    *s = (struct shot){.arena = arena_open(), .contact = *c};
    s->scene.output.sample_rate = rate;
    s->scene.output.ramp = shot_ramp;
    s->scene.accuracy.oversampling = over;
    s->board = (struct board){.rate = rate, .over = over, .trajectory = &s->trajectory};
    s->run = (struct stage_run){
        .stage = stage, .scene = &s->scene, .contact = &s->contact, .board = &s->board, .arena = s->arena};
    s->decimate = s->run;
    return trajectory_make(&c->motion, 1, s->arena, &s->trajectory, &s->e) && stage->open(&s->run, &s->e) &&
           decimate_stage.open(&s->decimate, &s->e);
}

/* The force at the sub-rate (or, of samples, at the audio rate) over the first frames, in uneven blocks. */
static inline const double *shot_force(struct shot *s, long frames)
{
    enum item item = s->run.stage->gives & ITEM_BIT(ITEM_FORCE) ? ITEM_FORCE : ITEM_SUBFORCE;
    shot_room(s, item, item == ITEM_FORCE ? 1 : s->board.over, frames);
    for (long from = 0, block = 1; from < frames + SHOT_MARGIN - 8; from += block, block = (7 * block + 3) % 1021 + 1) {
        long to = from + block < frames + SHOT_MARGIN - 8 ? from + block : frames + SHOT_MARGIN - 8;
        ck_assert_msg(s->run.stage->run(&s->run, from, to, &s->e), "%s", s->e.text);
    }
    return board_at(&s->board, item, 0);
}

/* The same decimated to the audio rate, in uneven blocks. */
static inline const double *shot_decimated(struct shot *s, long frames)
{
    shot_force(s, frames);
    shot_room(s, ITEM_FORCE, 1, frames);
    ck_assert(s->decimate.back < SHOT_MARGIN / 2 && s->decimate.ahead < SHOT_MARGIN / 2);
    for (long from = 0, to, block = 1; from < frames; from = to, block = (11 * block + 5) % 2027 + 1) {
        to = from + block < frames ? from + block : frames;
        ck_assert(decimate_stage.run(&s->decimate, from, to, &s->e));
    }
    return board_at(&s->board, ITEM_FORCE, 0);
}

#endif
