/* f_k(x) = (1 - x)^a (1 + x)^b p_k(x), p_k orthonormal under the weight (1 - x)^(2a) (1 + x)^(2b), so that the f_k are
   orthonormal under 1. p_k by its three-term recurrence (DLMF 18.9(i), Gautschi's normalisation), with alpha = 2a, beta
   = 2b, s = 2k + alpha + beta:

       center_k = (beta^2 - alpha^2)/(s (s + 2)),
       step_k^2 = 4 k (k + alpha)(k + beta)(k + alpha + beta)/(s^2 (s + 1)(s - 1)),
       p_0^-2 = 2^(alpha+beta+1) alpha! beta!/(alpha + beta + 1)!

   and its derivatives by the recurrence differentiated. */
#include "num/jacobi.h"

#include <math.h>

static double factorial(int n) { return n < 2 ? 1.0 : n * factorial(n - 1); }

struct jacobi jacobi_make(int a, int b)
{
    struct jacobi j = {.a = a, .b = b};
    double alpha = 2.0 * a, beta = 2.0 * b, sum = alpha + beta;
    for (int k = 0; k < JACOBI_MOST; k++) {
        double s = 2.0 * k + sum;
        j.center[k] = a == b ? 0.0 : (beta * beta - alpha * alpha) / (s * (s + 2.0));
        j.step[k] =
            k == 0 ? 0.0 : sqrt(4.0 * k * (k + alpha) * (k + beta) * (k + sum) / (s * s * (s + 1.0) * (s - 1.0)));
    }
    double weight = ldexp(factorial(2 * a) * factorial(2 * b) / factorial(2 * a + 2 * b + 1), 2 * a + 2 * b + 1);
    j.first = 1.0 / sqrt(weight);
    return j;
}

static double power(double x, int n) { return n <= 0 ? 1.0 : x * power(x, n - 1); }

void jacobi_values(const struct jacobi *j, int n, double x, double *f)
{
    double below = 0.0, p = j->first * power(1.0 - x, j->a) * power(1.0 + x, j->b);
    for (int k = 0; k < n; k++) {
        f[k] = p;
        if (k + 1 == n) break;
        p = ((x - j->center[k]) * p - j->step[k] * below) / j->step[k + 1];
        below = f[k];
    }
}

void jacobi_slopes(const struct jacobi *j, int n, double x, double *f, double *f1, double *f2)
{
    double a = j->a, b = j->b, u = 1.0 - x, v = 1.0 + x;
    double g = power(u, j->a) * power(v, j->b), slope = b / v - a / u; /* g'/g */
    double g1 = g * slope, g2 = g * (slope * slope - b / (v * v) - a / (u * u));
    double p[3] = {j->first, 0.0, 0.0}, below[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < n; k++) {
        f[k] = g * p[0];
        f1[k] = g * p[1] + g1 * p[0];
        f2[k] = g * p[2] + 2.0 * g1 * p[1] + g2 * p[0];
        if (k + 1 == n) break;
        double y = x - j->center[k];
        double next[3] = {(y * p[0] - j->step[k] * below[0]) / j->step[k + 1],
                          (y * p[1] + p[0] - j->step[k] * below[1]) / j->step[k + 1],
                          (y * p[2] + 2.0 * p[1] - j->step[k] * below[2]) / j->step[k + 1]};
        for (int d = 0; d < 3; d++) {
            below[d] = p[d];
            p[d] = next[d];
        }
    }
}
