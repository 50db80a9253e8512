/* The next knot is looked for along each family's coordinate, which runs nearly straight over a stretch: one Newton
   step from the tangent's crossing. A knot missed by rounding, or a knot line that a curve just touches between two
   places, leaves a kink inside a piece: the piece's mean is off by half the kink of its slope times what was missed (a
   part in 1e7 of a pitch by rounding, kappa h^2 / 8 of a line touched).

   Measured on a circle over roughness, where this was a quarter of all: the step is made for knots alone that may be
   the next ones, on one coordinate; and a stretch that begins where the one before ended shares its point, so that a
   third fewer are read and limited. */
#include "force/way_cut.h"

#include <math.h>

struct spot {
    double x, y, ex, ey; /* as the relief wants it; e in the direction of increasing u */
};

/* Hermite basis at share q, and its derivatives over q. */
static struct spot curve_at(const struct way_curve *c, double w)
{
    double q = w / c->length, p = 1 - q, h = c->length;
    double a = p * p * (1 + 2 * q), b = q * q * (1 + 2 * p), s = q * p * p * h, t = -q * q * p * h;
    double da = -6 * q * p / h, ds = p * (p - 2 * q), dt = q * (q - 2 * p);
    struct spot r = {.x = a * c->x[0] + b * c->x[1] + s * c->ex[0] + t * c->ex[1],
                     .y = a * c->y[0] + b * c->y[1] + s * c->ey[0] + t * c->ey[1]};
    double dx = da * (c->x[0] - c->x[1]) + ds * c->ex[0] + dt * c->ex[1],
           dy = da * (c->y[0] - c->y[1]) + ds * c->ey[0] + dt * c->ey[1];
    double d = sqrt(dx * dx + dy * dy);
    r.ex = d > 0 ? dx / d : c->ex[0];
    r.ey = d > 0 ? dy / d : c->ey[0];
    return r;
}

static int heading(const struct way_stretch *s) { return s->end > s->u ? 1 : -1; }

/* `done` m into the stretch. */
static struct spot spot_at(const struct way *w, const struct way_stretch *s, double done)
{
    double u = s->u + heading(s) * done;
    if (!w->curved) return (struct spot){w->from[0] + u * w->e[0], w->from[1] + u * w->e[1], w->e[0], w->e[1]};
    struct spot r = curve_at(&s->path, done);
    r.ex *= heading(s);
    r.ey *= heading(s);
    return r;
}

/* One coordinate of the curve; *rate: its derivative. */
static double curve_along(const struct way_curve *c, int axis, double w, double *rate)
{
    const double *x = axis ? c->y : c->x, *e = axis ? c->ey : c->ex;
    double h = c->length, q = w / h, p = 1 - q, b = q * q * (1 + 2 * p);
    *rate = 6 * q * p / h * (x[1] - x[0]) + p * (p - 2 * q) * e[0] + q * (q - 2 * p) * e[1];
    return x[0] + b * (x[1] - x[0]) + q * p * h * (p * e[0] - q * e[1]);
}

/* Where the stretch reaches the family's next knot, along the tangent; corrected once if that may be before `nearest`.
 */
static double grid_next(const struct way *w, const struct way_grid *g, const struct way_stretch *s, double done,
                        const struct spot *at, double nearest)
{
    double rate = heading(s) * (g->axis ? at->ey : at->ex) / g->pitch,
           q = ((g->axis ? at->y : at->x) - g->origin) / g->pitch;
    double slack = 1e-7 * (1 + fabs(q) * 1e-6); /* a knot just reached is not the next one */
    if (fabs(rate) * (fabs(s->end - s->u) - done) < 1e-9) return HUGE_VAL;
    double edge = rate > 0 ? floor(q + slack) + 1 : ceil(q - slack) - 1, next = done + (edge - q) / rate;
    if (!w->curved || !(next < s->path.length) || next - done > 2 * (nearest - done)) return next;
    double speed, left = edge - (curve_along(&s->path, g->axis, next, &speed) - g->origin) / g->pitch,
                  better = next + left * g->pitch / speed;
    return fabs(speed) > 0.1 * fabs(rate * g->pitch) && better > done ? better : next;
}

static void add_point(struct way *w, const struct way_stretch *s, const struct spot *at)
{
    struct way_pieces *p = &w->pieces;
    int k = p->points++;
    p->x[k] = at->x;
    p->y[k] = at->y;
    p->ex[k] = at->ex;
    p->ey[k] = at->ey;
    p->alpha[0][k] = s->alpha;
    p->alpha[1][k] = s->alpha * w->ratio;
}

/* Is the last point this very one, and of the same alpha? */
static bool last_point(const struct way_pieces *p, const struct way_stretch *s, const struct spot *at)
{
    int k = p->points - 1;
    return k >= 0 && p->x[k] == at->x && p->y[k] == at->y && p->ex[k] == at->ex && p->ey[k] == at->ey &&
           p->alpha[0][k] == s->alpha;
}

static void add_piece(struct way *w, const struct way_stretch *s, double length, const struct spot *end)
{
    struct way_pieces *p = &w->pieces;
    int i = p->n++;
    p->at[i] = p->points - 1;
    p->interval[i] = s->interval;
    p->heading[i] = heading(s);
    p->length[i] = length;
    add_point(w, s, end);
}

bool way_cut(struct way *w, struct way_stretch *s)
{
    struct way_pieces *p = &w->pieces;
    double whole = fabs(s->end - s->u), done = s->cut ? s->done : 0;
    struct spot at = spot_at(w, s, done);
    bool chained = false;
    while (done < whole) {
        double next = fmin(whole, done + w->longest);
        if (p->n + 2 > LIMITED_PIECES || p->points + 3 > LIMITED_POINTS) {
            s->cut = true;
            s->done = done;
            return false;
        }
        for (int k = 0; k < w->n_grids; k++)
            next = fmin(next, grid_next(w, &w->grids[k], s, done, &at, next));
        if (!(next > done)) next = done + fmax(1e-12 * whole, 4e-16 * fabs(done)); /* no progress in floating point */
        struct spot end = spot_at(w, s, next);
        if (!chained && !last_point(p, s, &at)) add_point(w, s, &at);
        chained = true;
        if (w->halves) {
            struct spot middle = spot_at(w, s, 0.5 * (done + next));
            add_piece(w, s, 0.5 * (next - done), &middle);
            add_piece(w, s, 0.5 * (next - done), &end);
        } else {
            add_piece(w, s, next - done, &end);
        }
        at = end;
        done = next;
    }
    return true;
}
