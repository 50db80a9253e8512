/* Nodes of launch.h that are freed from the force inside a block of what rings: they ring by themselves to its end. */
#ifndef CONVOLUTION_LAUNCH_REST_H
#define CONVOLUTION_LAUNCH_REST_H
#include "convolution/launch_ringing.h"

/* Adds Im of the nodes' states in the next `frames` frames, lane by lane, to sums[frames][LANES], and leaves the states at the last of them. */
void launch_rest(struct launch_freed *freed, int count, double (*sums)[LANES], int frames);

#endif
