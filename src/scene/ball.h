/* The ball of a rolling contact: what follows from its keys. */
#ifndef SCENE_BALL_H
#define SCENE_BALL_H
#include <stdbool.h>
#include <string.h>

#include "scene/scene.h"

/* Does the contact's model roll? */
static inline bool ball_rolls(const struct contact *c)
{
    return c->contact.model == CONTACT_ROLL || c->contact.model == CONTACT_ROLL_COUPLED;
}

/* What touches the surface, in keys and messages: "ball" or "scraper". */
static inline const char *ball_tool(const struct contact *c) { return ball_rolls(c) ? "ball" : "scraper"; }

/* Is a key's value a copy of what the ball's own key says (ball_apply)? */
static inline bool ball_copies(const struct contact *c, const char *path)
{
    return ball_rolls(c) && strncmp(path, "scraper.", 8) == 0;
}

/* Of a rolling contact: fills in c->scraper, what touches the surface, from c->ball: mass (NAN: nothing says it),
 * weight, radius, patch, response. */
void ball_apply(struct contact *c);

/* kg; NAN where it is neither given nor follows from radius, wall and the material's (or object's) density. */
double ball_mass(const struct ball *b);

/* I / (m R^2) of the body; of what slides, 0. */
double ball_inertia(const struct contact *c);

/* Acceleration of gravity along the normal of the surface, m/s^2: g cos(incline). */
double ball_gravity(const struct contact *c);

/* Hertz's stiffness of the ball, N/m^1.5: given stiffness, kappa times mass, or NAN. */
double ball_stiffness(const struct contact *c);

#endif
