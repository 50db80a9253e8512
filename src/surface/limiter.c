/* Limit of curvature: papers/000 eq. 6, eq. 7 here; T of eq. 4, eq. 5 below, at "cells".

     alpha(N) = (1 - nu) alpha_max + nu alpha_min,   nu = ((N - N_min) / (N_max - N_min))^zeta

   alpha is a length in m (the paper prints 0.05 and 0.01 without a unit; with z'' in 1/m it must be one): curvature is
   limited to 1/alpha. By default N_min and N_max are the scene's own extremes, as in the paper; limiter.force_range
   makes them absolute.

   Departures: the base of the power is held in [0, 1] (rounding makes it -1e-18, and NaN); equal extremes (0/0 in the
   paper) give the alpha for constant loads. */
#include "surface/limiter.h"

#include "num/lanes.h"
#include "num/real.h"
#include "num/vecmath.h"
#include "scene/rows.h"
#include "scene/scene_part.h"
#include "stage.h"
#include "trajectory/contact.h"
#include "trajectory/load.h"

struct limiter_law limiter_make(const struct limiter *given, double least, double most)
{
    bool range = !isnan(given->force_range[0]);
    struct limiter_law l = {.alpha_min = given->alpha_min,
                            .alpha_max = given->alpha_max,
                            .zeta = given->zeta,
                            .fixed = given->alpha,
                            .least = range ? given->force_range[0] : least,
                            .most = range ? given->force_range[1] : most};
    l.varies = l.most - l.least > 1e-12 * fabs(l.most);
    return l;
}

LANES_CLONES
static void limiter_base(const struct limiter_law *l, size_t n, const double *force, double *nu)
{
    double least = l->least, range = l->most - l->least;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double x = (force[i] - least) / range;
        nu[i] = lanes_select(x < 0, 0, lanes_select(x > 1, 1, x));
    }
}

void limiter_alpha(const struct limiter_law *l, size_t n, const double *force, double *alpha)
{
    if (!l->varies) {
        for (size_t i = 0; i < n; i++)
            alpha[i] = l->fixed;
        return;
    }
    limiter_base(l, n, force, alpha);
    vecmath_pow(n, alpha, l->zeta, alpha);
    for (size_t i = 0; i < n; i++)
        alpha[i] = (1 - alpha[i]) * l->alpha_max + alpha[i] * l->alpha_min;
}

double limiter_constant(const struct contact *c)
{
    const struct limiter *given = limiter_of(c);
    double n = load_constant(c), alpha = given->alpha;
    struct limiter_law l = limiter_make(given, n, n);
    if (!isnan(given->force_range[0])) limiter_alpha(&l, 1, &n, &alpha);
    return alpha;
}

void limiter_warn(struct stage_run *r, double least, double most)
{
    const struct limiter *given = limiter_of(r->contact);
    const double *range = given->force_range;
    if (given->curve == LIMITER_TANH && !isnan(range[0]) && (least < range[0] || most > range[1]))
        board_warn(r->board, arena_format(r->arena,
                                          "%s: the normal force, %s N, leaves contact.limiter.force_range, %.4g to "
                                          "%.4g N: alpha stays at that of "
                                          "the range's end there",
                                          r->contact->name,
                                          least == most ? arena_format(r->arena, "%.4g", least)
                                                        : arena_format(r->arena, "%.4g to %.4g", least, most),
                                          range[0], range[1]));
}

/* ------------------------------------------------------------------ limited cells */

/* Limited curvature: T(c) = tanh(alpha c) / alpha.

   Where c is linear, the mean of T over a cell from c0 to c1 is closed form (x = alpha c):

     mean T = [log cosh x1 - log cosh x0] / (alpha (x1 - x0)),   log cosh x = |x| + log(1 + e^(-2|x|)) - log 2

   The two parts of log cosh are subtracted separately: |x1| - |x0| is exact for large x, where the other vanishes. For
   |x1 - x0| < 1e-3 the corrected trapezoid (T0 + T1)/2 - (x1 - x0)^2/12 T'' is used; its error is (x1 - x0)^4 |T''''| /
   720 < 3e-14. Absolute error of alpha mean T in all below 2e-12.

   The first moment about the cell's middle needs J(x) = integral of t tanh t from 0 to x = sgn(x) (x^2/2 - G(|x|)),

     G(x) = pi^2/24 - x w + Li2(-e^(-2x))/2,   w = log(1 + e^(-2x)),   Li2(-e^(-2x)) = sum_k B_k (-w)^(k+1)/(k+1)!
   (Bernoulli numbers)

   again with the parts that cancel taken apart: for x0, x1 of one sign the squares drop out. Below |x1 - x0| = 0.05 the
   moment of the straight line through T0 and T1 is used, (T1 - T0)/12, and the next term of the series, -(x1 -
   x0)^3/720 T''': off by at most 1e-9 / alpha.

   Where c bulges above its chord by 4 b q (1 - q) (q from 0 to 1), the mean gains, to first order in b and by one
   integration by parts, 4 b integral of T'(c) q (1 - q) dq = 8 b moment / (c1 - c0),   or 2/3 b (T' + (x1 - x0)^2/40
   T''') where |x1 - x0| < 0.05. The second order is below 0.22 alpha b^2. Cutting a cell in two quarters b: where
   alpha |b| > 1/64 and tanh is not flat, a cell is halved until neither holds, and its mean and moment are gathered
   from the parts (bisected_add). */
#define INLINE static inline __attribute__((always_inline))

/* At the points: x = alpha c, log(1 + e^(-2|x|)), G(|x|) and 1/alpha. */
struct points {
    double x[LIMITER_POINTS], soft[LIMITER_POINTS], rest[LIMITER_POINTS], per[LIMITER_POINTS];
};

/* rest[] = G(|x[]|) above; w <= log 2, so that the first term left out is below 5e-16. limited[], which was tanh(x),
   becomes T. */
LANES_CLONES
static void points_rest(const struct limiter_cells *p, struct points *q)
{
    double *restrict limited = p->limited;
    int n = p->points;
#pragma omp simd
    for (int k = 0; k < n; k++) {
        double w = q->soft[k], big = lanes_select(w < 0x1p-200, 0, w),
               v = big * big; /* no subnormal squares: they are slow */
        double odd =
            1 +
            v * (1.0 / 36 + v * (-1.0 / 3600 +
                                 v * (1.0 / 211680 + v * (-1.0 / 10886400 +
                                                          v * (1.0 / 526901760 + v * (-691.0 / 16999766784000.0 +
                                                                                      v * (1.0 / 1120863744000.0)))))));
        q->rest[k] = 0.41123351671205660911810 - fabs(q->x[k]) * w - 0.5 * w * odd - 0.125 * v;
        q->per[k] = 1 / p->alpha[k];
        limited[k] *= q->per[k];
    }
}

LANES_CLONES
static void each_cell(const struct limiter_cells *p, const struct points *q)
{
    const double *t = p->limited, *alphas = p->alpha, *x = q->x, *soft = q->soft, *rest = q->rest, *per = q->per;
    double *restrict mean = p->mean, *restrict moment = p->moment;
    const int *at = p->at;
    int n = p->n;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        int a = at[i], b = a + 1;
        double alpha = alphas[a], xa = x[a], xb = x[b], dx = xb - xa, tm = 0.5 * alpha * (t[a] + t[b]),
               faded = soft[b] - soft[a], across = xa * xb;
        int near = fabs(dx) < 1e-3, small = fabs(dx) < 0.05;
        double straight = tm + dx * dx * (1.0 / 6) * tm * (1 - tm * tm),
               far = ((fabs(xb) - fabs(xa)) + faded) / lanes_select(near, 1, dx);
        mean[i] = lanes_select(near, straight, far) * per[a];
        double squares = lanes_select(across < 0, lanes_select(dx < 0, across, -across), 0);
        double whole = squares - (lanes_select(xb < 0, -rest[b], rest[b]) - lanes_select(xa < 0, -rest[a], rest[a])) -
                       0.5 * (xa + xb) * faded;
        double curved = dx * dx * dx * (1.0 / 360) * (1 - tm * tm) * (1 - 3 * tm * tm) * per[a];
        moment[i] =
            lanes_select(small, (t[b] - t[a]) * (1.0 / 12) + curved, whole * per[a] / lanes_select(small, 1, dx * dx));
    }
}

LANES_CLONES
static void each_sagitta(const struct limiter_cells *p)
{
    const double *alphas = p->alpha, *c = p->curvature, *limited = p->limited, *moment = p->moment,
                 *sagitta = p->sagitta;
    double *restrict mean = p->mean;
    const int *at = p->at;
    int n = p->n;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        int a = at[i], b = a + 1;
        double alpha = alphas[a], dc = c[b] - c[a], dx = alpha * dc, tm = 0.5 * alpha * (limited[a] + limited[b]);
        double t = tm + dx * dx / 4 * tm * (1 - tm * tm), rate = (1 - t * t) * (1 - dx * dx / 20 * (1 - 3 * t * t));
        int small = fabs(dx) < 0.05;
        mean[i] += sagitta[i] * lanes_select(small, 2.0 / 3 * rate, 8 * moment[i] / lanes_select(small, 1, dc));
    }
}

static void cells_unlimited(const struct limiter_cells *p)
{
    for (int k = 0; k < p->points; k++)
        p->limited[k] = p->curvature[k];
    for (int i = 0; i < p->n; i++) {
        double t0 = p->limited[p->at[i]], t1 = p->limited[p->at[i] + 1];
        p->mean[i] = 0.5 * (t0 + t1) + (p->sagitta ? 2.0 / 3 * p->sagitta[i] : 0);
        p->moment[i] = (t1 - t0) / 12;
    }
}

static void cells_limited(const struct limiter_cells *p)
{
    struct points q;
    for (int k = 0; k < p->points; k++)
        q.x[k] = p->alpha[k] * p->curvature[k];
    vecmath_tanh_softplus2((size_t)p->points, q.x, p->limited, q.soft);
    points_rest(p, &q);
    each_cell(p, &q);
    if (p->sagitta) each_sagitta(p);
}

/* ------------------------------------------------------------------ bisected */

enum { BISECTED = LIMITER_CELLS };

struct bisected {
    const struct limiter_cells *whole;
    int n, at[BISECTED], cell[BISECTED];
    double alpha[2 * BISECTED], curvature[2 * BISECTED], sagitta[BISECTED], limited[2 * BISECTED], mean[BISECTED],
        moment[BISECTED];
    double from[BISECTED], share[BISECTED]; /* of the cell */
};

/* What is not finite is not halved for ever. */
INLINE int cell_flat(double x0, double x1, double sagitta)
{
    double b = fabs(sagitta), a0 = fabs(x0), a1 = fabs(x1), least = lanes_select(a0 < a1, a0, a1);
    int much = (b > 1.0 / 64) & (b < 1e18), outside = (x0 * x1 > 0) & (least > 8 + b);
    return outside | (much == 0);
}

static void bisected_gather(struct bisected *l)
{
    const struct limiter_cells *w = l->whole;
    cells_limited(&(struct limiter_cells){l->n, 2 * l->n, l->at, l->alpha, l->curvature, l->sagitta, l->limited,
                                          l->mean, l->moment});
    for (int k = 0; k < l->n; k++) {
        double off = l->from[k] + 0.5 * l->share[k] - 0.5;
        w->mean[l->cell[k]] += l->share[k] * l->mean[k];
        w->moment[l->cell[k]] += l->share[k] * (off * l->mean[k] + l->share[k] * l->moment[k]);
    }
    l->n = 0;
}

/* The part of cell i from that share on, with c0 and c1 at its ends. */
static void bisected_add(struct bisected *l, int i, double from, double share, const double c[2])
{
    double alpha = l->whole->alpha[l->whole->at[i]], sagitta = l->whole->sagitta[i] * share * share;
    if (!cell_flat(alpha * c[0], alpha * c[1], alpha * sagitta)) {
        double middle = 0.5 * (c[0] + c[1]) + sagitta;
        bisected_add(l, i, from, 0.5 * share, (double[]){c[0], middle});
        bisected_add(l, i, from + 0.5 * share, 0.5 * share, (double[]){middle, c[1]});
        return;
    }
    if (l->n == BISECTED) bisected_gather(l);
    int k = l->n++;
    l->at[k] = 2 * k;
    l->cell[k] = i;
    l->alpha[2 * k] = l->alpha[2 * k + 1] = alpha;
    l->curvature[2 * k] = c[0];
    l->curvature[2 * k + 1] = c[1];
    l->sagitta[k] = sagitta;
    l->from[k] = from;
    l->share[k] = share;
}

/* flat[i]: is cell i good as it is? Are all? */
LANES_CLONES
static int cells_flat(const struct limiter_cells *p, int *flat)
{
    const double *alphas = p->alpha, *c = p->curvature, *sagitta = p->sagitta;
    const int *at = p->at;
    int n = p->n, all = 1;
#pragma omp simd reduction(& : all)
    for (int i = 0; i < n; i++) {
        double alpha = alphas[at[i]];
        flat[i] = cell_flat(alpha * c[at[i]], alpha * c[at[i] + 1], alpha * sagitta[i]);
        all &= flat[i];
    }
    return all;
}

/* Means and moments of the cells that are not flat, anew from their halves. */
static void cells_bisected(const struct limiter_cells *p)
{
    int flat[LIMITER_CELLS];
    struct bisected l;
    if (cells_flat(p, flat)) return;
    l.whole = p;
    l.n = 0;
    for (int i = 0; i < p->n; i++) {
        const double *c = p->curvature + p->at[i];
        if (flat[i]) continue;
        p->mean[i] = p->moment[i] = 0;
        bisected_add(&l, i, 0, 1, c);
    }
    bisected_gather(&l);
}

void limiter_cells(const struct limiter_cells *p, bool limiter)
{
    if (!limiter) {
        cells_unlimited(p);
        return;
    }
    cells_limited(p);
    if (p->sagitta) cells_bisected(p);
}

/* ------------------------------------------------------------------ the stage */

static void alpha_check(const struct scene_part *p, const struct limiter *l)
{
    if (l->alpha_min > l->alpha_max)
        scene_part_contradiction(p, "contact.limiter.alpha_min", "contact.limiter.alpha_max",
                                 "must not be greater than", "lower alpha_min, or raise alpha_max");
}

/* Defaults stand in every effective scene, so that only another value is one that was meant to do something. */
static void ratio_check(const struct scene_part *p, const struct limiter *l)
{
    const char *path = "contact.limiter.ratio_y", *curve = "contact.limiter.curve";
    if (yaml_find(p->map, path) && l->ratio_y != 1 && scene_part_known(p, curve) && l->curve == LIMITER_NONE &&
        !yaml_find(p->map, "ablation.nonlinearity"))
        diag_add(p->yaml->diag, yaml_find(p->map, path)->key->at, "remove it, or set contact.limiter.curve to tanh",
                 "%s has no effect where %s is none", scene_part_label(p, path), scene_part_label(p, curve));
}

static void limiter_check(const struct scene_part *p, const struct contact *c, const void *own)
{
    (void)c;
    alpha_check(p, own);
    ratio_check(p, own);
}

#define LIMITED "contact.limiter.curve=tanh"

static const struct choice curves[] = {
    [LIMITER_TANH] = {"tanh", "T(c) = tanh(alpha c) / alpha"}, [LIMITER_NONE] = {"none", "T(c) = c"}, {NULL, NULL}};

static const struct key keys[] = {
    {ROW_CHOICE(limiter, curve, "contact.limiter.curve"), KEY_NONE, 0, 0, "tanh", "contact.model=scrape|roll",
     "tanh: curvature is limited to 1/alpha (equations 4, 5); none: the scraper follows the surface exactly", curves},
    {ROW_NUMBER(limiter, alpha, "contact.limiter.alpha"), KEY_LENGTH, 1e-6, 1000, "3 cm", LIMITED,
     "alpha under a constant load, unless force_range is given"},
    {ROW_NUMBER(limiter, alpha_min, "contact.limiter.alpha_min"), KEY_LENGTH, 1e-6, 1000, "1 cm", LIMITED,
     "alpha at the largest normal force"},
    {ROW_NUMBER(limiter, alpha_max, "contact.limiter.alpha_max"), KEY_LENGTH, 1e-6, 1000, "5 cm", LIMITED,
     "alpha at the smallest normal force"},
    {ROW_NUMBER(limiter, ratio_y, "contact.limiter.ratio_y"), KEY_NONE, 0.01, 100, "1", "contact.force=paper",
     "alpha_y over alpha_x: the force of Agarwal et al. (2021) has one alpha for each axis"},
    {ROW_NUMBER(limiter, zeta, "contact.limiter.zeta"), KEY_NONE, 0.01, 100, "0.95", LIMITED, "exponent of equation 7"},
    {ROW_RANGE(limiter, force_range, "contact.limiter.force_range"), KEY_FORCE, 0, 1e5, "", LIMITED,
     "[N_min, N_max] of equation 7, so that scenes compare; forces outside count as its ends, with a warning; left "
     "out: "
     "the scene's own smallest and largest normal force",
     .shown = "[0.2 N, 5 N]"},
    {.path = NULL}};

/* Left out it is as with curve: none, under which the other keys do not apply. */
static void limiter_derive(struct contact *c, void *own)
{
    struct limiter *l = own;
    if (c->ablation.nonlinearity != ABLATED_NONLINEARITY_FULL)
        *l = (struct limiter){.curve = LIMITER_NONE,
                              .alpha = NAN,
                              .alpha_min = NAN,
                              .alpha_max = NAN,
                              .zeta = NAN,
                              .ratio_y = l->ratio_y,
                              .force_range = {NAN, NAN}};
}

static const struct params limiter_params = {
    .section = "contact.limiter",
    .size = sizeof(struct limiter),
    .keys = keys,
    .derive = limiter_derive,
    .check = limiter_check,
    .given = contact_pressed,
};

const struct limiter *limiter_of(const struct contact *c) { return params_of(c, &limiter_params); }

static bool limiter_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return load_varies(c) && limiter_of(c)->curve == LIMITER_TANH;
}

static double limiter_work(const struct contact *c, const struct scene *s)
{
    (void)c;
    return 16 * s->accuracy.oversampling;
}

static bool limiter_open(struct stage_run *r, struct err *e)
{
    const struct limiter *given = limiter_of(r->contact);
    struct limiter_law *l = ARENA_TAKE(r->arena, struct limiter_law, 1);
    (void)e;
    *l = limiter_make(given, r->board->load->least, r->board->load->most);
    r->board->limiter = l;
    limiter_warn(r, r->board->load->least, r->board->load->most);
    return true;
}

static bool limiter_run(struct stage_run *r, long from, long to, struct err *e)
{
    const struct board *b = r->board;
    (void)e;
    limiter_alpha(b->limiter, (size_t)((to - from) * b->over), board_at(b, ITEM_LOAD, from),
                  board_at(b, ITEM_ALPHA, from));
    return true;
}

const struct stage limiter_stage = {
    .name = "limiter",
    .params = &limiter_params,
    .does = "alpha, the limit of curvature, follows the normal force",
    .paper = "000 eq. 6, 7",
    .idle = "alpha is constant (constant load or no limiter)",
    .needs = ITEM_BIT(ITEM_LOAD),
    .gives = ITEM_BIT(ITEM_ALPHA),
    .wanted = limiter_wanted,
    .work = limiter_work,
    .open = limiter_open,
    .run = limiter_run,
};
