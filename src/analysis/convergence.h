/* Errors that shrink as something gets finer: at what rate, and what is worth its price. */
#ifndef ANALYSIS_CONVERGENCE_H
#define ANALYSIS_CONVERGENCE_H
#include <stdbool.h>

/* Slope between neighbours: (log of the error at the coarser - at the finer) / (finer - coarser), both abscissae
   logarithms of how fine, in the same units as the errors' (octaves and octaves: the order; dB and dB). NAN: an error
   is 0 or not known, or both are equally fine. */
double convergence_slope(const double fine[2], const double log_error[2]);

/* on[i]: nothing is cheaper and not worse, nor better and not dearer. Costs are intervals, of which one is
   cheaper that lies below the other; errors no farther apart than `equal` are equal. NAN in either: not on it. */
void convergence_front(int n, const double *from, const double *to, const double *error, double equal, bool *on);

#endif
