/* What can be left out of a contact, and what cannot. */
#include <string.h>

#include "scene/ablation.h"
#include "scene/rules.h"
#include "scene/scene_sense_parts.h"

/* Is the body called as this model calls it? */
static bool sound_check(const struct scene_part *p, const struct contact *c)
{
    static const char *const bodies[2] = {"scraper", "ball"};
    const char *path = "ablation.sound", *tool = ball_tool(c);
    int word = c->ablation.sound - ABLATED_SOUND_SCRAPER;
    if (word < 0 || !scene_part_known(p, "contact.model") || !strcmp(bodies[word], tool)) return true;
    diag_add(p->yaml->diag, scene_part_later(p, path, "contact.model"),
             arena_format(p->yaml->arena, "write %s: %s", path, tool),
             "%s is %s, and what touches the surface here is called %s", scene_part_label(p, path), bodies[word], tool);
    return false;
}

static bool lacks_sound(const struct contact *c)
{
    bool surface = rules_responds(&c->surface.response),
         tool = rules_responds(&c->scraper.response) && c->scraper.weight != 0;
    return (surface || tool) && !rules_rings(c);
}

static void silence_check(const struct scene_part *p, const struct contact *c)
{
    const char *path = "ablation.sound", *body = ablation_mutes_surface(c) ? ball_tool(c) : "surface";
    if (lacks_sound(c) && scene_part_known(p, path))
        diag_add(p->yaml->diag, scene_part_later(p, path, path),
                 arena_format(p->yaml->arena, "give %s.response%s, or leave ablation.sound out", body,
                              ablation_mutes_surface(c) ? " and a weight above 0" : ""),
                 "%s is %s, which does not ring: nothing would be heard", scene_part_label(p, path), body);
}

static void force_check(const struct scene_part *p, const struct contact *c)
{
    const char *path = "ablation.normal_force";
    if (ablation_steady(c) && c->load.recorded)
        diag_add(p->yaml->diag, scene_part_later(p, path, "load.recorded"),
                 "give load.constant in place of load.recorded (load: {recorded: null, constant: 1 N})",
                 "%s is constant, and a recorded force has no mean that is known before its file is read",
                 scene_part_label(p, path));
}

void scene_sense_ablation(const struct scene_part *p, const struct contact *c)
{
    if (sound_check(p, c)) silence_check(p, c);
    force_check(p, c);
}
