/* How bodies ring: what an object of simple shape needs, readings of a response that moves, and the engines that can do
 * them. */
#include "response/response.h"

#include <math.h>
#include <string.h>

#include "scene/scene_part.h"
#include "trajectory/contact.h"

struct body {
    const struct scene_part *part;
    const struct response *response;
    const char *name, *shape; /* shape: of its object */
};

static const char *path_of(const struct body *b, const char *key)
{
    return arena_format(b->part->yaml->arena, "%s.%s", b->name, key);
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

static struct diag_place later(const struct body *b, const char *key, const char *other)
{
    return scene_part_later(b->part, path_of(b, key), path_of(b, other));
}

static const char *leave_out(const struct body *b, const char *key, const char *instead)
{
    return arena_format(b->part->yaml->arena, "leave %s out, or set it to %s", path_of(b, key), instead);
}

/* ------------------------------------------------------------------ an object */

static bool is_stretched(const struct object_given *o)
{
    return o->shape == OBJECT_STRING || o->shape == OBJECT_MEMBRANE || o->shape == OBJECT_DRUM;
}

static bool is_plate(const struct object_given *o)
{
    return o->shape == OBJECT_PLATE || o->shape == OBJECT_DISK || o->shape == OBJECT_SHELL;
}

/* ------------------------------------------------------------------ sizes */

static void thickness_check(const struct body *b)
{
    const struct object_given *o = &b->response->object;
    const char *thickness = path_of(b, "object.thickness");
    bool hollow = o->shape == OBJECT_ROD || o->shape == OBJECT_SHELL;
    if (o->shape != OBJECT_STRING && o->shape != OBJECT_ROD)
        scene_part_missing(b->part, thickness, "5 mm", arena_format(b->part->yaml->arena, ": a %s has one", b->shape));
    if (hollow && 2 * o->thickness >= o->diameter)
        diag_add(b->part->yaml->diag, scene_part_later(b->part, thickness, path_of(b, "object.diameter")),
                 o->shape == OBJECT_ROD ? "lower thickness; a rod without one is solid" : "lower thickness",
                 "%s, %.4g m, must be less than half of %s, %.4g m", label_of(b, "object.thickness"), o->thickness,
                 label_of(b, "object.diameter"), o->diameter);
}

static void edges_check(const struct body *b)
{
    const struct object_given *o = &b->response->object;
    const char *edges = path_of(b, "object.edges");
    if (o->edges == EDGES_CANTILEVER && (o->shape == OBJECT_PLATE || o->shape == OBJECT_DISK) &&
        scene_part_known(b->part, edges))
        diag_add(b->part->yaml->diag, scene_part_later(b->part, edges, path_of(b, "object.shape")),
                 "edges here: free, supported, clamped",
                 "%s must not be cantilever where %s is %s: only bars and rods have one end",
                 label_of(b, "object.edges"), label_of(b, "object.shape"), b->shape);
}

/* ------------------------------------------------------------------ material */

static void needs(const struct body *b, const char *key, const char *example)
{
    struct arena *a = b->part->yaml->arena;
    const char *material = arena_format(a, "%s.material", b->name);
    const char *value = arena_format(a, "%s; or name a material, such as %s: steel", example, material);
    scene_part_missing(b->part, path_of(b, key), value,
                       arena_format(a, ": %s is custom", scene_part_label(b->part, material)));
}

static void material_check(const struct body *b)
{
    const struct object_given *o = &b->response->object;
    if (o->material != MATERIAL_CUSTOM ||
        !scene_part_known(b->part, arena_format(b->part->yaml->arena, "%s.material", b->name)))
        return;
    needs(b, "object.density", "650 kg/m^3");
    if (!is_stretched(o)) needs(b, "object.youngs_modulus", "12 GPa");
    if (is_plate(o)) needs(b, "object.poisson", "0.35");
}

/* nu_x nu_y = nu_x^2 E_y / E_x is below 1 in whatever does not fall apart. */
static void orthotropic_check(const struct body *b)
{
    const struct object_given *o = &b->response->object;
    double coupling = o->poisson * o->poisson * o->youngs_modulus_across / o->youngs_modulus;
    if (coupling >= 1)
        diag_add(b->part->yaml->diag,
                 scene_part_later(b->part, path_of(b, "object.poisson"), path_of(b, "object.youngs_modulus_across")),
                 "lower poisson or youngs_modulus_across",
                 "%s: poisson^2 x youngs_modulus_across / youngs_modulus is %.4g, and is below 1 in every material",
                 label_of(b, "object.poisson"), coupling);
}

static void object_check(struct body *b)
{
    if (!b->response->object.given || !known(b, "object.shape")) return;
    b->shape = word(b, "object.shape", b->response->object.shape);
    thickness_check(b);
    edges_check(b);
    material_check(b);
    orthotropic_check(b);
}

/* ------------------------------------------------------------------ what has no modes */

static void recorded_check(const struct body *b)
{
    const struct response *r = b->response;
    struct diag *d = b->part->yaml->diag;
    if (!response_is_recorded(r)) return;
    if (r->convolution == ENGINE_RESONATORS)
        diag_add(d, later(b, "convolution", "response"), leave_out(b, "convolution", "overlap_add"),
                 "%s: %s need a mode table (.csv) as %s, not '%s'", label_of(b, "convolution"),
                 word(b, "convolution", r->convolution), label_of(b, "response"), diag_shown(d, r->file));
    if (r->moving != MOVING_AUTO && r->moving != MOVING_LAUNCH)
        diag_add(d, later(b, "moving", "response"), leave_out(b, "moving", "launch"),
                 "%s: %s needs modes, and '%s' is recorded", label_of(b, "moving"), word(b, "moving", r->moving),
                 diag_shown(d, r->file));
}

/* ------------------------------------------------------------------ readings and engines */

/* Does it glide: because that is asked for, or because a place in the space of materials that travels does? */
static bool glides(const struct response *r)
{
    return r->moving == MOVING_GLIDE || (r->moving == MOVING_AUTO && response_travels(&r->space));
}

static void reading_check(const struct body *b)
{
    const struct response *r = b->response;
    int asked = r->convolution;
    bool readout = r->moving == MOVING_READOUT,
         clash = (glides(r) && asked == ENGINE_OVERLAP_ADD) || (readout && asked == ENGINE_RESONATORS);
    if (r->moving == MOVING_FIXED && response_travels(&r->space) && known(b, "moving"))
        diag_add(b->part->yaml->diag, later(b, "moving", "space"),
                 "leave surface.moving out, or set it to launch, glide or readout",
                 "%s: fixed needs an object that stays what it is, and %s travels", label_of(b, "moving"),
                 label_of(b, "space"));
    if (clash)
        diag_add(b->part->yaml->diag, later(b, "convolution", "moving"),
                 leave_out(b, "convolution", readout ? "overlap_add" : "resonators"), "%s: %s cannot do %s: %s%s",
                 label_of(b, "convolution"), word(b, "convolution", asked), label_of(b, "moving"),
                 glides(r) ? "glide" : "readout",
                 r->moving == MOVING_AUTO ? ", which is auto where surface.space travels" : "");
}

static void length_check(const struct body *b)
{
    const struct response *r = b->response;
    bool resonators = r->convolution == ENGINE_RESONATORS;
    if (isnan(r->length) || response_is_recorded(r) || (!resonators && !glides(r))) return;
    if (resonators)
        diag_add(b->part->yaml->diag, later(b, "convolution", "response_length"),
                 arena_format(b->part->yaml->arena, "leave %s out, or set %s to overlap_add",
                              path_of(b, "response_length"), path_of(b, "convolution")),
                 "%s: resonators ring on for ever, and %s cannot cut them", label_of(b, "convolution"),
                 label_of(b, "response_length"));
    else
        diag_add(b->part->yaml->diag, later(b, "moving", "response_length"),
                 arena_format(b->part->yaml->arena, "leave %s out, or set %s to launch", path_of(b, "response_length"),
                              path_of(b, "moving")),
                 "%s: what glides rings on for ever, and %s cannot cut it", label_of(b, "moving"),
                 label_of(b, "response_length"));
}

/* ------------------------------------------------------------------ gammatones, and a force louder near the modes */

static void gammatone_check(const struct body *b)
{
    const struct response *r = b->response;
    struct diag *d = b->part->yaml->diag;
    struct arena *a = b->part->yaml->arena;
    if (r->gammatone < 2) /* 0: the model is not known, so it is not either */
        return;
    if (response_is_recorded(r))
        diag_add(d, later(b, "gammatone", "response"), arena_format(a, "leave %s out", path_of(b, "gammatone")),
                 "%s needs a mode table (.csv) as %s, not '%s'", label_of(b, "gammatone"), label_of(b, "response"),
                 diag_shown(d, r->file));
    else if (!response_given(r))
        diag_add(d, later(b, "gammatone", "gammatone"),
                 arena_format(a, "give %s (a mode table) or %s, or leave %s out", path_of(b, "response"),
                              path_of(b, "object"), path_of(b, "gammatone")),
                 "%s is %d, and nothing rings", label_of(b, "gammatone"), r->gammatone);
    else if (glides(r))
        diag_add(d, later(b, "gammatone", "moving"),
                 arena_format(a, "set %s to launch or readout, or leave %s out", path_of(b, "moving"),
                              path_of(b, "gammatone")),
                 "%s is %d, and what glides begins at once: %s is glide%s", label_of(b, "gammatone"), r->gammatone,
                 label_of(b, "moving"), r->moving == MOVING_AUTO ? ", which is auto where surface.space travels" : "");
}

static void body_check(const struct scene_part *p, const char *name, const struct response *r)
{
    struct body b = {p, r, name, ""};
    object_check(&b);
    if (!response_given(r)) gammatone_check(&b);
    if (!response_given(r) || !known(&b, "convolution")) return;
    recorded_check(&b);
    reading_check(&b);
    length_check(&b);
    gammatone_check(&b);
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

static bool lacks_sound(const struct contact *c)
{
    bool surface = response_given(&c->surface.response),
         tool = response_given(&c->scraper.response) && c->scraper.weight != 0;
    return (surface || tool) && !response_rings(c);
}

static void silence_check(const struct scene_part *p, const struct contact *c)
{
    const char *path = "ablation.sound", *body = contact_mutes_surface(c) ? contact_tool(c) : "surface";
    if (lacks_sound(c) && scene_part_known(p, path))
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
