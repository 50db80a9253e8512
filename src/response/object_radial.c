/* Round flat objects (disk, drum): modes R_ns(r) cos n theta and, for n >= 1, R_ns(r) sin n theta of the same
   frequency.

   The lambda of order n are the zeros of a function of the object (no two of one order are closer than about pi, none
   below 0.9 n): bracketed in steps of a quarter and closed in on by false position (Illinois: Dowell and Jarratt, BIT
   11, 1971, 168).

   R is even or odd in r as n is, and band-limited by lambda: it is kept as a Chebyshev sum of its parity of degree
   lambda + 20 + 2 sqrt(lambda) (to rounding, tests/unit/test_object_round.c), so that a place costs no Bessel function.
   cos n theta = Re (x + j y)^n/r^n. */
#include <math.h>

#include "num/real.h"
#include "response/object_kinds.h"

enum { CHUNK = 64, DEGREES = 2048 };

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

static void add_pair(const struct object_radial *q, int n, int s, double lambda, struct arena *a, struct object_list *l)
{
    struct object_mode m = q->mode(q, n, lambda);
    m.a = n;
    m.b = s;
    m.own = lambda;
    if (n > 0) m.mass *= 0.5; /* the mean of cos^2 */
    object_list_add(l, a, m);
    m.c = 1;
    if (n > 0) object_list_add(l, a, m);
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
                if (lambda < top) add_pair(q, n, s++, lambda, a, l);
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
    struct object_radial *kept = ARENA_TAKE(a, struct object_radial, 1);
    *kept = *q;
    l->work = kept;
}

/* ------------------------------------------------------------------ shapes */

struct block { /* up to CHUNK radial functions of one parity */
    int n, parity, terms;
    double *c;                      /* [terms][CHUNK] of T_parity, T_parity+2, ... */
    int order[CHUNK], to[CHUNK][2]; /* n; place in phi of cos and sin, -1: none */
};

struct table {
    int blocks, terms, highest; /* terms: the most of any block; highest order n */
    struct block *block;
};

static void block_sum(const struct block *k, double *const chebyshev[2], const double *cosine, const double *sine,
                      double *phi)
{
    double r[CHUNK];
    object_sum(k->terms, CHUNK, k->c, chebyshev[k->parity], r);
    for (int i = 0; i < k->n; i++) {
        if (k->to[i][0] >= 0) phi[k->to[i][0]] = r[i] * cosine[k->order[i]];
        if (k->to[i][1] >= 0) phi[k->to[i][1]] = r[i] * sine[k->order[i]];
    }
}

static double shapes(const struct object *o, double x, double y, double *phi)
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
            k->c[t * CHUNK + k->n] += share * value * real_cospi(degree * (j + 0.5) / points);
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
        if (k->parity == m->a % 2 && k->n < CHUNK) room = k;
    }
    *at = -1;
    return room;
}

static struct block *block_new(struct table *t, int parity, struct arena *a)
{
    struct block *k = &t->block[t->blocks++];
    *k = (struct block){.parity = parity, .terms = t->terms, .c = ARENA_TAKE(a, double, t->terms *CHUNK)};
    return k;
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
    t->block = ARENA_TAKE(a, struct block, o->n / CHUNK + 2);
    for (int i = 0; i < o->n; i++) {
        const struct object_mode *m = &in->list.mode[i];
        int at;
        struct block *k = block_for(t, in->list.mode, m, &at);
        if (!k) k = block_new(t, m->a % 2, a);
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
    o->shapes = shapes;
    object_keep_table(o, a, t);
}
