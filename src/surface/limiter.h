/* The limiter of curvature (papers/000 equations 4 to 7): alpha(N), how much curvature the contact can follow; means
   and first moments of the limited curvature, in closed form, over cells in which a curvature runs along a parabola. */
#ifndef SURFACE_LIMITER_H
#define SURFACE_LIMITER_H
#include <stdbool.h>
#include <stddef.h>

#include "scene/scene.h"

enum limiter_curve { LIMITER_TANH, LIMITER_NONE };

struct limiter {                 /* contact.limiter, but where an ablation leaves it out */
    int curve;                   /* enum limiter_curve                                   */
    double alpha;                /* m, for a constant load                               */
    double alpha_min, alpha_max; /* m                                                    */
    double zeta;
    double ratio_y;        /* alpha_y / alpha_x, paper force                  */
    double force_range[2]; /* N, N_min and N_max of eq. 7; NAN: the scene's own */
};

const struct limiter *limiter_of(const struct contact *c);

struct limiter_law {
    double alpha_min, alpha_max, zeta; /* m, m, -                                      */
    double least, most;                /* N_min, N_max                                 */
    double fixed;                      /* m: alpha when the normal force does not vary */
    bool varies;
};

/* least, most: the range of N over the scene, used unless the scene gives its own. */
struct limiter_law limiter_make(const struct limiter *given, double least, double most);

/* alpha[n] (m) for normal forces[n] (N); forces outside the range count as its ends (negative ones as 0). */
void limiter_alpha(const struct limiter_law *l, size_t n, const double *force, double *alpha);

/* alpha of a contact whose load is constant; of one whose load varies (load_varies) it says nothing. */
double limiter_constant(const struct contact *c);

/* Two chunks of force/path_cells.h and a little: with arrays of 256, a power of two apart, a render in standard took 2
 * to 4 % more.
 */
enum { LIMITER_CELLS = 264, LIMITER_POINTS = 2 * LIMITER_CELLS };

struct limiter_cells { /* cells from point at[i] to point at[i] + 1 */
    int n, points;
    const int *at;           /* [n], rising */
    const double *alpha;     /* m, [points] */
    const double *curvature; /* c, 1/m, [points] */
    const double *sagitta;   /* 1/m, [n]: c in the middle above the straight line between the ends; NULL: none */
    double *limited;         /* T(c) at the points, 1/m, [points] */
    double *mean;            /* mean of T over the cell, 1/m, [n] */
    double *moment;          /* integral of (s - middle) T ds / length^2, 1/m, [n] */
};

/* T(c) = tanh(alpha c) / alpha, or T(c) = c when limiter is false. Absolute error of alpha mean below 2e-12, of alpha
   moment below 1e-9; with a sagitta b that of alpha mean grows by 0.21 (alpha b)^2 up to 5.2e-5 at alpha |b| = 1/64,
   from where on it grows no more, that of alpha moment by 0.05 alpha |b| up to 8e-4. |mean| <= 1/alpha, but for 2e-8 of
   it and 4 alpha |b| roundings. */
void limiter_cells(const struct limiter_cells *l, bool limiter);

struct stage_run;
/* Warns where a normal force from `least` to `most` N leaves limiter.force_range. */
void limiter_warn(struct stage_run *r, double least, double most);

#endif
