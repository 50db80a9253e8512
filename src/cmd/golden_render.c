/* The renders of `rasp golden`, each in a folder of its own: WORK/NAME/first/, WORK/NAME/again/. */
#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/scratch.h"
#include "cmd/golden.h"
#include "pipeline/render.h"
#include "scene/scene_places.h"
#include "scene/scene_read.h"

static const char *const passes[2] = {"first", "again"};

bool golden_render_folder(struct golden *g, struct err *e)
{
    const char *given = args_value(&g->call->args, "output");
    struct stat st;
    if (given) {
        g->work = given;
        g->stays = true;
        return (stat(given, &st) == 0 && S_ISDIR(st.st_mode)) || mkdir(given, 0777) == 0 || err_set(e, ERR_CREATE, "the folder %s cannot be created: %s", given, strerror(errno));
    }
    char *name = arena_format(g->call->arena, "%s/rasp-golden-XXXXXX", scratch_folder());
    interrupt_hold();
    bool made = mkdtemp(name) != NULL;
    if (made)
        interrupt_temporary(name);
    interrupt_go();
    if (!made)
        return err_set(e, ERR_CREATE, "%s: no temporary folder can be made there: %s; set TMPDIR to a folder that can be written", scratch_folder(), strerror(errno));
    g->work = name;
    return true;
}

const char *golden_render_path(const struct golden *g, const struct golden_scene *s, int pass, const char *file, struct arena *a)
{
    return arena_format(a, "%s/%s/%s/%s", g->work, s->name, passes[pass], file);
}

/* Sounds and tables, with their hashes. */
static bool note_files(struct golden_scene *s, int pass, const struct render_report *r, struct err *e)
{
    struct golden_files *made = &s->made[pass];
    *made = (struct golden_files){ARENA_TAKE(s->arena, struct golden_file, r->n_files + 1), 0};
    for (int i = 0; i < r->n_files; i++) {
        const struct render_file *f = &r->files[i];
        if (!strcmp(f->kind, "scene") || !strcmp(f->kind, "summary"))
            continue;
        made->list[made->n].name = arena_text(s->arena, strrchr(f->path, '/') + 1);
        if (!hash_file(f->path, made->list[made->n++].sha256, e))
            return false;
    }
    golden_kept_sort(made);
    return true;
}

static bool into(const struct golden *g, struct golden_scene *s, const char *folder, struct err *e)
{
    const char *outer = arena_format(s->arena, "%s/%s", g->work, s->name);
    interrupt_hold();
    bool there = (mkdir(outer, 0777) == 0 || errno == EEXIST) && (mkdir(folder, 0777) == 0 || errno == EEXIST);
    interrupt_go();
    return there || err_set(e, ERR_CREATE, "the folder %s cannot be created: %s", folder, strerror(errno));
}

bool golden_render(const struct golden *g, struct golden_scene *s, int pass, const char *from, struct err *e)
{
    struct arena *a = arena_open();
    const char *base = golden_render_path(g, s, pass, "sound", a), *messages = "";
    struct scene read;
    struct render_report report;
    bool ok = into(g, s, golden_render_path(g, s, pass, "", a), e) && (!from || scene_read(from, NULL, a, &read, &messages, e)) &&
              (render_scene(from ? &read : &s->scene, base, a, &report, e) || scene_places_tell(from ? &read : &s->scene, e)) && note_files(s, pass, &report, e);
    arena_close(a);
    return ok;
}

/* ------------------------------------------------------------------ away with it */

/* What a render writes: no folder in it, and nothing of somebody else's. */
static void clear(const char *folder)
{
    static const char *const endings[] = {".wav", ".csv", ".npy", ".json", ".yaml", NULL};
    DIR *d = opendir(folder);
    for (struct dirent *entry; d && (entry = readdir(d));) {
        const char *dot = strrchr(entry->d_name, '.');
        for (int k = 0; endings[k] && dot; k++)
            if (!strncmp(entry->d_name, "sound.", 6) && !strcmp(dot, endings[k]))
                unlinkat(dirfd(d), entry->d_name, 0);
    }
    if (d)
        closedir(d);
    rmdir(folder);
}

void golden_render_clear(const struct golden *g, const struct golden_scene *s)
{
    for (int pass = 0; pass < 2; pass++)
        clear(golden_render_path(g, s, pass, "", s->arena));
    rmdir(arena_format(s->arena, "%s/%s", g->work, s->name));
}

void golden_render_end(const struct golden *g)
{
    for (int i = 0; g->work && !g->stays && i < g->n; i++)
        golden_render_clear(g, &g->scenes[i]);
    if (g->work) {
        rmdir(g->work);
        interrupt_forget(g->work);
    }
}
