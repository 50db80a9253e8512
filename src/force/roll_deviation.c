/* rms of S, the height of a rolling ball's geometric centre as it follows the ground (force/roll_centre.c), less its level (force/slope.h). A stiffness is no
   matter of how far the ball rolls or how fast, nor of how exactly that is worked out, so

     - within the motion each grain counts by the way that is gone in it, whatever the speed;
     - where the motion is short (ball_beyond) it goes on from its end in thought (force/roll_pass.c), and either part counts by the ground that it goes over, in the rms and
       in the fit of the level that both have taken off: the motion's ground once, however often it goes over it. Were it each time, the level would be
       the motion's alone, which what is beyond, at other places, has not: S there would run off by l^2 times the difference. Where that cannot be enough,
       as under a long contact.leak, the render says how uncertain the stiffness is;
     - the ground is read as accuracy.tip_heights: 1 has it, in a pass of its own where that is another: the same to the bit in every preset. */
#include "force/roll_deviation.h"

#include <math.h>
#include <string.h>

#include "scene/ball.h"
#include "surface/relief.h"
#include "trajectory/trajectory.h"

#define UNSURE 0.2 /* of the rms: a standard error above that is told */

struct roll_spread roll_deviation_spread(const double *at, const double *way, long n)
{
    double all = 0, sum = 0, first = at[0];
    struct roll_spread s = {0};
    for (long i = 0; i < n && way; i++)
        all += way[i];
    bool alike = !(all > 0);
    for (long i = 0; i < n; i++)
        sum += (alike ? 1 : way[i]) * (at[i] - first);
    all = alike ? (double)n : all;
    s.mean = first + sum / all;
    for (long i = 0; i < n; i++)
        s.square += (alike ? 1 : way[i]) * (at[i] - s.mean) * (at[i] - s.mean);
    s.square /= all;
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

static double deviation_ground(const struct stage_run *r)
{
    return trajectory_ground(r->board->trajectory, r->board->relief->along, ball_leak(r->contact));
}

/* What the motion brings to the fit of the level, as though it had gone over each piece of its ground once. */
static void deviation_once(struct roll_pass *p, double ground)
{
    struct slope *s = &p->slope;
    double part = fmin(ground / (p->board.trajectory->mean_speed * p->board.trajectory->duration), 1);
    for (int k = 0; k < SLOPE_LEVELS; k++) {
        s->bent[k] *= part;
        for (int j = 0; j <= k; j++)
            s->gone[k][j] *= part;
    }
}

/* Of n heights and their lifts, which are left as they are. */
static struct roll_spread deviation_part(double *const *lifts, const double *at, const double *way, long n, const double *level)
{
    struct arena *a = arena_open();
    double *levelled = ARENA_TAKE(a, double, n);
    memcpy(levelled, at, (size_t)n * sizeof *at);
    roll_centre_level(levelled, n, lifts, level);
    struct roll_spread s = roll_deviation_spread(levelled, way, n);
    arena_close(a);
    return s;
}

static double deviation_after(struct roll_pass *p, double beyond, double normal, struct arena *a)
{
    double level[SLOPE_LEVELS], *on[1 + SLOPE_LEVELS], ground[2] = {deviation_ground(&p->run), beyond};
    struct roll_spread s[2];
    long n = (long)ceil(beyond / roll_pass_grain(p->run.contact));
    for (int k = 0; k <= SLOPE_LEVELS; k++)
        on[k] = ARENA_TAKE(a, double, n);
    if (n > 0)
        deviation_once(p, ground[0]);
    bool both = n > 0 && roll_pass_beyond(p, n, beyond / (double)n, normal, on);
    slope_level(&p->slope, level);
    s[0] = deviation_part(p->lift[0], p->at[0], p->way, p->n, level);
    if (!both)
        return sqrt(s[0].square);
    s[1] = deviation_part(on + 1, on[0], NULL, n, level);
    return sqrt(spread_both(s, ground));
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
