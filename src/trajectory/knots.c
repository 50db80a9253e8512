/* See knots.h. */
#include "trajectory/knots.h"

size_t knots_find(size_t n, const double *at, double x)
{
    size_t low = 0, high = n - 2;
    while (low < high) {
        size_t middle = (low + high + 1) / 2;
        if (at[middle] <= x)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}
