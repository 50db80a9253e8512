/* `contact.model: given`: a force from a file. Samples (WAV, NPY): given_samples.c; a table over time (CSV):
 * given_table.c. */
#ifndef FORCE_GIVEN_H
#define FORCE_GIVEN_H
#include <math.h>
#include <string.h>

#include "base/err.h"
#include "scene/rules.h"
#include "scene/scene.h"

/* Is the force a table of times and forces? Else it is samples. */
static inline bool given_is_table(const struct contact *c)
{
    return c->contact.given.file && rules_ends_in(c->contact.given.file, ".csv");
}

static inline double given_scale(const struct contact *c)
{
    return isnan(c->contact.given.scale) ? 1 : c->contact.given.scale;
}

/* Keys that a file of this kind has no use for: ERR_SCENE. channel: a WAV; rate: an NPY; column: a CSV. */
static inline bool given_fits(const struct contact *c, const char *kind, struct err *e)
{
    const struct given_force *g = &c->contact.given;
    const char *key = strcmp(kind, "WAV") != 0 && g->channel != 1                     ? "channel"
                      : strcmp(kind, "NPY") != 0 && !isnan(g->rate)                   ? "rate"
                      : strcmp(kind, "CSV") != 0 && strcmp(g->column, "force_n") != 0 ? "column"
                                                                                      : NULL;
    return !key ||
           err_set(e, ERR_SCENE, "contact '%s': contact.given.%s means nothing for %s, which is read as %s: remove it",
                   c->name, key, g->file, kind);
}

/* A force ends within its motion; last: s after the motion's start, of its last sample or row. */
static inline bool given_ends(const struct contact *c, double last, double duration, struct err *e)
{
    return last <= duration + 1e-9 || err_set(e, ERR_SCENE,
                                              "contact '%s': contact.given.file: the force of %s lasts %.9g s, but the "
                                              "motion lasts %.9g s: raise motion.duration, or cut "
                                              "the file",
                                              c->name, c->contact.given.file, last, duration);
}

#endif
