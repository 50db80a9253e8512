/* The contact force as papers/000 prints it (`force: paper`), in two stages around the smoothing.

     S_xx = T(z_xx; alpha_x),  S_yy = T(z_yy; alpha_y)     equations 4, 5
     f_v  = m (S_xx v_x^2 + S_yy v_y^2)                    equation 2
     f_h  = beta1 | v_x dz/dx + v_y dz/dy |^beta2          equation 3, with the slope of the surface z:
                                                           only S'' is defined by the paper

   Along a path a profile has one axis, the path itself: v_x is the velocity along it and the y terms are zero; with
   surface.along: x they are zero too. alpha_y = limiter.ratio_y alpha_x. The paper's smoothing acts on the limited
   curvatures, "the window size in each dimension ... proportional to alpha_x and alpha_y" (section 2.2, last
   paragraph); the force is formed from them afterwards. At rest curvature and slope are those of the point touched.

   Curvatures and |slope|^beta2 are on the board as means weighted by linear B-splines (force/path_integral.h), exact
   where the speed is constant over a sub-interval: a piece whose middle is at the share q of it gives (1 - q) mean -
   share moment to the B-spline of its start, q mean + share moment to that of its end. v_x^2, v_y^2 and |v|^beta2 are
   means of those of the sub-intervals on both sides of its centre. What a change of speed within it has to do with the
   surface there is left out: of order dt^2 v'/v, -90 dB of the force at 48 kHz without oversampling and v'/v = 30 1/s.
   Under a ball that rolls these are the scraping terms of equation 19, times contact.roll.scraping. */
#include <math.h>
#include <string.h>

#include "force/path_cells.h"
#include "force/path_integral.h"
#include "force/roll.h"
#include "force/scrape.h"
#include "num/real.h"
#include "surface/limiter.h"
#include "surface/relief.h"
#include "trajectory/contact.h"
#include "trajectory/trajectory.h"

enum { PAPER_X, PAPER_Y, PAPER_SLOPE, PAPER_SIGNALS }; /* curvatures, as the way's channels, and |dz/du|^beta2 */

struct paper {
    struct path_cells path;
    double beta1, beta2;
    double whole[PAPER_SIGNALS][CELLS_CHUNK], late[PAPER_SIGNALS][CELLS_CHUNK],
        length[CELLS_CHUNK]; /* integrals of x ds, x s ds; m travelled */
    double touched[PAPER_SIGNALS][CELLS_CHUNK], last[PAPER_SIGNALS],
        carried[PAPER_SIGNALS]; /* at the last point of a sub-interval; of all; for the next B-spline */
    bool begun;
};

static double paper_at_rest(const struct paper *s, int signal)
{
    double x = s->last[signal];
    return signal != PAPER_SLOPE || s->beta2 == 1 ? x : x > 0 ? real_pow(x, s->beta2) : 0;
}

/* What a piece adds to its sub-interval: a mean, and the mean of q times it, q from 0 to 1 on its way. */
static void paper_gather(struct paper *s, int signal, int k, const double of[3])
{
    double h = of[0], whole = of[1], late = of[2];
    s->whole[signal][k] += h * whole;
    s->late[signal][k] += h * (s->length[k] * whole + h * late);
}

/* Before it begins to move the contact touches the first place. */
static void paper_begin(struct paper *s, const struct cells *p)
{
    for (int c = 0; c < s->path.channels; c++)
        s->last[c] = p->limited[c][p->at[0]];
    s->last[PAPER_SLOPE] = fabs(p->slope[p->at[0]]);
    for (int c = 0; c < PAPER_SIGNALS; c++)
        s->carried[c] = 0.5 * paper_at_rest(s, c);
    s->begun = true;
}

static void paper_use(void *self, const struct cells *p)
{
    struct paper *s = self;
    if (!s->begun && p->n > 0) paper_begin(s, p);
    for (int i = 0; i < p->n; i++) {
        int k = p->interval[i], at = p->at[i];
        double h = p->length[i], a = p->slope[at], b = p->slope[at + 1],
               middle = 0.5 * (a + b) + h * p->heading[i] / 8 * (p->bend[at] - p->bend[at + 1]);
        for (int c = 0; c < s->path.channels; c++) {
            paper_gather(s, c, k, (double[]){h, p->mean[c][i], 0.5 * p->mean[c][i] + p->moment[c][i]});
            s->touched[c][k] = p->limited[c][at + 1];
        }
        if (s->beta1 != 0) {
            struct magnitude crossed = path_integral_power((double[]){a, middle, b}, s->beta2);
            paper_gather(s, PAPER_SLOPE, k, (double[]){h, crossed.whole, crossed.late});
            s->touched[PAPER_SLOPE][k] = fabs(b);
        }
        s->length[k] += h;
    }
}

static bool paper_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return contact_pressed(c) && scrape_law(c)->force == FORCE_PAPER;
}

static double paper_work(const struct contact *c, const struct scene *s)
{
    return (limiter_of(c)->curve == LIMITER_TANH ? 160 : 70) * path_cells_work(c, s);
}

static bool paper_curvature_open(struct stage_run *r, struct err *e)
{
    struct paper *s = ARENA_TAKE(r->arena, struct paper, 1);
    s->beta1 = scrape_law(r->contact)->beta1;
    s->beta2 = scrape_law(r->contact)->beta2;
    s->path.integrate = paper_use;
    s->path.self = s;
    r->state = s;
    r->ahead = 1;
    return path_cells_make(&s->path, r, CELLS_AXES, HUGE_VAL, e);
}

/* One signal's means by B-splines, from the chunk's sub-intervals. */
static void paper_bsplines(struct paper *s, int signal, double *out, int n)
{
    for (int i = 0; i < n; i++) {
        double l = s->length[i], whole = l > 0 ? s->whole[signal][i] / l : paper_at_rest(s, signal);
        double late = l > 0 ? s->late[signal][i] / (l * l) : 0.5 * whole;
        out[i] = s->carried[signal] + (whole - late);
        s->carried[signal] = late;
        s->last[signal] = l > 0 ? s->touched[signal][i] : s->last[signal];
    }
}

static bool paper_curvature_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct paper *s = r->state;
    struct board *b = r->board;
    (void)e;
    for (long first = from * b->over, last = to * b->over; first < last;) {
        int n = cells_chunk(first, last);
        memset(s->whole, 0, sizeof s->whole);
        memset(s->late, 0, sizeof s->late);
        memset(s->length, 0, sizeof s->length);
        path_cells_run(&s->path, r, first, n);
        paper_bsplines(s, PAPER_X, cells_values(b, ITEM_CURVATURE, first), n);
        if (board_has(b, ITEM_CURVATURE_Y)) paper_bsplines(s, PAPER_Y, cells_values(b, ITEM_CURVATURE_Y, first), n);
        paper_bsplines(s, PAPER_SLOPE, cells_values(b, ITEM_SLOPE, first), n);
        first += n;
    }
    return true;
}

const struct stage paper_curvature_stage = {
    .name = "paper_curvature",
    .does = "limited curvature and slope of the surface, per axis",
    .paper = "000 eq. 4, 5",
    .idle = "contact.model is neither scrape nor roll, or contact.force is directional",
    .needs = ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_VELOCITY) | ITEM_BIT(ITEM_SURFACE),
    .takes = ITEM_BIT(ITEM_ALPHA),
    .gives = ITEM_BIT(ITEM_CURVATURE) | ITEM_BIT(ITEM_CURVATURE_Y) | ITEM_BIT(ITEM_SLOPE),
    .knobs = KNOB_BIT(oversampling),
    .asks = path_cells_asks,
    .wanted = paper_wanted,
    .work = paper_work,
    .open = paper_curvature_open,
    .run = paper_curvature_run,
};

/* ------------------------------------------------------------------ equations 2 and 3 */

struct paper_speeds {
    double x, y, power; /* means over a sub-interval: v_x^2, v_y^2, m^2/s^2; |v|^beta2 */
    double early, late; /* its parts of the B-splines about its ends, each a half but where it is lifted off
                           (force/path_integral.h) */
};

struct paper_force {
    struct paper_speeds before; /* of the sub-interval before               */
    double beta1, beta2, share; /* share: of a ball, contact.roll.scraping  */
};

static bool paper_open(struct stage_run *r, struct err *e)
{
    const struct scrape_law *law = scrape_law(r->contact);
    struct paper_force *f = ARENA_TAKE(r->arena, struct paper_force, 1);
    (void)e;
    f->beta1 = law->beta1;
    f->beta2 = law->beta2;
    f->share = r->contact->contact.model == CONTACT_ROLL ? roll_of(r->contact)->scraping : 1;
    r->state = f;
    r->ahead = 1;
    r->ends = r->board->moving;
    r->board->bspline = true;
    return true;
}

static double paper_force_work(const struct contact *c, const struct scene *s)
{
    (void)c;
    return 8 * s->accuracy.oversampling;
}

/* Mean velocity along one axis over sub-interval number k. */
static double paper_velocity(const struct board *b, long k, int axis)
{
    const struct trajectory *tr = b->trajectory;
    bool path = b->relief->along == ALONG_PATH, ends = path || tr->straight;
    const double *place = cells_values(b, ends ? ITEM_POSITION : axis ? ITEM_Y : ITEM_X, k);
    double scale = path ? axis == 0 : tr->straight ? tr->e[axis] : 1;
    return (place[1] - place[0]) * b->rate * b->over * scale;
}

/* Over sub-interval number k. */
static struct paper_speeds paper_speeds(const struct board *b, double beta2, long k)
{
    double vx = paper_velocity(b, k, 0), vy = b->relief->along == ALONG_PLANE ? paper_velocity(b, k, 1) : 0;
    double speed =
        fabs(*cells_values(b, ITEM_POSITION, k + 1) - *cells_values(b, ITEM_POSITION, k)) * b->rate * b->over;
    struct paper_speeds s = {vx * vx, vy * vy, beta2 == 1 ? speed : speed > 0 ? real_pow(speed, beta2) : 0, 0.5, 0.5};
    if (board_has(b, ITEM_LOAD))
        path_integral_cut(*cells_values(b, ITEM_LOAD, k), *cells_values(b, ITEM_LOAD, k + 1), &s.early, &s.late);
    return s;
}

/* By the B-spline between two sub-intervals. */
static double paper_force(const struct stage_run *r, long k, const struct paper_speeds *after)
{
    const struct board *b = r->board;
    const struct paper_force *f = r->state;
    const struct paper_speeds *before = &f->before;
    double yy = board_has(b, ITEM_CURVATURE_Y) ? *cells_values(b, ITEM_CURVATURE_Y, k) : 0;
    double force = r->contact->scraper.mass *
                   (*cells_values(b, ITEM_CURVATURE, k) * (before->late * before->x + after->early * after->x) +
                    yy * (before->late * before->y + after->early * after->y));
    force += f->beta1 * *cells_values(b, ITEM_SLOPE, k) * (before->late * before->power + after->early * after->power);
    return f->share * force;
}

static bool paper_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct paper_force *f = r->state;
    struct board *b = r->board;
    double *force = board_at(b, ITEM_SUBFORCE, from);
    long first = from * b->over, last = to * b->over;
    (void)e;
    for (long k = first; k < last; k++) {
        struct paper_speeds after = paper_speeds(b, f->beta2, k);
        force[k - first] = paper_force(r, k, &after);
        f->before = after;
    }
    path_integral_lifted(b, first, (int)(last - first));
    return true;
}

static unsigned paper_asks(const struct contact *c, const struct scene *s)
{
    return path_cells_asks(c, s) | (relief_plane(c) ? ITEM_BIT(ITEM_CURVATURE_Y) : 0);
}

const struct stage paper_stage = {
    .name = "paper",
    .does = "contact force as printed, from curvature and slope",
    .paper = "000 eq. 2, 3",
    .idle = "contact.model is neither scrape nor roll, or contact.force is directional",
    .needs = ITEM_BIT(ITEM_POSITION) | ITEM_BIT(ITEM_CURVATURE) | ITEM_BIT(ITEM_SLOPE),
    .takes = ITEM_BIT(ITEM_LOAD),
    .gives = ITEM_BIT(ITEM_SUBFORCE),
    .knobs = KNOB_BIT(oversampling),
    .asks = paper_asks,
    .wanted = paper_wanted,
    .work = paper_force_work,
    .open = paper_open,
    .run = paper_run,
};
