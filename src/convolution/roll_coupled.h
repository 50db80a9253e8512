/* What gives way under a rolling ball: the surface's modes, and their shapes at the contact's place as it moves. */
#ifndef CONVOLUTION_ROLL_COUPLED_H
#define CONVOLUTION_ROLL_COUPLED_H
#include "response/modes.h"
#include "stage.h"

enum ground { GROUND_AUTO, GROUND_ELASTIC, GROUND_RIGID };

struct roll_coupled { /* contact.roll, as far as model roll_coupled alone has it */
    int integrator;   /* enum integrator                                         */
    int ground;       /* enum ground                                             */
    double drop;      /* m, of the ball above its rest at the start              */
};

const struct roll_coupled *roll_coupled_of(const struct contact *c);

struct roll_ground {
    struct modes_shapes shapes; /* n 0: rigid                                        */
    bool moves;                 /* phi changes on the way                            */
    struct modes_where first;   /* the place that counts where it does not           */
    double *phi, *from, *to;    /* [n] at a frame; at the ends of the present ramp   */
    long ramp, ramp_end;        /* frames                                            */
    const struct board *board;
};

/* By contact.roll.ground; at rest at the motion's start. ERR_SCENE: no modes though `elastic`, gains that are not the
   driving point's, a motion that leaves the places that are known. */
bool roll_coupled_ground_make(struct roll_ground *g, const struct stage_run *r, struct err *e);

/* phi[n] at the motion's start; NULL: rigid. */
const double *roll_coupled_ground_start(const struct roll_ground *g);

/* phi[n] at the end of a leg, which begins at `frame`, legs in order: read every accuracy.gain_ramp frames, at
   multiples of it, straight between. *frames, at least 1: the leg's length, which is shortened to where phi bends next.
   NULL: as it was. */
const double *roll_coupled_ground_next(struct roll_ground *g, long frame, long *frames);

/* How many modes, for predictions of cost. */
double roll_coupled_ground_modes(const struct contact *c);

#endif
