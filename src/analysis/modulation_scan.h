/* Where in the spectrum of amplitudes at irregular times a sinusoid is strongest, against what noise of the same
 * ARMA(1,1) filter does there. */
#ifndef ANALYSIS_MODULATION_SCAN_H
#define ANALYSIS_MODULATION_SCAN_H
#include "analysis/arma.h"
#include "analysis/modulation.h"

struct modulation_problem {
    const double *amplitude;
    double *time;     /* [n] from the middle, over `span`: -1/2 to 1/2 or so                         */
    double span, top; /* s; highest frequency in cycles per span                                     */
    int n;
    struct arma filter;            /* of the amplitudes, or of what the modulation leaves                         */
    double *ones;                  /* [n] whitened                                                                */
    double *value, *cosine, *sine; /* [n] work                                                                 */
};

/* The filter of a series, and the series of ones whitened by it. */
void modulation_scan_filter(struct modulation_problem *p, const double *amplitude);

double modulation_scan_dot(const double *x, const double *y, int n);

/* Takes from x its share of y. */
void modulation_scan_project(double *x, const double *y, int n);

/* Puts depth, rate (cycles per span) and probability; the phase is left. */
void modulation_scan_strongest(struct modulation_problem *p, struct modulation *m);

#endif
