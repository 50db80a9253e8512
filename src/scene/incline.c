/* A rigid body that moves freely along a straight line on a slope: it rolls without slipping, or slides (then I = 0).
   Newton's second law for its centre of mass and its turning, the force at the contact eliminated:

     u'' = -g (sin(incline) + c cos(incline) sgn u') / (1 + I / (m R^2))

     u        m, way of the centre of mass from `from` towards `to`, u(0) = 0, u'(0) = start_speed >= 0
     g        m/s^2, gravity                      incline  rad, above 0: `to` lies higher
     c        rolling friction: the couple c N R against the turning of what rolls, or the force c N against what
              slides, N = m g cos(incline)
     I        kg m^2, moment of inertia about the centre; R  m, outer radius

   So u is one parabola up to the stop (if there is one before `to`), then, where g sin(incline) outweighs friction, a
   second one back to `from`, or rest for good. u and u' are continuous; u'' jumps at the stop where there is friction.
   An offset of the centre of mass, air, and the friction of what slips while it rolls are left out.

   Near the stop u = top + pull/2 (t - stop)^2, which is 0 at t = 0 and top at the stop to the last bit, and never more
   than top; without a stop u = t (speed + pull t / 2). Papers/000 has balls that roll up and down a slope (section 5.1)
   and no formula for their motion. */
#include "scene/incline.h"

#include <math.h>

#include "num/real.h"

/* Least t > 0 with t (speed + pull t / 2) = way, in the form that keeps its digits. */
static double time_to(double distance, double speed, double pull)
{
    return 2 * distance /
           (speed + sqrt(fmax(speed * speed + 2 * pull * distance, 0))); /* arrives at rest: rounding leaves -1e-17 */
}

static void stops(struct incline *i)
{
    i->stop = i->speed / -i->pull;
    i->top = -0.5 * i->pull * (i->stop * i->stop);
    i->over = i->back < 0 ? INCLINE_AT_FROM : INCLINE_RESTS;
    i->end = i->back < 0 ? i->stop + sqrt(2 * i->top / -i->back) : i->stop;
}

struct incline incline_make(const struct motion *m)
{
    double x = m->to[0] - m->from[0], y = m->to[1] - m->from[1], share = m->gravity / (1 + m->inertia);
    double slope = share * real_sin(m->incline), friction = share * m->rolling_friction * real_cos(m->incline);
    struct incline i = {.length = sqrt(x * x + y * y),
                        .speed = m->start_speed,
                        .pull = 0 - slope - friction,
                        .stop = HUGE_VAL,
                        .top = HUGE_VAL,
                        .over = INCLINE_AT_TO};
    i.back = slope > friction ? friction - slope : 0;
    if (i.speed == 0 && i.pull <= 0) {
        i.over = INCLINE_STUCK;
        i.end = NAN;
    } else if (i.pull < 0 && -0.5 * i.speed * i.speed / i.pull < i.length)
        stops(&i);
    else
        i.end = time_to(i.length, i.speed, i.pull);
    return i;
}

void incline_at(const struct incline *i, double t, double out[3])
{
    bool over = t > i->stop;
    double pull = over ? i->back : i->pull, since = t - i->stop;
    if (i->stop < HUGE_VAL) {
        out[0] = i->top + 0.5 * pull * (since * since);
        out[1] = pull * since;
    } else {
        out[0] = t * (i->speed + 0.5 * pull * t);
        out[1] = i->speed + pull * t;
    }
    out[2] = pull;
}

double incline_lasts(const struct incline *i, const struct motion *m)
{
    return isnan(m->duration) ? i->end : m->duration;
}

bool incline_exits(const struct incline *i, double duration)
{
    return (i->over == INCLINE_AT_TO || i->over == INCLINE_AT_FROM) && duration > i->end * (1 + 1e-9);
}

double incline_distance(const struct incline *i, double t)
{
    double at[3];
    incline_at(i, t, at);
    return t > i->stop ? i->top + (i->top - at[0]) : at[0];
}

const char *incline_event(const struct incline *i)
{
    return i->over == INCLINE_AT_TO     ? "reaches motion.to"
           : i->over == INCLINE_AT_FROM ? "is back at motion.from"
                                        : "rests";
}

const char *incline_stuck(const struct motion *m, const char **cure)
{
    if (m->incline > 0) {
        *cure = "give a motion.start_speed above 0, such as 1 m/s; or swap motion.from and motion.to and turn "
                "motion.incline's sign";
        return "the way leads upwards, and motion.start_speed is 0: nothing drives it towards motion.to";
    }
    *cure = "give a motion.start_speed above 0, such as 1 m/s, or a motion.incline further below 0, such as -5 deg";
    if (m->incline == 0 || m->gravity == 0)
        return m->gravity == 0 ? "contact.gravity and motion.start_speed are 0: nothing moves it"
                               : "the way is level, and motion.start_speed is 0: nothing moves it";
    return "motion.start_speed is 0, and motion.rolling_friction holds it on this slope";
}

bool incline_can(const struct incline *i, const struct motion *m, struct err *e)
{
    if (isnan(m->gravity))
        return err_set(e, ERR_SCENE, "motion: contact.gravity must be given where motion.path is incline");
    const char *cure, *why = i->over == INCLINE_STUCK ? incline_stuck(m, &cure) : NULL;
    double lasts = incline_lasts(i, m);
    if (why) return err_set(e, ERR_SCENE, "motion: %s; %s", why, cure);
    if (incline_exits(i, lasts))
        return err_set(e, ERR_SCENE,
                       "motion.duration is %.6g s, and the motion %s after %.6g s; lower it or leave it out, or make "
                       "the way longer",
                       lasts, incline_event(i), i->end);
    return lasts <= INCLINE_LONGEST ||
           err_set(e, ERR_SCENE,
                   "motion: it is %.4g s before it %s, and a motion lasts at most %g s; give motion.duration", lasts,
                   incline_event(i), INCLINE_LONGEST);
}
