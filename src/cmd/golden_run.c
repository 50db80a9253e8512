/* The renders of `rasp golden`, each in a folder of its own: WORK/NAME/first/, WORK/NAME/again/. */
#include "cmd/golden.h"

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/outfile.h"
#include "base/relpath.h"
#include "base/text.h"
#include "batch/pool.h"
#include "cmd/message.h"
#include "file/bytes.h"
#include "file/wav.h"
#include "output/mark.h"
#include "output/picture.h"
#include "pipeline/render.h"
#include "scene/scene_places.h"
#include "scene/scene_read.h"

static const char *const passes[2] = {"first", "again"};

bool golden_run_folder(struct golden *g, struct err *e)
{
    const char *given = args_value(&g->call->args, "output");
    struct stat st;
    if (given) {
        g->work = given;
        g->stays = true;
        return (stat(given, &st) == 0 && S_ISDIR(st.st_mode)) || mkdir(given, 0777) == 0 ||
               err_set(e, ERR_CREATE, "the folder %s cannot be created: %s", given, strerror(errno));
    }
    g->work = outfile_scratch_make_folder("rasp-golden", g->call->arena, e);
    return g->work != NULL;
}

static const char *path_of(const struct golden *g, const struct golden_scene *s, int pass, const char *file,
                           struct arena *a)
{
    return arena_format(a, "%s/%s/%s/%s", g->work, s->name, passes[pass], file);
}

static bool render(const struct golden *g, struct golden_scene *s, int pass, const char *from, struct err *e)
{
    struct arena *a = arena_open();
    const char *base = path_of(g, s, pass, "sound", a), *messages = "";
    struct scene read;
    struct render_report report;
    const char *folder = path_of(g, s, pass, "", a), *outer = arena_format(a, "%s/%s", g->work, s->name);
    interrupt_hold();
    bool ok = (mkdir(outer, 0777) == 0 || errno == EEXIST) && (mkdir(folder, 0777) == 0 || errno == EEXIST);
    interrupt_go();
    if (!ok)
        err_set(e, ERR_CREATE, "the folder %s cannot be created: %s", arena_text(s->arena, folder), strerror(errno));
    ok = ok && (!from || scene_read(from, NULL, a, &read, &messages, e)) &&
         (render_scene(from ? &read : &s->scene, base, a, &report, e) ||
          scene_places_report(from ? &read : &s->scene, e));
    s->made[pass] = (struct golden_files){NULL, 0};
    for (int i = 0; ok && i < report.n_files; i++) { /* sounds and tables, with their hashes */
        const struct render_file *f = &report.files[i];
        if (!strcmp(f->kind, "scene") || !strcmp(f->kind, "summary")) continue;
        struct golden_file *to = golden_add(&s->made[pass], arena_text(s->arena, basename(f->path)), s->arena);
        ok = hash_file(f->path, to->sha256, e);
    }
    golden_sort(&s->made[pass]);
    arena_close(a);
    return ok;
}

/* ------------------------------------------------------------------ away with it */

/* What a render writes: no folder in it, and nothing of somebody else's. */
static void clear_renders(const struct golden *g, const struct golden_scene *s)
{
    static const char *const endings[] = {".wav", ".csv", ".npy", ".json", ".yaml", ".png", NULL};
    for (int pass = 0; pass < 2; pass++) {
        const char *folder = path_of(g, s, pass, "", s->arena);
        DIR *d = opendir(folder);
        for (struct dirent *entry; d && (entry = readdir(d));) {
            const char *dot = strrchr(entry->d_name, '.');
            if (dot && !strncmp(entry->d_name, "sound.", 6) && text_is_one(dot, endings))
                unlinkat(dirfd(d), entry->d_name, 0);
        }
        if (d) closedir(d);
        rmdir(folder);
    }
    rmdir(arena_format(s->arena, "%s/%s", g->work, s->name));
}

void golden_run_end(const struct golden *g)
{
    for (int i = 0; g->work && !g->stays && i < g->n; i++)
        clear_renders(g, &g->scenes[i]);
    if (g->work) {
        rmdir(g->work);
        interrupt_forget(g->work);
    }
}

/* What `rasp golden` has against a scene: files that are missing, stray, or not the same bytes; of these, how far they
 * are off, by `rasp compare`. */

static void __attribute__((format(printf, 4, 5)))
problem(struct golden_scene *s, const char *file, const char *report, const char *format, ...)
{
    char text[1200];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    s->problems = arena_more(s->arena, s->problems, s->n_problems, sizeof *s->problems);
    s->problems[s->n_problems++] = (struct golden_problem){file, arena_text(s->arena, text), report};
}

/* The first file is what it should be. `what`: "what is kept". */
static void judge_bytes(struct golden_scene *s, const char *name, const char *const files[2], const char *what)
{
    struct err why = {0};
    char *text = NULL;
    size_t size;
    bool sound = false;
    struct arena *a = arena_open();
    FILE *out = open_memstream(&text, &size);
    int code = ERR_MEMORY; /* as `rasp compare` sees them: 0, ERR_DIFFERS, or its error */
    if (out && compare_is_sound(files[1], &sound, &why)) {
        struct compare_ask ask = sound ? s->sounds : s->tables;
        memcpy(ask.files, files, sizeof ask.files);
        ask.out = out;
        ask.arena = a;
        code = sound ? compare_sound(&ask, &why) : compare_table(&ask, &why);
    }
    if (out) fclose(out);
    const char *report = arena_text(s->arena, text ? text : "");
    free(text);
    arena_close(a);
    sound = text_ends(name, ".wav");
    bool exact = sound ? s->sounds.exact : s->tables.exact;
    if (why.kind)
        problem(s, name, NULL, "is not %s, and cannot be compared with it: %s", what, why.text);
    else if (code)
        problem(s, name, report, "is not %s%s", what, exact ? "" : ", nor within its tolerances");
    else if (exact)
        problem(s, name, NULL, "has the same %s as %s, but not the same bytes: what stands around them differs",
                sound ? "samples" : "cells", what);
    else
        s->note = arena_format(s->arena, "%s%s%s", s->note ? s->note : "", s->note ? ", " : "", name);
}

/* Spectrograms of what is kept, of what was made and of their difference, one below the other on one scale: of the
   channel that differs most. Sounds of different rates have no difference. */
static void draw_difference(struct golden_scene *s, const char *name, const char *const files[2])
{
    enum { WIDTH = 800, HEIGHT = 160, LINE = 3, EACH = (HEIGHT + LINE) * WIDTH };
    struct arena *a = arena_open();
    struct wav w[2];
    struct err why = {0};
    if (wav_read(files[0], a, &w[0], &why) && wav_read(files[1], a, &w[1], &why) && w[0].rate == w[1].rate) {
        int both = w[0].channels < w[1].channels ? w[0].channels : w[1].channels, most = 0;
        size_t n = w[0].frames > w[1].frames ? w[0].frames : w[1].frames;
        double *x[3], greatest = -1;
        struct picture_axes axes = picture_axes_make(w[0].rate, HEIGHT);
        unsigned char *cells = ARENA_TAKE(a, unsigned char, 3 * EACH);
        const char *target = arena_format(a, "%s.png", relpath_base(files[1], a));
        for (int c = 0; c < both; c++)
            for (size_t i = 0; i < n; i++) {
                double off = fabs((i < w[0].frames ? w[0].x[i * (size_t)w[0].channels + (size_t)c] : 0) -
                                  (i < w[1].frames ? w[1].x[i * (size_t)w[1].channels + (size_t)c] : 0));
                most = off > greatest ? c : most;
                greatest = fmax(off, greatest);
            }
        memset(cells, PICTURE_LINE, 3 * EACH);
        for (int k = 0; k < 3; k++)
            x[k] = ARENA_TAKE(a, double, n);
        for (int k = 0; k < 2; k++)
            for (size_t i = 0; i < w[k].frames; i++)
                x[k][i] = w[k].x[i * (size_t)w[k].channels + (size_t)most];
        for (size_t i = 0; i < n; i++)
            x[2][i] = x[1][i] - x[0][i];
        for (int k = 0; k < 3; k++)
            picture_cells(x[k], n, w[0].rate, &axes, WIDTH, cells + k * EACH);
        if (mark_permits(target, NULL, false, &why))
            picture_write(target, cells, WIDTH, 3 * (HEIGHT + LINE) - LINE, picture_top(cells, 3 * EACH), &why);
    }
    if (why.kind) problem(s, name, NULL, "has no picture of the difference: %s", why.text);
    arena_close(a);
}

static void judge_file(const struct golden *g, struct golden_scene *s, const struct golden_file *saved, int pass)
{
    const struct golden_file *made = golden_find(&s->made[pass], saved->name);
    const char *new = path_of(g, s, pass, saved->name, s->arena),
               *old = arena_format(s->arena, "%s.png", relpath_base(new, s->arena)); /* of an earlier check */
    struct err why = {0};
    if (g->stays && wav_is_name(new) && mark_permits(old, NULL, false, &why)) unlink(old);
    if (pass == 0 && g->hashes && g->saved) { /* is the kept file the one that was written? */
        const struct golden_file *sum = golden_find(&g->sums, arena_format(s->arena, "%s/%s", s->name, saved->name));
        if (!sum)
            problem(s, saved->name, NULL, "has no hash in %s", g->hashes);
        else if (strcmp(sum->sha256, saved->sha256) != 0)
            problem(s, saved->name, NULL,
                    "the kept file is not the one whose hash is kept in %s: it was changed or damaged since",
                    g->hashes);
    }
    if (!made)
        problem(s, saved->name, NULL, "is kept, but not made any more");
    else if (strcmp(made->sha256, saved->sha256) == 0)
        return;
    else if (g->saved) {
        const char *files[] = {arena_format(s->arena, "%s/%s/%s", g->saved, s->name, saved->name), new};
        int before = s->n_problems;
        judge_bytes(s, saved->name, files, pass ? "what is kept (rendered from the effective scene)" : "what is kept");
        if (g->stays && s->n_problems > before && wav_is_name(saved->name)) draw_difference(s, saved->name, files);
    } else
        problem(
            s, saved->name, NULL,
            "is not what is kept%s: its sha256 is %s, where %s has %s; how far it is off only kept files could tell",
            pass ? " (rendered from the effective scene)" : "", made->sha256, g->hashes, saved->sha256);
}

/* what was made against what is kept       */
static void judge(const struct golden *g, struct golden_scene *s, int pass)
{
    struct err why = {0};
    struct golden_files saved = golden_files_of(g, s->name, s->arena, &why);
    if (why.kind)
        problem(s, "", NULL, "%s", why.text);
    else if (s->made[pass].n == 0)
        problem(s, "", NULL, "it makes neither a sound nor a table: there is nothing to keep");
    else if (saved.n == 0) {
        struct arena *a = s->arena;
        problem(s, "", NULL, "nothing is kept of it; this makes it: rasp golden update%s%s%s%s %s",
                g->saved ? " --kept " : "", g->saved ? g->saved : "", g->hashes ? " --hashes " : "",
                g->hashes ? g->hashes : "",
                *s->at ? arena_format(a, "%.*s", (int)(strchr(s->at, ':') - s->at), s->at) : s->file);
    }
    for (int i = 0; !why.kind && i < saved.n; i++)
        judge_file(g, s, &saved.list[i], pass);
    for (int i = 0; !why.kind && saved.n && i < s->made[pass].n; i++)
        if (!golden_find(&saved, s->made[pass].list[i].name))
            problem(s, s->made[pass].list[i].name, NULL, "is made, but not kept");
}

/* rasp golden check: every scene rendered, and again from its effective scene where that is asked for, against what is
 * kept. */

static bool interrupted(const struct golden_scene *s) { return s->failed.kind == ERR_INTERRUPTED || interrupt_seen(); }

/* By any thread; all that it touches is the scene's own. */
static bool check_scene(void *self, int i)
{
    const struct golden *g = self;
    struct golden_scene *s = &g->scenes[i];
    if (!s->failed.kind && render(g, s, 0, NULL, &s->failed)) {
        judge(g, s, 0);
        bool again = g->effective && s->n_problems == 0;
        if (again && render(g, s, 1, path_of(g, s, 0, "sound.scene.yaml", s->arena), &s->failed))
            judge(g, s, 1);
        else if (again)
            err_at(&s->failed, "rendered from the effective scene");
    }
    return !interrupted(s);
}

static void check_took(void *self, int i)
{
    const struct golden *g = self;
    struct golden_scene *s = &g->scenes[i];
    if (interrupted(s)) return;
    if (s->failed.kind) problem(s, "", NULL, "%s", s->failed.text);
    golden_report_scene(g, s, i + 1);
    if (!g->stays || s->n_problems == 0) clear_renders(g, s);
}

int golden_run_check(struct golden *g, struct err *e)
{
    int points = g->n + g->whole, good = 0, code = 0;
    const char **strays = NULL;
    struct outfile o = {0};
    if (!golden_read_hashes(g, e)) return (int)e->kind;
    if (g->junit &&
        (!mark_permits(g->junit, NULL, args_given(&g->call->args, "force"), e) || !outfile_open(&o, g->junit, e)))
        return (int)e->kind;
    if (g->tap) printf("TAP version 13\n1..%d\n", points);
    if (pool_run(&(struct pool_work){
            .n = g->n, .threads = g->threads, .context = g, .job = check_scene, .took = check_took}) < g->n ||
        interrupt_seen()) {
        err_set(e, ERR_INTERRUPTED, "interrupted; run the same command again");
        outfile_drop(&o);
        return (int)e->kind;
    }
    for (int i = 0; i < g->n; i++) {
        good += g->scenes[i].n_problems == 0;
        code = code ? code : (int)g->scenes[i].failed.kind;
    }
    if (g->whole) {
        strays = golden_strays(g, g->call->arena);
        golden_report_strays(g, strays, points);
        good += !*strays;
    }
    if (g->junit) golden_report_junit(g, strays, o.stream);
    if (g->junit && !outfile_commit(&o, e)) return (int)e->kind;
    if (!g->tap && (!g->quiet || good < points)) printf("%d passed, %d failed\n", good, points - good);
    return code ? code : good < points ? ERR_DIFFERS : 0;
}

/* rasp golden update: all scenes rendered, then all once more; only if every file has the same bytes twice is what they
   made kept. What can fail is done for every file before the first takes its name, and the hashes take theirs last. */

/* ------------------------------------------------------------------ twice */

struct pass {
    const struct golden *g;
    int number;
};

static bool render_one(void *self, int i)
{
    const struct pass *p = self;
    struct golden_scene *s = &p->g->scenes[i];
    return render(p->g, s, p->number, NULL, &s->failed) && !interrupt_seen();
}

static bool none_failed(const struct golden *g, struct err *e)
{
    for (int i = 0; i < g->n; i++)
        if (g->scenes[i].failed.kind)
            return err_set(e, g->scenes[i].failed.kind, "%s%s", g->scenes[i].at, g->scenes[i].failed.text);
    return true;
}

static bool same_twice(const struct golden *g, struct err *e)
{
    int unequal = 0;
    for (int i = 0; i < g->n; i++) {
        struct golden_scene *s = &g->scenes[i];
        s->sounds.exact = s->tables.exact = true;
        for (int pass = 0; pass < 2; pass++)
            for (const struct golden_file *one = s->made[pass].list; one < s->made[pass].list + s->made[pass].n;
                 one++) {
                const struct golden_file *other = golden_find(&s->made[1 - pass], one->name);
                const char *files[2] = {path_of(g, s, 0, one->name, s->arena), path_of(g, s, 1, one->name, s->arena)};
                if (!other)
                    problem(s, one->name, NULL, "was made by the %s render only", pass ? "second" : "first");
                else if (pass == 0 && strcmp(one->sha256, other->sha256) != 0)
                    judge_bytes(s, one->name, files, "what the first render made");
            }
        if (s->made[0].n == 0) problem(s, "", NULL, "it makes neither a sound nor a table: there is nothing to keep");
        if (s->n_problems && unequal++ == 0 && g->tap) printf("TAP version 13\n1..%d\n", g->n);
        if (s->n_problems) golden_report_scene(g, s, i + 1);
    }
    return !unequal ||
           err_set(e, ERR_DIFFERS, "%d scene%s not the same bytes twice, or nothing to keep: nothing was written",
                   unequal, unequal == 1 ? " has" : "s have");
}

/* ------------------------------------------------------------------ writing */

struct writing {
    struct golden *g;
    struct outfile *files; /* [n]: of what changes */
    int n;
    const char **removed; /* ends with NULL: kept so far, and not made any more */
    int n_removed, changed;
    const char **made; /* [n_made]: folders that were not there; until the commit they go with the program */
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
    return made || why == EEXIST ||
           err_set(e, ERR_CREATE, "the folder %s cannot be created: %s", folder, strerror(why));
}

static void forget_folders(const struct writing *w)
{
    for (int i = 0; i < w->n_made; i++)
        interrupt_forget(w->made[i]);
}

/* How far the table's columns are named: a CSV's first line, an NPY's dtype. */
static size_t columns_of(const struct bytes *b)
{
    const char *shape = b->n > 6 && !memcmp(b->at, "\x93NUMPY", 6) ? memmem(b->at, b->n, "'shape'", 7) : NULL,
               *line = memchr(b->at, '\n', b->n);
    return shape ? (size_t)(shape - b->at) : line ? (size_t)(line - b->at) : b->n;
}

static bool copy(struct writing *w, const char *from, const char *to, struct err *e)
{
    struct outfile *o = &w->files[w->n];
    struct arena *a = arena_open();
    struct bytes b, old;
    struct err why = {0}, unreadable = {0};
    struct stat link;
    bool ok = bytes_read(from, a, &b, e);
    /* The rule of output/mark.h. Nothing lies beside a kept table that names it: it is known as an earlier state of the
       one that takes its place by the same columns. */
    if (ok && !mark_permits(to, NULL, args_given(&w->g->call->args, "force"), &why)) {
        size_t n = columns_of(&b), length = strlen(to);
        bool table =
            lstat(to, &link) == 0 && S_ISREG(link.st_mode) && length > 4 && strcmp(to + length - 4, ".wav") != 0;
        ok = (table && n > 0 && bytes_read(to, a, &old, &unreadable) && columns_of(&old) == n &&
              !memcmp(old.at, b.at, n)) ||
             err_set(e, why.kind, "%s; nothing was written", why.text);
    }
    if (ok && (ok = outfile_open(o, to, e))) {
        w->n++;
        outfile_put(o, b.at, b.n);
        ok = outfile_finalise(o, e);
    }
    arena_close(a);
    return ok;
}

static void say(const struct golden *g, const char *what, const char *scene, const char *file)
{
    if (!g->quiet) printf("%-7s %s/%s\n", what, scene, text_shown(g->call->arena, file));
}

/* What a scene made takes the place of all that was kept of it. */
static bool write_scene(struct writing *w, const struct golden_scene *s, struct err *e)
{
    struct golden *g = w->g;
    struct arena *a = g->call->arena;
    struct golden_files saved = golden_files_of(g, s->name, a, e);
    const char *folder = arena_format(a, "%s/%s", g->saved ? g->saved : "", s->name);
    if (e->kind || (g->saved && !make_folder(w, folder, e))) return false;
    for (int i = 0; i < s->made[0].n; i++) {
        const struct golden_file *made = &s->made[0].list[i], *old = golden_find(&saved, made->name);
        bool same = old && strcmp(old->sha256, made->sha256) == 0;
        w->changed += !same;
        say(g, same ? "same" : old ? "changed" : "new", s->name, made->name);
        if (g->saved && !same &&
            !copy(w, path_of(g, s, 0, made->name, a), arena_format(a, "%s/%s", folder, made->name), e))
            return false;
    }
    for (int i = 0; i < saved.n; i++)
        if (!golden_find(&s->made[0], saved.list[i].name)) {
            w->changed++;
            say(g, "removed", s->name, saved.list[i].name);
            if (g->saved) w->removed[w->n_removed++] = arena_format(a, "%s/%s", folder, saved.list[i].name);
        }
    return true;
}

/* Lines of other scenes stay, but where lists say what all scenes are. */
static bool write_hashes(struct writing *w, struct err *e)
{
    struct golden *g = w->g;
    struct arena *a = g->call->arena;
    struct golden_files all = {NULL, 0};
    for (int i = 0; i < g->sums.n; i++)
        if (!g->whole && !golden_has(g, g->sums.list[i].name, strcspn(g->sums.list[i].name, "/")))
            *golden_add(&all, "", a) = g->sums.list[i];
    for (int i = 0; i < g->n; i++)
        for (int k = 0; k < g->scenes[i].made[0].n; k++) {
            const struct golden_file *made = &g->scenes[i].made[0].list[k];
            const char *name = arena_format(a, "%s/%s", g->scenes[i].name, made->name);
            memcpy(golden_add(&all, name, a)->sha256, made->sha256, HASH_TEXT);
        }
    golden_sort(&all);
    struct outfile *o = &w->files[w->n];
    if (!mark_links(g->hashes, args_given(&g->call->args, "force"), e) || !outfile_open(o, g->hashes, e)) return false;
    w->n++;
    for (int i = 0; i < all.n; i++)
        fprintf(o->stream, "%s  %s\n", all.list[i].sha256, all.list[i].name);
    return outfile_finalise(o, e);
}

static bool write_all(struct golden *g, struct writing *w, struct err *e)
{
    struct arena *a = g->call->arena;
    int most = 1, removed = 1;
    for (int i = 0; i < g->n; i++) {
        most += g->scenes[i].made[0].n;
        removed += golden_files_of(g, g->scenes[i].name, a, e).n;
    }
    *w = (struct writing){.g = g,
                          .files = ARENA_TAKE(a, struct outfile, most),
                          .removed = ARENA_TAKE(a, const char *, removed),
                          .made = ARENA_TAKE(a, const char *, g->n + 1)};
    for (int i = 0; i < most; i++)
        w->files[i].fd = -1;
    struct rlimit limit; /* every file that is about to be complete is open */
    if (getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < (rlim_t)most + 64) {
        limit.rlim_cur = limit.rlim_max;
        setrlimit(RLIMIT_NOFILE, &limit);
    }
    bool ok = !e->kind && (!g->saved || make_folder(w, g->saved, e));
    for (int i = 0; ok && i < g->n; i++)
        ok = write_scene(w, &g->scenes[i], e);
    ok = ok && (!g->hashes || write_hashes(w, e));
    int files = w->n - (g->hashes != NULL);
    interrupt_hold();
    if (ok) forget_folders(w);
    for (int i = 0; ok && i < files; i++)
        ok = outfile_commit(&w->files[i], e);
    for (int i = 0; ok && i < w->n_removed; i++)
        ok = unlink(w->removed[i]) == 0 ||
             err_set(e, ERR_IO, "%s: cannot be removed: %s", w->removed[i], strerror(errno));
    if (ok && g->hashes) ok = outfile_commit(&w->files[files], e);
    interrupt_go();
    for (int i = 0; i < w->n; i++)
        outfile_drop(&w->files[i]);
    for (int i = 0; !ok && g->saved && i < g->n; i++)
        rmdir(arena_format(a, "%s/%s", g->saved, g->scenes[i].name)); /* where nothing was in it */
    forget_folders(w);
    return ok;
}

int golden_run_update(struct golden *g, struct err *e)
{
    struct writing w;
    if (g->hashes && access(g->hashes, F_OK) == 0 && !golden_read_hashes(g, e)) return (int)e->kind;
    /* The second pass begins when the first is over: what one render leaves behind for the next would show. */
    for (int pass = 0; pass < 2; pass++) {
        struct pass p = {g, pass};
        if (!none_failed(g, e)) return (int)e->kind;
        if (pool_run(&(struct pool_work){.n = g->n, .threads = g->threads, .context = &p, .job = render_one}) < g->n &&
            none_failed(g, e))
            err_set(e, ERR_INTERRUPTED, "interrupted; nothing was written, run the same command again");
        if (e->kind) return (int)e->kind;
    }
    if (!none_failed(g, e) || !same_twice(g, e) || !write_all(g, &w, e)) return (int)e->kind;
    if (!g->quiet)
        printf("%d scene%s rendered twice; %d file%s changed\n", g->n, g->n == 1 ? "" : "s", w.changed,
               w.changed == 1 ? "" : "s");
    const char **strays = g->whole ? golden_strays(g, g->call->arena) : NULL;
    for (; g->saved && strays && *strays; strays++)
        message_warning(g->call, *strays, "no scene makes it; rasp golden check will fail until it is removed");
    return 0;
}
