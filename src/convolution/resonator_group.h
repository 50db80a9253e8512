/* Eight modes of convolution/resonators.h in the lanes of a vector, and their recursion, whose equations are in
 * resonators.c. */
#ifndef CONVOLUTION_RESONATOR_GROUP_H
#define CONVOLUTION_RESONATOR_GROUP_H
#include "num/lanes.h"

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
void resonator_group_ring(struct resonator_group *const *active, int n_active, const double *f, double (*sums)[LANES],
                          int n, enum resonator_change change);

#endif
