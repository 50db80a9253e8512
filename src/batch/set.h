/* A set of stimuli as its output folder knows it: what a design comes to once every scene has been read. See set_file.h for the file that shards leave. */
#ifndef BATCH_SET_H
#define BATCH_SET_H
#include <stdbool.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/err.h"
#include "base/hash.h"
#include "batch/design.h"

struct set_factor {
    const char *name, *column;      /* as of struct design_factor                                          */
    const char *unit, *meaning;     /* NULL: none                                                          */
    const char **texts, **values;   /* [n] of its levels; texts: what they are, in words                      */
    int n;
};

struct set_row {                    /* one stimulus                                                        */
    const char *name;
    const char **values;            /* [n_factors], for the manifest                                       */
    const char *text;               /* of the trial; NULL: none                                            */
    int replicate;
    uint64_t seed;
    const char *recording;          /* as the manifest calls it: its file's name; NULL: it is rendered      */
    double cost;                    /* predicted cycles, above 0                                            */
};

struct set {
    const char *title, *sha256;     /* of the design, with its scenes and what they read; title NULL: none  */
    const char *build;              /* of the program that renders it                                       */
    struct set_factor *factors;
    int n_factors;
    int replicates;
    struct set_row *rows;           /* in the order of the design                                           */
    int n;
    int level_rule;                 /* enum design_level_rule                                               */
    struct level level;
    double length;                  /* s, output.duration of every stimulus; NAN: each has its own          */
    double rate;                    /* Hz                                                                   */
    int channels, encoding;         /* of the WAVs: recordings must have them; encoding is an enum encoding */
    double ramp;                    /* s, of a recording that is cut                                        */
};

/* What the text of the design tells; costs, length, rate, channels, encoding and ramp are not known yet. */
void set_make(const struct design *d, const char *build, struct arena *a, struct set *s);

/* Does the gain wait for the whole set? */
bool set_waits(const struct set *s);

/* Lays the set's length and level over a scene of it. A sound that waits for its gain has full_scale 1. */
void set_lay(const struct set *s, struct scene *over);

/* "common peak -3 dB", for the manifest. */
const char *set_level_text(const struct set *s, struct arena *a);

#endif
