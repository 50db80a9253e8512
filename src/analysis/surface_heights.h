/* What the heights of a map are like (ISO 25178-2; of a profile ISO 21920-2, where S is R): about their mean, missing
 * points left out. */
#ifndef ANALYSIS_SURFACE_HEIGHTS_H
#define ANALYSIS_SURFACE_HEIGHTS_H
#include "file/heightfile.h"

struct surface_heights {
    double mean, low, high;  /* m                                                              */
    double sa, sq, sz;       /* m: mean and root mean square of the distance from the mean; high - low */
    double ssk, sku;         /* skewness, kurtosis (Gaussian: 0, 3); NAN when all are the same  */
    double slope, curvature; /* root mean square of first and second differences along the rows, over pitch and pitch^2:
                                m/m, 1/m */
    double slope_y, curvature_y; /* down the columns; NAN of a profile                            */
};

void surface_heights(const struct heightfile *h, struct surface_heights *s);

/* How finely the heights are stored. */
struct surface_heights_steps {
    size_t looked_at, levels; /* heights looked at (at most a million), different ones among them */
    double step;  /* m: what the file says (integers, float32), or, if larger, the smallest gap between levels when at
                     most half of the heights are different; 0: none                 */
    double noise; /* 1/m: rms curvature that rounding to `step` makes: step sqrt(6/12)/pitch^2; at the knots of the
                     cubic spline it is 2.45 times as much                            */
};

void surface_heights_steps(const struct heightfile *h, struct surface_heights_steps *s);

/* What the ends of a map are like, and whether a profile repeats itself: what is heard as clicks and as a buzz. */
struct surface_heights_ends {
    double step;    /* m: rms difference of neighbouring heights                                               */
    double jump;    /* m: rms over the rows of first minus last height, which is met when the map is repeated  */
    double kink;    /* m/m: rms of twice the slope at the ends, which changes by as much when it is mirrored   */
    size_t fall[2]; /* samples at the start and at the end over which heights fall away: steps more than 1.5 times the
                       largest anywhere else in the map; 0: none */
    double drop[2]; /* m: by how much they do (rms over the rows)                                              */
};

/* Along the rows, or down the columns. Rows with a hole at an end do not count. */
void surface_heights_ends(const struct heightfile *h, bool down, struct surface_heights_ends *s);

/* The highest peak of a profile's autocorrelation at a lag of at least ten times its correlation length (at which it
   has fallen to a half) and at most half the profile. Rows of an image laid end to end show a peak at the length of a
   row. Over at most 4 million samples; all NAN or 0 for maps, with holes, and when nothing stands out. */
struct surface_heights_period {
    size_t lag, correlation; /* samples; correlation: the length                                 */
    double peak;             /* autocorrelation there                                            */
    double others;           /* rms of the autocorrelation in that range                         */
    bool stands_out; /* peak at least 0.2 and 5 times the others, and as narrow as the one at lag 0: half of it is lost
                        within three correlation lengths to both sides                           */
};
void surface_heights_period(const struct heightfile *h, struct surface_heights_period *p);

/* How far the spectrum of a map reaches, along its rows or down its columns. */
struct surface_heights_band {
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
void surface_heights_band(const struct heightfile *h, bool down, struct surface_heights_band *b);

#endif
