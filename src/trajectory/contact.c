/* Mass and moment of inertia of what rolls, R its outer radius, h the wall's thickness, q = (R - h) / R:

     solid ball    m = 4/3 pi R^3 rho              I = 2/5 m R^2
     hollow ball   m = 4/3 pi R^3 (1 - q^3) rho    I = 2/5 m R^2 (1 - q^5) / (1 - q^3), 2/3 m R^2 of a thin wall
     hoop          m given                         I = m R^2
     wheel         m given                         I = 1/2 m R^2 */
#include "trajectory/contact.h"

#include <math.h>
#include <string.h>

#include "num/real.h"
#include "scene/keys.h"
#include "scene/material.h"
#include "scene/params.h"
#include "scene/scene_part.h"

static double density(const struct object_given *o)
{
    const struct material *m = material_given(o);
    return !isnan(o->density) || !m ? o->density : m->density;
}

/* (1 - q^n) for q = 1 - w: the sum w (1 + q + q^2 + ...), which keeps its digits for thin walls. */
static double shell(double w, int n)
{
    double q = 1 - w, sum = 0, power = 1;
    for (int i = 0; i < n; i++, power *= q)
        sum += power;
    return w * sum;
}

/* kg; NAN where it is neither given nor follows from radius, wall and the material's (or object's) density. */
static double ball_mass(const struct ball *b)
{
    double filled = b->body == BODY_SOLID                           ? 1
                    : b->body == BODY_HOLLOW && b->wall < b->radius ? shell(b->wall / b->radius, 3)
                                                                    : NAN;
    if (!isnan(b->mass)) return b->mass;
    return 4.0 / 3 * REAL_PI * b->radius * b->radius * b->radius * filled * density(&b->response.object);
}

/* I / (m R^2) of the body; of what slides, 0. */
static double ball_inertia(const struct contact *c)
{
    const struct ball *b = &c->ball;
    if (!contact_rolls(c)) return 0;
    switch (b->body) {
    case BODY_SOLID:
        return 2.0 / 5;
    case BODY_HOLLOW:
        return isnan(b->wall) ? 2.0 / 3 : 2.0 / 5 * shell(b->wall / b->radius, 5) / shell(b->wall / b->radius, 3);
    case BODY_HOOP:
        return 1;
    default:
        return 1.0 / 2;
    }
}

double contact_gravity(const struct contact *c)
{
    return c->motion.path == PATH_INCLINE ? c->contact.gravity * real_cospi(c->motion.incline / REAL_PI)
                                          : c->contact.gravity;
}

/* ------------------------------------------------------------------ what is left out */

const char *contact_ablation(const struct contact *c, struct arena *a)
{
    const struct ablation *b = &c->ablation;
    const struct {
        const char *key;
        int value;
    } all[] = {{"normal_force", b->normal_force},
               {"nonlinearity", b->nonlinearity},
               {"response", b->response},
               {"sound", b->sound}};
    const char *text = NULL;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        const struct key *k = keys_find(arena_format(a, "ablation.%s", all[i].key));
        if (all[i].value != 0)
            text = arena_format(a, "%s%s%s: %s", text ? text : "", text ? ", " : "", all[i].key,
                                k->choices[all[i].value].word);
    }
    return text;
}

void contact_derive(struct contact *c, void *own)
{
    const struct ball *b = &c->ball;
    (void)own;
    c->motion.gravity = c->contact.gravity;
    c->motion.inertia = ball_inertia(c);
    if (contact_rolls(c))
        c->scraper = (struct scraper){
            .mass = ball_mass(b), .weight = b->weight, .radius = b->radius, .patch = b->patch, .response = b->response};
}

/* ------------------------------------------------------------------ sizes and mass of a ball */

/* What the mass lacks, with an example of the cure; NULL: it is not the mass. */
static const char *mass_lacks(const struct scene_part *p, const struct ball *b)
{
    bool of_material = material_given(&b->response.object) || !isnan(b->response.object.density);
    if (b->body == BODY_HOOP || b->body == BODY_WHEEL)
        return ": what a hoop or a wheel weighs does not follow from its radius";
    if (b->body == BODY_HOLLOW && !scene_part_given(p, "ball.wall"))
        return ": it is hollow; or give ball.wall and ball.material, from which it follows";
    return of_material ? NULL
                       : ": it is not known what the ball is made of; ball.material, such as glass, would do as well";
}

static void ball_check(const struct scene_part *p, const struct ball *b)
{
    const struct {
        const char *path;
        double size;
    } below[] = {{"ball.offset", b->offset},
                 {"ball.wall", b->wall},
                 {"ball.patch", b->patch},
                 {"ball.lobe_height", b->lobe_height}};
    const char *lacks = mass_lacks(p, b);
    for (size_t i = 0; i < sizeof below / sizeof *below; i++)
        if (below[i].size >= b->radius)
            scene_part_contradiction(p, below[i].path, "ball.radius", "must be less than",
                                     arena_format(p->yaml->arena, "lower %s, or raise ball.radius", below[i].path));
    if (isnan(ball_mass(b)) && lacks && scene_part_known(p, "ball.body") && scene_part_known(p, "ball.material"))
        scene_part_missing(p, "ball.mass", "11 g", lacks);
}

/* ------------------------------------------------------------------ what the model has */

static const char *model(const struct contact *c) { return keys_find("contact.model")->choices[c->contact.model].word; }

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
    bool reads = contact_rolls(c) || c->contact.model == CONTACT_PLAYBACK;
    const struct params *own;
    idle_refuse(p, c, "grip", true);
    for (int i = 0; !reads && (own = stages_params(i)); i++)
        if (own->ground) idle_refuse(p, c, own->section, false);
}

static void contact_check(const struct scene_part *p, const struct contact *c, const void *own)
{
    (void)own;
    if (contact_steady(c) && c->load.recorded)
        scene_part_refuse(p, "ablation.normal_force", "load.recorded",
                          "give load.constant in place of load.recorded (load: {recorded: null, constant: 1 N})",
                          " is constant, and a recorded force has no mean that is known before its file is read");
    if (!scene_part_known(p, "contact.model")) return;
    still_check(p, c);
    if (c->contact.model != CONTACT_SCRAPE) idle_check(p, c);
    if (contact_rolls(c)) ball_check(p, &c->ball);
}

const struct params contact_params = {.section = "contact", .derive = contact_derive, .check = contact_check};
