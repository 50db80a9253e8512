/* Repeated measures: each listener gives a value for each combination of levels. Analysis of variance of all effects,
   and Tukey's comparisons of means. See anova.c. */
#ifndef ANALYSIS_ANOVA_H
#define ANALYSIS_ANOVA_H
#include "base/arena.h"

enum { ANOVA_FACTORS = 6 };

struct anova_design {
    int people, factors;       /* listeners, 2 and more; 1 to ANOVA_FACTORS                          */
    int levels[ANOVA_FACTORS]; /* 2 and more each                                                    */
    int cells;                 /* their product                                                      */
    const double *y;           /* [people][levels[0]][levels[1]]..., the last factor's running fastest */
};

struct anova_effect {
    unsigned factors;     /* bit i: factor i is one of its */
    int df, df_error;     /* of the effect; of its interaction with the listeners */
    double ss, ss_error;  /* sums of squares */
    double f, p;          /* NAN: all values are the same; f infinite: no error at all */
    double epsilon, p_gg; /* Greenhouse and Geisser's factor on both df, and p with it; 1 and p of two levels */
    double eta;           /* partial eta squared */
};

/* All effects: effect[m - 1] is that of the factors of mask m, 0 < m < 2^factors. */
void anova_within(const struct anova_design *d, struct anova_effect *effect);

/* mean[cell] and sem[cell] over listeners of the mask's factors, averaged over the others; cells as in y. */
void anova_means(const struct anova_design *d, unsigned mask, struct arena *a, double *mean, double *sem);

/* P(Q > q) of the studentized range of `groups` means, 2 to 1000, with df of the error; absolute error <= 1e-11. */
double anova_studentized_range(double q, int groups, double df);

/* p of Tukey's test that two means of the effect differ, which have `groups` levels or combinations of levels. */
double anova_tukey(const struct anova_design *d, const struct anova_effect *e, double difference);

#endif
