/* What a contact is, as far as its model and what it leaves out say it.

   What a contact leaves out of the model (section `ablation`): the ablated models of papers/000, experiments 1 to 3,
   sections 3.1, 3.2 and 5.1.

     paper                                                      here
     "using only the surface impulse response (eta = 0)"         sound: surface
     "only the ball IR contribution"                              sound: ball
     "lacking variation in the normal force (omitting 2.3)"       normal_force: constant
     "without a non-linearity ... (omitting 2.2)"                 nonlinearity: omitted
     "a constant surface IR (omitting ... morphing)"              response: constant

   Where other keys say the same (scraper.weight: 0, contact.limiter.curve: none), they do the same; but an ablation is
   laid over any scene, whatever its grip, limiter and weights are, and takes nothing else away. */
#ifndef TRAJECTORY_CONTACT_H
#define TRAJECTORY_CONTACT_H
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/arena.h"
#include "scene/params.h"

/* Does the contact's model roll? */
static inline bool contact_rolls(const struct contact *c)
{
    return c->contact.model == CONTACT_ROLL || c->contact.model == CONTACT_ROLL_COUPLED;
}

/* What touches the surface, in keys and messages: "ball" or "scraper". */
static inline const char *contact_tool(const struct contact *c) { return contact_rolls(c) ? "ball" : "scraper"; }

/* Is a key's value a copy of what the ball's own key says (contact_derive)? */
static inline bool contact_copies(const struct contact *c, const char *path)
{
    return contact_rolls(c) && strncmp(path, "scraper.", 8) == 0;
}

/* Does it press on the surface with what it draws or reads, whether it moves or not: a series of impacts, heights that
 * are played? */
static inline bool contact_driven(const struct contact *c)
{
    return c->contact.model == CONTACT_IMPACTS || c->contact.model == CONTACT_PLAYBACK;
}

/* Is it pressed on the surface, which it follows as far as its curvature is limited? */
static inline bool contact_pressed(const struct contact *c)
{
    return c->contact.model == CONTACT_SCRAPE || c->contact.model == CONTACT_ROLL;
}

/* The frame of the scene at which the contact begins: `start` to the nearest one, at a rate in Hz. */
static inline long contact_first_frame(const struct contact *c, double rate) { return (long)rint(c->start * rate); }

/* Of a filled contact, what follows from its keys: of one that rolls c->scraper, what touches the surface, from
 * c->ball: mass (NAN: nothing says it), weight, radius, patch, response. */
void contact_derive(struct contact *c, void *own);

/* Acceleration of gravity along the normal of the surface, m/s^2: g cos(incline). */
double contact_gravity(const struct contact *c);

/* Is the normal force held at its mean (load_constant, trajectory/load.h)? */
static inline bool contact_steady(const struct contact *c)
{
    return c->ablation.normal_force == ABLATED_FORCE_CONSTANT;
}

/* Does the surface ring everywhere as at one place? */
static inline bool contact_one_place(const struct contact *c)
{
    return c->ablation.response == ABLATED_RESPONSE_CONSTANT;
}

static inline bool contact_mutes_surface(const struct contact *c)
{
    return c->ablation.sound == ABLATED_SOUND_SCRAPER || c->ablation.sound == ABLATED_SOUND_BALL;
}

/* ... the scraper, or ball? */
static inline bool contact_mutes_tool(const struct contact *c) { return c->ablation.sound == ABLATED_SOUND_SURFACE; }

/* "normal_force: constant, sound: surface"; NULL: nothing is left out. */
const char *contact_ablation(const struct contact *c, struct arena *a);

#endif
