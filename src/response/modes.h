/* Modes: how an object rings, wherever it is touched. A mode is gain e^(-decay t) sin(2 pi f t + phase), t >= 0
   (papers/000 equation 10 with A_i(t) an exponential; a mode of several slopes is several components of one frequency).
   Complex gain: A = gain e^(j phase), so that h(t) = Im sum A_i e^(s_i t), s_i = -decay + j 2 pi f.

   A `struct modes` comes from a mode table (modes.c), a closed-form object (object.c), or a place in the
   space of materials (space.c); all are read through `at`. */
#ifndef RESPONSE_MODES_H
#define RESPONSE_MODES_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"
#include "base/file_cache.h"

/* The first three in the order of enum quantity of scene.h, which has `auto` before; MODES_PRESSURE comes from a
   listener only, and MODES_FORCE is no motion at all, but the contact force as the sound (convolution/mix.c):
   no table holds them. */
enum modes_quantity {
    MODES_DISPLACEMENT,
    MODES_VELOCITY,
    MODES_ACCELERATION,
    MODES_PRESSURE,
    MODES_FORCE,
    MODES_QUANTITIES
};

/* "velocity" and "m/s" of such a quantity, for messages. */
const char *modes_quantity_name(int quantity);

const char *modes_quantity_unit(int quantity);

struct modes_where {
    double x, y;  /* m, the contact, in the scene's coordinates */
    double share; /* of the motion's duration that has passed, 0 to 1 (the space of materials moves with it) */
};

struct modes_point {           /* what rings when it is touched there; arrays [n] of the caller (modes_point_make) */
    double *frequency, *decay; /* Hz, 1/s */
    double *re, *im;           /* complex gain, quantity per N s */
};

struct object;

struct places;

struct modes {
    int n;                       /* components, strongest mode first                                        */
    int quantity;                /* enum modes_quantity                                                     */
    bool shared;                 /* poles are the same everywhere: those of frequency, decay                */
    bool moves;                  /* gains or poles depend on the contact's place                            */
    bool travels;                /* ... or on the time: also where the contact stays                        */
    double *frequency, *decay;   /* [n] shared poles; of separate ones the place's where the mode is strongest */
    double *slowest;             /* [n] 1/s, least decay anywhere                                           */
    double radius;               /* m, of a sphere of the object's size (monopole); NAN: not stated         */
    const struct object *object; /* NULL: not one of closed form                                            */
    const char *name;            /* file or "surface.object", for messages                                  */
    const char *note;            /* what to warn of; NULL: nothing                                          */
    const struct places *places; /* that a table knows; NULL: no table                                      */
    double home[2];              /* m: the place that counts where nothing says which (of a line its first)  */
    int (*drop)(struct modes *,
                double top); /* as modes_drop_above does, modes from `top` Hz on; NULL: there are none */
    double (*at)(const struct modes *, const struct modes_where *, const struct modes_point *);
    const void *self;
};

/* Fills the point; poles too when they are not shared (when they are, frequency and decay of the point may be NULL and
   are left alone). Returns how far (m) the place lies off the hull of those that are known; beyond 1e-9 m the nearest
   place of the hull counts. */
double modes_at(const struct modes *m, const struct modes_where *where, const struct modes_point *p);

/* Gains of velocity to those of displacement (A/s) or acceleration (A s, for t > 0). */
void modes_to_quantity(int quantity, int n, const struct modes_point *p);

struct modes_point modes_point_make(struct arena *a, int n);

/* From a mode table (mode_table.h says what it holds): the `strongest` modes of the band, by energy summed over places,
   sum gain^2 / (4 decay) of a mode of one slope; of equal ones the one of lower frequency. The order of rows tells
   nothing. A mode of several slopes counts as one and becomes several components. One place holds everywhere; on a line
   and in the plane see places.h; between places see morph.c. pairing: see scene.h. rate in Hz: modes whose frequency
   reaches rate/2 fade out between 0.45 and 0.5 times it when poles are separate. Errors name file and line; none in the
   band is ERR_SCENE. */
struct modes_ask {
    int strongest;
    double band[2]; /* Hz, low <= f < high, from which they are chosen (modes_in_band); 0, 0: from all */
    double pairing, rate;
    struct file_cache *file_cache; /* of the scene (base/file_cache.h); NULL: none */
};

bool modes_table(const char *path, const struct modes_ask *ask, struct arena *a, struct modes *m, struct err *e);

/* The direct term D of an acceleration (or pressure) at those gains (its delta at t = 0: what the force itself adds):
   sum Im(A_i/s_i); 0 for the other quantities. frequency, decay: the point's, or the modes' own when poles are shared.
 */
double modes_direct(int quantity, int n, const double *frequency, const double *decay, const struct modes_point *p);

/* Is a mode whose frequency goes from `lowest` to `highest` (Hz) somewhere in the band? */
bool modes_in_band(const struct modes_ask *ask, double lowest, double highest);

/* Components that nowhere lie below MODES_TOP times the rate cannot be sampled: drops them (sets n), returns how many
 * there were. */
#define MODES_TOP 0.45

int modes_drop_above(struct modes *m, double rate);

/* What a mode of that frequency has left beside a sample rate that may be too low for it: 1 below 0.45 of the rate, 0
   from half of it on. rate 0: 1. */
double modes_fade(double frequency, double rate);

/* Time after which a unit impulse's response has decayed by `decibel` (> 0) below its initial amplitude bound; slowest
 * mode. */
double modes_ring_time(const struct modes *m, double decibel);

/* Signed mode shapes at the place that is touched, for what gives way under a contact: the object's displacement there
   is sum phi_i q_i,

     q_i'' + 2 sigma_i q_i' + |s_i|^2 q_i = phi_i f,   s_i = -sigma_i + j 2 pi f_i

   phi scaled to unit modal mass (1/sqrt(kg)). Of objects of closed form phi = shape / sqrt(modal mass), exact and
   signed; of a mode table with shared poles the gains must be those of the driving point (heard where it is touched):
   real positive phi_i^2. */
struct modes_shapes {
    int n;
    const double *frequency, *decay; /* [n] Hz (damped), 1/s */
    bool moves;                      /* phi depends on the place */
    const struct modes *modes;
    void *self;
};

/* From a body's modes; they must stay. key ("surface"): for messages. ERR_SCENE: separate poles, poles that travel, or
 * gains that are not those of the driving point. */
bool modes_shapes_make(const struct modes *m, const char *key, struct arena *a, struct modes_shapes *s, struct err *e);

/* phi[n] at a place (the scene's coordinates), 1/sqrt(kg). */
void modes_shapes_at(const struct modes_shapes *s, const struct modes_where *where, double *phi);

#endif
