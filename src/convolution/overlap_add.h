/* Fast convolution with an impulse response that may move. See overlap_add.c. */
#ifndef CONVOLUTION_OVERLAP_ADD_H
#define CONVOLUTION_OVERLAP_ADD_H
#include "base/arena.h"

struct overlap_add;

/* Writes the `length` samples of the impulse response that belongs to node k (time k hop / rate) into h: h[0] is half of h(0+),
   already scaled by 1/rate. Nodes are asked for in increasing order, each once, those without any
   force under their window not at all; k may be negative (the start's response). */
typedef void overlap_add_response(void *self, long k, double *h, size_t length);

/* order 0: a response that does not move: response(self, 0, ...) is asked for once and convolved exactly by uniform partitions.
   order 1, 2, 4: y = sum_k h_k * (w_k f), w_k the cardinal windows of piecewise constant, linear, cubic Lagrange interpolation over
   nodes at multiples of `hop` samples (w_k sums to 1 at every sample): the error against h moving sample by sample is of order
   hop^order. */
struct overlap_add *overlap_add_open(size_t length, int order, int hop, overlap_add_response *response, void *self);
void overlap_add_close(struct overlap_add *o);

/* Frames by which force must be known ahead of the sound that is asked for. */
int overlap_add_ahead(const struct overlap_add *o);

/* Adds to y[frames] the sound of the next `frames` samples. f points at the force of the first of them; f[0 .. frames + ahead - 1] must
   be there (zeros after the end). Calls may be of any length; the result does not depend on how it is cut. */
void overlap_add_run(struct overlap_add *o, const double *f, double *y, long frames);

#endif
