/* Stretched rectangular membrane, held at its edges (Rayleigh, The Theory of Sound, section 195): w = sqrt(S/(rho h))
   sqrt(kx^2 + ky^2), kx = m pi/a, ky = n pi/b, shapes sin(kx x) sin(ky y), masses rho h a b/4; S in N/m. No stiffness,
   no air load. */
#include <math.h>

#include "num/real.h"
#include "response/object_kinds.h"

static double frequency(const void *speed, double kx, double ky)
{
    return *(const double *)speed * sqrt(kx * kx + ky * ky);
}

static double no_excess(const void *speed, double w)
{
    (void)speed;
    (void)w;
    return 0.0;
}

static bool list(const struct object_body *b, const struct object_limit *limit, struct arena *a, struct object_list *l,
                 struct err *e)
{
    (void)e;
    const struct object_given *g = b->given;
    double area_density = b->density * g->thickness, speed = sqrt(g->surface_tension / area_density);
    struct object_sine_law law = {frequency, no_excess, &speed, 0.25 * area_density * g->length * g->width};
    object_sine_list(b, &law, limit, a, l);
    return true;
}

static void bind(struct arena *a, struct object *o)
{
    const struct object_given *g = object_inside(o)->body->given;
    o->high[0] = g->length;
    o->high[1] = g->width;
    o->flat = true;
    o->radius = sqrt(g->length * g->width / (2.0 * REAL_PI));
    object_sine_bind(a, o);
}

const struct object_kind object_membrane = {"membrane theory", list, bind};
