/* Integrals along the contact's path over its surface, equations 1 to 5 of papers/000: the slope S' of the limited
   trajectory S and, where asked for, its height, from the cells of force/path_cells.h; and what of a force reaches each
   sub-interval. Code and equations share these symbols:

     symbol    unit    in the code              what                                                      equation
     u, e      m, -    cells.x y, ex ey         place on the path, unit tangent of increasing u
     n         -                                e turned by +90 degrees
     c, d      1/m     cells.curvature[0, 1]    e' H e, e' H n; H the surface's second derivatives        4, 5
     alpha     m       cells.alpha              limit of curvature (surface/limiter.h)                    6, 7
     T         1/m     cells.limited            tanh(alpha c) / alpha at points                           4, 5
                       cells.mean, moment       its mean and first moment over a cell
     S'        -       slopes, terms.start, end dS/ds, slope of S along the path; s arc length            1 to 3
     S_n       -       slopes                   slope of S across the path
     S         m       height                   height
     l         m       leak                     contact.leak
     h, z      m, -    cells.length, terms.z    length of a cell; h / l
     f_v, f_h  N       force/scrape.c           vertical, horizontal force                                1, 3
     F_j       N       bspline.early, late      means of a force weighted by linear B-splines */
#ifndef FORCE_PATH_INTEGRAL_H
#define FORCE_PATH_INTEGRAL_H
#include "force/path_cells.h"

struct path_terms {
    double z[LIMITER_CELLS], phi[LIMITER_CELLS], chi[LIMITER_CELLS]; /* 1 */
    double decay[LIMITER_CELLS];                                     /* 1 - z phi                                   */
    double bent[CELLS_CHANNELS][LIMITER_CELLS]; /* what the end gains: phi h mean(T) + z (1 - z/2) h moment(T) */
    double risen[LIMITER_CELLS]; /* what the mean gains, of channel 0: chi h mean(T) - (1 - z/2) h moment(T)
                                     + z h (mean(T) - (T_start + T_end)/2) / 60 */
    double start[LIMITER_CELLS], end[LIMITER_CELLS],
        mean[LIMITER_CELLS]; /* S' along the direction of travel; set where the slope is known */
    double whole[LIMITER_CELLS], late[LIMITER_CELLS]; /* integrals of |S'|, q |S'| dq over the cell */
};

/* All of p's cells and channels, up to `risen`. leak: l, m. */
void path_integral_terms(struct path_terms *t, const struct cells *p, int channels, double leak);

/* mean[] of n cells of channel 0 from start[]. */
void path_integral_mean(struct path_terms *t, int n);

/* whole[], late[] of n cells from start[], end[], mean[]: S' taken as a parabola. */
void path_integral_magnitude(struct path_terms *t, int n);

/* S' at the cell's end from that at its start. */
static inline double path_terms_end(const struct path_terms *t, int channel, int i, double start)
{
    return t->decay[i] * start + t->bent[channel][i];
}

struct magnitude {
    double whole, late; /* integrals over 0 <= q <= 1 of |S'|^power, and of q |S'|^power */
};

/* Of a slope at the cell's start, middle and end: Simpson's rule, or straight lines to a zero. */
struct magnitude path_integral_power(const double s[3], double power);

struct slope_cells { /* at the cells of path_terms; [n + 1]: before each cell, and after the last */
    double slope[2][LIMITER_CELLS + 1], height[LIMITER_CELLS + 1]; /* of S in the plane; m, S            */
    double gain[2][LIMITER_CELLS], rise[LIMITER_CELLS];            /* what the cell adds to them         */
    double e[2][LIMITER_CELLS];                                    /* direction of increasing u half way */
    double facing[LIMITER_CELLS];                                  /* dS/du at the cell's end            */
    double turned[LIMITER_CELLS];                                  /* m, what turning adds to the integral of S' ds */
};

struct path_integral {
    struct path_cells cells;
    struct path_terms terms;
    struct slope_cells slopes;
    double leak, power;               /* m, l; |S'|^power is what crossed[] holds     */
    bool crossing, rising;            /* is crossed[] asked for? heights[]? The maker's to set        */
    double facing, height;            /* dS/du, m: S now                              */
    double ends[CELLS_CHUNK];         /* dS/du at each sub-interval's end             */
    double heights[CELLS_CHUNK];      /* m, S there                                   */
    double climbed[CELLS_CHUNK];      /* m, integral of S' ds over it                 */
    double crossed[CELLS_CHUNK];      /* integral of |S'|^power ds over it            */
    double crossed_late[CELLS_CHUNK]; /* m, the same of s |S'|^power, s travelled since its start */
    double travelled[CELLS_CHUNK];    /* m; more than |u1 - u0| where it turns        */
    int filled;                       /* ends[] and what is beside it up to here are known */
    double before;                    /* m, S at the first sub-interval's start */
};

/* Of the contact's surface, from S = S' = 0 on. s must be zeroed, and stay where it is. Errors as of path_cells_make.
 */
bool path_integral_make(struct path_integral *s, struct stage_run *r, struct err *e);

/* From S = S' = 0 on again, wherever the contact is then. */
void path_integral_reset(struct path_integral *s);

/* Follows the n <= CELLS_CHUNK sub-intervals from number `first` on (since the start), which must come in order. */
void path_integral_run(struct path_integral *s, const struct stage_run *r, long first, int n);

/* Of n sub-intervals without a way. */
void path_integral_rest(struct path_integral *s, int n);

/* m, of the ground that is followed where the contact is at the start of sub-interval number k. */
double path_integral_ground(const struct path_integral *s, const struct board *b, long k);

/* To ITEM_FOLLOWED, where the board has it: of the frames that begin in the n sub-intervals from number `first` on,
   which were followed last. */
void path_integral_note(const struct path_integral *s, struct board *b, long first, int n);

/* Means of a force weighted by a triangle about each sub-interval's start: linear B-splines, so that what lies beyond
   the sub-rate folds in with sinc^2.

     F_j = 1/dt integral of f(t) max(0, 1 - |t - t_j| / dt) dt = early_j + late_(j-1)          t_j = j dt

     early_i, late_i   N: over sub-interval i, (1/dt) integral of (1 - q) f dt and of q f dt,
                       q = (t - t_i) / dt, from 0 to 1

   The B-splines add up to 1: what each sub-interval gives is early + late, its plain mean, so that momentum is kept. */

struct bspline {
    double early[CELLS_CHUNK], late[CELLS_CHUNK];
    double carried; /* late part of the last sub-interval before the chunk */
};

/* Writes ITEM_SUBFORCE from number `first` on, of n sub-intervals, which must come in order. Where the contact is
   lifted off (to the instant) there is no force; the time is counted on the board. */
void path_integral_lay(struct bspline *h, struct board *b, long first, int n);

/* The same, added to what is there and counted already. */
void path_integral_add(struct bspline *h, struct board *b, long first, int n);

/* No contact, no force: where the hand lifts the scraper, or a ball is clear of the surface. N, ITEM_LOAD from number
 * `first` on: lifted off where it is negative; NULL: it never is. */
const double *path_integral_load(const struct board *b, long first);

/* The share of a sub-interval over which it presses, of a normal force (N) that goes in a straight line from a to b. */
double path_integral_pressed(double a, double b);

/* Of a force's parts over that sub-interval makes those of what of it falls into that share. The rest is
   cut off, and the force is taken as the straight line that has both parts. */
void path_integral_cut(double a, double b, double *early, double *late);

/* Counts on the board the time of the n sub-intervals from number `first` on over which it is negative. */
void path_integral_lifted(struct board *b, long first, int n);

#endif
