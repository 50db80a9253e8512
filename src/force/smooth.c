/* Gaussian smoothing, papers/000 section 2.2, last paragraph: the limiter's harmonics are removed by "a Gaussian moving
   average following the non-linearity", its width in proportion to alpha.

     sigma(t) = contact.smoothing alpha(t) / 0.03 m        s

   or, of an average over the contact's patch, by its speed: what goes faster is smoothed less,

     sigma(t) = contact.smoothing_length / |v(t)|, 1 ms at most     s

   (papers/000 has no such thing; at a constant width in seconds a light scrape gets duller the faster it goes.)

   Directional force: each element of force spreads with its own sigma, y(t) = integral f(t') G(t - t'; sigma(t')) dt',
   so that momentum is kept. Paper: the same on each limited curvature, sigma in proportion to its own alpha. The
   paper's "average half window size of 5 samples at a sampling rate of 44.1kHz" is read as an 11-sample window of 5
   sigma: 50 us; in seconds here, so that the sound does not depend on the sample rate.

   The stage that brings the force to the audio rate joins the smoothing to its own kernel (force/decimate.c): 4
   smoothed sub-samples of which one sample is made cost 4 times as much, and behind a low-pass so smooth another one
   hardly needs its own length. Here it is done where something else is made of it: of limited curvatures.

   Kernels are those of num/filter.h at the sub-rate, also where sigma is less than a sub-sample: a sampled Gaussian has
   no width then, and the force would brighten as sub-samples grow. While sigma varies, every element spreads with its
   own (num/spread.h).

   Nothing comes before the start: what would be spread to there is reflected at it, as heat is at an insulated end.
   Momentum is kept, and what begins at full height stays at full height, where without it it would begin at half. */
#include "force/smooth.h"

#include <float.h>
#include <math.h>

#include "force/scrape.h"
#include "num/filter.h"
#include "num/real.h"
#include "num/spread.h"
#include "scene/rows.h"
#include "scene/scene_part.h"
#include "stage.h"
#include "surface/limiter.h"
#include "surface/relief.h"
#include "trajectory/contact.h"
#include "trajectory/load.h"
#include "trajectory/motion.h"

#define WIDEST 0.1 /* s: a wider sigma leaves nothing to hear, and its kernels cost minutes per second of sound */

/* ------------------------------------------------------------------ parameters */

struct smooth_width {
    double sigma;  /* s at alpha = 0.03 m; 0: none */
    double length; /* m, in place of it; 0: not given */
};

static const double slowest = 1e-3; /* s, of a length */

static const struct key keys[] = {
    {ROW_NUMBER(smooth_width, sigma, "contact.smoothing"), KEY_TIME, 0, 0.01, "50 us", "contact.model=scrape|roll",
     "standard deviation of the Gaussian smoothing at alpha = 3 cm, in proportion to alpha; 0: none"},
    {ROW_NUMBER(smooth_width, length, "contact.smoothing_length"), KEY_LENGTH, 0, 1e-3, "0",
     "contact.model=scrape|roll",
     "standard deviation of the Gaussian smoothing along the way, in place of contact.smoothing: an average over the "
     "contact's patch, which takes less time the faster it goes (1 ms at most); 0: contact.smoothing counts"},
    {.path = NULL}};

/* m: without a limiter the width is that of 3 cm. */
static double smooth_alpha(const struct contact *c, double alpha)
{
    return limiter_of(c)->curve == LIMITER_TANH ? alpha : 0.03;
}

#define NARROWEST 1e-9 /* s: far below a sample, and kernels of it would underflow */

/* The largest alpha there can be along x: that of the force under a constant load. */
static double alpha_along_x(const struct contact *c)
{
    const struct limiter *l = limiter_of(c);
    double n = load_constant(c);
    if (!contact_steady(c) && (c->grip.given || c->load.recorded || (contact_rolls(c) && c->ball.offset > 0)))
        return fmax(l->alpha_max, l->alpha);
    if (isnan(l->force_range[0])) return l->alpha;
    double share = (n - l->force_range[0]) / (l->force_range[1] - l->force_range[0]);
    double nu = real_pow(share < 0 ? 0 : share > 1 ? 1 : share, l->zeta);
    return (1 - nu) * l->alpha_max + nu * l->alpha_min;
}

static double alpha_widest(const struct contact *c)
{
    return alpha_along_x(c) * fmax(1, limiter_of(c)->ratio_y); /* NAN: not the paper's force */
}

/* Reported at the smoothing if it is given, else at the alpha that makes it wide. */
static void smooth_check(const struct scene_part *p, const struct contact *c, const void *own)
{
    const char *path = "contact.smoothing";
    const struct smooth_width *w = own;
    double width = w->sigma;
    if (w->length > 0) return; /* which then counts */
    double sigma = width * smooth_alpha(c, alpha_widest(c)) / 0.03;
    if (width > 0 && width < NARROWEST)
        scene_part_refuse(p, path, path, "0 turns it off; or write for instance: smoothing: 50 us",
                          " must be 0 or at least 1 ns");
    if (sigma > WIDEST)
        diag_add(p->yaml->diag,
                 yaml_find(p->map, path) ? scene_part_later(p, path, path)
                                         : scene_part_later(p, "contact.limiter.alpha", "contact.limiter.alpha_max"),
                 "lower contact.smoothing or the alpha of contact.limiter; smoothing: 0 turns it off",
                 "%s smooths the force with a sigma of %.3g s (smoothing x alpha / 3 cm), and at most %g s make sense",
                 scene_part_label(p, path), sigma, WIDEST);
}

/* Left out with the limiter, after which the paper has it, against the harmonics that the non-linearity makes. */
static void smooth_derive(struct contact *c, void *own)
{
    if (c->ablation.nonlinearity == ABLATED_NONLINEARITY_OMITTED)
        *(struct smooth_width *)own = (struct smooth_width){0, 0};
}

static const struct params smooth_params = {
    .section = "contact.smoothing",
    .size = sizeof(struct smooth_width),
    .keys = keys,
    .derive = smooth_derive,
    .check = smooth_check,
    .given = contact_pressed,
};

static const struct smooth_width *width_of(const struct contact *c) { return params_of(c, &smooth_params); }

static double smooth_width(const struct contact *c) { return width_of(c)->sigma; }

static bool smooths(const struct contact *c) { return width_of(c)->sigma > 0 || width_of(c)->length > 0; }

/* s, standard deviation for an alpha in m. */
static double sigma_of(const struct contact *c, double alpha)
{
    return smooth_width(c) * smooth_alpha(c, alpha) / 0.03;
}

/* ------------------------------------------------------------------ the stages */

struct smooth {
    enum item item;
    bool varies;
    double per_alpha;       /* sigma in sub-samples per metre of alpha           */
    double length;          /* sigma in sub-samples at 1 m/s; 0: by alpha        */
    double slowest;         /* ... at most, by length                            */
    double widest;          /* variance, sub-samples^2                           */
    struct smoothing board; /* what the board shows of it                        */
    struct spread *spread;  /* made when first wanted                            */
    int reach;              /* of it                                             */
    long next;              /* the element that it gets next                     */
};

static bool smooth_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return contact_pressed(c) && smooths(c) && scrape_law(c)->force == FORCE_DIRECTIONAL;
}

static bool smooth_varies(const struct contact *c)
{
    return width_of(c)->length > 0 || (load_varies(c) && limiter_of(c)->curve == LIMITER_TANH);
}

static unsigned smooth_asks(const struct contact *c, const struct scene *s)
{
    (void)s;
    return !smooth_varies(c) ? 0 : width_of(c)->length > 0 ? ITEM_BIT(ITEM_VELOCITY) : ITEM_BIT(ITEM_ALPHA);
}

unsigned smooth_joined_asks(const struct contact *c, const struct scene *s)
{
    return smooth_wanted(c, s) ? smooth_asks(c, s) : 0;
}

static bool smooth_curvature_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return contact_pressed(c) && smooths(c) && scrape_law(c)->force == FORCE_PAPER;
}

static bool smooth_curvature_y_wanted(const struct contact *c, const struct scene *s)
{
    return smooth_curvature_wanted(c, s) && relief_plane(c);
}

static double smooth_widest(const struct contact *c)
{
    double mean = width_of(c)->length / motion_speed(&c->motion); /* s, of a length; at rest it is the slowest */
    if (width_of(c)->length > 0) return mean < slowest ? mean : slowest;
    return sigma_of(c, smooth_varies(c) ? limiter_of(c)->alpha_max : smooth_alpha(c, limiter_constant(c)));
}

static double smooth_work(const struct contact *c, const struct scene *s)
{
    double over = s->accuracy.oversampling, taps = 13 * smooth_widest(c) * s->output.sample_rate * over + 1;
    return over * (smooth_varies(c) ? 22 + 0.2 * taps : 0.35 * taps);
}

double smooth_sigma(const struct contact *c, bool *varies)
{
    *varies = smooth_varies(c);
    return smooth_wanted(c, NULL) ? smooth_widest(c) : 0;
}

static bool smooth_too_wide(const struct stage_run *r, double sigma, struct err *e)
{
    return err_set(e, ERR_SCENE,
                   "contact '%s': contact.smoothing: the force is smoothed with a sigma of %.3g s (contact.smoothing x "
                   "alpha / 3 cm), and at most "
                   "%g s make sense; lower contact.smoothing or contact.limiter's alpha",
                   r->contact->name, sigma, WIDEST);
}

int smooth_join(struct smooth *s, const struct filter *then, int each, long outputs, struct arena *a)
{
    s->reach = spread_reach(s->widest, then, each);
    s->spread = spread_open(a, s->widest, !s->varies, then, each, outputs);
    return s->reach;
}

/* ratio: sigma over that of the first axis. */
static bool smooth_open_item(struct stage_run *r, enum item item, double ratio, struct err *e)
{
    struct smooth *s = ARENA_TAKE(r->arena, struct smooth, 1);
    struct board *b = r->board;
    const struct contact *c = r->contact;
    s->item = item;
    s->length = width_of(c)->length * b->rate * b->over;
    s->slowest = slowest * b->rate * b->over;
    s->varies = smooth_varies(c);
    s->per_alpha = ratio * smooth_width(c) / 0.03 * b->rate * b->over;
    double alpha = b->limiter ? fmax(b->limiter->alpha_max, b->limiter->fixed) : smooth_alpha(c, limiter_constant(c)),
           widest = s->length > 0 ? s->slowest : s->per_alpha * alpha;
    if (s->length == 0 && ratio * sigma_of(c, alpha) > WIDEST) return smooth_too_wide(r, ratio * sigma_of(c, alpha), e);
    r->state = s;
    s->widest = widest * widest;
    if (s->varies)
        s->board.varying = s;
    else
        s->board.kernel = filter_gaussian(r->arena, widest);
    r->ahead = spread_reach(s->widest, NULL, 1) / b->over + 1;
    return true;
}

static bool smooth_open(struct stage_run *r, struct err *e)
{
    if (!smooth_open_item(r, ITEM_SUBFORCE, 1, e)) return false;
    r->board->smoothing = &((struct smooth *)r->state)->board;
    return true;
}

static bool smooth_curvature_open(struct stage_run *r, struct err *e)
{
    return smooth_open_item(r, ITEM_CURVATURE, 1, e);
}

static bool smooth_curvature_y_open(struct stage_run *r, struct err *e)
{
    return smooth_open_item(r, ITEM_CURVATURE_Y, limiter_of(r->contact)->ratio_y, e);
}

/* Values of n elements from the next on. */
static const double *smooth_next(const struct smooth *s, const struct board *b, enum item item)
{
    return board_at(b, item, s->next / b->over) + s->next % b->over;
}

/* Their variances, sub-samples^2. */
static void smooth_variances(const struct smooth *s, const struct board *b, long n, double *variance)
{
    const double *w = s->varies ? smooth_next(s, b, s->length > 0 ? ITEM_VELOCITY : ITEM_ALPHA) : NULL;
    for (long i = 0; i < n; i++) {
        double sigma = !w              ? 0
                       : s->length > 0 ? fmin(s->length / fmax(fabs(w[i]), DBL_MIN), s->slowest)
                                       : s->per_alpha * w[i];
        variance[i] = w ? sigma * sigma : s->widest;
    }
}

void smooth_spread(struct smooth *s, const struct board *b, long to, long outputs, double *y)
{
    double variance[STAGE_BLOCK];
    for (long n, end = to * b->over + s->reach; s->next < end; s->next += n) {
        n = end - s->next < STAGE_BLOCK ? end - s->next : STAGE_BLOCK;
        smooth_variances(s, b, n, variance);
        spread_add(s->spread, smooth_next(s, b, s->item), variance, n);
    }
    spread_take(s->spread, y, outputs);
}

static bool smooth_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct smooth *s = r->state;
    const struct board *b = r->board;
    (void)e;
    if (s->board.taken) return true;
    if (!s->spread) smooth_join(s, NULL, 1, STAGE_BLOCK * b->over, r->arena);
    smooth_spread(s, b, to, (to - from) * b->over, board_at(b, s->item, from));
    return true;
}

/* As at the start, from that frame on. */
static void smooth_skip(struct stage_run *r, long frame)
{
    struct smooth *s = r->state;
    if (s->spread) spread_restart(s->spread);
    s->next = frame * r->board->over;
}

static void smooth_close(struct stage_run *r)
{
    const struct smooth *s = r->state;
    if (s && s->spread) spread_close(s->spread);
}

/* A surface that turned out to have one axis has no second curvature: it stays 0. */
static bool smooth_curvature_y_run(struct stage_run *r, long from, long to, struct err *e)
{
    return r->board->relief->along != ALONG_PLANE || smooth_run(r, from, to, e);
}

const struct stage smooth_stage = {
    .name = "smooth",
    .params = &smooth_params,
    .does = "Gaussian smoothing of the force, sigma in proportion to alpha",
    .paper = "000 sec. 2.2",
    .idle = "contact.model is neither scrape nor roll, contact.smoothing is 0, or contact.force is paper",
    .needs = ITEM_BIT(ITEM_SUBFORCE),
    .asks = smooth_asks,
    .gives = ITEM_BIT(ITEM_SUBFORCE),
    .spreads = true,
    .knobs = KNOB_BIT(oversampling),
    .wanted = smooth_wanted,
    .cycles = 1, /* decimate does it */
    .open = smooth_open,
    .run = smooth_run,
    .skip = smooth_skip,
    .close = smooth_close,
};

const struct stage smooth_curvature_stage = {
    .name = "smooth_curvature",
    .does = "Gaussian smoothing of the limited curvature",
    .paper = "000 sec. 2.2",
    .idle = "contact.model is neither scrape nor roll, contact.smoothing is 0, or contact.force is directional",
    .needs = ITEM_BIT(ITEM_CURVATURE),
    .asks = smooth_asks,
    .gives = ITEM_BIT(ITEM_CURVATURE),
    .spreads = true,
    .knobs = KNOB_BIT(oversampling),
    .wanted = smooth_curvature_wanted,
    .work = smooth_work,
    .open = smooth_curvature_open,
    .run = smooth_run,
    .skip = smooth_skip,
    .close = smooth_close,
};

const struct stage smooth_curvature_y_stage = {
    .name = "smooth_curvature_y",
    .does = "Gaussian smoothing of the limited curvature's second axis",
    .paper = "000 sec. 2.2",
    .idle = "contact.model is neither scrape nor roll, contact.smoothing is 0, contact.force is directional, or the "
            "surface has one axis",
    .needs = ITEM_BIT(ITEM_CURVATURE_Y),
    .asks = smooth_asks,
    .gives = ITEM_BIT(ITEM_CURVATURE_Y),
    .spreads = true,
    .knobs = KNOB_BIT(oversampling),
    .wanted = smooth_curvature_y_wanted,
    .work = smooth_work,
    .open = smooth_curvature_y_open,
    .run = smooth_curvature_y_run,
    .skip = smooth_skip,
    .close = smooth_close,
};
