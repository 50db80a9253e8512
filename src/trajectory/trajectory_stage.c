/* The stage that lays the motion on the board. */
#include "num/lanes.h"
#include "stage.h"
#include "trajectory/trajectory.h"

enum { STAGE_CHUNK = 256 };

static bool stage_wanted(const struct contact *c, const struct scene *s)
{
    (void)c, (void)s;
    return true;
}

static double stage_work(const struct contact *c, const struct scene *s)
{
    static const double cycles[] = {
        [PATH_BACK_AND_FORTH] = 18, [PATH_LINE] = 14,     [PATH_FOUR_IN_LINE] = 18, [PATH_CIRCLE] = 35,
        [PATH_SCRIBBLE] = 100,      [PATH_POLYLINE] = 40, [PATH_SPLINE] = 75,       [PATH_RECORDED] = 65,
        [PATH_STILL] = 5,           [PATH_INCLINE] = 20};
    return cycles[c->motion.path] * s->accuracy.oversampling;
}

static bool stage_open(struct stage_run *r, struct err *e)
{
    struct trajectory *tr = ARENA_TAKE(r->arena, struct trajectory, 1);
    if (!trajectory_make(&r->contact->motion, trajectory_seed(r->scene, r->contact), r->arena, tr, e))
        return err_at(e, "contact '%s'", r->contact->name);
    r->board->trajectory = tr;
    r->board->moving = trajectory_frames(tr, r->board->rate);
    return true;
}

static const enum item stage_items[] = {ITEM_POSITION, ITEM_VELOCITY, ITEM_ACCELERATION, ITEM_X, ITEM_Y,
                                        ITEM_VX,       ITEM_VY,       ITEM_AX,           ITEM_AY};
enum { STAGE_ITEMS = sizeof stage_items / sizeof stage_items[0] };

/* False where the motion is read at other instants only. */
static bool stage_read(const struct board *b)
{
    bool any = false;
    for (int k = 0; k < STAGE_ITEMS; k++)
        any = any || board_has(b, stage_items[k]);
    return any;
}

/* Only what something reads. */
static struct trajectory_out stage_out(const struct board *b, long from, long skip)
{
    double *at[STAGE_ITEMS];
    for (int k = 0; k < STAGE_ITEMS; k++)
        at[k] = board_has(b, stage_items[k]) ? board_at(b, stage_items[k], from) + skip : NULL;
    return (struct trajectory_out){at[0], at[1], at[2], at[3], at[4], at[5], at[6], at[7], at[8]};
}

LANES_CLONES
static void stage_instants(long first, size_t n, double rate, double *t)
{
    double from = (double)first; /* exact, as the sums are */
#pragma omp simd
    for (int i = 0; i < (int)n; i++)
        t[i] = (from + i) / rate;
}

static bool stage_fill(struct stage_run *r, long from, long to, struct err *e)
{
    (void)e;
    const struct board *b = r->board;
    double t[STAGE_CHUNK];
    long n = (to - from) * b->over, first = from * b->over;
    for (long i = 0; i < n && stage_read(b); i += STAGE_CHUNK) {
        size_t some = (size_t)(n - i < STAGE_CHUNK ? n - i : STAGE_CHUNK);
        stage_instants(first + i, some, b->rate * b->over, t);
        trajectory_at(b->trajectory, some, t, stage_out(b, from, i));
    }
    return true;
}

const struct stage trajectory_stage = {
    .name = "trajectory",
    .does = "position, velocity and acceleration of the contact",
    .paper = "000 sec. 2.3, 3.2",
    .idle = "",
    .gives = ITEM_BIT(ITEM_MOTION) | ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | ITEM_BIT(ITEM_ACCELERATION) |
             ITEM_BIT(ITEM_X) | ITEM_BIT(ITEM_Y) | ITEM_BIT(ITEM_VX) | ITEM_BIT(ITEM_VY) | ITEM_BIT(ITEM_AX) |
             ITEM_BIT(ITEM_AY),
    .wanted = stage_wanted,
    .work = stage_work,
    .open = stage_open,
    .run = stage_fill,
};
