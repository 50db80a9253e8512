/* Parts of `rasp modes extract`: options, reading, finding, table, report, picture. */
#ifndef CMD_MODES_EXTRACT_H
#define CMD_MODES_EXTRACT_H
#include "analysis/ringing.h"
#include "analysis/spectral_distance.h"
#include "analysis/strikes.h"
#include "base/hash.h"
#include "base/outfile.h"
#include "cmd/modes.h"
#include "output/gnuplot.h"

enum { MODES_EXTRACT_NOTES = 64 };

struct modes_extract_given {
    long channel, force_channel;   /* from 1; force 0: none */
    double scale, force_scale;     /* the sound's unit, N, per full scale (floating point: per unit); NAN: not given */
    int quantity;                  /* enum modes_quantity of the sound's channel */
    double radius, distance;       /* m; NAN: not given */
    double delay;                  /* s; NAN: to be found */
    bool impulse, spectrogram, slopes;
    double regularisation;         /* NAN: by the force's noise */
    double low, high;              /* Hz; NAN: by the band */
    struct strikes_options strikes;
    const char *output, *residual, *resynthesis, *response, *plot; /* files; NULL: not wanted */
    bool svg;
};

struct modes_extract_place {
    const char *file, *shown;      /* shown: as it stands in errors */
    const char *name;              /* without folders, one line: as it stands in table, notes and picture, which do not depend on where the file lies */
    char hash[HASH_TEXT];
    bool placed;                   /* a place was given */
    double x, y, gain;             /* m; factor of the sound */
    int channels, bits;
    struct strikes_recording recording;
    struct strikes strikes;
    struct strikes_response response;
    struct spectral_distance distance; /* from the response to its modes' sound */
    double *sound, *rest;          /* [n] what the modes make, and what is left */
};

struct modes_extract {
    struct cmd_call *c;
    struct arena *arena;
    struct modes_extract_given given;
    int n;
    struct modes_extract_place *place; /* [n] */
    const char *index;             /* the folder's index.csv; NULL */
    double rate, low, high;        /* Hz; the band that is searched */
    long length;                   /* samples of each response */
    long skip;                     /* samples before the first that is fitted */
    struct ringing_modes modes;    /* with A at t = 0, of the table's quantity */
    struct ringing_modes heard;    /* of the sound's channel */
    int quantity;                  /* of the table */
    bool physical;
    const char *why_not;           /* what lacks for a physical level; NULL */
    const char *note[MODES_EXTRACT_NOTES];
    int notes;
    double median_decay;           /* 1/s, of all components alike */
    double median_by_energy;       /* 1/s, that half of the energy of all components, at all places, decays no faster than */
};

void modes_extract_find_note(struct modes_extract *x, const char *text);
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
