/* A motion as the scene has it: what follows from its keys before its path is computed; and the free one along the
   straight path `incline`, in closed form (motion.c), by which the checks and trajectory/speed.c both go. */
#ifndef TRAJECTORY_MOTION_H
#define TRAJECTORY_MOTION_H
#include <math.h>

#include <stdbool.h>

#include "base/err.h"
#include "scene/scene.h"

/* Is the path one straight line, on which the place is from + u e? (Of a contact that stays: at.) */
static inline bool motion_straight(const struct motion *m)
{
    return m->path == PATH_STILL || m->path == PATH_BACK_AND_FORTH || m->path == PATH_LINE ||
           m->path == PATH_FOUR_IN_LINE || m->path == PATH_INCLINE;
}

/* The mean speed in m/s as far as the scene alone tells it, for predictions of cost; 0.2 where only a file would. A
   scribble's sines (trajectory/path.c) make, in the mean over their draws, a velocity along each axis
   of 1.22 times rate and size, rms; the mean of its amount is some 0.8 to 0.89 of that. */
double motion_speed(const struct motion *m);

/* The speed law that applies: SPEED_AUTO resolved; it stays SPEED_AUTO for a scribble's or a recording's own, for what
   is still, and for what moves freely. */
int motion_law(const struct motion *m);

/* May the path be gone along under the law (auto: always)? back_and_forth turns round at rest, and so does what has
   corners; a straight line has no curvature for two_thirds; what is still has no law, and what moves freely has
   gravity's. */
bool motion_law_fits(const struct motion *m, int law);

/* Is the motion surely at rest where it starts (or ends)? What a file gives may be, and counts as not. */
bool motion_rests(const struct motion *m, bool at_end);

static inline bool motion_breaks_off(const struct motion *m) { return !isnan(m->until) && m->until > 0; }

/* A time of the motion (s), or when it breaks off: motion.until, where that is given. */
static inline double motion_cut(const struct motion *m, double t)
{
    return motion_breaks_off(m) ? fmin(t, m->until) : t;
}

/* How long it lasts, in s, as far as the scene alone tells; NAN: a file or the length of a curve does. */
double motion_lasts(const struct motion *m);

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
struct incline motion_incline(const struct motion *m);

/* u in m, du/dt in m/s, d2u/dt2 in m/s^2 at t in s; before 0 and after `end` the formula goes on (at the stop: the
 * limits from before it). */
void motion_incline_at(const struct incline *i, double t, double out[3]);

/* Seconds that the motion lasts: its duration if that is given, else `end`. */
double motion_incline_lasts(const struct incline *i, const struct motion *m);

/* m, travelled in the time t <= end (or any t, if it rests for good). */
double motion_incline_distance(const struct incline *i, double t);

/* ERR_SCENE where the motion is stuck, or leaves before its duration is over, or takes longer than INCLINE_LONGEST. */
bool motion_incline_can(const struct incline *i, const struct motion *m, struct err *e);

#endif
