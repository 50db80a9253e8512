/* The nearest point of the surface: of each face that may be nearer than the best so far, |x(u, v) - place|^2 is made
   least over the triangle by Newton's method with active sides: each step goes to the lowest place of the quadratic
   model within the triangle, halved until the distance falls. */
#include <math.h>

#include "fem/boundary_face.h"

enum { STEPS = 40, STARTS = 4 };

static const double starts[STARTS][2] = {{1. / 6, 1. / 6}, {2. / 3, 1. / 6}, {1. / 6, 2. / 3}, {1. / 3, 1. / 3}};

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
    return boundary_face_dot(d, d);
}

/* Of half the squared distance; without the bend where that leaves no lowest place. */
static struct model model_make(const struct mesh *m, const int face[6], const double uv[2], const double place[3])
{
    struct boundary_face_at x;
    double bend[3][3];
    boundary_face_at(m, face, uv, &x);
    boundary_face_bend(m, face, bend);
    double d[3] = {x.at[0] - place[0], x.at[1] - place[1], x.at[2] - place[2]};
    struct model q = {{boundary_face_dot(d, x.du), boundary_face_dot(d, x.dv)},
                      {boundary_face_dot(x.du, x.du), boundary_face_dot(x.du, x.dv), boundary_face_dot(x.dv, x.dv)}},
                 full = q;
    for (int k = 0; k < 3; k++)
        full.h[k] += boundary_face_dot(d, bend[k]);
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
    for (int i = 0; i < STEPS; i++) {
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

static double box_distance(const struct mesh *m, const int face[6], const double place[3])
{
    double low[3], high[3], d = 0;
    boundary_face_box(m, face, low, high);
    for (int c = 0; c < 3; c++) {
        double off = fmax(fmax(low[c] - place[c], place[c] - high[c]), 0);
        d += off * off;
    }
    return sqrt(d);
}

double boundary_nearest(const struct mesh *m, const struct boundary *b, const double place[3], struct boundary_point *p)
{
    double best = INFINITY, tie = 1e-12 * boundary_face_size(b);
    for (int i = 0; i < b->n; i++) {
        if (box_distance(m, b->face[i], place) >= best - tie) continue;
        for (int k = 0; k < STARTS; k++) {
            double uv[2] = {starts[k][0], starts[k][1]}, d = sqrt(descend(m, b->face[i], uv, place));
            if (d < best - tie) {
                best = d;
                p->face = i;
                p->u = fmax(uv[0], 0);
                p->v = fmax(uv[1], 0);
            }
        }
    }
    boundary_face_point(m, b, p);
    return best;
}
