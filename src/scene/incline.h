/* Free motion along the straight path `incline`, in closed form: see incline.c. The scene's checks and
 * trajectory/speed.c both go by it. */
#ifndef SCENE_INCLINE_H
#define SCENE_INCLINE_H
#include <stdbool.h>

#include "base/err.h"
#include "scene/scene.h"

#define INCLINE_LONGEST 36000.0 /* s: as motion.duration */

enum incline_end { INCLINE_AT_TO, INCLINE_AT_FROM, INCLINE_RESTS, INCLINE_STUCK };

struct incline {
    double length;         /* m, from `from` to `to`                                                          */
    double speed;          /* m/s, at the start                                                               */
    double pull;           /* m/s^2, d2u/dt2 while it goes towards `to`                                       */
    double stop;           /* s, when it stops on its way; HUGE_VAL: it does not                              */
    double top;            /* m, where; HUGE_VAL: it does not                                                 */
    double back;           /* m/s^2, below 0: d2u/dt2 on its way back from there; 0: it rests there for good  */
    double end;            /* s, when it reaches `to`, is back at `from`, or rests for good; NAN: stuck       */
    enum incline_end over; /* which of these it is; stuck: it never moves towards `to`                        */
};

/* From the motion's own values (gravity and inertia settled). A NAN among them gives a NAN in `end`. */
struct incline incline_make(const struct motion *m);

/* u in m, du/dt in m/s, d2u/dt2 in m/s^2 at t in s; before 0 and after `end` the formula goes on (at the stop: the
 * limits from before it). */
void incline_at(const struct incline *i, double t, double out[3]);

/* Seconds that the motion lasts: its duration if that is given, else `end`. */
double incline_lasts(const struct incline *i, const struct motion *m);

/* Does the duration lead beyond `to`, or back beyond `from`? (By more than 1e-9 of it.) */
bool incline_exits(const struct incline *i, double duration);

/* m, travelled in the time t <= end (or any t, if it rests for good). */
double incline_distance(const struct incline *i, double t);

/* "reaches motion.to", "is back at motion.from", "rests" */
const char *incline_event(const struct incline *i);

/* ERR_SCENE where the motion is stuck, or leaves before its duration is over, or takes longer than INCLINE_LONGEST. */
bool incline_can(const struct incline *i, const struct motion *m, struct err *e);

/* Why it is stuck, and what helps. */
const char *incline_stuck(const struct motion *m, const char **cure);

#endif
