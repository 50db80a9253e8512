/* Integrated loudness, BS.1770, by libebur128. Mono is counted on two ears, two channels as left and right; of more channels, which are no loudspeakers of a layout,
   each counts with weight 1, as a front loudspeaker does. */
#ifndef OUTPUT_LOUDNESS_H
#define OUTPUT_LOUDNESS_H
#include <stdbool.h>
#include <stddef.h>

struct loudness;

/* As many frames are needed: one block of 0.4 s, as libebur128 counts them. */
long loudness_least(double rate);

struct loudness *loudness_open(int channels, double rate); /* NULL: cannot be set up */

/* Frames [n][channels]; times scale. Blocks below -70 LUFS do not count: bring a sound to peak 1 first. */
void loudness_add(struct loudness *l, double *x, size_t frames);

/* LUFS, rounded to 1e-6, since the filter's coefficients come from libm. False: less than 0.4 s, or all of it nearly silent. */
bool loudness_read(struct loudness *l, double *lufs);
void loudness_close(struct loudness *l);

#endif
