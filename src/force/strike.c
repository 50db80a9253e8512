/* `contact.model: strike`. What strikes has the scraper's mass m and arrives with the speed v; the struck body is taken
   as immovable while they touch, and gravity and the weight at rest as nothing beside the impact's force. Pulses:
   pulse.c.

   Repeated impacts are all alike: T_n = first + n interval. A bounce train of restitution e under gravity g:

     v_{n+1} = e v_n,    T_{n+1} = T_n + t_c(v_n) + 2 e v_n / g          contact time, then flight

   An impact with restitution e hands over the momentum m v (1 + e): the elastic pulse's shape and contact time are
   kept, and its force is taken times (1 + e) / 2. (What loses energy also skews the pulse; that is left out.)

   The train is over when `count` impacts are done (0: one, or as many as there is room for), when the next one would
   not be over by the motion's end, or when the flight is shorter than the contact after it: then the ball has come to
   rest. */
#include "force/strike.h"

#include <math.h>

#include "force/hertz.h"

bool strike_stiffness(const struct contact *c, double *stiffness, struct err *e)
{
    *stiffness = c->contact.strike.stiffness;
    if (!isnan(*stiffness)) return true;
    if (c->contact.strike.pulse != PULSE_HERTZ)
        return err_set(e, ERR_SCENE,
                       "contact '%s': contact.strike.stiffness must be given where contact.strike.pulse is half_sine",
                       c->name);
    return hertz_stiffness(c, stiffness, e);
}

static bool strike_can(const struct contact *c, const struct strike_train *s, struct err *e)
{
    double lasts = pulse_lasts(&s->shape, s->mass, s->stiffness, s->speed);
    if (s->most > 1 && isnan(s->interval) && !s->bounces)
        return err_set(e, ERR_SCENE,
                       "contact '%s': contact.strike.count is %ld, and nothing says when the second impact comes: give "
                       "contact.strike.interval, or "
                       "contact.strike.restitution for a bounce train",
                       c->name, s->most);
    if (s->most != 1 && s->bounces && !(s->gravity > 0))
        return err_set(e, ERR_SCENE,
                       "contact '%s': contact.gravity is 0: what bounces never comes back; give "
                       "contact.strike.interval, or gravity",
                       c->name);
    if (s->most != 1 && s->interval < lasts)
        return err_set(e, ERR_SCENE,
                       "contact '%s': contact.strike.interval, %.4g s, is shorter than an impact, %.4g s: give a "
                       "longer one, or raise "
                       "contact.strike.stiffness",
                       c->name, s->interval, lasts);
    return s->first + lasts <= s->end || err_about(e, c->name, "motion.duration") ||
           err_set(e, ERR_SCENE,
                   "contact '%s': the first impact comes at %.4g s and lasts %.4g s, but the motion is over at %.4g s: "
                   "raise "
                   "motion.duration",
                   c->name, s->first, lasts, s->end);
}

bool strike_make(const struct contact *c, double duration, struct strike_train *s, struct err *e)
{
    const struct strike *given = &c->contact.strike;
    bool several = !isnan(given->interval) || !isnan(given->restitution);
    *s = (struct strike_train){.shape = pulse_make(given->pulse),
                               .mass = c->scraper.mass,
                               .gravity = c->contact.gravity,
                               .end = duration,
                               .restitution = isnan(given->restitution) ? 1 : given->restitution,
                               .bounces = !isnan(given->restitution),
                               .first = given->first,
                               .interval = given->interval,
                               .most = given->count || several ? given->count : 1,
                               .time = given->first,
                               .speed = given->speed,
                               .flight = HUGE_VAL};
    return strike_stiffness(c, &s->stiffness, e) && strike_can(c, s, e);
}

bool strike_next(struct strike_train *s, struct strike_impact *i)
{
    double after = s->restitution * s->speed;
    *i = (struct strike_impact){s->time, s->speed, pulse_lasts(&s->shape, s->mass, s->stiffness, s->speed),
                                s->mass * (s->speed + after)};
    if (s->over == STRIKE_GOES_ON)
        s->over = s->most && s->number == s->most ? STRIKE_COUNT
                  : s->flight < i->lasts          ? STRIKE_RESTS
                  : i->start + i->lasts > s->end  ? STRIKE_TIME
                                                  : STRIKE_GOES_ON;
    if (s->over != STRIKE_GOES_ON) return false;
    s->number++;
    if (s->bounces) {
        s->flight = 2 * after / s->gravity;
        s->time += i->lasts + s->flight;
        s->speed = after;
    } else
        s->time = s->first + (double)s->number * s->interval; /* NAN after a single one: it was the last */
    return true;
}
