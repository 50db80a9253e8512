/* How a knob's error falls as it is made finer, from rehearsals at doubled values; and the values that keep several
 * errors within one budget. */
#ifndef PIPELINE_PROMISE_CURVE_H
#define PIPELINE_PROMISE_CURVE_H
#include <stdbool.h>

enum { PROMISE_CURVE_MOST = 20 };

struct promise_curve {
    double order; /* at most counted on: scene/accuracy.def                           */
    double
        low; /* value of the first rehearsal; the next ones are its doubles (of a knob that counts down: its halves) */
    bool down;  /* less is finer                                                    */
    double end; /* the finest value that there is                                   */
    int n;
    double apart[PROMISE_CURVE_MOST]; /* [i]: relative rms difference of rehearsals i and i + 1 */
};

/* The value of rehearsal i, if there is one so fine. */
double promise_curve_value(const struct promise_curve *c, int i);

/* Relative rms error at a value, by the differences; beyond the last one by the order seen, at most `order`. Never said
   to be less than PROMISE_FLOOR, unless all differences are 0. */
#define PROMISE_FLOOR 1e-7
double promise_curve_error(const struct promise_curve *c, double value);

/* Is all known that rehearsals can tell? Up to `end`; or, of a knob of more than PROMISE_CURVE_FAR doublings, from
   there on as soon as two orders in a row agree. It does not depend on what is asked. */
enum { PROMISE_CURVE_FAR = 6 };
bool promise_curve_settled(const struct promise_curve *c);

/* Is enough rehearsed to tell the value at which the error is at most that much? That there is none is believed of a
 * settled curve only. */
bool promise_curve_enough(const struct promise_curve *c, double error);

/* The value with the least error: mostly `end`. */
double promise_curve_best(const struct promise_curve *c);

/* The coarsest whole value with at most that error; NAN: there is none. */
double promise_curve_least(const struct promise_curve *c, double error);

#endif
