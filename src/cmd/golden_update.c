/* rasp golden update: all scenes rendered, then all once more; only if every file has the same bytes twice is what they made kept. What can fail is done for every
   file before the first takes its name, and the hashes take theirs last. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/outfile.h"
#include "base/text.h"
#include "batch/pool.h"
#include "cmd/golden.h"
#include "cmd/tell.h"
#include "file/bytes.h"
#include "output/mark.h"

/* ------------------------------------------------------------------ twice */

struct pass {
    const struct golden *g;
    int number;
};

static bool render_one(void *self, int i)
{
    const struct pass *p = self;
    struct golden_scene *s = &p->g->scenes[i];
    return golden_render(p->g, s, p->number, NULL, &s->failed) && !interrupt_seen();
}

static bool none_failed(const struct golden *g, struct err *e)
{
    for (int i = 0; i < g->n; i++)
        if (g->scenes[i].failed.kind)
            return err_set(e, g->scenes[i].failed.kind, "%s%s", g->scenes[i].at, g->scenes[i].failed.text);
    return true;
}

/* The second pass begins when the first is over: what one render leaves behind for the next would show. */
static bool render_twice(const struct golden *g, struct err *e)
{
    for (int pass = 0; pass < 2; pass++) {
        struct pass p = {g, pass};
        int done = none_failed(g, e) ? pool_run(&(struct pool_work){.n = g->n, .threads = g->threads, .context = &p, .job = render_one}) : 0;
        if (!none_failed(g, e))
            return false;
        if (done < g->n)
            return err_set(e, ERR_INTERRUPTED, "interrupted; nothing was written, run the same command again");
    }
    return true;
}

static bool same_twice(const struct golden *g, struct err *e)
{
    int unequal = 0;
    for (int i = 0; i < g->n; i++) {
        struct golden_scene *s = &g->scenes[i];
        golden_judge_twice(g, s);
        if (s->n_problems && unequal++ == 0)
            golden_report_begin(g, g->n);
        if (s->n_problems)
            golden_report_scene(g, s, i + 1);
    }
    return !unequal || err_set(e, ERR_DIFFERS, "%d scene%s not the same bytes twice, or nothing to keep: nothing was written", unequal, unequal == 1 ? " has" : "s have");
}

/* ------------------------------------------------------------------ writing */

struct writing {
    struct golden *g;
    struct outfile *files;       /* [n]: of what changes */
    int n;
    const char **gone;           /* ends with NULL: kept so far, and not made any more */
    int n_gone, changed;
    const char **made;           /* [n_made]: folders that were not there; until the commit they go with the program */
    int n_made;
};

static bool make_folder(struct writing *w, const char *folder, struct err *e)
{
    interrupt_hold();
    bool made = mkdir(folder, 0777) == 0;
    int why = errno;
    if (made) {
        interrupt_temporary(folder);
        w->made[w->n_made++] = folder;
    }
    interrupt_go();
    return made || why == EEXIST || err_set(e, ERR_CREATE, "the folder %s cannot be created: %s", folder, strerror(why));
}

static void forget_folders(const struct writing *w)
{
    for (int i = 0; i < w->n_made; i++)
        interrupt_forget(w->made[i]);
}

/* How far the table's columns are named: a CSV's first line, an NPY's dtype. */
static size_t columns_of(const struct bytes *b)
{
    const char *shape = b->n > 6 && !memcmp(b->at, "\x93NUMPY", 6) ? memmem(b->at, b->n, "'shape'", 7) : NULL, *line = memchr(b->at, '\n', b->n);
    return shape ? (size_t)(shape - b->at) : line ? (size_t)(line - b->at) : b->n;
}

/* The rule of output/mark.h. Nothing lies beside a kept table that names it: it is known as an earlier state of the one that takes its place by the same columns. */
static bool may_replace(const struct golden *g, const struct bytes *made, const char *to, struct arena *a, struct err *e)
{
    struct err why = {0}, unreadable = {0};
    struct stat link;
    struct bytes old;
    if (mark_permits(to, NULL, args_given(&g->call->args, "force"), &why))
        return true;
    size_t n = columns_of(made), length = strlen(to);
    bool table = lstat(to, &link) == 0 && S_ISREG(link.st_mode) && length > 4 && strcmp(to + length - 4, ".wav") != 0;
    bool same = table && bytes_read(to, a, &old, &unreadable) && columns_of(&old) == n && !memcmp(old.at, made->at, n);
    return (same && n > 0) || err_set(e, why.kind, "%s; nothing was written", why.text);
}

static bool copy(struct writing *w, const char *from, const char *to, struct err *e)
{
    struct outfile *o = &w->files[w->n];
    struct arena *a = arena_open();
    struct bytes b;
    bool ok = bytes_read(from, a, &b, e) && may_replace(w->g, &b, to, a, e) && outfile_open(o, to, e);
    if (ok) {
        w->n++;
        outfile_put(o, b.at, b.n);
        ok = outfile_settle(o, e);
    }
    arena_close(a);
    return ok;
}

static void say(const struct golden *g, const char *what, const char *scene, const char *file)
{
    if (!g->quiet)
        printf("%-7s %s/%s\n", what, scene, text_shown(g->call->arena, file));
}

/* What a scene made takes the place of all that was kept of it. */
static bool write_scene(struct writing *w, const struct golden_scene *s, struct err *e)
{
    struct golden *g = w->g;
    struct arena *a = g->call->arena;
    struct golden_files kept = golden_kept_of(g, s->name, a, e);
    const char *folder = arena_format(a, "%s/%s", g->kept ? g->kept : "", s->name);
    if (e->kind || (g->kept && !make_folder(w, folder, e)))
        return false;
    for (int i = 0; i < s->made[0].n; i++) {
        const struct golden_file *made = &s->made[0].list[i], *old = golden_kept_find(&kept, made->name);
        bool same = old && strcmp(old->sha256, made->sha256) == 0;
        w->changed += !same;
        say(g, same ? "same" : old ? "changed" : "new", s->name, made->name);
        if (g->kept && !same && !copy(w, golden_render_path(g, s, 0, made->name, a), arena_format(a, "%s/%s", folder, made->name), e))
            return false;
    }
    for (int i = 0; i < kept.n; i++)
        if (!golden_kept_find(&s->made[0], kept.list[i].name)) {
            w->changed++;
            say(g, "removed", s->name, kept.list[i].name);
            if (g->kept)
                w->gone[w->n_gone++] = arena_format(a, "%s/%s", folder, kept.list[i].name);
        }
    return true;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(((const struct golden_sum *)a)->name, ((const struct golden_sum *)b)->name);
}

static bool is_ours(const struct golden *g, const char *sum)
{
    size_t n = strcspn(sum, "/");
    for (int i = 0; i < g->n; i++)
        if (strlen(g->scenes[i].name) == n && !strncmp(g->scenes[i].name, sum, n))
            return true;
    return false;
}

/* Lines of other scenes stay, but where lists say what all scenes are. */
static bool write_hashes(struct writing *w, struct err *e)
{
    struct golden *g = w->g;
    int n = 0, most = g->n_sums;
    for (int i = 0; i < g->n; i++)
        most += g->scenes[i].made[0].n;
    struct golden_sum *all = ARENA_TAKE(g->call->arena, struct golden_sum, most);
    for (int i = 0; i < g->n_sums; i++)
        if (!g->whole && !is_ours(g, g->sums[i].name))
            all[n++] = g->sums[i];
    for (int i = 0; i < g->n; i++)
        for (int k = 0; k < g->scenes[i].made[0].n; k++, n++) {
            all[n].name = arena_format(g->call->arena, "%s/%s", g->scenes[i].name, g->scenes[i].made[0].list[k].name);
            memcpy(all[n].sha256, g->scenes[i].made[0].list[k].sha256, HASH_TEXT);
        }
    qsort(all, (size_t)n, sizeof *all, by_name);
    struct outfile *o = &w->files[w->n];
    if (!mark_links(g->hashes, args_given(&g->call->args, "force"), e) || !outfile_open(o, g->hashes, e))
        return false;
    w->n++;
    for (int i = 0; i < n; i++)
        fprintf(o->stream, "%s  %s\n", all[i].sha256, all[i].name);
    return outfile_settle(o, e);
}

/* Every file that is about to be complete is open. */
static void allow_files(int n)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= (rlim_t)n + 64)
        return;
    limit.rlim_cur = limit.rlim_max;
    setrlimit(RLIMIT_NOFILE, &limit);
}

static bool settle_all(struct writing *w, struct err *e)
{
    struct golden *g = w->g;
    if (g->kept && !make_folder(w, g->kept, e))
        return false;
    for (int i = 0; i < g->n; i++)
        if (!write_scene(w, &g->scenes[i], e))
            return false;
    return !g->hashes || write_hashes(w, e);
}

static bool commit_all(struct writing *w, struct err *e)
{
    int files = w->n - (w->g->hashes != NULL);
    for (int i = 0; i < files; i++)
        if (!outfile_commit(&w->files[i], e))
            return false;
    for (int i = 0; i < w->n_gone; i++)
        if (unlink(w->gone[i]) != 0)
            return err_set(e, ERR_IO, "%s: cannot be removed: %s", w->gone[i], strerror(errno));
    return files == w->n || outfile_commit(&w->files[files], e);
}

static bool write_all(struct golden *g, struct writing *w, struct err *e)
{
    struct arena *a = g->call->arena;
    int most = 1, gone = 1;
    for (int i = 0; i < g->n; i++) {
        most += g->scenes[i].made[0].n;
        gone += golden_kept_of(g, g->scenes[i].name, a, e).n;
    }
    *w = (struct writing){.g = g, .files = ARENA_TAKE(a, struct outfile, most), .gone = ARENA_TAKE(a, const char *, gone), .made = ARENA_TAKE(a, const char *, g->n + 1)};
    for (int i = 0; i < most; i++)
        w->files[i].fd = -1;
    allow_files(most);
    bool ok = !e->kind && settle_all(w, e);
    interrupt_hold();
    if (ok)
        forget_folders(w);
    ok = ok && commit_all(w, e);
    interrupt_go();
    for (int i = 0; i < w->n; i++)
        outfile_drop(&w->files[i]);
    for (int i = 0; !ok && g->kept && i < g->n; i++)
        rmdir(arena_format(a, "%s/%s", g->kept, g->scenes[i].name)); /* where nothing was in it */
    forget_folders(w);
    return ok;
}

int golden_update(struct golden *g, struct err *e)
{
    struct writing w;
    if (g->hashes && access(g->hashes, F_OK) == 0 && !golden_kept_read(g, e))
        return (int)e->kind;
    if (!none_failed(g, e) || !render_twice(g, e) || !same_twice(g, e) || !write_all(g, &w, e))
        return (int)e->kind;
    if (!g->quiet)
        printf("%d scene%s rendered twice; %d file%s changed\n", g->n, g->n == 1 ? "" : "s", w.changed, w.changed == 1 ? "" : "s");
    const char **strays = g->whole ? golden_kept_strays(g, g->call->arena) : NULL;
    for (; g->kept && strays && *strays; strays++)
        tell_warning(g->call, *strays, "no scene makes it; rasp golden check will fail until it is removed");
    return 0;
}
