/* Round a centre:

     P(s) = center + radius (cos a, sin a),   a = start_angle + s / radius (counter-clockwise; turns < 0: minus)

   s runs to 2 pi radius |turns|, and round on beyond. The angle is taken in half turns, 2 turns s / length: after n
   turns it is off by at most 2 pi n 2^-52 rad. */
#include <math.h>

#include "num/real.h"
#include "num/vecmath.h"
#include "trajectory/path.h"

struct circle {
    double center[2], radius, start, per_length; /* start: half turns; per_length: half turns per m */
};

static void circle_place(const struct circle *c, size_t i, size_t from, double sine, double cosine,
                         const struct path_out *out)
{
    double way = c->per_length < 0 ? -1 : 1;
    const double at[2] = {cosine, sine}, ahead[2] = {-way * sine, way * cosine};
    for (int xy = 0; xy < 2; xy++) {
        if (out->p[xy]) out->p[xy][from + i] = c->center[xy] + c->radius * at[xy];
        if (out->e[xy]) out->e[xy][from + i] = ahead[xy];
        if (out->bend[xy]) out->bend[xy][from + i] = -at[xy] / c->radius;
    }
}

static void circle_at(const struct path *p, size_t n, const double *s, const struct path_out *out)
{
    const struct circle *c = p->state;
    double sine[PATH_CHUNK], cosine[PATH_CHUNK];
    for (size_t from = 0; from < n; from += PATH_CHUNK) {
        size_t some = n - from < PATH_CHUNK ? n - from : PATH_CHUNK;
        for (size_t i = 0; i < some; i++)
            sine[i] = c->start + c->per_length * s[from + i];
        vecmath_sincospi(some, sine, sine, cosine);
        for (size_t i = 0; i < some; i++)
            circle_place(c, i, from, sine[i], cosine[i], out);
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
