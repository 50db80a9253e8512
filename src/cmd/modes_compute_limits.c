/* Figures that are in the wrong unit, most likely: the material's by the limits of the scene's keys, the solid's size and mass by what one can strike or scrape.

   A bar carries waves at c = sqrt(E/density) (m/s): from some 3 in jelly and 30 in rubber to 18000 in diamond. Pascals for gigapascals, or g/cm^3 for kg/m^3, miss this by far. */
#include <math.h>

#include "cmd/modes_compute.h"
#include "fem/mesh_check.h"
#include "scene/keys_text.h"

static const double usual_size = 3, usual_mass = 1000, slowest = 2, fastest = 20000; /* m, kg, m/s */

static bool within(const struct compute *k, const char *option, double x, struct err *e)
{
    const char *path = option[0] == 'y' ? "surface.object.youngs_modulus" : option[0] == 'd' ? "surface.object.density" : "surface.object.poisson";
    const struct key *key = keys_find(path);
    const char *unit = keys_text_unit(key->dimension);
    return (x >= key->low && x <= key->high) || err_set(e, ERR_USAGE, *unit ? "--%s: %g %s is not from %s; a bare number is in %s" : "--%s: %g%s is not from %s", option, x, unit,
                                                        keys_text_range(key, k->c->arena), unit);
}

bool modes_compute_limits_material(const struct compute *k, double density, struct err *e)
{
    const struct compute_material *m = &k->material;
    bool wood = m->named && m->named->radial.youngs_modulus > 0;
    return within(k, "youngs-modulus", m->youngs_modulus, e) && within(k, "density", density, e) && (wood || within(k, "poisson", m->poisson, e));
}

static void note(struct compute *k, const char *text)
{
    k->note = k->note ? arena_format(k->c->arena, "%s\n%s", k->note, text) : text;
}

bool modes_compute_limits_solid(struct compute *k, struct err *e)
{
    const struct boundary *b = &k->boundary;
    const struct compute_material *m = &k->material;
    struct arena *a = k->c->arena;
    bool shape = args_given(&k->c->args, "shape");
    double size = 0, mass = b->volume * m->elastic.density, speed = sqrt(m->youngs_modulus / m->elastic.density);
    const char *cure = shape ? "a length without a unit is in metres: write 30cm or 300mm" : "a mesh file may be in mm or cm: give --unit mm or cm";
    for (int c = 0; c < 3; c++)
        size = fmax(size, b->high[c] - b->low[c]);
    if (shape && !mesh_check_size(k->mesh.name, size, size > usual_size ? cure : "are the units of its lengths right?", e))
        return false;
    if (size > usual_size)
        note(k, arena_format(a, "the solid is %.4g m large; is the unit right? %s", size, cure));
    if (mass > usual_mass)
        note(k, arena_format(a, "the solid has a mass of %.4g kg; are its lengths and its density (kg/m^3) right?", mass));
    if (!(speed >= slowest && speed <= fastest))
        note(k, arena_format(a, "sqrt(Young's modulus/density), the speed of waves along a bar, is %.3g m/s, and in solids some 30 (rubber) to 18000 m/s (diamond); are the units right? Bare numbers "
                                "are Pa and kg/m^3", speed));
    return true;
}
