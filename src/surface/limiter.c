/* Papers/000 equations 6 and 7:

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
#include "scene/rules.h"
#include "stage.h"
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

LANES_CLONES
static void limiter_blend(const struct limiter_law *l, size_t n, double *alpha)
{
    double alpha_min = l->alpha_min, alpha_max = l->alpha_max;
#pragma omp simd
    for (size_t i = 0; i < n; i++)
        alpha[i] = (1 - alpha[i]) * alpha_max + alpha[i] * alpha_min;
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
    limiter_blend(l, n, alpha);
}

double limiter_constant(const struct contact *c)
{
    const struct limiter *given = &c->contact.limiter;
    double n = rules_load(c), alpha = given->alpha;
    struct limiter_law l = limiter_make(given, n, n);
    if (!isnan(given->force_range[0])) limiter_alpha(&l, 1, &n, &alpha);
    return alpha;
}

void limiter_told(struct stage_run *r, double least, double most)
{
    const double *range = r->contact->contact.limiter.force_range;
    if (r->contact->contact.limiter.curve == LIMITER_TANH && !isnan(range[0]) && (least < range[0] || most > range[1]))
        board_warn(r->board, arena_format(r->arena,
                                          "%s: the normal force, %s N, leaves contact.limiter.force_range, %.4g to "
                                          "%.4g N: alpha stays at that of "
                                          "the range's end there",
                                          r->contact->name,
                                          least == most ? arena_format(r->arena, "%.4g", least)
                                                        : arena_format(r->arena, "%.4g to %.4g", least, most),
                                          range[0], range[1]));
}

/* ------------------------------------------------------------------ the stage */

static bool limiter_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return load_varies(c) && c->contact.limiter.curve == LIMITER_TANH;
}

static double limiter_work(const struct contact *c, const struct scene *s)
{
    (void)c;
    return 16 * s->accuracy.oversampling;
}

static bool limiter_open(struct stage_run *r, struct err *e)
{
    const struct limiter *given = &r->contact->contact.limiter;
    struct limiter_law *l = ARENA_TAKE(r->arena, struct limiter_law, 1);
    (void)e;
    *l = limiter_make(given, r->board->load->least, r->board->load->most);
    r->board->limiter = l;
    limiter_told(r, r->board->load->least, r->board->load->most);
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
