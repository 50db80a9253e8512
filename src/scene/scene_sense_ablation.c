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
    scene_part_refuse(p, path, "contact.model", arena_format(p->yaml->arena, "write %s: %s", path, tool),
                      " is %s, and what touches the surface here is called %s", bodies[word], tool);
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
        scene_part_refuse(p, path, path,
                          arena_format(p->yaml->arena, "give %s.response%s, or leave ablation.sound out", body,
                                       ablation_mutes_surface(c) ? " and a weight above 0" : ""),
                          " is %s, which does not ring: nothing would be heard", body);
}

static void force_check(const struct scene_part *p, const struct contact *c)
{
    const char *path = "ablation.normal_force";
    if (ablation_steady(c) && c->load.recorded)
        scene_part_refuse(p, path, "load.recorded",
                          "give load.constant in place of load.recorded (load: {recorded: null, constant: 1 N})",
                          " is constant, and a recorded force has no mean that is known before its file is read");
}

void scene_sense_ablation(const struct scene_part *p, const struct contact *c)
{
    if (sound_check(p, c)) silence_check(p, c);
    force_check(p, c);
}
