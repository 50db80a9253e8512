/* Chebyshev's nodes that a straight motion over a response needs. */
#ifndef CONVOLUTION_RING_NODES_H
#define CONVOLUTION_RING_NODES_H
#include <stdbool.h>

#include "base/arena.h"
#include "response/modes.h"
#include "trajectory/trajectory.h"

struct ring_nodes {
    int pieces;         /* between kinks of the response                     */
    double *breaks;     /* [pieces + 1] m, of u along the motion             */
    int *count;         /* [pieces] nodes in each                            */
    int n;              /* nodes in all                                      */
};

struct ring_nodes_ask {
    const struct modes *modes;
    const struct trajectory *trajectory; /* straight                    */
    double seconds;                      /* heard of a response at most */
    double error;                        /* relative rms (amplitude)    */
};

/* False: so many would be needed that they may not keep the error. */
bool ring_nodes(const struct ring_nodes_ask *ask, struct arena *a, struct ring_nodes *n);

#endif
