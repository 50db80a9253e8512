/* How far two sounds differ: sample by sample, as a signal-to-noise ratio, and in third-octave bands. */
#ifndef ANALYSIS_DISTANCE_H
#define ANALYSIS_DISTANCE_H
#include "base/arena.h"
#include "base/hash.h"
#include "file/wav.h"

struct distance_place {
    size_t frame;
    int channel; /* from 0           */
    double a, b; /* the two samples  */
};

struct distance_samples {
    size_t frames;               /* compared: those both have                                       */
    size_t differing;            /* samples that are not the same number                            */
    struct distance_place first; /* the first of them, when there is one                            */
    struct distance_place worst; /* where |b - a| is largest (the first such)                       */
    double largest;              /* |b - a| there                                                   */
    double snr_db;               /* 10 log10(sum a^2 / sum (b - a)^2); INFINITY when none differ,
                                    -INFINITY when a is silent and b is not                         */
};

/* a is the reference; a and b have the same number of channels and the same rate. */
void distance_samples(const struct wav *a, const struct wav *b, struct distance_samples *d);

/* SHA-256 of what a sound is, whatever file it stands in: rate (Hz), number of channels, then the samples frame by
   frame, all as little-endian binary64, -0 counted as +0. Two sounds have the same hash when rate, channels and all
   samples are the same numbers. */
void distance_hash(const struct wav *w, char hex[HASH_TEXT]);

/* Piece by piece: {rate, channels}, then the samples. */
void distance_hash_add(struct hash *h, const double *x, size_t n);

/* One step of the coarser integer encoding of the two (2^(1-bits)); 0: neither holds integers. */
double distance_step(const struct wav *a, const struct wav *b);

enum { DISTANCE_BANDS = 30, DISTANCE_BAND_1000 = 16 }; /* 25 Hz .. 20 kHz; which is the one at 1000 Hz */

double distance_band_centre(int band);  /* Hz, exact base-10 centre: 1000 * 10^((band - 16) / 10) */
double distance_band_nominal(int band); /* Hz, the name: 25, 31.5, 40, ... 20000 */

/* level[channels][DISTANCE_BANDS]: dB re 1 (mean square over the whole sound); -INFINITY where there is nothing. */
void distance_band_levels(const struct wav *w, struct arena *a, double *level);

struct distance_bands {
    int compared;      /* bands, counted over the channels, that come within range_db of the loudest */
    int band, channel; /* the worst of them (the first such); channel from 0                         */
    double worst_db;   /* |B's level - A's| there: 0 when both are silent                            */
    double a_db, b_db;
};

/* a and b have the same number of channels; their rates may differ: then only bands wholly below both Nyquist
   frequencies count. A band is compared when its level in a or in b is at most range_db below the loudest band of
   either. */
void distance_bands(const struct wav *a, const struct wav *b, double range_db, struct arena *arena,
                    struct distance_bands *d);

/* How long one sound follows another. */
#define AGREEMENT_WINDOW 10e-3 /* s */

/* Frames for which b follows a, the reference: up to the first window of 10 ms in which the difference's energy is a
   quarter of the sound's or more, and in all that comes from there on as well; all that both have when there is none.
   Same rate and number of channels. */
size_t distance_agreement(const struct wav *a, const struct wav *b);

#endif
