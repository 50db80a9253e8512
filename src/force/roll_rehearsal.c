/* The rehearsal of a rolling ball: k and rho_0 of rho = max(0, rho_0 + rest ((N(t)/N)^(2/3) - 1) + D), force/roll.c.

     D      deviation of S, the height of the ball's geometric centre as it follows the ground, from its mean over the way (force/roll_centre.c)
     N(t)   normal force, what of it presses; N its mean over the motion
     k      = N / (n rms)^1.5       n    contact.roll.static_depth      rms    of S over the ground (force/roll_deviation.c), m; N and rms of the contact before its ablation, if it has one
     rest   = (N / k)^(2/3), the penetration at rest; where k is not given, n rms
     rho_0  : mean of max(0, k rho^1.5 (1 + mu rho')) = N

   No such thing is in papers/000. Its penetration is about R as printed, and a stiffness after Hertz makes the force absurd: 5 um of
   roughness give 48 N under a glass ball of 1 cm that weighs 0.11 N. Over a long time a ball that keeps to its surface presses it with its weight's
   normal part, no more and no less: rho_0 is what makes it so.

   The mean is that over the motion's grains (force/roll_pass.c), in which rho is a straight line (force/roll_law.h); grains in which N(t) < 0 have no
   force, and count. It grows with rho_0 and is convex: Newton's method from above comes down to the root. */
#include "force/roll_rehearsal.h"

#include "force/roll_deviation.h"
#include "num/lanes.h"
#include "num/vecmath.h"
#include "scene/rules.h"

extern const struct stage load_stage, limiter_stage;

static bool rehearsal_lifted(const struct roll_pass *p, long i)
{
    return p->load[0] && p->load[0][i] + p->load[1][i] < 0;
}

/* Mean of what presses. */
static double rehearsal_normal(const struct roll_pass *p)
{
    double sum = 0;
    for (long i = 0; i < p->n; i++)
        sum += rehearsal_lifted(p, i) ? 0 : 0.5 * (p->load[0][i] + p->load[1][i]);
    return sum / (double)p->n;
}

void roll_rehearsal_press(const struct roll_rehearsal *f, long n, const double *load, double *deeper)
{
    for (long i = 0; i < n; i++)
        deeper[i] = load[i] > 0 ? load[i] / f->normal : 0;
    vecmath_pow((size_t)n, deeper, 2.0 / 3, deeper);
    for (long i = 0; i < n; i++)
        deeper[i] = f->rest * (deeper[i] - 1);
}

/* Of at[] makes what is added to rho_0; load[] is used up. What is lifted off goes out of reach of the surface. */
static void rehearsal_press(struct roll_pass *p, const struct roll_rehearsal *found)
{
    for (long i = 0; i < p->n; i++) {
        bool lifted = rehearsal_lifted(p, i);
        for (int k = 0; k < 2; k++)
            p->at[k][i] = lifted ? -1e6 : p->at[k][i] - found->mean;
    }
    for (int k = 0; k < 2 && p->load[0]; k++) {
        roll_rehearsal_press(found, p->n, p->load[k], p->load[k]);
        for (long i = 0; i < p->n; i++)
            p->at[k][i] += p->load[k][i];
    }
}

/* Sums over n grains of the mean of rho^1.5 (1 + mu rho'), and of its derivative by base; by: base, mu / dt. */
LANES_CLONES
static void rehearsal_sums(const double *from, const double *to, long n, const double by[2], double sums[2])
{
    double mean[LANES] = {0}, slope[LANES] = {0}, base = by[0], per = by[1];
    for (long i = 0; i < n; i += LANES) {
        int some = n - i < LANES ? (int)(n - i) : LANES;
        for (int l = 0; l < some; l++) {
            double a = from[i + l], b = to[i + l], damped = 1 + per * (b - a);
            struct roll_power power = roll_law_power(base + a, base + b);
            damped = damped > 0 ? damped : 0;
            mean[l] += damped * power.mean;
            slope[l] += damped * power.slope;
        }
    }
    sums[0] = ((mean[0] + mean[4]) + (mean[2] + mean[6])) + ((mean[1] + mean[5]) + (mean[3] + mean[7]));
    sums[1] = ((slope[0] + slope[4]) + (slope[2] + slope[6])) + ((slope[1] + slope[5]) + (slope[3] + slope[7]));
}

static void rehearsal_means(const struct roll_pass *p, const struct roll_law *l, double base, double means[2])
{
    const double by[2] = {base, l->mu * p->board.rate};
    rehearsal_sums(p->at[0], p->at[1], p->n, by, means);
    means[0] /= (double)p->n;
    means[1] /= (double)p->n;
}

/* The base at which the mean power is `wanted`. */
static double rehearsal_base(const struct roll_pass *p, const struct roll_law *l, double wanted, double rest)
{
    double base = rest, more = rest, means[2];
    rehearsal_means(p, l, base, means);
    for (int i = 0; i < 60 && means[0] < wanted; i++, more *= 2) {
        base += more;
        rehearsal_means(p, l, base, means);
    }
    for (int i = 0; i < 100 && fabs(means[0] - wanted) > 1e-10 * wanted && means[1] > 0; i++) {
        base -= (means[0] - wanted) / means[1];
        rehearsal_means(p, l, base, means);
    }
    return base;
}

/* Neither offset nor lobes are of the ground. */
static bool rehearsal_even(const struct contact *c, struct err *e)
{
    return err_set(e, ERR_SCENE,
                   "contact '%s': the ball's way is level: nothing deviates from which contact.roll.static_depth could make a stiffness; "
                   "give contact.roll.stiffness (or kappa), or a rougher surface", c->name);
}

/* The stiffness that the contact has before its ablation, which takes away what it says and no more: on a board of its own, with the normal force and the limit of curvature of then. */
static bool rehearsal_whole(const struct stage_run *r, struct roll_law *l, struct roll_rehearsal *found, struct err *e)
{
    struct arena *a = arena_open();
    struct contact *whole = ARENA_TAKE(a, struct contact, 1);
    struct board *board = ARENA_TAKE(a, struct board, 1);
    struct stage_run run = *r;
    struct roll_rehearsal before;
    *whole = *r->contact->whole;
    whole->ablation.normal_force = ABLATED_FORCE_VARYING;
    whole->ablation.nonlinearity = ABLATED_NONLINEARITY_KEPT;
    *board = *r->board;
    board->load = NULL;
    board->limiter = NULL;
    run.contact = whole;
    run.board = board;
    bool ok = (!load_stage.wanted(whole, r->scene) || load_stage.open(&run, e)) && (!limiter_stage.wanted(whole, r->scene) || limiter_stage.open(&run, e));
    board->n_warnings = 0;
    ok = ok && roll_rehearsal_run(&run, slope_heading_make(&run, a), l, &before, e);
    found->deviation = ok ? before.deviation : NAN;
    for (int i = 0; ok && i < board->n_warnings; i++)
        board_warn(r->board, board->warnings[i]);
    arena_close(a);
    return ok;
}

static bool rehearsal_stiffness(struct roll_pass *p, const struct stage_run *r, struct roll_law *l, struct roll_rehearsal *found, struct err *e)
{
    if (!isnan(l->stiffness))
        return true;
    if (r->contact->whole)
        return rehearsal_whole(r, l, found, e);
    if (!roll_deviation_of(p, r, found->normal, &found->deviation, e))
        return false;
    if (!(found->deviation > 1e-15))
        return rehearsal_even(r->contact, e);
    double rest = r->contact->contact.roll.static_depth * found->deviation;
    l->stiffness = found->normal / (rest * sqrt(rest));
    return true;
}

static bool rehearsal_settle(struct roll_pass *p, const struct stage_run *r, struct roll_law *l, struct roll_rehearsal *found, struct err *e)
{
    slope_level(&p->slope, found->level);
    if (!rehearsal_stiffness(p, r, l, found, e))
        return false;
    for (int k = 0; k < 2; k++)
        roll_centre_level(p->at[k], p->n, p->lift[k], found->level);
    struct roll_spread spread = roll_deviation_spread(p->at[0], p->way, p->n);
    found->mean = spread.mean;
    found->deviation = isnan(found->deviation) ? sqrt(spread.square) : found->deviation;
    found->rest = roll_law_rest(found->normal, l->stiffness);
    rehearsal_press(p, found);
    found->base = rehearsal_base(p, l, found->normal / l->stiffness, found->rest);
    return true;
}

static bool rehearsal_all(struct roll_pass *p, const struct stage_run *r, struct roll_law *l, struct roll_rehearsal *found, struct err *e)
{
    if (!roll_pass_make(p, r, p->run.arena, e) || !roll_pass_motion(p, e))
        return false;
    if (p->board.load)
        found->normal = rehearsal_normal(p);
    return !(found->normal > 0) || rehearsal_settle(p, r, l, found, e);
}

bool roll_rehearsal_run(struct stage_run *r, const struct slope_heading *h, struct roll_law *l, struct roll_rehearsal *found, struct err *e)
{
    *found = (struct roll_rehearsal){.normal = rules_load(r->contact), .deviation = NAN};
    if (!r->board->load && !(found->normal > 0))
        return true;
    struct arena *a = arena_open();
    struct roll_pass *p = ARENA_TAKE(a, struct roll_pass, 1);
    p->run.arena = a;
    p->slope.turned.heading = h;
    bool good = rehearsal_all(p, r, l, found, e);
    arena_close(a);
    return good;
}
