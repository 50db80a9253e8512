/* Impacts on a body that does not give way while they last: when, how fast, how long, and with what momentum. */
#ifndef FORCE_STRIKE_H
#define FORCE_STRIKE_H
#include <stdbool.h>

#include "base/err.h"
#include "scene/scene.h"

/* How an impact hands over its momentum: the shape of one pulse, and how long it lasts. */
enum pulse { PULSE_HALF_SINE, PULSE_HERTZ };

enum { PULSE_TERMS = 24 };

struct pulse_shape {
    int kind;                 /* enum pulse                          */
    double scale;             /* contact time in units of x_m / v    */
    double term[PULSE_TERMS]; /* hertz: see strike.c                  */
};

struct pulse_shape strike_pulse_make(int kind);

/* Contact time in s. mass kg, stiffness N/m (half_sine) or N/m^1.5 (hertz), speed m/s, all positive. */
double strike_pulse_lasts(const struct pulse_shape *p, double mass, double stiffness, double speed);

/* The share, 0 to 1, of its momentum that an impact has handed over at share q of its contact time: 0 before, 1 after
   it. Rises; error below 4e-16; p(q) + p(1 - q) = 1. */
double strike_pulse_share(const struct pulse_shape *p, double q);

/* The shape of an impact: a raised cosine (papers/002 equation 9). */

/* Share, 0 to 1, of its area that it has covered at q = (t - middle) / duration: 0 up to -1/2, 1 from 1/2 on; absolute
   error <= 4e-16. The area is amplitude duration / 2. */
double strike_pulse_cosine(double q);

/* The same of q[n], in place, n <= PULSE_COSINES. Both are 0 and 1 exactly before and after the impact; between they
 * may differ by rounding. */
enum { PULSE_COSINES = 64 };
void strike_pulse_cosines(int n, double *q);

struct strike {         /* keys contact.strike.* */
    int pulse;          /* enum pulse                                                               */
    double speed;       /* m/s, of the first impact                                                 */
    double stiffness;   /* N/m of half_sine, N/m^1.5 of hertz; NAN: hertz from radius and materials */
    double first;       /* s after the contact's start                                              */
    int count;          /* 0: one, or as many as there is time for                                  */
    double interval;    /* s; NAN: a bounce train by restitution                                    */
    double restitution; /* of a bounce train; NAN: repeated impacts                                 */
};

struct strike_impact {
    double start;    /* s after the contact's start       */
    double speed;    /* m/s, of arrival                   */
    double lasts;    /* s, contact time                   */
    double momentum; /* N s, handed over                  */
};

enum strike_end { STRIKE_GOES_ON, STRIKE_COUNT, STRIKE_RESTS, STRIKE_TIME };

struct strike_train {
    struct pulse_shape shape;
    double mass, stiffness; /* kg; N/m or N/m^1.5                */
    double restitution;     /* 1: nothing is lost                */
    double gravity;         /* m/s^2                             */
    bool bounces;
    double first, interval; /* s; interval: of repeated impacts  */
    double end;             /* s, of the motion                  */
    long most, number;      /* 0: no limit; impacts so far       */
    double time, speed;     /* of the next one                   */
    double flight;          /* s, before it                      */
    enum strike_end over;   /* why there is no further one       */
};

/* The impacts of a contact whose motion lasts `duration` (s). ERR_SCENE, with the contact's name: impacts that overlap,
   no room for the first one, a stiffness that nothing gives. */
bool strike_make(const struct contact *c, double duration, struct strike_train *s, struct err *e);

/* The next impact; false (see s->over) after the last one. */
bool strike_next(struct strike_train *s, struct strike_impact *i);

/* Stiffness of the contact: the given one, or Hertz's (force/hertz.h). ERR_SCENE: the scene does not tell it. */
bool strike_stiffness(const struct contact *c, double *stiffness, struct err *e);

#endif
