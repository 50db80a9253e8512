/* See convergence.h. */
#include "analysis/convergence.h"

#include <math.h>

double convergence_slope(const double fine[2], const double log_error[2])
{
    double step = fine[1] - fine[0], fall = log_error[0] - log_error[1];
    return step != 0.0 && isfinite(fall) ? fall / step : NAN;
}

void convergence_front(int n, const double *from, const double *to, const double *error, double equal, bool *on)
{
    for (int i = 0; i < n; i++) {
        on[i] = !isnan(from[i]) && !isnan(error[i]);
        for (int k = 0; k < n && on[i]; k++) { /* does k beat it? */
            bool cheaper = to[k] < from[i], no_dearer = from[k] <= to[i], better = error[k] < error[i] - equal,
                 no_worse = error[k] <= error[i] + equal;
            on[i] = isnan(from[k]) || !((cheaper && no_worse) || (better && no_dearer));
        }
    }
}
