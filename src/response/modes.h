/* Modes: how an object rings. A mode is gain e^(-decay t) sin(2 pi f t + phase), t >= 0 (equation 10 with A_i(t) an exponential).
   Mode table: tidy CSV `place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad` after `# key: value` lines:
     poles          shared | separate      (separate: issue a clear error until morphing is built)
     quantity       displacement | velocity | acceleration   per N s
     normalisation, source                  free text
   With shared poles frequency and decay of a mode are the same at every place (checked, 1e-9 relative); gain and phase move. */
#ifndef RESPONSE_MODES_H
#define RESPONSE_MODES_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"

enum modes_quantity { MODES_DISPLACEMENT, MODES_VELOCITY, MODES_ACCELERATION };

struct modes {
    int n, places;
    int quantity;                 /* enum modes_quantity                                    */
    double *frequency, *decay;    /* [n] Hz, 1/s (amplitude rate), strongest mode first     */
    double *gain_re, *gain_im;    /* [places][n]: gain e^(j phase)                          */
    double *along;                /* [places] m, increasing: coordinate along the line of places */
    double base[2], axis[2];      /* the line: base + along * axis, axis a unit vector      */
};

/* Reads a table and keeps the `strongest` modes: by energy summed over places, sum gain^2 / (4 decay); a tie keeps table order.
   Places must lie on one straight line (1e-9 m). Errors name file and line: duplicate or missing (place, mode), decay < 0,
   frequency <= 0, not finite, unequal poles. */
bool modes_read(const char *path, int strongest, struct arena *a, struct modes *m, struct err *e);

/* Complex gains [n] at a point, linear in the signed gains between neighbouring places. A contact off the hull (the stretch between the
   first and the last place, also when it is beside the line) by more than 1e-9 m gets the gains of the hull's nearest point, and how far
   off it is (m) is returned; else 0. A table of one place holds everywhere: 0. */
double modes_gains_at(const struct modes *m, double x, double y, double *gain_re, double *gain_im);

/* The direct term D of an acceleration table at those gains (its delta at t = 0: what the force itself adds, per kg): sum Im(A_i/s_i),
   A_i the complex gain, s_i = -decay + j 2 pi f. 0 for the other quantities. */
double modes_direct(const struct modes *m, const double *gain_re, const double *gain_im);

/* Drops modes at or above 0.499 rate from use (sets n); returns how many were dropped. */
int modes_drop_above(struct modes *m, double rate);

/* Time after which a unit impulse's response has decayed by `decibel` (> 0) below its initial amplitude bound; slowest mode. */
double modes_ring_time(const struct modes *m, double decibel);

#endif
