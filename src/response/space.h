/* The space of materials and shapes of papers/004 ("Intuitive Sound-Synthesis Control"): an object between wood, metal
   and glass, and between string, plate and shell. Everything 004 does not print is stated in space.c. */
#ifndef RESPONSE_SPACE_H
#define RESPONSE_SPACE_H
#include "base/arena.h"
#include "base/err.h"
#include "response/modes.h"
#include "scene/scene.h"

/* Modes of velocity (m/s per N s); separate poles that depend on modes_where.share when from and to (or the dimensions)
   differ. `rate` as modes_ask. ERR_SCENE: a place outside the unit disk. */
bool space_modes(const struct space *s, const struct modes_ask *ask, struct arena *a, struct modes *m, struct err *e);

/* The anchors of the space of materials and shapes, and how a place's share of each follows: response/space.h. */
enum { SPACE_WOOD, SPACE_METAL, SPACE_GLASS, SPACE_ANCHORS };

enum { SPACE_BAR, SPACE_PLATE, SPACE_SHELL, SPACE_SHAPES }; /* dimension - 1 */

/* Shares w of the anchors at (x, y) of the unit disk; they add up to 1 and none is negative. */
void space_anchors_shares(double x, double y, double w[SPACE_ANCHORS]);

#endif
