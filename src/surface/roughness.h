/* Procedural roughness: endless, aperiodic, random heights of a recipe, computed where they are read. */
#ifndef SURFACE_ROUGHNESS_H
#define SURFACE_ROUGHNESS_H
#include "base/arena.h"
#include "base/err.h"
#include "base/file_cache.h"
#include "file/heightfile.h"
#include "num/noise.h"
#include "scene/scene.h"
#include "surface/profile.h"
#include "surface/relief.h"
#include "surface/spectrum.h"

/* What a recipe comes to. */
struct roughness_plan {
    struct spectrum spectrum;
    double rms, skewness, kurtosis;
    const char *remark;                      /* what had to be departed from, or NULL */
    const char *doubts[HEIGHTFILE_WARNINGS]; /* about the map that it is like */
    int n_doubts;
    bool once; /* as of struct tiles_grain; false unless it is set behind roughness_plan */
};

/* The plan of a recipe, of its own numbers or of the map that it names (`like`, which is read, once for all that have
 * the file cache; NULL: none). ERR_SCENE, ERR_INPUT. */
bool roughness_plan(struct arena *a, struct file_cache *file_cache, const struct roughness *recipe,
                    struct roughness_plan *p, struct err *e);

/* A part with the heights of that plan and noise stream, in the coordinates `along` (enum along, decided). Close it
   with its own close(). NULL: ERR_SCENE, for heights or a spectrum that there are none of. */
struct relief_part *roughness_part(struct arena *a, struct roughness_plan *p, const struct roughness *recipe, int along,
                                   struct noise stream, struct err *e);

/* What a contact's roughness holds at most, in bytes; 0: next to nothing, or it has none. */
double roughness_bytes(const struct contact *c);

/* An endless, aperiodic, Gaussian random profile with that spectrum and noise stream, computed where it is read. Close
   it with its own close(). */
struct profile *roughness_blocks(struct arena *a, const struct spectrum *s, struct noise stream);

#endif
