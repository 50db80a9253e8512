/* Stretched string with fixed ends and stiffness (H. Fletcher, J. Acoust. Soc. Am. 36, 1964, 203; Morse, Vibration and
   Sound, section 16):

       f_n = n f0 sqrt(1 + B n^2),   f0 = sqrt(T/mu)/(2 L),   B = pi^3 E d^4/(64 T L^2),   mu = rho pi d^2/4,

   shapes sin(n pi x/L) (supported ends), masses mu L/2. The diameter is that of the core that bends, density that of
   all of it. */
#include <math.h>

#include "num/real.h"
#include "response/object_kinds.h"

static bool list(const struct object_body *b, const struct object_limit *limit, struct arena *a, struct object_list *l,
                 struct err *e)
{
    (void)e;
    const struct object_given *g = b->given;
    double d2 = g->diameter * g->diameter, mu = b->density * REAL_PI * d2 / 4.0, length = g->length;
    double stiffness =
        REAL_PI * REAL_PI * REAL_PI * b->youngs_modulus * d2 * d2 / (64.0 * g->tension * length * length);
    for (int n = 1; n <= limit->most; n++) {
        double w = n * REAL_PI / length * sqrt(g->tension / mu) * sqrt(1.0 + stiffness * n * n);
        if (w >= limit->w) break;
        object_list_add(l, a, (struct object_mode){.w = w, .mass = 0.5 * mu * length, .a = 2 * n});
    }
    return true;
}

static void bind(struct arena *a, struct object *o)
{
    const struct object_given *g = object_inside(o)->body->given;
    o->high[0] = g->length;
    o->low[1] = -0.5 * g->diameter;
    o->high[1] = 0.5 * g->diameter;
    o->radius = sqrt(0.25 * g->diameter * g->length);
    object_sine_bind(a, o);
}

const struct object_kind object_string = {"string theory", list, bind};
