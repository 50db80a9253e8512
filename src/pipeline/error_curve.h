/* How a knob's error falls as it is made finer, from pilot runs at doubled values; and the values that keep several
 * errors within one budget. */
#ifndef PIPELINE_ERROR_CURVE_H
#define PIPELINE_ERROR_CURVE_H
#include <stdbool.h>

enum { ERROR_CURVE_MOST = 20 };

struct error_curve {
    double order; /* at most counted on: scene/accuracy.def                           */
    double
        low; /* value of the first pilot run; the next ones are its doubles (of a knob that counts down: its halves) */
    bool down;  /* less is finer                                                    */
    double end; /* the finest value that there is                                   */
    int n;
    double distance[ERROR_CURVE_MOST]; /* [i]: relative rms difference of pilot runs i and i + 1 */
};

/* The value of pilot run i, if there is one so fine. */
double error_curve_value(const struct error_curve *c, int i);

/* Relative rms error at a value, by the differences; beyond the last one by the order seen, at most `order`. Never said
   to be less than ERROR_BUDGET_FLOOR, unless all differences are 0. */
#define ERROR_BUDGET_FLOOR 1e-7
double error_curve_error(const struct error_curve *c, double value);

/* Is all known that pilot runs can tell? Up to `end`; or, of a knob of more than ERROR_CURVE_FAR doublings, from
   there on as soon as two orders in a row agree. It does not depend on what is asked. */
enum { ERROR_CURVE_FAR = 6 };
bool error_curve_converged(const struct error_curve *c);

/* Is enough piloted to tell the value at which the error is at most that much? That there is none is believed of a
 * settled curve only. */
bool error_curve_enough(const struct error_curve *c, double error);

/* The value with the least error: mostly `end`. */
double error_curve_best(const struct error_curve *c);

/* The coarsest whole value with at most that error; NAN: there is none. */
double error_curve_least(const struct error_curve *c, double error);

#endif
