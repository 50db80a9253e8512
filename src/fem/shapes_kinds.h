/* A solid put together of blocks, each a lattice of n[0] x n[1] x n[2] hexahedral cells; blocks are joined where their
 * lattice points coincide. */
#ifndef FEM_SHAPES_KINDS_H
#define FEM_SHAPES_KINDS_H
#include "file/mesh.h"

enum { SHAPES_BLOCKS_MOST = 12 };

struct shapes_block {
    int n[3], which;        /* which: passed to place() */
    const char *side[3][2]; /* group of the faces at 0 and at n of each direction; NULL: none */
};

struct shapes_blocks {
    int n;
    struct shapes_block block[SHAPES_BLOCKS_MOST];
    double size; /* m, largest extent: points nearer than 1e-8 of it are one */
    /* Where lattice place c of block `which` lies, m; also between lattice points (halves). Blocks that share a side
     * must agree on it. */
    void (*place)(const void *shape, int which, const double c[3], double at[3]);
    const void *shape;
};

/* One more block. */
struct shapes_block *shapes_blocks_add(struct shapes_blocks *s, int which, int n0, int n1, int n2);

enum { SHAPES_LENGTHS = 5 };

struct shapes_ask {
    double length[SHAPES_LENGTHS]; /* m, in the order of the shape's keys; NAN: not given */
    int fineness;                  /* 1 to 6 */
    double nodes;                  /* of the kind, unless check() knows better */
    double cell;                   /* m, the length a cell should have */
};

struct shapes_kind {
    const char *name, *key[SHAPES_LENGTHS + 1]; /* NULL-terminated */
    int needed;                                 /* the first so many keys must be given */
    int order;                                  /* the least costly one, 3 or 4 */
    double nodes;                               /* of elements of that order at fineness 2, about */
    /* Fills in the lengths that are not given and says which does not fit; NULL: all fit. */
    bool (*check)(struct shapes_ask *q, struct err *e);
    void (*blocks)(const struct shapes_ask *q, struct arena *a, struct shapes_blocks *s);
};

enum { SHAPES_KINDS = 7 };
extern const struct shapes_kind *const shapes_kinds[SHAPES_KINDS + 1]; /* then NULL */

#endif
