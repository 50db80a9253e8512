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

struct roughness { /* section surface.roughness */
    bool given;
    double exponent;           /* one-sided power spectral density of a profile over spatial frequency ~ k^exponent */
    double rms;                /* m, of the heights                                                 */
    double longest;            /* m, wavelength above which the spectrum is flat (roll-off)         */
    double shortest;           /* m, wavelength below which it is zero                              */
    double skewness, kurtosis; /* of the height distribution; 0 and 3 are Gaussian                  */
    double grain;              /* ratio of correlation lengths along and across the grain; 1: isotropic */
    double grain_direction;    /* rad, of the grain's long axis, 0 = +x                             */
    const char *like;          /* height map whose spectrum, rms, skewness and kurtosis are taken; NULL: none */
    double like_pitch;         /* m; NAN: the file says it                                          */
};

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

/* m, the finest scale of a contact's roughness, as far as the scene tells; NAN: it has none. */
double roughness_scale(const struct contact *c);

/* What a contact's roughness holds at most, in bytes; 0: next to nothing, or it has none. */
double roughness_bytes(const struct contact *c);

/* An endless, aperiodic, Gaussian random profile with that spectrum and noise stream, computed where it is read. Close
   it with its own close(). */
struct profile *roughness_blocks(struct arena *a, const struct spectrum *s, struct noise stream);

#endif
