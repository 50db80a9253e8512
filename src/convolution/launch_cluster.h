/* Eight clusters of free resonators, the lanes: all nodes of a cluster have nearly the same pole, and sound together as one carrier times a
   polynomial. See launch_cluster.c. */
#ifndef CONVOLUTION_LAUNCH_CLUSTER_H
#define CONVOLUTION_LAUNCH_CLUSTER_H
#include "num/lanes.h"

enum { LAUNCH_CLUSTER_TERMS = 7, LAUNCH_CLUSTER_ROWS = 4 };

/* How far (|d|) a node's pole may lie from its cluster's for an error of 1e-11 of the node's size. */
#define LAUNCH_CLUSTER_REACH 0.09

struct launch_cluster_row {                /* one node per lane; a state of zero: none */
    _Alignas(64) double xr[LANES];         /* state, e^(d) from the block's start      */
    double xi[LANES];
    double dr[LANES], di[LANES];           /* d = (s_node - s_cluster) times half a block */
    double ar[LANES], ai[LANES];           /* e^(s_node block)                            */
    double until[LANES];                   /* frame from which it is dropped              */
};

struct launch_cluster {
    _Alignas(64) double qr[LANES];         /* carrier's pole e^(s_cluster/rate) */
    double qi[LANES];
    double mr[LAUNCH_CLUSTER_TERMS][LANES], mi[LAUNCH_CLUSTER_TERMS][LANES];
    struct launch_cluster_row *rows;
    int used, room;                        /* rows; multiples of LAUNCH_CLUSTER_ROWS */
    double reach;                          /* largest |d| of its nodes               */
};

/* The polynomials of the coming block, and all states one block further. */
void launch_cluster_gather(struct launch_cluster *g);

/* Adds the block's sound to sums[block][LANES], lane by lane. */
void launch_cluster_sound(const struct launch_cluster *g, double (*sums)[LANES], int block);

#endif
