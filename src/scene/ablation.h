/* What a contact leaves out of the model (section `ablation`): the ablated models of papers/000, experiments 1 to 3,
   sections 3.1, 3.2 and 5.1.

     paper                                                      here
     "using only the surface impulse response (eta = 0)"         sound: surface
     "only the ball IR contribution"                              sound: ball
     "lacking variation in the normal force (omitting 2.3)"       normal_force: constant
     "without a non-linearity ... (omitting 2.2)"                 nonlinearity: omitted
     "a constant surface IR (omitting ... morphing)"              response: constant

   Where other keys say the same (scraper.weight: 0, contact.limiter.curve: none), they do the same; but an ablation is
   laid over any scene, whatever its grip, limiter and weights are, and takes nothing else away. */
#ifndef SCENE_ABLATION_H
#define SCENE_ABLATION_H
#include "base/arena.h"
#include "scene/scene.h"

/* Without a non-linearity: no limiter, and of `omitted` no smoothing, which the paper has in the same section, against
   the harmonics that the non-linearity makes. */
void ablation_apply(struct contact *c);

/* Is the normal force held at its mean (rules_load)? */
static inline bool ablation_steady(const struct contact *c)
{
    return c->ablation.normal_force == ABLATED_FORCE_CONSTANT;
}

/* Does the surface ring everywhere as at one place? */
static inline bool ablation_one_place(const struct contact *c)
{
    return c->ablation.response == ABLATED_RESPONSE_CONSTANT;
}

static inline bool ablation_mutes_surface(const struct contact *c)
{
    return c->ablation.sound == ABLATED_SOUND_SCRAPER || c->ablation.sound == ABLATED_SOUND_BALL;
}

/* ... the scraper, or ball? */
static inline bool ablation_mutes_tool(const struct contact *c) { return c->ablation.sound == ABLATED_SOUND_SURFACE; }

/* "normal_force: constant, sound: surface"; NULL: nothing is left out. */
const char *ablation_text(const struct contact *c, struct arena *a);

#endif
