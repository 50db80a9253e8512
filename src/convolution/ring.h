/* What the stages that make a body ring share: which body, what rings (response/modes.h), what is heard of it at each
   listening place (response/listener.h), and the gains and poles where the contact is. */
#ifndef CONVOLUTION_RING_H
#define CONVOLUTION_RING_H
#include "convolution/ring_choice.h"
#include "response/listener.h"
#include "response/modes.h"
#include "stage.h"
#include "trajectory/trajectory.h"

struct ring_output { /* one listening place */
    const struct modes *modes;
    struct listener *listener;
    int n;                     /* components: the modes' and the listener's own */
    long delay;                /* frames by which it is heard later */
    double *frequency, *decay; /* [n] poles; those at the last place asked for, when they move */
    struct modes_point end;    /* work space */
    struct ring_alias *alias;  /* what sampling folds in (ring.c) */
};

struct ring {
    enum ring_body body;
    const struct ring_choice *choice;
    const struct board *board;
    const struct contact *contact;
    const char *key; /* "surface" or "scraper", for messages */
    enum item out;
    double weight; /* eta for the scraper, 1 for the surface */
    int ramp;      /* frames from one evaluation of gains, poles and taps to the next (accuracy.gain_ramp) */
    bool moves;    /* gains or poles change on the way */
    bool stays;    /* after the motion's end there is still force, or what rings is retuned or read: at the end */
    int channels;
    struct ring_output *outputs; /* [channels] */
    long delay;                  /* frames, the largest of the voices' */
    long first;                  /* frame at which the run began (ring_skip)  */
    double *y;                   /* [STAGE_BLOCK] one voice's sound */
};

/* Makes the voices, checks the places against the motion, notes quantity, ring time and warnings on the board, and sets
   r->back and r->ahead, which may be raised. */
bool ring_open(struct ring *g, struct stage_run *r, enum ring_body body, struct err *e);

/* Gains (weight included) of the contact at frame `frame`, and poles into p->frequency and p->decay, unless they are
   NULL. p is [voice->n]. Before the motion's start and after its end, where there is no force, they go on so that
   interpolation between instants keeps its order up to there: straight in the logarithm, or back where the motion
   rests. What is retuned or read out there, or still has force (`stays`), is that of the end. */
void ring_point_at(const struct ring *g, const struct ring_output *v, double frame, const struct modes_point *p);

/* The same at a place. */
void ring_point_in(const struct ring *g, const struct ring_output *v, const struct modes_where *where,
                   const struct modes_point *p);

/* Writes the voice's sound from the ring's y, less what sampling has folded in, into the item's channel, for frames
   [from, to). */
void ring_put(const struct ring *g, int channel, long from, long to);

/* The motion's place, and the share of its duration that has passed. */
struct modes_where ring_where(const struct trajectory *tr, double t);

/* The place whose response it is all the time, of one that does not change: where the motion starts, or what
   ablation.place says. */
struct modes_where ring_first_place(const struct contact *c, const struct trajectory *tr);

/* Does the motion stay on a surface whose modes are m? ERR_SCENE, with its key and place: it leaves the hull of the
   places, and surface.extrapolate is error. */
bool ring_reach(const struct modes *m, const struct stage_run *r, struct err *e);

/* .skip (stage.h) of a stage whose state begins with its ring and that has not run yet: silence before the frame. */
void ring_skip(struct stage_run *r, long frame);

/* Force under the voice at a frame: its own delay back. */
const double *ring_force(const struct ring *g, const struct ring_output *v, long from);

#endif
