/* What `rasp compare` finds of two sounds, and its report. */
#ifndef CMD_COMPARE_SOUND_H
#define CMD_COMPARE_SOUND_H
#include "analysis/distance.h"
#include "cmd/compare.h"

enum { COMPARE_SOUND_CRITERIA = 5 };

struct criterion {
    const char *name;
    double limit, measured; /* NAN: has none */
    bool held;
    const char *says;
};

struct verdict {
    const struct compare_ask *ask;
    struct wav sound[2];
    char hash[2][HASH_TEXT];
    bool alike, shape;         /* same number of channels; same rate and frames as well */
    bool paired;               /* same channels and rate: sample n of A belongs to sample n of B */
    struct distance_samples d; /* of paired sounds */
    struct distance_bands bands;
    struct criterion criteria[COMPARE_SOUND_CRITERIA];
    int n_criteria;
    bool held, equal;
};

/* "frame 2 (0.000250 s), channel 1: A ..., B ...", "4000 Hz, channel 2: A ... dB, B ... dB". */
const char *compare_sound_place(const struct verdict *v, const struct distance_place *p);
const char *compare_sound_band(const struct verdict *v);

/* The largest difference in steps of the coarser integer encoding; NAN: there is none. */
double compare_sound_steps(const struct verdict *v);

void compare_sound_report_text(const struct verdict *v);
bool compare_sound_report_json(const struct verdict *v, struct err *e);

#endif
