/* The knobs of accuracy.def: presets, and the `accuracy:` key of a scene. */
#ifndef SCENE_ACCURACY_H
#define SCENE_ACCURACY_H
#include "file/yaml.h"
#include "scene/scene.h"

/* All knobs as the preset (draft, standard, high, reference) has them; false: there is no such preset. */
bool accuracy_preset(struct accuracy *accuracy, const char *preset);

/* `high`, or {preset: high, oversampling: 16}; NULL: standard. Errors go to the diagnostics. */
void accuracy_read(struct yaml *y, const struct yaml_node *node, struct accuracy *accuracy);

#endif
