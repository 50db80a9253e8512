/* Every force sample launches the response of its own place, by resonators (papers/000 eq. 10 and 13, `launch` of rasp-scene(5)).

       y(n) = (1/rate) sum_{m <= n} h_{x(m)}((n-m)/rate) f(m),   half of h(0+) at m = n,   h_x(t) = sum_i Im A_i(x) e^(s_i(x) t)

   Component i has nodes at multiples of its own hop H_i; node k has the pole and gain of frame k H_i, gets w_k f with the cardinal windows w_k of
   order 1, 2 or 4 (cardinal.h), and rings freely afterwards. That interpolates h between nodes: its error is of order H^order (ring_error.h),
   component by component. What the force adds by itself, -Im A/(2 rate) and the direct term of an acceleration (modes_direct), is
   interpolated by the same windows.

   Hops are rounded down to powers of two, so that components share the instants at which poles are asked for, windows are exact, and blocks
   divide them: of 64 frames, less when a hop is less. Order 1 changes nodes halfway between them.

   Per component: `order` resonators under force (launch_driven.c); clusters of nodes that ring out (launch_ringing.c, in blocks of 64; launch_rest.c
   where a node is freed inside one), which take about as much as three resonators each however many nodes they hold. A node is dropped
   when |Re z| + |Im z| has fallen to `floor` times the most it has been at any block's end. Poles and gains are not asked for
   while there is no force.

   Nodes, blocks and what is dropped stand at fixed frames, and sums have one order: the sound does not depend on how it is cut into
   calls, nor on the instruction set. tests/bench/launch.c has the speed. */
#include "convolution/launch.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "convolution/launch_driven.h"
#include "convolution/launch_rest.h"
#include "convolution/launch_ringing.h"
#include "convolution/product.h"
#include "num/vecmath.h"

enum { BLOCK = LAUNCH_RINGING_BLOCK, LONGEST = 1 << 30, MOST = 4 };

struct node {
    double frequency, decay;
    bool known;
};

struct component {
    int hop;               /* frames                                          */
    long first;            /* number of the oldest node under force           */
    struct node node[MOST]; /* those under force                              */
};

struct launch {
    struct arena *arena;
    struct launch_ask ask;
    launch_point *point;
    void *self;
    int block;                          /* frames in which no component changes nodes; divides BLOCK */
    long now;
    struct component *component;
    struct modes_point at;              /* [n] the place asked for last     */
    double *size, *turn, *rise;         /* [n] of its poles                 */
    struct launch_freed *freed;         /* [n]                              */
    bool unknown;                       /* a node under force has no pole   */
    bool has_through;                   /* of the present block             */
    double through[4];
    struct launch_driven *driven;
    struct launch_ringing *ringing;
    double sums[BLOCK][LANES];          /* from the last multiple of BLOCK on */
};

/* ------------------------------------------------------------------ open and close */

static int power_below(double hop)
{
    int power = 1;
    while (power < LONGEST && 2.0 * power <= hop)
        power *= 2;
    return power;
}

/* Frames from a window's first to its node, order 1; the others' windows begin and end at nodes. */
static int half_of(const struct launch *l, int i)
{
    return l->ask.order == 1 ? l->component[i].hop / 2 : 0;
}

static void set_hops(struct launch *l)
{
    int *hop = ARENA_TAKE(l->arena, int, l->ask.n + 1);
    l->block = BLOCK;
    for (int i = 0; i < l->ask.n; i++) {
        hop[i] = l->component[i].hop = power_below(l->ask.hop[i]);
        l->component[i].first = l->ask.order == 4 ? -1 : 0;
        int part = l->ask.order == 1 && hop[i] > 1 ? hop[i] / 2 : hop[i];
        l->block = part < l->block ? part : l->block;
    }
    l->driven = launch_driven_make(l->arena, l->ask.n, l->ask.order, hop);
    l->ringing = launch_ringing_make(l->arena, l->ask.n, l->ask.rate);
}

struct launch *launch_open(const struct launch_ask *ask, launch_point *point, void *self)
{
    struct arena *a = arena_open();
    struct launch *l = ARENA_TAKE(a, struct launch, 1);
    l->arena = a;
    l->ask = *ask;
    l->point = point;
    l->self = self;
    l->component = ARENA_TAKE(a, struct component, ask->n + 1);
    l->freed = ARENA_TAKE(a, struct launch_freed, ask->n + 1);
    double **rooms[] = {&l->at.frequency, &l->at.decay, &l->at.re, &l->at.im, &l->size, &l->turn, &l->rise};
    for (size_t k = 0; k < sizeof rooms / sizeof rooms[0]; k++)
        *rooms[k] = ARENA_TAKE(a, double, ask->n + 1);
    l->unknown = ask->n > 0;
    set_hops(l);
    l->ask.hop = NULL;
    return l;
}

void launch_close(struct launch *l)
{
    arena_close(l->arena);
}

/* ------------------------------------------------------------------ poles and gains of nodes */

static void set_node(struct launch *l, int i, int which)
{
    double *re = &l->at.re[i], *im = &l->at.im[i], per = 1.0 / l->ask.rate;
    struct modes_point own = {.frequency = &l->at.frequency[i], .decay = &l->at.decay[i], .re = re, .im = im};
    struct launch_node node = {.pole_re = l->size[i] * l->turn[i], .pole_im = l->size[i] * l->rise[i], .gain_re = *re * per, .gain_im = *im * per};
    node.through = modes_direct(l->ask.quantity, 1, own.frequency, own.decay, &own) - 0.5 * node.gain_im;
    launch_driven_set(l->driven, i, which, &node);
    l->component[i].node[which] = (struct node){.frequency = *own.frequency, .decay = *own.decay, .known = true};
}

static long frame_of(const struct component *c, int which)
{
    return (c->first + which) * c->hop;
}

/* All nodes at that frame. */
static void ask_at(struct launch *l, long frame)
{
    size_t n = (size_t)l->ask.n;
    l->point(l->self, (double)frame, &l->at);
    for (size_t i = 0; i < n; i++) {
        l->size[i] = -l->at.decay[i] / l->ask.rate;
        l->turn[i] = 2.0 * l->at.frequency[i] / l->ask.rate;
    }
    vecmath_exp(n, l->size, l->size);
    vecmath_sincospi(n, l->turn, l->rise, l->turn);
    for (int i = 0; i < l->ask.n; i++)
        for (int q = 0; q < l->ask.order; q++)
            if (!l->component[i].node[q].known && frame_of(&l->component[i], q) == frame)
                set_node(l, i, q);
}

/* The earliest frame of a node that is not known; false: there is none. */
static bool next_unknown(const struct launch *l, long *frame)
{
    bool any = false;
    for (int i = 0; i < l->ask.n; i++)
        for (int q = 0; q < l->ask.order; q++)
            if (!l->component[i].node[q].known && (!any || frame_of(&l->component[i], q) < *frame)) {
                *frame = frame_of(&l->component[i], q);
                any = true;
            }
    return any;
}

/* Before there is force in a block. */
static void ready(struct launch *l)
{
    for (long frame = 0; l->unknown && next_unknown(l, &frame);)
        ask_at(l, frame);
    l->unknown = false;
    if (!l->has_through)
        launch_driven_through(l->driven, l->block, l->through);
    l->has_through = true;
}

/* ------------------------------------------------------------------ blocks */

/* The component's oldest node leaves the force; true if it rings on. */
static bool move_on(struct launch *l, int i, struct launch_freed *freed)
{
    struct component *c = &l->component[i];
    struct launch_node old = launch_driven_next(l->driven, i);
    *freed = (struct launch_freed){.component = i, .frame = l->now, .frequency = c->node[0].frequency, .decay = c->node[0].decay,
                                   .pole_re = old.pole_re, .pole_im = old.pole_im, .re = old.re, .im = old.im,
                                   .least = fmax(l->ask.floor * old.largest, 1e-200)};
    for (int q = 0; q + 1 < l->ask.order; q++)
        c->node[q] = c->node[q + 1];
    c->node[l->ask.order - 1].known = false;
    c->first++;
    l->unknown = true;
    return fabs(old.re) + fabs(old.im) > freed->least;
}

static void begin_block(struct launch *l)
{
    int count = 0, at = (int)(l->now % BLOCK);
    for (int i = 0; i < l->ask.n && l->now > 0; i++)
        if ((l->now + half_of(l, i)) % l->component[i].hop == 0)
            count += move_on(l, i, &l->freed[count]);
    if (at > 0)
        launch_rest(l->freed, count, l->sums + at, BLOCK - at);
    launch_ringing_add(l->ringing, l->freed, count);
    if (at == 0) {
        memset(l->sums, 0, sizeof l->sums);
        launch_ringing_run(l->ringing, l->sums);
    }
    l->has_through = false;
    memset(l->through, 0, sizeof l->through);
}

/* The order of every sum over lanes. */
static double lanes_sum(const double *s)
{
    return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
}

/* Frames inside one block. */
static void run_some(struct launch *l, const double *f, double *y, int n)
{
    int from = (int)(l->now % l->block);
    double(*sums)[LANES] = l->sums + l->now % BLOCK;
    const double *p = l->through;
    if (from == 0)
        begin_block(l);
    if (!product_nothing(f, n))
        ready(l);
    launch_driven_run(l->driven, f, sums, from, n);
    for (int j = 0; j < n; j++) {
        double t = (double)(from + j) / l->block;
        y[j] += lanes_sum(sums[j]) + (p[0] + t * (p[1] + t * (p[2] + t * p[3]))) * f[j];
    }
    l->now += n;
    if (l->now % l->block == 0)
        launch_driven_settle(l->driven, l->block);
}

void launch_run(struct launch *l, const double *f, double *y, long frames)
{
    for (long done = 0; done < frames && l->ask.n > 0;) {
        long left = l->block - l->now % l->block, n = frames - done < left ? frames - done : left;
        run_some(l, f + done, y + done, (int)n);
        done += n;
    }
}

long launch_active(const struct launch *l)
{
    return launch_driven_active(l->driven) + launch_ringing_active(l->ringing);
}
