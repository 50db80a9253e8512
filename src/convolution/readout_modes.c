/* All past force heard through the response of the present place (readout.c), mode by mode.

   Node k of component i, at frame k H_i, has the pole and gain of that frame, p = e^(s/rate) and A, and a window w_k over the sound (cardinal.h):

       y(n) = sum_i sum_k w_k(n) (Im A_k Z_k(n) + f(n) through_k),   Z_k(n) = p_k Z_k(n-1) + f(n)/rate

   Z_k at the window's start is a sum over the past force, sum_m p_k^(n-m) f(m)/rate, back to where p_k^(n-m) has decayed by `decibel`: L frames. Within
   the window it goes on as a resonator. So a component costs L/H + order steps of a resonator per frame, the sum over the past in LANES strides, while
   readout.c pays some hundred for each frame of the longest mode's response at the shortest mode's hop. At hops of one frame this is the defining sum.

   Hops are powers of two; nodes stand at fixed frames and sums have one order: the sound does not depend on how it is cut into calls. */
#include "convolution/readout_modes.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "convolution/cardinal.h"
#include "num/lanes.h"
#include "num/real.h"
#include "num/vecmath.h"

enum { MOST = 4, LEVELS = 31 };

struct node {
    double pole_re, pole_im, re, im; /* p; Z */
    double gain_re, gain_im;         /* A/rate */
    double through;
    long first;                      /* frame at which its window starts */
    bool used;
};

struct component {
    int level;              /* hop = 2^level frames */
    int oldest;
    struct node node[MOST];
};

struct readout_modes {
    struct arena *arena;
    struct readout_modes_ask ask;
    launch_point *point;
    void *self;
    struct component *component;
    double *window[LEVELS];      /* NULL: no component has that hop */
    long next[LEVELS];           /* number of the node that is next to start */
    struct modes_point at;
    double *size, *turn, *rise;  /* [n] of the place asked for last */
    double *past;                /* [2 most]: force before now, the newest at end - 1 */
    long most, end, known;       /* known: samples that count */
    long now;
};

/* ------------------------------------------------------------------ open and close */

static int level_of(double hop)
{
    int level = 0;
    while (level < LEVELS - 1 && ldexp(2, level) <= hop)
        level++;
    return level;
}

static void open_level(struct readout_modes *r, int level)
{
    int hop = 1 << level, order = r->ask.order;
    long k = 0;
    if (r->window[level])
        return;
    r->window[level] = ARENA_TAKE(r->arena, double, (size_t)order * hop);
    cardinal_window(order, hop, r->window[level]);
    while (cardinal_start(order, hop, k) + (long)order * hop > 0) /* back to the first node whose window reaches frame 0 */
        k--;
    r->next[level] = k + 1;
}

struct readout_modes *readout_modes_open(const struct readout_modes_ask *ask, launch_point *point, void *self)
{
    struct arena *a = arena_open();
    struct readout_modes *r = ARENA_TAKE(a, struct readout_modes, 1);
    *r = (struct readout_modes){.arena = a, .ask = *ask, .point = point, .self = self, .at = modes_point_make(a, ask->n + 1)};
    r->component = ARENA_TAKE(a, struct component, ask->n + 1);
    for (int i = 0; i < ask->n; i++) {
        r->component[i].level = level_of(ask->hop[i]);
        open_level(r, r->component[i].level);
    }
    r->size = ARENA_TAKE(a, double, ask->n + 1);
    r->turn = ARENA_TAKE(a, double, ask->n + 1);
    r->rise = ARENA_TAKE(a, double, ask->n + 1);
    r->most = (long)ceil(ask->seconds * ask->rate) + LANES;
    r->past = ARENA_TAKE(a, double, 2 * r->most);
    r->end = r->most;
    r->ask.hop = NULL;
    return r;
}

void readout_modes_close(struct readout_modes *r)
{
    arena_close(r->arena);
}

/* ------------------------------------------------------------------ the past */

static void remember(struct readout_modes *r, double f)
{
    if (r->end == 2 * r->most) {
        memcpy(r->past, r->past + r->most, (size_t)r->most * sizeof *r->past);
        r->end = r->most;
    }
    r->past[r->end++] = f;
    if (f != 0.0 || r->known > 0)
        r->known = r->known < r->most ? r->known + 1 : r->most;
}

struct lanes {
    double re[LANES], im[LANES];
};

/* Lane l: sum over the groups g of f[g LANES + l] q^(groups-1-g), q = turn. */
LANES_CLONES
static void stride(const double *restrict f, long groups, const double turn[2], struct lanes *restrict sum)
{
    double re[LANES] = {0}, im[LANES] = {0}, qr = turn[0], qi = turn[1];
    for (long g = 0; g < groups; g++)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double next = qr * re[l] - qi * im[l] + f[g * LANES + l];
            im[l] = qr * im[l] + qi * re[l];
            re[l] = next;
        }
    memcpy(sum->re, re, sizeof re);
    memcpy(sum->im, im, sizeof im);
}

/* Z of the frame before now. */
static void recall(const struct readout_modes *r, double decay, struct node *v)
{
    double nepers = r->ask.decibel * 0.11512925464970229, q[2] = {v->pole_re, v->pole_im};
    double want = decay > 0 ? ceil(nepers * r->ask.rate / decay) : (double)r->known;
    long groups = (want < (double)r->known ? (long)want + LANES - 1 : r->known + LANES - 1) / LANES;
    struct lanes sum;
    v->re = v->im = 0;
    groups = groups * LANES > r->most ? r->most / LANES : groups;
    for (int square = 1; square < LANES; square *= 2) {
        double re = q[0] * q[0] - q[1] * q[1];
        q[1] = 2 * q[0] * q[1];
        q[0] = re;
    }
    stride(r->past + r->end - groups * LANES, groups, q, &sum);
    for (int l = 0; l < LANES; l++) {
        double re = v->pole_re * v->re - v->pole_im * v->im + sum.re[l];
        v->im = v->pole_re * v->im + v->pole_im * v->re + sum.im[l];
        v->re = re;
    }
}

/* ------------------------------------------------------------------ nodes */

static void ask_at(struct readout_modes *r, double frame)
{
    size_t n = (size_t)r->ask.n;
    r->point(r->self, frame, &r->at);
    for (size_t i = 0; i < n; i++) {
        r->size[i] = -r->at.decay[i] / r->ask.rate;
        r->turn[i] = 2.0 * r->at.frequency[i] / r->ask.rate;
    }
    vecmath_exp(n, r->size, r->size);
    vecmath_sincospi(n, r->turn, r->rise, r->turn);
}

static void start(struct readout_modes *r, int i, long first)
{
    struct component *c = &r->component[i];
    struct node *v = &c->node[c->oldest];
    double *re = &r->at.re[i], *im = &r->at.im[i], per = 1.0 / r->ask.rate;
    struct modes_point own = {.frequency = &r->at.frequency[i], .decay = &r->at.decay[i], .re = re, .im = im};
    c->oldest = (c->oldest + 1) % r->ask.order;
    *v = (struct node){.pole_re = r->size[i] * r->turn[i], .pole_im = r->size[i] * r->rise[i], .gain_re = *re * per, .gain_im = *im * per, .first = first,
                       .used = true};
    v->through = modes_direct(r->ask.quantity, 1, own.frequency, own.decay, &own) - 0.5 * v->gain_im;
    if (*re != 0.0 || *im != 0.0)
        recall(r, r->at.decay[i], v);
}

/* Nodes whose windows start now; at frame 0 also those that would have before. Returns the frames until the next. */
static long begin(struct readout_modes *r)
{
    long left = 1L << 20;
    for (int level = 0; level < LEVELS; level++) {
        int hop = 1 << level;
        if (!r->window[level])
            continue;
        for (; cardinal_start(r->ask.order, hop, r->next[level]) <= r->now; r->next[level]++) {
            ask_at(r, (double)r->next[level] * hop);
            for (int i = 0; i < r->ask.n; i++)
                if (r->component[i].level == level)
                    start(r, i, cardinal_start(r->ask.order, hop, r->next[level]));
        }
        long until = cardinal_start(r->ask.order, hop, r->next[level]) - r->now;
        left = until < left ? until : left;
    }
    return left;
}

static void ring(const struct readout_modes *r, int level, struct node *v, const double *f, double *y, long n)
{
    const double *w = r->window[level] + (r->now - v->first);
    double re = v->re, im = v->im;
    for (long j = 0; j < n; j++) {
        double next = v->pole_re * re - v->pole_im * im + f[j];
        im = v->pole_re * im + v->pole_im * re;
        re = next;
        y[j] += w[j] * (v->gain_re * im + v->gain_im * re + v->through * f[j]);
    }
    v->re = re;
    v->im = im;
}

static void run_some(struct readout_modes *r, const double *f, double *y, long n)
{
    for (int i = 0; i < r->ask.n && r->known > 0; i++) {
        struct component *c = &r->component[i];
        for (int q = 0; q < r->ask.order; q++) {
            struct node *v = &c->node[(c->oldest + q) % r->ask.order];
            if (v->used && (v->gain_re != 0.0 || v->gain_im != 0.0))
                ring(r, c->level, v, f, y, n);
        }
    }
    r->now += n;
}

void readout_modes_run(struct readout_modes *r, const double *f, double *y, long frames)
{
    for (long done = 0; done < frames && r->ask.n > 0;) {
        long left = begin(r), n = left < frames - done ? left : frames - done;
        bool any = r->known > 0;
        for (long j = 0; j < n; j++)
            any = any || f[done + j] != 0.0;
        r->known = any && r->known == 0 ? 1 : r->known; /* from the first force on */
        run_some(r, f + done, y + done, n);
        for (long j = 0; j < n; j++)
            remember(r, f[done + j]);
        done += n;
    }
}
