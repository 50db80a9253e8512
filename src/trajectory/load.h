/* The normal force N(t): constant, recorded, from the hand that moves the tool, or from the turning of a ball; and how
 * far the scraper is lowered. */
#ifndef TRAJECTORY_LOAD_H
#define TRAJECTORY_LOAD_H
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/err.h"
#include "scene/scene.h"
#include "trajectory/spin.h"
#include "trajectory/trajectory.h"

enum load_phase { LOAD_LOWEST, LOAD_FALLING };

struct load_record;

struct load_law {
    double still;                     /* N without acceleration (grip, ball), or the constant   */
    double per_acceleration[2];       /* N per m/s^2 along x and y                              */
    const struct load_record *record; /* recorded N(t); NULL: none                        */
    double turned;                    /* kg, of a ball whose turning makes N vary; 0: none          */
    struct spin spin;                 /* of that ball                                               */
    bool falling;                     /* load.phase: falling                                        */
    double approach, release;         /* s; resolved, 0: none                                   */
    double duration;                  /* s, of the motion                                       */
    double least, most;               /* N over the motion, without approach and release; negative ones counted as 0 */
};

/* The normal force in N where nothing makes it vary (load_varies): what load.constant says, else the weight; of a grip
   whose variation is left out what it has without acceleration (papers/000 equations 8 and 9 with omega = 0). */
double load_constant(const struct contact *c);

#define LOAD_APPROACH 5e-3 /* s: contact is made and given up where the motion is at speed, unless the scene says */

/* Seconds of approach (or release), as far as the scene alone shows them: at least what they will be. What strikes and
   what is given is neither lowered nor raised. A scraper at rest makes no force; all others press at rest too, but a
   ball that is dropped comes down by itself. */
double load_approach(const struct contact *c, bool release);

/* ERR_SCENE when the grip jams (mu tan theta >= 0.999), or the motion is shorter than approach and release; ERR_INPUT,
   ERR_SCENE for a recorded force. least and most are exact to rounding (series_range); those of a load that does
   not vary are `still`. */
bool load_make(const struct contact *c, const struct trajectory *tr, struct arena *a, struct load_law *l,
               struct err *e);

/* Does the load of this contact vary over time by grip or record, or as a ball turns whose centre of mass is off its
   centre or whose rim has lobes (model roll; roll_coupled has its own dynamics)? (Approach and release alone do not
   count; with ablation.normal_force: constant nothing does.) */
bool load_varies(const struct contact *c);

/* Normal force in N at n instants, from accelerations ax, ay (m/s^2; read only by a grip, t only by a recorded force:
   else may be NULL); negative: lifted off. Approach and release are NOT in it. */
void load_at(const struct load_law *l, size_t n, const double *t, const double *ax, const double *ay, double *force);

/* The normal force in N of a ball that turns (l->turned > 0) at n instants, from u, du, ddu of its motion (m, m/s,
 * m/s^2); negative: lifted off. */
void load_turned(const struct load_law *l, size_t n, const double *u, const double *du, const double *ddu,
                 double *force);

/* The normal force from the motion itself, at n instants, and at one. */
void load_along(const struct load_law *l, const struct trajectory *tr, size_t n, const double *t, double *force);
double load_of(const struct load_law *l, const struct trajectory *tr, double t);

/* The share, 0 to 1, to which the scraper is lowered at time t: a minimum-jerk step (C2) over approach and release,
 * else 1. */
double load_lowered(const struct load_law *l, double t);

#endif
