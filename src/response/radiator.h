/* The simplest radiator: a sphere of the object's size whose whole surface moves as the place that is heard does. See
 * radiator.c. */
#ifndef RESPONSE_RADIATOR_H
#define RESPONSE_RADIATOR_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"
#include "response/modes.h"
#include "response/object.h"

struct radiator_monopole {
    double gain; /* Pa per m/s, K = rho c a / r */
    double pole; /* 1/s, w = c / a              */
};

struct radiator_monopole radiator_monopole(double radius, double distance, double density, double sound_speed);

/* H(s), complex. */
void radiator_monopole_at(const struct radiator_monopole *m, const double s[2], double h[2]);

/* The share w / (s + w) K of a mode's complex velocity gain at pole s that goes to the radiator's own pole. */
void radiator_monopole_own(const struct radiator_monopole *m, const double s[2], double share[2]);

/* Is the own pole slow enough to be sampled? */
bool radiator_monopole_sampled(const struct radiator_monopole *m, double rate);

/* A flat object in an infinite baffle: Rayleigh's integral over its mode shapes. See radiator.c. */
struct radiator_plate {
    const struct modes
        *modes; /* of velocity, linear in the shape where they are touched: made with `listen` = reference */
    const struct object *object; /* the modes': its outline (shape, low, high) and their shapes */
    double reference[2]; /* m, the object's coordinates                                                             */
    double origin[2];    /* m: where the object's x = y = 0 lies in the scene                                       */
    double place[3];     /* m, in the scene: where it is heard, z > 0                                               */
    double density, sound_speed; /* kg/m^3, m/s, of the air */
};

/* A place of the object (its own coordinates) at which no mode's shape is near zero. */
void radiator_plate_reference(const struct object *o, struct arena *a, double place[2]);

/* Distance (m) from the object's centre. */
double radiator_plate_distance(const struct object *o, const double origin[2], const double place[3]);

/* Complex factor [modes->n] from a gain to that of the pressure, after the delay from the object's centre. ERR_SCENE:
   not in front of the plate; ERR_NUMBERS: a mode vanishes at the reference, or the integral does not settle. */
bool radiator_plate(const struct radiator_plate *p, struct arena *a, double *re, double *im, struct err *e);

/* CPU cycles that this takes, about, with what comes before it (radiator_plate_reference); of the modes only n and
 * frequency count; reference does not. */
double radiator_plate_cost(const struct radiator_plate *p, struct arena *a);

#endif
