/* The annotated reference scene: every key there is, in a scene that is valid as it stands. */
#ifndef SCENE_KEYS_REFERENCE_H
#define SCENE_KEYS_REFERENCE_H
#include <stdio.h>

#include "base/arena.h"
#include "scene/keys.h"

void keys_reference_print(FILE *f, struct arena *a);

/* The value that the reference scene shows for a key that has no default, or NULL. */
const char *keys_reference_example(const char *path);

#endif
