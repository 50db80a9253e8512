/* Procedural roughness, the "depth maps synthesized from statistics" that papers/000 section 2.2 plans.

     P(k) = P0 (max(k, 1/longest))^exponent   for k < 1/shortest, 0 above        one-sided density, k in cycles/m
     rms^2 = integral of P dk

   The heights are independent blocks of N samples at a pitch of shortest / 4, each a random spectrum of P (Gaussian real and imaginary
   parts from the counter (block, line)) brought to space by an inverse FFT; successive blocks overlap by half under the window
   w(i) = sin(pi/2 sin^2(pi (i + 1/2) / N)), whose squares add to 1, so that the mean square height is the same everywhere. A block spans at
   least 8 times the longest wavelength. Any place can be read without the places before it; nothing repeats (2^64 blocks). The window
   convolves the spectrum with its own, 1.4 lines wide, which is the only departure from P in the mean. It begins and ends with a slope of 0:
   a window with a corner (sin) puts a kink into the profile at every half block, and at exponent -8 400 times P into the last octave.

   What is drawn are the spline's coefficients: line j is divided by the response (2 + cos(2 pi j / N)) / 3 of reading a spline at its
   knots, so that the heights at the knots have P. */
#include "surface/roughness.h"

#include <stdlib.h>

#include "num/fft.h"
#include "num/real.h"
#include "stage.h"

enum { ROUGHNESS_KEPT = 4 };

struct block {
    long index;
    bool filled;
    double *c;
};

struct rough {
    long n;                 /* samples of a block, even */
    double *window, *spread;/* [n], [n/2+1]: window; standard deviation of a line's real and imaginary part */
    struct fft *fft;
    struct noise stream;
    struct block blocks[ROUGHNESS_KEPT]; /* block b lies in slot b mod ROUGHNESS_KEPT */
    double *re, *im, *normal;
};

/* Integral of (max(k, k0) / k0)^exponent from `from` to `to`, k0 = 1/longest. */
static double roughness_shape(const struct roughness *r, double from, double to)
{
    double k0 = 1 / r->longest, a = r->exponent + 1, flat = fmin(to, k0) - fmin(from, k0);
    double x0 = fmax(from / k0, 1), x1 = fmax(to / k0, 1);
    return flat + k0 * (fabs(a) < 1e-9 ? real_log(x1 / x0) : (real_pow(x1, a) - real_pow(x0, a)) / a);
}

double roughness_density(const struct roughness *r, double k)
{
    double k0 = 1 / r->longest, k1 = 1 / r->shortest, p0 = r->rms * r->rms / roughness_shape(r, 0, k1);
    return k >= k1 ? 0 : k <= k0 ? p0 : p0 * real_pow(k / k0, r->exponent);
}

/* Line j of 1/(n pitch) cycles/m carries what P holds within half a line of it, so that all lines together have rms^2: line 0 in one number,
   the others in two, each of which has a quarter of the power in the sum (re + i im) e^(i..) + conjugate. */
static void rough_spread(struct rough *g, const struct roughness *recipe, double pitch)
{
    double dk = 1 / ((double)g->n * pitch), k1 = 1 / recipe->shortest, p0 = roughness_density(recipe, 0);
    for (long j = 0; j < g->n / 2; j++) {
        double from = fmax(((double)j - 0.5) * dk, 0), to = fmin(((double)j + 0.5) * dk, k1);
        double spline = (2 + real_cospi(2 * (double)j / (double)g->n)) / 3;
        if (from < to)
            g->spread[j] = sqrt(p0 * roughness_shape(recipe, from, to) / (j == 0 ? 1 : 4)) / spline;
    }
}

static void block_fill(struct rough *g, struct block *b, long index)
{
    noise_normal(g->stream, (uint64_t)index, (size_t)g->n, g->normal);
    for (long j = 0; j < g->n / 2; j++) {
        g->re[j] = g->normal[2 * j] * g->spread[j];
        g->im[j] = g->normal[2 * j + 1] * g->spread[j];
    }
    g->im[0] = g->re[g->n / 2] = g->im[g->n / 2] = 0;
    fft_inverse(g->fft, g->re, g->im, b->c);
    for (long i = 0; i < g->n; i++)
        b->c[i] *= g->window[i];
    b->index = index;
    b->filled = true;
}

static const double *block_at(struct rough *g, long index)
{
    struct block *b = &g->blocks[((index % ROUGHNESS_KEPT) + ROUGHNESS_KEPT) % ROUGHNESS_KEPT];
    if (!b->filled || b->index != index)
        block_fill(g, b, index);
    return b->c;
}

/* Coefficient i is the sum of blocks b = floor(i / half) and b - 1, block b beginning at b half. */
static void roughness_read(struct profile *p, long first, long n, double *c)
{
    struct rough *g = p->state;
    long half = g->n / 2;
    while (n > 0) {
        long b = first >= 0 ? first / half : -((-first + half - 1) / half), from = first - b * half;
        long some = half - from < n ? half - from : n;
        const double *new = block_at(g, b) + from, *old = block_at(g, b - 1) + half + from;
        for (long i = 0; i < some; i++)
            c[i] = new[i] + old[i];
        c += some;
        first += some;
        n -= some;
    }
}

static void roughness_close(struct profile *p)
{
    struct rough *g = p->state;
    fft_close(g->fft);
}

static double roughness_window(double share)
{
    double s = real_sinpi(share);
    return real_sinpi(s * s / 2);
}

struct profile *roughness_make(struct arena *a, const struct roughness *recipe, struct noise stream)
{
    struct profile *p = ARENA_TAKE(a, struct profile, 1);
    struct rough *g = ARENA_TAKE(a, struct rough, 1);
    double pitch = recipe->shortest / 4, span = 8 * recipe->longest / pitch;
    long n = (long)fft_good_size((size_t)(span < 4096 ? 4096 : span));
    *g = (struct rough){.n = n, .stream = stream, .fft = fft_open((size_t)n), .window = ARENA_TAKE(a, double, n),
                        .spread = ARENA_TAKE(a, double, n / 2 + 1), .re = ARENA_TAKE(a, double, n / 2 + 1),
                        .im = ARENA_TAKE(a, double, n / 2 + 1), .normal = ARENA_TAKE(a, double, n)};
    for (int k = 0; k < ROUGHNESS_KEPT; k++)
        g->blocks[k].c = ARENA_TAKE(a, double, n);
    for (long i = 0; i < n; i++)
        g->window[i] = roughness_window(((double)i + 0.5) / (double)n);
    rough_spread(g, recipe, pitch);
    *p = (struct profile){.pitch = pitch, .from = -HUGE_VAL, .to = HUGE_VAL, .read = roughness_read, .state = g, .close = roughness_close};
    return p;
}

/* ------------------------------------------------------------------ the stage */

static bool roughness_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->surface.roughness.given;
}

static double roughness_work(const struct contact *c, const struct scene *s)
{
    (void)c, (void)s;
    return 40;
}

static bool roughness_open(struct stage_run *r, struct err *e)
{
    const struct roughness *recipe = &r->contact->surface.roughness;
    if (recipe->longest <= recipe->shortest)
        return err_set(e, ERR_SCENE, "contact '%s': surface.roughness: longest (%g m) must be more than shortest (%g m)", r->contact->name,
                       recipe->longest, recipe->shortest);
    if (recipe->longest / recipe->shortest > 1e5)
        return err_set(e, ERR_SCENE, "contact '%s': surface.roughness: longest is more than 100 000 times shortest; lower longest",
                       r->contact->name);
    char *stream = arena_format(r->arena, "roughness/%s", r->contact->name);
    r->board->profile = roughness_make(r->arena, recipe, noise_make(r->scene->seed, stream));
    return true;
}

static void roughness_stage_close(struct stage_run *r)
{
    if (r->board->profile)
        r->board->profile->close(r->board->profile);
}

const struct stage roughness_stage = {
    .name = "roughness",
    .does = "procedural profile with a power-law spectrum",
    .paper = "000 sec. 2.2",
    .idle = "no surface.roughness",
    .gives = ITEM_BIT(ITEM_SURFACE),
    .wanted = roughness_wanted,
    .work = roughness_work,
    .open = roughness_open,
    .close = roughness_stage_close,
};
