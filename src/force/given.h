/* `contact.model: given`: a force from a file, of samples (WAV, NPY) or as a table over time (CSV). */
#ifndef FORCE_GIVEN_H
#define FORCE_GIVEN_H
#include <stdbool.h>

#include "scene/scene.h"

struct given_force {    /* keys contact.given.* */
    const char *file;   /* WAV, NPY or CSV                               */
    int channel;        /* of a WAV, from 1                              */
    double scale;       /* N per stored unit; NAN: 1, and a WAV must say */
    double rate;        /* Hz, of an NPY                                 */
    const char *column; /* of a CSV, beside time_s                       */
};

/* Is the force a table of times and forces? Else it is samples. */
bool given_is_table(const struct contact *c);

#endif
