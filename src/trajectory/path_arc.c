/* A course over its own length: s(w) = integral of |P'| dw, turned round into w(s) (trajectory/panels.h: within 1e-13
   m), then

     e = P' / |P'|,   de/ds = (P'' - (P'' . e) e) / |P'|^2,   kappa^2 = (x' y'' - y' x'')^2 / |P'|^6

   Beyond its ends w goes on in proportion to s. */
#include <math.h>

#include "trajectory/path.h"

/* Where |P'| falls below this share of its mean the curve has a cusp: its direction there is not defined. So it has
   where the direction turns by more than 90 degrees within one piece, which is then shorter than 1e-13 m. */
static const double CUSP = 1e-7;

struct arc {
    struct course course;
    struct panels w; /* of s */
    double slope[2]; /* dw/ds at the ends */
};

static void arc_parameter(const struct arc *a, size_t n, const double *s, double *w)
{
    double end = a->w.end;
    panels_at(&a->w, n, s, w, NULL, NULL);
    for (size_t i = 0; i < n; i++)
        if (s[i] < 0)
            w[i] = s[i] * a->slope[0];
        else if (s[i] > end)
            w[i] = a->course.end + (s[i] - end) * a->slope[1];
}

static void arc_directions(size_t n, double *const d[2], double *const dd[2], const struct path_out *out)
{
    for (size_t i = 0; i < n; i++) {
        double speed = sqrt(d[0][i] * d[0][i] + d[1][i] * d[1][i]), e[2] = {d[0][i] / speed, d[1][i] / speed};
        double along = dd[0][i] * e[0] + dd[1][i] * e[1];
        for (int xy = 0; xy < 2; xy++) {
            if (out->e[xy]) out->e[xy][i] = e[xy];
            if (out->bend[xy]) out->bend[xy][i] = (dd[xy][i] - along * e[xy]) / (speed * speed);
        }
    }
}

static struct path_out path_out_from(const struct path_out *out, size_t first)
{
    struct path_out o = {.p = {NULL}};
    for (int xy = 0; xy < 2; xy++) {
        o.p[xy] = out->p[xy] ? out->p[xy] + first : NULL;
        o.e[xy] = out->e[xy] ? out->e[xy] + first : NULL;
        o.bend[xy] = out->bend[xy] ? out->bend[xy] + first : NULL;
    }
    return o;
}

static void arc_at(const struct path *p, size_t n, const double *s, const struct path_out *out)
{
    const struct arc *a = p->state;
    double w[PATH_CHUNK], d[2][PATH_CHUNK], dd[2][PATH_CHUNK];
    for (size_t from = 0; from < n; from += PATH_CHUNK) {
        size_t some = n - from < PATH_CHUNK ? n - from : PATH_CHUNK;
        struct path_out here = path_out_from(out, from);
        arc_parameter(a, some, s + from, w);
        a->course.at(&a->course, some, w,
                     &(struct course_out){.p = {here.p[0], here.p[1]}, .d = {d[0], d[1]}, .dd = {dd[0], dd[1]}});
        arc_directions(some, (double *const[]){d[0], d[1]}, (double *const[]){dd[0], dd[1]}, &here);
    }
}

static void arc_curvature(const struct path *p, size_t n, const double *s, double *square, double *rate)
{
    const struct arc *a = p->state;
    double w[PATH_CHUNK], d[2][PATH_CHUNK], dd[2][PATH_CHUNK], ddd[2][PATH_CHUNK];
    for (size_t from = 0; from < n; from += PATH_CHUNK) {
        size_t some = n - from < PATH_CHUNK ? n - from : PATH_CHUNK;
        arc_parameter(a, some, s + from, w);
        a->course.at(&a->course, some, w,
                     &(struct course_out){.d = {d[0], d[1]}, .dd = {dd[0], dd[1]}, .ddd = {ddd[0], ddd[1]}});
        for (size_t i = 0; i < some; i++) {
            double cross = d[0][i] * dd[1][i] - d[1][i] * dd[0][i], dcross = d[0][i] * ddd[1][i] - d[1][i] * ddd[0][i];
            double q = d[0][i] * d[0][i] + d[1][i] * d[1][i], dq = 2 * (d[0][i] * dd[0][i] + d[1][i] * dd[1][i]),
                   q3 = q * q * q;
            square[from + i] = cross * cross / q3;
            rate[from + i] = cross * (2 * dcross - 3 * cross * dq / q) / (q3 * sqrt(q));
        }
    }
}

/* Mean of |P'|, roughly: only the scale of CUSP. */
static double arc_scale(const struct course *c)
{
    double w[PATH_CHUNK], g[PATH_CHUNK], dg[PATH_CHUNK], sum = 0;
    for (int i = 0; i < PATH_CHUNK; i++)
        w[i] = c->end * (i + 0.5) / PATH_CHUNK;
    course_speed(c, PATH_CHUNK, w, g, dg);
    for (int i = 0; i < PATH_CHUNK; i++)
        sum += g[i];
    return sum / PATH_CHUNK;
}

static bool arc_turns(const struct arc *a, double *where)
{
    double before[2] = {0, 0}, v[2];
    for (size_t i = 0; i <= a->w.n; i++, before[0] = v[0], before[1] = v[1]) {
        double w = i < a->w.n ? panels_piece(&a->w, i)->c[0] : a->course.end;
        a->course.at(&a->course, 1, &w, &(struct course_out){.d = {&v[0], &v[1]}});
        *where = w;
        if (before[0] * v[0] + before[1] * v[1] < 0) return true;
    }
    return false;
}

bool path_arc(struct path *p, const struct course *course, struct arena *a, double *where)
{
    struct arc *arc = ARENA_TAKE(a, struct arc, 1);
    double *strokes = ARENA_TAKE(a, double, 2), ends[2] = {0, course->end}, g[2], dg[2];
    arc->course = *course;
    struct panels_slope slope = {course_speed, &arc->course};
    if (!panels_inverse(&slope, course->breaks, course->n_breaks, CUSP * arc_scale(course), a, &arc->w, where) ||
        arc_turns(arc, where))
        return false;
    double *breaks = ARENA_TAKE(a, double, arc->w.n + 1);
    course_speed(course, 2, ends, g, dg);
    arc->slope[0] = 1 / g[0];
    arc->slope[1] = 1 / g[1];
    strokes[1] = arc->w.end;
    for (size_t i = 0; i <= arc->w.n; i++)
        breaks[i] = panels_edge(&arc->w, i);
    *p = (struct path){.length = strokes[1],
                       .n_strokes = 1,
                       .strokes = strokes,
                       .n_breaks = arc->w.n + 1,
                       .breaks = breaks,
                       .at = arc_at,
                       .curvature = arc_curvature,
                       .state = arc};
    return true;
}
