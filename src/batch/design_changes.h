/* What a level, or `set`, changes of a scene: keys and values, checked as far as they show it by themselves. */
#ifndef BATCH_DESIGN_CHANGES_H
#define BATCH_DESIGN_CHANGES_H
#include "batch/design_reading.h"

/* The row of a path as a design writes it ("contacts.rod.motion.rate"); NULL: it is none (a section, a knob, or unknown). */
const struct key *design_changes_key(const char *path);

/* Every path of scenes that ends in the word, "motion.rate or output.diagnostics.rate", or the nearest; NULL: none. */
const char *design_changes_near(const struct design_reading *r, const char *word);

/* Is it a path of scenes? Else an error is told at the key. */
bool design_changes_known(const struct design_reading *r, const struct yaml_node *key);

/* Adds path: value, or of a map each of its keys; false: an error was told. */
bool design_changes_add(const struct design_reading *r, struct design_change *c, const struct yaml_node *key, const struct yaml_node *value);

/* Adds every key of a map `set`. */
bool design_changes_map(const struct design_reading *r, struct design_change *c, const struct yaml_node *map);

/* The keys as "motion.rate=3 Hz", ends with NULL. */
const char **design_changes_texts(const struct design_change *c, struct arena *a);

/* A value as one line of YAML. */
const char *design_changes_text(const struct yaml_node *value, struct arena *a);

#endif
