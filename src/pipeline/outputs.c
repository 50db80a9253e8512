/* See outputs.h. Two files are one if they have the same device and inode, so that links count; an output that is not
   there yet is none of the inputs. Two outputs are one if they have the same path, with symbolic links followed: a
   commit replaces what they point to, while a hard link to another output is merely given up. */
#include "pipeline/outputs.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/hash.h"
#include "base/memory.h"
#include "base/relpath.h"
#include "file/csv.h"
#include "output/mark.h"
#include "output/sound.h"
#include "pipeline/plan.h"
#include "scene/keys.h"
#include "scene/scene_write.h"
#include "trajectory/contact.h"

const char *outputs_kind(const struct scene *s, enum output_kind kind)
{
    static const char *const kinds[OUTPUT_KINDS] = {"csv",  "impacts", "scene", "summary", "wav",
                                                    "stem", "stem",    "stem",  "stem"};
    return kind == OUTPUT_TABLE && s->output.diagnostics.format == TABLE_NPY ? "npy" : kinds[kind];
}

char *outputs_path(const struct scene *s, const char *base, enum output_kind kind, const struct contact *c,
                   struct arena *a)
{
    const char *const endings[] = {".csv", ".impacts.csv", ".scene.yaml", ".json", sound_ending(s->output.encoding)};
    bool several = kind <= OUTPUT_LISTING && s->n_contacts > 1,
         npy = kind == OUTPUT_TABLE && s->output.diagnostics.format == TABLE_NPY;
    if (kind >= OUTPUT_STEM) return arena_format(a, "%s.%s.wav", base, stems_names[kind - OUTPUT_STEM]);
    return arena_format(a, "%s%s%s%s", base, several ? "." : "", several ? c->name : "", npy ? ".npy" : endings[kind]);
}

static void add(struct outputs *o, enum output_kind kind, const struct contact *c, struct arena *a)
{
    o->kinds[o->n] = kind;
    o->paths[o->n++] = outputs_path(o->scene, o->base, kind, c, a);
}

/* Room for all that there may be. */
static struct outputs outputs_none(const struct scene *s, const char *base, struct arena *a)
{
    int most = 3 * s->n_contacts + OUTPUT_KINDS;
    return (struct outputs){s, base, ARENA_TAKE(a, const char *, most), ARENA_TAKE(a, enum output_kind, most), 0};
}

struct outputs outputs_make(const struct scene *s, const char *base, struct arena *a)
{
    struct outputs o = outputs_none(s, base, a);
    unsigned asked = 0;
    for (int i = 0; i < s->n_contacts; i++) {
        unsigned targets = plan_targets(&s->contacts[i], s);
        asked |= targets;
        if (targets & ITEM_BIT(ITEM_TABLE)) add(&o, OUTPUT_TABLE, &s->contacts[i], a);
        if (targets & ITEM_BIT(ITEM_LISTING)) add(&o, OUTPUT_LISTING, &s->contacts[i], a);
    }
    add(&o, OUTPUT_EFFECTIVE, NULL, a);
    add(&o, OUTPUT_SUMMARY, NULL, a);
    if (asked & ITEM_BIT(ITEM_SOUND)) add(&o, OUTPUT_SOUND, NULL, a);
    for (int k = 0; k < STEMS; k++)
        if (stems_asked(&s->output, (enum stem)k)) add(&o, OUTPUT_STEM + k, NULL, a);
    return o;
}

const char *outputs_effective(const struct scene *s, const char *path, struct arena *a)
{
    return scene_write(s, relpath_folder(path, a), a);
}

/* ------------------------------------------------------------------ outputs and outputs */

struct place {
    const char *path, *real;
    const struct scene *scene;
    int at;
};

static int place_order(const void *a, const void *b)
{
    const struct place *p = a, *q = b;
    int names = strcmp(p->real, q->real);
    return names ? names : p->at - q->at;
}

bool outputs_distinct(const struct outputs *o, int n, struct arena *a, struct err *e)
{
    int all = 0, k = 0;
    for (int i = 0; i < n; i++)
        all += o[i].n;
    struct place *places = ARENA_TAKE(a, struct place, all);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < o[i].n; j++, k++) {
            char *real = memory_realpath(o[i].paths[j]);
            places[k] = (struct place){o[i].paths[j], real ? arena_text(a, real) : o[i].paths[j], o[i].scene, k};
            free(real);
        }
    qsort(places, (size_t)all, sizeof *places, place_order);
    for (k = 1; k < all; k++)
        if (strcmp(places[k].real, places[k - 1].real) == 0)
            return err_set(
                e, ERR_USAGE,
                "%s and %s would both write %s%s%s; rename one, or render them into different folders with -o",
                places[k - 1].scene->file, places[k].scene->file, places[k].path,
                strcmp(places[k].path, places[k - 1].path) ? ", which is " : "",
                strcmp(places[k].path, places[k - 1].path) ? places[k - 1].path : "");
    return true;
}

/* ------------------------------------------------------------------ outputs and inputs */

struct sources {
    struct outputs_source *list;
    int n;
    struct arena *arena;
};

static void note(struct sources *all, const struct scene *s, const char *file, const char *what)
{
    struct stat status;
    if (!file || stat(file, &status) != 0) return;
    all->list = arena_more(all->arena, all->list, all->n, sizeof *all->list);
    all->list[all->n++] = (struct outputs_source){file, what, s, status.st_dev, status.st_ino};
}

static void note_scene(struct sources *all, const struct scene *s)
{
    for (int i = 0; s->sources && s->sources[i]; i++)
        note(all, s, s->sources[i], i ? "a file that it includes" : "the scene itself");
    for (int i = 0; i < s->n_contacts; i++)
        for (const struct key *k = keys_table; k->path; k++) {
            if (k->of != KEY_CONTACT || k->type != KEY_FILE || contact_copies(&s->contacts[i], k->path)) continue;
            const char *file = *(const char *const *)keys_field(k, &s->contacts[i]);
            int n = 0; /* of a folder what is read of it, too */
            const char **files = file ? csv_folder_files(file, &n, all->arena) : NULL;
            note(all, s, file, k->path);
            for (int j = 0; j < n; j++)
                note(all, s, files[j], k->path);
        }
    for (int i = 0; i < s->n_inputs; i++)
        note(all, s, s->inputs[i].file, "inputs");
}

static struct sources sources_of(const struct outputs *o, int n, struct arena *a)
{
    struct sources all = {NULL, 0, a};
    for (int i = 0; i < n; i++)
        note_scene(&all, o[i].scene);
    return all;
}

const struct outputs_source *outputs_sources(const struct scene *s, int *n, struct arena *a)
{
    struct sources all = {NULL, 0, a};
    note_scene(&all, s);
    *n = all.n;
    return all.list;
}

static const struct outputs_source *source_find(const struct sources *all, const char *path)
{
    struct stat status;
    if (stat(path, &status) == 0)
        for (int i = 0; i < all->n; i++)
            if (all->list[i].device == status.st_dev && all->list[i].inode == status.st_ino) return &all->list[i];
    return NULL;
}

/* Would the file that is there be replaced by one of the same bytes? */
static bool unchanged(const struct outputs *o, int k, struct arena *a)
{
    char is[HASH_TEXT], becomes[HASH_TEXT];
    struct err unreadable = {0};
    if (o->kinds[k] != OUTPUT_EFFECTIVE || !hash_file(o->paths[k], is, &unreadable)) return false;
    const char *text = outputs_effective(o->scene, o->paths[k], a);
    hash_bytes(text, strlen(text), becomes);
    return strcmp(is, becomes) == 0;
}

bool outputs_check_overwrite(const struct outputs *outputs, int n, struct arena *a, struct err *e)
{
    struct sources all = sources_of(outputs, n, a);
    for (const struct outputs *o = outputs; o < outputs + n; o++)
        for (int k = 0; k < o->n; k++) {
            const struct outputs_source *hit = source_find(&all, o->paths[k]);
            if (!hit || unchanged(o, k, a)) continue;
            bool other = hit->scene != o->scene,
                 differs = o->kinds[k] == OUTPUT_EFFECTIVE && hit->file == o->scene->sources[0];
            return err_set(e, ERR_CREATE,
                           "%s: the output %s would overwrite the input %s (%s%s%s%s); write elsewhere: -o FOLDER/ or "
                           "-o OTHER.wav",
                           o->scene->file, o->paths[k], hit->file, hit->what,
                           differs ? ", which is not its own effective scene" : "", other ? ", scene " : "",
                           other ? hit->scene->file : "");
        }
    return true;
}

/* ------------------------------------------------------------------ outputs and what is there */

bool outputs_replace(const struct outputs *o, int n, bool force, struct arena *a, struct err *e)
{
    struct err why = {0};
    for (int i = 0; i < n; i++)
        for (int k = 0; k < o[i].n; k++, why.kind = ERR_NONE) {
            const char *summary = outputs_path(o[i].scene, o[i].base, OUTPUT_SUMMARY, NULL, a);
            if (!mark_permits(o[i].paths[k], summary, force, &why) && !unchanged(&o[i], k, a))
                return err_set(e, why.kind, "%s: %s", o[i].scene->file, why.text);
        }
    return true;
}

/* ------------------------------------------------------------------ what an earlier render left */

const char **outputs_older(const struct scene *s, const char *base, struct arena *a)
{
    struct outputs o = outputs_make(s, base, a), most = outputs_none(s, base, a);
    struct scene other = *s;
    struct sources all = sources_of(&o, 1, a);
    const char **older = ARENA_TAKE(a, const char *, 3 * s->n_contacts + OUTPUT_KINDS + 1);
    struct stat status;
    int n = 0;
    for (int i = 0; i < s->n_contacts; i++)
        for (int kind = OUTPUT_TABLE; kind <= OUTPUT_LISTING; kind++)
            add(&most, (enum output_kind)kind, &s->contacts[i], a);
    other.output.diagnostics.format = s->output.diagnostics.format == TABLE_CSV ? TABLE_NPY : TABLE_CSV;
    for (int i = 0; i < s->n_contacts; i++)
        most.paths[most.n++] = outputs_path(&other, base, OUTPUT_TABLE, &s->contacts[i], a);
    other.output.encoding = strcmp(sound_ending(s->output.encoding), ".flac") ? ENCODING_FLAC24 : ENCODING_PCM24;
    most.paths[most.n++] = outputs_path(&other, base, OUTPUT_SOUND, NULL, a);
    for (int kind = OUTPUT_SOUND; kind < OUTPUT_KINDS; kind++)
        add(&most, (enum output_kind)kind, NULL, a);
    for (int k = 0; k < 3 && s->n_contacts > 1; k++)
        most.paths[most.n++] = arena_format(a, "%s%s", base, ((const char *[]){".csv", ".impacts.csv", ".npy"})[k]);
    for (int i = 0; i < most.n; i++) {
        bool writes = false;
        for (int k = 0; k < o.n; k++)
            writes = writes || strcmp(o.paths[k], most.paths[i]) == 0;
        if (!writes && stat(most.paths[i], &status) == 0 && !source_find(&all, most.paths[i]))
            older[n++] = most.paths[i];
    }
    return older;
}
