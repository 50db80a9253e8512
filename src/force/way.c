/* Stretches. Between two force samples a curved path is the cubic Hermite curve through both places with both unit
   tangents, its parameter w from 0 to the arc length h travelled: within h^4 kappa''.. / 384 of the path, below 1e-16 m
   at 10 um. Along a profile, and on a straight path, places are exact straight lines in u. */
#include "force/way.h"

#include <math.h>
#include <string.h>

#include "force/way_cut.h"
#include "force/way_straight.h"
#include "num/lanes.h"
#include "scene/rules.h"
#include "surface/limiter.h"
#include "surface/reading.h"
#include "trajectory/load.h"
#include "trajectory/trajectory.h"

unsigned way_asks(const struct contact *c)
{
    bool field = !rules_straight(&c->motion) && rules_along(c) != ALONG_PATH;
    return field ? ITEM_BIT(ITEM_X) | ITEM_BIT(ITEM_Y) | ITEM_BIT(ITEM_VX) | ITEM_BIT(ITEM_VY) : 0;
}

double way_work(const struct contact *c, const struct scene *s)
{
    const struct surface *u = &c->surface;
    double finest = u->roughness.given                  ? reading_roughness(&u->roughness)
                    : u->height_map && !isnan(u->pitch) ? u->pitch
                                                        : READING_MAP_PITCH;
    bool halves = rules_along(c) == ALONG_PLANE;
    return (halves ? 2 : 1) * (s->accuracy.oversampling + rules_speed(&c->motion) / (s->output.sample_rate * finest));
}

/* ------------------------------------------------------------------ making */

static bool way_grids(struct way *w, const char *contact, struct err *e)
{
    for (const struct relief_part *p = w->relief->first; p; p = p->next)
        for (int axis = 0; axis < 2; axis++) {
            struct way_grid g = {
                .axis = axis, .pitch = p->pitch[axis], .origin = p->origin[axis] + relief_shift(w->relief, axis)};
            bool known = g.pitch <= 0 || (axis == 1 && w->relief->along != ALONG_PLANE);
            for (int k = 0; k < w->n_grids; k++)
                known = known ||
                        (w->grids[k].axis == axis && w->grids[k].pitch == g.pitch && w->grids[k].origin == g.origin);
            if (known) continue;
            if (w->n_grids == WAY_GRIDS)
                return err_set(e, ERR_SCENE,
                               "contact '%s': the surface is made of too many parts: leave out one of height_map, "
                               "roughness, ridges, grit",
                               contact);
            w->grids[w->n_grids++] = g;
        }
    return true;
}

static bool way_linear(const struct relief *r)
{
    for (const struct relief_part *p = r->first; p; p = p->next)
        if (!p->linear) return false;
    return true;
}

bool way_place(struct way *w, const struct stage_run *r, struct err *e)
{
    const struct trajectory *tr = r->board->trajectory;
    int along = r->board->relief->along;
    w->relief = r->board->relief;
    w->field = along != ALONG_PATH;
    w->curved = w->field && !tr->straight;
    w->e[0] = w->field ? tr->e[0] : 1;
    w->e[1] = w->field ? tr->e[1] : 0;
    w->from[0] = w->field ? tr->from[0] : 0;
    w->from[1] = w->field ? tr->from[1] : 0;
    if (along == ALONG_X && fabs(w->e[0]) * tr->length < 1e-6 * relief_finest(w->relief) && tr->straight)
        w->e[0] =
            0; /* straight across the profile: what the decimals of the two ends leave in x is no motion along it */
    return way_grids(w, r->contact->name, e);
}

bool way_make(struct way *w, struct stage_run *r, enum way_kind kind, double longest, struct err *e)
{
    const struct limiter *limiter = &r->contact->contact.limiter;
    int along = r->board->relief->along;
    if (!way_place(w, r, e)) return false;
    w->kind = kind;
    w->channels = (kind == WAY_ALONG && w->curved) || (kind == WAY_AXES && along == ALONG_PLANE) ? 2 : 1;
    w->limiter = limiter->curve == LIMITER_TANH;
    w->ratio = kind == WAY_AXES ? limiter->ratio_y : 1;
    w->halves = w->curved || along == ALONG_PLANE || !way_linear(w->relief);
    w->longest = w->halves ? fmin(longest, relief_finest(w->relief) / 2) : longest;
    if (!load_varies(r->contact)) {
        double n = rules_load(r->contact);
        limiter_told(r, n, n);
    }
    w->straight = way_straight(w);
    w->along = w->straight && kind == WAY_ALONG && w->e[0] == 1 && w->e[1] == 0;
    return true;
}

/* ------------------------------------------------------------------ values at the points */

LANES_CLONES
static void values_along(struct way *w)
{
    struct way_pieces *p = &w->pieces;
    int n = p->points;
#pragma omp simd
    for (int k = 0; k < n; k++) {
        double x = p->ex[k], y = p->ey[k];
        p->curvature[0][k] = x * x * w->xx[k] + 2 * x * y * w->xy[k] + y * y * w->yy[k];
    }
    n = w->channels == 2 ? n : 0;
#pragma omp simd
    for (int k = 0; k < n; k++) {
        double x = p->ex[k], y = p->ey[k];
        p->curvature[1][k] = x * y * (w->yy[k] - w->xx[k]) + (x * x - y * y) * w->xy[k];
    }
}

static void values_axes(struct way *w)
{
    struct way_pieces *p = &w->pieces;
    for (int k = 0; k < p->points; k++) {
        double x = p->ex[k], y = p->ey[k];
        p->curvature[0][k] = w->xx[k];
        p->curvature[1][k] = w->yy[k];
        p->bend[k] = x * x * w->xx[k] + 2 * x * y * w->xy[k] + y * y * w->yy[k];
    }
}

static void values_slope(struct way_pieces *p, const double *zx, const double *zy)
{
    for (int k = 0; k < p->points; k++)
        p->slope[k] = p->ex[k] * zx[k] + p->ey[k] * zy[k];
}

/* Pieces come in pairs (a, m), (m, b): of a parabola through the three, each half bulges by a quarter of what m lies
 * above the chord. */
static void values_bulge(struct way_pieces *p, int channel)
{
    const double *c = p->curvature[channel];
    for (int i = 0; i < p->n; i += 2) {
        int a = p->at[i];
        p->bulge[channel][i] = p->bulge[channel][i + 1] = 0.25 * (c[a + 1] - 0.5 * (c[a] + c[a + 2]));
    }
}

static void way_flush(struct way *w)
{
    struct way_pieces *p = &w->pieces;
    bool plane = w->relief->along == ALONG_PLANE, axes = w->kind == WAY_AXES;
    double zx[LIMITED_POINTS], zy[LIMITED_POINTS] = {0};
    if (p->n == 0) return;
    relief_at(w->relief, &(struct relief_points){(size_t)p->points, p->x, plane ? p->y : NULL},
              &(struct relief_values){.x = axes ? zx : NULL,
                                      .y = axes && plane ? zy : NULL,
                                      .xx = w->along ? p->curvature[0] : w->xx,
                                      .xy = plane ? w->xy : NULL,
                                      .yy = plane ? w->yy : NULL});
    if (axes) values_slope(p, zx, zy);
    if (axes)
        values_axes(w);
    else if (!w->along)
        values_along(w);
    for (int k = 0; k < w->channels; k++) {
        if (w->halves) values_bulge(p, k);
        limited_run(&(struct limited){p->n, p->points, p->at, p->alpha[k], p->curvature[k],
                                      w->halves ? p->bulge[k] : NULL, p->limited[k], p->mean[k], p->moment[k]},
                    w->limiter);
    }
    w->use(w->self, p);
    p->n = p->points = 0;
}

/* ------------------------------------------------------------------ sub-intervals */

struct instant {
    double u, x, y, ex, ey;
};

/* A chunk's motion, looked up once. */
struct motions {
    const double *u, *du, *x, *y, *vx, *vy; /* x to vy: of a curved way */
    double top;
};

static struct motions way_motions(const struct way *w, const struct board *b, long first)
{
    struct motions m = {.u = way_values(b, ITEM_POSITION, first),
                        .du = way_values(b, ITEM_VELOCITY, first),
                        .top = b->trajectory->top_speed};
    if (w->curved) {
        m.x = way_values(b, ITEM_X, first);
        m.y = way_values(b, ITEM_Y, first);
        m.vx = way_values(b, ITEM_VX, first);
        m.vy = way_values(b, ITEM_VY, first);
    }
    return m;
}

/* The instant's place; its direction is 0, 0 where the contact rests. */
static struct instant way_instant(const struct way *w, const struct motions *m, int k)
{
    struct instant i = {.u = m->u[k]};
    if (!w->curved) return i;
    double vx = m->vx[k], vy = m->vy[k], v = sqrt(vx * vx + vy * vy), top_speed = m->top;
    i.x = m->x[k];
    i.y = m->y[k];
    if (v > 1e-6 * top_speed) {
        i.ex = vx / v;
        i.ey = vy / v;
    }
    return i;
}

static bool at_rest(struct instant i) { return i.ex == 0 && i.ey == 0; }

/* From a to b on a smooth curve. Where the contact rests at one end the direction is that of the other: a chord of a
   few last places of the coordinates points anywhere. */
static void way_stretch(struct way *w, struct instant a, struct instant b, double alpha, int interval)
{
    struct way_stretch s = {.u = a.u, .end = b.u, .alpha = alpha, .interval = interval};
    double dx = b.x - a.x, dy = b.y - a.y, chord = w->curved ? sqrt(dx * dx + dy * dy) : 0;
    if (a.u == b.u || (w->curved && chord == 0)) return;
    if (w->curved) {
        struct instant from = at_rest(a) ? b : a, to = at_rest(b) ? a : b;
        if (at_rest(from)) from.ex = to.ex = dx / chord, from.ey = to.ey = dy / chord;
        double h = fabs(b.u - a.u);
        if (chord < 0.9 * h) { /* the last places of x, y are coarser than those of u: straight on */
            b.x = a.x + h * from.ex, b.y = a.y + h * from.ey;
            to = from;
        }
        s.path = (struct way_curve){
            .x = {a.x, b.x}, .y = {a.y, b.y}, .length = h, .ex = {from.ex, to.ex}, .ey = {from.ey, to.ey}};
    }
    while (!way_cut(w, &s))
        way_flush(w);
}

/* Where the motion turns round on itself the stretch is two, each in its own side's direction. So it is where the turn
   is too slow or too small for its instant to be found: then t is half way. */
static void way_turn(struct way *w, const struct stage_run *r, struct instant a, struct instant b, double alpha,
                     int interval, double t)
{
    struct instant m = {0};
    trajectory_at(r->board->trajectory, 1, &t,
                  (struct trajectory_out){.u = &m.u, .x = w->curved ? &m.x : NULL, .y = w->curved ? &m.y : NULL});
    way_stretch(w, a, m, alpha, interval);
    way_stretch(w, m, b, alpha, interval);
}

static bool way_turns(const struct way *w, struct instant a, struct instant b, double va, double vb)
{
    return w->curved ? a.ex * b.ex + a.ey * b.ey < 0 : va * vb < 0;
}

struct interval {
    int i;           /* of the chunk          */
    long number;     /* since the start       */
    double alpha;    /* m                     */
    const double *v; /* m/s, at both ends   */
};

static void way_interval(struct way *w, const struct stage_run *r, const struct interval *s,
                         const struct instant ends[2])
{
    const struct board *b = r->board;
    if (!way_turns(w, ends[0], ends[1], s->v[0], s->v[1])) {
        way_stretch(w, ends[0], ends[1], s->alpha, s->i);
        return;
    }
    double dt = 1 / (b->rate * b->over), t0 = (double)s->number * dt, t1 = (double)(s->number + 1) * dt;
    double turn = trajectory_turning(b->trajectory, t0, t1);
    if (w->curved || !isnan(turn))
        way_turn(w, r, ends[0], ends[1], s->alpha, s->i, isnan(turn) ? 0.5 * (t0 + t1) : turn);
    else
        way_stretch(w, ends[0], ends[1], s->alpha, s->i);
}

/* Of each of the n sub-intervals. */
static void way_alphas(const struct stage_run *r, long first, int n, double *alpha)
{
    const struct board *b = r->board;
    bool varies = board_has(b, ITEM_ALPHA);
    const double *given = varies ? way_values(b, ITEM_ALPHA, first) : NULL;
    double fixed = varies ? NAN : limiter_constant(r->contact);
    for (int i = 0; i < n; i++)
        alpha[i] = varies ? 0.5 * (given[i] + given[i + 1]) : fixed;
}

void way_run(struct way *w, const struct stage_run *r, long first, int n)
{
    struct motions m = way_motions(w, r->board, first);
    struct way_straight s;
    struct instant ends[2] = {{0}, way_instant(w, &m, 0)};
    s.u = m.u;
    s.flush = way_flush;
    way_alphas(r, first, n, s.alpha);
    if (w->straight) way_straight_look(w, &s, n);
    for (int i = 0; i < n; i++) {
        int end = i;
        while (w->straight && end < n && m.du[end] * m.du[end + 1] >= 0)
            end++;
        if (end > i) {
            way_straight_cut(w, &s, i, end);
            i = end - 1;
            continue;
        }
        ends[0] = w->straight ? way_instant(w, &m, i) : ends[1];
        ends[1] = way_instant(w, &m, i + 1);
        way_interval(w, r, &(struct interval){i, first + i, s.alpha[i], m.du + i}, ends);
    }
    way_flush(w);
}
