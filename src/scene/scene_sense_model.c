/* What an impact and a given force need, and what has no effect where nothing scrapes or rolls. */
#include <math.h>
#include <string.h>

#include "scene/ball.h"
#include "scene/params.h"
#include "scene/rules.h"
#include "scene/scene_part.h"
#include "scene/scene_sense_parts.h"

static const char *model(const struct contact *c) { return keys_find("contact.model")->choices[c->contact.model].word; }

/* ------------------------------------------------------------------ scrape, and what only a scrape has */

/* A ball that is dropped may bounce at one place; all else that follows a surface has to move. */
static void still_check(const struct scene_part *p, const struct contact *c)
{
    const char *path = "motion.path", *kind = "contact.model";
    bool rolls = c->contact.model == CONTACT_ROLL,
         follows = rolls || c->contact.model == CONTACT_SCRAPE || c->contact.model == CONTACT_PLAYBACK;
    if (c->motion.path == PATH_STILL && scene_part_known(p, path) && follows)
        scene_part_refuse(
            p, path, kind,
            rolls ? "let it move, such as path: line; or set contact.model to roll_coupled, under which a ball "
                    "may bounce on the spot"
                  : "let it move, such as path: line; or set contact.model to strike or given",
            " is still: nothing would %s where %s is %s", c->contact.model == CONTACT_PLAYBACK ? "sound" : model(c),
            scene_part_label(p, kind), model(c));
}

static void idle_refuse(const struct scene_part *p, const struct contact *c, const char *path, bool keys_say_it)
{
    const struct yaml_node *node = yaml_find(p->map, path);
    if (node && (node->n == 0 || !keys_say_it))
        diag_add(p->yaml->diag, node->key->at,
                 "remove it (a null takes away what another file says), or set contact.model to scrape",
                 "%s has no effect where %s is %s", scene_part_label(p, path), scene_part_label(p, "contact.model"),
                 model(c));
}

static void idle_check(const struct scene_part *p, const struct contact *c)
{
    bool reads = ball_rolls(c) || c->contact.model == CONTACT_PLAYBACK;
    const struct params *own;
    idle_refuse(p, c, "grip", true);
    for (int i = 0; !reads && (own = stages_params(i)); i++)
        if (own->ground) idle_refuse(p, c, own->section, false);
}

/* ------------------------------------------------------------------ stiffness */

bool scene_sense_model_unit(const struct yaml_node *node, bool linear)
{
    const char *slash = node && node->kind == YAML_SCALAR ? strchr(node->text, '/') : NULL;
    return slash && (strchr(slash, '.') || strchr(slash, '(')) != !linear;
}

/* Are the moduli of a body known: from its material, or its object's own keys? */
static bool is_elastic(const struct scene_part *p, const char *body, const struct object_given *o)
{
    struct arena *a = p->yaml->arena;
    return o->material != MATERIAL_CUSTOM || !scene_part_known(p, arena_format(a, "%s.material", body)) ||
           (scene_part_given(p, arena_format(a, "%s.object.youngs_modulus", body)) &&
            scene_part_given(p, arena_format(a, "%s.object.poisson", body)));
}

static void moduli_missing(const struct scene_part *p, const char *body, const char *because)
{
    struct arena *a = p->yaml->arena;
    const char *material = arena_format(a, "%s.material", body),
               *object = arena_format(a, "youngs_modulus and poisson of %s.object", body);
    const struct yaml_node *custom = yaml_find(p->map, material);
    if (custom)
        diag_add(p->yaml->diag, custom->at, arena_format(a, "name a material, such as steel, or give %s", object),
                 "%s is custom, and %s are not given: %s", scene_part_label(p, material), object, because);
    else
        scene_part_missing(p, material, "steel", arena_format(a, " (or %s): %s", object, because));
}

/* Hertz's stiffness follows from the moduli of both. */
void scene_sense_model_moduli(const struct scene_part *p, const struct contact *c, const char *because)
{
    const struct object_given *const objects[2] = {&c->surface.response.object, &c->scraper.response.object};
    const char *const bodies[2] = {"surface", ball_tool(c)};
    for (int i = 0; i < 2; i++)
        if (!is_elastic(p, bodies[i], objects[i])) moduli_missing(p, bodies[i], because);
}

void scene_sense_model(const struct scene_part *p, const struct contact *c)
{
    if (!scene_part_known(p, "contact.model")) return;
    still_check(p, c);
    if (c->contact.model != CONTACT_SCRAPE) idle_check(p, c);
    if (ball_rolls(c)) scene_sense_ball(p, c);
}
