/* Every force sample launches the response of its own place, by resonators (papers/000 eq. 10 and 13, `launch` of rasp-scene(5)).

       y(n) = (1/rate) sum_{m <= n} h_{x(m)}((n-m)/rate) f(m),   half of h(0+) at m = n,   h_x(t) = sum_i Im A_i(x) e^(s_i(x) t)

   Nodes stand every H frames, and h is the cubic through the four nearest. So in the interval between nodes k and k + 1, u = 0 .. 1 of it, the force
   drives the resonators of nodes k - 1 .. k + 2 with w_q(u) f,

       w = -u (1-u)(2-u)/6, (1+u)(1-u)(2-u)/2, u (1+u)(2-u)/2, -u (1+u)(1-u)/6

   and at its end those of node k - 1 are free and ring out. With poles that move evenly, white force, a mode's relative rms error is

       0.211 rho^4,   rho = |ds/dt| H / (rate |Re s|): half bandwidths by which the pole moves in a hop

   (the mean square of the cubic's node polynomial and int t^8 e^(2 Re s t) dt). What the force adds by itself, -Im A/(2 rate) and the direct term of
   an acceleration (modes_direct), is interpolated by the same weights.

   Nodes that ring out take about as much as three resonators of a component however many they are (launch_ringing.c). A node is dropped when it has fallen
   to `floor` times what it was when the force left it. Poles and gains are not asked for while there is no force.

   Nodes and blocks stand at fixed frames, and sums have one order: the sound does not depend on how it is cut into calls, nor on the instruction set. */
#include "convolution/launch.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "convolution/launch_ringing.h"
#include "convolution/resonator_group.h"
#include "num/scaled.h"
#include "num/vecmath.h"

enum { BLOCK = LAUNCH_RINGING_BLOCK, NODES = 4 };

/* The resonators of one node under force. */
struct node {
    struct resonator_group *group;
    double *frequency, *decay; /* [n] */
    double through;            /* what the force adds by itself, per N */
    bool known, awake;         /* poles and gains are there; a state is not zero */
};

struct launch {
    struct arena *arena;
    struct launch_ask ask;
    launch_point *point;
    void *self;
    int groups, block;           /* block: frames, a part of the hop, at most BLOCK */
    long now;
    struct node node[NODES];     /* oldest first */
    struct resonator_group **active; /* [groups] */
    struct modes_point at;       /* [n] the place asked for last */
    double *size, *turn, *rise;  /* [n] of its poles */
    struct launch_freed *freed;  /* [n] */
    struct launch_ringing *ringing;
    double sums[BLOCK][LANES];   /* of the present block */
};

/* ------------------------------------------------------------------ open and close */

struct launch *launch_open(const struct launch_ask *ask, launch_point *point, void *self)
{
    struct arena *a = arena_open();
    struct launch *l = ARENA_TAKE(a, struct launch, 1);
    *l = (struct launch){.arena = a, .ask = *ask, .point = point, .self = self, .groups = (ask->n + LANES - 1) / LANES, .at = modes_point_make(a, ask->n + 1)};
    for (int parts = (ask->hop + BLOCK - 1) / BLOCK; l->block == 0; parts++)
        l->block = ask->hop % parts == 0 ? ask->hop / parts : 0;
    for (int q = 0; q < NODES; q++) {
        l->node[q].group = ARENA_TAKE(a, struct resonator_group, l->groups + 1);
        l->node[q].frequency = ARENA_TAKE(a, double, ask->n + 1);
        l->node[q].decay = ARENA_TAKE(a, double, ask->n + 1);
    }
    l->active = ARENA_TAKE(a, struct resonator_group *, l->groups + 1);
    l->size = ARENA_TAKE(a, double, ask->n + 1);
    l->turn = ARENA_TAKE(a, double, ask->n + 1);
    l->rise = ARENA_TAKE(a, double, ask->n + 1);
    l->freed = ARENA_TAKE(a, struct launch_freed, ask->n + 1);
    l->ringing = launch_ringing_make(a, ask->n, ask->rate, l->block);
    return l;
}

void launch_close(struct launch *l)
{
    arena_close(l->arena);
}

/* ------------------------------------------------------------------ nodes */

/* Poles and gains of the node at that frame. */
static void set_node(struct launch *l, struct node *v, double frame)
{
    size_t n = (size_t)l->ask.n;
    double per = 1.0 / l->ask.rate;
    l->point(l->self, frame, &l->at);
    memcpy(v->frequency, l->at.frequency, n * sizeof *v->frequency);
    memcpy(v->decay, l->at.decay, n * sizeof *v->decay);
    for (size_t i = 0; i < n; i++) {
        l->size[i] = -l->at.decay[i] / l->ask.rate;
        l->turn[i] = 2.0 * l->at.frequency[i] / l->ask.rate;
    }
    vecmath_exp(n, l->size, l->size);
    vecmath_sincospi(n, l->turn, l->rise, l->turn);
    v->through = modes_direct(l->ask.quantity, l->ask.n, l->at.frequency, l->at.decay, &l->at);
    for (size_t i = 0; i < n; i++) {
        struct resonator_group *g = &v->group[i / LANES];
        g->pr[i % LANES] = l->size[i] * l->turn[i];
        g->pi[i % LANES] = l->size[i] * l->rise[i];
        g->gr[i % LANES] = l->at.re[i] * per;
        g->gi[i % LANES] = l->at.im[i] * per;
        v->through -= 0.5 * g->gi[i % LANES];
    }
    v->known = true;
}

/* The oldest node is free: its resonators ring on, and serve the node that comes next. */
static void next_node(struct launch *l)
{
    struct node old = l->node[0];
    int count = 0;
    for (int i = 0; old.awake && i < l->ask.n; i++) {
        const struct resonator_group *g = &old.group[i / LANES];
        int lane = i % LANES;
        double size = fabs(g->zr[lane]) + fabs(g->zi[lane]);
        if (size > 1e-200)
            l->freed[count++] = (struct launch_freed){i, l->now, old.frequency[i], old.decay[i], g->zr[lane], g->zi[lane], fmax(l->ask.floor * size, 1e-200)};
    }
    launch_ringing_add(l->ringing, l->freed, count);
    for (int k = 0; old.awake && k < l->groups; k++)
        memset(old.group[k].zr, 0, sizeof old.group[k].zr), memset(old.group[k].zi, 0, sizeof old.group[k].zi);
    memmove(l->node, l->node + 1, (NODES - 1) * sizeof *l->node);
    old.known = old.awake = false;
    l->node[NODES - 1] = old;
}

/* ------------------------------------------------------------------ blocks */

/* After a block: a node whose states have all fallen below 1e-200 is at rest. */
static void rest(struct launch *l)
{
    for (int q = 0; q < NODES; q++) {
        struct node *v = &l->node[q];
        double most = 0;
        for (int k = 0; v->awake && k < l->groups; k++)
            for (int lane = 0; lane < LANES; lane++)
                most = fmax(most, fmax(fabs(v->group[k].zr[lane]), fabs(v->group[k].zi[lane])));
        for (int k = 0; v->awake && most < 1e-200 && k < l->groups; k++)
            memset(v->group[k].zr, 0, sizeof v->group[k].zr), memset(v->group[k].zi, 0, sizeof v->group[k].zi);
        v->awake = v->awake && most >= 1e-200;
    }
}

/* The order of every sum over lanes. */
static double lanes_sum(const double *s)
{
    return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
}

/* n frames inside one block. */
static void run_some(struct launch *l, const double *f, double *y, int n)
{
    static const double by[NODES] = {-1.0 / 6, 0.5, 0.5, -1.0 / 6};
    long at = l->now % l->ask.hop;
    int from = (int)(l->now % l->block);
    double share[NODES][BLOCK];
    bool force = !scaled_is_zero(f, n);
    for (int j = 0; j < n; j++) {
        double u = (double)(at + j) / l->ask.hop, v = 1 - u, around = (1 + u) * (2 - u);
        const double w[NODES] = {u * v * (2 - u), around * v, around * u, u * v * (1 + u)};
        for (int q = 0; q < NODES; q++)
            share[q][j] = by[q] * w[q] * f[j];
    }
    for (int q = 0; q < NODES; q++) {
        struct node *v = &l->node[q];
        if (force && !v->known)
            set_node(l, v, (double)(l->now - at + (q - 1) * (long)l->ask.hop));
        v->awake = v->awake || force;
        for (int k = 0; k < l->groups; k++)
            l->active[k] = &v->group[k];
        if (v->awake)
            resonator_group_ring(l->active, l->groups, share[q], l->sums + from, n, RESONATOR_STEADY);
    }
    for (int j = 0; j < n; j++) {
        double sum = lanes_sum(l->sums[from + j]);
        for (int q = 0; force && q < NODES; q++)
            sum += l->node[q].through * share[q][j];
        y[j] += sum;
    }
    l->now += n;
    if (l->now % l->block == 0)
        rest(l);
}

void launch_run(struct launch *l, const double *f, double *y, long frames)
{
    for (long done = 0; done < frames && l->ask.n > 0;) {
        long left = l->block - l->now % l->block, n = frames - done < left ? frames - done : left;
        if (l->now % l->block == 0) {
            if (l->now > 0 && l->now % l->ask.hop == 0)
                next_node(l);
            memset(l->sums, 0, sizeof l->sums);
            launch_ringing_run(l->ringing, l->sums);
        }
        run_some(l, f + done, y + done, (int)n);
        done += n;
    }
}

long launch_active(const struct launch *l)
{
    long count = launch_ringing_active(l->ringing);
    for (int q = 0; q < NODES; q++)
        for (int i = 0; i < l->ask.n; i++)
            count += l->node[q].group[i / LANES].zr[i % LANES] != 0.0 || l->node[q].group[i / LANES].zi[i % LANES] != 0.0;
    return count;
}
