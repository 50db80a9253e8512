#include "num/lead.h"

#include <assert.h>

void lead_fold(double *lead, long n, long distance)
{
    double late = 0;
    assert(2 * distance <= n);
    for (long m = n; m >= 1; m--) /* from the end, where it is small */
        late += (double)(2 * m - 1) * lead[m - 1];
    for (long i = 0; i < distance; i++) {
        lead[i] += late / ((double)distance * (double)distance);
        lead[distance + i] -= late / ((double)distance * (double)distance);
    }
}
