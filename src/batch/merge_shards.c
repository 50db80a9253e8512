/* See merge_shards.h. */
#include "batch/merge_shards.h"

#include <dirent.h>
#include <stdlib.h>
#include <unistd.h>

#include "batch/claim.h"
#include "batch/shard.h"
#include "file/csv.h"

static int is_part(const struct dirent *d)
{
    struct shard s;
    return shard_of_manifest(d->d_name, &s);
}

void merge_shards_find(const char *folder, struct arena *a, struct merge_shards *s)
{
    struct dirent **found;
    int n = scandir(folder, &found, is_part, alphasort);
    *s = (struct merge_shards){.folder = folder, .files = ARENA_TAKE(a, const char *, n > 0 ? n : 0), .missing = ""};
    for (int i = 0; i < n; i++) {
        s->files[s->n++] = arena_text(a, found[i]->d_name);
        free(found[i]);
    }
    if (n >= 0)
        free(found);
}

bool merge_shards_agree(struct merge_shards *s, struct err *e)
{
    struct shard one;
    for (int i = 0; i < s->n; i++) {
        shard_of_manifest(s->files[i], &one);
        if (s->of && one.n != s->of)
            return err_set(e, ERR_SCENE, "%s: %s and %s are of different divisions of the set: remove those of the one that is out of date", s->folder, s->files[0], s->files[i]);
        s->of = one.n;
    }
    return true;
}

bool merge_shards_complete(struct merge_shards *s, struct arena *a, struct err *e)
{
    struct shard one;
    int missing = 0;
    bool *seen = ARENA_TAKE(a, bool, s->of + 1);
    for (int i = 0; i < s->n; i++) {
        shard_of_manifest(s->files[i], &one);
        seen[one.i] = true;
    }
    for (int i = 1; i <= s->of; i++)
        if (!seen[i]) {
            s->missing = arena_format(a, "%s%s%d", s->missing, missing ? "," : "", i);
            missing++;
        }
    return !missing || err_set(e, ERR_INPUT, "%s: %d of %d shards %s missing: --array=%s", s->folder, missing, s->of, missing == 1 ? "is" : "are", s->missing);
}

bool merge_shards_swept(const struct merge_shards *s, struct arena *a)
{
    bool swept = access(arena_format(a, "%s/.rasp/set.json", s->folder), F_OK) != 0 && access(arena_format(a, "%s/manifest.csv", s->folder), F_OK) == 0;
    for (int i = 0; i < s->n && swept; i++) {
        struct csv t;
        struct err unreadable = {0};
        const char *design = csv_read(arena_format(a, "%s/%s", s->folder, s->files[i]), a, &t, &unreadable) ? csv_comment(&t, "design") : NULL;
        swept = design && claim_holds(s->folder, design, a);
    }
    return swept;
}
