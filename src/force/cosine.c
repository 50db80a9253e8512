/* The covered area of a raised cosine, phi = (1 + cos(2 pi q)) / 2 on -1/2 < q < 1/2, over the whole, 1/2:

     share(q) = q + 1/2 + sin(2 pi q) / (2 pi). */
#include "force/cosine.h"

#include "num/real.h"
#include "num/vecmath.h"

double cosine_share(double q)
{
    if (q <= -0.5 || q >= 0.5) return q >= 0.5;
    return 0.5 + (q + real_sinpi(2 * q) / (2 * REAL_PI));
}

void cosine_shares(int n, double *q)
{
    double sine[COSINE_MOST], unused[COSINE_MOST];
    if (n < 1) return;
    for (int i = 0; i < n; i++) {
        q[i] = q[i] < -0.5 ? -0.5 : q[i] < 0.5 ? q[i] : 0.5; /* where the sine is 0 exactly */
        sine[i] = 2 * q[i];
    }
    vecmath_sincospi((size_t)n, sine, sine, unused);
    for (int i = 0; i < n; i++)
        q[i] = 0.5 + (q[i] + sine[i] / (2 * REAL_PI));
}
