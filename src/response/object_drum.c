/* Stretched circular membrane, held at its edge (Rayleigh, The Theory of Sound, sections 200-206): R = J_n(lambda r/a),
   J_n(lambda) = 0, w = lambda/a sqrt(S/(rho h)), S in N/m; mass 2 pi (n = 0) or pi times rho h a^2 J_{n+1}(lambda)^2/2.
   No stiffness, no air load. */
#include <math.h>

#include "num/bessel.h"
#include "num/real.h"
#include "response/object_kinds.h"

static double zero(const struct object_radial *q, int n, double lambda)
{
    (void)q;
    double j[2];
    bessel_j(n, lambda, j);
    return j[0];
}

static double value(const struct object_radial *q, int n, double lambda, double r) { return zero(q, n, lambda * r); }

static struct object_mode mode(const struct object_radial *q, int n, double lambda)
{
    double j[2], a = q->radius;
    bessel_j(n, lambda, j);
    return (struct object_mode){.w = lambda / a * sqrt(q->stiffness / q->area_density),
                                .mass = REAL_PI * q->area_density * a * a * j[1] * j[1]};
}

static bool list(const struct object_body *b, const struct object_limit *limit, struct arena *a, struct object_list *l,
                 struct err *e)
{
    (void)e;
    const struct object_given *g = b->given;
    double radius = 0.5 * g->diameter, h = g->thickness;
    struct object_radial q = {zero, value, mode, 0.0, radius, g->surface_tension, b->density * h, h, EDGES_SUPPORTED};
    object_radial_list(&q, limit, limit->w * radius * sqrt(q.area_density / q.stiffness), a, l);
    return true;
}

const struct object_kind object_drum = {"membrane theory", list, object_radial_bind};
