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

   Where alpha is constant smoothing is one kernel, and the stage that brings the force to the audio rate joins it to
   its own (force/decimate.c): 4 smoothed sub-samples of which one sample is made cost 4 times as much, and behind a
   low-pass so smooth another one hardly needs its own length.

   Kernels are those of num/filter.h at the sub-rate, also where sigma is less than a sub-sample: a sampled Gaussian has
   no width then, and the force would brighten as sub-samples grow. While sigma varies, every element spreads with its
   own: the parabola in the variance through three kernels of a table, the nearest and one of 3 % more and less variance
   (narrow: of 0.02 more and less). However fast sigma changes, a kernel's spectrum is off by less than (0.03 3/e)^3 /
   (9 sqrt 3) = 2.4e-6, where v omega^2 = 6; a narrow one's by 6e-8 up to 1/6 of the sub-rate, 6e-5 at half of it.

   Nothing comes before the start: what would be spread to there is reflected at it, as heat is at an insulated end.
   Momentum is kept, and what begins at full height stays at full height, where without it it would begin at half. (What
   decimate joins to its kernel it reflects itself, num/filter.h.) */
#include "force/smooth.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "force/scrape.h"
#include "num/filter.h"
#include "num/lanes.h"
#include "num/real.h"
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

/* ------------------------------------------------------------------ kernels that change */

enum { SPREAD_MOST = 64, SPREAD_WIDE = 4 * LANES };

/* Convolutions with a kernel that stays the same, and with one that changes. x is read up to SPREAD_WIDE values
   further; before and behind the taps that change lie SPREAD_WIDE zeros, and sum is read and written up to SPREAD_WIDE
   values further, which stay as they are. */

struct shares { /* of elements, for three kernels */
    double of[3][SPREAD_MOST];
};

/* SPREAD_WIDE outputs at a time: the additions of one wait for each other, those of four
   registers do not. */
LANES_CLONES
void smooth_taps(const double *tap, int taps, const double *x, long n, bool adds, double *y)
{
    for (long i = 0; i < n; i += SPREAD_WIDE) {
        double sum[4][LANES] = {{0}};
        size_t some = (size_t)(n - i < SPREAD_WIDE ? n - i : SPREAD_WIDE);
        if (adds) memcpy(sum, y + i, some * sizeof *y);
        for (int j = 0; j < taps; j++)
#pragma omp simd
            for (int l = 0; l < LANES; l++) {
                const double *at = x + i + j + l;
                double by = tap[j];
                sum[0][l] = fma(by, at[0], sum[0][l]);
                sum[1][l] = fma(by, at[LANES], sum[1][l]);
                sum[2][l] = fma(by, at[2 * LANES], sum[2][l]);
                sum[3][l] = fma(by, at[3 * LANES], sum[3][l]);
            }
        memcpy(y + i, sum, some * sizeof *y);
    }
}

/* sum[t] += sum over kernels j and elements first <= i < last, in turn, of of[j][i] kj[t - i], for SPREAD_WIDE t. */
LANES_CLONES
static void spread_gather(const struct shares *x, const double *const k[3], const int range[2], double *sum)
{
    double s[4][LANES];
    memcpy(s, sum, sizeof s);
    for (int i = range[0]; i < range[1]; i++)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            const double *p = k[0] - i + l, *q = k[1] - i + l, *r = k[2] - i + l;
            double a = x->of[0][i], b = x->of[1][i], c = x->of[2][i];
            s[0][l] += fma(a, p[0], fma(b, q[0], c * r[0]));
            s[1][l] += fma(a, p[LANES], fma(b, q[LANES], c * r[LANES]));
            s[2][l] += fma(a, p[2 * LANES], fma(b, q[2 * LANES], c * r[2 * LANES]));
            s[3][l] += fma(a, p[3 * LANES], fma(b, q[3 * LANES], c * r[3 * LANES]));
        }
    memcpy(sum, s, sizeof s);
}

/* sum[i + t] += of[j][i] kj[t] for n elements i, kernels j of so many taps; by places, whose sums stay in registers,
   not by elements: half the time. */
static void spread(const struct shares *x, int n, double *const kernel[3], int taps, double *sum)
{
    for (int t = 0; t < taps + n - 1; t += SPREAD_WIDE) {
        int range[2] = {t - taps + 1 > 0 ? t - taps + 1 : 0, t + SPREAD_WIDE < n ? t + SPREAD_WIDE : n};
        spread_gather(x, (const double *const[]){kernel[0] + t, kernel[1] + t, kernel[2] + t}, range, sum + t);
    }
}

/* Kernels about the variance `middle`, d more and less; for variances up to `above`. Made when first wanted. */
struct node {
    double middle, d, above;
    int reach;
    double *kernel[3]; /* 2 reach + 1 taps, between SPREAD_WIDE zeros; NULL: not made */
};

static const double step = 0.03, narrow_step = 0.02; /* of the variance; sub-samples^2 */
enum { KERNELS_MOST = 1 << 23 };                     /* values in memory: 64 MiB */

struct smooth {
    enum item item;
    bool varies;
    int reach;              /* of the widest, sub-samples to each side           */
    double per_alpha;       /* sigma in sub-samples per metre of alpha           */
    double length;          /* sigma in sub-samples at 1 m/s; 0: by alpha        */
    double slowest;         /* ... at most, by length                            */
    struct smoothing still; /* the kernel when alpha does not vary               */
    double *raw;            /* unsmoothed values from sub-sample raw_first on    */
    long raw_first, raw_end;
    struct node *node; /* [nodes] by rising variance, each from where the one before ends */
    int nodes, at;     /* at: of the last element */
    struct arena *kernels;
    size_t values;        /* in it */
    double *sum;          /* smoothed so far, from sub-sample sum_first on     */
    long sum_first, next; /* next: the element that is to be spread next */
    size_t room;
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
    return width_of(c)->length > 0 ? ITEM_BIT(ITEM_VELOCITY) : 0;
}

double smooth_still(const struct contact *c)
{
    bool still = smooth_wanted(c, NULL) && !smooth_varies(c);
    return still ? sigma_of(c, smooth_alpha(c, limiter_constant(c))) : 0;
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

static double smooth_work(const struct contact *c, const struct scene *s)
{
    bool varies = smooth_varies(c);
    double over = s->accuracy.oversampling,
           alpha = varies ? limiter_of(c)->alpha_max : smooth_alpha(c, limiter_constant(c));
    double mean = width_of(c)->length / motion_speed(&c->motion), /* s, of a length; at rest it is the slowest */
        sigma = width_of(c)->length > 0 ? (mean < slowest ? mean : slowest) : smooth_width(c) * alpha / 0.03,
           taps = 13 * sigma * s->output.sample_rate * over + 1;
    return taps * over * (varies ? 0.65 : 0.35);
}

/* Where its width is constant, decimate does it. */
static double smooth_force_work(const struct contact *c, const struct scene *s)
{
    return smooth_varies(c) ? smooth_work(c, s) : 1;
}

static bool smooth_too_wide(const struct stage_run *r, double sigma, struct err *e)
{
    return err_set(e, ERR_SCENE,
                   "contact '%s': contact.smoothing: the force is smoothed with a sigma of %.3g s (contact.smoothing x "
                   "alpha / 3 cm), and at most "
                   "%g s make sense; lower contact.smoothing or contact.limiter's alpha",
                   r->contact->name, sigma, WIDEST);
}

/* The table of kernels for variances up to `widest`. */
static void nodes_make(struct smooth *s, double widest, struct arena *a)
{
    double v = 0;
    for (int pass = 0; pass < 2; pass++, v = 0) {
        for (s->nodes = 0; s->nodes == 0 || v < widest; s->nodes++) {
            bool narrow = v < FILTER_NARROW * FILTER_NARROW;
            double d = narrow ? narrow_step : v * step / (1 - step);
            if (pass) s->node[s->nodes] = (struct node){.middle = v + d, .d = d, .above = v + 2 * d};
            v += 2 * d;
        }
        if (!pass) s->node = ARENA_TAKE(a, struct node, s->nodes);
    }
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
    s->varies = b->limiter != NULL || s->length > 0;
    s->per_alpha = ratio * smooth_width(c) / 0.03 * b->rate * b->over;
    double alpha = b->limiter ? fmax(b->limiter->alpha_max, b->limiter->fixed) : smooth_alpha(c, limiter_constant(c)),
           widest = s->length > 0 ? s->slowest : s->per_alpha * alpha;
    if (s->length == 0 && ratio * sigma_of(c, alpha) > WIDEST) return smooth_too_wide(r, ratio * sigma_of(c, alpha), e);
    r->state = s;
    if (s->varies) {
        nodes_make(s, widest * widest, r->arena);
        s->reach = filter_gaussian_reach(sqrt(s->node[s->nodes - 1].above));
        s->kernels = arena_open();
    } else {
        s->still.kernel = filter_gaussian(r->arena, widest);
        s->reach = s->still.kernel.reach;
    }
    r->ahead = (s->reach + 1) / b->over + 3;
    s->room = (size_t)((STAGE_BLOCK + 2 * r->ahead + 4) * b->over + 2 * s->reach);
    if (s->varies)
        s->sum = ARENA_TAKE(r->arena, double, s->room + SPREAD_MOST + SPREAD_WIDE);
    else
        s->raw = ARENA_TAKE(r->arena, double, s->room + SPREAD_WIDE);
    s->raw_first = s->sum_first = -s->reach;
    return true;
}

static bool smooth_open(struct stage_run *r, struct err *e)
{
    if (!smooth_open_item(r, ITEM_SUBFORCE, 1, e)) return false;
    struct smooth *s = r->state;
    if (!s->varies) r->board->smoothing = &s->still;
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

/* Keeps raw values from `from` on and adds those up to `end`. */
static void smooth_take(struct smooth *s, const struct board *b, long from, long end)
{
    if (from > s->raw_first) {
        memmove(s->raw, s->raw + (from - s->raw_first), (size_t)(s->raw_end - from) * sizeof *s->raw);
        s->raw_first = from;
    }
    const double *x = board_at(b, s->item, s->raw_end / b->over);
    memcpy(s->raw + (s->raw_end - s->raw_first), x, (size_t)(end - s->raw_end) * sizeof *s->raw);
    s->raw_end = end;
}

/* With what kernels the node spreads. */
static void node_make(struct smooth *s, struct node *n)
{
    n->reach = filter_gaussian_reach(sqrt(n->above));
    size_t room = (size_t)(2 * n->reach + 1 + 2 * SPREAD_WIDE);
    s->values += 3 * room;
    if (s->values > KERNELS_MOST && s->values > 3 * room) { /* all anew */
        arena_close(s->kernels);
        s->kernels = arena_open();
        for (int k = 0; k < s->nodes; k++)
            s->node[k].kernel[0] = NULL;
        s->values = 3 * room;
    }
    struct arena *a = arena_open();
    for (int k = 0; k < 3; k++) {
        struct filter f = filter_gaussian(a, sqrt(fmax(n->middle + (k - 1) * n->d, 0)));
        n->kernel[k] = ARENA_TAKE(s->kernels, double, room) + SPREAD_WIDE;
        memcpy(n->kernel[k] + n->reach - f.reach, f.tap, (size_t)f.taps * sizeof *f.tap);
    }
    arena_close(a);
}

/* Spreads the elements below sub-sample `end`. */
static void smooth_elements(struct smooth *s, const struct board *b, long end)
{
    bool by_speed = s->length > 0, means = s->item == ITEM_SUBFORCE && !b->bspline;
    const double *x = board_at(b, s->item, s->next / b->over) + s->next % b->over,
                 *width = board_at(b, by_speed ? ITEM_VELOCITY : ITEM_ALPHA, s->next / b->over) + s->next % b->over;
    while (s->next < end) {
        struct shares shares;
        struct node *n = NULL;
        int count = 0;
        for (; count < SPREAD_MOST && s->next + count < end; count++) {
            double w = means ? 0.5 * (width[count] + width[count + 1]) : width[count],
                   sigma = by_speed ? fmin(s->length / fmax(fabs(w), DBL_MIN), s->slowest) : s->per_alpha * w,
                   variance = sigma * sigma;
            while (variance > s->node[s->at].above && s->at < s->nodes - 1)
                s->at++;
            while (s->at > 0 && variance <= s->node[s->at - 1].above)
                s->at--;
            if (n && n != &s->node[s->at]) break;
            n = &s->node[s->at];
            double u = (variance - n->middle) / n->d;
            shares.of[0][count] = 0.5 * u * (u - 1) * x[count];
            shares.of[1][count] = (1 - u * u) * x[count];
            shares.of[2][count] = 0.5 * u * (u + 1) * x[count];
        }
        if (!n->kernel[0]) node_make(s, n);
        spread(&shares, count, n->kernel, 2 * n->reach + 1, s->sum + (s->next - n->reach - s->sum_first));
        s->next += count;
        x += count;
        width += count;
    }
}

/* Hands over the finished sums of [first, end) and makes room behind them. */
static void smooth_hand_over(struct smooth *s, double *y, long first, long end)
{
    size_t used = (size_t)(end - s->sum_first), whole = s->room + SPREAD_MOST;
    memcpy(y, s->sum + (first - s->sum_first), (size_t)(end - first) * sizeof *y);
    memmove(s->sum, s->sum + used, (whole - used) * sizeof *y);
    memset(s->sum + (whole - used), 0, used * sizeof *y);
    s->sum_first = end;
}

static bool smooth_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct smooth *s = r->state;
    const struct board *b = r->board;
    long first = from * b->over, end = to * b->over;
    double *y = board_at(b, s->item, from);
    (void)e;
    if (s->still.taken) return true;
    if (!s->varies) {
        smooth_take(s, b, first - s->reach, (to + r->ahead - 1) * b->over);
        for (int i = 0; first == 0 && i < s->reach; i++)
            s->raw[s->reach - 1 - i] = s->raw[s->reach + i];
        smooth_taps(s->still.kernel.tap, s->still.kernel.taps, s->raw + (first - s->reach - s->raw_first), end - first,
                    false, y);
        return true;
    }
    smooth_elements(s, b, end + s->reach);
    for (int i = 0; first == 0 && i < s->reach; i++) /* what was spread to before 0 */
        s->sum[s->reach + i] += s->sum[s->reach - 1 - i];
    smooth_hand_over(s, y, first, end);
    return true;
}

/* As at the start, from that frame on. */
static void smooth_skip(struct stage_run *r, long frame)
{
    struct smooth *s = r->state;
    long first = frame * r->board->over;
    if (s->varies)
        memset(s->sum, 0, (s->room + SPREAD_MOST) * sizeof *s->sum);
    else
        memset(s->raw, 0, s->room * sizeof *s->raw);
    s->raw_first = s->sum_first = first - s->reach;
    s->raw_end = s->next = first;
}

static void smooth_close(struct stage_run *r)
{
    const struct smooth *s = r->state;
    if (s && s->kernels) arena_close(s->kernels);
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
    .takes = ITEM_BIT(ITEM_ALPHA),
    .asks = smooth_asks,
    .gives = ITEM_BIT(ITEM_SUBFORCE),
    .spreads = true,
    .knobs = KNOB_BIT(oversampling),
    .wanted = smooth_wanted,
    .work = smooth_force_work,
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
    .takes = ITEM_BIT(ITEM_ALPHA),
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
    .takes = ITEM_BIT(ITEM_ALPHA),
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
