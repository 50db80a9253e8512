/* See roll_pass.h. What the stages before the rolling force lay on the board are functions of time, and the relief may be read anywhere: here they lay the
   whole motion on a board of the pass's own, a chunk at a time, in grains of its own: 1/48000 s, or finer so that the ball goes no further in one than its
   patch, nor than a tenth of the way in which an offset ball's centre of mass passes through its lowest place, nor of that between two lobes (but no finer
   than 1 um of way), and a whole number in the motion. So neither accuracy.oversampling nor output.sample_rate changes what follows. S is integrated exactly
   over each grain, however long (force/slope.c).

   Of a motion of more than ROLL_PASS_MOST grains one in every `stride` is kept, at a place among them that goes by the golden ratio, so that nothing that
   repeats itself falls in step with it.

   Beyond its end a straight motion goes straight on as it last went. One on a curved or cornered way goes on in up to HEADINGS straight stretches of the same length, at
   least STRETCH each (S takes some leaks to turn from one to the next),
   whose directions are those of the motion, shared out by the way that it goes in each: over ridges or along a grain the ground depends on the direction, and
   that in which the motion happens to end is none of the stiffness's business. There and back are one direction, for S varies alike in both: all turned to
   +x or -x, as the motion last went, and taken from -y to +y, the stretches never come back to ground that they were on, along x either. The ground is the one
   that is there: what is procedural has no end, and a map goes on by surface.off_map, for `error` as for `mirror`. */
#include "force/roll_pass.h"

#include <math.h>
#include <stdlib.h>

#include "num/real.h"
#include "surface/limiter.h"
#include "surface/relief.h"
#include "trajectory/trajectory.h"

extern const struct stage trajectory_stage, load_stage, limiter_stage, tip_stage;

enum { HALVINGS = 20, HEADINGS = 8, LOOKS = 1024 };

#define STRETCH 4.0 /* l, at least, where there are several */
#define GOLDEN 0.6180339887498949

/* ------------------------------------------------------------------ grains */

double roll_pass_grain(const struct contact *c)
{
    const struct ball *b = &c->ball;
    double gap = b->radius - b->offset, turn = 0.1 * gap * sqrt(gap / b->radius), lobe = b->lobe_height > 0 ? 0.2 * REAL_PI * gap / b->lobes : HUGE_VAL;
    return fmax(fmin(fmin(b->patch, turn), lobe), 1e-6);
}

/* x = R theta - r sin theta goes through the lowest place of the centre of mass within some (R - r)^1.5 / R^0.5. */
double roll_pass_rate(const struct contact *c, double duration, double speed)
{
    return ceil(duration * fmax(ROLL_PASS_RATE, speed / roll_pass_grain(c)) * (1 - 1e-12)) / duration;
}

static long pass_pick(const struct roll_pass *p, long group)
{
    double place = (double)group * GOLDEN;
    return group * p->stride + (long)((double)p->stride * (place - floor(place)));
}

/* ------------------------------------------------------------------ making */

static void pass_board(struct roll_pass *p, const struct stage_run *r, struct arena *a)
{
    const struct contact *c = r->contact;
    const struct trajectory *tr = r->board->trajectory;
    unsigned items = ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | way_asks(c);
    p->run = *r;
    p->board = *r->board;
    p->run.board = &p->board;
    p->run.arena = a;
    p->board.rate = roll_pass_rate(c, tr->duration, tr->top_speed);
    p->board.over = 1;
    if (p->board.load)
        items |= ITEM_BIT(ITEM_LOAD) | (load_stage.asks ? load_stage.asks(c, p->run.scene) : 0);
    if (p->board.limiter)
        items |= ITEM_BIT(ITEM_ALPHA);
    for (int i = 0; i < ITEM_COUNT; i++)
        p->board.signals[i] = items & ITEM_BIT(i) ? (struct signal){.per_frame = 1, .capacity = WAY_CHUNK + 1, .x = ARENA_TAKE(a, double, WAY_CHUNK + 1)}
                                                  : (struct signal){0};
}

static void pass_room(struct roll_pass *p, struct arena *a)
{
    p->grains = lrint(p->board.trajectory->duration * p->board.rate);
    p->stride = (p->grains + ROLL_PASS_MOST - 1) / ROLL_PASS_MOST;
    p->next = pass_pick(p, 0);
    long room = p->grains / p->stride + 1;
    p->way = ARENA_TAKE(a, double, room);
    for (int k = 0; k < 2; k++) {
        p->at[k] = ARENA_TAKE(a, double, room);
        for (int j = 0; j < SLOPE_LEVELS; j++)
            p->lift[k][j] = ARENA_TAKE(a, double, room);
        p->load[k] = p->board.load ? ARENA_TAKE(a, double, room) : NULL;
    }
}

bool roll_pass_make(struct roll_pass *p, const struct stage_run *r, struct arena *a, struct err *e)
{
    pass_board(p, r, a);
    p->slope.rising = true;
    p->centre = roll_centre_make(r->contact);
    if (!slope_make(&p->slope, &p->run, e))
        return false;
    pass_room(p, a);
    return true;
}

/* The tip is laid over the bare ground once more. */
bool roll_pass_plain(struct roll_pass *p, struct err *e)
{
    struct arena *a = p->run.arena;
    const struct relief *fine = p->board.relief;
    struct scene *scene = ARENA_TAKE(a, struct scene, 1);
    struct relief *plain = ARENA_TAKE(a, struct relief, 1);
    *scene = *p->run.scene;
    scene->accuracy.tip_heights = 1;
    *plain = *fine;
    plain->first = fine->under->first;
    p->run.scene = scene;
    p->board.relief = plain;
    if (!tip_stage.open(&p->run, e))
        return false;
    p->slope = (struct slope){.rising = true, .turned = {.heading = slope_heading_make(&p->run, a)}};
    return slope_make(&p->slope, &p->run, e);
}

/* ------------------------------------------------------------------ the motion */

/* Motion, normal force and alpha at the ends of grains [from, to). */
static bool pass_fill(struct roll_pass *p, long from, long to, struct err *e)
{
    const struct stage *const before[] = {&trajectory_stage, &load_stage, &limiter_stage};
    const bool there[] = {true, p->board.load != NULL, p->board.limiter != NULL};
    for (int i = 0; i < ITEM_COUNT; i++)
        p->board.signals[i].first = from;
    for (int i = 0; i < 3; i++)
        if (there[i] && !before[i]->run(&p->run, from, to + 1, e))
            return false;
    return true;
}

static void pass_keep(struct roll_pass *p, long first, int n)
{
    const double *load = p->board.load ? way_values(&p->board, ITEM_LOAD, first) : NULL;
    for (; p->next < first + n; p->next = pass_pick(p, ++p->n)) {
        long i = p->next - first;
        p->way[p->n] = p->slope.travelled[i];
        for (int k = 0; k < 2; k++) {
            p->at[k][p->n] = p->centre.at[i + k];
            for (int j = 0; j < SLOPE_LEVELS; j++)
                p->lift[k][j][p->n] = p->centre.lifts[j][i + k];
            if (load)
                p->load[k][p->n] = load[i + k];
        }
    }
}

bool roll_pass_motion(struct roll_pass *p, struct err *e)
{
    for (long from = 0; from < p->grains;) {
        int n = way_some(from, p->grains);
        if (!pass_fill(p, from, from + n, e))
            return false;
        slope_run(&p->slope, &p->run, from, n);
        roll_centre_follow(&p->centre, &p->slope, n);
        pass_keep(p, from, n);
        from += n;
    }
    return true;
}

/* ------------------------------------------------------------------ beyond */

struct pass_on {
    double u, heading;              /* heading: +1, -1 */
    int n;                          /* stretches       */
    double ex[HEADINGS], ey[HEADINGS], share[HEADINGS];
    double x[HEADINGS], y[HEADINGS]; /* m, where each begins, */
    long first[HEADINGS + 1];        /* and its first grain   */
};

/* Where the motion ends, and which way it went there: by the last instant, of those that halve what is left, from which it went on by 1 um. */
static bool pass_end(const struct trajectory *tr, struct pass_on *on)
{
    double t = tr->duration, u, x, y;
    trajectory_at(tr, 1, &t, (struct trajectory_out){.u = &on->u, .x = &on->x[0], .y = &on->y[0]});
    double left = tr->duration / (1 << HALVINGS);
    for (int k = HALVINGS; k >= 0; k--, left *= 2) {
        t = tr->duration - left;
        trajectory_at(tr, 1, &t, (struct trajectory_out){.u = &u, .x = &x, .y = &y});
        double chord = sqrt((on->x[0] - x) * (on->x[0] - x) + (on->y[0] - y) * (on->y[0] - y));
        if (fabs(on->u - u) < 1e-6 || chord < 1e-6)
            continue;
        on->heading = on->u > u ? 1 : -1;
        on->n = 1;
        on->ex[0] = (on->x[0] - x) / chord;
        on->ey[0] = (on->y[0] - y) / chord;
        on->share[0] = 1;
        return true;
    }
    return false;
}

struct heading {
    double ex, ey, speed;           /* ex of one sign */
};

static int heading_order(const void *a, const void *b)
{
    const struct heading *p = a, *q = b;
    if (p->ey != q->ey)
        return p->ey < q->ey ? -1 : 1;
    return p->ex != q->ex ? (p->ex < q->ex ? -1 : 1) : (p->speed > q->speed) - (p->speed < q->speed);
}

/* At LOOKS instants; how many of them were none of rest. */
static int pass_look(const struct trajectory *tr, const struct pass_on *last, struct heading *h)
{
    double t[LOOKS], vx[LOOKS], vy[LOOKS];
    int n = 0;
    for (int k = 0; k < LOOKS; k++)
        t[k] = tr->duration * (k + (k * GOLDEN - floor(k * GOLDEN))) / LOOKS;
    trajectory_at(tr, LOOKS, t, (struct trajectory_out){.vx = vx, .vy = vy});
    for (int k = 0; k < LOOKS; k++) {
        double speed = sqrt(vx[k] * vx[k] + vy[k] * vy[k]), turn = vx[k] * last->ex[0] < 0 || (vx[k] == 0 && vy[k] * last->ey[0] < 0) ? -1 : 1;
        if (speed > 1e-6 * tr->top_speed)
            h[n++] = (struct heading){.ex = turn * vx[k] / speed, .ey = turn * vy[k] / speed, .speed = speed};
    }
    return n;
}

/* `most` directions of a motion on a curved way. One that rests at all instants keeps the one that it ended in. */
static void pass_headings(const struct trajectory *tr, int most, struct pass_on *on)
{
    struct heading h[LOOKS];
    double all = 0, sum = 0;
    int n = pass_look(tr, on, h);
    qsort(h, (size_t)n, sizeof *h, heading_order);
    for (int i = 0; i < n; i++)
        all += h[i].speed;
    for (int k = 0, i = 0; k < most && n > 0; k++) {
        while (i + 1 < n && sum + h[i].speed <= (k + 0.5) / most * all)
            sum += h[i++].speed;
        on->ex[k] = h[i].ex;
        on->ey[k] = h[i].ey;
        on->share[k] = 1.0 / most;
    }
    on->n = n > 0 ? most : on->n;
}

/* Into how many. */
static int pass_most(double way, double leak)
{
    return (int)fmin(fmax(way / (STRETCH * leak), 1), HEADINGS);
}

/* n grains of `step` m in whole stretches. */
static void pass_stretches(struct pass_on *on, long n, double step)
{
    double share = 0;
    on->first[0] = 0;
    for (int k = 0; k < on->n; k++) {
        share += on->share[k];
        on->first[k + 1] = k + 1 < on->n ? lrint(share * (double)n) : n;
        double way = (double)(on->first[k + 1] - on->first[k]) * step;
        if (k + 1 == on->n)
            break;
        on->x[k + 1] = on->x[k] + on->ex[k] * way;
        on->y[k + 1] = on->y[k] + on->ey[k] * way;
    }
}

static void pass_put(struct board *b, enum item item, long i, double value)
{
    if (board_has(b, item))
        *board_at(b, item, i) = value;
}

/* The ends of grains [from, to), `step` m each: the motion goes on at its top speed, so that nothing that goes by speed takes it to be at rest. At a corner
   it rests, and so has the direction of either side (force/way.c). */
static void pass_lay(struct roll_pass *p, const struct pass_on *on, long from, long to, double step)
{
    struct board *b = &p->board;
    double top = b->trajectory->top_speed;
    int k = 0;
    for (int i = 0; i < ITEM_COUNT; i++)
        b->signals[i].first = from;
    for (long i = from; i <= to; i++) {
        while (k + 1 < on->n && i >= on->first[k + 1])
            k++;
        double way = (double)(i - on->first[k]) * step, speed = k > 0 && i == on->first[k] ? 0 : top;
        pass_put(b, ITEM_POSITION, i, on->u + on->heading * (double)i * step);
        pass_put(b, ITEM_VELOCITY, i, on->heading * top);
        pass_put(b, ITEM_X, i, on->x[k] + on->ex[k] * way);
        pass_put(b, ITEM_Y, i, on->y[k] + on->ey[k] * way);
        pass_put(b, ITEM_VX, i, on->ex[k] * speed);
        pass_put(b, ITEM_VY, i, on->ey[k] * speed);
    }
}

bool roll_pass_beyond(struct roll_pass *p, long n, double step, double normal, double *const to[1 + SLOPE_LEVELS])
{
    struct pass_on on;
    double alpha;
    if (!pass_end(p->board.trajectory, &on))
        return false;
    if (p->slope.way.curved)
        pass_headings(p->board.trajectory, pass_most((double)n * step, p->slope.leak), &on);
    pass_stretches(&on, n, step);
    if (p->board.limiter)
        limiter_alpha(p->board.limiter, 1, &normal, &alpha);
    for (int i = 0; i <= WAY_CHUNK && p->board.limiter; i++)
        p->board.signals[ITEM_ALPHA].x[i] = alpha;
    for (long from = 0; from < n;) {
        int some = way_some(from, n);
        pass_lay(p, &on, from, from + some, step);
        slope_run(&p->slope, &p->run, from, some);
        roll_centre_follow(&p->centre, &p->slope, some);
        for (int i = 0; i < some; i++) {
            to[0][from + i] = p->centre.at[i];
            for (int k = 0; k < SLOPE_LEVELS; k++)
                to[1 + k][from + i] = p->centre.lifts[k][i];
        }
        from += some;
    }
    return true;
}
