/* A sinc under Kaiser's window, in steps of 1/BETWEEN_PHASES of a sample:

     x(i + p) = sum over j = 1 - R..R of x[i + j] sinc(p - j) I0(beta sqrt(1 - ((p - j)/R)^2)) / I0(beta),   R =
       BETWEEN_REACH, beta = 9 */
#include "num/between.h"

#include "num/bessel.h"
#include "num/real.h"

static const double beta = 9;

static double kaiser(double u)
{
    double inside[2], whole[2], x = beta * sqrt((1 - u) * (1 + u));
    if (fabs(u) >= 1) return 0;
    bessel_i(0, x, inside);
    bessel_i(0, beta, whole);
    return inside[0] / whole[0] * real_exp(x - beta);
}

struct between between_make(struct arena *a)
{
    struct between b = {ARENA_TAKE(a, double, 2 * BETWEEN_PHASES * BETWEEN_REACH)};
    for (int p = 0; p < BETWEEN_PHASES; p++)
        for (int j = 1 - BETWEEN_REACH; j <= BETWEEN_REACH; j++) {
            double t = (double)p / BETWEEN_PHASES - j;
            b.tap[2 * BETWEEN_REACH * p + BETWEEN_REACH - 1 + j] =
                t == 0   ? 1
                : p == 0 ? 0
                         : real_sinpi(t) / (REAL_PI * t) * kaiser(t / BETWEEN_REACH);
        }
    return b;
}

double between_at(const struct between *b, const double *x, long n, long k)
{
    long i = k >= 0 ? k / BETWEEN_PHASES : -((-k + BETWEEN_PHASES - 1) / BETWEEN_PHASES), first = i + 1 - BETWEEN_REACH;
    const double *tap = b->tap + 2 * BETWEEN_REACH * (k - i * BETWEEN_PHASES);
    double sum = 0;
    if (k == i * BETWEEN_PHASES) return i >= 0 && i < n ? x[i] : 0;
    for (long j = first < 0 ? -first : 0; j < 2 * BETWEEN_REACH && first + j < n; j++)
        sum += tap[j] * x[first + j];
    return sum;
}
