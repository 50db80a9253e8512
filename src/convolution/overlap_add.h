/* Fast convolution: with responses that stay, and with one that moves with the contact. See overlap_add.c. */
#ifndef CONVOLUTION_OVERLAP_ADD_H
#define CONVOLUTION_OVERLAP_ADD_H
#include <stdbool.h>
#include <stddef.h>

/* Writes the `length` samples of response k into h: h[0] is half of h(0+), already scaled by 1/rate. */
typedef void overlap_add_response(void *self, long k, double *h, size_t length);

/* Frames of a block, at multiples of it. */
enum { OVERLAP_ADD_BLOCK = 4096 };

/* Writes the share of the force that goes to response k in frames first .. first + n - 1, at most one block. Returns 0
   when all are 0 (w is then not read). In each block k runs from 0 to n - 1. Not called where there is no force in the
   whole block. The last block may reach beyond the sound's end. */
typedef int overlap_add_share(void *self, long first, int n, int k, double *w);

/* ------------------------------------------------------------------ responses that stay: y = sum_k h_k * (w_k f) */

struct overlap_add;

struct overlap_add_source {
    int n;                          /* responses */
    size_t length;                  /* samples of the longest */
    overlap_add_share *share;       /* NULL: every response gets all of the force */
    overlap_add_response *response; /* called once for each k, when it first gets force */
    void *self;
};

struct overlap_add *overlap_add_open(const struct overlap_add_source *source);
void overlap_add_close(struct overlap_add *o);

/* Adds to y[frames] the sound of the next `frames` frames. f points at the force of the first of them; f[0 .. frames +
   OVERLAP_ADD_BLOCK - 2] must be there (zeros after the end). The result does not depend on how the sound is cut into
   calls. */
void overlap_add_run(struct overlap_add *o, const double *f, double *y, long frames);

/* ------------------------------------------------------------------ a response that moves */

/* Node k is at frame k hop. The windows w_k of all nodes sum to 1 at every frame.

       launch     y = sum_k h_k * (w_k f)      each force sample launches the response of its own place
       readout    y = sum_k w_k (h_k * f)      all past force is heard through the response of the present place

   Responses are asked for in increasing order, each once, and not at all where no force reaches their window; k may be
   negative. */
enum overlap_add_reading { OVERLAP_ADD_LAUNCH, OVERLAP_ADD_READOUT };

struct overlap_add_moving;

struct overlap_add_moving *overlap_add_moving_open(size_t length, int hop, enum overlap_add_reading reading,
                                                   overlap_add_response *response, void *self);
void overlap_add_moving_close(struct overlap_add_moving *o);
int overlap_add_moving_ahead(const struct overlap_add_moving *o);
void overlap_add_moving_run(struct overlap_add_moving *o, const double *f, double *y, long frames);

#endif
