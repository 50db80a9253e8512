/* A mode table as it stands in its file, checked: the step between file/csv.h and struct modes.

   Tidy CSV, one row per place and mode:
       place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad
   h(t) = gain e^(-decay_per_s t) sin(2 pi frequency_hz t + phase_rad), in the quantity per N s; ids of places and modes
   are texts, rows in any order. Two other forms, for envelopes that are no single exponential (papers/000 equation 10):
   - one more column `slope` (1, 2, ...): several rows of one place and mode, with their own decay, gain and phase, that
   sound together;
   - the columns `time_s,amplitude` instead of `decay_per_s,gain`, one row per place, mode and time: the envelope
   A(tau), sampled, which is fitted by up to six slopes (slopes.h). Comments before the header, "# key: value": poles
   shared: frequency and decay of a mode are the same at every place (checked, 1e-9), and every place has every mode.
                      separate: a place's own; a place may lack a mode; decays above 0.
       gains          of separate poles, between places: logarithmic (papers/000; the default), or complex: as numbers
   that may pass zero quantity       displacement, velocity or acceleration, per N s pairing        ids: modes of one id
   are one mode; frequency: see morph.h. Default: ids, unless places differ in the ids they have, and ids that several
   have are not within 12 % of one frequency for the most part radius_m       of a sphere of the object's size, for a
   monopole's sound (optional) normalisation, source, ...   free text */
#ifndef RESPONSE_MODE_TABLE_H
#define RESPONSE_MODE_TABLE_H
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "base/arena.h"
#include "base/err.h"
#include "file/csv.h"
#include "response/modes.h"

struct mode_slope {
    double decay, gain, phase;
};

struct mode_entry {          /* a mode at a place */
    size_t place, mode, row; /* numbers: places by x, then y, modes by lowest frequency; first row of the CSV */
    double frequency;
    int n;
    struct mode_slope *slope; /* [n] by rising decay */
};

struct mode_table {
    struct csv csv;
    int quantity;              /* enum modes_quantity */
    bool shared, by_frequency; /* poles; pairing */
    bool complex;              /* gains, of separate poles */
    double radius;             /* m; NAN: not given */
    size_t places, modes;      /* places; ids of modes */
    double *xy;                /* [places][2] m */
    size_t *row;               /* [places] first row of each */
    size_t *first;             /* [places + 1] where its entries begin */
    struct mode_entry *entry;  /* [first[places]] by place, then by mode */
    const char *note;          /* a warning; NULL: none */
};

/* Reads and checks everything but the geometry. Errors: as csv_read, else ERR_SCENE with file and line. */
bool mode_table_read(const char *path, struct arena *a, struct mode_table *t, struct err *e);

/* For an error in a place: sets ERR_SCENE "file:line: place 'name' text", line its first; returns false. */
bool mode_table_bad_place(const struct mode_table *t, size_t place, const char *text, struct err *e);

/* Writing a mode table: the format that mode_table.h reads. */

/* The columns' line; comments ("# key: value") go before it. */
void mode_table_write_header(FILE *f);

/* One place's rows: modes order[0 .. n-1] of the point, numbered from 1 in that order, numbers with as many digits as
   the place says (zero without sign). Gains have the sign of the mode shapes' product: that of Re A of a displacement,
   Im A of a velocity, -Re A of an acceleration (phases near 0, pi/2, pi). */
struct mode_table_place {
    int digits; /* 12 of closed forms; 9 of what linear algebra on another CPU would give other last digits */
    int id;
    double x, y; /* m */
};

void mode_table_write_place(FILE *f, const struct mode_table_place *place, int n, const int *order,
                            const struct modes_point *p, int quantity);

#endif
