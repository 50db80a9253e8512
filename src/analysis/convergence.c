/* Richardson's extrapolation where the finest result is what the others are compared with. With h_1 > h_2 > h_3, u =
   -log2 h, and results y(h) = y + C h^p, the differences from the finest are

     d_1 = |C| (h_1^p - h_3^p),  d_2 = |C| (h_2^p - h_3^p),  so  d_1/d_2 = (2^(p(u_3 - u_1)) - 1) / (2^(p(u_3 - u_2)) -
       1) ,

   which grows with p from (u_3 - u_1)/(u_3 - u_2), at p = 0: p is found by halving, and the error of the finest is |C|
   h_3^p = d_2 / (2^(p(u_3 - u_2)) - 1). Where the ratio is not above that of p = 0 nothing is seen to converge, and the
   last difference stands for it. (Roache, Perspective: A Method for Uniform Reporting of Grid Refinement Studies, J.
   Fluids Eng. 116, 1994, has the same with a finest result that is not in the ratio.) */
#include "analysis/convergence.h"

#include <math.h>

#include "num/real.h"

#define ORDER_MOST 40.0

double convergence_slope(const double fine[2], const double log_error[2])
{
    double step = fine[1] - fine[0], fall = log_error[0] - log_error[1];
    return step != 0.0 && isfinite(fall) ? fall / step : NAN;
}

static double rise(double order, double octaves) { return real_exp10(order * octaves * real_log10(2.0)) - 1.0; }

double convergence_left(const double fine[3], const double difference[2], double *order)
{
    double far = fine[2] - fine[0], near = fine[2] - fine[1], ratio = difference[0] / difference[1], low = 0.0,
           high = ORDER_MOST / far;
    *order = NAN;
    if (!(difference[1] > 0.0)) return 0.0;
    if (!(near > 0.0 && far > near && isfinite(ratio) && ratio > far / near * (1.0 + 1e-9))) return difference[1];
    for (int i = 0; i < 60; i++) {
        double p = 0.5 * (low + high);
        if (rise(p, far) < ratio * rise(p, near))
            low = p;
        else
            high = p;
    }
    *order = 0.5 * (low + high);
    return difference[1] / rise(*order, near);
}

/* Does k beat i? Costs are positive; they are equal, as errors are, when nobody could tell them apart. */
static bool beats(const double cost[2], const double error[2], struct convergence_equal equal)
{
    double dear = 1.0 + equal.cost;
    bool cheaper = cost[0] * dear < cost[1], no_dearer = cost[0] <= cost[1] * dear,
         better = error[0] < error[1] - equal.error, no_worse = error[0] <= error[1] + equal.error;
    return (cheaper && no_worse) || (better && no_dearer); /* not with a NAN */
}

void convergence_front(int n, const double *cost, const double *error, struct convergence_equal equal, bool *on)
{
    for (int i = 0; i < n; i++) {
        on[i] = !isnan(cost[i]) && !isnan(error[i]);
        for (int k = 0; k < n && on[i]; k++)
            on[i] = !beats((const double[2]){cost[k], cost[i]}, (const double[2]){error[k], error[i]}, equal);
    }
}
