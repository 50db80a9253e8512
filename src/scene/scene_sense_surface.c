/* A surface's values against each other. */
#include <math.h>
#include <string.h>

#include "scene/rules.h"
#include "scene/scene_sense_parts.h"

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

void scene_sense_surface(const struct scene_part *p, const struct contact *c) { continuation_check(p, &c->surface); }
