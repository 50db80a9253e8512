/* A list of points, [[0, 0], [3 cm, 1 cm], ...], or of places in space, [[0, 0, 1 m], ...]. */
#ifndef SCENE_SCENE_POINTS_H
#define SCENE_SCENE_POINTS_H
#include "scene/scene_part.h"

/* [*n][keys_points_width(k)] in the arena, in the key's SI unit, each number within its range; a point of KEY_POINTS
   lies at least 1 nm from the one before. NULL: errors, each told where it stands. `label` is the key's name in
   messages. */
const double *scene_points_read(const struct scene_part *p, const struct key *k, const struct yaml_node *list,
                                const char *label, int *n);

#endif
