/* Where the sound is heard: turns modes of an object's motion into what reaches one listening place, by changing each
   mode's complex gain. See listener.c. */
#ifndef RESPONSE_LISTENER_H
#define RESPONSE_LISTENER_H
#include "base/arena.h"
#include "base/err.h"
#include "response/modes.h"
#include "response/object.h"
#include "scene/scene.h"

struct listener;

struct listener_ask {
    const struct output *output; /* quantity, listen */
    int channel;
    const double *origin; /* m: where the modes' object lies in the scene */
    double rate;          /* Hz */
    const double *listen; /* the place with which object_modes made the modes (listener_place); NULL: heard where they
                             are touched */
};

/* How many channels: one for each listening place. */
static inline int listener_channels(const struct output *o)
{
    return o->listen.given && o->listen.radiator != RADIATOR_CONTACT && o->listen.n_places > 1 ? o->listen.n_places : 1;
}

/* Is it heard in pascals? */
static inline bool listener_in_pascals(const struct output *o)
{
    return o->listen.given && (o->listen.radiator == RADIATOR_MONOPOLE || o->listen.radiator == RADIATOR_PLATE);
}

/* The `listen` place (the object's coordinates) with which the channel's modes are to be made by object_modes before
   listener_make gets them, and which listener_make then gets (ask->listen); false: with NULL. For the
   radiators point and plate, which are of objects only, true. */
bool listener_place(const struct listener_ask *ask, const struct object *o, struct arena *a, double place[2]);

/* NULL and an error: what is asked cannot be had of these modes (a plate radiator of a table, a monopole of no stated
   radius, ...). The modes must stay as they are while the listener is used. */
struct listener *listener_make(struct arena *a, const struct listener_ask *ask, const struct modes *m, struct err *e);

/* CPU cycles that listener_make takes for all channels, about, but for those too few to count: a plate's. origin: as in
 * the ask. */
double listener_cost(const struct output *o, const struct modes *m, const double *origin);

/* How many components it adds behind the modes' own (0 or 1: a radiator's own pole). */
int listener_extra(const struct listener *l);
/* What it gives: enum modes_quantity. */
int listener_quantity(const struct listener *l);
/* Samples by which the channel is later than the one whose listening place is nearest to this object. */
long listener_delay(const struct listener *l);

/* Replaces the gains of p (as modes_at gave them), n + extra components long. frequency, decay: those at the place, of
   the modes. The extra component's pole is written to p->frequency, p->decay too if they are not NULL. */
void listener_apply(const struct listener *l, const double *frequency, const double *decay,
                    const struct modes_point *p);

/* Poles of the extra components, constant. */
void listener_poles(const struct listener *l, double *frequency, double *decay);

#endif
