/* design_scene, design_scene_places, design_scene_recording: see design.h. Design, base and all that is laid over it are only read here: any number of threads may ask for scenes at once. */
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "batch/design_reading.h"
#include "scene/scene_places.h"
#include "scene/scene_read.h"

struct layer {
    struct scene_layer_key *keys;
    int n;
};

static void add(struct layer *l, const struct design_change *c)
{
    if (c->n > 0)
        memcpy(l->keys + l->n, c->keys, (size_t)c->n * sizeof *c->keys);
    l->n += c->n;
}

/* The design's seed in this stimulus, as a key of the scene. */
static struct scene_layer_key seed_key(struct yaml *y, const struct design *d, int i)
{
    struct yaml_node **path = ARENA_TAKE(y->arena, struct yaml_node *, 2);
    struct diag_place at = d->texts->seed;
    path[0] = yaml_make(y, YAML_SCALAR, at, "seed");
    return (struct scene_layer_key){path, yaml_make(y, YAML_SCALAR, at, arena_format(y->arena, "%llu", (unsigned long long)d->stimuli[i].seed))};
}

static int most_keys(const struct design *d, const int *level)
{
    int n = d->texts->set.n + 1;
    for (int f = 0; f < d->n_factors; f++)
        n += d->texts->levels[f][level[f]].n;
    return n;
}

bool design_scene(const struct design *d, int i, struct arena *a, struct scene *s, const char **messages, struct err *e)
{
    const struct design_texts *t = d->texts;
    const int *level = d->stimuli[i].level;
    const char *base = d->base;
    const struct yaml_node *named = t->base;
    *messages = "";
    if (d->stimuli[i].recording)
        return err_set(e, ERR_USAGE, "%s is a recording: it has no scene", d->stimuli[i].recording);
    struct layer l = {ARENA_TAKE(a, struct scene_layer_key, most_keys(d, level)), 0};
    add(&l, &t->set);
    for (int f = 0; f < d->n_factors; f++) {
        const struct design_change *c = &t->levels[f][level[f]];
        add(&l, c);
        base = c->base ? d->factors[f].levels[level[f]].base : base;
        named = c->base ? c->base : named;
    }
    l.keys[l.n++] = seed_key(yaml_open(a), d, i);
    const struct scene_layer layer = {named->at, l.keys, l.n};
    return scene_read(base, &(struct scene_overrides){.layer = &layer}, a, s, messages, e);
}

bool design_scene_recording(const struct design *d, int i, struct err *e)
{
    const struct diag_place *at = &yaml_get(d->texts->cells[d->stimuli[i].cell].entry, "file")->at;
    char name[sizeof e->text], number[32];
    text_show(at->source->name, name, sizeof name);
    int file = (int)strlen(name), rest = snprintf(number, sizeof number, ":%d:%d: ", at->line, at->column);
    err_at(e, "%s:%d:%d", at->source->name, at->line, at->column);
    e->place = (struct err_place){file, file + rest, at->line, at->column, at->width};
    return false;
}

void design_scene_places(const struct design *d, struct scene *s, struct arena *a)
{
    if (d->level_rule != DESIGN_LEVEL_SCENE)
        scene_places_move(s, "output.level", "level", &d->texts->level, a);
    if (d->length_rule == DESIGN_LENGTH_FIXED)
        scene_places_move(s, "output.duration", "length", &d->texts->length, a);
}
