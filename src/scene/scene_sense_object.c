/* An object of simple shape: the sizes and constants that its shape needs. */
#include <math.h>

#include "scene/rules.h"
#include "scene/scene_part.h"
#include "scene/scene_sense_parts.h"

struct body {
    const struct scene_part *part;
    const struct object_given *object;
    const char *name, *shape;
};

static const char *path_of(const struct body *b, const char *key)
{
    return arena_format(b->part->yaml->arena, "%s.object.%s", b->name, key);
}

static const char *label_of(const struct body *b, const char *key)
{
    return scene_part_label(b->part, path_of(b, key));
}

static bool is_stretched(const struct object_given *o)
{
    return o->shape == OBJECT_STRING || o->shape == OBJECT_MEMBRANE || o->shape == OBJECT_DRUM;
}

static bool is_plate(const struct object_given *o)
{
    return o->shape == OBJECT_PLATE || o->shape == OBJECT_DISK || o->shape == OBJECT_SHELL;
}

/* ------------------------------------------------------------------ sizes */

static void thickness_check(const struct body *b)
{
    const struct object_given *o = b->object;
    const char *thickness = path_of(b, "thickness");
    bool hollow = o->shape == OBJECT_ROD || o->shape == OBJECT_SHELL;
    if (o->shape != OBJECT_STRING && o->shape != OBJECT_ROD)
        scene_part_missing(b->part, thickness, "5 mm", arena_format(b->part->yaml->arena, ": a %s has one", b->shape));
    if (hollow && 2 * o->thickness >= o->diameter)
        diag_add(b->part->yaml->diag, scene_part_later(b->part, thickness, path_of(b, "diameter")),
                 o->shape == OBJECT_ROD ? "lower thickness; a rod without one is solid" : "lower thickness",
                 "%s, %.4g m, must be less than half of %s, %.4g m", label_of(b, "thickness"), o->thickness,
                 label_of(b, "diameter"), o->diameter);
}

static void edges_check(const struct body *b)
{
    const struct object_given *o = b->object;
    const char *edges = path_of(b, "edges");
    if (o->edges == EDGES_CANTILEVER && (o->shape == OBJECT_PLATE || o->shape == OBJECT_DISK) &&
        scene_part_known(b->part, edges))
        diag_add(b->part->yaml->diag, scene_part_later(b->part, edges, path_of(b, "shape")),
                 "edges here: free, supported, clamped",
                 "%s must not be cantilever where %s is %s: only bars and rods have one end", label_of(b, "edges"),
                 label_of(b, "shape"), b->shape);
}

/* ------------------------------------------------------------------ material */

static void needs(const struct body *b, const char *key, const char *example)
{
    struct arena *a = b->part->yaml->arena;
    const char *material = arena_format(a, "%s.material", b->name);
    const char *value = arena_format(a, "%s; or name a material, such as %s: steel", example, material);
    scene_part_missing(b->part, path_of(b, key), value,
                       arena_format(a, ": %s is custom", scene_part_label(b->part, material)));
}

static void material_check(const struct body *b)
{
    const struct object_given *o = b->object;
    if (o->material != MATERIAL_CUSTOM ||
        !scene_part_known(b->part, arena_format(b->part->yaml->arena, "%s.material", b->name)))
        return;
    needs(b, "density", "650 kg/m^3");
    if (!is_stretched(o)) needs(b, "youngs_modulus", "12 GPa");
    if (is_plate(o)) needs(b, "poisson", "0.35");
}

/* nu_x nu_y = nu_x^2 E_y / E_x is below 1 in whatever does not fall apart. */
static void orthotropic_check(const struct body *b)
{
    const struct object_given *o = b->object;
    double coupling = o->poisson * o->poisson * o->youngs_modulus_across / o->youngs_modulus;
    if (coupling >= 1)
        diag_add(b->part->yaml->diag,
                 scene_part_later(b->part, path_of(b, "poisson"), path_of(b, "youngs_modulus_across")),
                 "lower poisson or youngs_modulus_across",
                 "%s: poisson^2 x youngs_modulus_across / youngs_modulus is %.4g, and is below 1 in every material",
                 label_of(b, "poisson"), coupling);
}

void scene_sense_object(const struct scene_part *p, const struct object_given *o, const char *body)
{
    struct body b = {p, o, body, ""};
    if (!o->given || !scene_part_known(p, path_of(&b, "shape"))) return;
    b.shape = keys_find(path_of(&b, "shape"))->choices[o->shape].word;
    thickness_check(&b);
    edges_check(&b);
    material_check(&b);
    orthotropic_check(&b);
}
