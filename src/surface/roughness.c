/* Procedural roughness, from figures

     P(k) = P0 (max(k, 1/longest))^exponent   for k < 1/shortest, 0 above        one-sided density of a profile, k in
                                              cycles/m
     rms^2 = integral of P dk

   or like a measured map: the table of its density by thirds of an octave, up to its band limit (surface/survey.h), its
   rms, skewness and kurtosis. Waves longer than the table's are given what is missing from the rms, spread evenly.

   Along a line (path, x) it is made of blocks (surface/blocks.h), in the plane of tiles (surface/tiles.h); both are
   Gaussian. Another skewness or kurtosis is given to it by a smooth increasing function of the heights
   (surface/heights.h, which says what that does to the spectrum). */
#include "surface/roughness.h"

#include "file/heightfile.h"
#include "num/real.h"
#include "scene/rules.h"
#include "stage.h"
#include "surface/blocks.h"
#include "surface/heights.h"
#include "surface/patches.h"
#include "surface/reading.h"
#include "surface/survey.h"
#include "surface/tile.h"
#include "surface/tiles.h"

double roughness_density(const struct roughness *r, double k)
{
    double nodes[2] = {1 / r->longest, 1 / r->shortest}, p[2] = {1, real_pow(r->longest / r->shortest, r->exponent)};
    struct spectrum s = {.n = 2, .k = nodes, .p = p, .flat = true};
    spectrum_scale(&s, r->rms);
    return spectrum_at(&s, k);
}

struct profile *roughness_make(struct arena *a, const struct roughness *r, struct noise stream)
{
    struct spectrum s = spectrum_power_law(a, r->exponent, r->longest, r->shortest, r->rms);
    return blocks_make(a, &s, stream);
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
    struct survey_grid g = {h->z, h->columns, h->rows, h->pitch_x};
    if (h->columns < 64)
        return err_set(
            e, ERR_SCENE,
            "%s: %zu samples along a row are too few to take statistics from (at least 64): give a larger map", file,
            h->columns);
    struct survey_moments m = survey_heights(&g);
    if (!(m.rms > 0))
        return err_set(e, ERR_SCENE, "%s: is flat: there is no roughness to take statistics from: give another map",
                       file);
    struct spectrum all = survey_spectrum(a, &g),
                    s = {.k = ARENA_TAKE(a, double, all.n + 1), .p = ARENA_TAKE(a, double, all.n + 1), .flat = true};
    double limit = survey_limit(&all);
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

static bool plan_like(struct shelf *shelf, const struct roughness *r, struct arena *a, struct roughness_plan *p,
                      struct err *e)
{
    static const struct shelf_kind likes = {"statistics of a height map", sizeof(struct roughness_plan), like_make,
                                            false};
    const struct roughness_plan *found =
        shelf_take(shelf, &(struct shelf_ask){&likes, r->like, arena_format(a, "%a", r->like_pitch), r}, a, e);
    if (!found) return false;
    *p = *found;
    p->spectrum.k = copied(a, found->spectrum.k, found->spectrum.n); /* what is made of it may scale it */
    p->spectrum.p = copied(a, found->spectrum.p, found->spectrum.n);
    like_reachable(a, p, r->like);
    return true;
}

bool roughness_plan(struct arena *a, struct shelf *shelf, const struct roughness *r, struct roughness_plan *p,
                    struct err *e)
{
    *p = (struct roughness_plan){.rms = r->rms, .skewness = r->skewness, .kurtosis = r->kurtosis};
    if (r->like) return plan_like(shelf, r, a, p, e);
    if (r->longest <= r->shortest)
        return err_set(e, ERR_SCENE, "surface.roughness: longest (%g m) must be more than shortest (%g m)", r->longest,
                       r->shortest);
    if (r->longest / r->shortest > 1e5)
        return err_set(e, ERR_SCENE, "surface.roughness: longest is more than 100 000 times shortest; lower longest");
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
                                   : profile_part(a, blocks_make(a, &p->spectrum, stream), "roughness", 0);
    if (!part) {
        err_at(e, "surface.roughness");
        return NULL;
    }
    part = gaussian ? part : heights_part(a, part, &h, p->rms);
    part->name = "roughness";
    return part;
}

/* ------------------------------------------------------------------ the stage */

static bool roughness_wanted(const struct contact *c, const struct scene *s)
{
    (void)s;
    return c->surface.roughness.given;
}

static double roughness_octaves(const struct roughness *r)
{
    return r->like ? 9 : 1 + real_log(r->longest / r->shortest) / real_log(2);
}

double roughness_bytes(const struct contact *c)
{
    int bands = c->surface.roughness.given ? (int)roughness_octaves(&c->surface.roughness) : 0;
    return bands > 0 && rules_along(c) == ALONG_PLANE
               ? (double)(patches_bytes(bands, rules_once(c)) + (size_t)bands * TILE_SIDE * TILE_ROW * sizeof(double))
               : 0;
}

/* Measured, in cycles: along a line 8 per point of its spline; in the plane per cell that is crossed, which has its
   coefficients made and is read at some 6 points, less where they are kept; 60 more per point for another distribution
   of heights. What a tip reads in the plane is told with the tip. */
static double roughness_work(const struct contact *c, const struct scene *s)
{
    const struct roughness *r = &c->surface.roughness;
    bool plane = rules_along(c) == ALONG_PLANE, shaped = r->like || r->skewness != 0 || r->kurtosis != 3;
    double finest = reading_roughness(r), points = reading_points(s, finest),
           cells = rules_speed(&c->motion) / (s->output.sample_rate * finest);
    if (plane && !isnan(c->scraper.radius)) return 1;
    return (plane ? (rules_once(c) ? 900 : 700) * cells + 50 * s->accuracy.oversampling : 8 * points) +
           60 * shaped * points;
}

static bool roughness_open(struct stage_run *r, struct err *e)
{
    const struct roughness *recipe = &r->contact->surface.roughness;
    struct noise stream = noise_make(r->scene->seed, arena_format(r->arena, "roughness/%s", r->contact->name));
    struct roughness_plan p;
    relief_settle(r->board->relief, r->contact);
    struct relief_part *part = NULL;
    if (roughness_plan(r->arena, r->scene->shelf, recipe, &p, e)) {
        p.once = rules_once(r->contact);
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

static void roughness_close(struct stage_run *r)
{
    struct relief_part *part = r->state;
    if (part && part->close) part->close(part);
}

const struct stage roughness_stage = {
    .name = "roughness",
    .does = "procedural roughness, random with a given spectrum",
    .paper = "000 sec. 2.2",
    .idle = "no surface.roughness",
    .needs = ITEM_BIT(ITEM_SURFACE),
    .gives = ITEM_BIT(ITEM_SURFACE),
    .wanted = roughness_wanted,
    .work = roughness_work,
    .open = roughness_open,
    .close = roughness_close,
};
