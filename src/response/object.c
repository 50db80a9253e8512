/* From a given object to its modes: what it is made of (object_kinds.c), the shape's own list of modes (object_*.c),
   damping, and what is reported of the theory's reach.

   A mode of undamped angular frequency w decays at d = material_decay (1/s) and rings at sqrt(w^2 - d^2)/(2 pi); where
   d >= w it does not ring and is left out. `top` and `most` are counted in undamped frequencies. */
#include "response/object.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "num/lanes.h"
#include "num/real.h"
#include "num/vecmath.h"
#include "response/object_kinds.h"
#include "scene/material.h"

/* Sums of functions with the same weights for many modes at once: the inner loop of mode shapes that are sums. */

LANES_CLONES
void object_sum(int n, int modes, const double *rows, const double *weight, double *sum)
{
    for (int first = 0; first < modes; first += OBJECT_SUM) {
        double part[OBJECT_SUM];
        const double *row = rows + first;
#pragma omp simd
        for (int i = 0; i < OBJECT_SUM; i++)
            part[i] = row[i] * weight[0];
        for (int t = 1; t < n; t++) {
            row += modes;
#pragma omp simd
            for (int i = 0; i < OBJECT_SUM; i++)
                part[i] = fma(row[i], weight[t], part[i]);
        }
        memcpy(sum + first, part, sizeof part);
    }
}

/* Mode shapes that are sines (or cosines) along x, or products of sines along x and y: supported bars and plates,
   strings, membranes, longitudinal waves. Each sine of one order is computed once per place (num/vecmath.h) and used by
   all modes that have it. */

enum {
    ORDERS = 512,
    SINE_CHUNK = 64
}; /* more orders along one axis than this (long and narrow, very many modes): each mode for itself */

struct sine {
    bool cosine;
    int nx, ny; /* orders that occur; ny = 0: no second factor; nx = 0: more than ORDERS */
    double *order_x, *order_y;
    int *ix, *iy; /* [n] which of them */
};

static void products(const struct sine *q, int n, const double u[2], double *phi)
{
    double t[ORDERS], s[ORDERS], c[ORDERS], along[ORDERS];
    for (int i = 0; i < q->nx; i++)
        t[i] = q->order_x[i] * u[0];
    vecmath_sincospi((size_t)q->nx, t, along, c);
    const double *first = q->cosine ? c : along;
    for (int i = 0; i < n; i++)
        phi[i] = first[q->ix[i]];
    if (q->ny == 0) return;
    for (int i = 0; i < q->ny; i++)
        t[i] = q->order_y[i] * u[1];
    vecmath_sincospi((size_t)q->ny, t, s, c);
    for (int i = 0; i < n; i++)
        phi[i] *= s[q->iy[i]];
}

static void one_by_one(const struct object_mode *mode, int n, const double u[2], double *phi)
{
    for (int i = 0; i < n; i += SINE_CHUNK) {
        double t[SINE_CHUNK], s[SINE_CHUNK], c[SINE_CHUNK];
        int m = n - i < SINE_CHUNK ? n - i : SINE_CHUNK;
        for (int k = 0; k < m; k++)
            t[k] = mode[i + k].a * u[0];
        vecmath_sincospi((size_t)m, t, s, c);
        for (int k = 0; k < m; k++) {
            phi[i + k] = mode[i + k].c ? c[k] : s[k];
            t[k] = mode[i + k].b * u[1];
        }
        vecmath_sincospi((size_t)m, t, s, c);
        for (int k = 0; k < m; k++)
            if (mode[i + k].b) phi[i + k] *= s[k];
    }
}

static double sine_shapes(const struct object *o, double x, double y, double *phi)
{
    const struct object_inside *in = object_inside(o);
    const struct sine *q = (const struct sine *)in->table;
    double off = object_nearest(o, &x, &y);
    double u[2] = {0.5 * ((x - o->low[0]) / (o->high[0] - o->low[0])),
                   0.5 * ((y - o->low[1]) / (o->high[1] - o->low[1]))};
    if (q->nx > 0)
        products(q, o->n, u, phi);
    else
        one_by_one(in->list.mode, o->n, u, phi);
    return off;
}

/* Where order is in orders[0..*n), added if it is not; ORDERS: no room. */
static int place_of(int order, double *orders, int *n)
{
    for (int i = 0; i < *n; i++)
        if ((int)orders[i] == order) return i;
    if (*n < ORDERS)
        orders[(*n)++] = order;
    else
        return ORDERS;
    return *n - 1;
}

void object_sine_bind(struct arena *a, struct object *o)
{
    const struct object_mode *mode = object_inside(o)->list.mode;
    struct sine *q = ARENA_TAKE(a, struct sine, 1);
    q->order_x = ARENA_TAKE(a, double, ORDERS);
    q->order_y = ARENA_TAKE(a, double, ORDERS);
    q->ix = ARENA_TAKE(a, int, o->n);
    q->iy = ARENA_TAKE(a, int, o->n);
    q->cosine = o->n > 0 && mode[0].c;
    for (int i = 0; i < o->n; i++) {
        q->ix[i] = place_of(mode[i].a, q->order_x, &q->nx);
        q->iy[i] = mode[i].b ? place_of(mode[i].b, q->order_y, &q->ny) : 0;
        if (q->ix[i] == ORDERS || q->iy[i] == ORDERS) {
            q->nx = 0;
            break;
        }
    }
    o->shapes = sine_shapes;
    object_set_table(o, a, q);
}

void object_sine_list(const struct object_body *b, const struct object_sine_law *law, const struct object_limit *limit,
                      struct arena *a, struct object_list *l)
{
    const struct object_given *g = b->given;
    for (int m = 1; m <= limit->most; m++) /* below (m, n) there are the m n - 1 others of no higher orders */
        for (int n = 1; n <= limit->most / m; n++) {
            double w = law->w(law->self, m * REAL_PI / g->length, n * REAL_PI / g->width);
            if (w >= limit->w) break;
            object_list_add(l, a,
                            (struct object_mode){.w = w,
                                                 .mass = law->mass,
                                                 .excess = law->excess ? law->excess(law->self, w) : 0.0,
                                                 .a = 2 * m,
                                                 .b = 2 * n});
        }
    object_list_cut(l, limit);
}

/* Round flat objects (disk, drum): modes R_ns(r) cos n theta and, for n >= 1, R_ns(r) sin n theta of the same
   frequency.

   The lambda of order n are the zeros of a function of the object (no two of one order are closer than about pi, none
   below 0.9 n): bracketed in steps of a quarter and closed in on by false position (Illinois: Dowell and Jarratt, BIT
   11, 1971, 168).

   R is even or odd in r as n is, and band-limited by lambda: it is kept as a Chebyshev sum of its parity of degree
   lambda + 20 + 2 sqrt(lambda) (to rounding, tests/unit/test_object_round.c), so that a place costs no Bessel function.
   cos n theta = Re (x + j y)^n/r^n. */

enum { RADIAL_CHUNK = 64, DEGREES = 2048 };

/* ------------------------------------------------------------------ frequencies */

static double close_in(const struct object_radial *q, int n, double low, double high)
{
    double f_low = q->zero(q, n, low), f_high = q->zero(q, n, high), middle = low;
    for (int pass = 0; pass < 100 && high - low > 4e-16 * high; pass++) {
        double last = middle;
        middle = (low * f_high - high * f_low) / (f_high - f_low);
        double f = q->zero(q, n, middle);
        if (f == 0.0 || middle == last) break;
        if ((f < 0.0) == (f_high < 0.0)) {
            high = middle;
            f_high = f;
            f_low *= 0.5;
        } else {
            low = middle;
            f_low = f;
            f_high *= 0.5;
        }
    }
    return middle;
}

static void all_below(const struct object_radial *q, double top, struct arena *a, struct object_list *l)
{
    const double step = 0.25;
    for (int n = 0; 0.9 * n < top; n++) {
        double low = fmax(0.9 * n, 0.1), f_low = q->zero(q, n, low);
        for (int s = 0; low < top; low += step) {
            double f_high = q->zero(q, n, low + step);
            if ((f_low < 0.0) != (f_high < 0.0)) {
                double lambda = close_in(q, n, low, low + step);
                if (lambda < top) {
                    struct object_mode m = q->mode(q, n, lambda);
                    m.a = n;
                    m.b = s++;
                    m.own = lambda;
                    if (n > 0) m.mass *= 0.5; /* the mean of cos^2 */
                    object_list_add(l, a, m);
                    m.c = 1;
                    if (n > 0) object_list_add(l, a, m);
                }
            }
            f_low = f_high;
        }
    }
}

/* About lambda^2/4 modes lie below lambda (Weyl). */
void object_radial_list(const struct object_radial *q, const struct object_limit *limit, double lambda_top,
                        struct arena *a, struct object_list *l)
{
    const double highest = DEGREES - 200.0; /* a million modes */
    lambda_top = fmin(lambda_top, highest);
    for (double top = fmin(2.0 * sqrt((double)limit->most) + 4.0, lambda_top);; top = fmin(1.3 * top, lambda_top)) {
        l->n = 0;
        all_below(q, top, a, l);
        if (l->n >= limit->most || top >= lambda_top) break;
    }
    l->capped = l->n < limit->most && lambda_top >= highest;
    object_list_cut(l, limit);
    struct object_radial *rest = ARENA_TAKE(a, struct object_radial, 1);
    *rest = *q;
    l->work = rest;
}

/* ------------------------------------------------------------------ shapes */

struct block { /* up to CHUNK radial functions of one parity */
    int n, parity, terms;
    double *c;                                    /* [terms][CHUNK] of T_parity, T_parity+2, ... */
    int order[RADIAL_CHUNK], to[RADIAL_CHUNK][2]; /* n; place in phi of cos and sin, -1: none */
};

struct table {
    int blocks, terms, highest; /* terms: the most of any block; highest order n */
    struct block *block;
};

static void block_sum(const struct block *k, double *const chebyshev[2], const double *cosine, const double *sine,
                      double *phi)
{
    double r[RADIAL_CHUNK];
    object_sum(k->terms, RADIAL_CHUNK, k->c, chebyshev[k->parity], r);
    for (int i = 0; i < k->n; i++) {
        if (k->to[i][0] >= 0) phi[k->to[i][0]] = r[i] * cosine[k->order[i]];
        if (k->to[i][1] >= 0) phi[k->to[i][1]] = r[i] * sine[k->order[i]];
    }
}

static double radial_shapes(const struct object *o, double x, double y, double *phi)
{
    const struct table *t = (const struct table *)object_inside(o)->table;
    double even[DEGREES / 2], odd[DEGREES / 2], *const chebyshev[2] = {even, odd}, cosine[DEGREES], sine[DEGREES];
    double from = sqrt(x * x + y * y), c = from > 0.0 ? x / from : 1.0, s = from > 0.0 ? y / from : 0.0;
    double r = fmin(from / o->high[0], 1.0);
    even[0] = 1.0;
    odd[0] = r;
    for (int k = 1; k < t->terms; k++) {
        even[k] = 2.0 * r * odd[k - 1] - even[k - 1];
        odd[k] = 2.0 * r * even[k] - odd[k - 1];
    }
    cosine[0] = 1.0;
    sine[0] = 0.0;
    for (int n = 1; n <= t->highest; n++) {
        cosine[n] = cosine[n - 1] * c - sine[n - 1] * s;
        sine[n] = sine[n - 1] * c + cosine[n - 1] * s;
    }
    for (int i = 0; i < t->blocks; i++)
        block_sum(&t->block[i], chebyshev, cosine, sine, phi);
    return fmax(from - o->high[0], 0.0);
}

/* Coefficients of the terms of that parity, from values at Chebyshev's zeros (of which only the positive half is
 * needed). */
static void expand(const struct object_radial *q, int n, double lambda, struct block *k)
{
    int points = 2 * k->terms;
    for (int j = 0; j < k->terms; j++) {
        double value = q->value(q, n, lambda, real_cospi((j + 0.5) / points));
        for (int t = 0; t < k->terms; t++) {
            int degree = k->parity + 2 * t;
            double share = (degree == 0 ? 2.0 : 4.0) / points;
            k->c[t * RADIAL_CHUNK + k->n] += share * value * real_cospi(degree * (j + 0.5) / points);
        }
    }
}

/* The block that has the radial function already (*at says where), or has room for it, or NULL. */
static struct block *block_for(struct table *t, const struct object_mode *mode, const struct object_mode *m, int *at)
{
    struct block *room = NULL;
    for (int b = 0; b < t->blocks; b++) {
        struct block *k = &t->block[b];
        for (int i = 0; i < k->n; i++) {
            int known = k->to[i][0] >= 0 ? k->to[i][0] : k->to[i][1];
            if (mode[known].a == m->a && mode[known].b == m->b) {
                *at = i;
                return k;
            }
        }
        if (k->parity == m->a % 2 && k->n < RADIAL_CHUNK) room = k;
    }
    *at = -1;
    return room;
}

void object_radial_bind(struct arena *a, struct object *o)
{
    const struct object_inside *in = object_inside(o);
    const struct object_radial *q = (const struct object_radial *)in->list.work;
    struct table *t = ARENA_TAKE(a, struct table, 1);
    double lambda = 0.0;
    for (int i = 0; i < o->n; i++) {
        lambda = fmax(lambda, in->list.mode[i].own);
        t->highest = in->list.mode[i].a > t->highest ? in->list.mode[i].a : t->highest;
    }
    t->terms = (int)(lambda + 20.0 + 2.0 * sqrt(lambda)) / 2 + 1;
    t->block = ARENA_TAKE(a, struct block, o->n / RADIAL_CHUNK + 2);
    for (int i = 0; i < o->n; i++) {
        const struct object_mode *m = &in->list.mode[i];
        int at;
        struct block *k = block_for(t, in->list.mode, m, &at);
        if (!k) {
            k = &t->block[t->blocks++];
            *k = (struct block){
                .parity = m->a % 2, .terms = t->terms, .c = ARENA_TAKE(a, double, t->terms *RADIAL_CHUNK)};
        }
        if (at < 0) {
            expand(q, m->a, m->own, k);
            at = k->n++;
            k->order[at] = m->a;
            k->to[at][0] = k->to[at][1] = -1;
        }
        k->to[at][m->c] = i;
    }
    double radius = q->radius;
    o->low[0] = o->low[1] = -radius;
    o->high[0] = o->high[1] = radius;
    o->radius = radius / sqrt(2.0);
    o->flat = true;
    o->shapes = radial_shapes;
    o->terms = (double)t->blocks * t->terms * RADIAL_CHUNK;
    object_set_table(o, a, t);
}

#define TOO_HIGH 0.05 /* excess of a frequency that is worth a note */

/* ------------------------------------------------------------------ for the shapes */

void object_set_table(struct object *o, struct arena *a, const void *table)
{
    struct object_inside *in = ARENA_TAKE(a, struct object_inside, 1);
    *in = *object_inside(o);
    in->table = table;
    o->self = in;
}

double object_nearest(const struct object *o, double *x, double *y)
{
    double nx = fmin(fmax(*x, o->low[0]), o->high[0]), ny = fmin(fmax(*y, o->low[1]), o->high[1]);
    double dx = *x - nx, dy = *y - ny;
    *x = nx;
    *y = ny;
    return sqrt(dx * dx + dy * dy);
}

/* The room doubles at powers of two. */
void object_list_add(struct object_list *l, struct arena *a, struct object_mode m)
{
    if ((l->n & (l->n - 1)) == 0) {
        struct object_mode *more = ARENA_TAKE(a, struct object_mode, l->n ? 2 * l->n : 1);
        if (l->n) memcpy(more, l->mode, (size_t)l->n * sizeof *more);
        l->mode = more;
    }
    l->mode[l->n++] = m;
}

static int by_w(const void *p, const void *q)
{
    const struct object_mode *x = (const struct object_mode *)p, *y = (const struct object_mode *)q;
    if (x->w != y->w) return x->w < y->w ? -1 : 1;
    if (x->a != y->a) return x->a < y->a ? -1 : 1;
    if (x->b != y->b) return x->b < y->b ? -1 : 1;
    return (x->c > y->c) - (x->c < y->c);
}

void object_list_cut(struct object_list *l, const struct object_limit *limit)
{
    if (l->n > 0) qsort(l->mode, (size_t)l->n, sizeof *l->mode, by_w);
    if (l->n > limit->most) l->n = limit->most;
}

/* ------------------------------------------------------------------ its modes */

static double decay_of(const struct object_body *b, double w) { return material_decay(b->alpha, b->beta, b->loss, w); }

/* Takes out those that do not ring; returns how many. */
static int drop_overdamped(const struct object_body *b, struct object_list *l)
{
    int rest = 0;
    for (int i = 0; i < l->n; i++)
        if (decay_of(b, l->mode[i].w) < l->mode[i].w) l->mode[rest++] = l->mode[i];
    int dropped = l->n - rest;
    l->n = rest;
    return dropped;
}

/* d/w = alpha/(2 w) + loss/2 + beta w/2 is past its minimum at the highest mode, which does not ring: no higher one
 * does. */
static bool beyond_ringing(const struct object_body *b, const struct object_list *l)
{
    double w = l->n > 0 ? l->mode[l->n - 1].w : 0.0;
    return b->beta * w * w >= b->alpha && decay_of(b, w) >= w;
}

/* Takes out those below the band; returns how many. */
static int drop_below(double low, struct object_list *l)
{
    int below = 0;
    while (below < l->n && l->mode[below].w < low)
        below++;
    l->n -= below;
    memmove(l->mode, l->mode + below, (size_t)l->n * sizeof *l->mode);
    return below;
}

/* The shape's list, with so many more asked for as do not ring or lie below the band. */
static bool list_ringing(struct object_inside *in, const struct object_limit *limit, struct arena *a, struct err *e)
{
    struct object_limit wide = *limit;
    for (;;) {
        struct object_list l = {0};
        if (!in->kind->list(in->body, &wide, a, &l, e)) return false;
        bool all = l.n < wide.most || l.capped || beyond_ringing(in->body, &l);
        int below = l.n > 0 ? drop_below(limit->low, &l) : 0;
        l.dropped = drop_overdamped(in->body, &l);
        in->list = l;
        if (all || l.n >= limit->most) break;
        int more = l.dropped + below;
        wide.most = 2 * more < wide.most ? limit->most + more : 4 * wide.most;
    }
    if (in->list.n > limit->most) in->list.n = limit->most;
    return true;
}

static void finish(struct object *o, const struct object_inside *in, struct arena *a)
{
    o->n = in->list.n;
    o->shape = in->body->given->shape;
    o->self = in;
    o->frequency = ARENA_TAKE(a, double, o->n);
    o->decay = ARENA_TAKE(a, double, o->n);
    o->mass = ARENA_TAKE(a, double, o->n);
    for (int i = 0; i < o->n; i++) {
        double w = in->list.mode[i].w, d = decay_of(in->body, w);
        o->frequency[i] = sqrt((w - d) * (w + d)) / (2.0 * REAL_PI);
        o->decay[i] = d;
        o->mass[i] = in->list.mode[i].mass;
    }
    in->kind->bind(a, o);
}

/* The same object with modes chosen[0..n) of o in that order. */
static void pick(const struct object *o, const int *chosen, int n, struct arena *a, struct object *picked)
{
    struct object_inside *in = ARENA_TAKE(a, struct object_inside, 1);
    *in = *object_inside(o);
    in->list.n = n;
    in->list.mode = ARENA_TAKE(a, struct object_mode, n);
    for (int i = 0; i < n; i++)
        in->list.mode[i] = object_inside(o)->list.mode[chosen[i]];
    *picked = (struct object){.key = o->key};
    finish(picked, in, a);
}

/* Strong damping may put damped frequencies into another order. */
static void sort_by_frequency(struct object *o, struct arena *a)
{
    bool sorted = true;
    int *order = ARENA_TAKE(a, int, o->n);
    for (int i = 0; i < o->n; i++) {
        int k = i;
        for (; k > 0 && o->frequency[order[k - 1]] > o->frequency[i]; k--)
            order[k] = order[k - 1];
        sorted = sorted && k == i;
        order[k] = i;
    }
    struct object old = *o;
    if (!sorted) pick(&old, order, old.n, a, o);
}

/* ------------------------------------------------------------------ what must be said */

/* Of the modes below `audible`, Hz; 0: of all. */
static const char *reach(const struct object_inside *in, double audible, struct arena *a)
{
    const struct object_list *l = &in->list;
    int high = 0, first = -1, all = 0;
    double worst = 0.0;
    for (int i = 0; i < l->n; i++) {
        double w = l->mode[i].w, d = decay_of(in->body, w);
        if (audible > 0 && !(sqrt((w - d) * (w + d)) < 2 * REAL_PI * audible)) continue;
        all++;
        if (l->mode[i].excess > TOO_HIGH) {
            first = first < 0 ? i : first;
            worst = fmax(worst, l->mode[i].excess);
            high++;
        }
    }
    if (high == 0) return NULL;
    return arena_format(a,
                        "%s: %s puts the frequencies of %d of its %d modes more than %g %% too high, from %.0f Hz on "
                        "(by about %.0f %% at most): it is not thin enough for them",
                        in->body->key, in->kind->theory, high, all, 100.0 * TOO_HIGH,
                        l->mode[first].w / (2.0 * REAL_PI), 100.0 * worst);
}

static const char *notes(const struct object_inside *in, double audible, struct arena *a)
{
    const char *text = reach(in, audible, a), *key = in->body->key;
    int dropped = in->list.dropped;
    if (dropped > 0)
        text = arena_line(a, text,
                          arena_format(a, "%s: %d mode%s so damped that %s not ring, and %s left out", key, dropped,
                                       dropped > 1 ? "s are" : " is", dropped > 1 ? "they do" : "it does",
                                       dropped > 1 ? "are" : "is"));
    if (in->list.capped)
        text = arena_line(
            a, text,
            arena_format(a, "%s: of an object of these proportions and edges only the lowest %d modes are computed",
                         key, in->list.n));
    return text;
}

bool object_make(const struct object_given *given, const struct object_ask *ask, struct arena *a, struct object *o,
                 const char **note, struct err *e)
{
    const struct object_body *b = object_kinds_body(given, ask->key, a, e);
    if (!b) return false;
    struct object_inside *in = ARENA_TAKE(a, struct object_inside, 1);
    static const struct object_kind *const kinds[] = {
        [OBJECT_BAR] = &object_kinds_bar,       [OBJECT_ROD] = &object_kinds_bar,
        [OBJECT_STRING] = &object_kinds_string, [OBJECT_PLATE] = &object_plate,
        [OBJECT_DISK] = &object_kinds_disk,     [OBJECT_MEMBRANE] = &object_kinds_membrane,
        [OBJECT_DRUM] = &object_kinds_drum,     [OBJECT_SHELL] = &object_kinds_shell,
    };
    const struct object_limit limit = {2.0 * REAL_PI * ask->top, ask->most, 2.0 * REAL_PI * ask->low};
    *in = (struct object_inside){.kind = kinds[given->shape], .body = b};
    if (!list_ringing(in, &limit, a, e)) return false;
    if (in->list.n == 0)
        return err_set(
            e, ERR_SCENE,
            "%s: no %smode of this object %s%g Hz: widen the band (rasp modes object: --top), or, if it is too %s",
            b->key, in->list.dropped ? "ringing " : "",
            ask->low > 0 ? arena_format(a, "from %g Hz to below ", ask->low) : "below ", ask->top,
            in->list.dropped ? "damped, give a material of less damping"
                             : "small or too stiff, give larger sizes or a softer material");
    *note = notes(in, ask->audible, a);
    *o = (struct object){.key = b->key};
    finish(o, in, a);
    sort_by_frequency(o, a);
    return true;
}

/* The modes of an object as modes of velocity. A unit impulse (1 N s) at x makes a mode of shape phi and mass m move,
   heard at l, by

       q(t) = phi(x) phi(l)/(m w_d) e^(-d t) sin(w_d t),   so that  dq/dt = Im(A e^(s t)),   A = phi(x) phi(l)/m (j -
                                                           d/w_d),   s = -d + j w_d.

   Heard where it is touched: l = x, the driving-point response. Of a spherical shell, whose modes come in families of 2
   l + 1, phi(x) phi(l) stands for P_l(cos of the angle between x and l), which is 1 at the place that is touched,
   wherever that is.

   Strength: energy of a mode's velocity, (phi phi_l/m)^2/(4 d), averaged over PLACES places of the object, spread by R2
   = n (1/g, 1/g^2), g^3 = g + 1 (M. Roberts' sequence); the two members of a pair of a round object count alike, so
   that none is chosen before the other by chance. */

enum { PLACES = 256 };

struct ear {
    const struct object *o;
    struct arena *arena;
    double origin[2], listen[2];
    bool fixed;    /* heard at `listen` */
    double *scale; /* [n] phi(listen)/m, or 1/m */
    double *turn;  /* [n] -d/w_d */
};

static bool is_family(const struct object *o) { return o->shape == OBJECT_SHELL; }

/* gain[i] = phi(x) phi(l)/m at the object's (x, y); returns how far off it is. */
static double gains(const struct ear *r, double x, double y, double *gain)
{
    const struct object *o = r->o;
    double off = o->shapes(o, x, y, gain);
    if (is_family(o) && r->fixed) object_kinds_shell_from(o, r->listen, (const double[2]){x, y}, gain);
    for (int i = 0; i < o->n; i++)
        gain[i] = is_family(o) ? (r->fixed ? gain[i] : 1.0) * r->scale[i]
                  : r->fixed   ? gain[i] * r->scale[i]
                               : gain[i] * gain[i] * r->scale[i];
    return off;
}

static double at(const struct modes *m, const struct modes_where *where, const struct modes_point *p)
{
    const struct ear *r = (const struct ear *)m->self;
    double off = gains(r, where->x - r->origin[0], where->y - r->origin[1], p->im);
    for (int i = 0; i < m->n; i++)
        p->re[i] = r->turn[i] * p->im[i];
    return off;
}

static void ear_make(struct ear *r, const struct object *o, const double origin[2], const double *listen,
                     struct arena *a)
{
    *r = (struct ear){.o = o, .arena = a, .origin = {origin[0], origin[1]}, .fixed = listen != NULL};
    r->scale = ARENA_TAKE(a, double, o->n);
    r->turn = ARENA_TAKE(a, double, o->n);
    if (listen) {
        r->listen[0] = listen[0];
        r->listen[1] = listen[1];
    }
    if (listen && !is_family(o)) o->shapes(o, listen[0], listen[1], r->scale);
    for (int i = 0; i < o->n; i++) {
        r->scale[i] = (listen && !is_family(o) ? r->scale[i] : 1.0) / o->mass[i];
        r->turn[i] = -o->decay[i] / (2.0 * REAL_PI * o->frequency[i]);
    }
}

/* ------------------------------------------------------------------ the strongest */

static double *energies(const struct ear *r, struct arena *a)
{
    const struct object *o = r->o;
    double *energy = ARENA_TAKE(a, double, o->n), *gain = ARENA_TAKE(a, double, o->n);
    const double g = 1.32471795724474602596;
    for (int k = 1; k <= PLACES; k++) {
        double u = k / g - floor(k / g), v = k / (g * g) - floor(k / (g * g));
        double off = gains(r, o->low[0] + u * (o->high[0] - o->low[0]), o->low[1] + v * (o->high[1] - o->low[1]), gain);
        for (int i = 0; i < o->n && off == 0.0; i++)
            energy[i] += gain[i] * gain[i];
    }
    for (int i = 0; i < o->n; i++)
        energy[i] /= 4.0 * o->decay[i];
    const struct object_mode *mode = object_inside(o)->list.mode;
    for (int i = 0; i + 1 < o->n && (o->shape == OBJECT_DISK || o->shape == OBJECT_DRUM); i++)
        if (mode[i].a == mode[i + 1].a && mode[i].b == mode[i + 1].b)
            energy[i] = energy[i + 1] = 0.5 * (energy[i] + energy[i + 1]);
    return energy;
}

struct rank {
    double energy;
    int mode;
};

static int by_energy(const void *p, const void *q)
{
    const struct rank *x = (const struct rank *)p, *y = (const struct rank *)q;
    if (x->energy != y->energy) return x->energy > y->energy ? -1 : 1;
    return (x->mode > y->mode) - (x->mode < y->mode);
}

static const struct object *strongest_of(const struct ear *r, int strongest, struct arena *a)
{
    int all = r->o->n, n = strongest < all ? strongest : all;
    struct object *picked = ARENA_TAKE(a, struct object, 1);
    struct rank *rank = ARENA_TAKE(a, struct rank, all);
    int *chosen = ARENA_TAKE(a, int, n);
    const double *energy = energies(r, a);
    for (int i = 0; i < all; i++)
        rank[i] = (struct rank){energy[i], i};
    qsort(rank, (size_t)all, sizeof *rank, by_energy);
    for (int i = 0; i < n; i++)
        chosen[i] = rank[i].mode;
    pick(r->o, chosen, n, a, picked);
    return picked;
}

/* ------------------------------------------------------------------ all */

static int drop(struct modes *m, double top);

static void fill(struct ear *r, const struct object *picked, struct modes *m)
{
    const double origin[2] = {r->origin[0], r->origin[1]}, listen[2] = {r->listen[0], r->listen[1]};
    bool fixed = r->fixed;
    ear_make(r, picked, origin, fixed ? listen : NULL, r->arena);
    *m = (struct modes){.n = picked->n,
                        .quantity = MODES_VELOCITY,
                        .shared = true,
                        .moves = fixed || !is_family(picked),
                        .frequency = picked->frequency,
                        .decay = picked->decay,
                        .slowest = picked->decay,
                        .radius = picked->radius,
                        .object = picked,
                        .name = picked->key,
                        .drop = drop,
                        .at = at,
                        .self = r};
}

static int drop(struct modes *m, double top)
{
    struct ear *r = (struct ear *)m->self;
    struct object *picked = ARENA_TAKE(r->arena, struct object, 1);
    int *rest = ARENA_TAKE(r->arena, int, m->n), n = 0, all = m->n;
    for (int i = 0; i < all; i++)
        if (m->frequency[i] < top) rest[n++] = i;
    if (n > 0 && n < all) {
        pick(r->o, rest, n, r->arena, picked);
        fill(r, picked, m);
    }
    m->n = n;
    return all - n;
}

void object_modes(const struct object *o, const double origin[2], const double *listen, int strongest, struct arena *a,
                  struct modes *m)
{
    struct ear *r = ARENA_TAKE(a, struct ear, 1);
    ear_make(r, o, origin, listen, a);
    fill(r, strongest_of(r, strongest, a), m);
}

const double *object_modes_origin(const struct modes *m) { return ((const struct ear *)m->self)->origin; }
