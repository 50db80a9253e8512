/* Smooth through points: the natural cubic spline of x and y over the length of the chords from point to point, which
   is C2, read over its own length (path_arc.c). */
#include <math.h>

#include "trajectory/path.h"

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
    course_cubic(&course, n, knots, (const double(*)[2])points, a);
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
