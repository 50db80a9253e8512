/* struct modes from a mode table: the line its places lie on, its strongest modes, complex gains.

   Strength of a mode: its energy per (N s)^2 summed over the places, integral of (gain e^(-decay t) sin(...))^2 dt ~ gain^2/(4 decay).
   Complex gain: A = gain e^(j phase), so that h(t) = Im(A e^(s t)). */
#include <math.h>
#include <stdlib.h>

#include "num/real.h"
#include "response/mode_table.h"
#include "response/modes.h"

/* ------------------------------------------------------------------ the line of places */

struct rank {
    double key;
    size_t index;
};

static int rank_up(const void *a, const void *b)
{
    const struct rank *p = a, *q = b;
    if (p->key != q->key)
        return p->key < q->key ? -1 : 1;
    return (p->index > q->index) - (p->index < q->index);
}

static const double *place_at(const struct mode_table *t, size_t place)
{
    return mode_table_values(t, place, 0) + MODE_TABLE_X; /* x, y */
}

static double distance(const double *p, const double *q)
{
    double x = q[0] - p[0], y = q[1] - p[1];
    return sqrt(x * x + y * y);
}

static size_t farthest(const struct mode_table *t, size_t from)
{
    size_t best = from;
    for (size_t p = 0; p < t->places; p++)
        if (distance(place_at(t, from), place_at(t, p)) > distance(place_at(t, from), place_at(t, best)))
            best = p;
    return best;
}

/* The line runs between the two ends, towards +x (towards +y when it is upright). */
static void find_line(const struct mode_table *t, struct modes *m)
{
    size_t u = farthest(t, 0), v = farthest(t, u);
    const double *p = place_at(t, u), *q = place_at(t, v);
    if (q[0] < p[0] || (q[0] == p[0] && q[1] < p[1])) {
        const double *swap = p;
        p = q;
        q = swap;
    }
    double length = distance(p, q);
    for (int c = 0; c < 2; c++) {
        m->base[c] = p[c];
        m->axis[c] = length > 0.0 ? (q[c] - p[c]) / length : 1.0 - c;
    }
}

/* Places in order along the line: order[k].index with order[k].key metres. */
static bool order_places(const struct mode_table *t, const struct modes *m, struct rank *order, struct err *e)
{
    for (size_t p = 0; p < t->places; p++) {
        const double *at = place_at(t, p);
        double x = at[0] - m->base[0], y = at[1] - m->base[1];
        if (fabs(y * m->axis[0] - x * m->axis[1]) > 1e-9)
            return mode_table_bad_place(t, p, "lies beside the line through the others; places must lie on one straight line", e);
        order[p] = (struct rank){x * m->axis[0] + y * m->axis[1], p};
    }
    qsort(order, t->places, sizeof *order, rank_up);
    for (size_t p = 1; p < t->places; p++)
        if (order[p].key - order[p - 1].key <= 1e-9)
            return mode_table_bad_place(t, order[p].index, "is at the same point as another place", e);
    return true;
}

/* ------------------------------------------------------------------ the strongest modes */

static double energy(const struct mode_table *t, size_t mode)
{
    double sum = 0.0;
    for (size_t p = 0; p < t->places; p++) {
        const double *v = mode_table_values(t, p, mode);
        if (v[MODE_TABLE_GAIN] != 0.0 && v[MODE_TABLE_DECAY] == 0.0)
            return HUGE_VAL; /* without decay: endless energy, unless silent */
        double amplitude = v[MODE_TABLE_GAIN] != 0.0 ? v[MODE_TABLE_GAIN] / (2.0 * sqrt(v[MODE_TABLE_DECAY])) : 0.0;
        sum += amplitude * amplitude;
    }
    return sum;
}

static struct rank *rank_modes(const struct mode_table *t, struct arena *a)
{
    struct rank *order = ARENA_TAKE(a, struct rank, t->modes);
    for (size_t i = 0; i < t->modes; i++)
        order[i] = (struct rank){-energy(t, i), i};
    qsort(order, t->modes, sizeof *order, rank_up);
    return order;
}

static void fill(const struct mode_table *t, const struct rank *places, const struct rank *modes, struct modes *m)
{
    for (int i = 0; i < m->n; i++) {
        const double *v = mode_table_values(t, 0, modes[i].index);
        m->frequency[i] = v[MODE_TABLE_FREQUENCY];
        m->decay[i] = v[MODE_TABLE_DECAY];
    }
    for (int p = 0; p < m->places; p++) {
        m->along[p] = places[p].key;
        for (int i = 0; i < m->n; i++) {
            const double *v = mode_table_values(t, places[p].index, modes[i].index);
            m->gain_re[(size_t)p * m->n + i] = v[MODE_TABLE_GAIN] * real_cos(v[MODE_TABLE_PHASE]);
            m->gain_im[(size_t)p * m->n + i] = v[MODE_TABLE_GAIN] * real_sin(v[MODE_TABLE_PHASE]);
        }
    }
}

bool modes_read(const char *path, int strongest, struct arena *a, struct modes *m, struct err *e)
{
    struct mode_table t;
    if (!mode_table_read(path, a, &t, e))
        return false;
    *m = (struct modes){.n = (size_t)strongest < t.modes ? strongest : (int)t.modes, .places = (int)t.places, .quantity = t.quantity};
    struct rank *places = ARENA_TAKE(a, struct rank, t.places);
    find_line(&t, m);
    if (!order_places(&t, m, places, e))
        return false;
    m->frequency = ARENA_TAKE(a, double, m->n);
    m->decay = ARENA_TAKE(a, double, m->n);
    m->along = ARENA_TAKE(a, double, m->places);
    m->gain_re = ARENA_TAKE(a, double, (size_t)m->places * m->n);
    m->gain_im = ARENA_TAKE(a, double, (size_t)m->places * m->n);
    fill(&t, places, rank_modes(&t, a), m);
    return true;
}
