/* A low-pass on the force whose cutoff is in proportion to the contact's speed (papers/004, after van den Doel, Kry and
   Pai 2001):

     f_c = contact.gesture.cutoff |v| / contact.gesture.speed      -3 dB, at most 0.49 of the sample rate, from where on
                                                                   it counts as open

   Order 1: y' = w (x - y). Order 2, Butterworth's two poles: s' = w (x - sqrt(2) s - y), y' = w s, with w = 2 pi f_c.
   Each is stepped by the trapezoidal rule with w T / 2 replaced by g = tan(pi f_c T), which puts the -3 dB at f_c at
   any sample rate (a topology-preserving transform; V. Zavalishin, The Art of VA Filter Design, 2012, chapters 3 and
   4). The state is kept as what the integrators hold, so that a step is an implicit midpoint step: |state|^2 never
   grows without input, whatever f_c does.

   Its gain at 0 Hz is 1 at every cutoff. As the speed falls to 0 all that changes is filtered away, and what is left is
   the force that there is as the contact comes to rest, which stands still with it: a constant force, which drives no
   mode. So a hand that rests makes no sound, and there is no step when it comes to rest or moves on. (A gain that fell
   to 0 would be the other reading; neither paper asks for one.) A motion that starts from rest starts from a force of
   0.

   load.approach and load.release come after it, in place of the stage approach: what the low-pass holds is let go too.
   Of a given force, which has neither, it is let go over 5 ms, so that the sound does not end with what it holds. */
#include "force/gesture.h"

#include <math.h>

#include "num/real.h"
#include "scene/rows.h"
#include "scene/scene_part.h"
#include "stage.h"
#include "trajectory/contact.h"
#include "trajectory/load.h"
#include "trajectory/trajectory.h"

#define GESTURE_OPEN 0.49 /* of the sample rate */

/* ------------------------------------------------------------------ parameters */

#define DRIVEN "contact.model=impacts|playback|given"

static const struct key keys[] = {{ROW_NUMBER(gesture, cutoff, "contact.gesture.cutoff"), KEY_FREQUENCY, 1, 1e6,
                                   "10 kHz", DRIVEN,
                                   "cutoff (-3 dB) at the speed below; it is in proportion to the speed"},
                                  {ROW_NUMBER(gesture, speed, "contact.gesture.speed"), KEY_SPEED, 1e-4, 100, "0.5 m/s",
                                   DRIVEN, "speed of the contact at that cutoff"},
                                  {ROW_COUNT(gesture, order, "contact.gesture.order"), KEY_NONE, 1, 2, "2", DRIVEN,
                                   "order of the low-pass: 6 or 12 dB an octave"},
                                  {.path = NULL}};

static void check(const struct scene_part *p, const struct contact *c, const void *own)
{
    (void)own;
    const char *path = "contact.gesture", *motion = "motion.path";
    const struct yaml_node *node = yaml_find(p->map, path);
    if (!gesture_follows(c) && node->n == 0) /* its keys say it themselves */
        diag_add(p->yaml->diag, node->key->at, "remove it, or set contact.model to impacts, playback or given",
                 "%s has no effect where %s is %s", scene_part_label(p, path), scene_part_label(p, "contact.model"),
                 keys_find("contact.model")->choices[c->contact.model].word);
    if (gesture_follows(c) && c->motion.path == PATH_STILL && scene_part_known(p, motion))
        scene_part_refuse(p, motion, path, "let it move, such as path: back_and_forth; or remove contact.gesture",
                          " is still and %s is given: its low-pass follows the speed, and lets nothing pass at rest",
                          scene_part_label(p, path));
}

static const struct params gesture_params = {
    .section = "contact.gesture",
    .meaning = "a low-pass on the force that follows the contact's speed, as of a hand's gesture (Conan et al. 2014b)",
    .size = sizeof(struct gesture),
    .keys = keys,
    .check = check,
};

bool gesture_follows(const struct contact *c)
{
    return params_given(c, &gesture_params) && (contact_driven(c) || c->contact.model == CONTACT_GIVEN);
}

/* ------------------------------------------------------------------ the filter */

struct gesture_filter {
    struct load_law fade;
    double per_speed; /* f_c T over |v|, s/m             */
    double speed, g;  /* of the frame before             */
    double state[2];  /* what the integrators hold: s, y */
    int order;
};

static bool gesture_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return gesture_follows(c);
}

static void warn_open(const struct stage_run *r, double greatest)
{
    const struct gesture *g = params_of(r->contact, &gesture_params);
    if (greatest > GESTURE_OPEN * r->board->rate)
        board_warn(r->board, arena_format(r->arena,
                                          "contact '%s': contact.gesture: the cutoff reaches %.6g Hz at %.4g m/s; "
                                          "above %.6g Hz, 0.49 of the sample rate, the "
                                          "low-pass counts as open",
                                          r->contact->name, greatest, greatest / g->cutoff * g->speed,
                                          GESTURE_OPEN * r->board->rate));
}

static bool gesture_open(struct stage_run *r, struct err *e)
{
    const struct gesture *g = params_of(r->contact, &gesture_params);
    struct gesture_filter *f = ARENA_TAKE(r->arena, struct gesture_filter, 1);
    r->state = f;
    f->order = g->order;
    f->per_speed = g->cutoff / g->speed / r->board->rate;
    warn_open(r, f->per_speed * r->board->rate * r->board->trajectory->top_speed);
    /* what is lowered and raised; of a given force raised alone, as far as there is time */
    if (!load_make(r->contact, r->board->trajectory, r->arena, &f->fade, e)) return false;
    if (r->contact->contact.model == CONTACT_GIVEN) f->fade.release = fmin(LOAD_APPROACH, f->fade.duration);
    return true;
}

static double filter_step(struct gesture_filter *f, double x)
{
    double g = f->g, *state = f->state;
    if (f->order == 1) {
        double y = (state[1] + g * x) / (1 + g);
        state[1] = 2 * y - state[1];
        return y;
    }
    double s = (state[0] + g * (x - state[1])) / (1 + g * (sqrt(2) + g)), y = state[1] + g * s;
    state[0] = 2 * s - state[0];
    state[1] = 2 * y - state[1];
    return y;
}

static bool gesture_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct gesture_filter *f = r->state;
    const struct board *b = r->board;
    const double *velocity = board_at(b, ITEM_VELOCITY, from);
    double *force = board_at(b, ITEM_FORCE, from);
    (void)e;
    for (long n = from; n < to; n++) {
        double speed = fabs(velocity[(n - from) * b->over]);
        if (speed != f->speed) f->g = real_tan(REAL_PI * fmin(f->per_speed * speed, GESTURE_OPEN));
        f->speed = speed;
        force[n - from] = filter_step(f, force[n - from]) * load_lowered(&f->fade, (double)n / b->rate);
    }
    return true;
}

static void gesture_skip(struct stage_run *r, long frame)
{
    struct gesture_filter *f = r->state;
    (void)frame;
    f->state[0] = f->state[1] = 0;
}

const struct stage gesture_stage = {
    .name = "gesture",
    .does = "a low-pass on the force whose cutoff follows the contact's speed",
    .paper = "004, navigation strategy",
    .idle = "no contact.gesture",
    .params = &gesture_params,
    .needs = ITEM_BIT(ITEM_FORCE) | ITEM_BIT(ITEM_VELOCITY),
    .gives = ITEM_BIT(ITEM_FORCE),
    .wanted = gesture_wanted,
    .cycles = 160,
    .open = gesture_open,
    .run = gesture_run,
    .skip = gesture_skip,
};
