/* `inputs` of an effective scene. */
#ifndef SCENE_SCENE_WRITE_INPUTS_H
#define SCENE_SCENE_WRITE_INPUTS_H
#include <stdio.h>

#include "base/arena.h"
#include "scene/keys.h"
#include "scene/scene.h"

/* The files, in that order. */
const char **scene_write_inputs_files(const struct scene *s, int *n, struct arena *a);

/* Writes them to f; file names are relative to the folder `beside`. */
void scene_write_inputs(FILE *f, const struct scene *s, const char *beside, struct arena *a);

/* A file that is listed here, and not written as a key: a recipe, whose keys are written among the scene's own. */
bool scene_write_inputs_only(const struct key *k);

#endif
