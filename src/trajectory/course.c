/* Speed along a curve, |P'| = sqrt(x'^2 + y'^2), and what it changes by: P' . P'' / |P'|. See course.h. */
#include "trajectory/course.h"

#include <math.h>

#include "trajectory/cubic.h"
#include "trajectory/knots.h"

void course_speed(const void *self, size_t n, const double *w, double *g, double *dg)
{
    const struct course *c = self;
    double d[2][COURSE_CHUNK], dd[2][COURSE_CHUNK];
    for (size_t first = 0; first < n; first += COURSE_CHUNK) {
        size_t some = n - first < COURSE_CHUNK ? n - first : COURSE_CHUNK;
        c->at(c, some, w + first, &(struct course_out){.d = {d[0], d[1]}, .dd = {dd[0], dd[1]}});
        for (size_t i = 0; i < some; i++) {
            double speed = sqrt(d[0][i] * d[0][i] + d[1][i] * d[1][i]);
            g[first + i] = speed;
            dg[first + i] = speed > 0 ? (d[0][i] * dd[0][i] + d[1][i] * dd[1][i]) / speed
                                      : sqrt(dd[0][i] * dd[0][i] + dd[1][i] * dd[1][i]);
        }
    }
}

static void course_cubic_at(const struct course *c, size_t n, const double *w, const struct course_out *out)
{
    const struct cubic *axis = c->state;
    size_t i = 0;
    for (size_t k = 0; k < n; k++) {
        i = knots_next(axis->n, axis->at, i, w[k]);
        for (int xy = 0; xy < 2; xy++) {
            double v[4];
            cubic_at(&axis[xy], i, w[k], v);
            if (out->p[xy]) out->p[xy][k] = v[0];
            if (out->d[xy]) out->d[xy][k] = v[1];
            if (out->dd[xy]) out->dd[xy][k] = v[2];
            if (out->ddd[xy]) out->ddd[xy][k] = v[3];
        }
    }
}

void course_cubic(struct course *c, size_t n, const double *knots, const double (*p)[2], struct arena *a)
{
    struct cubic *axis = ARENA_TAKE(a, struct cubic, 2);
    double *one = ARENA_TAKE(a, double, n);
    for (int xy = 0; xy < 2; xy++) {
        for (size_t i = 0; i < n; i++)
            one[i] = p[i][xy];
        cubic_natural(&axis[xy], n, knots, one, a);
    }
    *c = (struct course){.end = knots[n - 1], .breaks = knots, .n_breaks = n, .at = course_cubic_at, .state = axis};
}

void course_cut(struct course *c, double end, struct arena *a)
{
    double *breaks = ARENA_TAKE(a, double, c->n_breaks + 1);
    size_t n = 0;
    for (; n < c->n_breaks && c->breaks[n] < end; n++)
        breaks[n] = c->breaks[n];
    breaks[n] = end;
    c->breaks = breaks;
    c->n_breaks = n + 1;
    c->end = end;
}
