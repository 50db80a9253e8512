/* A moving response heard where the contact is now: y(t) = sum_m h_{x(t)}(t - m) f(m) (papers/000 equation 13 read literally; `readout` of
   rasp-scene(5)): the transpose of overlap_add.h, windows on the sound instead of on the force. */
#ifndef CONVOLUTION_READOUT_H
#define CONVOLUTION_READOUT_H
#include "convolution/overlap_add.h"

struct readout;

/* As overlap_add_open (order 1, 2, 4). */
struct readout *readout_open(size_t length, int order, int hop, overlap_add_response *response, void *self);
void readout_close(struct readout *r);

/* Frames by which force must be known ahead of the sound that is asked for. */
int readout_ahead(const struct readout *r);

/* As overlap_add_run. */
void readout_run(struct readout *r, const double *f, double *y, long frames);

#endif
