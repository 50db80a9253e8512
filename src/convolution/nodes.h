/* Chebyshev's nodes along a coordinate, between its kinks: Lagrange shares of the nodes at any place, and how many nodes an error needs. */
#ifndef CONVOLUTION_NODES_H
#define CONVOLUTION_NODES_H
#include "base/arena.h"

struct nodes;

/* Pieces between the increasing breaks[pieces + 1]; count[piece] >= 2 Chebyshev-Lobatto nodes in each, ends shared. The arena must outlive it. */
struct nodes *nodes_make(struct arena *a, int pieces, const double *breaks, const int *count);
int nodes_n(const struct nodes *n);
double nodes_place(const struct nodes *n, int k);   /* increasing with k; a piece's ends are the breaks exactly */

/* The places u[count] of which nodes_share then gives shares: made ready once for all nodes. Beyond the breaks the end stands for what is there. */
void nodes_locate(struct nodes *n, int count, const double *u);

/* Shares w[count] of node k at the places last located: at a node exactly 1 and 0, 0 outside its pieces, their sum over k 1 to rounding.
   Returns 0 when all are 0. */
int nodes_share(const struct nodes *n, int k, double *w);

enum { NODES_MOST = 4096 };

struct nodes_ask {      /* a mode A(u) e^(s(u) t) along one piece */
    double turn;        /* rad/s, half the range of Im s          */
    double decay[2];    /* 1/s, the least and the largest, >= 0   */
    double seconds;     /* of it are heard, > 0                   */
    double change;      /* nepers, range of log A                 */
};

/* Nodes of one piece that keep the relative rms error (amplitude). NODES_MOST: so many, and they may not be enough. See nodes_needed.c. */
int nodes_needed(const struct nodes_ask *ask, double error);

#endif
