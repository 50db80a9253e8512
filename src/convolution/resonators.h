/* One exact recursion per mode: z <- p z + a f, y = Im z (papers/000 eq. 10, 13). Poles that do not move are `fixed` of
   rasp-scene(5) (every force sample is launched with the gain of its own place), poles that do are `glide` (all that
   rings is retuned). See resonators.c for the formula, its discrete convention and its cost. */
#ifndef CONVOLUTION_RESONATORS_H
#define CONVOLUTION_RESONATORS_H
#include "base/arena.h"
#include "response/modes.h"

struct resonators;

struct resonators_ask {
    int n, quantity;                 /* components; enum modes_quantity                               */
    double rate;                     /* Hz                                                            */
    const double *frequency, *decay; /* [n] poles at the start, every one below rate/2; 0 Hz is allowed */
    bool glides;                     /* resonators_run and _set get poles too                         */
    int ramp;                        /* samples per call, for which work space is kept; calls may be of any length */
};

/* State and gains zero. */
struct resonators *resonators_make(struct arena *a, const struct resonators_ask *ask);

/* Adds to y[frames] the response to f[frames] newtons, while the complex gains (of a bank that glides, the discrete
   poles e^(s/rate) too) go linearly, sample by sample, from those last given (zero before any, see resonators_set) to
   `to` at the end of the frames. A sample uses the gain and pole at its own instant. y is in the gains' quantity: y[n]
   = (1/rate) sum_m h(n-m) f[m], half of h(0+) at n = m. */
void resonators_run(struct resonators *r, const double *f, double *y, int frames, const struct modes_point *to);

/* Sets gains (and poles) at once: a start, or a contact that does not move. */
void resonators_set(struct resonators *r, const struct modes_point *at);

/* Groups of eight modes with a state that is not zero: what the next call without force costs. After 256 frames without
   force, what has fallen below 1e-22 of the loudest state there was becomes zero, whatever the calls. */
int resonators_awake(const struct resonators *r);

/* True when every state is exactly zero. */
int resonators_silent(const struct resonators *r);

#endif
