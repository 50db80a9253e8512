/* Gauss-Legendre nodes: zeros of P_n by Newton from cos(pi (i + 3/4)/(n + 1/2)), weights 2/((1 - x^2) P_n'(x)^2)
 * (DLMF 3.5(v)). */
#include "num/gauss.h"

#include "num/real.h"

/* P_n(x); its derivative in *slope. */
static double legendre(int n, double x, double *slope)
{
    double p = 1.0, below = 0.0;
    for (int k = 0; k < n; k++) {
        double next = ((2 * k + 1) * x * p - k * below) / (k + 1);
        below = p;
        p = next;
    }
    *slope = n * (below - x * p) / (1.0 - x * x);
    return p;
}

void gauss_legendre(int n, double *node, double *weight)
{
    for (int i = 0; i < (n + 1) / 2; i++) {
        double x = 2 * i + 1 == n ? 0.0 : real_cospi((i + 0.75) / (n + 0.5)), slope;
        for (int pass = 0; pass < 6; pass++) {
            double p = legendre(n, x, &slope);
            x -= p / slope;
        }
        legendre(n, x, &slope);
        node[i] = -x;
        node[n - 1 - i] = x;
        weight[i] = weight[n - 1 - i] = 2.0 / ((1.0 - x * x) * slope * slope);
    }
}
