/* What `rasp modes` looks at: a body of a scene or recipe, its object, and places on that. */
#include <math.h>
#include <stdlib.h>
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

static void add(struct modes_places *p, double x, double y)
{
    p->xy[p->n][0] = x;
    p->xy[p->n++][1] = y;
}

static void line(struct modes_places *p, const double ends[4], int n, struct arena *a)
{
    p->xy = arena_take(a, (size_t)n, sizeof *p->xy);
    for (int i = 0; i < n; i++) { /* exact at both ends and in the middle */
        double u = n > 1 ? (double)i / (n - 1) : 0.0;
        add(p, ends[0] + u * (ends[2] - ends[0]), ends[1] + u * (ends[3] - ends[1]));
    }
}

static void grid(struct modes_places *p, const struct object *o, const int n[2], struct arena *a)
{
    double *phi = ARENA_TAKE(a, double, o->n);
    p->xy = arena_take(a, (size_t)n[0] * (size_t)n[1], sizeof *p->xy);
    for (int j = 0; j < n[1]; j++)
        for (int i = 0; i < n[0]; i++) {
            double x = o->low[0] + (o->high[0] - o->low[0]) * i / (n[0] - 1), y = o->low[1] + (o->high[1] - o->low[1]) * j / (n[1] - 1);
            if (o->shapes(o, x, y, phi) <= 1e-9)
                add(p, x, y);
            else
                p->left_out++;
        }
}

static bool read_grid(struct cmd_call *c, int n[2], bool *given, struct err *e)
{
    const char *text = args_value(&c->args, "grid");
    *given = text != NULL;
    if (!text)
        return true;
    char *comma, *end;
    long x = strtol(text, &comma, 10), y = *comma == ',' ? strtol(comma + 1, &end, 10) : 0;
    if (y < 2 || x < 2 || x > 1000 || y > 1000 || *end)
        return err_set(e, ERR_USAGE, "--grid: '%s' is not of the form NX,NY, whole numbers from 2 to 1000, as in 17,9", text);
    n[0] = (int)x;
    n[1] = (int)y;
    return true;
}

static bool all_on(struct cmd_call *c, const struct object *o, const struct modes_places *p, struct err *e)
{
    double *phi = ARENA_TAKE(c->arena, double, o->n);
    for (int i = 0; i < p->n; i++) {
        double off = o->shapes(o, p->xy[i][0], p->xy[i][1], phi);
        if (off > 1e-9)
            return err_set(e, ERR_SCENE, "the place (%.9g, %.9g) m lies %.3g m off the object, which spans x from %.9g to %.9g m and y from %.9g to %.9g m",
                           p->xy[i][0], p->xy[i][1], off, o->low[0], o->high[0], o->low[1], o->high[1]);
    }
    return true;
}

/* What is slender has its places on a line; of a shell any place is like the other. */
static void standard(struct cmd_call *c, const struct modes_body *b, const struct object *o, struct modes_places *p)
{
    const double *at = b->response->object.at;
    if (strcmp(b->key, "surface") != 0)
        line(p, (double[4]){at[0], at[1], at[0], at[1]}, 1, c->arena);
    else if (o->shape == OBJECT_SHELL)
        line(p, (double[4]){0}, 1, c->arena);
    else if (o->flat)
        grid(p, o, (int[2]){17, 9}, c->arena);
    else
        line(p, (double[4]){o->low[0], 0.5 * (o->low[1] + o->high[1]), o->high[0], 0.5 * (o->low[1] + o->high[1])}, 33, c->arena);
}

bool modes_body_places(struct cmd_call *c, const struct modes_body *b, const struct object *o, struct modes_places *p, struct err *e)
{
    static const long counts[2] = {2, 100000};
    double ends[4] = {0};
    int n[2];
    long places = 33;
    bool has_grid, has_line = args_given(&c->args, "line"), has_at = args_given(&c->args, "at");
    *p = (struct modes_places){0};
    if (!modes_lengths(c, &(struct modes_lengths){"line", "X0,Y0,X1,Y1", 4}, ends, e) || !modes_lengths(c, &(struct modes_lengths){"at", "X,Y", 2}, ends, e) ||
        !read_grid(c, n, &has_grid, e) || !args_whole(&c->args, "places", counts, &places, e))
        return false;
    if (has_line + has_at + has_grid > 1)
        return err_set(e, ERR_USAGE, "--line, --grid and --at exclude each other");
    if (args_given(&c->args, "places") && !has_line)
        return err_set(e, ERR_USAGE, "--places needs --line");
    if (has_at)
        line(p, ends, 1, c->arena);
    else if (has_grid)
        grid(p, o, n, c->arena);
    else if (has_line)
        line(p, ends, (int)places, c->arena);
    else
        standard(c, b, o, p);
    return all_on(c, o, p, e);
}
