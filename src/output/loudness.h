/* Integrated loudness and true peak, BS.1770, by libebur128. Mono is counted on two ears, two channels as left and
   right; of more channels, which are no loudspeakers of a layout, each counts with weight 1, as a front loudspeaker
   does. */
#ifndef OUTPUT_LOUDNESS_H
#define OUTPUT_LOUDNESS_H
#include <stdbool.h>
#include <stddef.h>

struct loudness;

/* As many frames are needed: one block of 0.4 s, as libebur128 counts them. */
long loudness_least(double rate);

/* peaks: true peaks are wanted, too,. NULL: cannot be set up */
struct loudness *loudness_open(int channels, double rate, bool peaks);

/* Frames [n][channels]; times scale. Blocks below -70 LUFS do not count: bring a sound to peak 1 first. */
void loudness_add(struct loudness *l, double *x, size_t frames);

/* LUFS, rounded to 1e-6, since the filter's coefficients come from libm. False: less than 0.4 s, or all of it nearly
 * silent. */
bool loudness_read(struct loudness *l, double *lufs);

/* The greatest magnitude between samples, too, of all channels: of four times as many (below 96 kHz), which finds up to
 * 0.2 dB less than there is at a third of the rate. */
double loudness_true_peak(const struct loudness *l);
void loudness_close(struct loudness *l);

#endif
