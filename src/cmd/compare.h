/* What `rasp compare` is asked, and its parts: two sounds, two tables, one file against a hash. */
#ifndef CMD_COMPARE_H
#define CMD_COMPARE_H
#include "analysis/table_distance.h"
#include "base/arena.h"
#include "base/err.h"

struct compare_ask {
    const char *files[2];            /* A, the reference, and B; with a hash there is only A */
    const char *hash;                /* 64 lower-case digits, or NULL                       */
    bool json, quiet;
    bool exact;                      /* asked for, or nothing else is                       */
    double snr, lsb, third_octave;   /* sounds: limits, dB, steps, dB; NAN: not asked for   */
    double within;                   /* dB below the loudest third-octave band that still counts */
    const struct table_distance_tolerance *tolerances; /* tables; ends with a column of NULL */
    struct arena *arena;
};

/* Each prints its report and returns 0 or ERR_DIFFERS, or sets the error and returns its kind. */
int compare_sound(const struct compare_ask *ask, struct err *e);
int compare_table(const struct compare_ask *ask, struct err *e);
int compare_hash(const struct compare_ask *ask, bool sound, struct err *e);

#endif
