/* All keys, put together from the tables of the files that read them; accuracy.def as a table. */
#include "scene/keys.h"

#include <assert.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/version.h"
#include "scene/rows.h"

static const struct key scene_own[] = {
    {ROW_COUNT(scene, version, "rasp"), KEY_NONE, 1, 1, NULL, NULL, "version of the scene format; this is version 1",
     .shown = "1"},
    {ROW_TEXT(scene, written_by, "written_by"), KEY_NONE, 0, 0, "", NULL,
     "the version of rasp that wrote an effective scene; one whose sounds are others says so",
     .shown = "\"rasp " VERSION "\""},
    {ROW_TEXT(scene, title, "title"), KEY_NONE, 0, 0, "", NULL,
     "what the scene shows, for people; goes into the WAV as its title",
     .shown = "\"a tool scraped back and forth on a rough plank\"", .on = true},
    {ROW_SEED(scene, seed, "seed"), KEY_NONE, 0, 0, "0", NULL,
     "seed of all random numbers; each stage has its own stream, so that adding an effect changes no other stage's "
     "noise"},
    {ROW_TEXT(contact, name, "name"), KEY_NONE, 0, 0, "contact", NULL,
     "name of the contact, in diagnostics and messages"},
    {ROW_NUMBER(contact, start, "start"), KEY_TIME, 0, 3600, "0 s", NULL,
     "when the contact begins, after the start of the scene, to the nearest audio sample"},
    {ROW_NUMBER(contact, gain, "gain"), KEY_NONE, -1000, 1000, "1", NULL, "factor on this contact's sound in the sum"},
    {.path = NULL}};

/* Then the maps' keys, in this order, and within a map in that of pipeline/stages.def. */
static const char *const maps[] = {"surface", "surface.response", "surface.space", "scraper", "scraper.response",
                                   "ball",    "ball.response",    "motion",        "grip",    "load",
                                   "contact", "ablation",         "output"};
enum { MAPS = sizeof maps / sizeof *maps };

static struct keys all;

static void longer(const char **best, const char *place, const char *section)
{
    size_t n = strlen(place);
    if (!strncmp(place, section, n) && strchr(".", section[n]) && (!*best || strlen(*best) < n)) *best = place;
}

/* The place at which the rows of p stand: the longest that its section is in, of `maps` and of the rows that are
   places. */
static const char *home_of(const struct params *p)
{
    const struct params *other;
    const char *best = NULL;
    for (int i = 0; i < MAPS; i++)
        longer(&best, maps[i], p->section);
    for (int i = 0; (other = stages_params(i)); i++)
        for (const struct key *k = other->keys; k && k->path; k++)
            if (!k->meaning) longer(&best, k->path, p->section);
    return best;
}

/* "*" stands for all parts of the surface that are not named. */
static void rivals_add(struct key_alternative *t, const struct key_alternative *old)
{
    const struct params *p;
    int n = 0;
    *t = *old;
    for (int k = 0; old->paths[k]; k++) {
        bool rest = !strcmp(old->paths[k], "*");
        if (!rest) t->paths[n++] = old->paths[k];
        for (int i = 0; rest && (p = stages_params(i)); i++) {
            bool named = !p->ground || !p->ground->span;
            for (int m = 0; old->paths[m]; m++)
                named = named || !strcmp(old->paths[m], p->section);
            assert(named || n < KEYS_RIVALS);
            if (!named) t->paths[n++] = p->section;
        }
    }
    t->paths[n] = NULL;
    t->most = old->most == 1 ? 1 : n;
}

enum { HOMES = 200 };

struct taken {
    struct key *keys;
    struct key_section *sections;
    const char *home[HOMES]; /* of stages_params(i) */
};

/* The path of a key of `in`. */
static const char *path_in(const struct params *in, const char *path)
{
    if (!in->body || path[0] != '.') return path;
    size_t n = strlen(in->body) + strlen(path) + 1;
    char *whole = memory_take(n);
    snprintf(whole, n, "%s%s", in->body, path);
    return whole;
}

static void rows_take(struct taken *t, const char *place);

static void row_take(struct taken *t, const struct key *row, const struct params *in)
{
    struct key *k = t->keys;
    if (!row->meaning) {
        rows_take(t, row->path);
        return;
    }
    t->keys++;
    *k = *row;
    k->in = in;
    k->path = path_in(in, k->path);
    k->applies = k->applies ? path_in(in, k->applies) : in->when;
    k->offset += in->size ? params_at(in) : in->base;
}

/* What stands at that place. */
static void rows_take(struct taken *t, const char *place)
{
    const struct params *p;
    for (int i = 0; (p = stages_params(i)); i++) {
        if (!t->home[i] || strcmp(t->home[i], place) != 0) continue;
        if (p->meaning)
            *t->sections++ = (struct key_section){p->keys->of, p->size ? params_at(p) : p->base + p->flag, p->section,
                                                  p->meaning, p};
        for (const struct key *row = p->keys; row && row->path; row++)
            row_take(t, row, p);
    }
}

static long n_keys;
static const struct key **deciders; /* [keys of the table] which of them decides; NULL: none */
static const struct key **by_path;  /* [n_keys] */

static int path_order(const void *p, const void *q)
{
    const struct key *const *a = (const struct key *const *)p, *const *b = (const struct key *const *)q;
    return strcmp((*a)->path, (*b)->path);
}

static const struct key *decider_find(const struct key *k)
{
    const char *name = k->applies ? k->applies + (k->applies[0] == '!') : "";
    size_t n = strcspn(name, "=");
    for (const struct key *other = all.table; n > 0 && other->path; other++)
        if (other->path[0] == name[0] && strncmp(other->path, name, n) == 0 && !other->path[n]) return other;
    return NULL;
}

static void tables_make(void)
{
    enum { MOST = 400, RIVALS = 20 };
    struct key *table = memory_take(MOST * sizeof *table);
    struct key_section *sections = memory_take(MOST * sizeof *sections);
    struct key_alternative *rivals = memory_take(RIVALS * sizeof *rivals), *r = rivals;
    struct taken t = {table, sections, {NULL}};
    const struct params *p;
    for (int i = 0; (p = stages_params(i)); i++) {
        assert(i < HOMES);
        t.home[i] = home_of(p);
    }
    for (const struct key *row = scene_own; row->path; row++)
        *t.keys++ = *row;
    for (int i = 0; i < MAPS; i++)
        rows_take(&t, maps[i]);
    for (int i = 0; (p = stages_params(i)); i++)
        if (p->alternative.paths[0]) rivals_add(r++, &p->alternative);
    assert(t.keys - table < MOST && t.sections - sections < MOST && r - rivals < RIVALS);
    t.keys->path = t.sections->path = r->paths[0] = NULL;
    all = (struct keys){table, sections, rivals};
    deciders = memory_take(MOST * sizeof *deciders);
    by_path = memory_take(MOST * sizeof *by_path);
    for (const struct key *k = table; k->path; k++) {
        deciders[k - table] = decider_find(k);
        by_path[n_keys++] = k;
    }
    qsort(by_path, (size_t)n_keys, sizeof *by_path, path_order);
}

const struct keys *keys_all(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, tables_make);
    return &all;
}

void *keys_field(const struct key *k, const void *owner)
{
    return (k->in && k->in->size ? (char *)params_block(owner) : (char *)owner) + k->offset;
}

bool *keys_given(const struct key_section *s, const void *owner)
{
    return (bool *)((s->in->size ? (char *)params_block(owner) : (char *)owner) + s->offset);
}

#define KNOB(knob, lowest, highest, integer, counts, falls, draft, standard, best, reference, text)                    \
    {.name = #knob,                                                                                                    \
     .low = lowest,                                                                                                    \
     .high = highest,                                                                                                  \
     .whole = integer,                                                                                                 \
     .scale = KEY_##counts,                                                                                            \
     .order = falls,                                                                                                   \
     .preset = {draft, standard, best, reference},                                                                     \
     .offset = offsetof(struct accuracy, knob),                                                                        \
     .meaning = text},
const struct key_knob keys_knobs[] = {
#include "scene/accuracy.def"
    {.name = NULL}};

const char *const keys_presets[5] = {"draft", "standard", "high", "reference", NULL};

const char *keys_former(const char *path, const char *word)
{
    static const char ramp[] = "leave it out; accuracy.gain_ramp alone says how finely a response that moves is "
                               "followed (64 is standard, 16 high)";
    static const char engine[] =
        "leave it out: surface.moving: launch is the same sound by resonators; or write overlap_add";
    static const struct {
        const char *path, *word, *instead;
    } former[] = {
        {"accuracy.morph_error", "", ramp},
        {"accuracy.overlap_hop", "", ramp},
        {"accuracy.overlap_order", "", ramp},
        {"surface.convolution", "nodes", engine},
        {"scraper.convolution", "nodes", engine},
        {"ball.convolution", "nodes", engine},
        {"contact.roll.static_depth", "",
         "it is gone: the stiffness follows from both materials and the ground's roughness; remove it, or give "
         "contact.roll.static_penetration, a length"},
    };
    for (size_t i = 0; i < sizeof former / sizeof *former; i++)
        if (strcmp(former[i].path, path) == 0 && strcmp(former[i].word, word) == 0) return former[i].instead;
    return NULL;
}

const struct key *keys_find(const char *path)
{
    const struct key wanted = {.path = path}, *w = &wanted;
    keys_all();
    const struct key *const *at = bsearch(&w, by_path, (size_t)n_keys, sizeof *by_path, path_order);
    return at ? *at : NULL;
}

const struct key *keys_decider(const struct key *k)
{
    const struct key *table = keys_table; /* each scene that is read asks for all of them */
    return k >= table && k < table + n_keys ? deciders[k - table] : decider_find(k);
}

const char *keys_words(const struct key *k)
{
    const char *equals = k->applies ? strchr(k->applies, '=') : NULL;
    return equals ? equals + 1 : NULL;
}

bool keys_applies_with(const struct key *k, const char *word)
{
    size_t n = strlen(word);
    for (const char *w = keys_words(k); w; w = strchr(w, '|') ? strchr(w, '|') + 1 : NULL)
        if (strncmp(w, word, n) == 0 && (w[n] == '|' || !w[n])) return true;
    return false;
}

bool keys_applies_beside(const struct key *k, bool given) { return given == (k->applies[0] != '!'); }

#define FOLLOWS(owner, number, list)                                                                                   \
    _Static_assert(offsetof(struct owner, number) == offsetof(struct owner, list) + sizeof(const double *),            \
                   "the number follows the list")
FOLLOWS(motion, n_points, points);
FOLLOWS(listen, n_places, places);

int *keys_points_count(const void *field) { return (int *)((char *)field + sizeof(const double *)); }

int keys_points_width(const struct key *k) { return k->type == KEY_PLACES ? 3 : 2; }

const struct key *keys_same_words(const struct key *k)
{
    for (const struct key *other = keys_table; k->choices && other < k; other++)
        if (other->choices == k->choices) return other;
    return NULL;
}

struct key keys_condition(const struct key_alternative *t) { return (struct key){.path = "", .applies = t->applies}; }
