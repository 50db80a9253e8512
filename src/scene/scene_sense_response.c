/* How bodies ring: readings of a response that moves, and the engines that can do them. */
#include <math.h>
#include <string.h>

#include "scene/ball.h"
#include "scene/rules.h"
#include "scene/scene_sense_parts.h"

struct body {
    const struct scene_part *part;
    const struct response *response;
    const char *name;
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

/* ------------------------------------------------------------------ what has no modes */

static void recorded_check(const struct body *b)
{
    const struct response *r = b->response;
    struct diag *d = b->part->yaml->diag;
    if (!rules_is_recorded(r)) return;
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
    return r->moving == MOVING_GLIDE || (r->moving == MOVING_AUTO && rules_travels(&r->space));
}

static void reading_check(const struct body *b)
{
    const struct response *r = b->response;
    int asked = r->convolution;
    bool readout = r->moving == MOVING_READOUT,
         clash = (glides(r) && asked == ENGINE_OVERLAP_ADD) || (readout && asked == ENGINE_RESONATORS);
    if (r->moving == MOVING_FIXED && rules_travels(&r->space) && known(b, "moving"))
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
    if (isnan(r->length) || rules_is_recorded(r) || (!resonators && !glides(r))) return;
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
    if (rules_is_recorded(r))
        diag_add(d, later(b, "gammatone", "response"), arena_format(a, "leave %s out", path_of(b, "gammatone")),
                 "%s needs a mode table (.csv) as %s, not '%s'", label_of(b, "gammatone"), label_of(b, "response"),
                 diag_shown(d, r->file));
    else if (!rules_responds(r))
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
    struct body b = {p, r, name};
    scene_sense_object(p, &r->object, name);
    if (!rules_responds(r)) gammatone_check(&b);
    if (!rules_responds(r) || !known(&b, "convolution")) return;
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

void scene_sense_response(const struct scene_part *p, const struct contact *c)
{
    body_check(p, "surface", &c->surface.response);
    body_check(p, ball_tool(c), &c->scraper.response);
    space_check(p, "surface.space.from", c->surface.response.space.from);
    space_check(p, "surface.space.to", c->surface.response.space.to);
}
