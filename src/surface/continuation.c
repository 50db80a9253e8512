/* The fractal continuation of a measured map: instruments stop at 11 to 45 cycles/mm, surfaces do not.

     P(k) = P_fit (k/k_fit)^exponent X(k)    from k_c/sqrt 2 up to 1/shortest           X: surface/spectrum.h

   The map's own spectrum (surface/spectrum.h) has a knee, where its instrument begins to lose detail, and a band limit,
   where it has lost 30 dB more. The takeover k_c is the geometric mean of both, unless given. A power law is fitted to
   the map's two octaves below the knee (below k_c/sqrt 2 where k_c is given); it continues beyond, with its exponent
   unless that is given. X takes it in over an octave about k_c, in power; the map itself is left as it is, and loses
   there what it loses: the sum is within 2 dB of the fit about k_c. In the plane X acts on the radial frequency, and
   the traces of what has only radial frequencies above k_c hold some power below it (the map's traces, whose instrument
   cut them likewise, miss just that). */
#include "surface/continuation.h"

#include "num/real.h"
#include "scene/rows.h"
#include "scene/scene_part.h"
#include "stage.h"
#include "surface/relief.h"
#include "surface/roughness.h"
#include "surface/spectrum.h"
#include "surface/tiles.h"
#include "trajectory/motion.h"

/* ------------------------------------------------------------------ parameters */

static const struct key keys[] = {
    {ROW_NUMBER(continuation, exponent, "surface.continuation.exponent"), KEY_NONE, -8, 0, "", NULL,
     "exponent of its spectrum; left out: fitted to the map's two octaves before its band limit", .shown = "-2.4"},
    {ROW_NUMBER(continuation, from, "surface.continuation.from"), KEY_LENGTH, 1e-7, 1e-1, "", NULL,
     "wavelength below which it takes over; left out: the map's band limit, measured", .shown = "50 um"},
    {ROW_NUMBER(continuation, shortest, "surface.continuation.shortest"), KEY_LENGTH, 1e-7, 1e-2, "5 um", NULL,
     "wavelength below which there is no roughness"},
    {.path = NULL}};

/* It takes over half an octave to both sides of `from`. */
static void check(const struct scene_part *p, const struct contact *c, const void *own)
{
    const struct continuation *k = own;
    const char *section = "surface.continuation", *map = "surface.height_map";
    (void)c;
    if (!yaml_find(p->map, map))
        diag_add(p->yaml->diag, yaml_find(p->map, section)->key->at,
                 "give surface.height_map, or write roughness in place of continuation",
                 "%s needs %s, which it continues", scene_part_label(p, section), scene_part_label(p, map));
    if (k->shortest >= sqrt(0.5) * k->from)
        scene_part_contradiction(p, "surface.continuation.shortest", "surface.continuation.from",
                                 "must be less than 0.7 times", "raise from, or lower shortest");
}

static double likely_finest(const void *own) { return ((const struct continuation *)own)->shortest / 4; }

static const struct params continuation_params = {
    .section = "surface.continuation",
    .meaning = "finer roughness than the height map holds: a fractal continuation of its spectrum beyond its band "
               "limit, drawn from the seed",
    .size = sizeof(struct continuation),
    .keys = keys,
    .check = check,
    .ground = &(const struct params_ground){.finest = likely_finest},
};

static const struct continuation *continuation_of(const struct contact *c)
{
    return params_of(c, &continuation_params);
}

/* ------------------------------------------------------------------ its spectrum */

struct takeover {
    double k, fit; /* cycles/m: k_c, and where the fit ends */
};

static struct takeover takeover_of(const struct continuation *c, const struct spectrum *measured)
{
    if (!isnan(c->from)) return (struct takeover){1 / c->from, sqrt(0.5) / c->from};
    double knee = spectrum_knee(measured);
    return (struct takeover){sqrt(knee * spectrum_limit(measured)), knee};
}

bool continuation_spectrum(struct arena *a, const struct continuation *c, const struct height_map *map,
                           struct spectrum *s, struct err *e)
{
    if (map->columns < 64)
        return err_set(e, ERR_SCENE,
                       "surface.continuation: %zu samples along a row are too few to tell a spectrum (at least 64): "
                       "give a larger map, or leave surface.continuation out",
                       map->columns);
    struct spectrum measured =
        spectrum_measured(a, &(struct spectrum_rows){map->z, map->columns, map->rows, map->pitch[0]});
    if (measured.n < 3)
        return err_set(e, ERR_SCENE,
                       "surface.continuation: the map is flat: there is no spectrum to continue: give another map, or "
                       "leave surface.continuation out");
    struct takeover t = takeover_of(c, &measured);
    double density, fitted = spectrum_fit(&measured, t.fit, &density),
                    exponent = isnan(c->exponent) ? fitted : c->exponent, top = 1 / c->shortest;
    if (isnan(fitted))
        return err_set(e, ERR_SCENE,
                       "surface.continuation: the map holds no two octaves below a wavelength of %g m to continue; "
                       "give surface.continuation.from "
                       "(its pitch is %g m)",
                       1 / t.fit, map->pitch[0]);
    if (top <= t.k * sqrt(2))
        return err_set(
            e, ERR_SCENE,
            "surface.continuation: the map reaches down to wavelengths of %g m: shortest (%g m) must be less than %g m",
            1 / t.k, c->shortest, sqrt(0.5) / t.k);
    if (exponent > 0 || exponent < -8)
        return err_set(e, ERR_SCENE,
                       "surface.continuation: the map's spectrum has the exponent %.3g in the two octaves before %g m, "
                       "which is no "
                       "surface's (-8 to 0): give surface.continuation.exponent and from",
                       exponent, 1 / t.fit);
    *s = (struct spectrum){.n = 2, .k = ARENA_TAKE(a, double, 2), .p = ARENA_TAKE(a, double, 2), .takeover = t.k};
    s->k[0] = t.k * sqrt(0.5);
    s->k[1] = top;
    for (int i = 0; i < 2; i++)
        s->p[i] = density * real_pow(s->k[i] / t.fit, exponent);
    return true;
}

/* ------------------------------------------------------------------ the stage */

/* As roughness_work (surface/roughness.c). */
static double continuation_work(const struct contact *c, const struct scene *s)
{
    double finest = likely_finest(continuation_of(c)),
           cells = motion_speed(&c->motion) / (s->output.sample_rate * finest);
    if (c->surface.along != ALONG_PLANE) return 8 * relief_readings(c, s, finest);
    return relief_tipped(c) ? 1 : 800 * cells + 50 * s->accuracy.oversampling;
}

static bool continuation_open(struct stage_run *r, struct err *e)
{
    struct noise stream = noise_make(r->scene->seed, arena_format(r->arena, "continuation/%s", r->contact->name));
    struct relief *relief = r->board->relief;
    struct spectrum s;
    double lost;
    relief_decide(relief, r->contact);
    if (!continuation_spectrum(r->arena, continuation_of(r->contact), r->board->height_map, &s, e))
        return err_at(e, "contact '%s'", r->contact->name);
    struct relief_part *part =
        relief->along == ALONG_PLANE
            ? tiles_part(r->arena, &s, &(struct tiles_grain){1, 0, relief_once(r->contact)}, stream, &lost, e)
            : profile_part(r->arena, roughness_blocks(r->arena, &s, stream), "continuation", 0);
    part->name = "continuation";
    relief_add(relief, part);
    r->state = part;
    return true;
}

const struct stage continuation_stage = {
    .name = "continuation",
    .does = "finer roughness than the map holds, its spectrum continued",
    .paper = "000 sec. 2.2",
    .idle = "no surface.continuation of a height map",
    .params = &continuation_params,
    .needs = ITEM_BIT(ITEM_SURFACE),
    .gives = ITEM_BIT(ITEM_SURFACE),
    .work = continuation_work,
    .open = continuation_open,
    .close = relief_close,
};
