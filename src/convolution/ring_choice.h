/* Which engine makes a body ring, chosen before the plan is made: it depends on what the response holds (shared or separate poles), on the motion,
   and on the accuracy asked for. */
#ifndef CONVOLUTION_RING_CHOICE_H
#define CONVOLUTION_RING_CHOICE_H
#include "convolution/ring_nodes.h"
#include "response/modes.h"
#include "scene/scene.h"

enum ring_body { RING_SURFACE, RING_SCRAPER };
enum ring_engine { RING_NONE, RING_RESONATORS, RING_LAUNCH, RING_OVERLAP, RING_READOUT, RING_PANNED };

struct ring_choice {
    enum ring_engine engine;
    int reading;                 /* enum moving, never auto                                  */
    bool recorded;               /* a WAV or a folder of them: no modes                      */
    struct modes modes;          /* as read, the strongest of the band, below 0.45 of the rate */
    int chosen, high;            /* components of the strongest; how many of them lie above that */
    const char *note;            /* a warning from reading; NULL: none                       */
    bool moves;                  /* the response changes on the way                          */
    int gamma;                   /* of the modes' onset (gammatone.h); 1: at once            */
    int order, hop;              /* of overlap-add and readout; hop in frames                */
    double *hops;                /* [modes.n] frames, of launch and of readout by resonators; else NULL */
    int ramp;                    /* frames, of resonators                                    */
    struct ring_nodes nodes;     /* of panned modes                                          */
    double bytes;                /* memory that their spectra take, at all listening places  */
    double seconds;              /* of an impulse response that is computed                  */
    double forgotten;            /* dB by which what rings has decayed when it is dropped      */
    double error;                /* predicted, relative rms; 0: none                         */
    double work;                 /* predicted cycles per audio sample                        */
    unsigned knobs;              /* set of those of scene/accuracy.def that all this was chosen by */
    double cpu;                  /* s of CPU time that choosing took, the response being read*/
};

/* The contact retunes what rings; poles that are the same everywhere stay where they are. */
static inline bool ring_choice_glides(const struct ring_choice *c)
{
    return c->reading == MOVING_GLIDE && !c->modes.shared;
}

/* NULL: the body does not ring. Errors: as modes_table, object_make, space_modes; ERR_SCENE where what is asked cannot be had. */
bool ring_choice_make(const struct contact *c, const struct scene *s, enum ring_body body, struct arena *a, const struct ring_choice **choice,
                 struct err *e);

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
