/* `inputs` names every file of the scene once, with its sha256 as it is now: those of its keys (of a folder of
   responses its index.csv and the files that this names, by name), and those that it has pinned besides (such as the
   recipe that an effective scene was made with). An effective scene has them in the same order again. */
#include "scene/scene_write_inputs.h"

#include <string.h>

#include "base/file_cache.h"
#include "base/relpath.h"
#include "file/csv.h"
#include "scene/keys_yaml.h"

struct list {
    const struct scene *scene;
    struct arena *arena;
    const char **files;
    int n, room;
};

bool scene_write_inputs_only(const struct key *k) { return strcmp(k->path, "surface.recipe") == 0; }

/* ------------------------------------------------------------------ which files */

static void add(struct list *l, const char *file)
{
    for (int i = 0; i < l->n; i++)
        if (!strcmp(l->files[i], file)) return;
    if (l->n == l->room) {
        l->room = 2 * l->room + 16;
        const char **more = ARENA_TAKE(l->arena, const char *, l->room);
        if (l->n) memcpy(more, l->files, (size_t)l->n * sizeof *more);
        l->files = more;
    }
    l->files[l->n++] = file;
}

/* A file; or what is read of a folder. */
static void add_all(struct list *l, const char *name)
{
    int n;
    const char **files = csv_folder_files(name, &n, l->arena);
    if (n == 0) add(l, name);
    for (int i = 0; i < n; i++)
        add(l, files[i]);
}

static void add_keys(struct list *l, bool only)
{
    for (int i = 0; i < l->scene->n_contacts; i++)
        for (const struct key *k = keys_table; k->path; k++) {
            bool mine = k->of == KEY_CONTACT && k->type == KEY_FILE && scene_write_inputs_only(k) == only;
            const char *file = mine ? *(const char *const *)keys_field(k, &l->scene->contacts[i]) : NULL;
            if (file) add_all(l, file);
        }
}

/* ------------------------------------------------------------------ as YAML */

static const char *pinned(const struct scene *s, const char *file)
{
    for (int i = 0; i < s->n_inputs; i++)
        if (s->inputs[i].sha256 && !strcmp(s->inputs[i].file, file)) return s->inputs[i].sha256;
    return NULL;
}

const char **scene_write_inputs_files(const struct scene *s, int *n, struct arena *a)
{
    struct list l = {s, a, NULL, 0, 0};
    if (!s->inputs_known) {
        add_keys(&l, false);
        add_keys(&l, true);
    }
    for (int i = 0; i < s->n_inputs; i++)
        if (s->inputs[i].file) add(&l, s->inputs[i].file);
    *n = l.n;
    return l.files;
}

/* A file that cannot be read keeps the hash it was pinned to; without one it is listed unpinned, with a remark. */
static void write_input(FILE *f, const struct scene *s, const char *file, const char *beside, struct arena *a)
{
    struct err unreadable = {0};
    const char *now = s->inputs_known ? NULL : file_cache_sha256(s->file_cache, file, a, &unreadable),
               *sha256 = now ? now : pinned(s, file);
    fprintf(f, "  - file: %s\n", keys_yaml_quoted(relpath_make(file, beside, a), a));
    if (sha256)
        fprintf(f, "    sha256: \"%s\"\n", sha256);
    else
        fputs("    # could not be read when this was written\n", f);
}

void scene_write_inputs(FILE *f, const struct scene *s, const char *beside, struct arena *a)
{
    int n;
    const char **files = scene_write_inputs_files(s, &n, a);
    if (n) fputs("inputs:\n", f);
    for (int i = 0; i < n; i++)
        write_input(f, s, files[i], beside, a);
}
