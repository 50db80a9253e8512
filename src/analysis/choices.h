/* Forced choices: confusion matrices, how alike two of them are, and what few answers say of a share. See choices.c. */
#ifndef ANALYSIS_CHOICES_H
#define ANALYSIS_CHOICES_H
#include <stdbool.h>
#include <stdint.h>

#include "base/arena.h"

/* 1 - ||reference - other||/||reference|| of two matrices [n][n] of shares (000 eq. 14, whose ||.||_2 may be either
 * norm): the spectral norm, which is the largest singular value, or Frobenius's. */
double choices_similarity(const double *reference, const double *other, int n, bool frobenius);

/* Rows of counts [n][n] into shares; a row of zeros stays one. */
void choices_shares(const double *counts, int n, double *shares);

/* Wilson's interval (J. Amer. Statist. Assoc. 22, 1927, 209) of a share of k in n > 0 answers; z: deviations of the
 * normal distribution to either side. */
void choices_wilson(double k, double n, double z, double interval[2]);

/* z of an interval that holds with that confidence: of m intervals all at once (Bonferroni). */
double choices_deviations(double confidence, int m);

/* Pearson's chi-squared of two rows of counts [n] having the same shares; columns without answers do not count.
 * *df 0 and p NAN: one column has all. */
double choices_chi_squared(const double *a, const double *b, int n, int *df, double *p);

/* Are differences [n] of listeners, n >= 2, centred at 0? Two-sided p of their mean under changes of sign: of all 2^n
 * where these are at most `draws`, else of so many drawn from the seed (then the observed one counts too). */
double choices_permutation(const double *d, int n, long draws, uint64_t seed, bool *all);

struct choices_equivalence {
    double mean, low, high; /* of the differences; interval of confidence 1 - 2 alpha, 90 % */
    double p;               /* the larger of the two one-sided tests'                       */
};

/* Do differences [n], n >= 2, lie within +-bound in the mean? Two one-sided t tests (Schuirmann, J. Pharmacokinet.
 * Biopharm. 15, 1987, 657). */
struct choices_equivalence choices_equivalence(const double *d, int n, double bound);

#endif
