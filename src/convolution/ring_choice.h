/* How a body rings: which modes, by which reading of a response that moves, and by which engine. It follows from the
   scene and from what the response holds (shared or separate poles), and is known before the plan is made. */
#ifndef CONVOLUTION_RING_CHOICE_H
#define CONVOLUTION_RING_CHOICE_H
#include "response/modes.h"
#include "scene/scene.h"

/* Nodes of launch that ring out are dropped at this part of what they were: -180 dB. */
#define RING_CHOICE_NODE_FLOOR 1e-9

enum ring_body { RING_SURFACE, RING_SCRAPER };
enum ring_engine { RING_NONE, RING_RESONATORS, RING_LAUNCH, RING_OVERLAP_ADD };

struct ring_made {             /* what was made when a run was opened, the same for the next one */
    const struct modes *modes; /* NULL: nothing yet */
    struct listener *listener;
};

struct listener;

struct ring_choice {
    struct arena *arena;
    struct ring_made *made; /* [channels] */
    enum ring_engine engine;
    int reading;   /* enum moving, never auto                                  */
    bool recorded; /* a WAV or a folder of them: no modes                      */
    bool folder;
    struct modes modes; /* as read, the strongest of the band, below 0.45 of the rate */
    int chosen, high;   /* components of the strongest; how many of them lie above that */
    const char *note;   /* a warning from reading; NULL: none                       */
    bool moves;         /* the response changes on the way                          */
    int gamma;          /* of the modes' onset (gammatone.h); 1: at once            */
    double seconds;     /* of an impulse response that is computed                  */
};

/* The contact retunes what rings; poles that are the same everywhere stay where they are. */
static inline bool ring_choice_glides(const struct ring_choice *c)
{
    return c->reading == MOVING_GLIDE && !c->modes.shared;
}

/* NULL: the body does not ring. Errors: as modes_table, object_make, space_modes; ERR_SCENE where what is asked cannot
   be had. */
bool ring_choice_make(const struct contact *c, const struct scene *s, enum ring_body body, struct arena *a,
                      const struct ring_choice **choice, struct err *e);

/* Frames from one node of a response that moves to the next, by launch or overlap-add: see ring_choice.c. */
int ring_choice_hop(const struct ring_choice *c, const struct accuracy *accuracy);

/* "surface.response", "ball.object": the key that says what rings, for err_about. */
const char *ring_choice_about(const struct contact *c, enum ring_body body);

/* The engine of a contact that has been through ring_choice_make (scene.h: response.choice). */
enum ring_engine ring_choice_engine(const struct contact *c, enum ring_body body);

/* A ringing stage's .work and .turns (stage.h). */
double ring_choice_surface_work(const struct contact *c, const struct scene *s);
double ring_choice_scraper_work(const struct contact *c, const struct scene *s);
unsigned ring_choice_surface_turns(const struct contact *c, const struct scene *s);
unsigned ring_choice_scraper_turns(const struct contact *c, const struct scene *s);

#endif
