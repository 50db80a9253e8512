/* See prepare_look.h. */
#include "batch/prepare_look.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "output/loudness.h"
#include "output/sound.h"
#include "pipeline/plan_scene.h"
#include "response/modes.h"
#include "scene/scene_places.h"
#include "scene/scene_write.h"

struct prepare_trial *prepare_look_open(void)
{
    struct arena *a = arena_open();
    struct prepare_trial *t = ARENA_TAKE(a, struct prepare_trial, 1);
    *t = (struct prepare_trial){.arena = a, .messages = ""};
    return t;
}

/* File names are seen from the base scene: where all lies does not count. */
static void hash_scene(struct prepare_trial *t)
{
    const struct scene *s = &t->scene;
    const char *slash = strrchr(s->sources[0], '/'), *beside = slash ? arena_format(t->arena, "%.*s", slash == s->sources[0] ? 1 : (int)(slash - s->sources[0]), s->sources[0]) : ".";
    const char *text = scene_write(s, beside, t->arena);
    hash_bytes(text, strlen(text), t->sha256);
}

/* The texts it was read from lie on the shelf from now on, which knows whether they change while the set is rendered: each stimulus reads them once more. */
static bool watch_sources(const struct prepare_view *v, struct prepare_trial *t)
{
    for (const char *const *file = t->scene.sources; *file; file++)
        if (!shelf_sha256(v->shelf, *file, t->arena, &t->e))
            return false;
    return true;
}

/* The level that is asked of it in the end, by itself or with the others of a common one. */
static struct level wants(const struct prepare_view *v, const struct scene *s)
{
    return v->set->level_rule == DESIGN_LEVEL_SCENE ? s->output.level : v->set->level;
}

static bool draws(const struct scene *s)
{
    for (int i = 0; i < s->n_contacts; i++)
        if (s->contacts[i].motion.path == PATH_SCRIBBLE)
            return true;
    return false;
}

static bool estimate(const struct prepare_view *v, int i, struct prepare_look *l)
{
    struct plan_scene_estimate x;
    struct prepare_trial *t = l->trial;
    struct scene *s = &t->scene;
    bool read = design_scene(v->design, i, t->arena, s, &t->messages, &t->e);
    t->diag = s->diag;
    if (!read || !watch_sources(v, t))
        return false;
    s->shelf = v->shelf;
    hash_scene(t);
    l->drawn = draws(s);
    set_lay(v->set, s);
    design_scene_places(v->design, s, t->arena);
    if (!plan_scene_estimate(s, t->arena, &x, &t->e))
        return scene_places_tell(s, &t->e);
    t->warnings = x.warnings;
    struct track_format f = sound_format(s, x.length.frames);
    l->seconds = (double)x.length.frames / f.rate;
    l->cost = fmax(x.cycles, 1);
    l->rate = f.rate;
    l->channels = f.channels;
    l->bits = abs(f.bits);
    l->encoding = s->output.encoding;
    l->ramp = s->output.ramp;
    l->sounds = x.sounds;
    l->quantity = x.quantity;
    l->loud = !isnan(wants(v, s).lufs);
    return true;
}

void prepare_look_at(const struct prepare_view *v, int i, struct prepare_look *l)
{
    l->trial = prepare_look_open();
    estimate(v, i, l);
}

static long frames_of(const struct prepare_look *l, double seconds)
{
    return (long)rint(seconds * l->rate);
}

bool prepare_look_is_short(const struct prepare_look *l, double seconds)
{
    return l->sounds && l->loud && frames_of(l, seconds) < loudness_least(l->rate);
}

void prepare_look_short(const struct prepare_view *v, int i, double seconds, struct prepare_look *l)
{
    struct prepare_trial *t = l->trial = prepare_look_open();
    struct scene *s = &t->scene;
    if (!design_scene(v->design, i, t->arena, s, &t->messages, &t->e))
        return;
    s->output.level = wants(v, s);
    design_scene_places(v->design, s, t->arena);
    if (!sound_long_enough(s, frames_of(l, seconds), &t->e))
        scene_places_tell(s, &t->e);
}

/* ------------------------------------------------------------------ one form */

/* Players and trial scripts take one rate and one number of channels for all that they play, and resample, or fail, where it is another. */
static bool tell_otherwise(const struct prepare_view *v, const struct prepare_form *f, const struct prepare_look *l, struct err *e)
{
    if (l->rate != f->first->rate)
        return err_set(e, ERR_SCENE, "the sound has %g Hz, '%s' of the same set %g Hz: give all one output.sample_rate, or make two sets", l->rate, f->first_name, f->first->rate);
    if (l->channels != f->first->channels)
        return err_set(e, ERR_SCENE, "the sound has %d channel%s, '%s' of the same set %d: give all as many (output.channels, output.listen), or make two sets", l->channels,
                       l->channels == 1 ? "" : "s", f->first_name, f->first->channels);
    if (v->set->level_rule == DESIGN_LEVEL_COMMON && l->quantity >= 0 && l->quantity != f->stated->quantity)
        return err_set(e, ERR_SCENE, "the sound is in %s, '%s' of the same set in %s, and one gain cannot be common to both: choose one by output.quantity, or level: {each: ...}",
                       modes_quantity_unit(l->quantity), f->stated_name, modes_quantity_unit(f->stated->quantity));
    return true;
}

/* The key by which it became so. */
static bool about(const struct prepare_form *f, const struct prepare_look *l, const struct scene *s, struct err *e)
{
    if (l->rate != f->first->rate)
        return err_about(e, NULL, "output.sample_rate");
    if (l->channels != f->first->channels)
        return err_about(e, NULL, l->channels == s->output.channels ? "output.channels" : "output.listen");
    return s->output.quantity == QUANTITY_AUTO ? err_about(e, s->contacts[0].name, "surface.response") : err_about(e, NULL, "output.quantity");
}

bool prepare_look_otherwise(const struct prepare_view *v, int i, const struct prepare_form *f, struct prepare_look *l)
{
    struct err e = {0};
    if (!l->sounds || tell_otherwise(v, f, l, &e))
        return false;
    struct prepare_trial *t = l->trial = prepare_look_open();
    l->otherwise = true;
    if (!design_scene(v->design, i, t->arena, &t->scene, &t->messages, &t->e))
        return true;
    t->e = e;
    about(f, l, &t->scene, &t->e);
    design_scene_places(v->design, &t->scene, t->arena);
    scene_places_tell(&t->scene, &t->e);
    return true;
}
