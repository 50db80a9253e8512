/* Hertz's stiffness of a sphere on a flat, f = k x^1.5 (K. Johnson, Contact Mechanics, 1985, section 4.2):

     k = (4/3) E* sqrt(R),   1/E* = (1 - nu_1^2) / E_1 + (1 - nu_2^2) / E_2                  papers/002 equation 4

   R radius of the scraper's tip or of the ball, m; E Young's moduli, Pa; nu Poisson's ratios, of both bodies: those of
   their objects, else of their materials. Of what has a grain the modulus across it is taken, as a plank is pressed in
   across its grain; Hertz's theory is of isotropic bodies, of a ball that is filled, and of a surface that is flat at
   the scale of the contact. */
#include "force/hertz.h"

#include <math.h>

#include "scene/ball.h"
#include "scene/material.h"

/* (1 - nu^2) / E, 1/Pa; NAN: not known. */
static double compliance(const struct object_given *o)
{
    const struct material *m = material_find(o->material);
    double youngs = o->youngs_modulus, across = o->youngs_modulus_across, poisson = o->poisson;
    if (m) {
        across = isnan(across) && isnan(youngs) ? m->across : across;
        youngs = isnan(youngs) ? m->youngs_modulus : youngs;
        poisson = isnan(poisson) ? m->poisson : poisson;
    }
    return (1 - poisson * poisson) / (isnan(across) ? youngs : across);
}

static const char *own_key(const struct contact *c)
{
    return ball_rolls(c) ? "contact.roll.stiffness" : "contact.strike.stiffness";
}

static bool radius_missing(const struct contact *c, struct err *e)
{
    return err_set(e, ERR_SCENE, "contact '%s': the stiffness of the %s is not known: give %s.radius, or %s", c->name,
                   ball_rolls(c) ? "contact" : "impact", ball_tool(c), own_key(c));
}

static bool material_missing(const struct contact *c, const char *body, struct err *e)
{
    return err_set(e, ERR_SCENE,
                   "contact '%s': the stiffness of the %s is not known: give %s.material (such as steel), or "
                   "youngs_modulus and poisson of %s.object, "
                   "or %s",
                   c->name, ball_rolls(c) ? "contact" : "impact", body, body, own_key(c));
}

bool hertz_stiffness(const struct contact *c, double *stiffness, struct err *e)
{
    double tool = compliance(&c->scraper.response.object), surface = compliance(&c->surface.response.object);
    if (isnan(c->scraper.radius)) return radius_missing(c, e);
    if (isnan(tool) || isnan(surface)) return material_missing(c, isnan(tool) ? ball_tool(c) : "surface", e);
    *stiffness = 4.0 / 3 * sqrt(c->scraper.radius) / (tool + surface);
    return true;
}
