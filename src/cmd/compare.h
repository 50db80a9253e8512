/* What `rasp compare` is asked, and its parts: two sounds, two tables, one file against a hash. */
#ifndef CMD_COMPARE_H
#define CMD_COMPARE_H
#include "analysis/table_distance.h"
#include "base/arena.h"
#include "base/err.h"
#include "cmd/cmd.h"

struct compare_ask {
    const char *files[2]; /* A, the reference, and B; with a hash there is only A */
    bool json, quiet;
    bool exact;                                        /* asked for, or nothing else is                       */
    double snr, lsb, third_octave;                     /* sounds: limits, dB, steps, dB; NAN: not asked for   */
    double within;                                     /* dB below the loudest third-octave band that still counts */
    const struct table_distance_tolerance *tolerances; /* tables; ends with a column of NULL */
    FILE *out;                                         /* where the report goes                               */
    struct arena *arena;
};

/* Rows of an option table: within what a sound or a table may differ. */
#define COMPARE_SOUND_LIMITS                                                                                           \
    {"snr", 0, "DB", false, "sounds: the difference is at least this far below A (signal-to-noise ratio)"},            \
        {"lsb", 0, "N", false, "sounds: no sample differs by more than N steps of the coarser integer encoding"},      \
        {"third-octave", 0, "DB", false,                                                                               \
         "sounds: no third-octave band near the loudest differs by more (see --within); alone, rates may differ"},     \
    {                                                                                                                  \
        "within", 0, "DB", false, "sounds: third-octave bands farther than this below the loudest are left out (60)"   \
    }
#define COMPARE_TABLE_LIMITS                                                                                           \
    {"tolerance", 't', "FILE", false,                                                                                  \
     "tables: a table column,abs,rel of tolerances; the column * stands for all others"},                              \
        {"column", 'c', "NAME=ABS,REL", true, "tables: the tolerance of one column; overrides the file"},              \
        {"abs", 0, "X", false, "tables: absolute tolerance of all columns not named; overrides the file's *"},         \
    {                                                                                                                  \
        "rel", 0, "Y", false, "tables: relative tolerance of all columns not named; overrides the file's *"            \
    }

/* The first of those options that was given, of sounds or of tables; NULL: none. */
const char *compare_limit_of_sounds(const struct args *g);
const char *compare_limit_of_tables(const struct args *g);

/* Their values; `folder` (NULL: the current one) is where a relative name of --tolerance starts. ERR_USAGE, ERR_INPUT,
 * ERR_SCENE */
bool compare_limits(const struct args *g, const char *folder, struct compare_ask *ask, struct err *e);

/* Is the file a sound, rather than a table? ERR_INPUT: it is not there. */
bool compare_is_sound(const char *path, bool *sound, struct err *e);

/* Each prints its report and returns 0 or ERR_DIFFERS, or sets the error and returns its kind. */
int compare_sound(const struct compare_ask *ask, struct err *e);
int compare_table(const struct compare_ask *ask, struct err *e);

#endif
