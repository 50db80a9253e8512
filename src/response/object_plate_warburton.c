/* About how high the modes of a rectangular plate lie: Rayleigh's quotient of products of beam functions (G. B.
   Warburton, Proc. Inst. Mech. Eng. 168, 1954, 371), for orthotropic plates

       rho h w^2 = Dx (pi/a)^4 Gx^4 + Dy (pi/b)^4 Gy^4 + (pi/a)^2 (pi/b)^2 (2 D1 Hx Hy + 4 Dk Jx Jy),

   with his G, H, J of each beam function. A few percent off: it only says how many functions object_plate_ritz.c needs.
 */
#include <math.h>

#include "num/real.h"
#include "response/object_kinds.h"

/* Warburton's G, H, J of the i-th beam function, i = 0, 1, ... */
static void warburton(int edges, bool across, int i, double g[3])
{
    bool free_free = edges == EDGES_FREE || across;
    g[0] = edges == EDGES_CANTILEVER && !across ? i + 0.5 : free_free ? i - 0.5 : i + 1.5;
    if (edges == EDGES_CANTILEVER && !across && i == 0) g[0] = 0.597;
    double cross = 2.0 / (g[0] * REAL_PI), twist = free_free ? 6.0 : edges == EDGES_CANTILEVER ? 2.0 : -2.0;
    g[1] = g[0] * g[0] * (1.0 - cross);
    g[2] = g[0] * g[0] * (1.0 + twist / (g[0] * REAL_PI));
    if (free_free && i < 2) {
        g[0] = g[1] = 0.0;
        g[2] = i * 12.0 / (REAL_PI * REAL_PI);
    }
}

static double estimate(const struct object_body *b, const struct object_plate *p, int i, int k)
{
    double x[3], y[3], sx = REAL_PI / b->given->length, sy = REAL_PI / b->given->width;
    int edges = b->given->edges;
    warburton(edges, false, i, x);
    warburton(edges, edges == EDGES_CANTILEVER, k, y);
    double x2 = sx * sx * x[0] * x[0], y2 = sy * sy * y[0] * y[0], cross = sx * sx * sy * sy;
    double sum =
        p->dx * x2 * x2 + p->dy * y2 * y2 + cross * (2.0 * p->coupling * x[1] * y[1] + 4.0 * p->twist * x[2] * y[2]);
    return sqrt(fmax(sum, 0.0) / p->area_density);
}

/* (i, k) has at least (i - 1)(k - 1) modes below it. */
double object_plate_warburton(const struct object_body *b, const struct object_plate *p,
                              const struct object_limit *limit, struct arena *a)
{
    struct object_list l = {0};
    for (int i = 0; i < limit->most + 2; i++)
        for (int k = 0; k < (limit->most + 4) / (i > 1 ? i - 1 : 1) + 2; k++) {
            double w = estimate(b, p, i, k);
            if (w > 0.0) object_list_add(&l, a, (struct object_mode){.w = w, .a = i, .b = k});
        }
    object_list_cut(&l, limit);
    return l.mode[l.n - 1].w;
}
