/* `materials`: materials of a scene's own, by name, which `material` of a body then takes beside those of material.def.
   `rasp modes material` writes such entries. */
#ifndef SCENE_SCENE_MATERIALS_H
#define SCENE_SCENE_MATERIALS_H
#include <stdio.h>

#include "scene/material.h"
#include "scene/scene_part.h"

struct scene_material {
    struct material m; /* figures that are not given: NAN, of damping 0 */
    double wave_speed; /* m/s, sqrt(E/density), of one whose density is not known; else NAN */
    const char *like;  /* the wood whose ratios of moduli it keeps; NULL: isotropic */
};

/* [s->n_materials] of the tree's `materials`; errors are reported there. */
void scene_materials_read(struct yaml *y, const struct yaml_node *map, struct scene *s);

/* Of a material whose modulus follows from its wave_speed: the one of that density (kg/m^3). */
const struct material *scene_materials_dense(const struct scene_material *t, double density, struct arena *a);

/* Into the three bodies of a contact that was filled: the material of the scene's that each names, with the modulus
   that follows from the body's own density where the material has none (without that: reported). */
void scene_materials_assign(const struct scene_part *p, const struct scene *s, struct contact *c);

/* Is it the key of a body's material? The name of the scene's own that a field of it stands for; NULL: none. */
bool scene_materials_key(const struct key *k);
const char *scene_materials_name(const struct key *k, const struct contact *c);

/* The map, as it reads back; nothing where there are none. */
void scene_materials_write(FILE *f, const struct scene *s, struct arena *a);

#endif
