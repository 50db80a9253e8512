/* See shard.h: longest processing time first (Graham 1969). The least loaded shard is kept on top of a heap, ordered by load, then by number. */
#include "batch/shard.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"

bool shard_read(const char *text, struct shard *s, struct err *e)
{
    char left[8] = "";
    const char *slash = strchr(text, '/');
    size_t n = slash ? (size_t)(slash - text) : sizeof left;
    if (n < sizeof left)
        memcpy(left, text, n);
    if (slash && n < sizeof left && text_int(slash + 1, 1, SHARD_MOST, &s->n) && text_int(left, 1, s->n, &s->i))
        return true;
    return err_set(e, ERR_USAGE, "--shard %s: write i/n, with n from 1 to %d and i from 1 to n, as in --shard 3/7", text, SHARD_MOST);
}

bool shard_of_manifest(const char *name, struct shard *s)
{
    char text[32];
    const char *of = strstr(name, "-of-"), *dot = of ? strstr(of, ".csv") : NULL;
    if (strncmp(name, "manifest.", 9) != 0 || !of || !dot || dot[4] || dot - name > 30)
        return false;
    snprintf(text, sizeof text, "%.*s/%.*s", (int)(of - name - 9), name + 9, (int)(dot - of - 4), of + 4);
    struct err e = {0};
    return shard_read(text, s, &e);
}

void shard_sweep(const char *folder)
{
    struct shard s;
    DIR *d = opendir(folder);
    if (d)
        unlinkat(dirfd(d), ".rasp/set.json", 0); /* first: manifests without it are of a set that is done (merge.c) */
    for (struct dirent *entry; d && (entry = readdir(d));)
        if (shard_of_manifest(entry->d_name, &s))
            unlinkat(dirfd(d), entry->d_name, 0);
    if (d)
        closedir(d);
}

struct dear {
    double cost;
    int at;
};

static int dearest_first(const void *a, const void *b)
{
    const struct dear *p = a, *q = b;
    return p->cost != q->cost ? (p->cost > q->cost ? -1 : 1) : p->at - q->at;
}

static bool less(const double *load, int a, int b)
{
    return load[a] != load[b] ? load[a] < load[b] : a < b;
}

/* The top has become heavier. */
static void sink(int *heap, int n, const double *load)
{
    for (int at = 0, child; (child = 2 * at + 1) < n; at = child) {
        if (child + 1 < n && less(load, heap[child + 1], heap[child]))
            child++;
        if (!less(load, heap[child], heap[at]))
            return;
        int kept = heap[at];
        heap[at] = heap[child];
        heap[child] = kept;
    }
}

void shard_assign(const double *cost, int n, int shards, int *to, struct arena *a)
{
    struct dear *order = ARENA_TAKE(a, struct dear, n);
    double *load = ARENA_TAKE(a, double, shards);
    int *heap = ARENA_TAKE(a, int, shards);
    for (int k = 0; k < shards; k++)
        heap[k] = k;
    for (int k = 0; k < n; k++)
        order[k] = (struct dear){cost[k], k};
    qsort(order, (size_t)n, sizeof *order, dearest_first);
    for (int k = 0; k < n; k++) {
        to[order[k].at] = heap[0] + 1;
        load[heap[0]] += order[k].cost;
        sink(heap, shards, load);
    }
}
