/* Errors that shrink as something gets finer: at what rate, what is left at the finest, and what is worth its price. */
#ifndef ANALYSIS_CONVERGENCE_H
#define ANALYSIS_CONVERGENCE_H
#include <stdbool.h>

/* Slope between neighbours: (log of the error at the coarser - at the finer) / (finer - coarser), both abscissae
   logarithms of how fine, in the same units as the errors' (octaves and octaves: the order; dB and dB). NAN: an error
   is 0 or not known, or both are equally fine. */
double convergence_slope(const double fine[2], const double log_error[2]);

/* What is left at the finest of three: differences (amplitudes, not logarithms) from the finest, of the coarsest and
   the one between, fine[] as above in octaves, coarsest first. *order: what is observed, or NAN. See convergence.c; the
   last difference itself when it is not seen to converge. */
double convergence_left(const double fine[3], const double difference[2], double *order);

/* What counts as equal: costs whose ratio is below 1 + cost, errors no farther apart than error. */
struct convergence_equal {
    double cost, error;
};

/* on[i]: nothing is cheaper and not worse, nor better and not dearer. NAN in either: not on it. */
void convergence_front(int n, const double *cost, const double *error, struct convergence_equal equal, bool *on);

#endif
