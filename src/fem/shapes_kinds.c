/* See shapes_kinds.h. */
#include "fem/shapes_kinds.h"

#include <math.h>

int shapes_kinds_cells(const struct shapes_ask *q, double length, int least)
{
    double n = rint(length / q->cell);
    return n < least ? least : n > 1e6 ? 1000000 : (int)n;
}

int shapes_kinds_across(const struct shapes_ask *q, double thickness)
{
    return shapes_kinds_cells(q, thickness, (q->fineness + 1) / 2);
}
