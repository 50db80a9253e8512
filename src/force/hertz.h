/* Hertz's contact of what strikes or rolls with the surface: f = k x^1.5. */
#ifndef FORCE_HERTZ_H
#define FORCE_HERTZ_H
#include <stdbool.h>

#include "base/err.h"
#include "scene/scene.h"
#include "scene/scene_part.h"

struct hertz {        /* of a ball that rolls                     */
    double stiffness; /* N/m^1.5, k; NAN: kappa, or not given     */
    double kappa;     /* N/(m^1.5 kg), k over the ball's mass     */
    double mu;        /* s/m, lambda / k                          */
};

const struct hertz *hertz_of(const struct contact *c);

/* N/m^1.5: the ball's given stiffness, kappa times its mass, or NAN. */
double hertz_given(const struct contact *c);

/* k in N/m^1.5 from radius and materials (hertz.c). ERR_SCENE: the scene does not tell them; names the keys that would,
 * and the model's own key of stiffness. */
bool hertz_stiffness(const struct contact *c, double *stiffness, struct err *e);

/* Hertz's stiffness needs the moduli of the surface and of what touches it: reports what is missing, and BECAUSE. */
void hertz_check(const struct scene_part *p, const struct contact *c, const char *because);

/* Is a stiffness written with the unit of a linear spring (N/m), or, of a linear one, with that of Hertz's contact
 * (N/m^1.5)? */
bool hertz_unit(const struct yaml_node *node, bool linear);

/* The mean of Hertz's k xi^1.5 while the penetration goes in a straight line from xi to xi+: with a^2, b^2 = xi, xi+,
   both above 0, is

     (2/5) k (b^5 - a^5) / (b^2 - a^2) = (2/5) k (b^4 + b^3 a + b^2 a^2 + b a^3 + a^4) / (a + b),

   the discrete gradient of the potential (2/5) k xi^2.5 too. The right-hand form loses no digits where xi and xi+ are
   all but equal. */

/* b^4 + b^3 a + b^2 a^2 + b a^3 + a^4; aa, bb: a^2, b^2. */
static inline double hertz_mean_quartic(double a, double b, double aa, double bb)
{
    double ab = a * b;
    return bb * bb + ab * (bb + ab + aa) + aa * aa;
}

#endif
