/* What one could write for a key, for the cure in a message. */
#ifndef SCENE_SCENE_EXAMPLE_H
#define SCENE_SCENE_EXAMPLE_H
#include "file/yaml.h"
#include "scene/keys.h"

/* A value such as 20 g: the key's default if it has one. */
const char *scene_example(struct yaml *y, const struct key *k);

#endif
