/* What a given object is made of: the material's figures where the scene gives none; whether all that its shape needs
 * is there and fits. */
#include <math.h>

#include "response/object_kinds.h"
#include "scene/material.h"

static double given_or(double given, double material) { return isnan(given) ? material : given; }

/* Isotropic materials follow youngs_modulus and poisson wherever those come from. */
static void elasticity(struct object_body *b, const struct material *m)
{
    const struct object_given *g = b->given;
    bool wood = m && !isnan(m->across) && m->across != m->youngs_modulus;
    b->youngs_modulus = given_or(g->youngs_modulus, m ? m->youngs_modulus : NAN);
    b->poisson = given_or(g->poisson, m ? m->poisson : NAN);
    b->across = given_or(g->youngs_modulus_across, wood ? m->across : b->youngs_modulus);
    double mean = sqrt(b->youngs_modulus * b->across), nu = b->poisson * sqrt(b->across / b->youngs_modulus);
    b->shear = given_or(g->shear_modulus, wood ? m->shear : mean / (2.0 * (1.0 + nu)));
}

static void damping(struct object_body *b, const struct material *m)
{
    const struct object_given *g = b->given;
    bool any = m || !isnan(g->alpha) || !isnan(g->beta) || !isnan(g->loss);
    b->alpha = given_or(g->alpha, m ? m->alpha : any ? 0.0 : NAN);
    b->beta = given_or(g->beta, m ? m->beta : any ? 0.0 : NAN);
    b->loss = given_or(g->loss, m ? m->loss : any ? 0.0 : NAN);
}

struct need {
    const char *name;
    double value;
    unsigned shapes; /* bits of enum object_shape */
};

#define ON(shape) (1u << (OBJECT_##shape))
#define STIFF (ON(BAR) | ON(ROD) | ON(STRING) | ON(PLATE) | ON(DISK) | ON(SHELL))
#define SHEET (ON(BAR) | ON(PLATE) | ON(DISK) | ON(MEMBRANE) | ON(DRUM) | ON(SHELL))

static bool all_there(const struct object_body *b, struct err *e)
{
    const struct object_given *g = b->given;
    const struct need sizes[] = {
        {"length", g->length, ON(BAR) | ON(ROD) | ON(STRING) | ON(PLATE) | ON(MEMBRANE)},
        {"width", g->width, ON(BAR) | ON(PLATE) | ON(MEMBRANE)},
        {"diameter", g->diameter, ON(ROD) | ON(STRING) | ON(DISK) | ON(DRUM) | ON(SHELL)},
        {"thickness", g->thickness, SHEET},
        {"tension", g->tension, ON(STRING)},
        {"surface_tension", g->surface_tension, ON(MEMBRANE) | ON(DRUM)},
    };
    const struct need figures[] = {
        {"density", b->density, ~0u},
        {"youngs_modulus", b->youngs_modulus, STIFF},
        {"poisson", b->poisson, ON(PLATE) | ON(DISK) | ON(SHELL)},
        {"alpha, beta or loss", b->alpha, ~0u},
    };
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        if ((sizes[i].shapes >> g->shape & 1u) && isnan(sizes[i].value))
            return err_set(e, ERR_SCENE, "%s.%s is missing", b->key, sizes[i].name);
    for (size_t i = 0; i < sizeof figures / sizeof *figures; i++)
        if ((figures[i].shapes >> g->shape & 1u) && isnan(figures[i].value))
            return err_set(e, ERR_SCENE, "%s: a custom material needs %s (or name one: %s.material)", b->key,
                           figures[i].name, b->key);
    return true;
}

static bool fits(const struct object_body *b, struct err *e)
{
    const struct object_given *g = b->given;
    double wall = g->thickness;
    if (g->shape == OBJECT_ROD && wall > 0.5 * g->diameter)
        return err_set(
            e, ERR_SCENE,
            "%s.thickness: a wall of %g m does not fit into a rod of %g m diameter; leave it out for a solid rod",
            b->key, wall, g->diameter);
    if (g->shape == OBJECT_SHELL && wall >= 0.5 * g->diameter)
        return err_set(e, ERR_SCENE,
                       "%s.thickness: a wall of %g m does not fit into a shell of %g m diameter; give a thinner one",
                       b->key, wall, g->diameter);
    if (g->shape == OBJECT_DISK && g->edges == EDGES_CANTILEVER)
        return err_set(e, ERR_SCENE, "%s.edges: a disk has one edge all round; cantilever is for bars, rods and plates",
                       b->key);
    return true;
}

const struct object_body *object_body_make(const struct object_given *given, const char *key, struct arena *a,
                                           struct err *e)
{
    struct object_body *b = ARENA_TAKE(a, struct object_body, 1);
    struct object_given *copy = ARENA_TAKE(a, struct object_given, 1);
    const struct material *m = material_find(given->material);
    *copy = *given;
    *b = (struct object_body){
        .given = copy, .key = arena_text(a, key), .density = given_or(given->density, m ? m->density : NAN)};
    elasticity(b, m);
    damping(b, m);
    return all_there(b, e) && fits(b, e) ? b : NULL;
}
