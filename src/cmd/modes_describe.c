/* What an object is, as comment lines of a mode table. */
#include <math.h>

#include "cmd/modes.h"
#include "num/real.h"
#include "response/object_kinds.h"
#include "scene/keys.h"
#include "scene/material.h"

static const char *word(const char *key, int value)
{
    return keys_find(key)->choices[value].word;
}

static void length(FILE *f, const char *name, double value)
{
    if (!isnan(value))
        fprintf(f, ", %s %.9g m", name, value);
}

static void object(FILE *f, const struct object_given *g)
{
    bool held = g->shape == OBJECT_BAR || g->shape == OBJECT_ROD || g->shape == OBJECT_PLATE || g->shape == OBJECT_DISK;
    bool slender = g->shape == OBJECT_BAR || g->shape == OBJECT_ROD;
    fprintf(f, "# object: %s", word("surface.object.shape", g->shape));
    length(f, "length", g->length);
    length(f, "width", g->width);
    length(f, "diameter", g->diameter);
    length(f, g->shape == OBJECT_ROD ? "wall" : "thickness", g->thickness);
    if (!isnan(g->tension))
        fprintf(f, ", tension %.9g N", g->tension);
    if (!isnan(g->surface_tension))
        fprintf(f, ", tension %.9g N/m", g->surface_tension);
    if (held)
        fprintf(f, ", edges %s", word("surface.object.edges", g->edges));
    if (slender)
        fprintf(f, ", %s", word("surface.object.waves", g->waves));
    fputc('\n', f);
}

static void figure(FILE *f, const char *name, double value, const char *unit)
{
    if (!isnan(value))
        fprintf(f, ", %s %.9g%s%s", name, value, *unit ? " " : "", unit);
}

/* Is a figure the object's own, in place of the material's? */
static bool changed(const struct object_given *g)
{
    return !(isnan(g->youngs_modulus) && isnan(g->youngs_modulus_across) && isnan(g->shear_modulus) && isnan(g->poisson) && isnan(g->density));
}

static bool changed_damping(const struct object_given *g)
{
    return !(isnan(g->alpha) && isnan(g->beta) && isnan(g->loss));
}

static void material(FILE *f, const struct object_body *b)
{
    const struct object_given *g = b->given;
    const struct material *m = material_find(g->material);
    bool plate = g->shape == OBJECT_PLATE, sheet = plate || g->shape == OBJECT_DISK || g->shape == OBJECT_SHELL;
    bool stiff = g->shape != OBJECT_MEMBRANE && g->shape != OBJECT_DRUM;
    fprintf(f, "# material: %s, density %.9g kg/m^3", word("surface.material", g->material), b->density);
    figure(f, "Young's modulus", stiff ? b->youngs_modulus : NAN, "Pa");
    if (plate && b->across != b->youngs_modulus) {
        figure(f, "along y", b->across, "Pa");
        figure(f, "shear modulus", b->shear, "Pa");
    }
    figure(f, "Poisson's ratio", sheet ? b->poisson : NAN, "");
    fprintf(f, "\n# damping: decay = (alpha + beta w^2 + loss w)/2, alpha %.9g 1/s, beta %.9g s, loss factor %.9g\n", b->alpha, b->beta, b->loss);
    if (m)
        fprintf(f, "# source: %s%s\n# source_of_damping: %s%s\n", changed(g) ? "the object's own figures, else " : "", m->source,
                changed_damping(g) ? "the object's own figures, else " : "", m->damping_source);
    else
        fputs("# source: the object's own figures\n", f);
}

void modes_describe(FILE *f, const struct object *o)
{
    const struct object_inside *in = object_inside(o);
    object(f, in->body->given);
    material(f, in->body);
    fprintf(f, "# holds: %s: no shear, no rotation of sections, no radiation\n", in->kind->theory);
}
