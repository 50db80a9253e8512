/* The force of a ball that rolls over a surface, papers/000 section 4.

     f      = scraping (f_h + f_v) + f_roll                 equation 19; contact.roll.scraping: how much it slips
     f_roll = k rho^1.5 (1 + mu rho') for rho > 0, else 0   equation 15; lambda = mu k
     rho    = delta (N(t)/N)^(2/3) + r + y                  m, for eq. 16; delta at rest (below)
     y'' + (2 zeta w0 + mu N/m) y' + w0^2 y = S''           y  m, how much deeper the ground presses in
     r'     = -2 pi 2 Hz (delta / 1.5 N) (f_roll - N(t)+)   r  m, holds the mean force at that of N(t)+

   S'' is the vertical acceleration of the limited trajectory S that the ball is to follow, d/dt (|v| S') of
   force/scrape.c: S follows the ball's rolling curve (surface/tip.c), its curvature limited by an alpha that varies
   with the normal force N(t) (equation 7). A ball of mass m on the spring d(f_roll)/d(rho) = 1.5 N/delta = m w0^2
   keeps to the ground below its resonance w0, where f_roll = N + m S'', and above it stays where it is, and the
   ground presses into it: f_roll = N + 1.5 N S/delta. zeta is contact.roll.damping_ratio.

   With follows: point S is of the ground itself, as papers/000 has it (section 4.1: S "is determined as in the
   scraping model"): what the limiter then takes away is as much as of a scraper. Departure, by default: a ball cannot
   follow what is narrower than itself.

   f_h, f_v are those of what scrapes (force/scrape.c), of the same trajectory S; with contact.force: paper those of
   equations 2 and 3 as printed (force/paper.c), and the rolling term is added to them, not smoothed, as there what is
   smoothed are curvatures.

   Departure. Equation 16 has rho = R - r cos(x/R) + S: it puts S itself, and the rise of the centre of mass, about -r
   cos(theta), into the penetration. S is what the ball meets only where it does not follow; and with the rise the
   force is largest where the centre of mass is highest. By Newton's second law the normal force, N(t) = m (g + d2(-r
   cos theta)/dt2), is largest where it is lowest; and millimetres of rise stand against micrometres of S. So here the
   offset and the lobes of the rim (rim, which is not in the paper) press the ball deeper and less deep as N(t)
   does, quasi-statically: on level ground f_roll is N(t) (mu aside: a ball turns slowly; force/roll.c says where
   it does not). With penetration: paper, rho = R - r cos(x/R) + S + rim as printed, x that of equation 18, S leaked
   (force/path_integral.c), k and lambda by hand, and N(t) without the lobes.

   Where N(t) < 0, as when an offset ball spins fast, it is clear of the surface: no force at all. Without a static
   normal force (contact.gravity: 0) there is no rest and no resonance, and f_roll is what of N(t) presses. */
#include "force/roll.h"

#include <math.h>
#include <string.h>

#include "force/hertz.h"
#include "force/scrape.h"
#include "num/noise.h"
#include "num/real.h"
#include "num/vecmath.h"
#include "scene/rows.h"
#include "scene/scene_part.h"
#include "surface/limiter.h"
#include "surface/relief.h"
#include "trajectory/contact.h"
#include "trajectory/load.h"
#include "trajectory/trajectory.h"

/* ------------------------------------------------------------------ the law */

/* f_roll = k rho^1.5 (1 + mu rho') for rho > 0, else 0, and never below 0: papers/000 equation 15 with lambda = mu k.

   Over a sub-interval dt from a to b, with rho' known at both ends, and rho in the mean (of what is smooth (a + b)/2 +
   dt (rho'_a - rho'_b)/12, Euler and Maclaurin):

     mean rho^1.5       of the straight line from a to b, raised by what the mean of rho lies above it
     its late part      half of it and (b^1.5 - a^1.5) / 12
     lambda rho^1.5 rho' is dQ/dt, Q = (2/5) lambda rho^2.5, mean Q = (Q_a + Q_b) / 2 + dt (Q'_a - Q'_b) / 12; early and
   late parts as in force/scrape.c

   The error is of order dt^4 where rho is smooth, of order dt^3 where rho'' jumps, as it does where the limiter
   saturates, and dt^2.5 where rho passes through 0, as rho^1.5 has a continuous first derivative there. The paper says
   nothing of rho < 0 (its power is then no number) and of rho' < -1/mu, where the force would pull: no force. */

/* max(0, rho)^1.5 */
/* The contact of a rolling ball at rest, on smooth ground and on rough.

     N     = m g cos(incline), or load.constant     static normal force
     delta = delta_H + 1.5 Rq, at least 1 nm        penetration at rest; or contact.roll.static_penetration
     k     = N / delta^1.5                          or contact.roll.stiffness, kappa: then delta = (N/k)^(2/3)
     w0^2  = 1.5 N / (delta m)                      the ball's mass on the spring d(k rho^1.5)/d(rho) at rest

     delta_H = (N/k_H)^(2/3)                        Hertz's law, force/hertz.c; 0 where a modulus is not known
     Rq^2    = <(z(p + h) - 2 z(p) + z(p - h))^2> / 6

   Two springs in series: Hertz's, 1.5 N / delta_H, and that of the asperities, N / Rq. A rough contact's stiffness is
   in proportion to its load over the height of its roughness (Greenwood and Williamson, Proc. R. Soc. A 295, 1966;
   Persson, Phys. Rev. Lett. 99, 2007, has N / (gamma h_rms) with gamma near 0.5). Departure: papers/000 sets k by
   ear.

   Rq is a mean over 1024 places p, in one coordinate over the first 20 cm or the profile's extent, in the plane over
   the map or the first 20 cm square, and as many vectors h, Gaussian, of s = 0.5 mm in each coordinate. A wave of
   wave number q passes with 1 - (4/3) exp(-q^2 s^2/2) + (1/3) exp(-2 q^2 s^2) of its square: 50 % at 2.3 mm, near the
   cut-off of 2.5 mm of ISO 21920; a tilt does not pass. Places are random, one in each of 1024 parts along x, vectors
   quasi-random (an additive recurrence, Roberts 2018) in random order, and both always the same: Rq is the ground's,
   whatever rolls there, to about 2 %. */

enum { PLACES = 1024, BATCH = 128 };

#define ROUGH_SHARE 1.5 /* of Rq, in delta */
#define REST_LEAST 1e-9 /* m */
#define STRETCH 0.2     /* m of ground, where it has no end */
#define STEP 0.5e-3     /* m, s */

/* In [0, 1): number i of the recurrence by `step`. */
static double spread(long i, double step)
{
    double x = 0.5 + (double)i * step;
    return x - floor(x);
}

static void ground_extent(const struct relief *ground, int axis, double extent[2])
{
    extent[0] = -HUGE_VAL;
    extent[1] = HUGE_VAL;
    for (const struct relief_part *p = ground->first; p; p = p->next) {
        extent[0] = fmax(extent[0], p->from[axis]);
        extent[1] = fmin(extent[1], p->to[axis]);
    }
    if (!isfinite(extent[0]) || !isfinite(extent[1])) {
        extent[0] = 0;
        extent[1] = STRETCH;
    }
}

/* Numbers of random streams, one row each. */
enum { ALONG, ACROSS, SHUFFLE };

/* The second differences of BATCH places from number `first` on, m. */
static void second_differences(const struct relief *ground, double extent[2][2], struct noise places,
                               const int order[PLACES], long first, double to[BATCH])
{
    double x[3 * BATCH], y[3 * BATCH], z[3 * BATCH];
    for (int i = 0; i < BATCH; i++) {
        double length = STEP * sqrt(-2 * real_log(1 - spread(order[first + i], 0.75487766624669276)));
        double turn = 2 * spread(order[first + i], 0.56984029099805327);
        double along =
            (double)(first + i) + noise_uniform(places, ALONG, (uint64_t)(first + i)); /* rising: cheaply read */
        along /= PLACES;
        double across = noise_uniform(places, ACROSS, (uint64_t)(first + i));
        for (int k = 0; k < 3; k++) {
            x[3 * i + k] = extent[0][0] + along * (extent[0][1] - extent[0][0]) + (k - 1) * length * real_cospi(turn);
            y[3 * i + k] = extent[1][0] + across * (extent[1][1] - extent[1][0]) + (k - 1) * length * real_sinpi(turn);
        }
    }
    const double *beside = ground->along == ALONG_PLANE ? y : NULL;
    relief_at(ground, &(struct relief_points){3 * BATCH, x, beside}, &(struct relief_values){.z = z});
    for (int i = 0; i < BATCH; i++)
        to[i] = (z[3 * i] - z[3 * i + 1]) + (z[3 * i + 2] - z[3 * i + 1]);
}

double roll_stiffness_roughness(const struct relief *ground)
{
    struct noise places = noise_make(0, "roll_stiffness");
    double extent[2][2], difference[BATCH], sum = 0;
    int order[PLACES];
    /* Vectors go to places at random: two sequences in step would meet some waves at the same phase again and again. */
    for (int i = 0; i < PLACES; i++) {
        int k = (int)(noise_uniform(places, SHUFFLE, (uint64_t)i) * (i + 1));
        order[i] = order[k];
        order[k] = i;
    }
    for (int axis = 0; axis < 2; axis++)
        ground_extent(ground, axis, extent[axis]);
    for (long first = 0; first < PLACES; first += BATCH) {
        second_differences(ground, extent, places, order, first, difference);
        for (int i = 0; i < BATCH; i++)
            sum += difference[i] * difference[i];
    }
    return sqrt(sum / (6.0 * PLACES));
}

static double rest_of(double normal, double stiffness) { return real_pow(normal / stiffness, 2.0 / 3); }

static double hertz_rest(const struct contact *c, double normal)
{
    struct err unknown = {0};
    double stiffness;
    return hertz_stiffness(c, &stiffness, &unknown) ? rest_of(normal, stiffness) : 0;
}

/* Of r's contact, whose board has the relief with its tip. Without a static normal force there is neither rest nor
   resonance: both are 0, and the stiffness is the scene's, or NAN. */
static struct roll_stiffness roll_stiffness_make(const struct stage_run *r)
{
    const struct contact *c = r->contact;
    double given = hertz_given(c), depth = roll_of(c)->static_penetration;
    struct roll_stiffness s = {.normal = load_constant(c), .stiffness = given, .roughness = NAN, .hertz = NAN};
    if (!(s.normal > 0)) return s;
    if (isnan(given) && isnan(depth)) {
        s.roughness = roll_stiffness_roughness(c->ball.point ? r->board->relief : r->board->relief->under);
        s.hertz = hertz_rest(c, s.normal);
        depth = fmax(s.hertz + ROUGH_SHARE * s.roughness, REST_LEAST);
    }
    s.rest = isnan(given) ? depth : rest_of(s.normal, given);
    s.stiffness = isnan(given) ? s.normal / (s.rest * sqrt(s.rest)) : given;
    s.resonance = sqrt(1.5 * s.normal / (s.rest * c->scraper.mass));
    return s;
}

static double roll_power_at(double rho) { return rho > 0 ? rho * sqrt(rho) : 0; }

struct roll_parts roll_law_force(const struct roll_law *l, const struct roll_end *a, const struct roll_end *b,
                                 double mean, double dt)
{
    double k = l->stiffness, lambda = k * l->mu, pa = roll_power_at(a->rho), pb = roll_power_at(b->rho),
           bow = mean - 0.5 * (a->rho + b->rho);
    double spring = 0.5 * k * roll_law_power(a->rho + bow, b->rho + bow), tilt = k * (pb - pa) / 12;
    double qa = 0.4 * lambda * pa * a->rho, qb = 0.4 * lambda * pb * b->rho, half = 0.5 * (qb - qa) / dt,
           curved = lambda * (pa * a->rate - pb * b->rate) / 12;
    if (dt + l->mu * (b->rho - a->rho) <= 0) return (struct roll_parts){0};
    return (struct roll_parts){spring - tilt + half + curved, spring + tilt + half - curved};
}

double roll_law_contact(double a, double b)
{
    double most = a > b ? a : b, least = a > b ? b : a;
    return least > 0 ? 1 : most > 0 ? most / (most - least) : 0;
}

/* ------------------------------------------------------------------ a mass on a spring */

/* The step of y'' + c y' + w^2 y = a, a = start + (end - start) q over 0 <= q <= 1, q = t/dt, is exact: with p = w y,
   v = y' and the integral I of p,

     d(p, v, a dt, slope dt, I)/dq = M (p, v, a dt, slope dt, I)
      dp = w dt v    dv = -w dt p - c dt v + a dt    d(a dt) = slope dt    dI = p

   has the solution exp(M) after a whole step, whatever the poles are, real, double or complex. exp(M) is Taylor's
   series of M / 2^n, |M| / 2^n < 1/2, squared n times (Moler and Van Loan, SIAM Review 45, 2003): the only operations
   are + and *, the same bits everywhere. */

enum { ORDER = 5, TERMS = 16 };

typedef double matrix[ORDER][ORDER];

static void multiply(matrix a, matrix b, matrix to)
{
    matrix product = {{0}};
    for (int i = 0; i < ORDER; i++)
        for (int k = 0; k < ORDER; k++)
            for (int j = 0; j < ORDER; j++)
                product[i][j] += a[i][k] * b[k][j];
    memcpy(to, product, sizeof product);
}

static void exponential(matrix m)
{
    double norm = 0, scale = 1;
    matrix power = {{0}}, sum = {{0}};
    int squarings = 0;
    for (int i = 0; i < ORDER; i++)
        for (int j = 0; j < ORDER; j++)
            norm = fmax(norm, fabs(m[i][j]));
    for (; norm * ORDER * scale > 0.5; scale *= 0.5)
        squarings++;
    for (int i = 0; i < ORDER; i++) {
        power[i][i] = sum[i][i] = 1;
        for (int j = 0; j < ORDER; j++)
            m[i][j] *= scale;
    }
    for (int n = 1; n <= TERMS; n++) {
        multiply(power, m, power);
        for (int i = 0; i < ORDER; i++)
            for (int j = 0; j < ORDER; j++)
                sum[i][j] += power[i][j] /= n;
    }
    memcpy(m, sum, sizeof sum);
    for (; squarings > 0; squarings--)
        multiply(m, m, m);
}

struct roll_follow roll_follow_make(double resonance, double damping, double dt)
{
    enum { P, V, A, SLOPE, I };
    double w = resonance * dt;
    struct roll_follow f = {.dt = dt};
    matrix m = {[P] = {[V] = w}, [V] = {[P] = -w, [V] = -damping * dt, [A] = 1}, [A] = {[SLOPE] = 1}, [I] = {[P] = 1}};
    exponential(m);
    static const int rows[3] = {P, V, I};
    for (int k = 0; k < 3; k++) {
        double unit = rows[k] == V ? dt : 1 / resonance; /* y = p / w; dt y' = dt v */
        const double *row = m[rows[k]];
        f.step[k][0] = unit * row[P] * resonance;
        f.step[k][1] = unit * row[V] / dt;
        f.push[k][0] = unit * (row[A] - row[SLOPE]) * dt;
        f.push[k][1] = unit * row[SLOPE] * dt;
    }
    return f;
}

double roll_follow_step(struct roll_follow *f, double start, double end)
{
    double to[3], y = f->y, rate = f->rate * f->dt;
    for (int k = 0; k < 3; k++)
        to[k] = f->step[k][0] * y + f->step[k][1] * rate + f->push[k][0] * start + f->push[k][1] * end;
    f->y = to[0];
    f->rate = to[1] / f->dt;
    return to[2];
}

/* ------------------------------------------------------------------ warnings */

/* A ball that follows its lobes does so quasi-statically: driven at w rad/s up and down by h, a mass m
   on a contact that gives way by a spring s rises by h / (1 - w^2/w0^2), w0^2 = s/m, and presses by m w^2 times that. s
   = d(k rho^1.5)/d(rho) = 1.5 N / rest where it lies at rest. At half of w0 the force is a third larger than what N(t)
   says; well above w0 it is s h, that of a roughness, and what N(t) says is far too much. */

#define DEEP 0.1    /* of the radius: a rest deeper than that is warned of */
#define FAST 0.5    /* of w0 */
#define SLIGHT 0.05 /* of N: how much it swings */

static void warn_lobes(struct stage_run *r, const struct roll_stiffness *rests)
{
    const struct contact *c = r->contact;
    const struct ball *b = &c->ball;
    double lobes = b->lobes * r->board->trajectory->top_speed / (b->radius - b->offset) / (2 * REAL_PI);
    double own = rests->resonance / (2 * REAL_PI);
    if (b->lobe_height > 0 && lobes > FAST * own)
        board_warn(
            r->board,
            arena_format(
                r->arena,
                "contact '%s': %.3g lobes of the ball pass in a second, and it cannot follow them: on its contact it "
                "swings by itself at %.3g Hz; the force "
                "that they make is too large: take contact.model: roll_coupled, fewer ball.lobes, or a slower motion",
                c->name, lobes, own));
}

static void warn_roll(struct stage_run *r, const struct roll_stiffness *rests)
{
    const struct contact *c = r->contact;
    const struct load_law *l = r->board->load;
    if (!(rests->normal > 0) && !(l && l->most > 0)) {
        board_warn(r->board,
                   arena_format(r->arena,
                                "contact '%s': nothing presses the ball down: it scrapes, but its rolling force is 0",
                                r->contact->name));
        return;
    }
    if (rests->rest > DEEP * c->ball.radius)
        board_warn(r->board,
                   arena_format(r->arena,
                                "contact '%s': at rest the ball lies %.3g m deep, more than a tenth of its radius, "
                                "%.3g m: so soft a contact is no ball's; a greater contact.roll.stiffness (or kappa), "
                                "or a smaller static_penetration, makes it harder",
                                c->name, rests->rest, c->ball.radius));
    if (rests->normal > 0) warn_lobes(r, rests);
    /* Equation 7 goes by the extremes of N(t), however near to each other: as N(t) swings less and less, alpha does not
       come near to that of a constant force. The paper has the extremes, and so it stays. */
    if (r->board->limiter && r->board->limiter->varies && isnan(limiter_of(c)->force_range[0]) &&
        l->most - l->least < SLIGHT * l->most)
        board_warn(r->board,
                   arena_format(r->arena,
                                "contact '%s': the normal force swings by %.2g %% only, from %.6g to %.6g N, and "
                                "contact.limiter goes from alpha_max to alpha_min by it; give "
                                "contact.limiter.force_range, for alpha to go by newtons",
                                c->name, 100 * (1 - l->least / l->most), l->least, l->most));
    if (contact_gravity(c) == 0)
        board_warn(r->board,
                   arena_format(r->arena,
                                "contact '%s': nothing presses the ball down but its own turning: contact.gravity is "
                                "0, and for about half of the time it is clear of the surface; once off it would stay "
                                "off, which contact.model: roll_coupled follows",
                                c->name));
}

/* ------------------------------------------------------------------ state */

#define HOLDING 2.0 /* Hz, how fast the mean force is brought to that of N(t) */

struct roll_state {
    struct scrape scrape;
    struct spin spin;
    struct roll_law law;
    struct roll_stiffness rests;
    struct roll_follow follow;
    bool round;   /* neither offset nor lobes                                    */
    bool printed; /* penetration: paper                                          */
    bool added;   /* the scraping terms are there, from force/paper.c            */
    bool idle;    /* nothing presses the ball                                    */
    bool touches; /* the ball lay on the surface at the end of the last sub-interval */
    bool begun;
    double climbing;         /* m/s, |v| S' at the end of the last sub-interval             */
    double shift, excess[2]; /* m, r; N, force less N(t)+ in the last sub-interval, and in that before */
    double slow[2];          /* m, rho less follows[] where the last sub-interval began and ended */
    /* At the start of the chunk's first sub-interval and at each one's end: */
    double follows[CELLS_CHUNK + 1], rate[CELLS_CHUNK + 1]; /* m, m/s: y (printed: S) and its rate */
    double mean[CELLS_CHUNK];          /* m, of y or S over each                                      */
    double rests_at[CELLS_CHUNK + 1];  /* m: delta (N(t)/N)^(2/3); printed: R - r cos(x/R) + rim */
    double rise[CELLS_CHUNK + 1];      /* m, of the centre of mass over where it is lowest (trajectory/spin.h) */
    double rho[CELLS_CHUNK + 1], last; /* m; at the end of the chunk before                      */
};

static bool roll_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->contact.model == CONTACT_ROLL && scrape_law(c)->force == FORCE_DIRECTIONAL;
}

static bool roll_added_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->contact.model == CONTACT_ROLL && scrape_law(c)->force == FORCE_PAPER;
}

/* Measured. */
static double roll_work(const struct contact *c, const struct scene *s)
{
    bool round = c->ball.offset == 0 && c->ball.lobe_height == 0;
    double piece = limiter_of(c)->curve == LIMITER_TANH ? 180 : 80;
    return piece * path_cells_work(c, s) + (round ? 60 : 210) * s->accuracy.oversampling;
}

/* ------------------------------------------------------------------ opening */

static bool roll_printed(const struct contact *c, struct roll_state *s, struct err *e)
{
    double k = s->law.stiffness = hertz_given(c), normal = load_constant(c);
    s->law.mu = roll_of(c)->lambda / k;
    s->rests = (struct roll_stiffness){.normal = normal, .stiffness = k, .roughness = NAN, .hertz = NAN};
    s->rests.rest = normal > 0 ? real_pow(normal / k, 2.0 / 3) : 0;
    return !isnan(k) ||
           err_set(e, ERR_SCENE,
                   "contact '%s': contact.roll.penetration: paper needs contact.roll.stiffness (or kappa)", c->name);
}

static void roll_rests(struct stage_run *r, struct roll_state *s)
{
    const struct contact *c = r->contact;
    const struct board *b = r->board;
    struct roll_stiffness *rests = &s->rests;
    *rests = roll_stiffness_make(r);
    s->law = (struct roll_law){.stiffness = rests->stiffness, .mu = hertz_of(c)->mu};
    double added = 2 * roll_of(c)->damping_ratio * rests->resonance;
    double damping = added + s->law.mu * rests->normal / c->scraper.mass;
    if (rests->resonance > 0) s->follow = roll_follow_make(rests->resonance, damping, 1 / (b->rate * b->over));
    s->idle = !(rests->normal > 0) && !(b->load && b->load->most > 0);
    warn_roll(r, rests);
}

static bool roll_open(struct stage_run *r, struct err *e)
{
    const struct contact *c = r->contact;
    struct roll_state *s = ARENA_TAKE(r->arena, struct roll_state, 1);
    s->spin = spin_make(c);
    s->round = c->ball.offset == 0 && c->ball.lobe_height == 0;
    s->printed = s->scrape.path.rising = roll_of(c)->penetration == PENETRATION_PAPER;
    s->added = scrape_law(c)->force == FORCE_PAPER;
    s->touches = true;
    r->state = s;
    r->ahead = 1;
    if (!scrape_make(&s->scrape, r, roll_of(c)->scraping, e) || (s->printed && !roll_printed(c, s, e))) return false;
    if (!s->printed) roll_rests(r, s);
    r->board->bspline = true;
    r->board->rolls = !s->idle;
    r->board->roll = (struct roll_report){.stiffness = s->rests.stiffness,
                                          .rest = s->rests.rest,
                                          .resonance = s->rests.resonance / (2 * REAL_PI),
                                          .roughness = s->rests.roughness,
                                          .hertz = s->rests.hertz};
    return true;
}

/* ------------------------------------------------------------------ penetration */

/* S and dS/dt = v S'(u) - |v| S/l. */
static void roll_follows_printed(struct roll_state *s, const double *v, double dt, int n)
{
    const struct path_integral *l = &s->scrape.path;
    for (int i = 0; i < n; i++) {
        s->follows[i + 1] = l->heights[i];
        s->rate[i + 1] = v[i + 1] * l->ends[i] - fabs(v[i + 1]) * l->heights[i] / l->leak;
        s->mean[i] = 0.5 * (s->follows[i] + s->follows[i + 1]) + dt * (s->rate[i] - s->rate[i + 1]) / 12;
    }
}

/* y, of S'' as the straight line that has its two parts over the sub-interval, those of f_v/m in force/scrape.c:
   early = (2 start + end)/6, late = (start + 2 end)/6. */
static void roll_follows(struct roll_state *s, const double *v, double dt, int n)
{
    const struct path_integral *l = &s->scrape.path;
    for (int i = 0; i < n; i++) {
        double from = s->climbing, to = s->climbing = v[i + 1] * l->ends[i], mean = l->climbed[i] / dt;
        double early = (mean - from) / dt, late = (to - mean) / dt;
        s->mean[i] = roll_follow_step(&s->follow, 4 * early - 2 * late, 4 * late - 2 * early);
        s->follows[i + 1] = s->follow.y;
        s->rate[i + 1] = s->follow.rate;
    }
}

/* rests_at[], and rise[] of what is not round. */
static void roll_turns(struct roll_state *s, const struct board *b, const double *load, long first, int n)
{
    double rim[CELLS_CHUNK + 1], *at = s->rests_at;
    const struct roll_stiffness *rests = &s->rests;
    if (!s->round)
        spin_at(&s->spin, (size_t)n + 1, cells_values(b, ITEM_POSITION, first), cells_values(b, ITEM_VELOCITY, first),
                NULL, &(struct spin_out){.rise = s->rise, .printed = s->printed ? at : NULL, .rim = rim});
    for (int i = 0; i <= n && !s->round; i++)
        s->rise[i] += rim[i] + s->spin.offset;
    for (int i = 0; i <= n && s->printed; i++)
        at[i] = s->spin.radius + (s->round ? 0 : at[i] + rim[i]);
    for (int i = 0; i <= n && !s->printed; i++)
        at[i] = !load || !(rests->normal > 0) ? 1 : load[i] > 0 ? load[i] / rests->normal : 0;
    if (load && !s->printed) vecmath_pow((size_t)n + 1, at, 2.0 / 3, at);
    for (int i = 0; i <= n && !s->printed; i++)
        at[i] *= rests->rest;
}

/* ------------------------------------------------------------------ force */

/* rho less follows[] changes slowly: its rates at a sub-interval's ends are made of its last two steps. */
static struct roll_parts roll_force(struct roll_state *s, int i, double dt)
{
    double slow = s->rho[i + 1] - s->follows[i + 1], step = slow - s->slow[1];
    double bend = s->begun ? step - (s->slow[1] - s->slow[0]) : 0;
    struct roll_end from = {s->rho[i], s->rate[i] + (step - 0.5 * bend) / dt};
    struct roll_end to = {s->rho[i + 1], s->rate[i + 1] + (step + 0.5 * bend) / dt};
    s->slow[0] = s->slow[1];
    s->slow[1] = slow;
    s->begun = true;
    return roll_law_force(&s->law, &from, &to, s->mean[i] + 0.5 * (s->slow[0] + slow) - bend / 12, dt);
}

/* N, by how much the force is above N(t)+ in the sub-interval. */
static double roll_excess(const struct roll_state *s, const double *load, int i, struct roll_parts f)
{
    if (!load) return f.early + f.late - s->rests.normal;
    path_integral_cut(load[i], load[i + 1], &f.early, &f.late);
    double pressed = path_integral_pressed(load[i], load[i + 1]);
    double twice = pressed < 1 ? pressed * fmax(load[i], load[i + 1]) : load[i] + load[i + 1];
    return f.early + f.late - 0.5 * twice;
}

/* To the scraping terms' parts, or (added) alone. */
static void roll_add(struct roll_state *s, const double *load, double dt, int n)
{
    struct bspline *h = &s->scrape.bspline;
    bool weightless = !s->printed && !(s->rests.normal > 0);
    double softness = s->printed || weightless ? 0 : s->rests.rest / (1.5 * s->rests.normal); /* m/N */
    double holding = 2 * REAL_PI * HOLDING * dt * softness;
    s->rho[0] = s->begun ? s->last : s->rests_at[0];
    s->slow[1] = s->begun ? s->slow[1] : s->rho[0];
    for (int i = 0; i < n; i++) {
        double ahead = 2 * s->excess[0] - s->excess[1]; /* of this sub-interval */
        s->rho[i + 1] = s->rests_at[i + 1] + s->shift - holding * ahead + s->follows[i + 1];
        struct roll_parts f = {0};
        if (!weightless)
            f = roll_force(s, i, dt);
        else if (load)
            f = (struct roll_parts){(2 * load[i] + load[i + 1]) / 6, (load[i] + 2 * load[i + 1]) / 6};
        s->excess[1] = s->excess[0];
        s->excess[0] = holding > 0 ? roll_excess(s, load, i, f) : 0;
        s->shift -= holding * s->excess[0];
        h->early[i] = f.early + (s->added ? 0 : h->early[i]);
        h->late[i] = f.late + (s->added ? 0 : h->late[i]);
    }
}

/* ------------------------------------------------------------------ account */

/* The share of sub-interval i of the chunk in contact, and whether in it the ball leaves the surface. */
static double roll_contact(struct roll_state *s, const double *load, int i, bool *lifts_off)
{
    bool before = s->touches, weightless = !s->printed && !(s->rests.normal > 0);
    double pressed = load ? path_integral_pressed(load[i], load[i + 1]) : 1;
    s->touches = !(load && load[i + 1] < 0) && (weightless || s->rho[i + 1] > 0);
    *lifts_off = before && !s->touches;
    return s->idle ? 0 : pressed * (weightless ? 1 : roll_law_contact(s->rho[i], s->rho[i + 1]));
}

/* m, of the centre of mass at the start of sub-interval i of the chunk: the rolling curve where the ball is, less how
   much deeper the ground presses in there. */
static double roll_height(const struct roll_state *s, const struct board *b, long first, int i)
{
    double z = path_integral_ground(&s->scrape.path, b, first + i);
    return z - (s->printed ? 0 : s->follows[i]) + (s->round ? 0 : s->rise[i]);
}

/* Report and ITEM_ROLL over the chunk's sub-intervals. */
static void roll_account(struct roll_state *s, struct board *b, const double *load, long first, int n)
{
    double dt = 1 / (b->rate * b->over), last = b->trajectory->duration / dt;
    for (int i = 0; i < n; i++) {
        bool lifts_off;
        double share = roll_contact(s, load, i, &lifts_off);
        if ((double)(first + i) + 0.5 < last) {
            b->roll.contact += share * dt;
            b->roll.time += dt;
            b->roll.lift_offs += lifts_off;
        }
        if (!board_has(b, ITEM_ROLL)) continue;
        double *value = board_at(b, ITEM_ROLL, (first + i) / b->over);
        if ((first + i) % b->over == 0) {
            value[ROLL_PENETRATION] = s->rho[i];
            value[ROLL_HEIGHT] = roll_height(s, b, first, i);
            value[ROLL_CONTACT] = value[ROLL_LIFT_OFFS] = 0;
        }
        value[ROLL_CONTACT] += share / b->over;
        value[ROLL_LIFT_OFFS] += lifts_off;
    }
}

/* ------------------------------------------------------------------ running */

static void roll_chunk(struct roll_state *s, struct stage_run *r, long first, int n)
{
    struct board *b = r->board;
    double dt = 1 / (b->rate * b->over);
    const double *load = path_integral_load(b, first), *v = cells_values(b, ITEM_VELOCITY, first);
    if (s->added)
        path_integral_run(&s->scrape.path, r, first, n);
    else
        scrape_force(&s->scrape, r, first, n);
    if (s->printed)
        roll_follows_printed(s, v, dt, n);
    else if (s->rests.resonance > 0)
        roll_follows(s, v, dt, n);
    roll_turns(s, b, load, first, n);
    roll_add(s, load, dt, n);
    roll_account(s, b, load, first, n);
    path_integral_note(&s->scrape.path, b, first, n);
    s->last = s->rho[n];
    s->follows[0] = s->follows[n];
    s->rate[0] = s->rate[n];
    if (!board_has(b, ITEM_SUBFORCE)) /* a table may ask for the ball's height alone */
        return;
    if (s->added)
        path_integral_add(&s->scrape.bspline, b, first, n);
    else
        path_integral_lay(&s->scrape.bspline, b, first, n);
}

static bool roll_run(struct stage_run *r, long from, long to, struct err *e)
{
    int over = r->board->over;
    (void)e;
    for (long first = from * over, last = to * over; first < last; first += cells_chunk(first, last))
        roll_chunk(r->state, r, first, cells_chunk(first, last));
    return true;
}

static void roll_skip(struct stage_run *r, long frame)
{
    struct roll_state *s = r->state;
    (void)frame;
    scrape_reset(&s->scrape);
    s->climbing = s->shift = s->excess[0] = s->excess[1] = 0;
    s->follow.y = s->follow.rate = s->follows[0] = s->rate[0] = 0;
    s->touches = true;
    s->begun = false;
}

/* ------------------------------------------------------------------ parameters */

#define ROLLS "contact.model=roll"
#define DEVIATION "contact.roll.penetration=deviation"

static const struct choice penetrations[] = {
    [PENETRATION_DEVIATION] =
        {"deviation",
         "rho is the penetration at rest under the normal force, which an offset of the centre of mass and lobes of "
         "the rim vary. Added is how much deeper the ground presses in as the ball follows it like a mass on the "
         "contact's spring. The sum is slowly shifted so that the mean force is the normal force's"},
    [PENETRATION_PAPER] = {"paper",
                           "equation 16 as printed, rho = R - r cos(x/R) + S, with a stiffness chosen by hand"},
    {NULL, NULL}};

static const struct choice followed[] = {
    [FOLLOWS_BALL] = {"ball", "the way of a ball's centre, which no valley narrower than the ball lets in"},
    [FOLLOWS_POINT] = {"point",
                       "the ground itself, as a scraper's point does: Agarwal et al. (2021), section 4.1, as printed"},
    {NULL, NULL}};

static const struct key keys[] = {
    {ROW_CHOICE(roll, follows, "contact.roll.follows"), KEY_NONE, 0, 0, "ball", ROLLS,
     "what of the ground the trajectory S is of", followed},
    {ROW_CHOICE(roll, penetration, "contact.roll.penetration"), KEY_NONE, 0, 0, "deviation", ROLLS,
     "what the penetration rho is", penetrations},
    {ROW_NUMBER(roll, lambda, "contact.roll.lambda"), KEY_DISSIPATION, 0, 1e12, "0.1 N s/m^2.5",
     "contact.roll.penetration=paper", "lambda of equation 15"},
    {ROW_NUMBER(roll, static_penetration, "contact.roll.static_penetration"), KEY_LENGTH, 1e-12, 1, "", DEVIATION,
     "how deep the ball lies in the contact at rest, from which the stiffness follows; left out: Hertz's depth of both "
     "materials plus 1.5 times the ground's roughness Rq, at least 1 nm",
     .shown = "8 um"},
    {ROW_NUMBER(roll, damping_ratio, "contact.roll.damping_ratio"), KEY_NONE, 0, 10, "0.3", DEVIATION,
     "damping ratio of the ball's mass on its contact, added to that of mu: a ball does not hum at its resonance; 0: "
     "mu "
     "alone, as roll_coupled has it"},
    {ROW_NUMBER(roll, scraping, "contact.roll.scraping"), KEY_NONE, 0, 1000, "1", ROLLS,
     "factor on the scraping terms of equation 19: how much the ball slips; 0: it rolls purely"},
    {.path = NULL}};

/* Defaults stand in every effective scene, so that only another value is one that was meant to do something. */
static void paper_check(const struct scene_part *p, const struct contact *c)
{
    if (!scene_part_given(p, "contact.roll.stiffness") && !scene_part_given(p, "contact.roll.kappa"))
        scene_part_missing(p, "contact.roll.stiffness", "2 kN/m^1.5",
                           " (or contact.roll.kappa): under penetration: paper rho is about the ball's radius, and "
                           "the stiffness is chosen by hand");
    if (scene_part_given(p, "contact.roll.mu") && hertz_of(c)->mu != 1)
        scene_part_refuse(p, "contact.roll.mu", "contact.roll.mu",
                          "give contact.roll.lambda in its place, or set contact.roll.penetration to deviation",
                          " has no effect where contact.roll.penetration is paper");
}

#define PATCH 20e-6 /* m, default of ball.patch */

/* As above: patch's default stands in every effective scene. */
static void point_check(const struct scene_part *p, const struct contact *c)
{
    if (scene_part_given(p, "ball.patch") && c->ball.patch != PATCH)
        scene_part_refuse(p, "ball.patch", "ball.patch", "remove it (a null takes away what another file says)",
                          " has no effect where contact.roll.follows is point: the ground is followed itself, and no "
                          "rolling curve is smoothed");
}

static void roll_check(const struct scene_part *p, const struct contact *c, const void *own)
{
    const struct roll *r = own;
    if (scene_part_known(p, "contact.roll.follows") && r->follows == FOLLOWS_POINT)
        point_check(p, c);
    else if (c->ball.patch == 0)
        scene_part_refuse(
            p, "ball.patch", "ball.patch", "write for instance: patch: 20 um",
            " must be above 0 where contact.model is roll: the force follows from the slope and curvature of the "
            "rolling curve, which has kinks");
    if (scene_part_known(p, "contact.roll.penetration") && r->penetration == PENETRATION_PAPER) paper_check(p, c);
}

static bool rolls(const struct contact *c) { return c->contact.model == CONTACT_ROLL; }

/* Of equation 16 as printed the lobes are in the penetration. A point has no rolling curve. */
static void roll_derive(struct contact *c, void *own)
{
    const struct roll *r = own;
    c->load.no_lobes = r->penetration == PENETRATION_PAPER;
    c->ball.point = r->follows == FOLLOWS_POINT;
}

static const struct params roll_params = {
    .section = "contact.roll",
    .size = sizeof(struct roll),
    .keys = keys,
    .alternative = {.most = 1,
                    .paths = {"contact.roll.stiffness", "contact.roll.kappa", "contact.roll.static_penetration"}},
    .derive = roll_derive,
    .check = roll_check,
    .given = rolls,
};

const struct roll *roll_of(const struct contact *c) { return params_of(c, &roll_params); }

const struct stage roll_stage = {
    .name = "roll",
    .params = &roll_params,
    .does = "contact force of a ball that rolls: penetration, and the scraping terms of one limited trajectory",
    .paper = "000 eq. 15, 16, 18, 19",
    .idle = "contact.model is not roll, or contact.force is paper",
    .needs = ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | ITEM_BIT(ITEM_SURFACE),
    .takes = ITEM_BIT(ITEM_ALPHA) | ITEM_BIT(ITEM_LOAD),
    .gives = ITEM_BIT(ITEM_SUBFORCE) | ITEM_BIT(ITEM_ROLL) | ITEM_BIT(ITEM_FOLLOWED),
    .knobs = KNOB_BIT(oversampling),
    .asks = path_cells_asks,
    .wanted = roll_wanted,
    .work = roll_work,
    .open = roll_open,
    .run = roll_run,
    .skip = roll_skip,
    .report = roll_report,
};

const struct stage roll_added_stage = {
    .name = "roll_added",
    .does = "rolling term of the contact force, added to the scraping terms as printed",
    .paper = "000 eq. 15, 16, 18, 19",
    .idle = "contact.model is not roll, or contact.force is directional",
    .needs = ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | ITEM_BIT(ITEM_SURFACE) | ITEM_BIT(ITEM_SUBFORCE),
    .takes = ITEM_BIT(ITEM_ALPHA) | ITEM_BIT(ITEM_LOAD),
    .gives = ITEM_BIT(ITEM_SUBFORCE) | ITEM_BIT(ITEM_ROLL) | ITEM_BIT(ITEM_FOLLOWED),
    .knobs = KNOB_BIT(oversampling),
    .asks = path_cells_asks,
    .wanted = roll_added_wanted,
    .work = roll_work,
    .open = roll_open,
    .run = roll_run,
    .skip = roll_skip,
    .report = roll_report,
};
