/* The pinned hashes of an effective scene: inputs: [{file: ..., sha256: ...}]. */
#ifndef SCENE_SCENE_INPUTS_H
#define SCENE_SCENE_INPUTS_H
#include "file/yaml.h"
#include "scene/scene.h"

/* Reads the list (NULL: there is none) into s->inputs; errors go to the diagnostics. The files are not opened. */
void scene_inputs_read(struct yaml *y, const struct yaml_node *list, struct scene *s);

#endif
