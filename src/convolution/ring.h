/* What the stages that make a body ring share: which body, its response file, and the gains where the contact is. */
#ifndef CONVOLUTION_RING_H
#define CONVOLUTION_RING_H
#include "response/modes.h"
#include "stage.h"

enum ring_body { RING_SURFACE, RING_SCRAPER };

struct ring {
    enum ring_body body;
    const struct response *given;
    const char *key;         /* "surface" or "scraper", for messages */
    enum item out;
    double weight;           /* eta for the scraper, 1 for the surface */
    bool moves;              /* the gains follow the contact */
    struct modes modes;
};

/* Does that body ring in this scene, and by which engine (enum engine, never auto)? */
bool ring_wanted(const struct contact *c, enum ring_body body, int engine);

/* True for a mode table (.csv), false for an impulse response. */
bool ring_is_table(const struct response *given);

struct ring ring_make(const struct stage_run *r, enum ring_body body);

/* Reads the mode table: strongest modes below Nyquist, quantity noted on the board, places checked against the motion. */
bool ring_read_modes(struct ring *g, struct stage_run *r, struct err *e);

/* Complex gains [modes.n], weight included, of the contact at time t (s after the contact's start); before its start and after its end of
   where its motion would go on, so that interpolation keeps its order there. */
void ring_gains_at(const struct ring *g, const struct board *b, double t, double *re, double *im);

#endif
