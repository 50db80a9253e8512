/* Hertz's contact of what strikes or rolls with the surface: f = k x^1.5. */
#ifndef FORCE_HERTZ_H
#define FORCE_HERTZ_H
#include <stdbool.h>

#include "base/err.h"
#include "scene/scene.h"

/* k in N/m^1.5 from radius and materials (hertz.c). ERR_SCENE: the scene does not tell them; names the keys that would,
 * and the model's own key of stiffness. */
bool hertz_stiffness(const struct contact *c, double *stiffness, struct err *e);

#endif
