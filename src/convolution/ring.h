/* What the stages that make a body ring share: which body, what rings (response/modes.h), what is heard of it at each listening place
   (response/listener.h), and the gains and poles where the contact is. */
#ifndef CONVOLUTION_RING_H
#define CONVOLUTION_RING_H
#include "convolution/ring_choice.h"
#include "response/listener.h"
#include "response/modes.h"
#include "stage.h"

struct ring_voice {             /* one listening place */
    const struct modes *modes;
    struct listener *listener;
    int n;                      /* components: the modes' and the listener's own */
    long delay;                 /* frames by which it is heard later */
    double *frequency, *decay;  /* [n] poles; those at the last place asked for, when they move */
    struct modes_point end;     /* work space */
    struct ring_alias *alias;   /* what sampling folds in (ring_alias.h) */
};

struct ring {
    enum ring_body body;
    const struct ring_choice *choice;
    const struct board *board;
    const struct contact *contact;
    const char *key;            /* "surface" or "scraper", for messages */
    enum item out;
    double weight;              /* eta for the scraper, 1 for the surface */
    double morph_error;         /* dB, accuracy's */
    bool moves;                 /* gains or poles change on the way */
    bool stays;                 /* after the motion's end what rings is still retuned or read at a place: the end */
    int channels;
    struct ring_voice *voices;  /* [channels] */
    long delay;                 /* frames, the largest of the voices' */
    double *y;                  /* [STAGE_BLOCK] one voice's sound */
};

/* Makes the voices, checks the places against the motion, notes quantity, ring time and warnings on the board, and sets r->back and r->ahead, which may be raised. */
bool ring_open(struct ring *g, struct stage_run *r, enum ring_body body, struct err *e);

/* Gains (weight included) of the contact at frame `frame`, and poles into p->frequency and p->decay, unless they are NULL. p is [voice->n].
   Before the motion's start and after its end, where there is no force, they go on as ring_along.h says. */
void ring_point_at(const struct ring *g, const struct ring_voice *v, double frame, const struct modes_point *p);

/* The same at a place. */
void ring_point_in(const struct ring *g, const struct ring_voice *v, const struct modes_where *where, const struct modes_point *p);

/* [v->n] hops of a voice's components (choice->hops); those of modes that are not the chosen ones, or that a listener adds, are the shortest of all. */
double *ring_component_hops(const struct ring *g, const struct ring_voice *v, struct arena *a);

/* Writes the voice's sound from the ring's y, less what sampling has folded in, into the item's channel, for frames [from, to). */
void ring_put(const struct ring *g, int channel, long from, long to);

/* Force under the voice at a frame: its own delay back. */
const double *ring_force(const struct ring *g, const struct ring_voice *v, long from);

#endif
