/* Measured on a line over roughness at one sub-interval a sample: a third of what way_cut takes for each piece, and
   half the points where alpha is constant; a whole render in draft over a map on a line fell from 794 to 621 cycles a
   sample. Operations are those of way_cut.c in the same order: so are the bits. */
#include "force/way_straight.h"

#include <math.h>

#include "num/lanes.h"

#define INLINE static inline __attribute__((always_inline))

bool way_straight(struct way *w)
{
    for (int k = 0; k < LIMITED_POINTS; k++) {
        w->pieces.ex[k] = w->e[0];
        w->pieces.ey[k] = w->e[1];
    }
    return !w->curved && w->channels == 1;
}

struct knots {
    double from, e, origin, pitch;
    int n;
};

/* One family's: first[i] m into the sub-interval or before is the nearest knot of all, not before second[i] the one
 * after it. */
LANES_CLONES
static void knots_first(const struct knots *g, const double *u, double *first, double *second)
{
    double from = g->from, e = g->e, origin = g->origin, pitch = g->pitch, each = pitch / fabs(e), along = e / pitch;
    int n = g->n;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double heading = lanes_select(u[i + 1] > u[i], 1, -1), whole = fabs(u[i + 1] - u[i]);
        double rate = heading * along, q = (from + u[i] * e - origin) / pitch, slack = 1e-7 * (1 + fabs(q) * 1e-6);
        double edge = lanes_select(rate > 0, lanes_floor(q + slack) + 1, lanes_ceil(q - slack) - 1);
        int none = fabs(rate) * whole < 1e-9;
        double next = lanes_select(none, HUGE_VAL, (edge - q) / lanes_select(none, 1, rate));
        double later = lanes_select(next < first[i], first[i], next) - 1e-6 * each, again = next + 0.99 * each;
        later = lanes_select(again < later, again, later);
        first[i] = lanes_select(next < first[i], next, first[i]);
        second[i] = lanes_select(later < second[i], later, second[i]);
    }
}

/* A sub-interval without a knot is one piece; with one knot, and none that may lie near behind it, it is two. */
LANES_CLONES
static void pieces_count(const struct way *w, struct way_straight *s, int n)
{
    const double *u = s->u, *second = s->second;
    double longest = w->longest, *first = s->first;
    int *pieces = s->pieces;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double whole = fabs(u[i + 1] - u[i]), most = lanes_select(whole < longest, whole, longest);
        double length = lanes_select(first[i] < most, first[i], most), left = whole - length;
        int one = (left == 0) & (whole > 0), two = (left > 0) & (whole < second[i]) & (whole <= longest);
        first[i] = length;
        pieces[i] = one + 2 * two;
    }
}

void way_straight_look(const struct way *w, struct way_straight *s, int n)
{
    for (int i = 0; i < n; i++)
        s->first[i] = s->second[i] = HUGE_VAL;
    for (int k = 0; k < w->n_grids; k++) {
        const struct way_grid *g = &w->grids[k];
        if (w->e[g->axis] != 0)
            knots_first(&(struct knots){w->from[g->axis], w->e[g->axis], g->origin, g->pitch, n}, s->u, s->first,
                        s->second);
    }
    pieces_count(w, s, n);
}

/* A sub-interval. */
struct interval {
    int i, heading;
    double u, alpha;
};

/* Where the next piece ends that begins `done` m into the sub-interval. */
static double piece_end(const struct way *w, const struct interval *v, double whole, double done)
{
    double next = done + w->longest < whole ? done + w->longest : whole;
    for (int k = 0; k < w->n_grids; k++) {
        const struct way_grid *g = &w->grids[k];
        double at = w->from[g->axis] + (v->u + v->heading * done) * w->e[g->axis];
        double rate = v->heading * w->e[g->axis] / g->pitch, q = (at - g->origin) / g->pitch,
               slack = 1e-7 * (1 + fabs(q) * 1e-6);
        if (fabs(rate) * (whole - done) < 1e-9) continue;
        double knot = done + ((rate > 0 ? lanes_floor(q + slack) + 1 : lanes_ceil(q - slack) - 1) - q) / rate;
        next = knot < next ? knot : next;
    }
    return next > done ? next : done + fmax(1e-12 * whole, 4e-16 * fabs(done)); /* no progress in floating point */
}

/* Point k, `done` m into the sub-interval. */
INLINE void put_point(struct way *w, int k, const struct interval *v, double done, bool halves)
{
    double u = v->u + v->heading * done;
    w->pieces.x[k] = w->from[0] + u * w->e[0];
    if (halves) w->pieces.y[k] = w->from[1] + u * w->e[1];
    w->pieces.alpha[0][k] = v->alpha;
}

/* The point where pieces begin, `done` m into the sub-interval; the last one counts as it where it is the same. Makes
 * room for four pieces. */
INLINE void put_start(struct way *w, const struct way_straight *s, const struct interval *v, double done, bool halves)
{
    struct way_pieces *p = &w->pieces;
    if (p->n + 4 > LIMITED_PIECES || p->points + 5 > LIMITED_POINTS) s->flush(w);
    int k = p->points;
    put_point(w, k, v, done, halves);
    if (k == 0 || p->x[k - 1] != p->x[k] || (halves && p->y[k - 1] != p->y[k]) || p->alpha[0][k - 1] != v->alpha)
        p->points++;
}

INLINE void put_piece(struct way_pieces *p, int k, const struct interval *v, double length)
{
    p->at[p->n + k] = p->points - 1 + k;
    p->interval[p->n + k] = v->i;
    p->heading[p->n + k] = v->heading;
    p->length[p->n + k] = length;
}

/* What lies between `done` and `next` m, as piece k behind those that are counted, or its two halves as pieces 2 k and
 * 2 k + 1. */
INLINE void put_part(struct way *w, int k, const struct interval *v, double done, double next, bool halves)
{
    struct way_pieces *p = &w->pieces;
    if (!halves) {
        put_piece(p, k, v, next - done);
        put_point(w, p->points + k, v, next, false);
        return;
    }
    put_piece(p, 2 * k, v, 0.5 * (next - done));
    put_piece(p, 2 * k + 1, v, 0.5 * (next - done));
    put_point(w, p->points + 2 * k, v, 0.5 * (done + next), true);
    put_point(w, p->points + 2 * k + 1, v, next, true);
}

INLINE void count_parts(struct way_pieces *p, int n, bool halves)
{
    p->n += halves ? 2 * n : n;
    p->points += halves ? 2 * n : n;
}

static struct interval interval_of(const struct way_straight *s, int i)
{
    return (struct interval){i, s->u[i + 1] > s->u[i] ? 1 : -1, s->u[i], s->alpha[i]};
}

static void cut_any(struct way *w, const struct way_straight *s, int i)
{
    struct interval v = interval_of(s, i);
    double whole = fabs(s->u[i + 1] - s->u[i]), done = 0, next = s->first[i];
    for (; done < whole; done = next, next = done < whole ? piece_end(w, &v, whole, done) : 0) {
        put_start(w, s, &v, done, w->halves);
        put_part(w, 0, &v, done, next, w->halves);
        count_parts(&w->pieces, 1, w->halves);
    }
}

/* Sub-intervals of one or two pieces: whether a knot lies inside is for a CPU to guess, and it guesses wrong, so that
   two are written every time and one or two are counted. A third of what cut_any takes. */
INLINE void cut_few(struct way *w, const struct way_straight *s, int i, int end, bool halves)
{
    for (; i < end; i++) {
        struct interval v = interval_of(s, i);
        put_start(w, s, &v, 0, halves);
        put_part(w, 0, &v, 0, s->first[i], halves);
        put_part(w, 1, &v, s->first[i], fabs(s->u[i + 1] - s->u[i]), halves);
        count_parts(&w->pieces, s->pieces[i], halves);
    }
}

void way_straight_cut(struct way *w, const struct way_straight *s, int i, int end)
{
    while (i < end) {
        int from = i;
        while (i < end && s->pieces[i])
            i++;
        if (w->halves)
            cut_few(w, s, from, i, true);
        else
            cut_few(w, s, from, i, false);
        if (i < end) cut_any(w, s, i++);
    }
}
