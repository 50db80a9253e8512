/* What a part of a scene must, may and must not have. */
#ifndef SCENE_SCENE_CHECK_H
#define SCENE_SCENE_CHECK_H
#include "scene/scene_part.h"

/* Fills every field of the part's struct: given values, defaults, "not given", and sections' flags; tells what is
   missing, does not apply, or excludes another. */
void scene_check_fill(const struct scene_part *p);

/* Where the path is not there (not even in error): "PATH is missing" and BECAUSE, told at the innermost map on its way,
   with the line that adds the value. */
void scene_check_missing(const struct scene_part *p, const char *path, const char *value, const char *because);

#endif
