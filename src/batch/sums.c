/* See sums.h. Names hold nothing that sha256sum would want escaped. */
#include "batch/sums.h"

#include <math.h>

#include "base/outfile.h"
#include "batch/manifest_columns.h"

typedef void put_line(FILE *, const struct set_row *, const struct record *); /* the record NULL: there is none */

static bool put_one(FILE *f, const struct results *all, int i, put_line *put, struct err *e)
{
    struct arena *a = arena_open();
    bool there = all->of[i].record.size != 0;
    const struct record *r = there ? journal_read(all->journal, all->of[i].record, a, e) : NULL;
    bool ok = r || !there;
    if (ok)
        put(f, &all->set->rows[i], r);
    arena_close(a);
    return ok;
}

static bool put_all(FILE *f, const struct results *all, put_line *put, struct err *e)
{
    for (int i = 0; i < all->set->n; i++)
        if (!put_one(f, all, i, put, e))
            return false;
    return true;
}

static void put_sums(FILE *f, const struct set_row *row, const struct record *r)
{
    (void)row;
    for (int i = 0; r && r->job && i < r->n_files; i++)
        if (r->files[i].sha256)
            fprintf(f, "%s  %s\n", r->files[i].sha256, r->files[i].path);
}

static void put_times(FILE *f, const struct set_row *row, const struct record *r)
{
    manifest_columns_text(f, row->name);
    fputc(',', f);
    manifest_columns_number(f, r ? r->wall : HUGE_VAL);
    fputc(',', f);
    manifest_columns_number(f, r ? r->cpu : HUGE_VAL);
    fputc('\n', f);
}

bool sums_write(const char *folder, const struct results *r, struct err *e)
{
    static const char *const own[] = {"manifest.csv", "manifest.json"};
    struct arena *a = arena_open();
    struct outfile f;
    char hex[HASH_TEXT];
    bool ok = outfile_open(&f, arena_format(a, "%s/SHA256SUMS", folder), e);
    if (ok) {
        ok = put_all(f.stream, r, put_sums, e);
        for (int i = 0; ok && i < 2; i++) {
            ok = hash_file(arena_format(a, "%s/%s", folder, own[i]), hex, e);
            fprintf(f.stream, "%s  %s\n", ok ? hex : "", own[i]);
        }
        ok = ok && outfile_commit(&f, e);
        if (!ok)
            outfile_drop(&f);
    }
    arena_close(a);
    return ok;
}

bool sums_timings(const char *folder, const struct results *r, struct err *e)
{
    struct arena *a = arena_open();
    struct outfile f;
    bool ok = outfile_open(&f, arena_format(a, "%s/timings.csv", folder), e);
    if (ok) {
        fputs("stimulus_id,wall_s,cpu_s\n", f.stream);
        ok = put_all(f.stream, r, put_times, e) && outfile_commit(&f, e);
        if (!ok)
            outfile_drop(&f);
    }
    arena_close(a);
    return ok;
}
