/* Procedural roughness, from figures

     P(k) = P0 (max(k, 1/longest))^exponent   for k < 1/shortest, 0 above        one-sided density of a profile, k in
                                              cycles/m
     rms^2 = integral of P dk

   or like a measured map: the table of its density by thirds of an octave, up to its band limit (surface/spectrum.h),
   its rms, skewness and kurtosis. Waves longer than the table's are given what is missing from the rms, spread evenly.

   Along a line (path, x) it is made of blocks, in the plane of tiles (surface/tiles.h); both are
   Gaussian. Another skewness or kurtosis is given to it by a smooth increasing function of the heights
   (surface/heights.h, which says what that does to the spectrum). */
#include "surface/roughness.h"

#include <math.h>
#include <string.h>

#include "base/stopwatch.h"
#include "file/heightfile.h"
#include "num/fft.h"
#include "num/real.h"
#include "num/vecmath.h"
#include "scene/rows.h"
#include "scene/scene_part.h"
#include "stage.h"
#include "surface/block_cache.h"
#include "surface/heights.h"
#include "surface/relief.h"
#include "surface/spectrum.h"
#include "surface/tiles.h"
#include "trajectory/motion.h"

#define BAND_WIDEST 1e5 /* longest over shortest wavelength */

/* ------------------------------------------------------------------ parameters */

#define OWN "!surface.roughness.like"

static const struct key keys[] = {
    {ROW_NUMBER(roughness, exponent, "surface.roughness.exponent"), KEY_NONE, -8, 2, "-2.4", OWN,
     "slope of a profile's power spectral density over spatial frequency, between the two cut-off wavelengths"},
    {ROW_NUMBER(roughness, rms, "surface.roughness.rms"), KEY_LENGTH, 1e-10, 1e-3, "4 um", OWN,
     "root-mean-square height"},
    {ROW_NUMBER(roughness, longest, "surface.roughness.longest"), KEY_LENGTH, 1e-5, 1, "2 mm", OWN,
     "wavelength above which the spectrum is flat"},
    {ROW_NUMBER(roughness, shortest, "surface.roughness.shortest"), KEY_LENGTH, 1e-7, 1e-2, "20 um", OWN,
     "wavelength below which there is no roughness"},
    {ROW_NUMBER(roughness, skewness, "surface.roughness.skewness"), KEY_NONE, -3, 3, "0", OWN,
     "skewness of the height distribution: below 0 a plateau with valleys, above 0 a ground with peaks"},
    {ROW_NUMBER(roughness, kurtosis, "surface.roughness.kurtosis"), KEY_NONE, 1.8, 30, "3", OWN,
     "kurtosis of the height distribution; 3 is Gaussian"},
    {ROW_NUMBER(roughness, grain, "surface.roughness.grain"), KEY_NONE, 1, 100, "1", NULL,
     "how many times longer features are along the grain than across it; 1: isotropic"},
    {ROW_NUMBER(roughness, grain_direction, "surface.roughness.grain_direction"), KEY_ANGLE, -6.2832, 6.2832, "0 deg",
     NULL, "direction of the grain, 0 is +x"},
    {ROW_FILE(roughness, like, "surface.roughness.like"), KEY_NONE, 0, 0, "", NULL,
     "height map whose statistics (spectrum, rms, skewness, kurtosis) the roughness takes, in place of those above",
     .example = "map.gsf", .shown = "plank.gsf"},
    {ROW_NUMBER(roughness, like_pitch, "surface.roughness.like_pitch"), KEY_LENGTH, 1e-8, 1e-3, "",
     "surface.roughness.like", "distance between two of its samples, where the file does not hold it", .shown = "5 um"},
    {.path = NULL}};

static void band_check(const struct scene_part *p, const struct roughness *r)
{
    const char *shortest = "surface.roughness.shortest", *longest = "surface.roughness.longest";
    if (r->longest <= r->shortest)
        scene_part_contradiction(p, shortest, longest, "must be less than", "raise longest, or lower shortest");
    else if (r->longest / r->shortest > BAND_WIDEST)
        scene_part_refuse(p, longest, shortest, "lower longest, or raise shortest",
                          " is %.3g times %s, and at most 100 000 times are offered", r->longest / r->shortest,
                          scene_part_label(p, shortest));
}

/* (E x^3)^2 <= E x^2 E (x^2 - 1)^2 for x of mean 0 and variance 1: no distribution lies beyond, and none that is
 * continuous on it. */
static void moments_check(const struct scene_part *p, const struct roughness *r)
{
    const char *skewness = "surface.roughness.skewness", *kurtosis = "surface.roughness.kurtosis";
    double least = r->skewness * r->skewness + 1;
    if (r->kurtosis <= least)
        diag_add(p->yaml->diag, scene_part_later(p, skewness, kurtosis),
                 arena_format(p->yaml->arena, "raise %s, or bring %s nearer to 0", kurtosis, skewness),
                 "%s: no heights have a skewness of %.4g and a kurtosis of %.4g: it is above skewness^2 + 1, %.4g",
                 scene_part_label(p, "surface.roughness"), r->skewness, r->kurtosis, least);
}

static void check(const struct scene_part *p, const struct contact *c, const void *own)
{
    const struct roughness *r = own;
    const char *grain = "surface.roughness.grain", *along = "surface.along";
    band_check(p, r);
    moments_check(p, r);
    if (r->grain > 1 && scene_part_known(p, along) && (c->surface.along == ALONG_PATH || c->surface.along == ALONG_X))
        scene_part_refuse(p, grain, along, arena_format(p->yaml->arena, "set %s to plane, or remove the grain", along),
                          ": a profile has no grain: it needs %s: plane", along);
}

static int directed(const void *own) { return ((const struct roughness *)own)->grain != 1; }

/* A quarter of the shortest wave. Roughness like a map has the map's waves, and so its pitch. */
static double likely_finest(const void *own)
{
    const struct roughness *r = own;
    return !r->like ? r->shortest / 4 : isnan(r->like_pitch) ? RELIEF_MAP_PITCH : r->like_pitch;
}

static double likely_span(const void *own)
{
    const struct roughness *r = own;
    return r->like ? RELIEF_MAP_SPAN : 8 * r->rms;
}

static const struct params roughness_params = {
    .section = "surface.roughness",
    .meaning = "procedural roughness: endless, aperiodic, drawn from the seed",
    .size = sizeof(struct roughness),
    .keys = keys,
    .check = check,
    .ground = &(const struct params_ground){.directed = directed, .finest = likely_finest, .span = likely_span},
    .shown = true,
};

static const struct roughness *roughness_of(const struct contact *c) { return params_of(c, &roughness_params); }

double roughness_scale(const struct contact *c)
{
    return roughness_of(c)->given ? likely_finest(roughness_of(c)) : NAN;
}

/* ------------------------------------------------------------------ along a line */

/* Random profiles: the "depth maps synthesized from statistics" that papers/000 section 2.2 plans.

   The heights are independent blocks of N samples at a pitch of 1/(4 k1), k1 the highest frequency of the density P:
   each a random spectrum of P (Gaussian real and imaginary parts from the counter (block, line)) brought to space by an
   inverse FFT; successive blocks overlap by half under the window w(i) = sin(pi/2 sin^2(pi (i + 1/2) / N)), whose
   squares add to 1, so that the mean square height is the same everywhere. A block spans at least 8 times the longest
   wavelength. Any place can be read without the places before it; nothing repeats (2^64 blocks). The window convolves
   the spectrum with its own, 1.4 lines wide, which is the only departure from P in the mean. It begins and ends with a
   slope of 0: a window with a corner (sin) puts a kink into the profile at every half block, and at exponent -8 400
   times P into the last octave.

   What is drawn are the spline's coefficients: line j is divided by the response (2 + cos(2 pi j / N)) / 3 of reading a
   spline at its knots, so that the heights at the knots have P. */

/* Blocks are cached as long as they fit into BLOCKS_BYTES: strokes back and forth read the same ones again, and making
 * one costs what 20 000 frames of reading do. */
enum { BLOCKS_LEAST = 4, BLOCKS_MOST = 64, BLOCKS_BYTES = 1 << 19 };

struct blocks {
    long n;                  /* samples of a block, even */
    double *window, *spread; /* [n], [n/2+1]: window; standard deviation of a line's real and imaginary part */
    struct fft *fft;
    struct noise stream;
    struct block_cache *cache;
    double *re, *im, *normal;
};

/* Line j of 1/(n pitch) cycles/m carries what P holds within half a line of it, so that all lines together have rms^2:
   line 0 in one number, the others in two, each of which has a quarter of the power in the sum (re + i im) e^(i..) +
   conjugate. */
static void blocks_spread(struct blocks *g, const struct spectrum *s, double pitch)
{
    double dk = 1 / ((double)g->n * pitch);
    for (long j = 0; j < g->n / 2; j++)
        g->re[j] = 2 * (double)j / (double)g->n;
    vecmath_sincospi((size_t)g->n / 2, g->re, g->im, g->re);
    for (long j = 0; j < g->n / 2; j++) {
        double power = spectrum_power(s, ((double)j - 0.5) * dk, ((double)j + 0.5) * dk), spline = (2 + g->re[j]) / 3;
        g->spread[j] = sqrt(power / (j == 0 ? 1 : 4)) / spline;
    }
}

static void blocks_window(struct blocks *g)
{
    double *w = g->window;
    for (long i = 0; i < g->n; i++)
        w[i] = ((double)i + 0.5) / (double)g->n;
    vecmath_sincospi((size_t)g->n, w, w, g->normal);
    for (long i = 0; i < g->n; i++)
        w[i] *= 0.5 * w[i];
    vecmath_sincospi((size_t)g->n, w, w, g->normal);
}

static void blocks_fill(void *self, long index, long row, double *c)
{
    const struct blocks *g = self;
    (void)row;
    stopwatch_spend(90 * (double)g->n);
    noise_normal(g->stream, (uint64_t)index, (size_t)g->n, g->normal);
    for (long j = 0; j < g->n / 2; j++) {
        g->re[j] = g->normal[2 * j] * g->spread[j];
        g->im[j] = g->normal[2 * j + 1] * g->spread[j];
    }
    g->im[0] = g->re[g->n / 2] = g->im[g->n / 2] = 0;
    fft_inverse(g->fft, g->re, g->im, c);
    for (long i = 0; i < g->n; i++)
        c[i] *= g->window[i];
}

/* Coefficient i is the sum of blocks b = floor(i / half) and b - 1, block b beginning at b half. */
static void blocks_read(struct profile *p, long first, long n, double *c)
{
    struct blocks *g = p->state;
    long half = g->n / 2;
    while (n > 0) {
        long b = block_cache_index(first, half), from = first - b * half;
        long some = half - from < n ? half - from : n;
        const double *new = block_cache_at(g->cache, b, 0) + from,
                     *old = block_cache_at(g->cache, b - 1, 0) + half + from;
        for (long i = 0; i < some; i++)
            c[i] = new[i] + old[i];
        c += some;
        first += some;
        n -= some;
    }
}

static void blocks_close(struct profile *p)
{
    struct blocks *g = p->state;
    fft_close(g->fft);
}

struct profile *roughness_blocks(struct arena *a, const struct spectrum *s, struct noise stream)
{
    struct profile *p = ARENA_TAKE(a, struct profile, 1);
    struct blocks *g = ARENA_TAKE(a, struct blocks, 1);
    double pitch = 0.25 / spectrum_top(s), span = 8 / fmax(spectrum_bottom(s), s->k[0]) / pitch;
    long n = (long)fft_good_size((size_t)(span < 4096 ? 4096 : span));
    long cached = BLOCKS_BYTES / (n * (long)sizeof(double));
    *g = (struct blocks){.n = n,
                         .stream = stream,
                         .fft = fft_open((size_t)n),
                         .window = ARENA_TAKE(a, double, n),
                         .spread = ARENA_TAKE(a, double, n / 2 + 1),
                         .re = ARENA_TAKE(a, double, n / 2 + 1),
                         .im = ARENA_TAKE(a, double, n / 2 + 1),
                         .normal = ARENA_TAKE(a, double, n)};
    cached = cached < BLOCKS_LEAST ? BLOCKS_LEAST : cached > BLOCKS_MOST ? BLOCKS_MOST : cached;
    g->cache = block_cache_make(a, (size_t)n, (size_t)cached, blocks_fill, g);
    blocks_window(g);
    blocks_spread(g, s, pitch);
    stopwatch_spend(120 * (double)n);
    *p = (struct profile){
        .pitch = pitch, .from = -HUGE_VAL, .to = HUGE_VAL, .read = blocks_read, .state = g, .close = blocks_close};
    return p;
}

/* ------------------------------------------------------------------ like a map */

/* A node below the first one that takes up what the rms has beyond the table; or, if the table has more, the table
 * scaled. */
static void like_long_waves(struct spectrum *s, double rms)
{
    double known = spectrum_power(s, s->k[0], spectrum_top(s)), rest = rms * rms - known;
    if (rest <= s->p[0] * s->k[0]) {
        spectrum_scale(s, rms);
        return;
    }
    for (int i = s->n++; i > 0; i--) {
        s->k[i] = s->k[i - 1];
        s->p[i] = s->p[i - 1];
    }
    s->k[0] *= 0.99;
    s->p[0] = rest / s->k[0];
    spectrum_scale(s, rms);
}

static bool like_spectrum(struct arena *a, const struct heightfile *h, struct roughness_plan *p, const char *file,
                          struct err *e)
{
    struct spectrum_rows g = {h->z, h->columns, h->rows, h->pitch_x};
    if (h->columns < 64)
        return err_set(
            e, ERR_SCENE,
            "%s: %zu samples along a row are too few to take statistics from (at least 64): give a larger map", file,
            h->columns);
    struct spectrum_moments m = spectrum_moments(&g);
    if (!(m.rms > 0))
        return err_set(e, ERR_SCENE, "%s: is flat: there is no roughness to take statistics from: give another map",
                       file);
    struct spectrum all = spectrum_measured(a, &g),
                    s = {.k = ARENA_TAKE(a, double, all.n + 1), .p = ARENA_TAKE(a, double, all.n + 1), .flat = true};
    double limit = spectrum_limit(&all);
    for (; s.n < all.n && all.k[s.n] <= limit * (1 + 1e-9); s.n++) {
        s.k[s.n] = all.k[s.n];
        s.p[s.n] = all.p[s.n];
    }
    if (s.n < 3)
        return err_set(e, ERR_SCENE,
                       "%s: its spectrum cannot be told: fewer than three thirds of an octave hold anything: give a "
                       "larger or finer map",
                       file);
    like_long_waves(&s, m.rms);
    p->spectrum = s;
    p->rms = m.rms, p->skewness = m.skewness, p->kurtosis = m.kurtosis;
    return true;
}

/* The nearest skewness (of the key's range) and kurtosis that can be had, with a remark. */
static void like_reachable(struct arena *a, struct roughness_plan *p, const char *file)
{
    double range[2], skewness = p->skewness, kurtosis = p->kurtosis;
    p->skewness = fmin(fmax(skewness, -3), 3);
    heights_range(p->skewness, range);
    p->kurtosis = fmin(fmax(kurtosis, range[0]), range[1]);
    if (p->skewness != skewness || p->kurtosis != kurtosis)
        p->remark = arena_format(a,
                                 "surface.roughness.like: heights with the skewness %.3g and kurtosis %.3g of %s "
                                 "cannot be made: they are %.3g and "
                                 "%.3g here",
                                 skewness, kurtosis, file, p->skewness, p->kurtosis);
}

/* What the map is like, of its own pitch and heights. */
static bool like_make(const char *file, const void *how, struct arena *a, void *thing, struct err *e)
{
    const struct roughness *r = how;
    struct heightfile_options o = {
        .pitch = r->like_pitch, .height_scale = NAN, .height_range = NAN, .holes = HEIGHTFILE_FILL};
    static const struct heightfile_names names = {"surface.roughness.like_pitch", "a file whose heights are in metres",
                                                  "another format", "a file without holes"};
    struct heightfile h;
    o.names = &names;
    *(struct roughness_plan *)thing = (struct roughness_plan){0};
    struct roughness_plan *p = thing;
    if (!heightfile_load(file, &o, a, &h, e) || !like_spectrum(a, &h, p, file, e)) return false;
    p->n_doubts = heightfile_warnings(&h, &names, a, p->doubts);
    return true;
}

static double *copied(struct arena *a, const double *x, int n)
{
    return memcpy(ARENA_TAKE(a, double, n), x, (size_t)n * sizeof *x);
}

static bool plan_like(struct file_cache *file_cache, const struct roughness *r, struct arena *a,
                      struct roughness_plan *p, struct err *e)
{
    static const struct file_cache_kind likes = {"statistics of a height map", sizeof(struct roughness_plan), like_make,
                                                 false};
    const struct roughness_plan *found = file_cache_take(
        file_cache, &(struct file_cache_ask){&likes, r->like, arena_format(a, "%a", r->like_pitch), r}, a, e);
    if (!found) return false;
    *p = *found;
    p->spectrum.k = copied(a, found->spectrum.k, found->spectrum.n); /* what is made of it may scale it */
    p->spectrum.p = copied(a, found->spectrum.p, found->spectrum.n);
    like_reachable(a, p, r->like);
    return true;
}

bool roughness_plan(struct arena *a, struct file_cache *file_cache, const struct roughness *r, struct roughness_plan *p,
                    struct err *e)
{
    *p = (struct roughness_plan){.rms = r->rms, .skewness = r->skewness, .kurtosis = r->kurtosis};
    if (r->like) return plan_like(file_cache, r, a, p, e);
    p->spectrum = spectrum_power_law(a, r->exponent, r->longest, r->shortest, r->rms);
    return true;
}

/* ------------------------------------------------------------------ the part */

static struct relief_part *gaussian_part(struct arena *a, struct roughness_plan *p, const struct roughness *r,
                                         struct noise stream, struct err *e)
{
    double lost = 0;
    struct relief_part *part = tiles_part(a, &p->spectrum, &(struct tiles_grain){r->grain, r->grain_direction, p->once},
                                          stream, r->like ? &lost : NULL, e);
    if (lost > 1e-3)
        p->remark = arena_format(a,
                                 "%s%ssurface.roughness.like: no surface in the plane has the spectrum of %s along "
                                 "every line; %.2g %% of its power "
                                 "was moved",
                                 p->remark ? p->remark : "", p->remark ? "; " : "", r->like, 100 * lost);
    return part;
}

struct relief_part *roughness_part(struct arena *a, struct roughness_plan *p, const struct roughness *r, int along,
                                   struct noise stream, struct err *e)
{
    bool gaussian = p->skewness == 0 && p->kurtosis == 3;
    struct heights h;
    if (!gaussian && !heights_make(p->skewness, p->kurtosis, &h, e)) {
        err_at(e, "surface.roughness");
        return NULL;
    }
    if (!gaussian) spectrum_scale(&p->spectrum, 1);
    struct relief_part *part = along == ALONG_PLANE
                                   ? gaussian_part(a, p, r, stream, e)
                                   : profile_part(a, roughness_blocks(a, &p->spectrum, stream), "roughness", 0);
    if (!part) {
        err_at(e, "surface.roughness");
        return NULL;
    }
    part = gaussian ? part : heights_part(a, part, &h, p->rms);
    part->name = "roughness";
    return part;
}

/* ------------------------------------------------------------------ the stage */

static double roughness_octaves(const struct roughness *r)
{
    return r->like ? 9 : 1 + real_log(r->longest / r->shortest) / real_log(2);
}

double roughness_bytes(const struct contact *c)
{
    const struct roughness *r = roughness_of(c);
    int bands = r->given ? (int)roughness_octaves(r) : 0;
    return bands > 0 && relief_along(c) == ALONG_PLANE
               ? (double)(tiles_bytes(bands, relief_once(c)) + (size_t)bands * TILE_SIDE * TILE_ROW * sizeof(double))
               : 0;
}

/* Measured, in cycles: along a line 8 per point of its spline; in the plane per cell that is crossed, which has its
   coefficients made and is read at some 6 points, less where they are kept; 60 more per point for another distribution
   of heights. What a tip reads in the plane is reported with the tip. */
static double roughness_work(const struct contact *c, const struct scene *s)
{
    const struct roughness *r = roughness_of(c);
    bool plane = relief_along(c) == ALONG_PLANE, shaped = r->like || r->skewness != 0 || r->kurtosis != 3;
    double finest = likely_finest(r), points = relief_readings(c, s, finest),
           cells = motion_speed(&c->motion) / (s->output.sample_rate * finest);
    if (plane && relief_tipped(c)) return 1;
    return (plane ? (relief_once(c) ? 900 : 700) * cells + 50 * s->accuracy.oversampling : 8 * points) +
           60 * shaped * points;
}

static bool roughness_open(struct stage_run *r, struct err *e)
{
    const struct roughness *recipe = roughness_of(r->contact);
    struct noise stream = noise_make(r->scene->seed, arena_format(r->arena, "roughness/%s", r->contact->name));
    struct roughness_plan p;
    relief_decide(r->board->relief, r->contact);
    struct relief_part *part = NULL;
    if (roughness_plan(r->arena, r->scene->file_cache, recipe, &p, e)) {
        p.once = relief_once(r->contact);
        part = roughness_part(r->arena, &p, recipe, r->board->relief->along, stream, e);
    }
    if (!part) return err_at(e, "contact '%s'", r->contact->name);
    if (p.remark) board_warn(r->board, p.remark);
    for (int k = 0; k < p.n_doubts; k++)
        board_warn(r->board, arena_format(r->arena, "%s: %s", recipe->like, p.doubts[k]));
    relief_add(r->board->relief, part);
    r->state = part;
    return true;
}

const struct stage roughness_stage = {
    .name = "roughness",
    .does = "procedural roughness, random with a given spectrum",
    .paper = "000 sec. 2.2",
    .idle = "no surface.roughness",
    .params = &roughness_params,
    .needs = ITEM_BIT(ITEM_SURFACE),
    .gives = ITEM_BIT(ITEM_SURFACE),
    .work = roughness_work,
    .open = roughness_open,
    .close = relief_close,
};
