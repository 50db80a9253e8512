/* As hands draw (the two-thirds power law): F. Lacquaniti, C. Terzuolo, P. Viviani, Acta Psychologica 54 (1983) 115:
   angular velocity in proportion to curvature to the power 2/3, so speed to the radius of curvature to the power 1/3.
   On straight stretches that has no bounds; here the square of a curvature 1 / straight is added, which it comes near
   to where the path is straighter than that:

     v(s) = K (kappa(s)^2 + 1 / straight^2)^(-1/6)

   t(s) = 1/K integral of (kappa^2 + 1 / straight^2)^(1/6) ds, K such that t is the duration at the end; turned round
   into s(t) by trajectory/panels.h (within 1e-13 m), whose derivatives are the speed and the acceleration. The motion
   does not begin or end at rest. Where the path's curvature has a kink (the knots of a cubic spline) the acceleration
   along it jumps. */
#include <math.h>

#include "num/vecmath.h"
#include "trajectory/speed.h"

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
