/* See manifest.h. */
#include "batch/manifest.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#include "base/outfile.h"
#include "batch/manifest_columns.h"

static void put_head(FILE *f, const struct set *s)
{
    for (const struct manifest_column *c = manifest_columns; c->name; c++) {
        if (strcmp(c->name, "*") != 0) {
            fprintf(f, "%s%s", c == manifest_columns ? "" : ",", c->name);
            continue;
        }
        for (int k = 0; k < s->n_factors; k++)
            fprintf(f, ",%s", s->factors[k].column);
    }
    fputc('\n', f);
}

static void put_row(const struct manifest_cell *cell)
{
    for (const struct manifest_column *c = manifest_columns; c->name; c++) {
        if (strcmp(c->name, "*") != 0) {
            fputs(c == manifest_columns ? "" : ",", cell->f);
            c->put(cell);
            continue;
        }
        for (int k = 0; k < cell->set->n_factors; k++) {
            fputc(',', cell->f);
            manifest_columns_text(cell->f, cell->set->rows[cell->row].values[k]);
        }
    }
    fputc('\n', cell->f);
}

static bool print_row(struct manifest_cell *c, const struct results *r, int i, struct err *e)
{
    struct arena *a = arena_open();
    c->row = i;
    c->is = &r->of[i];
    c->record = c->is->record.size ? journal_read(r->journal, c->is->record, a, e) : NULL;
    bool ok = c->record || !c->is->record.size;
    if (ok)
        put_row(c);
    arena_close(a);
    return ok;
}

bool manifest_print(FILE *f, const struct results *r, const bool *mine, struct err *e)
{
    struct arena *a = arena_open();
    struct manifest_cell c = {.set = r->set, .level = set_level_text(r->set, a), .f = f};
    bool ok = true;
    put_head(f, r->set);
    for (int i = 0; ok && i < r->set->n; i++)
        ok = (mine && !mine[i]) || print_row(&c, r, i, e);
    arena_close(a);
    return ok;
}

const char *manifest_path(const char *folder, const struct shard *shard, struct arena *a)
{
    return shard->n > 1 ? arena_format(a, "%s/manifest.%d-of-%d.csv", folder, shard->i, shard->n) : arena_format(a, "%s/manifest.csv", folder);
}

bool manifest_write(const char *folder, const struct results *r, const struct shard *shard, const bool *mine, struct err *e)
{
    struct arena *a = arena_open();
    struct outfile f;
    const struct set *s = r->set;
    bool part = shard->n > 1;
    bool ok = outfile_open(&f, manifest_path(folder, shard, a), e);
    if (ok) {
        if (part)
            fprintf(f.stream, "# design: %s\n# build: %s\n# shard: %d of %d\n", s->sha256, s->build, shard->i, shard->n);
        ok = manifest_print(f.stream, r, mine, e) && outfile_commit(&f, e);
        if (!ok)
            outfile_drop(&f);
    }
    arena_close(a);
    return ok;
}

/* ------------------------------------------------------------------ side-car */

static json_t *factor_json(const struct set_factor *f)
{
    json_t *j = json_pack("{s:s, s:s, s:s*}", "LongName", f->name, "Description", f->meaning ? f->meaning : "a factor of the design", "Units", f->unit), *levels = json_object();
    for (int i = 0; i < f->n; i++)
        json_object_set_new(levels, f->values[i], json_string(f->texts[i]));
    json_object_set_new(j, "Levels", levels);
    return j;
}

static json_t *sidecar(const struct set *s)
{
    json_t *j = json_object();
    for (const struct manifest_column *c = manifest_columns; c->name; c++) {
        if (strcmp(c->name, "*") != 0) {
            json_object_set_new(j, c->name, json_pack("{s:s, s:s, s:s*}", "LongName", c->title, "Description", c->meaning, "Units", c->unit));
            continue;
        }
        for (int k = 0; k < s->n_factors; k++)
            json_object_set_new(j, s->factors[k].column, factor_json(&s->factors[k]));
    }
    return j;
}

bool manifest_describe(const char *folder, const struct set *s, struct err *e)
{
    struct outfile f;
    struct arena *a = arena_open();
    bool ok = outfile_open(&f, arena_format(a, "%s/manifest.json", folder), e);
    if (ok) {
        json_t *j = sidecar(s);
        json_dumpf(j, f.stream, JSON_INDENT(2) | JSON_ENSURE_ASCII);
        fputc('\n', f.stream);
        json_decref(j);
        ok = outfile_commit(&f, e);
    }
    arena_close(a);
    return ok;
}
