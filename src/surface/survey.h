/* What a measured map's heights are like: spectrum along its rows, moments, band limit. */
#ifndef SURFACE_SURVEY_H
#define SURFACE_SURVEY_H
#include <stddef.h>

#include "base/arena.h"
#include "surface/spectrum.h"

struct survey_grid {
    const double *z;      /* [rows][columns], m, without holes */
    size_t columns, rows; /* columns >= 16                     */
    double pitch;         /* m, along a row                    */
};

/* One-sided density along the rows as a table of one node per third of an octave: Welch's estimate, Hann segments of an
   eighth of a row (but at least 1024 samples or the whole row) overlapping by half, each row without its least-squares
   line. Up to 256 rows are read, evenly spread. A node stands at the middle of its band (in log k), its density is the
   mean over the band; the first band begins 2 lines above 0 and holds at least 3 lines. Flat below; ends at the middle
   of the last band below the Nyquist frequency. */
struct spectrum survey_spectrum(struct arena *a, const struct survey_grid *g);

/* Where a measured spectrum stops, in cycles/m. Its knee: where the density begins to fall to less than 1/1000 within
   an octave, as no surface's does but every instrument's (of that octave's nodes the first behind which it falls by
   more than 0.3); the last node if there is none. Its band limit: where it has fallen to 1/1000 of what it is at the
   knee. */
double survey_knee(const struct spectrum *s);
double survey_limit(const struct spectrum *s);

/* Exponent, and density at k, of the power law through the nodes of the two octaves below k (least squares in log-log).
   NAN: fewer than three nodes. */
double survey_fit(const struct spectrum *s, double k, double *density);

/* Of all heights less the least-squares plane (line, if there is one row). */
struct survey_moments {
    double rms, skewness, kurtosis;
};
struct survey_moments survey_heights(const struct survey_grid *g);

#endif
