/* How an impact hands over its momentum: the shape of one pulse, and how long it lasts. */
#ifndef FORCE_PULSE_H
#define FORCE_PULSE_H

enum pulse { PULSE_HALF_SINE, PULSE_HERTZ };

enum { PULSE_TERMS = 24 };

struct pulse_shape {
    int kind;                 /* enum pulse                          */
    double scale;             /* contact time in units of x_m / v    */
    double term[PULSE_TERMS]; /* hertz: see pulse.c                  */
};

struct pulse_shape pulse_make(int kind);

/* Contact time in s. mass kg, stiffness N/m (half_sine) or N/m^1.5 (hertz), speed m/s, all positive. */
double pulse_lasts(const struct pulse_shape *p, double mass, double stiffness, double speed);

/* The share, 0 to 1, of its momentum that an impact has handed over at share q of its contact time: 0 before, 1 after
   it. Rises; error below 4e-16; p(q) + p(1 - q) = 1. */
double pulse_share(const struct pulse_shape *p, double q);

/* The shape of an impact: a raised cosine (papers/002 equation 9). */

/* Share, 0 to 1, of its area that it has covered at q = (t - middle) / duration: 0 up to -1/2, 1 from 1/2 on; absolute
   error <= 4e-16. The area is amplitude duration / 2. */
double pulse_cosine(double q);

/* The same of q[n], in place, n <= PULSE_COSINES. Both are 0 and 1 exactly before and after the impact; between they
 * may differ by rounding. */
enum { PULSE_COSINES = 64 };
void pulse_cosines(int n, double *q);

#endif
