/* The rehearsal of a rolling ball: k and rho_0 of rho = max(0, rho_0 + rest ((N(t)/N)^(2/3) - 1) + D), force/roll.c.

     D      deviation of the height of the ball's geometric centre from its mean over the motion (force/roll_centre.c)
     N(t)   normal force, what of it presses; N its mean over the motion
     k      = N / (n rms(D))^1.5                         n    contact.roll.static_depth
     rest   = (N / k)^(2/3), the penetration at rest; where k is not given, n rms(D)
     rho_0  : mean of max(0, k rho^1.5 (1 + mu rho')) = N

   No such thing is in papers/000. Its penetration is about R as printed, and a stiffness after Hertz makes the force absurd: 5 um of
   roughness give 48 N under a glass ball of 1 cm that weighs 0.11 N. Over a long time a ball that keeps to its surface presses it with its weight's
   normal part, no more and no less: rho_0 is what makes it so.

   What the stages before lay on the board are functions of time, and the relief may be read anywhere: here they lay the whole motion on a board of the
   rehearsal's own, a chunk at a time, in grains of its own: 1/48000 s, or finer so that the ball goes no further in one than its patch, nor than a tenth of
   the way in which an offset ball's centre of mass passes through its lowest place (but no finer than 1 um of way), and a whole number in the motion.
   So neither accuracy.oversampling nor output.sample_rate changes what follows. S is integrated exactly over each grain, however long (force/slope.c).

   Of a motion of more than ROLL_REHEARSAL_MOST grains one in every `stride` is kept, at a place among them that goes by the golden ratio, so that nothing
   that repeats itself falls in step with it. The mean is that over grains in which rho is a straight line (force/roll_law.h); grains in which N(t) < 0
   have no force, and count. It grows with rho_0 and is convex: Newton's method from above comes down to the root. */
#include "force/roll_rehearsal.h"

#include "force/roll_centre.h"
#include "force/slope.h"
#include "num/lanes.h"
#include "num/vecmath.h"
#include "scene/rules.h"
#include "trajectory/trajectory.h"

extern const struct stage trajectory_stage, load_stage, limiter_stage;

struct rehearsal {
    struct stage_run run;           /* the rolling stage's, on the board below */
    struct board board;
    struct slope slope;
    struct roll_centre centre;
    double *at[2], *lift[2][2];     /* m, m^2, at the start and the end of each kept grain (force/roll_centre.h) */
    double *load[2];                /* N; NULL: constant                                                         */
    long grains, stride, next, n;   /* in all; one of so many is kept; which is the next; kept                   */
};

/* ------------------------------------------------------------------ grains */

/* x = R theta - r sin theta goes through the lowest place of the centre of mass within some (R - r)^1.5 / R^0.5. */
double roll_rehearsal_rate(const struct contact *c, double duration, double speed)
{
    double gap = c->ball.radius - c->ball.offset, way = fmax(fmin(c->ball.patch, 0.1 * gap * sqrt(gap / c->ball.radius)), 1e-6);
    return ceil(duration * fmax(ROLL_REHEARSAL_RATE, speed / way) * (1 - 1e-12)) / duration;
}

static long rehearsal_pick(const struct rehearsal *h, long group)
{
    double place = (double)group * 0.6180339887498949;
    return group * h->stride + (long)((double)h->stride * (place - floor(place)));
}

/* ------------------------------------------------------------------ the way over the motion */

static void rehearsal_board(struct rehearsal *h, const struct stage_run *r, struct arena *a)
{
    const struct contact *c = r->contact;
    const struct trajectory *tr = r->board->trajectory;
    unsigned items = ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | way_asks(c);
    h->run = *r;
    h->board = *r->board;
    h->run.board = &h->board;
    h->run.arena = a;
    h->board.rate = roll_rehearsal_rate(c, tr->duration, tr->top_speed);
    h->board.over = 1;
    if (h->board.load)
        items |= ITEM_BIT(ITEM_LOAD) | (load_stage.asks ? load_stage.asks(c, h->run.scene) : 0);
    if (h->board.limiter)
        items |= ITEM_BIT(ITEM_ALPHA);
    for (int i = 0; i < ITEM_COUNT; i++)
        h->board.signals[i] = items & ITEM_BIT(i) ? (struct signal){.per_frame = 1, .capacity = WAY_CHUNK + 1, .x = ARENA_TAKE(a, double, WAY_CHUNK + 1)}
                                                  : (struct signal){0};
}

static void rehearsal_room(struct rehearsal *h, struct arena *a)
{
    h->grains = lrint(h->board.trajectory->duration * h->board.rate);
    h->stride = (h->grains + ROLL_REHEARSAL_MOST - 1) / ROLL_REHEARSAL_MOST;
    h->next = rehearsal_pick(h, 0);
    long room = h->grains / h->stride + 1;
    for (int k = 0; k < 2; k++) {
        h->at[k] = ARENA_TAKE(a, double, room);
        h->lift[k][0] = ARENA_TAKE(a, double, room);
        h->lift[k][1] = ARENA_TAKE(a, double, room);
        h->load[k] = h->board.load ? ARENA_TAKE(a, double, room) : NULL;
    }
}

/* Motion, normal force and alpha at the ends of grains [from, to). */
static bool rehearsal_fill(struct rehearsal *h, long from, long to, struct err *e)
{
    const struct stage *const before[] = {&trajectory_stage, &load_stage, &limiter_stage};
    const bool there[] = {true, h->board.load != NULL, h->board.limiter != NULL};
    for (int i = 0; i < ITEM_COUNT; i++)
        h->board.signals[i].first = from;
    for (int i = 0; i < 3; i++)
        if (there[i] && !before[i]->run(&h->run, from, to + 1, e))
            return false;
    return true;
}

static void rehearsal_keep(struct rehearsal *h, long first, int n)
{
    const double *load = h->board.load ? way_values(&h->board, ITEM_LOAD, first) : NULL;
    for (; h->next < first + n; h->next = rehearsal_pick(h, ++h->n))
        for (long k = 0, i = h->next - first; k < 2; k++) {
            h->at[k][h->n] = h->centre.at[i + k];
            h->lift[k][0][h->n] = h->centre.lifts[0][i + k];
            h->lift[k][1][h->n] = h->centre.lifts[1][i + k];
            if (load)
                h->load[k][h->n] = load[i + k];
        }
}

static bool rehearsal_motion(struct rehearsal *h, struct err *e)
{
    for (long from = 0; from < h->grains;) {
        int n = way_some(from, h->grains);
        if (!rehearsal_fill(h, from, from + n, e))
            return false;
        slope_run(&h->slope, &h->run, from, n);
        roll_centre_run(&h->centre, &h->slope, &h->board, from, n);
        rehearsal_keep(h, from, n);
        from += n;
    }
    return true;
}

/* ------------------------------------------------------------------ what follows from it */

static bool rehearsal_lifted(const struct rehearsal *h, long i)
{
    return h->load[0] && h->load[0][i] + h->load[1][i] < 0;
}

/* Mean of what presses. */
static double rehearsal_normal(const struct rehearsal *h)
{
    double sum = 0;
    for (long i = 0; i < h->n; i++)
        sum += rehearsal_lifted(h, i) ? 0 : 0.5 * (h->load[0][i] + h->load[1][i]);
    return sum / (double)h->n;
}

static void rehearsal_statistics(const struct rehearsal *h, struct roll_rehearsal *found)
{
    const double *at = h->at[0];
    double sum = 0, squares = 0, first = at[0];
    for (long i = 0; i < h->n; i++)
        sum += at[i] - first;
    found->mean = first + sum / (double)h->n;
    for (long i = 0; i < h->n; i++)
        squares += (at[i] - found->mean) * (at[i] - found->mean);
    found->deviation = sqrt(squares / (double)h->n);
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
static void rehearsal_press(struct rehearsal *h, const struct roll_rehearsal *found)
{
    for (long i = 0; i < h->n; i++) {
        bool lifted = rehearsal_lifted(h, i);
        for (int k = 0; k < 2; k++)
            h->at[k][i] = lifted ? -1e6 : h->at[k][i] - found->mean;
    }
    for (int k = 0; k < 2 && h->load[0]; k++) {
        roll_rehearsal_press(found, h->n, h->load[k], h->load[k]);
        for (long i = 0; i < h->n; i++)
            h->at[k][i] += h->load[k][i];
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

static void rehearsal_means(const struct rehearsal *h, const struct roll_law *l, double base, double means[2])
{
    const double by[2] = {base, l->mu * h->board.rate};
    rehearsal_sums(h->at[0], h->at[1], h->n, by, means);
    means[0] /= (double)h->n;
    means[1] /= (double)h->n;
}

/* The base at which the mean power is `wanted`. */
static double rehearsal_base(const struct rehearsal *h, const struct roll_law *l, double wanted, double rest)
{
    double base = rest, more = rest, means[2];
    rehearsal_means(h, l, base, means);
    for (int i = 0; i < 60 && means[0] < wanted; i++, more *= 2) {
        base += more;
        rehearsal_means(h, l, base, means);
    }
    for (int i = 0; i < 100 && fabs(means[0] - wanted) > 1e-10 * wanted && means[1] > 0; i++) {
        base -= (means[0] - wanted) / means[1];
        rehearsal_means(h, l, base, means);
    }
    return base;
}

static bool rehearsal_even(const struct contact *c, struct err *e)
{
    return err_set(e, ERR_SCENE,
                   "contact '%s': the ball's rim is round and its way is level: nothing deviates from which contact.roll.static_depth could make a stiffness; "
                   "give contact.roll.stiffness (or kappa), or a rougher surface, or ball.lobe_height", c->name);
}

static bool rehearsal_settle(struct rehearsal *h, struct roll_law *l, struct roll_rehearsal *found, struct err *e)
{
    const struct contact *c = h->run.contact;
    slope_level(&h->slope, found->level);
    for (int k = 0; k < 2; k++)
        roll_centre_level(h->at[k], h->n, (const double *const[]){h->lift[k][0], h->lift[k][1]}, found->level);
    rehearsal_statistics(h, found);
    if (isnan(l->stiffness) && !(found->deviation > 1e-15))
        return rehearsal_even(c, e);
    if (isnan(l->stiffness)) {
        double rest = c->contact.roll.static_depth * found->deviation;
        l->stiffness = found->normal / (rest * sqrt(rest));
    }
    found->rest = roll_law_rest(found->normal, l->stiffness);
    rehearsal_press(h, found);
    found->base = rehearsal_base(h, l, found->normal / l->stiffness, found->rest);
    return true;
}

static bool rehearsal_all(struct rehearsal *h, struct roll_law *l, struct roll_rehearsal *found, struct err *e)
{
    h->slope.rising = true;
    h->centre = roll_centre_make(h->run.contact);
    if (!slope_make(&h->slope, &h->run, e) || !rehearsal_motion(h, e))
        return false;
    if (h->board.load)
        found->normal = rehearsal_normal(h);
    return !(found->normal > 0) || rehearsal_settle(h, l, found, e);
}

bool roll_rehearsal_run(struct stage_run *r, struct roll_law *l, struct roll_rehearsal *found, struct err *e)
{
    *found = (struct roll_rehearsal){.normal = rules_load(r->contact), .deviation = NAN};
    if (!r->board->load && !(found->normal > 0))
        return true;
    struct arena *a = arena_open();
    struct rehearsal *h = ARENA_TAKE(a, struct rehearsal, 1);
    rehearsal_board(h, r, a);
    rehearsal_room(h, a);
    bool good = rehearsal_all(h, l, found, e);
    arena_close(a);
    return good;
}
