#include "force/lift.h"

#include "force/way.h"

void lift_off(struct board *b, long first, int n)
{
    if (!board_has(b, ITEM_LOAD))
        return;
    const double *load = way_values(b, ITEM_LOAD, first);
    double *force = way_values(b, ITEM_SUBFORCE, first);
    for (int i = 0; i < n; i++)
        if (load[i] + load[i + 1] < 0) {
            force[i] = 0;
            if ((first + i) / b->over < b->moving - 1)
                b->lifted += 1 / (b->rate * b->over);
        }
}
