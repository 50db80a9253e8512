/* `contact.model: given`: a force from a file, of samples (WAV, NPY) or as a table over time (CSV). */
#ifndef FORCE_GIVEN_H
#define FORCE_GIVEN_H
#include <stdbool.h>

#include "scene/scene.h"

/* Is the force a table of times and forces? Else it is samples. */
bool given_is_table(const struct contact *c);

#endif
