#include "force/lift.h"

#include "force/way.h"

const double *lift_load(const struct board *b, long first)
{
    return board_has(b, ITEM_LOAD) ? way_values(b, ITEM_LOAD, first) : NULL;
}

bool lift_off(const struct board *b, long k)
{
    return board_has(b, ITEM_LOAD) && *way_values(b, ITEM_LOAD, k) + *way_values(b, ITEM_LOAD, k + 1) < 0;
}

void lift_count(struct board *b, long first, int n)
{
    const double *load = lift_load(b, first);
    for (int i = 0; load && i < n; i++)
        if (load[i] + load[i + 1] < 0 && (first + i) / b->over < b->moving - 1)
            b->lifted += 1 / (b->rate * b->over);
}
