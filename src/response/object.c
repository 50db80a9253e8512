/* From a given object to its modes: what it is made of (object_body.c), the shape's own list of modes (object_*.c),
   damping, and what is said about the theory's reach.

   A mode of undamped angular frequency w decays at d = material_decay (1/s) and rings at sqrt(w^2 - d^2)/(2 pi); where
   d >= w it does not ring and is left out. `top` and `most` are counted in undamped frequencies. */
#include "response/object.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "num/real.h"
#include "response/object_kinds.h"
#include "scene/material.h"

#define TOO_HIGH 0.05 /* excess of a frequency that is worth a note */

/* ------------------------------------------------------------------ for the shapes */

void object_keep_table(struct object *o, struct arena *a, const void *table)
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

static const struct object_kind *kind_of(int shape)
{
    static const struct object_kind *const kinds[] = {
        [OBJECT_BAR] = &object_bar,     [OBJECT_ROD] = &object_bar,     [OBJECT_STRING] = &object_string,
        [OBJECT_PLATE] = &object_plate, [OBJECT_DISK] = &object_disk,   [OBJECT_MEMBRANE] = &object_membrane,
        [OBJECT_DRUM] = &object_drum,   [OBJECT_SHELL] = &object_shell,
    };
    return kinds[shape];
}

static double decay_of(const struct object_body *b, double w) { return material_decay(b->alpha, b->beta, b->loss, w); }

/* Takes out those that do not ring; returns how many. */
static int drop_overdamped(const struct object_body *b, struct object_list *l)
{
    int kept = 0;
    for (int i = 0; i < l->n; i++)
        if (decay_of(b, l->mode[i].w) < l->mode[i].w) l->mode[kept++] = l->mode[i];
    int dropped = l->n - kept;
    l->n = kept;
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

void object_pick(const struct object *o, const int *chosen, int n, struct arena *a, struct object *picked)
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
    if (!sorted) object_pick(&old, order, old.n, a, o);
}

/* ------------------------------------------------------------------ what must be said */

static const char *joined(struct arena *a, const char *before, const char *more)
{
    return before ? arena_format(a, "%s\n%s", before, more) : more;
}

/* Of the modes below `heard`, Hz; 0: of all. */
static const char *reach(const struct object_inside *in, double heard, struct arena *a)
{
    const struct object_list *l = &in->list;
    int high = 0, first = -1, all = 0;
    double worst = 0.0;
    for (int i = 0; i < l->n; i++) {
        double w = l->mode[i].w, d = decay_of(in->body, w);
        if (heard > 0 && !(sqrt((w - d) * (w + d)) < 2 * REAL_PI * heard)) continue;
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
                        "(by about %.0f %% at most): it is not "
                        "thin enough for them",
                        in->body->key, in->kind->theory, high, all, 100.0 * TOO_HIGH,
                        l->mode[first].w / (2.0 * REAL_PI), 100.0 * worst);
}

static const char *notes(const struct object_inside *in, double heard, struct arena *a)
{
    const char *text = reach(in, heard, a), *key = in->body->key;
    int dropped = in->list.dropped;
    if (dropped > 0)
        text = joined(a, text,
                      arena_format(a, "%s: %d mode%s so damped that %s not ring, and %s left out", key, dropped,
                                   dropped > 1 ? "s are" : " is", dropped > 1 ? "they do" : "it does",
                                   dropped > 1 ? "are" : "is"));
    if (in->list.capped)
        text = joined(
            a, text,
            arena_format(a, "%s: of an object of these proportions and edges only the lowest %d modes are computed",
                         key, in->list.n));
    return text;
}

bool object_make(const struct object_given *given, const struct object_ask *ask, struct arena *a, struct object *o,
                 const char **note, struct err *e)
{
    const struct object_body *b = object_body_make(given, ask->key, a, e);
    if (!b) return false;
    struct object_inside *in = ARENA_TAKE(a, struct object_inside, 1);
    const struct object_limit limit = {2.0 * REAL_PI * ask->top, ask->most, 2.0 * REAL_PI * ask->low};
    *in = (struct object_inside){.kind = kind_of(given->shape), .body = b};
    if (!list_ringing(in, &limit, a, e)) return false;
    if (in->list.n == 0)
        return err_set(e, ERR_SCENE,
                       "%s: no %smode of this object %s%g Hz: widen the band (rasp modes object: --top), "
                       "or, if it is too %s",
                       b->key, in->list.dropped ? "ringing " : "",
                       ask->low > 0 ? arena_format(a, "from %g Hz to below ", ask->low) : "below ", ask->top,
                       in->list.dropped ? "damped, give a material of less damping"
                                        : "small or too stiff, give larger sizes or a softer material");
    *note = notes(in, ask->heard, a);
    *o = (struct object){.key = b->key};
    finish(o, in, a);
    sort_by_frequency(o, a);
    return true;
}
