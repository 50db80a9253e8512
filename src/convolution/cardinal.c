/* See convolution/cardinal.h. Order 4 is the polynomial through the two nodes on either side of a sample. */
#include "convolution/cardinal.h"

#include <math.h>

long cardinal_start(int order, int hop, long k)
{
    long twice = (2 * k - order) * hop;
    return twice > 0 ? (twice + 1) / 2 : -(-twice / 2);
}

static double at(int order, double u)
{
    if (order == 1)
        return 1.0;
    if (order == 2)
        return 1.0 - u;
    return u <= 1.0 ? (1.0 - u * u) * (2.0 - u) / 2.0 : (1.0 - u) * (2.0 - u) * (3.0 - u) / 6.0;
}

void cardinal_window(int order, int hop, double *window)
{
    int count = order * hop;
    for (int j = 0; j < count; j++)
        window[j] = at(order, fabs((double)(j - count / 2) / hop));
}
