/* See inputs.h. */
#include "pipeline/inputs.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file_cache.h"
#include "file/bytes.h"
#include "scene/keys.h"
#include "scene/scene_places.h"
#include "scene/scene_write.h"
#include "trajectory/contact.h"

struct missing {
    const struct scene *scene;
    struct arena *arena;
    const char *text;
    const char *contact, *key; /* of the first */
};

/* The place of the first is reported with the whole (scene_places_report), those of the others here. What names a file
   is given: it has a place. */
static void add(struct missing *m, const char *contact, const char *key, const char *file)
{
    struct stat s;
    /* A response may be a folder, whose reader looks for its places in index.csv (response/ir.h). */
    bool folder = file && strcmp(key, "surface.response") == 0 && stat(file, &s) == 0 && S_ISDIR(s.st_mode);
    const char *index = folder ? arena_format(m->arena, "%s/index.csv", file) : NULL, *read = index ? index : file;
    bool there = read && stat(read, &s) == 0 && access(read, R_OK) == 0;
    if (!read || (there && S_ISREG(s.st_mode))) return;
    const char *why = !there                                 ? strerror(errno)
                      : strcmp(key, "surface.residual") == 0 ? "is not a file; name the residual.yaml in the folder"
                                                             : "is not a file";
    const struct scene_place *p = scene_places_find(m->scene, contact, key, file);
    if (index)
        file =
            arena_format(m->arena, "a folder of responses has its places in index.csv (file_name,x_m,y_m): %s", index);
    const char *between = m->key ? arena_format(m->arena, "; %s: ", scene_places_text(m->scene, p, m->arena)) : "";
    const char *near = there ? NULL : bytes_near(read, m->arena);
    m->text = arena_format(m->arena, "%s%s%s: %s: %s%s%s%s", m->text, between, p ? p->label : key, file, why,
                           near ? "; did you mean " : "", near ? near : "", near ? "?" : "");
    if (p) m->text = arena_format(m->arena, "%s%s", m->text, p->named);
    m->contact = m->key ? m->contact : contact;
    m->key = m->key ? m->key : key;
}

bool inputs_check(const struct scene *s, struct arena *a, struct err *e)
{
    struct missing m = {.scene = s, .arena = a, .text = ""};
    for (int i = 0; i < s->n_contacts; i++)
        for (const struct key *k = keys_table; k->path; k++)
            if (k->of == KEY_CONTACT && k->type == KEY_FILE && !contact_copies(&s->contacts[i], k->path))
                add(&m, s->contacts[i].name, k->path, *(const char **)keys_field(k, &s->contacts[i]));
    for (int i = 0; i < s->n_inputs && !m.key; i++)
        add(&m, NULL, "inputs", s->inputs[i].file);
    if (m.key) return err_set(e, ERR_INPUT, "%s", m.text) || err_about(e, m.contact, m.key);
    for (int i = 0; i < s->n_inputs; i++) {
        const struct input *p = &s->inputs[i];
        const char *hex = p->sha256 ? file_cache_sha256(s->file_cache, p->file, a, e) : NULL;
        if (p->sha256 && !hex) return false;
        if (!p->sha256 || !strcmp(hex, p->sha256)) continue;
        err_about(e, NULL, "inputs");
        return err_set(e, ERR_SCENE,
                       "inputs: %s has changed: its sha256 is %s, not %s; restore the file, or remove its entry to use "
                       "it as it is",
                       p->file, hex, p->sha256);
    }
    return true;
}

struct watch inputs_watch(const struct scene *s, struct arena *a)
{
    int n;
    const char **files = scene_write_inputs(s, &n, a);
    return file_cache_watch(files, n, a);
}

bool inputs_still(const struct watch *w, struct err *e)
{
    const char *file = file_cache_watch_changed(w);
    return !file ||
           err_set(e, ERR_INPUT, "%s: has changed while the sound was made of it: run the same command again", file);
}
