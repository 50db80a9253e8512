/* Positions over time from a CSV become C2 functions of time: cubic splines, at times that need not be evenly spaced
   (trajectory/cubic.h).

   With motion.cutoff they are smoothing splines, which a sine at that frequency passes with half its power, one at half
   of it with 0.95, at twice it with 0.02; with cutoff 0 they go through the rows. Both have no acceleration at their
   two ends. */
#include "trajectory/recorded.h"

#include <math.h>

#include "trajectory/cubic.h"
#include "trajectory/series.h"

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
        cubic_smooth(s->n, s->time, s->x[k], m->cutoff, s->x[k], a);
    return true;
}

static bool recorded_moves(const struct motion *m, const struct series *s, struct err *e)
{
    for (size_t i = 1; i < s->n; i++)
        if (s->x[0][i] != s->x[0][0] || s->x[1][i] != s->x[1][0]) return true;
    return err_set(e, ERR_SCENE, "%s: all positions are the same: nothing moves: give motion.path: still instead",
                   m->file);
}

bool recorded_read(const struct motion *m, double duration, struct arena *a, struct course *c, double *clock,
                   struct err *e)
{
    static const char *const columns[2] = {"x_m", "y_m"};
    struct series s;
    if (!series_read(m->file, columns, a, &s, e) || !series_apart(&s, m->file, e) || !recorded_near(m, &s, e) ||
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
    course_cubic(c, s.n, s.time, (const double(*)[2])p, a);
    if (!isnan(duration) && duration < whole) course_cut(c, duration, a);
    return true;
}
