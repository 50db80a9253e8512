/* Which modes, readings and engines can begin softly (gammatone.h). */
#ifndef CONVOLUTION_RING_GAMMATONE_H
#define CONVOLUTION_RING_GAMMATONE_H
#include "convolution/ring_means.h"

/* ERR_SCENE: an undamped mode, which has no greatest value; poles that glide, whose chain has no such solution; engines that know exponentials alone. */
bool ring_gammatone_fits(const struct ring_choosing *c, struct err *e);

#endif
