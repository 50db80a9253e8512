/* The effective scene: everything spelt out, so that rendering it gives the same bytes. */
#ifndef SCENE_SCENE_WRITE_H
#define SCENE_SCENE_WRITE_H
#include "base/arena.h"
#include "scene/scene.h"

/* YAML text of the scene with every key that applies, every accuracy knob, and the scene's inputs with their sha256.
   File names are written relative to the folder `beside` (where the text will stand). */
const char *scene_write(const struct scene *s, const char *beside, struct arena *a);

/* The files that it lists: every file of the scene once, first those of its keys. */
const char **scene_write_inputs(const struct scene *s, int *n, struct arena *a);

#endif
