/* Hertz's stiffness of a sphere on a flat, f = k x^1.5 (K. Johnson, Contact Mechanics, 1985, section 4.2):

     k = (4/3) E* sqrt(R),   1/E* = (1 - nu_1^2) / E_1 + (1 - nu_2^2) / E_2

   R scraper.radius, m; E Young's moduli, Pa; nu Poisson's ratios, of scraper and surface: those of their objects, else of their materials. Of what
   has a grain the modulus across it is taken, as a plank is pressed in across its grain; Hertz's theory is of isotropic bodies. */
#include <math.h>

#include "force/strike.h"
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

static bool material_missing(const struct contact *c, const char *body, struct err *e)
{
    return err_set(e, ERR_SCENE,
                   "contact '%s': the stiffness of the impact is not known: give %s.material (such as steel), or youngs_modulus and poisson of %s.object, "
                   "or contact.strike.stiffness", c->name, body, body);
}

bool strike_stiffness(const struct contact *c, double *stiffness, struct err *e)
{
    double scraper = compliance(&c->scraper.response.object), surface = compliance(&c->surface.response.object);
    *stiffness = c->contact.strike.stiffness;
    if (!isnan(*stiffness))
        return true;
    if (c->contact.strike.pulse != PULSE_HERTZ)
        return err_set(e, ERR_SCENE, "contact '%s': contact.strike.stiffness must be given where contact.strike.pulse is half_sine", c->name);
    if (isnan(c->scraper.radius))
        return err_set(e, ERR_SCENE, "contact '%s': the stiffness of the impact is not known: give scraper.radius, or contact.strike.stiffness", c->name);
    if (isnan(scraper) || isnan(surface))
        return material_missing(c, isnan(scraper) ? "scraper" : "surface", e);
    *stiffness = 4.0 / 3 * sqrt(c->scraper.radius) / (scraper + surface);
    return true;
}
