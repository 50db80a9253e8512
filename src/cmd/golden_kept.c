/* What is kept of the scenes of `rasp golden`: files, hashes, or both. */
#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cmd/golden.h"
#include "file/bytes.h"

enum { GAP = 2 /* of blanks between hash and name; the second may be * */ };

static int by_name(const void *a, const void *b)
{
    return strcmp(((const struct golden_file *)a)->name, ((const struct golden_file *)b)->name);
}

void golden_kept_sort(struct golden_files *files)
{
    if (files->n)
        qsort(files->list, (size_t)files->n, sizeof *files->list, by_name);
}

const struct golden_file *golden_kept_find(const struct golden_files *files, const char *name)
{
    for (int i = 0; i < files->n; i++)
        if (!strcmp(files->list[i].name, name))
            return &files->list[i];
    return NULL;
}

/* ------------------------------------------------------------------ hashes */

static bool sum_read(const struct golden *g, char *line, int number, struct golden_sum *sum, struct err *e)
{
    size_t n = HASH_TEXT - 1;
    bool good = strlen(line) > n + GAP && strspn(line, "0123456789abcdef") == n && line[n] == ' ' && strchr(" *", line[n + 1]);
    if (!good || !strchr(line + n + GAP, '/'))
        return err_set(e, ERR_SCENE, "%s:%d: is not of the form SHA256  NAME/FILE, as rasp golden update writes it", g->hashes, number);
    line[n] = '\0';
    memcpy(sum->sha256, line, HASH_TEXT);
    sum->name = line + n + GAP;
    return true;
}

bool golden_kept_read(struct golden *g, struct err *e)
{
    struct bytes b;
    int number = 0, most = 1;
    if (!g->hashes)
        return true;
    if (!bytes_read(g->hashes, g->call->arena, &b, e))
        return false;
    for (const char *p = b.at; *p; p++)
        most += *p == '\n';
    g->sums = ARENA_TAKE(g->call->arena, struct golden_sum, most);
    for (char *p = b.at, *next; p; p = next) {
        next = strchr(p, '\n');
        if (next)
            *next++ = '\0';
        p[strcspn(p, "\r")] = '\0';
        number++;
        if (*p && !sum_read(g, p, number, &g->sums[g->n_sums++], e))
            return false;
    }
    return true;
}

/* What the line is of: FILE of NAME/FILE; NULL: of another scene. */
static const char *file_of(const struct golden_sum *sum, const char *scene)
{
    size_t n = strlen(scene);
    return !strncmp(sum->name, scene, n) && sum->name[n] == '/' ? sum->name + n + 1 : NULL;
}

const struct golden_sum *golden_kept_sum(const struct golden *g, const char *scene, const char *file, struct arena *a)
{
    const char *name = arena_format(a, "%s/%s", scene, file);
    for (int i = 0; i < g->n_sums; i++)
        if (!strcmp(g->sums[i].name, name))
            return &g->sums[i];
    return NULL;
}

static struct golden_files in_sums(const struct golden *g, const char *scene, struct arena *a)
{
    struct golden_files files = {ARENA_TAKE(a, struct golden_file, g->n_sums + 1), 0};
    for (int i = 0; i < g->n_sums; i++) {
        const char *file = file_of(&g->sums[i], scene);
        if (!file)
            continue;
        files.list[files.n].name = file;
        memcpy(files.list[files.n++].sha256, g->sums[i].sha256, HASH_TEXT);
    }
    golden_kept_sort(&files);
    return files;
}

/* ------------------------------------------------------------------ files */

static bool is_kept(const char *name)
{
    const char *dot = strrchr(name, '.');
    return *name != '.' && dot && (!strcmp(dot, ".wav") || !strcmp(dot, ".csv") || !strcmp(dot, ".npy"));
}

/* Sounds and tables in a folder, without hashes; none where there is no such folder. */
static struct golden_files in_folder(const char *folder, struct arena *a)
{
    struct golden_files files = {NULL, 0};
    DIR *d = opendir(folder);
    int room = 0;
    for (struct dirent *entry; d && (entry = readdir(d));) {
        if (!is_kept(entry->d_name))
            continue;
        if (files.n == room) {
            struct golden_file *more = ARENA_TAKE(a, struct golden_file, room = 2 * room + 8);
            if (files.n)
                memcpy(more, files.list, (size_t)files.n * sizeof *more);
            files.list = more;
        }
        files.list[files.n++].name = arena_text(a, entry->d_name);
    }
    if (d)
        closedir(d);
    golden_kept_sort(&files);
    return files;
}

struct golden_files golden_kept_of(const struct golden *g, const char *scene, struct arena *a, struct err *e)
{
    if (!g->kept)
        return in_sums(g, scene, a);
    const char *folder = arena_format(a, "%s/%s", g->kept, scene);
    struct golden_files files = in_folder(folder, a);
    for (int i = 0; i < files.n; i++)
        hash_file(arena_format(a, "%s/%s", folder, files.list[i].name), files.list[i].sha256, e);
    return files;
}

/* ------------------------------------------------------------------ strays */

struct strays {
    const char **list;
    int n, room;
};

static void stray(struct strays *all, const char *name, struct arena *a)
{
    if (all->n + 1 >= all->room) {
        const char **more = ARENA_TAKE(a, const char *, all->room = 2 * all->room + 16);
        if (all->n)
            memcpy(more, all->list, (size_t)all->n * sizeof *more);
        all->list = more;
    }
    all->list[all->n++] = name;
}

static bool is_scene(const struct golden *g, const char *name, size_t n)
{
    for (int i = 0; i < g->n; i++)
        if (strlen(g->scenes[i].name) == n && !strncmp(g->scenes[i].name, name, n))
            return true;
    return false;
}

static void strays_in_kept(const struct golden *g, struct strays *all, struct arena *a)
{
    struct dirent **entries;
    int n = scandir(g->kept, &entries, NULL, alphasort);
    for (int i = 0; i < n; i++) {
        const char *name = entries[i]->d_name;
        if (*name != '.' && is_kept(name))
            stray(all, arena_text(a, name), a);
        if (*name != '.' && !is_scene(g, name, strlen(name))) {
            struct golden_files files = in_folder(arena_format(a, "%s/%s", g->kept, name), a);
            for (int k = 0; k < files.n; k++)
                stray(all, arena_format(a, "%s/%s", name, files.list[k].name), a);
        }
        free(entries[i]);
    }
    if (n >= 0)
        free(entries);
}

const char **golden_kept_strays(const struct golden *g, struct arena *a)
{
    struct strays all = {ARENA_TAKE(a, const char *, 16), 0, 16};
    if (g->kept)
        strays_in_kept(g, &all, a);
    for (int i = 0; i < g->n_sums; i++)
        if (!is_scene(g, g->sums[i].name, strcspn(g->sums[i].name, "/")))
            stray(&all, arena_format(a, "%s, in %s", g->sums[i].name, g->hashes), a);
    all.list[all.n] = NULL;
    return all.list;
}
