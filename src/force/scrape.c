/* The force of a scraper that follows one limited trajectory S along its path (`force: directional`).

     f_v = d/dt (m |v| S')                  vertical force, N                                        papers/000 eq. 1
     f_h = beta1 | |v| S' |^beta2           horizontal force, N                                      papers/000 eq. 3

     m     mass of the scraper, kg          v        velocity along the path, m/s
     S'    dS/ds, force/path_integral.c             beta1    N (s/m)^beta2

   Departures from papers/000, and why. Equation 2 keeps only S'' v^2 of the second time derivative of S and leaves out
   2 S_xy v_x v_y and the gradient times the acceleration: momentum is lost at every reversal, and the force changes
   when the axes are turned; here f_v is the whole derivative along the path. One S serves both forces.

   What goes on the board are means weighted by linear B-splines (force/path_integral.h). With P = m |v| S', and since v
   dt = du, a sub-interval's parts of f_v are

     early  (mean P - P(start)) / dt        late  (P(end) - mean P) / dt
     mean P = m/dt times the integral of S' ds over it

   exactly, whatever the surface does inside. Those of f_h are beta1 / dt |v|^(beta2 - 1) times the integrals of (1 - q)
   |S'|^beta2 ds and of q |S'|^beta2 ds at the mean speed, with q the share of the way. Where the speed changes from v0
   to v1 the force does as its power, and time runs otherwise than the way: beta2/6 (v1 - v0)/(v1 + v0) of f_h goes from
   early to late (to first order, and as though S' were constant). */
#include "force/scrape.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "num/lanes.h"
#include "num/real.h"
#include "scene/rows.h"
#include "surface/limiter.h"
#include "surface/relief.h"
#include "trajectory/contact.h"
#include "trajectory/motion.h"

bool scrape_make(struct scrape *s, struct stage_run *r, double share, struct err *e)
{
    const struct scrape_law *m = scrape_law(r->contact);
    s->beta1 = m->beta1;
    s->beta2 = m->beta2;
    s->mass = r->contact->scraper.mass;
    s->share = share;
    s->path.crossing = share * m->beta1 != 0;
    return path_integral_make(&s->path, r, e);
}

void scrape_reset(struct scrape *s)
{
    path_integral_reset(&s->path);
    s->momentum = s->bspline.carried = 0;
}

/* Both parts of f_h, N, from rubbed[]. `changes` is (v1 - v0)/(v1 + v0), and 0 where these are not the ends of the
   sub-interval's straight line: at a turn, a sudden start or stop. */
LANES_CLONES
static void scrape_horizontal(struct scrape *s, const double *v, double per_second, int n, const double *rubbed)
{
    const struct path_integral *l = &s->path;
    double power = s->beta2 / 6, *early = s->bspline.early, *late = s->bspline.late;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double mean = l->travelled[i] * per_second, a = fabs(v[i]), b = fabs(v[i + 1]);
        int straight = (v[i] * v[i + 1] >= 0) & (fabs(a + b - 2 * mean) < 0.1 * mean), some = l->crossed[i] > 0;
        double changes = lanes_select(straight, (b - a) / lanes_select(straight, a + b, 1), 0);
        double delayed =
            rubbed[i] * (l->crossed_late[i] / lanes_select(some, l->travelled[i], 1) + power * changes * l->crossed[i]);
        late[i] = lanes_select(some, delayed, 0);
        early[i] = lanes_select(some, rubbed[i] * l->crossed[i] - delayed, 0);
    }
}

/* f_v is added to f_h, and both take their share. */
LANES_CLONES
static void scrape_vertical(struct scrape *s, const double *v, int n, double per_second, double share)
{
    const double *ends = s->path.ends, *climbed = s->path.climbed;
    double momentum[CELLS_CHUNK + 1],
        mass = s->mass, *restrict early = s->bspline.early, *restrict late = s->bspline.late;
    momentum[0] = s->momentum;
#pragma omp simd
    for (int i = 0; i < n; i++)
        momentum[i + 1] = mass * v[i + 1] * ends[i];
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double mean = mass * climbed[i] * per_second;
        early[i] = share * (mean - momentum[i] + early[i]);
        late[i] = share * (momentum[i + 1] - mean + late[i]);
    }
    s->momentum = momentum[n];
}

void scrape_force(struct scrape *s, const struct stage_run *r, long first, int n)
{
    const struct board *b = r->board;
    double rubbed[CELLS_CHUNK], per_second = b->rate * b->over, share = s->share * per_second;
    path_integral_run(&s->path, r, first, n);
    const double *v = cells_values(b, ITEM_VELOCITY, first);
    for (int i = 0; i < n; i++)
        rubbed[i] = s->beta2 == 1 || !(s->path.crossed[i] > 0)
                        ? s->beta1
                        : s->beta1 * real_pow(s->path.travelled[i] * per_second, s->beta2 - 1);
    scrape_horizontal(s, v, per_second, n, rubbed);
    scrape_vertical(s, v, n, per_second, share);
}

/* ------------------------------------------------------------------ parameters */

#define PRESSED "contact.model=scrape|roll"

static const struct choice forces[] = {
    [FORCE_DIRECTIONAL] = {"directional",
                           "one limited trajectory S along the path; f_v = d/dt(m |v| S'), f_h = beta1 | "
                           "|v| S' |^beta2"},
    [FORCE_PAPER] = {"paper", "equations 2 and 3 as printed"},
    {NULL, NULL}};

static const struct key keys[] = {
    {ROW_CHOICE(scrape_law, force, "contact.force"), KEY_NONE, 0, 0, "directional", PRESSED,
     "directional: one limited trajectory along the path, from which both forces follow; paper: equations 2 and 3 as "
     "printed",
     forces},
    {ROW_NUMBER(scrape_law, beta1, "contact.beta1"), KEY_FORCE_COEFFICIENT, 0, 1e6, "0.05", PRESSED,
     "beta_1 of equation 3, in N (s/m)^beta2; 0: no horizontal force"},
    {ROW_NUMBER(scrape_law, beta2, "contact.beta2"), KEY_NONE, 0.1, 10, "1", PRESSED, "beta_2 of equation 3"},
    {ROW_NUMBER(scrape_law, leak, "contact.leak"), KEY_LENGTH, 1e-5, 10, "2 mm", "contact.force=directional",
     "distance over which the limited slope forgets; keeps it from drifting away"},
    {.path = NULL}};

static const struct params scrape_params = {
    .section = "contact.force", .size = sizeof(struct scrape_law), .keys = keys, .given = contact_pressed};

const struct scrape_law *scrape_law(const struct contact *c) { return params_of(c, &scrape_params); }

/* ------------------------------------------------------------------ the stage */

static bool scrape_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->contact.model == CONTACT_SCRAPE && scrape_law(c)->force == FORCE_DIRECTIONAL;
}

/* Measured. On a way that turns in the plane sub-intervals longer than a pitch over their number are cut. */
static double scrape_work(const struct contact *c, const struct scene *s)
{
    bool straight = motion_straight(&c->motion), plane = relief_along(c) == ALONG_PLANE;
    double limited = limiter_of(c)->curve == LIMITER_TANH ? 1 : 0.4, over = s->accuracy.oversampling,
           knots = path_cells_knots(c, s);
    if (plane && !straight) return limited * (300 * over * fmax(2 * knots, 1) + 2000 * knots);
    return limited * (plane ? 250 * over + 1000 * knots : 95 * over + 350 * knots);
}

static bool scrape_open(struct stage_run *r, struct err *e)
{
    struct scrape *s = ARENA_TAKE(r->arena, struct scrape, 1);
    r->state = s;
    r->ahead = 1;
    r->ends = r->board->moving;
    r->board->bspline = true;
    return scrape_make(s, r, 1, e);
}

/* Does nothing move in those n sub-intervals, or to and from them, so that there is no force? */
static bool scrape_rests(const struct scrape *s, const struct board *b, long first, int n)
{
    const double *u = cells_values(b, ITEM_POSITION, first), *v = cells_values(b, ITEM_VELOCITY, first);
    if (s->momentum != 0) return false;
    for (int i = 0; i <= n; i++)
        if (v[i] != 0 || u[i] != u[0]) return false;
    return true;
}

static bool scrape_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct scrape *s = r->state;
    struct board *b = r->board;
    (void)e;
    for (long first = from * b->over, last = to * b->over; first < last;) {
        int n = cells_chunk(first, last);
        if (scrape_rests(s, b, first, n)) {
            memset(&s->bspline, 0, offsetof(struct bspline, carried));
            path_integral_rest(&s->path, n);
        } else
            scrape_force(s, r, first, n);
        path_integral_note(&s->path, b, first, n);
        if (board_has(b, ITEM_SUBFORCE)) path_integral_lay(&s->bspline, b, first, n);
        first += n;
    }
    return true;
}

static void scrape_skip(struct stage_run *r, long frame)
{
    (void)frame;
    scrape_reset(r->state);
}

const struct stage scrape_stage = {
    .name = "scrape",
    .params = &scrape_params,
    .does = "contact force of one limited trajectory along the path",
    .paper = "000 eq. 1, 3, 4, 5",
    .idle = "contact.model is not scrape, or contact.force is paper",
    .needs = ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | ITEM_BIT(ITEM_SURFACE),
    .takes = ITEM_BIT(ITEM_ALPHA) | ITEM_BIT(ITEM_LOAD),
    .gives = ITEM_BIT(ITEM_SUBFORCE) | ITEM_BIT(ITEM_FOLLOWED),
    .knobs = KNOB_BIT(oversampling),
    .asks = path_cells_asks,
    .wanted = scrape_wanted,
    .work = scrape_work,
    .open = scrape_open,
    .run = scrape_run,
    .skip = scrape_skip,
};
