#include "trajectory/path.h"

#include <math.h>
#include <string.h>

#include "base/stopwatch.h"
#include "num/noise.h"
#include "num/real.h"
#include "num/vecmath.h"
#include "trajectory/series.h"

/* ------------------------------------------------------------------ courses */

void path_course_speed(const void *self, size_t n, const double *w, double *g, double *dg)
{
    const struct course *c = self;
    double d[2][PATH_CHUNK], dd[2][PATH_CHUNK];
    for (size_t first = 0; first < n; first += PATH_CHUNK) {
        size_t some = n - first < PATH_CHUNK ? n - first : PATH_CHUNK;
        c->at(c, some, w + first, &(struct course_out){.d = {d[0], d[1]}, .dd = {dd[0], dd[1]}});
        for (size_t i = 0; i < some; i++) {
            double speed = sqrt(d[0][i] * d[0][i] + d[1][i] * d[1][i]);
            g[first + i] = speed;
            dg[first + i] = speed > 0 ? (d[0][i] * dd[0][i] + d[1][i] * dd[1][i]) / speed
                                      : sqrt(dd[0][i] * dd[0][i] + dd[1][i] * dd[1][i]);
        }
    }
}

static void cubic_course_at(const struct course *c, size_t n, const double *w, const struct course_out *out)
{
    const struct cubic *axis = c->state;
    size_t i = 0;
    for (size_t k = 0; k < n; k++) {
        i = series_cubic_next(axis->n, axis->at, i, w[k]);
        for (int xy = 0; xy < 2; xy++) {
            double v[4];
            series_cubic_at(&axis[xy], i, w[k], v);
            if (out->p[xy]) out->p[xy][k] = v[0];
            if (out->d[xy]) out->d[xy][k] = v[1];
            if (out->dd[xy]) out->dd[xy][k] = v[2];
            if (out->ddd[xy]) out->ddd[xy][k] = v[3];
        }
    }
}

static void cubic_course(struct course *c, size_t n, const double *knots, const double (*p)[2], struct arena *a)
{
    struct cubic *axis = ARENA_TAKE(a, struct cubic, 2);
    double *one = ARENA_TAKE(a, double, n);
    for (int xy = 0; xy < 2; xy++) {
        for (size_t i = 0; i < n; i++)
            one[i] = p[i][xy];
        series_cubic_natural(&axis[xy], n, knots, one, a);
    }
    *c = (struct course){.end = knots[n - 1], .breaks = knots, .n_breaks = n, .at = cubic_course_at, .state = axis};
}

static void course_cut(struct course *c, double end, struct arena *a)
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

/* ------------------------------------------------------------------ scribbles */

/* A hand's wandering loops: on each axis a sum of sines

     x(t) = center + size / 2 sum_k a_k sin(2 pi f_k t + phi_k),   sum_k a_k = 1,   k = 1 .. 4

   f_k = rate 2^(e), e evenly drawn from [-0.7, 0.7], so that no two frequencies have a common period; a_k in proportion
   to numbers evenly drawn from [0.5, 1]; phi_k from a whole turn. All come from the seed alone: a longer scribble
   begins as a shorter one. The box is never left, and filled as time goes on. Sums of sines of a narrow band on both
   axes are near to ellipses at every instant, and an ellipse drawn by two sines obeys the two-thirds power law exactly
   (F. Lacquaniti, C. Terzuolo, P. Viviani, Acta Psychologica 54 (1983) 115).

   The argument of a sine is rounded once: after n loops its phase is off by at most 2 pi n 1.6 2^-53. */

enum { SINES = 4, BREAKS_PER_LOOP = 8 };

struct scribble {
    double center[2], half[2];
    double turns[2][SINES]; /* half turns per s */
    double phase[2][SINES]; /* half turns       */
    double share[2][SINES];
};

/* y[i] = (k == 0 ? start : y[i]) + size * wave[i] */
static void add_wave(size_t n, double *y, bool first, double start, double size, const double *wave)
{
    for (size_t i = 0; y && i < n; i++)
        y[i] = (first ? start : y[i]) + size * wave[i];
}

static void scribble_axis(const struct scribble *s, int xy, size_t n, const double *w, const struct course_out *out,
                          size_t at)
{
    double sine[PATH_CHUNK], cosine[PATH_CHUNK];
    for (int k = 0; k < SINES; k++) {
        double size = s->half[xy] * s->share[xy][k], omega = REAL_PI * s->turns[xy][k];
        for (size_t i = 0; i < n; i++)
            sine[i] = s->turns[xy][k] * w[i] + s->phase[xy][k];
        vecmath_sincospi(n, sine, sine, cosine);
        add_wave(n, out->p[xy] ? out->p[xy] + at : NULL, k == 0, s->center[xy], size, sine);
        add_wave(n, out->d[xy] ? out->d[xy] + at : NULL, k == 0, 0, size * omega, cosine);
        add_wave(n, out->dd[xy] ? out->dd[xy] + at : NULL, k == 0, 0, -size * omega * omega, sine);
        add_wave(n, out->ddd[xy] ? out->ddd[xy] + at : NULL, k == 0, 0, -size * omega * omega * omega, cosine);
    }
}

static void scribble_at(const struct course *c, size_t n, const double *w, const struct course_out *out)
{
    for (size_t first = 0; first < n; first += PATH_CHUNK)
        for (int xy = 0; xy < 2; xy++)
            scribble_axis(c->state, xy, n - first < PATH_CHUNK ? n - first : PATH_CHUNK, w + first, out, first);
}

/* Row 3 xy + k of the stream: exponent, share, phase (k = 0, 1, 2), one column for each sine. */
static struct scribble scribble_draw(const struct motion *m, uint64_t seed)
{
    struct noise stream = noise_make(seed, "scribble");
    struct scribble s;
    for (int xy = 0; xy < 2; xy++) {
        double sum = 0;
        s.center[xy] = m->center[xy];
        s.half[xy] = m->size[xy] / 2;
        for (int k = 0; k < SINES; k++) {
            uint64_t row = (uint64_t)(3 * xy), column = (uint64_t)k;
            s.turns[xy][k] = 2 * m->rate * real_pow(2, 0.7 * (2 * noise_uniform(stream, row, column) - 1));
            s.share[xy][k] = 0.5 + 0.5 * noise_uniform(stream, row + 1, column);
            s.phase[xy][k] = 2 * noise_uniform(stream, row + 2, column);
            sum += s.share[xy][k];
        }
        for (int k = 0; k < SINES; k++)
            s.share[xy][k] /= sum;
    }
    return s;
}

void path_scribble(struct course *c, const struct motion *m, uint64_t seed, double end, struct arena *a)
{
    struct scribble *s = ARENA_TAKE(a, struct scribble, 1);
    size_t pieces = (size_t)ceil(end * m->rate * BREAKS_PER_LOOP) + 1;
    double *breaks = ARENA_TAKE(a, double, pieces + 1);
    for (size_t i = 0; i <= pieces; i++)
        breaks[i] = i == pieces ? end : end * (double)i / (double)pieces;
    *s = scribble_draw(m, seed);
    *c = (struct course){.end = end, .breaks = breaks, .n_breaks = pieces + 1, .at = scribble_at, .state = s};
}

/* ------------------------------------------------------------------ recordings */

/* Positions over time from a CSV become C2 functions of time: cubic splines, at times that need not be evenly spaced
   (trajectory/series.h).

   With motion.cutoff they are smoothing splines, which a sine at that frequency passes with half its power, one at half
   of it with 0.95, at twice it with 0.02; with cutoff 0 they go through the rows. Both have no acceleration at their
   two ends. */

static const double FARTHEST = 100; /* m, as everywhere in a scene */

static bool recorded_near(const struct motion *m, const struct series *s, struct err *e)
{
    for (size_t i = 0; i < s->n; i++)
        for (int k = 0; k < 2; k++)
            if (fabs(s->x[k][i]) > FARTHEST)
                return err_set(e, ERR_SCENE,
                               "%s:%d: column '%s': %.9g m is farther than %g m from the origin; positions are in "
                               "metres: mend the row, or the unit",
                               m->file, s->lines[i], k ? "y_m" : "x_m", s->x[k][i], FARTHEST);
    return true;
}

static bool recorded_smooth(const struct motion *m, const struct series *s, struct arena *a, struct err *e)
{
    double rate = (double)(s->n - 1) / (s->time[s->n - 1] - s->time[0]);
    if (m->cutoff == 0) return true;
    if (s->n < 3)
        return err_set(e, ERR_SCENE, "%s: 2 rows cannot be smoothed; give motion.cutoff: 0 Hz, or more rows", m->file);
    if (m->cutoff >= rate / 2)
        return err_set(e, ERR_SCENE,
                       "motion.cutoff: %.6g Hz is not below half of the %.6g rows per second of %s; lower it, or set "
                       "it to 0 Hz: then the rows are "
                       "interpolated",
                       m->cutoff, rate, m->file);
    for (int k = 0; k < 2; k++)
        series_cubic_smooth(s->n, s->time, s->x[k], m->cutoff, s->x[k], a);
    return true;
}

static bool recorded_moves(const struct motion *m, const struct series *s, struct err *e)
{
    for (size_t i = 1; i < s->n; i++)
        if (s->x[0][i] != s->x[0][0] || s->x[1][i] != s->x[1][0]) return true;
    return err_set(e, ERR_SCENE, "%s: all positions are the same: nothing moves: give motion.path: still instead",
                   m->file);
}

bool path_recorded(const struct motion *m, double duration, struct arena *a, struct course *c, double *clock,
                   struct err *e)
{
    static const char *const columns[2] = {"x_m", "y_m"};
    struct series s;
    if (!series_read(m->file, columns, a, &s, e) || !series_spaced(&s, m->file, e) || !recorded_near(m, &s, e) ||
        !recorded_moves(m, &s, e))
        return false;
    *clock = s.time[0];
    for (size_t i = 0; i < s.n; i++)
        s.time[i] -= *clock;
    double(*p)[2] = arena_take(a, s.n, sizeof *p), whole = s.time[s.n - 1];
    if (!isnan(duration) && duration > whole * (1 + 1e-9))
        return err_set(e, ERR_SCENE,
                       "motion.duration: %.9g s is longer than the %.9g s of %s; leave it out, or lower it", duration,
                       whole, m->file);
    if (!recorded_smooth(m, &s, a, e)) return false;
    for (size_t i = 0; i < s.n; i++)
        p[i][0] = s.x[0][i], p[i][1] = s.x[1][i];
    cubic_course(c, s.n, s.time, (const double(*)[2])p, a);
    if (!isnan(duration) && duration < whole) course_cut(c, duration, a);
    return true;
}

/* ------------------------------------------------------------------ a course over its own length */

/* A course over its own length: s(w) = integral of |P'| dw, turned round into w(s) (trajectory/panels.h: within 1e-13
   m), then

     e = P' / |P'|,   de/ds = (P'' - (P'' . e) e) / |P'|^2,   kappa^2 = (x' y'' - y' x'')^2 / |P'|^6

   Beyond its ends w goes on in proportion to s. */

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

static struct path_out out_from(const struct path_out *out, size_t first)
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
        struct path_out here = out_from(out, from);
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
    path_course_speed(c, PATH_CHUNK, w, g, dg);
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
    struct panels_slope slope = {path_course_speed, &arc->course};
    if (!panels_inverse(&slope, course->breaks, course->n_breaks, CUSP * arc_scale(course), a, &arc->w, where) ||
        arc_turns(arc, where))
        return false;
    double *breaks = ARENA_TAKE(a, double, arc->w.n + 1);
    path_course_speed(course, 2, ends, g, dg);
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

/* ------------------------------------------------------------------ circles */

/* Round a centre:

     P(s) = center + radius (cos a, sin a),   a = start_angle + s / radius (counter-clockwise; turns < 0: minus)

   s runs to 2 pi radius |turns|, and round on beyond. The angle is taken in half turns, 2 turns s / length: after n
   turns it is off by at most 2 pi n 2^-52 rad. */

struct circle {
    double center[2], radius, start, per_length; /* start: half turns; per_length: half turns per m */
};

static void circle_at(const struct path *p, size_t n, const double *s, const struct path_out *out)
{
    const struct circle *c = p->state;
    double sine[PATH_CHUNK], cosine[PATH_CHUNK], sense = c->per_length < 0 ? -1 : 1;
    for (size_t from = 0; from < n; from += PATH_CHUNK) {
        size_t some = n - from < PATH_CHUNK ? n - from : PATH_CHUNK;
        for (size_t i = 0; i < some; i++)
            sine[i] = c->start + c->per_length * s[from + i];
        vecmath_sincospi(some, sine, sine, cosine);
        for (size_t i = 0; i < some; i++) {
            const double at[2] = {cosine[i], sine[i]}, ahead[2] = {-sense * sine[i], sense * cosine[i]};
            for (int xy = 0; xy < 2; xy++) {
                if (out->p[xy]) out->p[xy][from + i] = c->center[xy] + c->radius * at[xy];
                if (out->e[xy]) out->e[xy][from + i] = ahead[xy];
                if (out->bend[xy]) out->bend[xy][from + i] = -at[xy] / c->radius;
            }
        }
    }
}

void path_circle(struct path *p, const struct motion *m, struct arena *a)
{
    struct circle *c = ARENA_TAKE(a, struct circle, 1);
    double length = 2 * REAL_PI * m->radius * fabs(m->turns), *strokes = ARENA_TAKE(a, double, 2);
    *c = (struct circle){.center = {m->center[0], m->center[1]},
                         .radius = m->radius,
                         .start = m->start_angle / REAL_PI,
                         .per_length = 2 * m->turns / length};
    strokes[1] = length;
    *p = (struct path){.length = length, .n_strokes = 1, .strokes = strokes, .at = circle_at, .state = c};
}

/* ------------------------------------------------------------------ splines */

/* Smooth through points: the natural cubic spline of x and y over the length of the chords from point to point, which
   is C2, read over its own length (path.c). */

bool path_spline(struct path *p, const struct motion *m, struct arena *a, struct err *e)
{
    size_t n = (size_t)m->n_points;
    double *knots = ARENA_TAKE(a, double, n), (*points)[2] = arena_take(a, n, sizeof *points), where;
    struct course course;
    for (size_t i = 0; i < n; i++) {
        points[i][0] = m->points[2 * i];
        points[i][1] = m->points[2 * i + 1];
        double x = i > 0 ? points[i][0] - points[i - 1][0] : 1, y = i > 0 ? points[i][1] - points[i - 1][1] : 0,
               chord = sqrt(x * x + y * y);
        if (chord < 1e-9)
            return err_set(e, ERR_SCENE, "motion.points: points %zu and %zu are in one place; leave one of them out", i,
                           i + 1);
        knots[i] = i > 0 ? knots[i - 1] + chord : 0;
    }
    cubic_course(&course, n, knots, (const double(*)[2])points, a);
    if (path_arc(p, &course, a, &where)) return true;
    size_t near = 1;
    while (near + 1 < n && knots[near] < where)
        near++;
    return err_set(e, ERR_SCENE,
                   "motion.points: the spline has a cusp between points %zu and %zu, where its direction is not "
                   "defined; move one of them a "
                   "little, or use path: polyline",
                   near, near + 1);
}

/* ------------------------------------------------------------------ polylines */

/* Straight from point to point. With motion.corner > 0 a corner of turning angle phi is rounded by a curve of length L
   = 2 |phi| corner, on which the heading turns by

     psi(z) = phi (z - sin(2 pi z) / (2 pi)),   kappa = 2 phi / L sin^2(pi z),   z = s / L from 0 to 1

   so that curvature, and with it the acceleration, is continuous (on a circle's arc it would jump); corner is the
   smallest radius. The curve leaves the straight d before the point, d = X(1/2) + Y(1/2) tan(phi / 2), where X, Y = L
   integral of cos psi, sin psi dz is its shape in the direction of the straight (trajectory/panels.h: within 1e-13 L).
   Without rounding each straight is a stroke. */

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

struct corner_slope {
    double turn;
    bool sine;
};

/* cos psi, or sin psi. */
static void corner_slope(const void *self, size_t n, const double *z, double *g, double *dg)
{
    const struct corner_slope *c = self;
    stopwatch_spend(300.0 * (double)n);
    for (size_t i = 0; i < n; i++) {
        double psi = c->turn * corner_psi(z[i]), sine = real_sin(psi), cosine = real_cos(psi);
        g[i] = c->sine ? sine : cosine;
        dg[i] = (c->sine ? cosine : -sine) * c->turn * (1 - real_cospi(2 * z[i]));
    }
}

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

/* Shape of a corner, and how much of the straights it takes. */
static double corner_make(struct line_piece *w, double turn, double radius, struct arena *a)
{
    static const double whole[3] = {0, 0.5, 1};
    double half = 0.5, x, y;
    w->turn = turn;
    w->length = 2 * fabs(turn) * radius;
    panels_integral(&(struct panels_slope){corner_slope, &(struct corner_slope){turn, false}}, whole, 3, a, &w->x);
    panels_integral(&(struct panels_slope){corner_slope, &(struct corner_slope){turn, true}}, whole, 3, a, &w->y);
    panels_at(&w->x, 1, &half, &x, NULL, NULL);
    panels_at(&w->y, 1, &half, &y, NULL, NULL);
    return w->length * (x + y * real_tan(turn / 2));
}

static bool side_of(const struct motion *m, size_t k, double e[2], double *length, struct err *e_out)
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

/* One straight, and the corner at its end if there is one. taken: m of the straight that the corner before it has;
 * becomes that of the next. */
static bool side_put(struct polyline *l, const struct motion *m, size_t k, double *taken, struct arena *a,
                     struct err *err)
{
    double e[2], next[2], length, next_length, room = 0;
    struct line_piece corner = {.turn = 0};
    bool last = k + 2 == (size_t)m->n_points;
    if (!side_of(m, k, e, &length, err) || (!last && !side_of(m, k + 1, next, &next_length, err)) ||
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
    if (corner.turn != 0) {
        const double *point = m->points + 2 * (k + 1), begin[2] = {point[0] - room * e[0], point[1] - room * e[1]};
        struct line_piece *w = piece_put(l, begin, e);
        w->turn = corner.turn;
        w->length = corner.length;
        w->x = corner.x;
        w->y = corner.y;
    }
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
