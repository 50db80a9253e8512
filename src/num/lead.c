#include "num/lead.h"

#include <assert.h>

void lead_fold(double *lead, long n, long apart)
{
    double late = 0;
    assert(2 * apart <= n);
    for (long m = n; m >= 1; m--) /* from the end, where it is small */
        late += (double)(2 * m - 1) * lead[m - 1];
    for (long i = 0; i < apart; i++) {
        lead[i] += late / ((double)apart * (double)apart);
        lead[apart + i] -= late / ((double)apart * (double)apart);
    }
}
