/* How far the spectrum of a map reaches, along its rows or down its columns. */
#ifndef ANALYSIS_SURFACE_BAND_H
#define ANALYSIS_SURFACE_BAND_H
#include "file/heightfile.h"

struct surface_band {
    size_t segment,
        segments;   /* samples of one, how many; 0 segments: too short, too many holes, or flat: all else is NAN */
    double nyquist; /* cycles/m                                                                            */
    double limit; /* cycles/m from which on, for an octave at least, the power spectral density is more than 80 dB below
                     its highest, or within 6 dB of the noise floor, but for single lines that are 40 dB below the
                     highest; NAN: it goes on to the Nyquist frequency                                            */
    bool noise; /* the limit is that of a noise floor: the top half of the band is flat within 1 dB, and 10 dB below the
                   highest */
    double floor;  /* m^2 per cycle/m, of that floor; NAN: none                                           */
    double beyond; /* share of the mean square curvature that lies above the limit, where there is no surface but noise,
                      or artefacts of resampling                                                             */
    double exponent; /* of the power law k^exponent fitted between `from` and `to` (cycles/m), the three octaves up to
                        half the limit */
    double from, to;
};

/* Median (not mean: a scratch or a dust grain in one segment does not count) over segments of up to 8192 samples, at
   most 256 of them, spread evenly, each less its least-squares line, under a four-term window with side lobes of -93 dB
   that fall by 18 dB an octave. Segments with holes are left out. */
void surface_band(const struct heightfile *h, bool down, struct surface_band *b);

#endif
