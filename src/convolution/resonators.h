/* One exact recursion per mode: z <- p z + a f, y = Im z (papers/000 eq. 10, 13). Poles that do not move are `fixed` of
   rasp-scene(5) (every force sample is launched with the gain of its own place), poles that do are `glide` (all that
   rings is retuned). See resonators.c for the formula, its discrete convention and its cost. */
#ifndef CONVOLUTION_RESONATORS_H
#define CONVOLUTION_RESONATORS_H
#include "base/arena.h"
#include "num/lanes.h"
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

/* Eight modes of convolution/resonators.h in the lanes of a vector, and their recursion, whose equations are in
 * resonators.c. */
struct resonator_group {
    _Alignas(64) double zr[LANES];
    double zi[LANES], pr[LANES], pi[LANES];
    double gr[LANES], gi[LANES];   /* gains / rate                          */
    double sr[LANES], si[LANES];   /* their steps per sample                */
    double tr[LANES], ti[LANES];   /* their targets                         */
    double psr[LANES], psi[LANES]; /* steps and targets of poles that move  */
    double ptr[LANES], pti[LANES];
    int awake; /* a state may not be zero               */
};

/* Within a call: nothing; gains; gains and poles. */
enum resonator_change { RESONATOR_STEADY, RESONATOR_RAMPS, RESONATOR_GLIDES };

/* The states of n_active groups go on by n samples of the force f, N; adds their lanes' Im z to sums[n][LANES], in the
 * order of the groups. A change that is none leaves the same bits. */
void resonators_ring(struct resonator_group *const *active, int n_active, const double *f, double (*sums)[LANES], int n,
                     enum resonator_change change);

#endif
