/* Speed over time from a table, v(t) >= 0 and its integral. Between rows v is the cubic with the rows' values and
   slopes d_i (Hermite); F. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300 (PCHIP):

     d_i = 0 where the chords' slopes m_{i-1}, m_i differ in sign, else (w1 + w2) / (w1 / m_{i-1} + w2 / m_i),
     w1 = 2 h_i + h_{i-1}, w2 = h_i + 2 h_{i-1};   at the ends the parabola's slope, held to the chord's sign and three
                                                   times the chord's slope

   so that v is C1, rises and falls only where the rows do, and never goes below 0. The distance is its exact integral,
   a quartic in each interval. The motion starts with the first row and ends with the last. */
#include <math.h>
#include <string.h>

#include "trajectory/knots.h"
#include "trajectory/series.h"
#include "trajectory/speed.h"

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
static void given_way(const struct given *g, size_t *i, double t, double out[3])
{
    double last = g->t[g->n - 1], at = t < 0 ? 0 : t > last ? last : t;
    *i = knots_next(g->n, g->t, *i, at);
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
        double way[3];
        bool back = false;
        given_way(g, &piece, t[i], way);
        if (!isnan(g->fold) && way[0] > 0) {
            double k = floor(way[0] / g->fold);
            back = k / 2 != floor(k / 2);
            way[0] -= k * g->fold;
        }
        if (u)
            u[i] = back                                        ? g->fold - way[0]
                   : isnan(g->fold) && t[i] <= speed->duration ? fmin(way[0], speed->reach[1])
                                                               : way[0];
        if (du) du[i] = back ? -way[1] : way[1];
        if (ddu) ddu[i] = back ? -way[2] : way[2];
    }
}

static double given_strokes(const struct given *g, double t)
{
    size_t piece = 0;
    double way[3];
    given_way(g, &piece, t, way);
    return floor(way[0] / g->fold);
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
    if (!series_read(file, columns, a, &s, e) || !series_apart(&s, file, e)) return false;
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
