/* Bars (rectangular section, bending across the thickness) and rods (round: solid, or a tube with a wall).

   Bending (Euler and Bernoulli; Rayleigh, The Theory of Sound, chapter VIII): w = beta^2 sqrt(E I/(rho A)), beta from
   object_beam.c, or i pi/L with sines between simple supports; I = b h^3/12, or pi (D^4 - d^4)/64. Masses: rho A L,
   supported half of it.

   Longitudinal waves: w = k sqrt(E/rho); k = i pi/L with cosines between free ends and sines between held ones (nothing
   turns here: `supported` is the same as `clamped`), k = (i - 1/2) pi/L with sines when x = 0 is held. Masses: rho A
   L/2. The force is then along the bar.

   What this leaves out, to first order: Timoshenko's shear and rotation lower bending frequencies by (beta r)^2/2 (1 +
   E/(kappa G)), r^2 = I/A, kappa = 5/6, 9/10 (solid), 1/2 (thin tube); Rayleigh's lateral inertia longitudinal ones by
   (nu k)^2 r_p^2/2, r_p^2 = polar I/A. */
#include <math.h>

#include "num/real.h"
#include "response/object_kinds.h"

struct section {
    double area, inertia, polar; /* m^2, m^4 */
    double kappa;
};

static struct section section_of(const struct object_given *g)
{
    if (g->shape == OBJECT_BAR) {
        double area = g->width * g->thickness, i = area * g->thickness * g->thickness / 12.0;
        return (struct section){area, i, i + area * g->width * g->width / 12.0, 5.0 / 6.0};
    }
    double out = g->diameter, in = isnan(g->thickness) ? 0.0 : fmax(out - 2.0 * g->thickness, 0.0);
    double area = REAL_PI / 4.0 * (out * out - in * in),
           i = REAL_PI / 64.0 * (out * out * out * out - in * in * in * in);
    return (struct section){area, i, 2.0 * i, in > 0.5 * out ? 0.5 : 0.9};
}

static bool bends(const struct object_given *g) { return g->waves == WAVES_BENDING; }

static struct object_mode mode_bending(const struct object_body *b, const struct section *s, int i)
{
    const struct object_given *g = b->given;
    bool sine = g->edges == EDGES_SUPPORTED;
    double z = sine ? i * REAL_PI : object_beam_root(g->edges, i), k = z / g->length;
    double mass = b->density * s->area * g->length, shear = isnan(b->shear) ? b->youngs_modulus / 2.6 : b->shear;
    double k2r2 = k * k * s->inertia / s->area;
    struct object_mode m = {.w = k * k * sqrt(b->youngs_modulus * s->inertia / (b->density * s->area)),
                            .mass = sine ? 0.5 * mass : mass,
                            .a = sine ? 2 * i : i};
    m.excess = 0.5 * k2r2 * (1.0 + b->youngs_modulus / (s->kappa * shear));
    return m;
}

static struct object_mode mode_longitudinal(const struct object_body *b, const struct section *s, int i)
{
    const struct object_given *g = b->given;
    int quarters = g->edges == EDGES_CANTILEVER ? 2 * i - 1 : 2 * i;
    double k = quarters * REAL_PI / (2.0 * g->length), nu = isnan(b->poisson) ? 0.3 : b->poisson;
    struct object_mode m = {.w = k * sqrt(b->youngs_modulus / b->density),
                            .mass = 0.5 * b->density * s->area * g->length,
                            .a = quarters,
                            .c = g->edges == EDGES_FREE};
    m.excess = 0.5 * nu * nu * k * k * s->polar / s->area;
    return m;
}

static bool list(const struct object_body *b, const struct object_limit *limit, struct arena *a, struct object_list *l,
                 struct err *e)
{
    (void)e;
    struct section s = section_of(b->given);
    for (int i = 1; i <= limit->most; i++) {
        struct object_mode m = bends(b->given) ? mode_bending(b, &s, i) : mode_longitudinal(b, &s, i);
        if (m.w >= limit->w) break;
        object_list_add(l, a, m);
    }
    return true;
}

static void bind(struct arena *a, struct object *o)
{
    const struct object_given *g = object_inside(o)->body->given;
    double width = g->shape == OBJECT_BAR ? g->width : g->diameter;
    o->high[0] = g->length;
    o->low[1] = g->shape == OBJECT_BAR ? 0.0 : -0.5 * width;
    o->high[1] = g->shape == OBJECT_BAR ? width : 0.5 * width;
    double surface = g->shape == OBJECT_BAR ? 2.0 * (g->length * (width + g->thickness) + width * g->thickness)
                                            : REAL_PI * width * (g->length + 0.5 * width);
    o->radius = sqrt(surface / (4.0 * REAL_PI));
    if (bends(g) && g->edges != EDGES_SUPPORTED)
        object_beam_bind(a, o);
    else
        object_sine_bind(a, o);
}

const struct object_kind object_bar = {"slender-bar theory", list, bind};
