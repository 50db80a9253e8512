/* Thin rectangular plate (Kirchhoff), isotropic or orthotropic with the grain along x (Leissa, Vibration of Plates,
   NASA SP-160, 1969, chapters 4 and 9; Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells, section 85):

       Dx = Ex h^3/(12 (1 - nu_x nu_y)),  Dy likewise,  nu_y = nu_x Ey/Ex,  D1 = nu_x Dy,  Dk = G h^3/12,
       supported all round:  rho h w^2 = Dx kx^4 + 2 (D1 + 2 Dk) kx^2 ky^2 + Dy ky^4,   kx = m pi/a, ky = n pi/b,

   shapes sin(kx x) sin(ky y), masses rho h a b/4. Other edges: object_plate_ritz.c.

   What thin-plate theory leaves out lowers frequencies, to first order (Mindlin 1951), by k^2/2 (h^2/12 + D/(kappa G
   h)), kappa = 5/6, k^2 = w sqrt(rho h/D), here with D = sqrt(Dx Dy). Across the grain through the thickness wood
   shears more easily than G says. */
#include <math.h>

#include "num/real.h"
#include "response/object_kinds.h"

bool object_plate_stiffness(const struct object_body *b, struct object_plate *p, struct err *e)
{
    double h = b->given->thickness, nu = b->poisson, coupled = 1.0 - nu * nu * b->across / b->youngs_modulus;
    if (!(coupled > 0.0))
        return err_set(e, ERR_SCENE,
                       "%s: no material has a poisson of %g with a youngs_modulus_across of %g Pa beside a "
                       "youngs_modulus of %g Pa: "
                       "poisson^2 must be below the modulus along over the one across",
                       b->key, nu, b->across, b->youngs_modulus);
    double cube = h * h * h / 12.0;
    p->dx = b->youngs_modulus * cube / coupled;
    p->dy = b->across * cube / coupled;
    p->coupling = nu * p->dy;
    p->twist = b->shear * cube;
    p->area_density = b->density * h;
    p->thickness = h;
    p->shear = b->shear;
    return true;
}

double object_plate_supported(const void *plate, double kx, double ky)
{
    const struct object_plate *p = (const struct object_plate *)plate;
    double x2 = kx * kx, y2 = ky * ky;
    return sqrt((p->dx * x2 * x2 + 2.0 * (p->coupling + 2.0 * p->twist) * x2 * y2 + p->dy * y2 * y2) / p->area_density);
}

double object_plate_excess(const void *plate, double w)
{
    const struct object_plate *p = (const struct object_plate *)plate;
    double d = sqrt(p->dx * p->dy), k2 = w * sqrt(p->area_density / d), h = p->thickness;
    return 0.5 * k2 * (h * h / 12.0 + d / (5.0 / 6.0 * p->shear * h));
}

static bool list(const struct object_body *b, const struct object_limit *limit, struct arena *a, struct object_list *l,
                 struct err *e)
{
    const struct object_given *g = b->given;
    struct object_plate p;
    if (g->edges != EDGES_SUPPORTED) return object_plate_ritz(b, limit, a, l, e);
    if (!object_plate_stiffness(b, &p, e)) return false;
    struct object_sine_law law = {object_plate_supported, object_plate_excess, &p,
                                  0.25 * p.area_density * g->length * g->width};
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
    if (g->edges == EDGES_SUPPORTED)
        object_sine_bind(a, o);
    else
        object_plate_ritz_bind(a, o);
}

const struct object_kind object_plate = {"thin-plate theory", list, bind};
