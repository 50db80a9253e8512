/* A surface's values against each other. */
#include <math.h>
#include <string.h>

#include "scene/rules.h"
#include "scene/scene_sense_parts.h"

static void band_check(const struct scene_part *p, const struct roughness *r)
{
    static const char *const waves[2] = {"surface.roughness.shortest", "surface.roughness.longest"};
    if (isnan(r->longest) || isnan(r->shortest)) return;
    if (!rules_has_band(r))
        scene_part_contradiction(p, waves, "must be less than", "raise longest, or lower shortest");
    else if (!rules_band_fits(r))
        diag_add(p->yaml->diag, scene_part_later(p, waves[0], waves[1]), "lower longest, or raise shortest",
                 "%s is %.3g times %s, and at most 100 000 times are offered", scene_part_label(p, waves[1]),
                 r->longest / r->shortest, scene_part_label(p, waves[0]));
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

static void grain_check(const struct scene_part *p, const struct surface *s)
{
    const char *grain = "surface.roughness.grain", *along = "surface.along";
    if (s->roughness.grain != 1 && !isnan(s->roughness.grain) && scene_part_known(p, along) &&
        (s->along == ALONG_PATH || s->along == ALONG_X))
        diag_add(p->yaml->diag, scene_part_later(p, grain, along),
                 arena_format(p->yaml->arena, "set %s to plane, or remove the grain", along),
                 "%s: a profile has no grain: it needs %s: plane", scene_part_label(p, grain), along);
}

static void roughness_check(const struct scene_part *p, const struct surface *s)
{
    if (!s->roughness.given) return;
    band_check(p, &s->roughness);
    moments_check(p, &s->roughness);
    grain_check(p, s);
}

static void continuation_check(const struct scene_part *p, const struct surface *s)
{
    static const char *const waves[2] = {"surface.continuation.shortest", "surface.continuation.from"};
    const struct yaml_node *node = yaml_find(p->map, "surface.continuation");
    if (!s->continuation.given) return;
    if (!yaml_find(p->map, "surface.height_map"))
        diag_add(p->yaml->diag, node->key->at, "give surface.height_map, or write roughness in place of continuation",
                 "%s needs %s, which it continues", scene_part_label(p, "surface.continuation"),
                 scene_part_label(p, "surface.height_map"));
    if (s->continuation.shortest >=
        sqrt(0.5) * s->continuation.from) /* it takes over half an octave to both sides of `from` */
        scene_part_contradiction(p, waves, "must be less than 0.7 times", "raise from, or lower shortest");
}

void scene_sense_surface(const struct scene_part *p, const struct contact *c)
{
    roughness_check(p, &c->surface);
    continuation_check(p, &c->surface);
}
