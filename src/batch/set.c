/* See set.h. */
#include "batch/set.h"

#include <math.h>
#include <string.h>

#include "scene/keys_yaml.h"

static struct set_factor factor_make(const struct design_factor *d, struct arena *a)
{
    struct set_factor f = {.name = d->name, .column = d->column, .unit = d->unit, .meaning = d->meaning, .n = d->n_levels};
    f.texts = ARENA_TAKE(a, const char *, d->n_levels);
    f.values = ARENA_TAKE(a, const char *, d->n_levels);
    for (int i = 0; i < d->n_levels; i++) {
        f.texts[i] = d->levels[i].text ? d->levels[i].text : d->levels[i].label;
        f.values[i] = d->levels[i].value;
    }
    return f;
}

static const char *file_of(const char *path)
{
    const char *slash = path ? strrchr(path, '/') : NULL;
    return slash ? slash + 1 : path;
}

static struct set_row row_make(const struct design *d, int i, struct arena *a)
{
    const struct design_stimulus *x = &d->stimuli[i];
    struct set_row r = {.name = x->name, .replicate = x->replicate, .seed = x->seed, .recording = file_of(x->recording), .cost = 1};
    r.text = design_text(d, i, a);
    r.values = ARENA_TAKE(a, const char *, d->n_factors);
    for (int k = 0; k < d->n_factors; k++)
        r.values[k] = design_value(d, i, k);
    return r;
}

void set_make(const struct design *d, const char *build, struct arena *a, struct set *s)
{
    *s = (struct set){.title = d->title, .sha256 = d->sha256, .build = build, .n_factors = d->n_factors, .replicates = d->replicates, .n = d->n_stimuli,
                      .level_rule = d->level_rule, .level = d->level, .length = d->length_rule == DESIGN_LENGTH_FIXED ? d->length : NAN};
    s->factors = ARENA_TAKE(a, struct set_factor, d->n_factors);
    s->rows = ARENA_TAKE(a, struct set_row, d->n_stimuli);
    for (int k = 0; k < d->n_factors; k++)
        s->factors[k] = factor_make(&d->factors[k], a);
    for (int i = 0; i < d->n_stimuli; i++)
        s->rows[i] = row_make(d, i, a);
}

bool set_waits(const struct set *s)
{
    return s->level_rule == DESIGN_LEVEL_COMMON && isnan(s->level.full_scale) && isnan(s->level.dbfs_at_1_pa);
}

void set_lay(const struct set *s, struct scene *over)
{
    if (!isnan(s->length))
        over->output.duration = s->length;
    if (s->level_rule != DESIGN_LEVEL_SCENE)
        over->output.level = s->level;
    if (set_waits(s))
        over->output.level = (struct level){.later = true, .full_scale = 1, .peak = NAN, .rms = NAN, .lufs = NAN, .dbfs_at_1_pa = NAN};
}

const char *set_level_text(const struct set *s, struct arena *a)
{
    static const char *const rules[] = {[DESIGN_LEVEL_COMMON] = "common", [DESIGN_LEVEL_EACH] = "each", [DESIGN_LEVEL_SCENE] = "scene"};
    const struct level *l = &s->level;
    const char *rule = rules[s->level_rule];
    if (s->level_rule == DESIGN_LEVEL_SCENE)
        return rule;
    if (!isnan(l->full_scale))
        return arena_format(a, "%s full_scale %s", rule, keys_yaml_number(l->full_scale, a));
    if (!isnan(l->dbfs_at_1_pa))
        return arena_format(a, "%s dbfs_at_1_pa %s dB", rule, keys_yaml_number(l->dbfs_at_1_pa, a));
    if (!isnan(l->rms))
        return arena_format(a, "%s rms %s dB", rule, keys_yaml_number(l->rms, a));
    if (!isnan(l->lufs))
        return arena_format(a, "%s lufs %s LUFS", rule, keys_yaml_number(l->lufs, a));
    return arena_format(a, "%s peak %s dB", rule, keys_yaml_number(l->peak, a));
}
