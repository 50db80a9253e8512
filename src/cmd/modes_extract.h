/* Parts of `rasp modes extract`: from recordings to modes (modes_extract_find), and what is written of them. */
#ifndef CMD_MODES_EXTRACT_H
#define CMD_MODES_EXTRACT_H
#include "analysis/modal.h"
#include "analysis/spectral_distance.h"
#include "analysis/strikes.h"
#include "base/hash.h"
#include "cmd/modes.h"
#include "output/gnuplot.h"

enum { MODES_EXTRACT_NOTES = 64 };
#define MODES_EXTRACT_NO_FORCE "no channel holds the force"
#define MODES_EXTRACT_REACH 1e-4 /* of the force's greatest power: what lies below is noise */

enum {
    MODES_EXTRACT_TABLE,
    MODES_EXTRACT_RESIDUAL,
    MODES_EXTRACT_RESYNTHESIS,
    MODES_EXTRACT_PLOT,
    MODES_EXTRACT_ENVELOPES,
    MODES_EXTRACT_FILES
};

struct modes_extract_given {
    long channel, force_channel; /* from 1; force 0: none */
    double scale, force_scale;   /* the sound's unit, N, per full scale (floating point: per unit); NAN: not given */
    int quantity;                /* enum modes_quantity of the sound's channel */
    double radius, distance;     /* m; NAN: not given */
    double delay;                /* s; NAN: to be found */
    bool impulse, spectrogram, svg;
    const char *only;                      /* strikes that are fitted, as 1,3,5-7; NULL: all that can be */
    double low, high;                      /* Hz; NAN: by the band */
    double fastest;                        /* 1/s; NAN: by the rate */
    double threshold;                      /* dB, of strikes */
    long modes;                            /* at most */
    const char *file[MODES_EXTRACT_FILES]; /* outputs; NULL: not wanted */
};

struct modes_extract_place {
    const char *file, *shown; /* shown: as it stands in errors */
    const char *name; /* without folders, one line: as it stands in table, notes and picture, which do not depend on
                         where the file lies */
    char hash[HASH_TEXT];
    bool placed;       /* a place was given */
    double x, y, gain; /* m; factor of the sound */
    struct strikes_recording recording;
    struct strikes strikes;
    double delay;                      /* s, by which the sound comes after the force */
    double high;                       /* Hz, the force's reach */
    int first, stretches;              /* of x->data */
    double explained;                  /* share of the energy of the strikes that are fitted */
    double predicted;                  /* ... of those that are not; NAN: there are none */
    int loudest;                       /* stretch: of strikes that are predicted the loudest, else of those fitted */
    struct spectral_distance distance; /* from that strike to what its modes make of it */
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
    struct modal_gain *sound; /* [found.n][n] of the sound's channel per N s, t from the strike; without force
                                         of a strike whose sound's peak is 1; se: of all */
    struct modal_gain *gain;  /* ... of the table's quantity */
    int quantity;             /* of the table */
    const char *why_not;      /* what lacks for a physical level; NULL */
    const char *note[MODES_EXTRACT_NOTES];
    int notes;
    double median_decay;     /* 1/s, of all components alike */
    double median_by_energy; /* 1/s, that half of the energy of all components is slower than */
};

/* What the options say of recordings, and the recordings that the first `operands` operands name. ERR_USAGE, ERR_INPUT,
   ERR_SCENE */
bool modes_extract_options(struct modes_extract *x, struct err *e);
bool modes_extract_recordings(struct modes_extract *x, int operands, struct err *e);

/* Strikes, and the stretches that are fitted: x->data, and the band x->low to x->high. */
bool modes_extract_find_strikes(struct modes_extract *x, struct modal_options *o, struct err *e);

/* Strikes, responses, modes, gains, what they explain. */
bool modes_extract_find(struct modes_extract *x, struct err *e);

/* The lines of a text, each once, among x->note; of a place (NULL: of none). */
void modes_extract_find_note(struct modes_extract *x, const struct modes_extract_place *p, const char *text);

/* |X|^2 of y[n], padded with 0: [size/2 + 1]. */
double *modes_extract_find_power(const double *y, long n, long size, struct arena *a);

void modes_extract_write_table(FILE *f, const struct modes_extract *x);
void modes_extract_write_envelopes(FILE *f, const struct modes_extract *x);
bool modes_extract_write_report(const struct modes_extract *x, bool json, struct err *e);
void modes_extract_write_picture(void *self, struct gnuplot *g); /* self: struct modes_extract */

#endif
