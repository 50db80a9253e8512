/* Values: from a YAML node to the field of a key. */
#ifndef SCENE_SCENE_VALUES_H
#define SCENE_SCENE_VALUES_H
#include "scene/scene_part.h"

/* Reads the key's value from the node into its field; false: an error was reported and the field says "not given". */
bool scene_values_read(const struct scene_part *p, const struct key *k, const struct yaml_node *node);

/* The key's default, or "not given" where there is none. */
void scene_values_default(const struct scene_part *p, const struct key *k);

/* "Not given": NAN, NULL, 0. */
void scene_values_clear(const struct scene_part *p, const struct key *k);

/* A quantity alone, such as a knob; `label` is its name in messages. */
bool scene_values_quantity(struct yaml *y, const struct yaml_node *node, const char *label, enum key_dimension d,
                           double *x);

/* The same within the key's dimension and range. */
bool scene_values_number(const struct scene_part *p, const struct key *k, const struct yaml_node *node,
                         const char *label, double *x);

/* Index of the node's word in a table of choices, -1: it is none of them (nothing is reported). */
int scene_values_choice(const struct choice *choices, const struct yaml_node *node);

/* "a map", "a list", "the text 'x'". */
const char *scene_values_kind(struct yaml *y, const struct yaml_node *node);

/* What one could write for the key, for the cure in a message: its default if it has one, such as 20 g. */
const char *scene_values_example(struct yaml *y, const struct key *k);

#endif
