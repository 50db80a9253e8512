/* What a part of a scene must, may and must not have. */
#ifndef SCENE_SCENE_CHECK_H
#define SCENE_SCENE_CHECK_H
#include "scene/scene_part.h"

/* Fills every field of the part's struct: given values, defaults, "not given", and sections' flags; tells what is missing, does
   not apply, or excludes another. */
void scene_check_fill(const struct scene_part *p);

#endif
