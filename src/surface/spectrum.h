/* Power spectral densities of heights along a line, as tables: one-sided, m^2 per cycle/m, over spatial frequency k in
   cycles/m.

     P(k) = p[i] (k/k[i])^a between k[i] and k[i+1] (a straight line in log-log), 0 above the last node;
     below the first node p[0] if `flat`, else 0;
     times X(k), the share of a continuation that takes over at `takeover` (0: none, X = 1): 0 below takeover/sqrt 2, 1
       above takeover sqrt 2,
     sin^2(pi/2 sin^2(pi/4 (1 + 2 log2(k/takeover)))) between: with 1 - X, which is its mirror image, it adds to 1.

   rms^2 = integral of P dk. */
#ifndef SURFACE_SPECTRUM_H
#define SURFACE_SPECTRUM_H
#include <stdbool.h>

#include "base/arena.h"

struct spectrum {
    int n;         /* nodes, at least 2          */
    double *k, *p; /* [n], k rising, k and p > 0 */
    bool flat;
    double takeover; /* cycles/m                   */
};

/* The power law k^exponent from 1/longest to 1/shortest, flat below, of that rms height. */
struct spectrum spectrum_power_law(struct arena *a, double exponent, double longest, double shortest, double rms);

/* P at k >= 0, and its integral from `from` to `to`: in closed form but where X is neither 0 nor 1 (relative error
 * below 1e-9). */
double spectrum_at(const struct spectrum *s, double k);
double spectrum_power(const struct spectrum *s, double from, double to);
double spectrum_takeover(const struct spectrum *s, double k); /* X */

/* Multiplies it so that the whole has that rms; the rms as it is. */
void spectrum_scale(struct spectrum *s, double rms);
double spectrum_rms(const struct spectrum *s);

/* Highest and lowest spatial frequency with power; the latter is 0 if the table is flat below. */
double spectrum_top(const struct spectrum *s);
double spectrum_bottom(const struct spectrum *s);

/* Power at radial frequencies from kappa on that an isotropic surface has whose traces along straight lines have the
   table's density (X left out): the inverse Abel transform C2(kappa) = -(1/pi) integral of P1'(k)/sqrt(k^2 - kappa^2),
   P1 = P/2, over rings 2 pi kappa dkappa, is

     W(kappa) = integral over s >= 0 of P(sqrt(kappa^2 + s^2)) ds        (relative error below 1e-8)

   A W that rises somewhere is that of no surface: C2 would be negative there. */
double spectrum_beyond(const struct spectrum *s, double kappa);

/* ------------------------------------------------------------------ of a measured map */

struct spectrum_rows {
    const double *z;      /* [rows][columns], m, without holes */
    size_t columns, rows; /* columns >= 16                     */
    double pitch;         /* m, along a row                    */
};

/* One-sided density along the rows as a table of one node per third of an octave: Welch's estimate, Hann segments of an
   eighth of a row (but at least 1024 samples or the whole row) overlapping by half, each row without its least-squares
   line. Up to 256 rows are read, evenly spread. A node stands at the middle of its band (in log k), its density is the
   mean over the band; the first band begins 2 lines above 0 and holds at least 3 lines. Flat below; ends at the middle
   of the last band below the Nyquist frequency. */
struct spectrum spectrum_measured(struct arena *a, const struct spectrum_rows *g);

/* Where a measured spectrum stops, in cycles/m. Its knee: where the density begins to fall to less than 1/1000 within
   an octave, as no surface's does but every instrument's (of that octave's nodes the first behind which it falls by
   more than 0.3); the last node if there is none. Its band limit: where it has fallen to 1/1000 of what it is at the
   knee. */
double spectrum_knee(const struct spectrum *s);
double spectrum_limit(const struct spectrum *s);

/* Exponent, and density at k, of the power law through the nodes of the two octaves below k (least squares in log-log).
   NAN: fewer than three nodes. */
double spectrum_fit(const struct spectrum *s, double k, double *density);

/* Of all heights less the least-squares plane (line, if there is one row). */
struct spectrum_moments {
    double rms, skewness, kurtosis;
};
struct spectrum_moments spectrum_moments(const struct spectrum_rows *g);

#endif
