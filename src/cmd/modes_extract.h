/* Parts of `rasp modes extract`: options, reading, finding, table, report, picture. */
#ifndef CMD_MODES_EXTRACT_H
#define CMD_MODES_EXTRACT_H
#include "analysis/modal.h"
#include "analysis/spectral_distance.h"
#include "analysis/strikes.h"
#include "base/hash.h"
#include "base/outfile.h"
#include "cmd/modes.h"
#include "output/gnuplot.h"

enum { MODES_EXTRACT_NOTES = 64, MODES_EXTRACT_STRIKES = 250 };

struct modes_extract_given {
    long channel, force_channel; /* from 1; force 0: none */
    double scale, force_scale;   /* the sound's unit, N, per full scale (floating point: per unit); NAN: not given */
    int quantity;                /* enum modes_quantity of the sound's channel */
    double radius, distance;     /* m; NAN: not given */
    double delay;                /* s; NAN: to be found */
    bool impulse, spectrogram;
    const char *only;                                   /* strikes that are fitted, as 1,3,5-7; NULL: all that can be */
    double low, high;                                   /* Hz; NAN: by the band */
    double fastest;                                     /* 1/s; NAN: by the rate */
    double threshold;                                   /* dB, of strikes */
    const char *output, *residual, *resynthesis, *plot; /* files; NULL: not wanted */
    bool svg;
};

struct modes_extract_place {
    const char *file, *shown; /* shown: as it stands in errors */
    const char *name; /* without folders, one line: as it stands in table, notes and picture, which do not depend on
                         where the file lies */
    char hash[HASH_TEXT];
    bool placed;       /* a place was given */
    double x, y, gain; /* m; factor of the sound */
    int channels, bits;
    struct strikes_recording recording;
    struct strikes strikes;
    double delay;                      /* s, by which the sound comes after the force */
    double low, high;                  /* Hz, the force's reach */
    int first, stretches;              /* of x->data */
    double explained;                  /* share of the energy of the strikes that are fitted */
    double predicted;                  /* ... of those that are not; NAN: there are none */
    struct spectral_distance distance; /* from a strike to what its modes make of it: of those that are predicted the
                                          loudest, else of those that are fitted */
    int shown_stretch;                 /* which one that is */
    double noise;                      /* rms */
};

struct modes_extract_mode { /* h(t) = Im A e^(s t) per N s at every place, t from the strike; without force of a strike
                               whose sound's peak is 1 */
    double frequency, decay, frequency_se, decay_se, frequency_between, decay_between, share;
    double *re, *im, *gain_se; /* [places] */
    int mode, slope;
};

struct modes_extract {
    struct cmd_call *c;
    struct arena *arena;
    struct modes_extract_given given;
    int n;
    struct modes_extract_place *place; /* [n] */
    const char *index;                 /* the folder's index.csv; NULL */
    double rate, low, high;            /* Hz; the band that is searched */
    struct modal_data data;
    struct modal_result found;
    int components, modes;
    struct modes_extract_mode *heard; /* [components] of the sound's channel */
    struct modes_extract_mode *mode;  /* of the table's quantity */
    int quantity;                     /* of the table */
    bool physical;
    const char *why_not; /* what lacks for a physical level; NULL */
    const char *note[MODES_EXTRACT_NOTES];
    int notes;
    double median_decay;     /* 1/s, of all components alike */
    double median_by_energy; /* 1/s, that half of the energy of all components is slower than; of decays up to
                                300/s */
};

void modes_extract_find_note(struct modes_extract *x, const char *text);
/* Share of a strike's energy that the modes explain; NAN: it is no part of the fit's data. */
double modes_extract_find_explained(const struct modes_extract *x, const struct modes_extract_place *p, int strike);
bool modes_extract_options(struct modes_extract *x, struct err *e);

/* Operands to places, with their samples. */
bool modes_extract_read(struct modes_extract *x, struct err *e);

/* Responses, modes, what they explain. */
bool modes_extract_find(struct modes_extract *x, struct err *e);

/* Divides out a monopole's radiation, if its sizes are given. */
void modes_extract_write_radiation(struct modes_extract *x);

void modes_extract_write(FILE *f, const struct modes_extract *x);
void modes_extract_print(const struct modes_extract *x);
bool modes_extract_json(const struct modes_extract *x, struct err *e);
void modes_extract_plot(void *self, struct gnuplot *g); /* self: struct modes_extract */

#endif
