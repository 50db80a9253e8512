/* Points that coincide within a share of a size have one number. */
#ifndef FEM_GLUE_H
#define FEM_GLUE_H
#include "base/arena.h"

struct glue {
    double size, same; /* same: share of the size within which points are one, at most 1e-6 */
    size_t room;       /* slots, a power of two above twice the points */
    struct glue_slot {
        double at[3];
        int number, used;
    } * slot;
};

/* At most `most` points. */
void glue_open(struct glue *g, double size, double same, size_t most, struct arena *a);

/* Where the number of the point there stands; -1 when there was none before. */
int *glue_at(struct glue *g, const double at[3]);

#endif
