/* See set_file.h. */
#include "batch/set_file.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/outfile.h"
#include "base/text.h"
#include "file/json_value.h"

static json_t *factor_json(const struct set_factor *f)
{
    return json_pack("{s:s, s:s, s:s?, s:s?, s:o, s:o}", "name", f->name, "column", f->column, "unit", f->unit, "meaning", f->meaning, "texts",
                     json_value_texts(f->texts, f->n), "values", json_value_texts(f->values, f->n));
}

static json_t *row_json(const struct set *s, const struct set_row *r)
{
    char seed[32];
    snprintf(seed, sizeof seed, "%llu", (unsigned long long)r->seed); /* JSON's numbers are doubles to many readers */
    return json_pack("{s:s, s:o, s:s?, s:i, s:s, s:s?, s:f}", "name", r->name, "values", json_value_texts(r->values, s->n_factors), "text", r->text, "replicate", r->replicate, "seed", seed,
                     "recording", r->recording, "cost", r->cost);
}

static json_t *level_json(const struct level *l)
{
    return json_pack("{s:o, s:o, s:o, s:o, s:o}", "full_scale", json_value_number(l->full_scale), "peak", json_value_number(l->peak), "rms", json_value_number(l->rms), "lufs", json_value_number(l->lufs),
                     "dbfs_at_1_pa", json_value_number(l->dbfs_at_1_pa));
}

static json_t *set_json(const struct set *s)
{
    json_t *factors = json_array(), *rows = json_array();
    for (int k = 0; k < s->n_factors; k++)
        json_array_append_new(factors, factor_json(&s->factors[k]));
    for (int i = 0; i < s->n; i++)
        json_array_append_new(rows, row_json(s, &s->rows[i]));
    return json_pack("{s:i, s:s?, s:s, s:s, s:i, s:i, s:o, s:o, s:o, s:i, s:i, s:o, s:o, s:o}", "rasp-set", 1, "title", s->title, "design", s->sha256, "build",
                     s->build, "replicates", s->replicates, "level_rule", s->level_rule, "level", level_json(&s->level), "length", json_value_number(s->length), "rate",
                     json_value_number(s->rate), "channels", s->channels, "encoding", s->encoding, "ramp", json_value_number(s->ramp), "factors", factors, "rows", rows);
}

bool set_file_save(const struct set *s, const char *path, struct err *e)
{
    struct outfile f;
    if (!outfile_open(&f, path, e))
        return false;
    json_t *j = set_json(s);
    if (!j || json_dumpf(j, f.stream, JSON_INDENT(1) | JSON_REAL_PRECISION(17)) != 0)
        err_set(e, ERR_IO, "%s: cannot be written: is the disk full?", path);
    fputc('\n', f.stream);
    json_decref(j);
    if (!e->kind)
        return outfile_commit(&f, e);
    outfile_drop(&f);
    return false;
}

/* ------------------------------------------------------------------ reading */

static int int_of(const json_t *j, const char *key)
{
    return (int)json_integer_value(json_object_get(j, key));
}

static const char **texts_of(const json_t *j, const char *key, int n, struct arena *a)
{
    const char **list = ARENA_TAKE(a, const char *, n);
    for (int i = 0; i < n; i++) {
        const char *s = json_string_value(json_array_get(json_object_get(j, key), (size_t)i));
        list[i] = arena_text(a, s ? s : "");
    }
    return list;
}

static bool factor_of(const json_t *j, struct arena *a, struct set_factor *f)
{
    *f = (struct set_factor){.name = json_value_text_of(j, "name", a), .column = json_value_text_of(j, "column", a), .unit = json_value_text_of(j, "unit", a),
                             .meaning = json_value_text_of(j, "meaning", a), .n = (int)json_array_size(json_object_get(j, "texts"))};
    f->texts = texts_of(j, "texts", f->n, a);
    f->values = texts_of(j, "values", f->n, a);
    return f->name && f->column;
}

static bool row_of(const json_t *j, int factors, struct arena *a, struct set_row *r)
{
    const char *seed = json_value_text_of(j, "seed", a);
    *r = (struct set_row){.name = json_value_text_of(j, "name", a), .values = texts_of(j, "values", factors, a), .text = json_value_text_of(j, "text", a), .replicate = int_of(j, "replicate"),
                          .recording = json_value_text_of(j, "recording", a), .cost = json_value_number_of(j, "cost")};
    return r->name && seed && text_u64(seed, &r->seed) && r->cost > 0;
}

static struct level level_of(const json_t *j)
{
    return (struct level){.full_scale = json_value_number_of(j, "full_scale"), .peak = json_value_number_of(j, "peak"), .rms = json_value_number_of(j, "rms"), .lufs = json_value_number_of(j, "lufs"),
                          .dbfs_at_1_pa = json_value_number_of(j, "dbfs_at_1_pa")};
}

static bool lists_of(const json_t *j, struct arena *a, struct set *s)
{
    const json_t *factors = json_object_get(j, "factors"), *rows = json_object_get(j, "rows");
    bool ok = true;
    s->n_factors = (int)json_array_size(factors);
    s->n = (int)json_array_size(rows);
    s->factors = ARENA_TAKE(a, struct set_factor, s->n_factors);
    s->rows = ARENA_TAKE(a, struct set_row, s->n);
    for (int k = 0; ok && k < s->n_factors; k++)
        ok = factor_of(json_array_get(factors, (size_t)k), a, &s->factors[k]);
    for (int i = 0; ok && i < s->n; i++)
        ok = row_of(json_array_get(rows, (size_t)i), s->n_factors, a, &s->rows[i]);
    return ok && s->n > 0;
}

static bool set_of(const json_t *j, struct arena *a, struct set *s)
{
    *s = (struct set){.title = json_value_text_of(j, "title", a), .sha256 = json_value_text_of(j, "design", a), .build = json_value_text_of(j, "build", a), .replicates = int_of(j, "replicates"),
                      .level_rule = int_of(j, "level_rule"), .level = level_of(json_object_get(j, "level")), .length = json_value_number_of(j, "length"),
                      .rate = json_value_number_of(j, "rate"), .channels = int_of(j, "channels"), .encoding = int_of(j, "encoding"), .ramp = json_value_number_of(j, "ramp")};
    bool rule = s->level_rule >= DESIGN_LEVEL_COMMON && s->level_rule <= DESIGN_LEVEL_SCENE, form = s->encoding >= 0 && s->encoding <= ENCODING_FLOAT64;
    return int_of(j, "rasp-set") == 1 && s->sha256 && s->build && rule && form && lists_of(j, a, s);
}

bool set_file_load(const char *path, struct arena *a, struct set *s, struct err *e)
{
    json_error_t fault;
    errno = 0;
    json_t *j = json_load_file(path, 0, &fault);
    if (!j && fault.line < 0)
        return err_set(e, ERR_INPUT, "%s: %s: the hidden folder .rasp is copied with the files of a shard, too; else run the shards again", path, strerror(errno));
    bool ok = j && set_of(j, a, s);
    json_decref(j);
    return ok || err_set(e, ERR_SCENE, "%s: is no list of a set's stimuli as rasp batch --shard writes it; remove it and run the shards again", path);
}
