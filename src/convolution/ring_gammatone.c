/* See ring_gammatone.h. */
#include "convolution/ring_gammatone.h"

#include <string.h>

static bool undamped(const struct ring_choosing *c, int i, struct err *e)
{
    return err_set(e, ERR_SCENE, "contact '%s': %s.gammatone: %d: the mode at %.6g Hz of %s has no decay, and a gammatone of it would grow for ever; give it decay, or leave "
                                 "gammatone out", c->contact->name, c->key, c->to->gamma, c->to->modes.frequency[i], c->to->modes.name);
}

static bool fits(const struct ring_choosing *c, struct err *e)
{
    int asked = c->given->convolution, reading = c->to->reading;
    const char *name = c->contact->name;
    if (c->to->gamma == 1)
        return true;
    for (int i = 0; i < c->to->modes.n; i++)
        if (!(c->to->modes.slowest[i] > 0))
            return undamped(c, i, e);
    if (reading == MOVING_GLIDE)
        return err_set(e, ERR_SCENE, "contact '%s': surface.gammatone: %d: what glides begins at once%s; set surface.moving to launch or readout, or leave gammatone out", name,
                       c->to->gamma, c->given->moving == MOVING_AUTO ? " (surface.moving: auto is glide where surface.space travels)" : "");
    if (asked == ENGINE_NODES && c->to->moves)
        return err_set(e, ERR_SCENE, "contact '%s': surface.convolution: nodes cannot do surface.gammatone: %d; choose overlap_add, or leave surface.convolution out", name,
                       c->to->gamma);
    if (asked == ENGINE_RESONATORS && reading != MOVING_FIXED)
        return err_set(e, ERR_SCENE, "contact '%s': surface.convolution: resonators cannot do surface.gammatone: %d where poles differ from place to place; choose overlap_add, "
                                     "or leave surface.convolution out", name, c->to->gamma);
    return true;
}

bool ring_gammatone_fits(const struct ring_choosing *c, struct err *e)
{
    return fits(c, e) || err_about(e, c->contact->name, strcmp(c->key, "surface") == 0 ? "surface.gammatone" : strcmp(c->key, "ball") == 0 ? "ball.gammatone" : "scraper.gammatone");
}
