/* The curve under a rolling ball: s(t) = z + bulge + rise at the motion's place.

   z is the surface as the ball meets it (surface/tip.c: the rolling curve of papers/002, fig. 1), rise = -r cos(theta)
   that of the centre of mass over the geometric centre, bulge that of the rim (trajectory/spin.h): the ball's lowest
   point is at w - R - rise - bulge, w the height of the centre of mass, so that with w counted from R it dips into the
   surface by xi = s - w. */
#ifndef CONVOLUTION_ROLL_CURVE_H
#define CONVOLUTION_ROLL_CURVE_H
#include "stage.h"
#include "trajectory/spin.h"

struct roll_curve {
    const struct board *board;
    struct spin spin;
    bool turns;                            /* the ball is not quite round, or its centre of mass is off */
    double *t, *s;                         /* [room] s: instants since the contact's start, m            */
    double *u, *du, *x, *y, *rise, *bulge; /* [room] work                                   */
};

enum { ROLL_CURVE_LEAST = 1024 };

/* r: of a stage whose relief and motion are on the board; for up to `room` >= ROLL_CURVE_LEAST instants at a time. */
void roll_curve_make(struct roll_curve *c, const struct stage_run *r, long room);

/* s at the n instants in c->t. */
void roll_curve_read(const struct roll_curve *c, size_t n);

/* The greatest |ds/dt| met, m/s: differences over sub-intervals, in 16 stretches of 1024 instants spread evenly over
   the motion, or one of a short one. */
double roll_curve_fastest(const struct roll_curve *c);

#endif
