/* See boundary.h. Area and volume by Radon's seven points on the triangle, exact to degree 5: the volume, one third of
 * the integral of x . n, is of degree 4 and so exact. */
#include "fem/boundary.h"

#include <math.h>
#include <string.h>

#include "fem/topology.h"
#include "num/real.h"

void boundary_face_at(const struct mesh *m, const int face[6], const double uv[2], struct boundary_face_at *x)
{
    double u = uv[0], v = uv[1], t = 1 - u - v, w[6];
    boundary_weights(u, v, w);
    const double wu[6] = {1 - 4 * t, 4 * u - 1, 0, 4 * (t - u), 4 * v, -4 * v},
                 wv[6] = {1 - 4 * t, 0, 4 * v - 1, -4 * u, 4 * u, 4 * (t - v)};
    memset(x, 0, sizeof *x);
    for (int i = 0; i < 6; i++)
        for (int c = 0; c < 3; c++) {
            x->at[c] += w[i] * m->at[face[i]][c];
            x->du[c] += wu[i] * m->at[face[i]][c];
            x->dv[c] += wv[i] * m->at[face[i]][c];
        }
    for (int c = 0; c < 3; c++) {
        int d = (c + 1) % 3, e = (c + 2) % 3;
        x->across[c] = x->du[d] * x->dv[e] - x->du[e] * x->dv[d];
    }
}

/* The box of the face's control points as a Bezier triangle, in whose hull it lies. */
static void face_box(const struct mesh *m, const int face[6], double low[3], double high[3])
{
    for (int c = 0; c < 3; c++) {
        low[c] = INFINITY;
        high[c] = -INFINITY;
        for (int i = 0; i < 3; i++) {
            double p = m->at[face[i]][c], q = 2 * m->at[face[3 + i]][c] - 0.5 * (p + m->at[face[(i + 1) % 3]][c]);
            low[c] = fmin(low[c], fmin(p, q));
            high[c] = fmax(high[c], fmax(p, q));
        }
    }
}

/* Place and unit normal of a point whose face, u and v are known. */
static void face_point(const struct mesh *m, const struct boundary *b, struct boundary_point *p)
{
    struct boundary_face_at x;
    boundary_face_at(m, b->face[p->face], (double[2]){p->u, p->v}, &x);
    double length = sqrt(boundary_dot(x.across, x.across));
    for (int c = 0; c < 3; c++) {
        p->at[c] = x.at[c];
        p->normal[c] = x.across[c] / length;
    }
}

/* Largest extent, m. */
static double extent(const struct boundary *b)
{
    return fmax(fmax(b->high[0] - b->low[0], b->high[1] - b->low[1]), b->high[2] - b->low[2]);
}

void boundary_weights(double u, double v, double w[6])
{
    double t = 1 - u - v;
    w[0] = t * (2 * t - 1);
    w[1] = u * (2 * u - 1);
    w[2] = v * (2 * v - 1);
    w[3] = 4 * t * u;
    w[4] = 4 * u * v;
    w[5] = 4 * v * t;
}

static void outer_faces(const struct mesh *m, struct arena *a, struct boundary *b)
{
    struct topology_face *f = topology_faces(m, a);
    bool *outer = ARENA_TAKE(a, bool, 4 * (size_t)m->elements);
    int n = 4 * m->elements;
    for (int i = 0, alike; i < n; i += alike) {
        alike = topology_faces_alike(f + i, n - i);
        outer[4 * f[i].element + f[i].side] = alike == 1;
        b->n += alike == 1;
    }
    b->face = arena_take(a, (size_t)b->n, sizeof *b->face);
    for (int i = 0, k = 0; i < n; i++)
        if (outer[i]) {
            for (int c = 0; c < 6; c++)
                b->face[k][c] = m->element[i / 4][topology_face_nodes[i % 4][c]];
            k++;
        }
}

static void measure_face(const struct mesh *m, const int face[6], double *area, double *volume)
{
    const double root = sqrt(15), p = (6 - root) / 21, q = (6 + root) / 21, wp = (155 - root) / 2400,
                 wq = (155 + root) / 2400;
    const double rule[7][3] = {{1. / 3, 1. / 3, 9. / 80}, {p, p, wp}, {p, 1 - 2 * p, wp},
                               {1 - 2 * p, p, wp},        {q, q, wq}, {q, 1 - 2 * q, wq},
                               {1 - 2 * q, q, wq}};
    for (int k = 0; k < 7; k++) {
        struct boundary_face_at x;
        boundary_face_at(m, face, rule[k], &x);
        *area += rule[k][2] * sqrt(boundary_dot(x.across, x.across));
        *volume += rule[k][2] * boundary_dot(x.at, x.across) / 3;
    }
}

/* Faces that share nodes are of one skin; that of a cavity, seen from the solid, has a negative volume. */
static void measure(const struct mesh *m, struct arena *a, struct boundary *b)
{
    int *skin = topology_roots(m->nodes, a);
    double *area = ARENA_TAKE(a, double, m->nodes), *volume = ARENA_TAKE(a, double, m->nodes);
    for (int i = 0; i < b->n; i++)
        for (int c = 1; c < 6; c++)
            topology_join(skin, b->face[i][0], b->face[i][c]);
    for (int i = 0; i < b->n; i++) {
        int of = topology_root_of(skin, b->face[i][0]);
        measure_face(m, b->face[i], &b->area, &b->volume);
        measure_face(m, b->face[i], &area[of], &volume[of]);
    }
    for (int i = 0; i < m->nodes; i++)
        b->outer += volume[i] > 0 ? area[i] : 0;
}

void boundary_make(const struct mesh *m, struct arena *a, struct boundary *b)
{
    *b = (struct boundary){.low = {INFINITY, INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY, -INFINITY}};
    for (int i = 0; i < m->nodes; i++)
        for (int c = 0; c < 3; c++) {
            b->low[c] = fmin(b->low[c], m->at[i][c]);
            b->high[c] = fmax(b->high[c], m->at[i][c]);
        }
    outer_faces(m, a, b);
    b->box = arena_take(a, (size_t)b->n, sizeof *b->box);
    for (int i = 0; i < b->n; i++)
        face_box(m, b->face[i], b->box[i][0], b->box[i][1]);
    measure(m, a, b);
}

/* The nearest point of the surface: of each face that may be nearer than the best so far, |x(u, v) - place|^2 is made
   least over the triangle by Newton's method with active sides: each step goes to the lowest place of the quadratic
   model within the triangle, halved until the distance falls. */

enum { NEAREST_STEPS = 40, NEAREST_STARTS = 4 };

static const double nearest_starts[NEAREST_STARTS][2] = {
    {1. / 6, 1. / 6}, {2. / 3, 1. / 6}, {1. / 6, 2. / 3}, {1. / 3, 1. / 3}};

struct model { /* g . s + s . H s / 2 */
    double g[2], h[3];
};

static double model_at(const struct model *q, const double s[2])
{
    return q->g[0] * s[0] + q->g[1] * s[1] +
           0.5 * (q->h[0] * s[0] * s[0] + 2 * q->h[1] * s[0] * s[1] + q->h[2] * s[1] * s[1]);
}

static double squared(const struct mesh *m, const int face[6], const double uv[2], const double place[3])
{
    struct boundary_face_at x;
    boundary_face_at(m, face, uv, &x);
    double d[3] = {x.at[0] - place[0], x.at[1] - place[1], x.at[2] - place[2]};
    return boundary_dot(d, d);
}

/* Of half the squared distance; without the bend where that leaves no lowest place. */
static struct model model_make(const struct mesh *m, const int face[6], const double uv[2], const double place[3])
{
    struct boundary_face_at x;
    static const double second[3][6] = {{4, 4, 0, -8, 0, 0}, {4, 0, 0, -4, 4, -4}, {4, 0, 4, 0, 0, -8}};
    double bend[3][3] = {{0}};
    boundary_face_at(m, face, uv, &x);
    for (int k = 0; k < 3; k++) /* d2x/du2, d2x/dudv, d2x/dv2: the same in all of the face */
        for (int i = 0; i < 6; i++)
            for (int c = 0; c < 3; c++)
                bend[k][c] += second[k][i] * m->at[face[i]][c];
    double d[3] = {x.at[0] - place[0], x.at[1] - place[1], x.at[2] - place[2]};
    struct model q = {{boundary_dot(d, x.du), boundary_dot(d, x.dv)},
                      {boundary_dot(x.du, x.du), boundary_dot(x.du, x.dv), boundary_dot(x.dv, x.dv)}},
                 full = q;
    for (int k = 0; k < 3; k++)
        full.h[k] += boundary_dot(d, bend[k]);
    double det = full.h[0] * full.h[2] - full.h[1] * full.h[1];
    return full.h[0] > 0 && det > 1e-6 * q.h[0] * q.h[2] ? full : q;
}

/* The step from uv to the lowest place of the model on the side from a to b. */
static void along_side(const struct model *q, const double uv[2], const double a[2], const double b[2], double s[2])
{
    double from[2] = {a[0] - uv[0], a[1] - uv[1]}, d[2] = {b[0] - a[0], b[1] - a[1]};
    double slope = d[0] * (q->g[0] + q->h[0] * from[0] + q->h[1] * from[1]) +
                   d[1] * (q->g[1] + q->h[1] * from[0] + q->h[2] * from[1]);
    double curve = q->h[0] * d[0] * d[0] + 2 * q->h[1] * d[0] * d[1] + q->h[2] * d[1] * d[1];
    double t = curve > 0 ? fmin(fmax(-slope / curve, 0), 1) : 0;
    s[0] = from[0] + t * d[0];
    s[1] = from[1] + t * d[1];
}

static void lowest(const struct model *q, const double uv[2], double s[2])
{
    static const double corner[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    double det = q->h[0] * q->h[2] - q->h[1] * q->h[1], best = INFINITY;
    if (det > 0) {
        s[0] = (q->h[1] * q->g[1] - q->h[2] * q->g[0]) / det;
        s[1] = (q->h[1] * q->g[0] - q->h[0] * q->g[1]) / det;
        if (uv[0] + s[0] >= 0 && uv[1] + s[1] >= 0 && uv[0] + s[0] + uv[1] + s[1] <= 1) return;
    }
    for (int i = 0; i < 3; i++) {
        double t[2];
        along_side(q, uv, corner[i], corner[(i + 1) % 3], t);
        if (model_at(q, t) < best) {
            best = model_at(q, t);
            s[0] = t[0];
            s[1] = t[1];
        }
    }
}

/* Moves uv to a lowest place; returns the squared distance there. */
static double descend(const struct mesh *m, const int face[6], double uv[2], const double place[3])
{
    double d = squared(m, face, uv, place);
    for (int i = 0; i < NEAREST_STEPS; i++) {
        struct model q = model_make(m, face, uv, place);
        double s[2] = {0, 0};
        lowest(&q, uv, s);
        for (double part = 1;; part /= 2) {
            double to[2] = {uv[0] + part * s[0], uv[1] + part * s[1]}, there = squared(m, face, to, place);
            if (part * (fabs(s[0]) + fabs(s[1])) < 1e-13) return d;
            if (there > d) continue;
            d = there;
            uv[0] = to[0];
            uv[1] = to[1];
            break;
        }
    }
    return d;
}

static double box_distance(double box[2][3], const double place[3])
{
    double d = 0;
    for (int c = 0; c < 3; c++) {
        double off = fmax(fmax(box[0][c] - place[c], place[c] - box[1][c]), 0);
        d += off * off;
    }
    return sqrt(d);
}

double boundary_nearest(const struct mesh *m, const struct boundary *b, const double place[3], struct boundary_point *p)
{
    double best = INFINITY, tie = 1e-12 * extent(b);
    for (int i = 0; i < b->n; i++) {
        if (box_distance(b->box[i], place) >= best - tie) continue;
        for (int k = 0; k < NEAREST_STARTS; k++) {
            double uv[2] = {nearest_starts[k][0], nearest_starts[k][1]}, d = sqrt(descend(m, b->face[i], uv, place));
            if (d < best - tie) {
                best = d;
                p->face = i;
                p->u = fmax(uv[0], 0);
                p->v = fmax(uv[1], 0);
            }
        }
    }
    face_point(m, b, p);
    return best;
}

/* Where a ray meets the surface: of each face whose box it passes, the two equations e_i . (x(u, v) - from) = 0, e_1
   and e_2 across the ray, by Newton's method from seven places (a ray may cross a bent face more than once). */

enum { RAY_STEPS = 30, RAY_STARTS = 7 };

static const double ray_starts[RAY_STARTS][2] = {{1. / 3, 1. / 3}, {0, 0},     {1, 0},  {0, 1},
                                                 {0.5, 0},         {0.5, 0.5}, {0, 0.5}};
static const double inside = 1e-9; /* of u and v: so far beyond an edge still counts */

struct ray {
    const struct mesh *m;
    const double *from, *along;
    double across[2][3], size;
};

static void ray_frame(struct ray *r)
{
    int least = 0;
    for (int c = 1; c < 3; c++)
        if (fabs(r->along[c]) < fabs(r->along[least])) least = c;
    double length = 0;
    for (int c = 0; c < 3; c++) {
        r->across[0][c] = (c == least) - r->along[least] * r->along[c];
        length += r->across[0][c] * r->across[0][c];
    }
    for (int c = 0; c < 3; c++)
        r->across[0][c] /= sqrt(length);
    for (int c = 0; c < 3; c++) {
        int d = (c + 1) % 3, e = (c + 2) % 3;
        r->across[1][c] = r->along[d] * r->across[0][e] - r->along[e] * r->across[0][d];
    }
}

/* Does it pass the box, made larger by a millionth of the size, not wholly behind `from`? */
static bool passes(const struct ray *r, const double low[3], const double high[3])
{
    double first = -1e-9 * r->size, last = INFINITY;
    for (int c = 0; c < 3; c++) {
        double l = low[c] - 1e-6 * r->size - r->from[c], h = high[c] + 1e-6 * r->size - r->from[c];
        if (fabs(r->along[c]) < 1e-300) {
            if (l > 0 || h < 0) return false;
            continue;
        }
        l /= r->along[c];
        h /= r->along[c];
        first = fmax(first, fmin(l, h));
        last = fmin(last, fmax(l, h));
        if (first > last) return false;
    }
    return true;
}

/* From (u, v) to a place on the ray; false: none was found within the face. *t: how far along the ray. */
static bool newton(const struct ray *r, const int face[6], double uv[2], double *t)
{
    for (int i = 0; i < RAY_STEPS; i++) {
        struct boundary_face_at x;
        boundary_face_at(r->m, face, uv, &x);
        double d[3] = {x.at[0] - r->from[0], x.at[1] - r->from[1], x.at[2] - r->from[2]};
        double f = boundary_dot(r->across[0], d), g = boundary_dot(r->across[1], d);
        *t = boundary_dot(r->along, d);
        double fu = boundary_dot(r->across[0], x.du), fv = boundary_dot(r->across[0], x.dv);
        double gu = boundary_dot(r->across[1], x.du), gv = boundary_dot(r->across[1], x.dv), det = fu * gv - fv * gu;
        if (fabs(det) <= 1e-12 * boundary_dot(x.du, x.du)) return false;
        double su = (fv * g - gv * f) / det, sv = (gu * f - fu * g) / det;
        uv[0] += su;
        uv[1] += sv;
        if (!(fabs(uv[0]) < 10 && fabs(uv[1]) < 10)) return false;
        if (fabs(su) + fabs(sv) < 1e-14 || (i > 6 && fabs(su) + fabs(sv) < 1e-12))
            return uv[0] >= -inside && uv[1] >= -inside && uv[0] + uv[1] <= 1 + inside;
    }
    return false;
}

/* Is the face's nearest meeting, if there is one in front of `from`, nearer than *best by more than rounding? */
static bool nearer(const struct ray *r, const int face[6], struct boundary_point *p, double *best)
{
    bool found = false;
    for (int i = 0; i < RAY_STARTS; i++) {
        double uv[2] = {ray_starts[i][0], ray_starts[i][1]}, t;
        if (newton(r, face, uv, &t) && t >= -1e-12 * r->size && t < *best - 1e-10 * r->size) {
            *best = t;
            p->u = fmin(fmax(uv[0], 0), 1);
            p->v = fmin(fmax(uv[1], 0), 1 - p->u);
            found = true;
        }
    }
    return found;
}

bool boundary_ray(const struct mesh *m, const struct boundary *b, const double from[3], const double along[3],
                  struct boundary_point *p)
{
    struct ray r = {.m = m, .from = from, .along = along, .size = extent(b)};
    double best = INFINITY;
    ray_frame(&r);
    p->face = -1;
    for (int i = 0; i < b->n; i++)
        if (passes(&r, b->box[i][0], b->box[i][1]) && nearer(&r, b->face[i], p, &best)) p->face = i;
    if (p->face < 0) return false;
    face_point(m, b, p);
    return true;
}

const char *const boundary_map_sides[BOUNDARY_SIDES + 1] = {"top",   "bottom", "right",  "left", "back",
                                                            "front", "around", "inside", NULL};

static const struct view {
    int across[2], along; /* axes of the place, axis that is looked along */
    double side;          /* of which we look from                        */
} views[] = {
    [BOUNDARY_TOP] = {{0, 1}, 2, 1},   [BOUNDARY_BOTTOM] = {{0, 1}, 2, -1}, [BOUNDARY_RIGHT] = {{1, 2}, 0, 1},
    [BOUNDARY_LEFT] = {{1, 2}, 0, -1}, [BOUNDARY_BACK] = {{0, 2}, 1, 1},    [BOUNDARY_FRONT] = {{0, 2}, 1, -1}};

void boundary_map_make(const struct mesh *m, const struct boundary *b, int face, struct boundary_map *c)
{
    *c = (struct boundary_map){.mesh = m, .boundary = b, .face = face};
    c->radius = 0.5 * fmin(b->high[0] - b->low[0], b->high[1] - b->low[1]);
    if (face >= BOUNDARY_AROUND) {
        c->high[0] = 2.0 * REAL_PI * c->radius;
        c->low[1] = b->low[2];
        c->high[1] = b->high[2];
        return;
    }
    for (int i = 0; i < 2; i++) {
        c->low[i] = b->low[views[face].across[i]];
        c->high[i] = b->high[views[face].across[i]];
    }
}

bool boundary_map_point(const struct boundary_map *c, double x, double y, struct boundary_point *p)
{
    double from[3] = {0, 0, y}, along[3] = {0}, far = 0;
    for (int i = 0; i < 3; i++)
        far += fabs(c->boundary->low[i]) + fabs(c->boundary->high[i]);
    if (c->face >= BOUNDARY_AROUND) {
        double side = c->face == BOUNDARY_AROUND ? -1 : 1, angle = x / c->radius;
        along[0] = side * real_cos(angle);
        along[1] = side * real_sin(angle);
        for (int i = 0; i < 2 && side < 0; i++)
            from[i] = -far * along[i];
        return boundary_ray(c->mesh, c->boundary, from, along, p);
    }
    const struct view *v = &views[c->face];
    from[v->across[0]] = x;
    from[v->across[1]] = y;
    from[v->along] = v->side * far;
    along[v->along] = -v->side;
    return boundary_ray(c->mesh, c->boundary, from, along, p);
}
