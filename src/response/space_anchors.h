/* The anchors of the space of materials and shapes, and how a place's share of each follows: response/space.h. */
#ifndef RESPONSE_SPACE_ANCHORS_H
#define RESPONSE_SPACE_ANCHORS_H
#include "base/arena.h"

enum { SPACE_WOOD, SPACE_METAL, SPACE_GLASS, SPACE_ANCHORS };
enum { SPACE_BAR, SPACE_PLATE, SPACE_SHELL, SPACE_SHAPES }; /* dimension - 1 */

/* Shares w of the anchors at (x, y) of the unit disk; they add up to 1 and none is negative. */
void space_anchors_shares(double x, double y, double w[SPACE_ANCHORS]);

/* ln(f_i/f_0), i = 0 .. n-1, rising: an anchor's spectrum in that shape. */
void space_anchors_spectrum(int shape, int anchor, int n, double *log_ratio, struct arena *a);

/* Gain of mode i over that of mode 0. */
double space_anchors_gain(int shape, int i);

/* decay in 1/s at angular frequency w (rad/s) */
double space_anchors_decay(int anchor, double w);

#endif
