/* A ball's values against each other, and what its two models need. */
#include <math.h>

#include "scene/ball.h"
#include "scene/keys.h"
#include "scene/rules.h"
#include "scene/scene_part.h"
#include "scene/scene_sense_parts.h"

/* ------------------------------------------------------------------ sizes and mass */

static void below_radius(const struct scene_part *p, const char *path, double size, double radius)
{
    if (size >= radius)
        scene_part_contradiction(p, path, "ball.radius", "must be less than",
                                 arena_format(p->yaml->arena, "lower %s, or raise ball.radius", path));
}

static void sizes_check(const struct scene_part *p, const struct contact *c)
{
    const struct ball *b = &c->ball;
    below_radius(p, "ball.offset", b->offset, b->radius);
    below_radius(p, "ball.wall", b->wall, b->radius);
    below_radius(p, "ball.patch", b->patch, b->radius);
    below_radius(p, "ball.lobe_height", b->lobe_height, b->radius);
    if (b->patch == 0 && c->contact.model == CONTACT_ROLL)
        scene_part_refuse(
            p, "ball.patch", "ball.patch", "write for instance: patch: 20 um",
            " must be above 0 where contact.model is roll: the force follows from the slope and curvature of the "
            "rolling curve, which has kinks");
    if (b->patch == 0 && c->contact.model == CONTACT_ROLL_COUPLED && rules_along(c) == ALONG_PLANE)
        scene_part_refuse(
            p, "ball.patch", "ball.patch",
            "write for instance: patch: 20 um; or let the surface follow the path, by surface.along: path",
            " must be above 0 on a surface in the plane: only along a line is the rolling curve known without "
            "smoothing");
}

/* What the mass lacks, with an example of the cure; NULL: it is not the mass. */
static const char *mass_lacks(const struct scene_part *p, const struct ball *b)
{
    bool of_material = b->response.object.material != MATERIAL_CUSTOM || !isnan(b->response.object.density);
    if (b->body == BODY_HOOP || b->body == BODY_WHEEL)
        return ": what a hoop or a wheel weighs does not follow from its radius";
    if (b->body == BODY_HOLLOW && !scene_part_given(p, "ball.wall"))
        return ": it is hollow; or give ball.wall and ball.material, from which it follows";
    return of_material ? NULL
                       : ": it is not known what the ball is made of; ball.material, such as glass, would do as well";
}

static void mass_check(const struct scene_part *p, const struct contact *c)
{
    const char *lacks = mass_lacks(p, &c->ball);
    if (isnan(c->scraper.mass) && lacks && scene_part_known(p, "ball.body") && scene_part_known(p, "ball.material"))
        scene_part_missing(p, "ball.mass", "11 g", lacks);
}

/* ------------------------------------------------------------------ stiffness */

static bool stiffness_is_given(const struct scene_part *p)
{
    return scene_part_given(p, "contact.roll.stiffness") || scene_part_given(p, "contact.roll.kappa");
}

static void unit_check(const struct scene_part *p, const struct roll *r)
{
    const char *path = "contact.roll.stiffness";
    if (!isnan(r->stiffness) && scene_sense_model_unit(yaml_find(p->map, path), false))
        scene_part_refuse(p, path, path,
                          "give it in N/m^1.5: the force is stiffness x penetration^1.5 (Hertz's contact)",
                          " is in N/m^1.5, not in N/m");
}

/* ------------------------------------------------------------------ roll */

/* Defaults stand in every effective scene, so that only another value is one that was meant to do something. */
static void paper_check(const struct scene_part *p, const struct roll *r)
{
    if (!stiffness_is_given(p))
        scene_part_missing(p, "contact.roll.stiffness", "2 kN/m^1.5",
                           " (or contact.roll.kappa): under penetration: paper rho is about the ball's radius, and "
                           "the stiffness is chosen by hand");
    if (scene_part_given(p, "contact.roll.mu") && r->mu != 1)
        scene_part_refuse(p, "contact.roll.mu", "contact.roll.mu",
                          "give contact.roll.lambda in its place, or set contact.roll.penetration to deviation",
                          " has no effect where contact.roll.penetration is paper");
}

static void roll_check(const struct scene_part *p, const struct contact *c)
{
    const struct roll *r = &c->contact.roll;
    if (!scene_part_known(p, "contact.roll.penetration")) return;
    if (r->penetration == PENETRATION_PAPER) paper_check(p, r);
}

/* ------------------------------------------------------------------ roll_coupled */

/* Why the surface cannot give way; NULL: it may, as far as the scene tells (the poles of a mode table are known when it
 * has been read). */
static const char *why_rigid(const struct response *r)
{
    if (!rules_responds(r)) return "the surface has no modes";
    if (rules_is_recorded(r)) return "what is recorded has no modes";
    return rules_travels(&r->space) ? "a surface.space that travels has no mode shapes" : NULL;
}

static void ground_check(const struct scene_part *p, const struct contact *c)
{
    const char *ground = "contact.roll.ground", *integrator = "contact.roll.integrator",
               *why = why_rigid(&c->surface.response);
    bool elastic = c->contact.roll.ground == GROUND_ELASTIC,
         exact = c->contact.roll.integrator == INTEGRATOR_EXACT_IMPACT;
    if (!scene_part_known(p, ground) || !scene_part_known(p, integrator)) return;
    if (elastic && why)
        scene_part_refuse(
            p, ground, ground,
            "give surface.object, or a mode table with shared poles as surface.response; or set it to rigid",
            " is elastic, and %s", why);
    else if (exact && (elastic || (c->contact.roll.ground == GROUND_AUTO && !why)))
        scene_part_refuse(p, integrator, ground,
                          "set contact.roll.ground to rigid, or leave contact.roll.integrator out",
                          ": exact_impact needs rigid ground, and %s is %s", scene_part_label(p, ground),
                          elastic ? "elastic" : "auto, which is elastic where the surface rings by modes");
}

/* What is dropped without gravity never arrives. */
static void drop_check(const struct scene_part *p, const struct contact *c)
{
    const char *drop = "contact.roll.drop", *gravity = "contact.gravity";
    if (c->contact.roll.drop > 0 && c->contact.gravity == 0)
        scene_part_refuse(p, drop, gravity, "raise contact.gravity, or lay the ball down with drop: 0",
                          " is %.4g m and %s is 0: the ball never arrives", c->contact.roll.drop,
                          scene_part_label(p, gravity));
}

void scene_sense_ball(const struct scene_part *p, const struct contact *c)
{
    sizes_check(p, c);
    mass_check(p, c);
    unit_check(p, &c->contact.roll);
    if (c->contact.model == CONTACT_ROLL) {
        roll_check(p, c);
        return;
    }
    ground_check(p, c);
    drop_check(p, c);
    if (!stiffness_is_given(p))
        scene_sense_model_moduli(
            p, c, "the stiffness of the contact follows from it, unless contact.roll.stiffness (or kappa) is given");
}
