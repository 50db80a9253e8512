/* rms of S, the height of a rolling ball's geometric centre as it follows the ground (force/roll_centre.c), less its level (force/slope.h). A stiffness is no
   matter of how far the ball rolls, nor of how exactly that is worked out, so

     - where the motion is short (ball_beyond) it goes on from its end in thought (force/roll_pass.c), and each part counts by the ground that it goes over, in the rms and
       in the fit of the level that both have taken off: the motion's ground once, however often it goes over it. Were it each time, the level would be
       the motion's alone, which what is beyond, at other places, has not: S there would run off by l^2 times the difference. Where that cannot be enough,
       as under a long contact.leak, the render says how uncertain the stiffness is;
     - the ground is read as accuracy.tip_heights: 1 has it, in a pass of its own where that is another: the same to the bit in every preset.

   The eight shapes that the level of a way that turns has beyond those of a line (force/slope.h) take some of S by chance, most of it where the ground is short,
   as on a circle of 2 mm. Added again is, of W metres of ground, R the mean of D^2, D what they leave, never more than they took:

     R q / (1 - q)     q = 8 P / (W R), at most 3/4     P   m^3, the spectrum of D at wavelengths far above l

   as eight shapes that vary slowly take 8 P of a random D's integral. P is l/SLOW times the mean square of D's means over l: of T that is white S has
   the covariance (1 + x/l) exp(-x/l), the spectrum 4 l, and means over l whose square is 8/e - 2 = 0.943 of its own. Longer means would tell ridges from a
   slow part better, but that part of D is what was taken. Over ridges of half of l q is some percent. By the number of independent values alone, whatever D
   is, k on ridges was up to 1.6 times too small on a circle of 15 mm. */
#include "force/roll_deviation.h"

#include <math.h>
#include <string.h>

#include "force/slope_level.h"
#include "scene/ball.h"
#include "surface/relief.h"
#include "trajectory/trajectory.h"

#define SLOW 0.236 /* (8/e - 2) / 4 */
#define UNSURE 0.2 /* of the rms: a standard error above that is told */

struct roll_spread roll_deviation_spread(const double *at, long n)
{
    double sum = 0, first = at[0];
    struct roll_spread s = {0};
    for (long i = 0; i < n; i++)
        sum += at[i] - first;
    s.mean = first + sum / (double)n;
    for (long i = 0; i < n; i++)
        s.square += (at[i] - s.mean) * (at[i] - s.mean);
    s.square /= (double)n;
    return s;
}

/* rms^2 of both together, of which each is so many metres of ground. */
static double spread_both(const struct roll_spread s[2], const double ground[2])
{
    double all = ground[0] + ground[1], mean = (ground[0] * s[0].mean + ground[1] * s[1].mean) / all, sum = 0;
    for (int k = 0; k < 2; k++)
        sum += ground[k] * (s[k].square + (s[k].mean - mean) * (s[k].mean - mean));
    return sum / all;
}

/* At the starts of grains: heights, and lifts. */
struct stretch {
    double *of[1 + SLOPE_LEVELS];
    long n;
    int levels;
};

static struct stretch stretch_make(struct arena *a, long n, int levels)
{
    struct stretch s = {.n = n, .levels = levels};
    for (int k = 0; k <= levels; k++)
        s.of[k] = ARENA_TAKE(a, double, n);
    return s;
}

/* Mean of the squares of the means over so many grains, less the mean of all. */
static double stretch_slow(const struct stretch *s, long block)
{
    double mean = roll_deviation_spread(s->of[0], s->n).mean, squares = 0;
    long blocks = s->n / block;
    for (long b = 0; b < blocks; b++) {
        double sum = 0;
        for (long i = b * block; i < (b + 1) * block; i++)
            sum += s->of[0][i] - mean;
        squares += sum / (double)block * (sum / (double)block);
    }
    return blocks > 0 ? squares / (double)blocks : 0;
}

/* The motion and what is beyond it. */
struct deviation_parts {
    int n;
    struct stretch of[2];
    double ground[2];               /* m */
};

static void deviation_level(struct deviation_parts *d, const double *level)
{
    for (int k = 0; k < d->n; k++)
        roll_centre_level(d->of[k].of[0], d->of[k].n, d->of[k].levels, d->of[k].of + 1, level);
}

static double deviation_square(const struct deviation_parts *d)
{
    struct roll_spread s[2];
    for (int k = 0; k < d->n; k++)
        s[k] = roll_deviation_spread(d->of[k].of[0], d->of[k].n);
    return d->n == 1 ? s[0].square : spread_both(s, d->ground);
}

static double deviation_ground(const struct stage_run *r)
{
    return trajectory_ground(r->board->trajectory, r->board->relief->along, ball_leak(r->contact));
}

/* What the motion brings to the fit of the level, as though it had gone over each piece of its ground once. */
static void deviation_once(struct roll_pass *p, double ground)
{
    struct slope *s = &p->slope;
    double part = fmin(ground / (p->board.trajectory->mean_speed * p->board.trajectory->duration), 1);
    for (int k = 0; k < s->levels; k++) {
        s->bent[k] *= part;
        s->rose[k] *= part;
        for (int j = 0; j <= k; j++) {
            s->gone[k][j] *= part;
            s->risen[k][j] *= part;
        }
    }
    s->far *= part;
}

/* Of the rms's square, what the shapes beyond the two took by chance. */
static double deviation_chance(const struct roll_pass *p, const struct deviation_parts *d)
{
    int shapes = p->slope.levels - SLOPE_PAIR;
    double leak = p->slope.leak, ground = d->ground[0] + d->ground[1];
    double way = p->board.trajectory->mean_speed * p->board.trajectory->duration, slow = 0;
    for (int k = 0; k < d->n; k++)
        slow += d->ground[k] / ground * stretch_slow(&d->of[k], lrint(fmax(leak * (double)d->of[k].n / (k == 0 ? way : d->ground[1]), 1)));
    double left = deviation_square(d), share = left > 0 ? fmin(shapes * leak * slow / (SLOW * ground * left), 0.75) : 0;
    return left * share / (1 - share);
}

static double deviation_after(struct roll_pass *p, double beyond, double normal, struct arena *a)
{
    double level[SLOPE_LEVELS], two[SLOPE_LEVELS];
    long n = (long)ceil(beyond / roll_pass_grain(p->run.contact));
    struct deviation_parts d = {.n = 1, .of = {stretch_make(a, p->n, p->slope.levels), stretch_make(a, n, p->slope.levels)}, .ground = {deviation_ground(&p->run)}};
    for (int k = 0; k <= p->slope.levels; k++)
        memcpy(d.of[0].of[k], k == 0 ? p->at[0] : p->lift[0][k - 1], (size_t)p->n * sizeof(double));
    if (n > 0)
        deviation_once(p, d.ground[0]);
    if (n > 0 && roll_pass_beyond(p, n, beyond / (double)n, normal, d.of[1].of)) {
        d.n = 2;
        d.ground[1] = beyond;
    }
    slope_level(&p->slope, false, two);
    slope_level(&p->slope, true, level);
    for (int k = 0; k < p->slope.levels; k++)
        level[k] -= two[k];
    deviation_level(&d, two);
    double all = deviation_square(&d);
    if (p->slope.levels <= SLOPE_PAIR)
        return sqrt(all);
    deviation_level(&d, level);
    double left = deviation_square(&d);
    return sqrt(fmin(left + deviation_chance(p, &d), fmax(all, left)));
}

static bool deviation_plain(const struct stage_run *r, double beyond, double normal, double *rms, struct err *e)
{
    struct arena *a = arena_open();
    struct roll_pass *p = ARENA_TAKE(a, struct roll_pass, 1);
    bool good = roll_pass_make(p, r, a, e) && roll_pass_plain(p, e) && roll_pass_motion(p, e);
    *rms = good ? deviation_after(p, beyond, normal, a) : NAN;
    arena_close(a);
    return good;
}

static void deviation_told(const struct stage_run *r, double ground)
{
    double error = ball_deviation_error(r->contact, ground);
    if (error > UNSURE)
        board_warn(r->board, arena_format(r->arena, "contact '%s': the stiffness comes from %.3g m of ground, in which contact.leak, %.3g m, forgets %.3g times only: it may well be "
                                          "off by %.0f %%; give contact.roll.stiffness (or kappa), a longer motion, or a shorter leak", r->contact->name, ground,
                                          r->contact->contact.leak, ground / r->contact->contact.leak, 150 * error));
}

bool roll_deviation_of(struct roll_pass *p, const struct stage_run *r, double normal, double *rms, struct err *e)
{
    double ground = deviation_ground(r), beyond = ball_beyond(r->contact, ground);
    if (ground > 0)
        deviation_told(r, ground + beyond);
    if (r->scene->accuracy.tip_heights != 1 && r->board->relief->under)
        return deviation_plain(r, beyond, normal, rms, e);
    *rms = deviation_after(p, beyond, normal, p->run.arena);
    return true;
}
