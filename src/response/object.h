/* Objects of simple shape whose modes are closed forms (or converged Rayleigh-Ritz sums, of plates with other than
   supported edges): frequencies, damping, modal masses, and mode shapes at any place. Sources stand in object_*.c. */
#ifndef RESPONSE_OBJECT_H
#define RESPONSE_OBJECT_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"
#include "response/modes.h"
#include "scene/scene.h"

struct object {
    const char *key;           /* "surface.object", for messages                                         */
    int n;                     /* modes, by rising frequency                                             */
    int shape;                 /* enum object_shape                                                      */
    double *frequency, *decay; /* [n] Hz (damped), 1/s                                                   */
    double *mass;              /* [n] kg, modal mass for the shapes as they are scaled                   */
    double low[2], high[2];    /* m: box of the object's own coordinates that may be touched             */
    double radius;             /* m, of the sphere of equal surface area (both sides of what is flat)    */
    bool flat;                 /* has an area of shapes in the plane: plate, disk, membrane, drum        */
    /* Mode shapes [n] at a place (m, the object's coordinates); returns how far (m) off the object it lies: there the
     * nearest place counts. */
    double (*shapes)(const struct object *, double x, double y, double *phi);
    /* The same for `count` places on it with the same y, phi [count][n], for less; NULL: there is no such way. */
    void (*row)(const struct object *, int count, const double *x, double y, double *phi);
    double terms; /* products that `row`, or else `shapes`, sums up at a place               */
    const void *self;
};

/* Own coordinates: bar, plate, membrane lie at x in [0, length], y in [0, width]; rod and string at x in [0, length]
   with y = 0 on the axis; disk and drum round (0, 0); a shell's place is (x, y) = arc length from a pole times (cos,
   sin) of the azimuth. Longitudinal waves: `supported` means `clamped`, the force is along x. Rigid motions of what is
   free are left out.

   The n = `most` modes of lowest undamped frequency from `low` to below `top` Hz that ring. given->... NAN are the
   material's (scene/material.h); an isotropic material's moduli follow youngs_modulus and poisson. Errors: ERR_SCENE,
   with the key's name after `key` ("surface.object"): a needed size missing, custom material without its constants,
   sizes that do not fit, no mode below `top`. *note (text in the arena, else NULL; lines): modes more than 5 % too high
   as the object is not thin enough for thin-plate or slender-bar theory, overdamped modes left out, fewer modes than
   asked for (plates with other than supported edges: at most 400, fewer of very narrow ones).

   Plates with other than supported edges take time: 50 modes about 3 ms, 200 35 ms, 400 0.2 s; cantilevers and
   narrow strips (1:25) up to four times that, 0.5 s at most. All else is done in milliseconds. */
struct object_ask {
    const char *key;
    double top;
    int most;
    double low;
    double audible; /* Hz: `note` says of modes below this how far theory is off; 0: of all */
};
bool object_make(const struct object_given *given, const struct object_ask *ask, struct arena *a, struct object *o,
                 const char **note, struct err *e);

/* As modes of velocity (m/s per N s) with shared poles. listen: place (the object's coordinates) that is heard; NULL:
   the place that is touched, so that gains are phi^2/m (of a shell 1/m, wherever it is touched). The `strongest` by
   energy over the object; m->object holds just these, in the same order: m->object->shapes gives phi of component i in
   phi[i]. */
void object_modes(const struct object *o, const double origin[2], const double *listen, int strongest, struct arena *a,
                  struct modes *m); /* a outlives m */

/* Of such modes: where the object's x = y = 0 lies in the scene, m. */
const double *object_modes_origin(const struct modes *m);

#endif
