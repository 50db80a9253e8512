/* What `rasp modes` looks at: a body of a scene or recipe, its object, and places on that. */
#include <string.h>

#include "cmd/modes.h"
#include "cmd/recipe.h"
#include "scene/ball.h"
#include "scene/units.h"

/* Of a scene that names a recipe of an object nothing else matters. */
static const char rest[] = "scraper: {mass: 1 g}\nmotion: {path: still, duration: 1 s}\n"
                           "contact: {model: strike, strike: {pulse: half_sine, speed: 1 m/s, stiffness: 1e6}}\noutput: {diagnostics: {rate: 1 kHz}}\n";

bool modes_body_read(struct cmd_call *c, const char *file, struct modes_body *b, struct err *e)
{
    const char *word = args_value(&c->args, "body");
    bool scene, tool = word && (!strcmp(word, "scraper") || !strcmp(word, "ball"));
    b->key = tool ? word : "surface";
    if (word && !tool && strcmp(word, "surface") != 0)
        return err_set(e, ERR_USAGE, "--body: '%s' is not surface, scraper or ball", word);
    if (!recipe_is_scene(c, file, &scene, e))
        return false;
    if (tool && !scene)
        return err_set(e, ERR_USAGE, "--body %s: %s is a recipe, which describes a surface; it needs a scene (with the key rasp: 1)", word, file);
    if (!recipe_read(c, file, rest, &b->scene, e))
        return false;
    if (b->scene.n_contacts > 1)
        return err_set(e, ERR_SCENE, "%s: has %d contacts; rasp modes takes a recipe, or a scene of one contact", file, b->scene.n_contacts);
    if (tool && strcmp(word, ball_tool(b->scene.contacts)) != 0)
        return err_set(e, ERR_USAGE, "--body %s: what touches the surface of %s is a %s", word, file, ball_tool(b->scene.contacts));
    b->title = scene ? b->scene.title : recipe_remark(c, file, "title");
    b->remark = scene ? NULL : recipe_remark(c, file, "source");
    b->response = tool ? &b->scene.contacts[0].scraper.response : &b->scene.contacts[0].surface.response;
    return true;
}

bool modes_body_object(struct cmd_call *c, const struct modes_body *b, struct object *o, const char **note, struct err *e)
{
    const char *text = args_value(&c->args, "top");
    struct units_fault fault = {NULL, NULL};
    struct object_ask ask = {.key = arena_format(c->arena, "%s.object", b->key), .top = 20000, .most = 10000};
    if (text && !units_read(text, KEY_FREQUENCY, &ask.top, c->arena, &fault))
        return err_set(e, ERR_USAGE, "--top: '%s' %s", text, fault.text);
    if (!(ask.top > 0 && ask.top <= 1e7))
        return err_set(e, ERR_USAGE, "--top: %s is not above 0 and at most 10 MHz", text);
    if (!b->response->object.given)
        return err_set(e, ERR_SCENE, "%s: there is no %s: it describes no object of simple shape", c->args.operands[0], ask.key);
    if (!object_make(&b->response->object, &ask, c->arena, o, note, e))
        return false;
    return o->n < ask.most || err_set(e, ERR_SCENE, "%s has more than %d modes below %g Hz; lower --top", ask.key, ask.most - 1, ask.top);
}

/* ------------------------------------------------------------------ places */

struct footing {
    const struct object *object;
    double *phi;
};

static double off(const void *self, double x, double y)
{
    const struct footing *g = (const struct footing *)self;
    return g->object->shapes(g->object, x, y, g->phi);
}

/* What is slender has its places on a line; of a shell any place is like the other. */
bool modes_body_places(struct cmd_call *c, const struct modes_body *b, const struct object *o, struct modes_fit *fit,
                       struct modes_places *p, struct err *e)
{
    struct footing g = {o, ARENA_TAKE(c->arena, double, o->n)};
    struct modes_ground ground = {.self = &g,
                                  .off = off,
                                  .low = {o->low[0], o->low[1]},
                                  .high = {o->high[0], o->high[1]},
                                  .standard = {33, 1},
                                  .fit = fit};
    const double *at = b->response->object.at;
    bool tool = strcmp(b->key, "surface") != 0;
    if (tool || o->shape == OBJECT_SHELL)
        memcpy(ground.standard, (int[2]){1, 1}, sizeof ground.standard);
    else if (o->flat)
        memcpy(ground.standard, (int[2]){17, 9}, sizeof ground.standard);
    if (tool)
        memcpy(ground.at, at, sizeof ground.at);
    return modes_places(c, &ground, p, e);
}
