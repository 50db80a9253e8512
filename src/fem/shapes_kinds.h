/* The shapes, each in a file of its own: check() fills in the lengths that are not given and says which does not fit;
 * blocks() lays the solid out. */
#ifndef FEM_SHAPES_KINDS_H
#define FEM_SHAPES_KINDS_H
#include "fem/shapes_blocks.h"

enum { SHAPES_KINDS_LENGTHS = 5 };

struct shapes_ask {
    double length[SHAPES_KINDS_LENGTHS]; /* m, in the order of the shape's keys; NAN: not given */
    int fineness;                        /* 1 to 6 */
    double nodes;                        /* of the kind, unless check() knows better */
    double cell;                         /* m, the length a cell should have */
};

struct shapes_kind {
    const char *name, *key[SHAPES_KINDS_LENGTHS + 1]; /* NULL-terminated */
    int needed;                                       /* the first so many keys must be given */
    int order;                                        /* the least costly one, 3 or 4 */
    double nodes;                                     /* of elements of that order at fineness 2, about */
    bool (*check)(struct shapes_ask *q, struct err *e);
    void (*blocks)(const struct shapes_ask *q, struct arena *a, struct shapes_blocks *s);
};

extern const struct shapes_kind shapes_plate, shapes_plate_bar, shapes_rod, shapes_ring, shapes_bowl, shapes_sphere,
    shapes_mug;

/* Cells along a length, at least so many. */
int shapes_kinds_cells(const struct shapes_ask *q, double length, int least);

/* Cells through a thickness: one at fineness 1 and 2, two at 3 and 4, three above; more where it is thick. */
int shapes_kinds_across(const struct shapes_ask *q, double thickness);

#endif
