/* Measured on a line over roughness at one sub-interval a sample: a third of what way_cut takes for each piece, and half the points where alpha is
   constant. Operations are those of way_cut.c in the same order: so are the bits. */
#include "force/way_straight.h"

#include <math.h>

#include "num/lanes.h"

bool way_straight(struct way *w)
{
    bool across = false;
    for (int k = 0; k < w->n_grids; k++)
        across = across || w->grids[k].axis != 0;
    for (int k = 0; k < LIMITED_POINTS; k++) {
        w->pieces.ex[k] = w->e[0];
        w->pieces.ey[k] = w->e[1];
    }
    return !w->curved && !w->halves && w->channels == 1 && !across;
}

struct knots {
    double from, e, origin, pitch, longest;
    int n;
};

/* first[i] no longer than to the next knot of one family. */
LANES_CLONES
static void knots_first(const struct knots *g, const double *u, double *first)
{
    double from = g->from, e = g->e, origin = g->origin, pitch = g->pitch;
    int n = g->n;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double heading = lanes_select(u[i + 1] > u[i], 1, -1), whole = fabs(u[i + 1] - u[i]);
        double rate = heading * e / pitch, q = (from + u[i] * e - origin) / pitch, slack = 1e-7 * (1 + fabs(q) * 1e-6);
        double edge = lanes_select(rate > 0, lanes_floor(q + slack) + 1, lanes_ceil(q - slack) - 1);
        int none = fabs(rate) * whole < 1e-9;
        double next = lanes_select(none, HUGE_VAL, (edge - q) / lanes_select(none, 1, rate));
        first[i] = lanes_select(next < first[i], next, first[i]);
    }
}

LANES_CLONES
static void whole_first(int n, const double *u, double longest, double *first)
{
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double whole = fabs(u[i + 1] - u[i]);
        first[i] = lanes_select(whole < longest, whole, longest);
    }
}

/* A sub-interval without a knot is one piece; of one family of knots, with less than a pitch behind the first, it is two. */
LANES_CLONES
static void pieces_count(const struct way *w, struct way_straight *s, int n)
{
    const double *u = s->u, *first = s->first;
    double longest = w->longest, pitch = w->n_grids == 1 && w->e[0] != 0 ? 0.99 * w->grids[0].pitch / fabs(w->e[0]) : 0;
    int *pieces = s->pieces;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double whole = fabs(u[i + 1] - u[i]), left = whole - first[i];
        int one = (left == 0) & (whole > 0), two = (left > 0) & (left < pitch) & (whole <= longest);
        pieces[i] = one + 2 * two;
    }
}

void way_straight_look(const struct way *w, struct way_straight *s, int n)
{
    whole_first(n, s->u, w->longest, s->first);
    for (int k = 0; k < w->n_grids; k++)
        knots_first(&(struct knots){w->from[0], w->e[0], w->grids[k].origin, w->grids[k].pitch, w->longest, n}, s->u, s->first);
    pieces_count(w, s, n);
}

/* Where the next piece ends that begins `done` m into the sub-interval, at x. */
static double piece_end(const struct way *w, int heading, double whole, double done, double x)
{
    double next = done + w->longest < whole ? done + w->longest : whole;
    for (int k = 0; k < w->n_grids; k++) {
        const struct way_grid *g = &w->grids[k];
        double rate = heading * w->e[0] / g->pitch, q = (x - g->origin) / g->pitch, slack = 1e-7 * (1 + fabs(q) * 1e-6);
        if (fabs(rate) * (whole - done) < 1e-9)
            continue;
        double knot = done + ((rate > 0 ? lanes_floor(q + slack) + 1 : lanes_ceil(q - slack) - 1) - q) / rate;
        next = knot < next ? knot : next;
    }
    return next > done ? next : done + fmax(1e-12 * whole, 4e-16 * fabs(done)); /* no progress in floating point */
}

static void put_point(struct way_pieces *p, double x, double alpha)
{
    int k = p->points++;
    p->x[k] = x;
    p->alpha[0][k] = alpha;
}

static void cut_any(struct way *w, const struct way_straight *s, int i)
{
    struct way_pieces *p = &w->pieces;
    double u = s->u[i], whole = fabs(s->u[i + 1] - u), done = 0, next = s->first[i], x = w->from[0] + u * w->e[0], alpha = s->alpha[i];
    int heading = s->u[i + 1] > u ? 1 : -1;
    for (; done < whole; done = next, next = done < whole ? piece_end(w, heading, whole, done, x) : 0) {
        if (p->n + 2 > LIMITED_PIECES || p->points + 3 > LIMITED_POINTS)
            s->flush(w);
        if (p->points == 0 || p->x[p->points - 1] != x || p->alpha[0][p->points - 1] != alpha)
            put_point(p, x, alpha);
        x = w->from[0] + (u + heading * next) * w->e[0];
        p->at[p->n] = p->points - 1;
        p->interval[p->n] = i;
        p->heading[p->n] = heading;
        p->length[p->n++] = next - done;
        put_point(p, x, alpha);
    }
}

static void put_piece(struct way_pieces *p, int k, int i, int heading, double length)
{
    p->at[p->n + k] = p->points - 1 + k;
    p->interval[p->n + k] = i;
    p->heading[p->n + k] = heading;
    p->length[p->n + k] = length;
}

/* Sub-intervals of one or two pieces: whether a knot lies inside is for a CPU to guess, and it guesses wrong, so that two are written every time and one or
   two are counted. A third of what cut_any takes. */
static void cut_few(struct way *w, const struct way_straight *s, int i, int end)
{
    struct way_pieces *p = &w->pieces;
    double from = w->from[0], e = w->e[0];
    for (; i < end && s->pieces[i]; i++) {
        double u = s->u[i], way = s->u[i + 1] - u, whole = fabs(way), x = from + u * e, alpha = s->alpha[i], first = s->first[i];
        int heading = way > 0 ? 1 : -1, more = s->pieces[i];
        if (p->n + 2 > LIMITED_PIECES || p->points + 3 > LIMITED_POINTS)
            s->flush(w);
        if (p->points == 0 || p->x[p->points - 1] != x || p->alpha[0][p->points - 1] != alpha)
            put_point(p, x, alpha);
        put_piece(p, 0, i, heading, first);
        put_piece(p, 1, i, heading, whole - first);
        p->x[p->points] = from + (u + heading * first) * e;
        p->x[p->points + 1] = from + (u + heading * whole) * e;
        p->alpha[0][p->points] = p->alpha[0][p->points + 1] = alpha;
        p->points += more;
        p->n += more;
    }
}

void way_straight_cut(struct way *w, const struct way_straight *s, int i, int end)
{
    while (i < end) {
        int n = 0;
        while (i + n < end && s->pieces[i + n])
            n++;
        cut_few(w, s, i, i + n);
        if ((i += n) < end)
            cut_any(w, s, i++);
    }
}
