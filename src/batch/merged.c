/* See merged.h. */
#include "batch/merged.h"

#include <string.h>
#include <unistd.h>

#include "batch/job.h"
#include "file/bytes.h"
#include "file/csv.h"

struct columns {
    int name, status, job;
};

/* NULL: nothing; else as merge_report's whys. */
static const char *wrong_with(const char *folder, struct journal *j, const char *const *cell, const struct columns *c, struct arena *a)
{
    struct journal_ref ref;
    const char *file = cell[c->name], *state = NULL;
    struct arena *own = arena_open();
    const struct record *r = NULL;
    if (strcmp(cell[c->status], "ok") != 0)
        state = cell[c->status];
    else if (!(r = journal_find(j, cell[c->job], false, own, &ref)))
        state = "is not known here: .rasp/journal is of another set";
    else
        state = job_differs(folder, r, own, &file);
    const char *why = state ? arena_format(a, "%s %s", file, state) : NULL;
    arena_close(own);
    return why;
}

static bool judge(const char *folder, const struct csv *t, const struct columns *c, struct arena *a, struct merge_report *r, struct err *e)
{
    if (access(arena_format(a, "%s/.rasp/journal", folder), R_OK) != 0)
        return err_set(e, ERR_INPUT, "%s: has no manifest.I-of-N.csv and no .rasp/journal: what was rendered elsewhere is copied with its hidden folder .rasp", folder);
    struct journal *j = journal_open(folder, NULL, a, e);
    int wrong = 0;
    if (!j)
        return false;
    r->already = (int)t->rows;
    r->names = ARENA_TAKE(a, const char *, t->rows + 1);
    r->whys = ARENA_TAKE(a, const char *, t->rows + 1);
    for (size_t i = 0; i < t->rows; i++) {
        const char *const *cell = t->cells + i * t->columns, *why = wrong_with(folder, j, cell, c, a);
        r->names[wrong] = why ? cell[c->name] : NULL;
        r->whys[wrong] = why;
        wrong += why != NULL;
    }
    journal_close(j);
    return !wrong || err_set(e, ERR_INPUT, "%s: there is nothing to merge, and %d of the %d stimuli of its manifest.csv are not there as it says: run the shards, or the whole "
                             "batch, again", folder, wrong, r->already);
}

/* "manifest.csv is not as SHA256SUMS says"; NULL: the tables are as they were written. */
static const char *wrong_with_tables(const char *folder, struct arena *a)
{
    static const char *const tables[] = {"manifest.csv", "manifest.json", NULL};
    struct err unreadable = {0};
    struct bytes sums;
    char hex[HASH_TEXT];
    if (!bytes_read(arena_format(a, "%s/SHA256SUMS", folder), a, &sums, &unreadable))
        return "SHA256SUMS is missing";
    for (int i = 0; tables[i]; i++) {
        if (!hash_file(arena_format(a, "%s/%s", folder, tables[i]), hex, &unreadable))
            return arena_format(a, "%s is missing", tables[i]);
        if (!strstr(sums.at, arena_format(a, "%s  %s\n", hex, tables[i])))
            return arena_format(a, "%s is not as SHA256SUMS says", tables[i]);
    }
    return NULL;
}

bool merged_already(const char *folder, struct arena *a, struct merge_report *r, struct err *e)
{
    struct csv t;
    const char *file = arena_format(a, "%s/manifest.csv", folder);
    if (access(file, F_OK) != 0)
        return err_set(e, ERR_INPUT, "%s: has no manifest.I-of-N.csv, as rasp batch --shard leaves them: there is nothing to merge", folder);
    const char *why = wrong_with_tables(folder, a);
    if (why)
        return err_set(e, ERR_INPUT, "%s: there is nothing to merge, and %s: run the shards, or the whole batch, again", folder, why);
    if (!csv_read(file, a, &t, e))
        return false;
    struct columns c = {csv_column(&t, "stimulus_id"), csv_column(&t, "status"), csv_column(&t, "job_hash")};
    if (c.name < 0 || c.status < 0 || c.job < 0)
        return err_set(e, ERR_SCENE, "%s: is no manifest of a set: run the shards, or the whole batch, again", file);
    return judge(folder, &t, &c, a, r, e);
}
