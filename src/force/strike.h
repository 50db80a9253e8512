/* Impacts on a body that does not give way while they last: when, how fast, how long, and with what momentum. */
#ifndef FORCE_STRIKE_H
#define FORCE_STRIKE_H
#include <stdbool.h>

#include "base/err.h"
#include "force/pulse.h"
#include "scene/scene.h"

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
