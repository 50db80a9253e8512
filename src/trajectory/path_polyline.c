/* Straight from point to point. With motion.corner > 0 a corner of turning angle phi is rounded by a curve of length L
   = 2 |phi| corner, on which the heading turns by

     psi(z) = phi (z - sin(2 pi z) / (2 pi)),   kappa = 2 phi / L sin^2(pi z),   z = s / L from 0 to 1

   so that curvature, and with it the acceleration, is continuous (on a circle's arc it would jump); corner is the
   smallest radius. The curve leaves the straight d before the point, d = X(1/2) + Y(1/2) tan(phi / 2), where X, Y = L
   integral of cos psi, sin psi dz is its shape in the direction of the straight (trajectory/panels.h: within 1e-13 L).
   Without rounding each straight is a stroke. */
#include <math.h>

#include "num/real.h"
#include "trajectory/path.h"

struct line_piece {
    double s, length, p[2]; /* m: where it starts                     */
    double heading;         /* half turns                             */
    double e[2];            /* direction at its start                 */
    double turn;            /* rad, to the left; 0: straight          */
    struct panels x, y;     /* shape of a corner over its own length  */
};

struct polyline {
    size_t n;
    struct line_piece *piece;
};

static double corner_psi(double z) { return z - real_sinpi(2 * z) / (2 * REAL_PI); }

static void corner_cosine(const void *self, size_t n, const double *z, double *g, double *dg)
{
    const double turn = *(const double *)self;
    for (size_t i = 0; i < n; i++) {
        double psi = turn * corner_psi(z[i]);
        g[i] = real_cos(psi);
        dg[i] = -real_sin(psi) * turn * (1 - real_cospi(2 * z[i]));
    }
}

static void corner_sine(const void *self, size_t n, const double *z, double *g, double *dg)
{
    const double turn = *(const double *)self;
    for (size_t i = 0; i < n; i++) {
        double psi = turn * corner_psi(z[i]);
        g[i] = real_sin(psi);
        dg[i] = real_cos(psi) * turn * (1 - real_cospi(2 * z[i]));
    }
}

/* ------------------------------------------------------------------ reading */

static size_t polyline_find(const struct polyline *l, double s)
{
    size_t low = 0, high = l->n - 1;
    while (low < high) {
        size_t middle = (low + high + 1) / 2;
        if (l->piece[middle].s <= s)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

static double corner_bend(const struct line_piece *w, double z)
{
    double sine = real_sinpi(z);
    return 2 * w->turn / w->length * sine * sine;
}

static void piece_at(const struct line_piece *w, double s, double p[2], double e[2], double bend[2])
{
    double along = s - w->s, across = 0, kappa = 0;
    e[0] = w->e[0], e[1] = w->e[1];
    if (w->turn != 0) {
        double z = along / w->length, heading = w->heading + w->turn / REAL_PI * corner_psi(z);
        panels_at(&w->x, 1, &z, &along, NULL, NULL);
        panels_at(&w->y, 1, &z, &across, NULL, NULL);
        along *= w->length;
        across *= w->length;
        e[0] = real_cospi(heading);
        e[1] = real_sinpi(heading);
        kappa = corner_bend(w, z);
    }
    p[0] = w->p[0] + along * w->e[0] - across * w->e[1];
    p[1] = w->p[1] + along * w->e[1] + across * w->e[0];
    bend[0] = -kappa * e[1];
    bend[1] = kappa * e[0];
}

static void polyline_at(const struct path *path, size_t n, const double *s, const struct path_out *out)
{
    const struct polyline *l = path->state;
    for (size_t i = 0; i < n; i++) {
        double p[2], e[2], bend[2];
        piece_at(&l->piece[polyline_find(l, s[i])], s[i], p, e, bend);
        for (int xy = 0; xy < 2; xy++) {
            if (out->p[xy]) out->p[xy][i] = p[xy];
            if (out->e[xy]) out->e[xy][i] = e[xy];
            if (out->bend[xy]) out->bend[xy][i] = bend[xy];
        }
    }
}

static void polyline_curvature(const struct path *path, size_t n, const double *s, double *square, double *rate)
{
    const struct polyline *l = path->state;
    for (size_t i = 0; i < n; i++) {
        const struct line_piece *w = &l->piece[polyline_find(l, s[i])];
        double z = (s[i] - w->s) / w->length, kappa = w->turn != 0 ? corner_bend(w, z) : 0;
        square[i] = kappa * kappa;
        rate[i] = w->turn != 0 ? 4 * REAL_PI * kappa * w->turn / (w->length * w->length) * real_sinpi(2 * z) : 0;
    }
}

/* ------------------------------------------------------------------ making */

/* Shape of a corner, and how much of the straights it takes. */
static double corner_make(struct line_piece *w, double turn, double radius, struct arena *a)
{
    static const double whole[3] = {0, 0.5, 1};
    double half = 0.5, x, y;
    w->turn = turn;
    w->length = 2 * fabs(turn) * radius;
    panels_integral(&(struct panels_slope){corner_cosine, &w->turn}, whole, 3, a, &w->x);
    panels_integral(&(struct panels_slope){corner_sine, &w->turn}, whole, 3, a, &w->y);
    panels_at(&w->x, 1, &half, &x, NULL, NULL);
    panels_at(&w->y, 1, &half, &y, NULL, NULL);
    return w->length * (x + y * real_tan(turn / 2));
}

static bool points_apart(const struct motion *m, size_t k, double e[2], double *length, struct err *e_out)
{
    const double *p = m->points + 2 * k;
    double x = p[2] - p[0], y = p[3] - p[1];
    *length = sqrt(x * x + y * y);
    if (*length < 1e-9)
        return err_set(e_out, ERR_SCENE, "motion.points: points %zu and %zu are in one place; leave one of them out",
                       k + 1, k + 2);
    e[0] = x / *length;
    e[1] = y / *length;
    return true;
}

/* A piece from point p in direction e, behind the last one. */
static struct line_piece *piece_put(struct polyline *l, const double p[2], const double e[2])
{
    const struct line_piece *last = l->n > 0 ? &l->piece[l->n - 1] : NULL;
    struct line_piece *w = &l->piece[l->n++];
    *w = (struct line_piece){.s = last ? last->s + last->length : 0,
                             .p = {p[0], p[1]},
                             .e = {e[0], e[1]},
                             .heading = real_atan2(e[1], e[0]) / REAL_PI};
    return w;
}

/* What the corner at point k is to be, from direction e to direction `next`; *room: m that it takes of the straights.
 */
static bool corner_plan(const struct motion *m, size_t k, const double e[2], const double next[2],
                        struct line_piece *corner, double *room, struct arena *a, struct err *err)
{
    double turn = real_atan2(e[0] * next[1] - e[1] * next[0], e[0] * next[0] + e[1] * next[1]);
    *corner = (struct line_piece){.turn = 0};
    *room = 0;
    if (m->corner == 0 || fabs(turn) < 1e-9) return true;
    if (fabs(turn) > 3.1)
        return err_set(
            err, ERR_SCENE,
            "motion.points: at point %zu the path turns back on itself, which cannot be rounded; set motion.corner: 0",
            k + 1);
    *room = corner_make(corner, turn, m->corner, a);
    return true;
}

static void corner_put(struct polyline *l, const double *point, const double e[2], double room,
                       const struct line_piece *corner)
{
    const double p[2] = {point[0] - room * e[0], point[1] - room * e[1]};
    struct line_piece *w = piece_put(l, p, e);
    w->turn = corner->turn;
    w->length = corner->length;
    w->x = corner->x;
    w->y = corner->y;
}

/* One straight, and the corner at its end if there is one. taken: m of the straight that the corner before it has;
 * becomes that of the next. */
static bool side_put(struct polyline *l, const struct motion *m, size_t k, double *taken, struct arena *a,
                     struct err *err)
{
    double e[2], next[2], length, next_length, room = 0;
    struct line_piece corner = {.turn = 0};
    bool last = k + 2 == (size_t)m->n_points;
    if (!points_apart(m, k, e, &length, err) || (!last && !points_apart(m, k + 1, next, &next_length, err)) ||
        (!last && !corner_plan(m, k + 1, e, next, &corner, &room, a, err)))
        return false;
    if (*taken + room > length * (1 + 1e-12))
        return err_set(err, ERR_SCENE,
                       "motion.corner: rounding takes %.4g m of the straight between points %zu and %zu, which is %.4g "
                       "m long; lower "
                       "motion.corner, or move the points apart",
                       *taken + room, k + 1, k + 2, length);
    const double p[2] = {m->points[2 * k] + *taken * e[0], m->points[2 * k + 1] + *taken * e[1]};
    piece_put(l, p, e)->length = fmax(length - *taken - room, 0);
    if (corner.turn != 0) corner_put(l, m->points + 2 * (k + 1), e, room, &corner);
    *taken = room;
    return true;
}

/* Where pieces begin, and the end: the breaks of curvature; without rounding the strokes. */
static double *polyline_borders(const struct polyline *l, struct arena *a, size_t *count)
{
    const struct line_piece *last = &l->piece[l->n - 1];
    double *s = ARENA_TAKE(a, double, l->n + 1);
    size_t n = 0;
    for (size_t i = 0; i < l->n; i++)
        if (i == 0 || l->piece[i].s > s[n - 1]) s[n++] = l->piece[i].s;
    if (last->s + last->length > s[n - 1]) s[n++] = last->s + last->length;
    *count = n;
    return s;
}

bool path_polyline(struct path *p, const struct motion *m, struct arena *a, struct err *e)
{
    struct polyline *l = ARENA_TAKE(a, struct polyline, 1);
    double taken = 0;
    l->piece = ARENA_TAKE(a, struct line_piece, 2 * m->n_points);
    for (size_t k = 0; k + 1 < (size_t)m->n_points; k++)
        if (!side_put(l, m, k, &taken, a, e)) return false;
    const struct line_piece *last = &l->piece[l->n - 1];
    double length = last->s + last->length, *ends = ARENA_TAKE(a, double, 2);
    ends[1] = length;
    *p = (struct path){.length = length,
                       .n_strokes = 1,
                       .strokes = ends,
                       .at = polyline_at,
                       .curvature = polyline_curvature,
                       .state = l};
    p->breaks = polyline_borders(l, a, &p->n_breaks);
    if (m->corner == 0) {
        p->strokes = p->breaks;
        p->n_strokes = p->n_breaks - 1;
    }
    return true;
}
