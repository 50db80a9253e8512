/* Mode shapes that are sines (or cosines) along x, or products of sines along x and y: supported bars and plates,
   strings, membranes, longitudinal waves. Each sine of one order is computed once per place (num/vecmath.h) and used by
   all modes that have it. */
#include <math.h>

#include "num/real.h"
#include "num/vecmath.h"
#include "response/object_kinds.h"

enum {
    ORDERS = 512,
    CHUNK = 64
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
    for (int i = 0; i < n; i += CHUNK) {
        double t[CHUNK], s[CHUNK], c[CHUNK];
        int m = n - i < CHUNK ? n - i : CHUNK;
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

static double shapes(const struct object *o, double x, double y, double *phi)
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
    o->shapes = shapes;
    object_keep_table(o, a, q);
}

void object_sine_list(const struct object_body *b, const struct object_sine_law *law, const struct object_limit *limit,
                      struct arena *a, struct object_list *l)
{
    const struct object_given *g = b->given;
    for (int m = 1; m <= limit->most; m++) /* below (m, n) there are the m n - 1 others of no higher orders */
        for (int n = 1; n <= limit->most / m; n++) {
            double w = law->w(law->self, m * REAL_PI / g->length, n * REAL_PI / g->width);
            if (w >= limit->w) break;
            object_list_add(
                l, a,
                (struct object_mode){
                    .w = w, .mass = law->mass, .excess = law->excess(law->self, w), .a = 2 * m, .b = 2 * n});
        }
    object_list_cut(l, limit);
}
