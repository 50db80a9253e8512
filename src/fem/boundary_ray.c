/* Where a ray meets the surface: of each face whose box it passes, the two equations e_i . (x(u, v) - from) = 0, e_1
   and e_2 across the ray, by Newton's method from seven places (a ray may cross a bent face more than once). */
#include <math.h>

#include "fem/boundary_face.h"

enum { STEPS = 30, STARTS = 7 };

static const double starts[STARTS][2] = {{1. / 3, 1. / 3}, {0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
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
    }
    return first <= last;
}

/* From (u, v) to a place on the ray; false: none was found within the face. *t: how far along the ray. */
static bool newton(const struct ray *r, const int face[6], double uv[2], double *t)
{
    for (int i = 0; i < STEPS; i++) {
        struct boundary_face_at x;
        boundary_face_at(r->m, face, uv, &x);
        double d[3] = {x.at[0] - r->from[0], x.at[1] - r->from[1], x.at[2] - r->from[2]};
        double f = boundary_face_dot(r->across[0], d), g = boundary_face_dot(r->across[1], d);
        *t = boundary_face_dot(r->along, d);
        double fu = boundary_face_dot(r->across[0], x.du), fv = boundary_face_dot(r->across[0], x.dv);
        double gu = boundary_face_dot(r->across[1], x.du), gv = boundary_face_dot(r->across[1], x.dv),
               det = fu * gv - fv * gu;
        if (fabs(det) <= 1e-12 * boundary_face_dot(x.du, x.du)) return false;
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
    for (int i = 0; i < STARTS; i++) {
        double uv[2] = {starts[i][0], starts[i][1]}, t;
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
    struct ray r = {.m = m, .from = from, .along = along, .size = boundary_face_size(b)};
    double best = INFINITY, low[3], high[3];
    ray_frame(&r);
    p->face = -1;
    for (int i = 0; i < b->n; i++) {
        boundary_face_box(m, b->face[i], low, high);
        if (passes(&r, low, high) && nearer(&r, b->face[i], p, &best)) p->face = i;
    }
    if (p->face < 0) return false;
    boundary_face_point(m, b, p);
    return true;
}
