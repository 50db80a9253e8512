/* Bessel functions J_n and e^-x I_n by Miller's algorithm (J. C. P. Miller, British Association Mathematical Tables X,
   1952; DLMF 3.6): the recurrences

       J_{k-1} = (2k/x) J_k - J_{k+1},      I_{k-1} = (2k/x) I_k + I_{k+1}

   are run down from an order far above n and x, where both functions are as good as zero, and what comes out is scaled
   by

       J_0 + 2 (J_2 + J_4 + ...) = 1,       e^-x (I_0 + 2 (I_1 + I_2 + ...)) = 1,

   so that no exponential is needed. x = 0: J_0 = I_0 = 1, all others 0. */
#include "num/bessel.h"

#include <math.h>

/* Even order above which nothing counts: J and I have fallen below 1e-20 of their size at max(n, x). */
static int start(int n, double x)
{
    double top = fmax(n + 1.0, x);
    return 2 * (int)((top + 24.0 + 5.0 * sqrt(top)) / 2.0);
}

/* sign -1: J, +1: I. */
static void miller(int n, double x, double sign, double out[2])
{
    double above = 0.0, here = 1e-290, sum = 0.0;
    out[0] = out[1] = 0.0;
    for (int k = start(n, x); k >= 0; k--) { /* here = order k */
        if (k == n + 1) out[1] = here;
        if (k == n) out[0] = here;
        if (sign > 0.0 || k % 2 == 0) sum += k > 0 ? 2.0 * here : here;
        double below = 2.0 * k / x * here + sign * above;
        above = here;
        here = below;
        if (fabs(here) > 1e250) {
            here *= 1e-250, above *= 1e-250, sum *= 1e-250;
            out[0] *= 1e-250, out[1] *= 1e-250;
        }
    }
    out[0] /= sum;
    out[1] /= sum;
}

/* Below 1e-8 two terms of the series are all there is, and 2k/x would overflow further down. */
static void small(int n, double x, double sign, double out[2])
{
    double term = 1.0;
    for (int k = 1; k <= n + 1; k++) {
        if (k == n + 1) out[0] = term;
        term *= 0.5 * x / k;
    }
    out[1] = term;
    if (sign > 0.0) out[0] *= 1.0 - x, out[1] *= 1.0 - x;
}

static void both(int n, double x, double sign, double out[2])
{
    if (x < 1e-8)
        small(n, x, sign, out);
    else
        miller(n, x, sign, out);
}

void bessel_j(int n, double x, double j[2]) { both(n, x, -1.0, j); }

void bessel_i(int n, double x, double i[2]) { both(n, x, 1.0, i); }
