/* The knobs of accuracy.def: presets, and the `accuracy:` key of a scene. */
#ifndef SCENE_ACCURACY_H
#define SCENE_ACCURACY_H
#include "file/yaml.h"
#include "scene/scene.h"

/* All knobs as the preset (draft, standard, high, reference) has them; false: there is no such preset. */
bool accuracy_preset(struct accuracy *accuracy, const char *preset);

/* `high`, {preset: high, oversampling: 16}, {error: -80 dB}; NULL: standard. Errors go to the diagnostics. */
void accuracy_read(struct yaml *y, const struct yaml_node *node, struct accuracy *accuracy);

/* A knob of the whole set, by its row. */
double accuracy_knob(const struct accuracy *accuracy, enum knob k);
void accuracy_turn(struct accuracy *accuracy, enum knob k, double value);

/* dB, the error that a preset aims at; NAN: none (reference), or every knob is said. */
double accuracy_target(const struct accuracy *accuracy);

/* The scene that is looked at before it is rendered: a preset that aims at an error takes knobs as coarse as its
   renders may, and refuses nothing; with those of its own, finer ones, a ground could be too fine to be held. With a
   ball of roll_coupled it has none coarser than the preset's own (pipeline/error_budget.h). */
struct scene accuracy_coarsest(const struct scene *s);

/* Is it a value that the knob can have? */
bool accuracy_takes(enum knob k, double value);

#endif
