/* How bodies ring: what an object of simple shape needs, readings of a response that moves, and the engines that can do
 * them. */
#include "response/response.h"

#include <math.h>
#include <string.h>

#include "scene/scene_part.h"
#include "trajectory/contact.h"

struct body {
    const struct scene_part *part;
    struct arena *arena;
    const struct response *response;
    const char *name;
};

static const char *path_of(const struct body *b, const char *key)
{
    return arena_format(b->arena, "%s.%s", b->name, key);
}

static const char *label_of(const struct body *b, const char *key)
{
    return scene_part_label(b->part, path_of(b, key));
}

static const char *word(const struct body *b, const char *key, int value)
{
    return keys_find(path_of(b, key))->choices[value].word;
}

static bool known(const struct body *b, const char *key) { return scene_part_known(b->part, path_of(b, key)); }

static const char *leave_out(const struct body *b, const char *key, const char *instead)
{
    return arena_format(b->arena, "leave %s out, or set it to %s", path_of(b, key), instead);
}

/* ------------------------------------------------------------------ an object */

static void needs(const struct body *b, const char *key, const char *example)
{
    const char *material = path_of(b, "material");
    const char *value = arena_format(b->arena, "%s; or name a material, such as %s: steel", example, material);
    scene_part_missing(b->part, path_of(b, key), value,
                       arena_format(b->arena, ": %s is custom", scene_part_label(b->part, material)));
}

/* Sizes, edges and constants that its shape needs. */
static void object_check(const struct body *b)
{
    const struct object_given *o = &b->response->object;
    if (!o->given || !known(b, "object.shape")) return;
    const char *thickness = path_of(b, "object.thickness"), *edges = path_of(b, "object.edges"),
               *shape = path_of(b, "object.shape"), *is = word(b, "object.shape", o->shape);
    bool plate = o->shape == OBJECT_PLATE || o->shape == OBJECT_DISK, rod = o->shape == OBJECT_ROD,
         stretched = o->shape == OBJECT_STRING || o->shape == OBJECT_MEMBRANE || o->shape == OBJECT_DRUM;
    if (o->shape != OBJECT_STRING && !rod)
        scene_part_missing(b->part, thickness, "5 mm", arena_format(b->arena, ": a %s has one", is));
    if ((rod || o->shape == OBJECT_SHELL) && 2 * o->thickness >= o->diameter)
        scene_part_refuse(b->part, thickness, path_of(b, "object.diameter"),
                          rod ? "lower thickness; a rod without one is solid" : "lower thickness",
                          ", %.4g m, must be less than half of %s, %.4g m", o->thickness,
                          label_of(b, "object.diameter"), o->diameter);
    if (o->edges == EDGES_CANTILEVER && plate && scene_part_known(b->part, edges))
        scene_part_refuse(b->part, edges, shape, "edges here: free, supported, clamped",
                          " must not be cantilever where %s is %s: only bars and rods have one end",
                          label_of(b, "object.shape"), is);
    if (o->material == MATERIAL_CUSTOM && known(b, "material")) {
        needs(b, "object.density", "650 kg/m^3");
        if (!stretched) needs(b, "object.youngs_modulus", "12 GPa");
        if (plate || o->shape == OBJECT_SHELL) needs(b, "object.poisson", "0.35");
    }
    /* nu_x nu_y = nu_x^2 E_y / E_x is below 1 in whatever does not fall apart. */
    double coupling = o->poisson * o->poisson * o->youngs_modulus_across / o->youngs_modulus;
    if (coupling >= 1)
        scene_part_refuse(
            b->part, path_of(b, "object.poisson"), path_of(b, "object.youngs_modulus_across"),
            "lower poisson or youngs_modulus_across",
            ": poisson^2 x youngs_modulus_across / youngs_modulus is %.4g, and is below 1 in every material", coupling);
}

/* ------------------------------------------------------------------ readings and engines */

/* Does it glide: because that is asked for, or because a place in the space of materials that travels does? */
static bool glides(const struct response *r)
{
    return r->moving == MOVING_GLIDE || (r->moving == MOVING_AUTO && response_travels(&r->space));
}

/* What has no modes. */
static void recorded_check(const struct body *b)
{
    const struct response *r = b->response;
    const char *engine = path_of(b, "convolution"), *moving = path_of(b, "moving"), *file = path_of(b, "response"),
               *shown = diag_shown(b->part->yaml->diag, r->file);
    if (r->convolution == ENGINE_RESONATORS)
        scene_part_refuse(b->part, engine, file, leave_out(b, "convolution", "overlap_add"),
                          ": %s need a mode table (.csv) as %s, not '%s'", word(b, "convolution", r->convolution),
                          label_of(b, "response"), shown);
    if (r->moving != MOVING_AUTO && r->moving != MOVING_LAUNCH)
        scene_part_refuse(b->part, moving, file, leave_out(b, "moving", "launch"),
                          ": %s needs modes, and '%s' is recorded", word(b, "moving", r->moving), shown);
}

static void reading_check(const struct body *b)
{
    const struct response *r = b->response;
    int asked = r->convolution;
    const char *engine = path_of(b, "convolution"), *moving = path_of(b, "moving"),
               *length = path_of(b, "response_length");
    bool readout = r->moving == MOVING_READOUT, resonators = asked == ENGINE_RESONATORS,
         clash = (glides(r) && asked == ENGINE_OVERLAP_ADD) || (readout && resonators);
    if (r->moving == MOVING_FIXED && response_travels(&r->space) && known(b, "moving"))
        scene_part_refuse(b->part, moving, path_of(b, "space"),
                          "leave surface.moving out, or set it to launch, glide or readout",
                          ": fixed needs an object that stays what it is, and %s travels", label_of(b, "space"));
    if (clash)
        scene_part_refuse(b->part, engine, moving, leave_out(b, "convolution", readout ? "overlap_add" : "resonators"),
                          ": %s cannot do %s: %s%s", word(b, "convolution", asked), label_of(b, "moving"),
                          glides(r) ? "glide" : "readout",
                          r->moving == MOVING_AUTO ? ", which is auto where surface.space travels" : "");
    if (isnan(r->length) || response_is_recorded(r)) return;
    if (resonators)
        scene_part_refuse(b->part, engine, length,
                          arena_format(b->arena, "leave %s out, or set %s to overlap_add", length, engine),
                          ": resonators ring on for ever, and %s cannot cut them", label_of(b, "response_length"));
    else if (glides(r))
        scene_part_refuse(b->part, moving, length,
                          arena_format(b->arena, "leave %s out, or set %s to launch", length, moving),
                          ": what glides rings on for ever, and %s cannot cut it", label_of(b, "response_length"));
}

static void gammatone_check(const struct body *b)
{
    const struct response *r = b->response;
    const char *path = path_of(b, "gammatone"), *file = path_of(b, "response"), *moving = path_of(b, "moving");
    if (r->gammatone < 2) /* 0: the model is not known, so it is not either */
        return;
    if (response_is_recorded(r))
        scene_part_refuse(b->part, path, file, arena_format(b->arena, "leave %s out", path),
                          " needs a mode table (.csv) as %s, not '%s'", label_of(b, "response"),
                          diag_shown(b->part->yaml->diag, r->file));
    else if (!response_given(r))
        scene_part_refuse(
            b->part, path, path,
            arena_format(b->arena, "give %s (a mode table) or %s, or leave %s out", file, path_of(b, "object"), path),
            " is %d, and nothing rings", r->gammatone);
    else if (glides(r))
        scene_part_refuse(b->part, path, moving,
                          arena_format(b->arena, "set %s to launch or readout, or leave %s out", moving, path),
                          " is %d, and what glides begins at once: %s is glide%s", r->gammatone, label_of(b, "moving"),
                          r->moving == MOVING_AUTO ? ", which is auto where surface.space travels" : "");
}

static void body_check(const struct scene_part *p, const char *name, const struct response *r)
{
    const struct body b = {p, p->yaml->arena, r, name};
    object_check(&b);
    if (!response_given(r) || known(&b, "convolution")) gammatone_check(&b);
    if (!response_given(r) || !known(&b, "convolution")) return;
    if (response_is_recorded(r)) recorded_check(&b);
    reading_check(&b);
}

/* ------------------------------------------------------------------ the space of materials */

static void space_check(const struct scene_part *p, const char *path, const double place[2])
{
    double r = sqrt(place[0] * place[0] + place[1] * place[1]);
    if (r > 1 + 1e-6)
        scene_part_refuse(p, path, path, "the rim is where x^2 + y^2 is 1",
                          " lies %.6g from the centre, outside the disk of materials, whose radius is 1", r);
}

/* Is the body called as this model calls it? */
static bool sound_named(const struct scene_part *p, const struct contact *c)
{
    static const char *const bodies[2] = {"scraper", "ball"};
    const char *path = "ablation.sound", *tool = contact_tool(c);
    int word = c->ablation.sound - ABLATED_SOUND_SCRAPER;
    if (word < 0 || !scene_part_known(p, "contact.model") || !strcmp(bodies[word], tool)) return true;
    scene_part_refuse(p, path, "contact.model", arena_format(p->yaml->arena, "write %s: %s", path, tool),
                      " is %s, and what touches the surface here is called %s", bodies[word], tool);
    return false;
}

static void silence_check(const struct scene_part *p, const struct contact *c)
{
    const char *path = "ablation.sound", *body = contact_mutes_surface(c) ? contact_tool(c) : "surface";
    bool responds =
        response_given(&c->surface.response) || (response_given(&c->scraper.response) && c->scraper.weight != 0);
    if (responds && !response_rings(c) && scene_part_known(p, path))
        scene_part_refuse(p, path, path,
                          arena_format(p->yaml->arena, "give %s.response%s, or leave ablation.sound out", body,
                                       contact_mutes_surface(c) ? " and a weight above 0" : ""),
                          " is %s, which does not ring: nothing would be heard", body);
}

static void response_check(const struct scene_part *p, const struct contact *c, const void *own)
{
    (void)own;
    body_check(p, "surface", &c->surface.response);
    body_check(p, contact_tool(c), &c->scraper.response);
    if (sound_named(p, c)) silence_check(p, c);
    space_check(p, "surface.space.from", c->surface.response.space.from);
    space_check(p, "surface.space.to", c->surface.response.space.to);
}

const struct params response_params = {.section = "surface.response", .check = response_check};
