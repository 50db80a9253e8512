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
#include <math.h>
#include <stdlib.h>

#include "num/real.h"
#include "response/object.h"
#include "response/object_kinds.h"

enum { PLACES = 256 };

struct ear {
    const struct object *o;
    struct arena *arena;
    double origin[2], listen[2];
    bool fixed;    /* heard at `listen` */
    double *heard; /* [n] phi(listen)/m, or 1/m */
    double *turn;  /* [n] -d/w_d */
};

static bool is_family(const struct object *o) { return o->shape == OBJECT_SHELL; }

/* gain[i] = phi(x) phi(l)/m at the object's (x, y); returns how far off it is. */
static double gains(const struct ear *r, double x, double y, double *gain)
{
    const struct object *o = r->o;
    double off = o->shapes(o, x, y, gain);
    if (is_family(o) && r->fixed) object_shell_from(o, r->listen, (const double[2]){x, y}, gain);
    for (int i = 0; i < o->n; i++)
        gain[i] = is_family(o) ? (r->fixed ? gain[i] : 1.0) * r->heard[i]
                  : r->fixed   ? gain[i] * r->heard[i]
                               : gain[i] * gain[i] * r->heard[i];
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
    r->heard = ARENA_TAKE(a, double, o->n);
    r->turn = ARENA_TAKE(a, double, o->n);
    if (listen) {
        r->listen[0] = listen[0];
        r->listen[1] = listen[1];
    }
    if (listen && !is_family(o)) o->shapes(o, listen[0], listen[1], r->heard);
    for (int i = 0; i < o->n; i++) {
        r->heard[i] = (listen && !is_family(o) ? r->heard[i] : 1.0) / o->mass[i];
        r->turn[i] = -o->decay[i] / (2.0 * REAL_PI * o->frequency[i]);
    }
}

/* ------------------------------------------------------------------ the strongest */

static void average_pairs(const struct object *o, double *energy)
{
    const struct object_mode *mode = object_inside(o)->list.mode;
    if (o->shape != OBJECT_DISK && o->shape != OBJECT_DRUM) return;
    for (int i = 0; i + 1 < o->n; i++)
        if (mode[i].a == mode[i + 1].a && mode[i].b == mode[i + 1].b)
            energy[i] = energy[i + 1] = 0.5 * (energy[i] + energy[i + 1]);
}

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
    average_pairs(o, energy);
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
    object_pick(r->o, chosen, n, a, picked);
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
    int *kept = ARENA_TAKE(r->arena, int, m->n), n = 0, all = m->n;
    for (int i = 0; i < all; i++)
        if (m->frequency[i] < top) kept[n++] = i;
    if (n > 0 && n < all) {
        object_pick(r->o, kept, n, r->arena, picked);
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
