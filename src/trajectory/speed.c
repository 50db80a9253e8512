#include "trajectory/speed.h"

#include <math.h>
#include <string.h>

#include "num/lanes.h"
#include "num/real.h"
#include "num/vecmath.h"
#include "trajectory/motion.h"
#include "trajectory/panels.h"
#include "trajectory/series.h"

/* ------------------------------------------------------------------ strokes */

/* Laws in closed form, over a stroke of length l in a time T, q = (t - t0) / T from 0 to 1:

     constant       p = q
     harmonic       p = (1 - cos pi q) / 2                  simple harmonic motion from rest to rest, papers/000 section
                                                            2.3
     minimum jerk   p = 10 q^3 - 15 q^4 + 6 q^5             T. Flash, N. Hogan, J. Neurosci. 5 (1985) 1688

   u = u0 + l p. Strokes follow one another without a pause, each with its share of the duration by length, or go there
   and back: then 2 rate strokes a second between u = 0 and l. So the speeds of back_and_forth and of four_in_line with
   strokes of the same length and time are the same functions of time, and so are those of a circle and a line
   (papers/000 section 3.2).

   Phase: there and back t 2 rate is rounded once, so after n strokes it is off by at most n 2^-53 strokes. */

enum { STROKES_CHUNK = 256, STROKE_DETAIL = 64 };

struct strokes {
    int law;
    bool folded;
    double per_second; /* folded                                        */
    double length;     /* m, of each; NAN: not all the same             */
    double time;       /* s, of each                                    */
    size_t n;
    const double *from; /* [n + 1] m; NULL when folded                   */
    double pace;        /* s per m: duration over the whole length       */
};

static size_t stroke_find(const struct strokes *s, double t)
{
    size_t low = 0, high = s->n - 1;
    while (low < high) {
        size_t middle = (low + high + 1) / 2;
        if (s->from[middle] * s->pace <= t)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

struct strokes_at {
    size_t n;
    double q[STROKES_CHUNK], p[STROKES_CHUNK], dp[STROKES_CHUNK], ddp[STROKES_CHUNK];
    double from[STROKES_CHUNK], length[STROKES_CHUNK],
        time[STROKES_CHUNK]; /* where the stroke starts, its signed length, m; s */
};

LANES_CLONES
static void stroke_folded(const struct strokes *s, struct strokes_at *a, const double *t)
{
    double per_second = s->per_second, length = s->length, time = s->time;
    size_t n = a->n;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double x = t[i] * per_second, k = lanes_floor(x);
        int back = k / 2 != lanes_floor(k / 2);
        a->from[i] = lanes_select(back, length, 0);
        a->length[i] = lanes_select(back, -length, length);
        a->time[i] = time;
        a->q[i] = x - k;
    }
}

LANES_CLONES
static void stroke_even(const struct strokes *s, struct strokes_at *a, const double *t)
{
    double most = (double)(s->n - 1), length = s->length, time = s->time;
    size_t n = a->n;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double x = t[i] / time, k = lanes_floor(x);
        k = lanes_select(k < 0, 0, lanes_select(k > most, most, k));
        a->from[i] = length * k;
        a->length[i] = length;
        a->time[i] = time;
        a->q[i] = x - k;
    }
}

static void stroke_uneven(const struct strokes *s, struct strokes_at *a, const double *t)
{
    for (size_t i = 0; i < a->n; i++) {
        size_t j = stroke_find(s, t[i]);
        a->from[i] = s->from[j];
        a->length[i] = s->from[j + 1] - s->from[j];
        a->time[i] = a->length[i] * s->pace;
        a->q[i] = (t[i] - a->from[i] * s->pace) / a->time[i];
    }
}

LANES_CLONES
static void shape_harmonic(size_t n, double *restrict p, double *restrict dp, double *restrict ddp)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        p[i] = (1 - ddp[i]) / 2;
        dp[i] *= REAL_PI / 2;
        ddp[i] *= REAL_PI * REAL_PI / 2;
    }
}

static void stroke_shape(int law, size_t n, const double *q, double *p, double *dp, double *ddp)
{
    if (law == SPEED_HARMONIC) {
        vecmath_sincospi(n, q, dp, ddp);
        shape_harmonic(n, p, dp, ddp);
    } else if (law == SPEED_MINIMUM_JERK) {
        for (size_t i = 0; i < n; i++) {
            double x = q[i];
            p[i] = x * x * x * (10 + x * (-15 + x * 6));
            dp[i] = 30 * x * x * (1 - x) * (1 - x);
            ddp[i] = 60 * x * (1 - x) * (1 - 2 * x);
        }
    } else {
        for (size_t i = 0; i < n; i++)
            p[i] = q[i], dp[i] = 1, ddp[i] = 0;
    }
}

/* Place, or its first or second derivative over time. */
LANES_CLONES
static void stroke_out(const struct strokes_at *a, int derivative, double *out)
{
    size_t n = a->n;
#pragma omp simd
    for (size_t i = 0; i < (derivative == 0 ? n : 0); i++)
        out[i] = a->from[i] + a->length[i] * a->p[i];
#pragma omp simd
    for (size_t i = 0; i < (derivative == 1 ? n : 0); i++)
        out[i] = a->length[i] / a->time[i] * a->dp[i];
#pragma omp simd
    for (size_t i = 0; i < (derivative == 2 ? n : 0); i++)
        out[i] = a->length[i] / (a->time[i] * a->time[i]) * a->ddp[i];
}

static void strokes_at(const struct speed *speed, size_t n, const double *t, double *u, double *du, double *ddu)
{
    const struct strokes *s = speed->state;
    double *out[3] = {u, du, ddu};
    struct strokes_at a;
    for (size_t first = 0; first < n; first += STROKES_CHUNK) {
        a.n = n - first < STROKES_CHUNK ? n - first : STROKES_CHUNK;
        if (s->folded)
            stroke_folded(s, &a, t + first);
        else if (!isnan(s->length))
            stroke_even(s, &a, t + first);
        else
            stroke_uneven(s, &a, t + first);
        stroke_shape(s->law, a.n, a.q, a.p, a.dp, a.ddp);
        for (int k = 0; k < 3; k++)
            if (out[k]) stroke_out(&a, k, out[k] + first);
    }
}

/* The first border of two strokes behind t0. */
static double folded_turning(const struct speed *speed, double t0, double t1)
{
    const struct strokes *s = speed->state;
    double turn = (floor(s->per_second * t0) + 1) / s->per_second;
    return turn > t0 && turn < t1 && turn < speed->duration ? turn : NAN;
}

static double top_of(int law) { return law == SPEED_HARMONIC ? REAL_PI / 2 : law == SPEED_MINIMUM_JERK ? 1.875 : 1; }

void speed_strokes(struct speed *speed, int law, const struct path *path, double duration, struct arena *a)
{
    struct strokes *s = ARENA_TAKE(a, struct strokes, 1);
    double length = path->length / (double)path->n_strokes;
    *s = (struct strokes){.law = law,
                          .n = path->n_strokes,
                          .from = path->strokes,
                          .pace = duration / path->length,
                          .length = length,
                          .time = duration / (double)path->n_strokes};
    for (size_t i = 0; i < s->n; i++)
        if (fabs(s->from[i] - length * (double)i) > 1e-15 * path->length) s->length = NAN;
    *speed = (struct speed){.duration = duration,
                            .top = path->length / duration * top_of(law),
                            .distance = path->length,
                            .reach = {0, path->length},
                            .cycle = duration,
                            .detail = STROKE_DETAIL * (long)s->n,
                            .at = strokes_at,
                            .state = s};
}

void speed_strokes_folded(struct speed *speed, int law, double length, double rate, double duration, struct arena *a)
{
    struct strokes *s = ARENA_TAKE(a, struct strokes, 1);
    double whole, last, end = duration;
    *s = (struct strokes){
        .law = law, .folded = true, .n = 1, .length = length, .per_second = 2 * rate, .time = 1 / (2 * rate)};
    *speed = (struct speed){.duration = duration,
                            .top = length * 2 * rate * top_of(law),
                            .cycle = fmin(duration, 1 / rate),
                            .detail = 2 * STROKE_DETAIL,
                            .at = strokes_at,
                            .turning = folded_turning,
                            .state = s};
    strokes_at(speed, 1, &end, &last, NULL, NULL);
    whole = floor(duration * s->per_second);
    speed->distance = whole * length + (whole / 2 != floor(whole / 2) ? length - last : last);
    speed->reach[1] = whole >= 1 ? length : last;
}

/* ------------------------------------------------------------------ two-thirds power law */

/* As hands draw (the two-thirds power law): F. Lacquaniti, C. Terzuolo, P. Viviani, Acta Psychologica 54 (1983) 115:
   angular velocity in proportion to curvature to the power 2/3, so speed to the radius of curvature to the power 1/3.
   On straight stretches that has no bounds; here the square of a curvature 1 / straight is added, which it comes near
   to where the path is straighter than that:

     v(s) = K (kappa(s)^2 + 1 / straight^2)^(-1/6)

   t(s) = 1/K integral of (kappa^2 + 1 / straight^2)^(1/6) ds, K such that t is the duration at the end; turned round
   into s(t) by trajectory/panels.h (within 1e-13 m), whose derivatives are the speed and the acceleration. The motion
   does not begin or end at rest. Where the path's curvature has a kink (the knots of a cubic spline) the acceleration
   along it jumps. */

enum { THIRDS_CHUNK = 64 };

struct thirds_slope {
    const struct path *path;
    double straight;
};

struct thirds {
    struct panels s; /* m, of t times pace                                              */
    double pace;     /* m/s: speed where the path is straight                           */
    double ends[2];  /* m/s, speed at both ends                                         */
    double duration;
};

/* g = (1 + (straight kappa)^2)^(1/6), so that an error of its integral is at least that of s. */
static void thirds_slope(const void *self, size_t n, const double *s, double *g, double *dg)
{
    const struct thirds_slope *w = self;
    double square[THIRDS_CHUNK], rate[THIRDS_CHUNK], big = w->straight * w->straight;
    for (size_t first = 0; first < n; first += THIRDS_CHUNK) {
        size_t some = n - first < THIRDS_CHUNK ? n - first : THIRDS_CHUNK;
        w->path->curvature(w->path, some, s + first, square, rate);
        for (size_t i = 0; i < some; i++)
            square[i] = 1 + big * square[i];
        vecmath_pow(some, square, 1.0 / 6, g + first);
        for (size_t i = 0; i < some; i++)
            dg[first + i] = g[first + i] / (6 * square[i]) * big * rate[i];
    }
}

static void thirds_at(const struct speed *speed, size_t n, const double *t, double *u, double *du, double *ddu)
{
    const struct thirds *w = speed->state;
    double x[THIRDS_CHUNK];
    for (size_t first = 0; first < n; first += THIRDS_CHUNK) {
        size_t some = n - first < THIRDS_CHUNK ? n - first : THIRDS_CHUNK;
        for (size_t i = 0; i < some; i++)
            x[i] = t[first + i] * w->pace;
        panels_at(&w->s, some, x, u ? u + first : NULL, du ? du + first : NULL, ddu ? ddu + first : NULL);
        for (size_t i = first; i < first + some; i++) {
            double over = t[i] < 0 ? t[i] : t[i] > w->duration ? t[i] - w->duration : 0;
            if (u) u[i] += over * w->ends[over > 0];
            if (du) du[i] *= w->pace;
            if (ddu) ddu[i] = over == 0 ? ddu[i] * w->pace * w->pace : 0;
        }
    }
}

void speed_two_thirds(struct speed *speed, const struct path *path, double straight, double duration, struct arena *a)
{
    struct thirds *w = ARENA_TAKE(a, struct thirds, 1);
    struct thirds_slope slope = {path, straight};
    double nowhere, top = 0;
    panels_inverse(&(struct panels_slope){thirds_slope, &slope}, path->breaks, path->n_breaks, 0, a, &w->s,
                   &nowhere); /* g >= 1 */
    w->pace = w->s.end / duration;
    w->duration = duration;
    for (size_t i = 0; i <= w->s.n; i++) {
        double x = panels_edge(&w->s, i), v;
        panels_at(&w->s, 1, &x, NULL, &v, NULL);
        top = fmax(top, v * w->pace);
        if (i == 0 || i == w->s.n) w->ends[i > 0] = v * w->pace;
    }
    *speed = (struct speed){.duration = duration,
                            .top = top,
                            .distance = path->length,
                            .reach = {0, path->length},
                            .cycle = duration,
                            .detail = 4 * (long)w->s.n,
                            .at = thirds_at,
                            .state = w};
}

/* ------------------------------------------------------------------ tables */

/* Speed over time from a table, v(t) >= 0 and its integral. Between rows v is the cubic with the rows' values and
   slopes d_i (Hermite); F. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300 (PCHIP):

     d_i = 0 where the chords' slopes m_{i-1}, m_i differ in sign, else (w1 + w2) / (w1 / m_{i-1} + w2 / m_i),
     w1 = 2 h_i + h_{i-1}, w2 = h_i + 2 h_{i-1};   at the ends the parabola's slope, held to the chord's sign and three
                                                   times the chord's slope

   so that v is C1, rises and falls only where the rows do, and never goes below 0. The distance is its exact integral,
   a quartic in each interval. The motion starts with the first row and ends with the last. */

struct given {
    size_t n;
    const double *t; /* [n] s, from 0                 */
    double (*c)[4];  /* [n - 1] v = sum c_j (t - t_i)^j */
    double *far;     /* [n] m travelled               */
    double fold;     /* m; NAN: none                  */
};

static double slope_inside(double h0, double h1, double m0, double m1)
{
    if (!(m0 * m1 > 0)) return 0;
    double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
    return (w0 + w1) / (w0 / m0 + w1 / m1);
}

static double slope_at_end(double h0, double h1, double m0, double m1)
{
    double d = ((2 * h0 + h1) * m0 - h0 * m1) / (h0 + h1);
    if (!(d * m0 > 0)) return 0;
    return m0 * m1 <= 0 && fabs(d) > 3 * fabs(m0) ? 3 * m0 : d;
}

static double slope_of(const double *t, const double *v, size_t n, size_t i)
{
#define CHORD(k) ((v[(k) + 1] - v[k]) / (t[(k) + 1] - t[k]))
#define STEP(k) (t[(k) + 1] - t[k])
    if (n == 2) return CHORD(0);
    if (i == 0) return slope_at_end(STEP(0), STEP(1), CHORD(0), CHORD(1));
    if (i == n - 1) return slope_at_end(STEP(n - 2), STEP(n - 3), CHORD(n - 2), CHORD(n - 3));
    return slope_inside(STEP(i - 1), STEP(i), CHORD(i - 1), CHORD(i));
#undef CHORD
#undef STEP
}

static void given_fit(struct given *g, const double *v, struct arena *a)
{
    double lost = 0;
    g->c = arena_take(a, g->n, sizeof *g->c);
    g->far = ARENA_TAKE(a, double, g->n);
    for (size_t i = 0; i + 1 < g->n; i++) {
        double h = g->t[i + 1] - g->t[i], m = (v[i + 1] - v[i]) / h, d0 = slope_of(g->t, v, g->n, i),
               d1 = slope_of(g->t, v, g->n, i + 1);
        const double c[4] = {v[i], d0, (3 * m - 2 * d0 - d1) / h, (d0 + d1 - 2 * m) / (h * h)};
        memcpy(g->c[i], c, sizeof c);
        double more = h * (c[0] + h * (c[1] / 2 + h * (c[2] / 3 + h * c[3] / 4))) + lost;
        g->far[i + 1] = g->far[i] + more;
        lost = more - (g->far[i + 1] - g->far[i]);
    }
}

/* Distance, speed, and its derivative; at the speeds of its ends before and after the table. */
static void given_distance(const struct given *g, size_t *i, double t, double out[3])
{
    double last = g->t[g->n - 1], at = t < 0 ? 0 : t > last ? last : t;
    *i = series_cubic_next(g->n, g->t, *i, at);
    const double *c = g->c[*i];
    double x = at - g->t[*i];
    out[1] = fmax(c[0] + x * (c[1] + x * (c[2] + x * c[3])), 0); /* rounding leaves -1e-17 beside a row of 0 */
    out[0] = g->far[*i] + x * (c[0] + x * (c[1] / 2 + x * (c[2] / 3 + x * c[3] / 4))) + (t - at) * out[1];
    out[2] = c[1] + x * (2 * c[2] + x * 3 * c[3]);
}

static void given_at(const struct speed *speed, size_t n, const double *t, double *u, double *du, double *ddu)
{
    const struct given *g = speed->state;
    size_t piece = 0;
    for (size_t i = 0; i < n; i++) {
        double far[3];
        bool back = false;
        given_distance(g, &piece, t[i], far);
        if (!isnan(g->fold) && far[0] > 0) {
            double k = floor(far[0] / g->fold);
            back = k / 2 != floor(k / 2);
            far[0] -= k * g->fold;
        }
        if (u)
            u[i] = back                                        ? g->fold - far[0]
                   : isnan(g->fold) && t[i] <= speed->duration ? fmin(far[0], speed->reach[1])
                                                               : far[0];
        if (du) du[i] = back ? -far[1] : far[1];
        if (ddu) ddu[i] = back ? -far[2] : far[2];
    }
}

static double given_strokes(const struct given *g, double t)
{
    size_t piece = 0;
    double far[3];
    given_distance(g, &piece, t, far);
    return floor(far[0] / g->fold);
}

/* The instant at which the number of whole strokes first is another one than at t0, by bisection down to neighbouring
 * numbers. */
static double given_turning(const struct speed *speed, double t0, double t1)
{
    const struct given *g = speed->state;
    double low = fmax(t0, 0), high = fmin(t1, speed->duration), before = given_strokes(g, low);
    if (!(high > low) || given_strokes(g, high) == before) return NAN;
    for (int i = 0; i < 200; i++) {
        double middle = low + 0.5 * (high - low);
        if (middle <= low || middle >= high) break;
        if (given_strokes(g, middle) == before)
            low = middle;
        else
            high = middle;
    }
    return high < t1 && high < speed->duration ? high : NAN;
}

bool speed_given(struct speed *speed, const char *file, double fold, struct arena *a, struct err *e)
{
    static const char *const columns[2] = {"speed_m_per_s", NULL};
    struct given *g = ARENA_TAKE(a, struct given, 1);
    struct series s;
    double top = 0, start;
    if (!series_read(file, columns, a, &s, e) || !series_spaced(&s, file, e)) return false;
    start = s.time[0];
    for (size_t i = 0; i < s.n; i++) {
        if (s.x[0][i] < 0)
            return err_set(e, ERR_SCENE,
                           "%s:%d: column 'speed_m_per_s': %.9g is negative; a speed is at least 0 (a back_and_forth "
                           "motion turns by itself): write its magnitude",
                           file, s.lines[i], s.x[0][i]);
        top = fmax(top, s.x[0][i]);
        s.time[i] -= start;
    }
    if (!(top > 0))
        return err_set(e, ERR_SCENE, "%s: all speeds are 0: nothing moves: give motion.path: still instead", file);
    *g = (struct given){.n = s.n, .t = s.time, .fold = fold};
    given_fit(g, s.x[0], a);
    double far = g->far[g->n - 1];
    *speed = (struct speed){.duration = s.time[s.n - 1],
                            .top = top,
                            .distance = far,
                            .cycle = s.time[s.n - 1],
                            .detail = 4 * (long)s.n,
                            .at = given_at,
                            .turning = isnan(fold) ? NULL : given_turning,
                            .state = g};
    speed->reach[1] = isnan(fold) ? far : fmin(far, fold);
    return true;
}

bool speed_given_ends(struct speed *speed, double length, const char *file, struct err *e)
{
    if (speed->distance > length * (1 + 1e-6))
        return err_set(e, ERR_SCENE,
                       "motion.profile: %s leads %.9g m far, but the path is %.9g m long; lower its speeds, end it "
                       "earlier, or make the path longer",
                       file, speed->distance, length);
    speed->distance = speed->reach[1] = fmin(speed->distance, length);
    return true;
}

/* ------------------------------------------------------------------ inclines */

/* The law of free motion on a slope: motion.c has its formula. The acceleration jumps where what moves turns
   round under friction, and where it comes to rest; speed and way do not. */

/* Within the duration u lies between 0 and the way's end: rounding leaves 1e-17 m beyond them. */
static void incline_fill(const struct speed *speed, size_t n, const double *t, double *u, double *du, double *ddu)
{
    const struct incline *s = speed->state;
    double at[3];
    for (size_t i = 0; i < n; i++) {
        bool inside = t[i] >= 0 && t[i] <= speed->duration;
        motion_incline_at(s, t[i], at);
        if (u) u[i] = inside ? fmin(fmax(at[0], 0), s->length) : at[0];
        if (du) du[i] = at[1];
        if (ddu) ddu[i] = at[2];
    }
}

static double incline_turning(const struct speed *speed, double t0, double t1)
{
    const struct incline *s = speed->state;
    return s->back < 0 && s->stop > t0 && s->stop < t1 && s->stop < speed->duration ? s->stop : NAN;
}

bool speed_incline(struct speed *speed, const struct motion *m, struct arena *a, struct err *e)
{
    struct incline *s = ARENA_TAKE(a, struct incline, 1);
    double end[3], duration;
    *s = motion_incline(m);
    if (!motion_incline_can(s, m, e)) return false;
    duration = motion_incline_lasts(s, m);
    if (s->over != INCLINE_RESTS) duration = fmin(duration, s->end);
    motion_incline_at(s, duration, end);
    *speed = (struct speed){.duration = duration,
                            .top = fmax(s->speed, fabs(end[1])),
                            .distance = motion_incline_distance(s, duration),
                            .cycle = duration,
                            .detail = 64,
                            .at = incline_fill,
                            .turning = incline_turning,
                            .state = s};
    speed->reach[1] = fmin(duration > s->stop ? s->top : end[0], s->length);
    return true;
}

/* ------------------------------------------------------------------ rest */

/* No speed at all: the motion of a contact that stays where it is. */

static void still_at(const struct speed *speed, size_t n, const double *t, double *u, double *du, double *ddu)
{
    (void)speed, (void)t;
    for (size_t i = 0; i < n; i++) {
        if (u) u[i] = 0;
        if (du) du[i] = 0;
        if (ddu) ddu[i] = 0;
    }
}

void speed_still(struct speed *speed, double duration)
{
    *speed = (struct speed){.duration = duration, .cycle = duration, .detail = 1, .at = still_at};
}
