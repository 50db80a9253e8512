/* Hertz's stiffness of a sphere on a flat, f = k x^1.5 (K. Johnson, Contact Mechanics, 1985, section 4.2):

     k = (4/3) E* sqrt(R),   1/E* = (1 - nu_1^2) / E_1 + (1 - nu_2^2) / E_2                  papers/002 equation 4

   R radius of the scraper's tip or of the ball, m; E Young's moduli, Pa; nu Poisson's ratios, of both bodies: those of
   their objects, else of their materials. Of what has a grain the modulus across it is taken, as a plank is pressed in
   across its grain; Hertz's theory is of isotropic bodies, of a ball that is filled, and of a surface that is flat at
   the scale of the contact. */
#include "force/hertz.h"

#include <math.h>
#include <string.h>

#include "scene/material.h"
#include "scene/rows.h"
#include "trajectory/contact.h"

/* (1 - nu^2) / E, 1/Pa; NAN: not known. */
static double compliance(const struct object_given *o)
{
    const struct material *m = material_given(o);
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
    return contact_rolls(c) ? "contact.roll.stiffness" : "contact.strike.stiffness";
}

bool hertz_stiffness(const struct contact *c, double *stiffness, struct err *e)
{
    double tool = compliance(&c->scraper.response.object), surface = compliance(&c->surface.response.object);
    const char *what = contact_rolls(c) ? "contact" : "impact";
    if (isnan(c->scraper.radius))
        return err_set(e, ERR_SCENE, "contact '%s': the stiffness of the %s is not known: give %s.radius, or %s",
                       c->name, what, contact_tool(c), own_key(c));
    const char *body = isnan(tool) ? contact_tool(c) : "surface";
    if (isnan(tool) || isnan(surface))
        return err_set(e, ERR_SCENE,
                       "contact '%s': the stiffness of the %s is not known: give %s.material (such as steel; one of "
                       "your own needs a density, too), or "
                       "youngs_modulus and poisson of %s.object, or %s",
                       c->name, what, body, body, own_key(c));
    *stiffness = 4.0 / 3 * sqrt(c->scraper.radius) / (tool + surface);
    return true;
}

/* ------------------------------------------------------------------ what the scene must say */

bool hertz_unit(const struct yaml_node *node, bool linear)
{
    const char *slash = node && node->kind == YAML_SCALAR ? strchr(node->text, '/') : NULL;
    return slash && (strchr(slash, '.') || strchr(slash, '(')) != !linear;
}

/* Are the moduli of a body known: from its material, or its object's own keys? */
static bool is_elastic(const struct scene_part *p, const char *body, const struct object_given *o)
{
    struct arena *a = p->yaml->arena;
    return material_given(o) || !scene_part_known(p, arena_format(a, "%s.material", body)) ||
           (scene_part_given(p, arena_format(a, "%s.object.youngs_modulus", body)) &&
            scene_part_given(p, arena_format(a, "%s.object.poisson", body)));
}

static void moduli_missing(const struct scene_part *p, const char *body, const char *because)
{
    struct arena *a = p->yaml->arena;
    const char *material = arena_format(a, "%s.material", body),
               *object = arena_format(a, "youngs_modulus and poisson of %s.object", body);
    const struct yaml_node *custom = yaml_find(p->map, material);
    if (custom)
        diag_add(p->yaml->diag, custom->at, arena_format(a, "name a material, such as steel, or give %s", object),
                 "%s is custom, and %s are not given: %s", scene_part_label(p, material), object, because);
    else
        scene_part_missing(p, material, "steel", arena_format(a, " (or %s): %s", object, because));
}

void hertz_check(const struct scene_part *p, const struct contact *c, const char *because)
{
    const struct object_given *const objects[2] = {&c->surface.response.object, &c->scraper.response.object};
    const char *const bodies[2] = {"surface", contact_tool(c)};
    for (int i = 0; i < 2; i++)
        if (!is_elastic(p, bodies[i], objects[i])) moduli_missing(p, bodies[i], because);
}

/* ------------------------------------------------------------------ parameters */

#define ROLLS "contact.model=roll|roll_coupled"

static const struct key keys[] = {
    {ROW_NUMBER(hertz, stiffness, "contact.roll.stiffness"), KEY_STIFFNESS, 1e-3, 1e18, "", ROLLS,
     "k of k rho^1.5, in N/m^1.5; left out: roll_coupled takes Hertz's from ball.radius and both materials, roll what "
     "follows from static_penetration; penetration: paper needs it (or kappa)",
     .shown = "2e9 N/m^1.5"},
    {ROW_NUMBER(hertz, kappa, "contact.roll.kappa"), KEY_STIFFNESS_PER_MASS, 1e-3, 1e18, "", ROLLS,
     "k over the ball's mass, in place of stiffness", .shown = "5e9 N/(m^1.5 kg)"},
    {ROW_NUMBER(hertz, mu, "contact.roll.mu"), KEY_PER_SPEED, 0, 1e4, "1 s/m", ROLLS,
     "dissipation in the contact: the force is k rho^1.5 (1 + mu rho'), at least 0; of penetration: paper lambda "
     "decides"},
    {.path = NULL}};

static void unit_check(const struct scene_part *p, const struct contact *c, const void *own)
{
    const char *path = "contact.roll.stiffness";
    const struct hertz *h = own;
    (void)c;
    if (!isnan(h->stiffness) && hertz_unit(yaml_find(p->map, path), false))
        scene_part_refuse(p, path, path,
                          "give it in N/m^1.5: the force is stiffness x penetration^1.5 (Hertz's contact)",
                          " is in N/m^1.5, not in N/m");
}

const struct params hertz_params = {
    .section = "contact.roll",
    .size = sizeof(struct hertz),
    .keys = keys,
    .check = unit_check,
    .given = contact_rolls,
};

const struct hertz *hertz_of(const struct contact *c) { return params_of(c, &hertz_params); }

double hertz_given(const struct contact *c)
{
    const struct hertz *h = hertz_of(c);
    return !isnan(h->stiffness) ? h->stiffness : h->kappa * c->scraper.mass;
}
