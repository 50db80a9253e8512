/* keys.def, choices.def and accuracy.def as tables. */
#include "scene/keys.h"

#include <assert.h>
#include <pthread.h>
#include <string.h>

#include "base/memory.h"
#include "scene/params.h"

#define CHOICES(name) static const struct choice words_##name[] = {
#define CHOICE(name, word, meaning) {word, meaning},
#define CHOICES_END                                                                                                    \
    {                                                                                                                  \
        NULL, NULL                                                                                                     \
    }                                                                                                                  \
    }                                                                                                                  \
    ;
#include "scene/choices.def"
#undef CHOICES
#undef CHOICE
#undef CHOICES_END

#define OFFSET_SCENE(field) offsetof(struct scene, field)
#define OFFSET_CONTACT(field) offsetof(struct contact, field)
#define KEY_CHOICE(name) KEY_CHOICE, .choices = words_##name

#define KEY(owner, field, where, kind, unit, lowest, highest, preset, when, text)                                      \
    {.of = KEY_##owner,                                                                                                \
     .offset = OFFSET_##owner(field),                                                                                  \
     .path = where,                                                                                                    \
     .type = KEY_##kind,                                                                                               \
     .dimension = KEY_##unit,                                                                                          \
     .low = lowest,                                                                                                    \
     .high = highest,                                                                                                  \
     .standard = preset,                                                                                               \
     .applies = when,                                                                                                  \
     .meaning = text},
#define SECTION(...)
#define ALTERNATIVE(...)
#define STAGES(map) {.path = map, .meaning = NULL},
static const struct key rows[] = {
#include "scene/keys.def"
    {.path = NULL}};
#undef KEY
#undef SECTION
#undef ALTERNATIVE

#define KEY(...)
#define SECTION(owner, field, where, text)                                                                             \
    {.of = KEY_##owner, .offset = OFFSET_##owner(field.given), .path = where, .meaning = text},
#define ALTERNATIVE(...)
static const struct key_section sections[] = {
#include "scene/keys.def"
    {.path = NULL}};
#undef SECTION
#undef ALTERNATIVE
#undef STAGES

#define STAGES(...)
#define SECTION(...)
#define ALTERNATIVE(when, lowest, highest, ...)                                                                        \
    {.applies = when, .least = lowest, .most = highest, .paths = {__VA_ARGS__}},
static const struct key_alternative alternatives[] = {
#include "scene/keys.def"
    {.paths = {NULL}}};

/* ------------------------------------------------------------------ with those of the effects */

static struct keys all;

/* The longest of the places among rows, and from there on in those of all params, that `section` is in; NULL: none. */
static const char *place_of(const char *section)
{
    const char *best = NULL;
    const struct params *p = NULL;
    for (int i = 0; i == 0 || p; p = stages_params(i++))
        for (const struct key *k = p ? p->keys : rows; k && k->path; k++) {
            size_t n = strlen(k->path);
            if (!k->meaning && !strncmp(k->path, section, n) && strchr(".", section[n]) && (!best || strlen(best) < n))
                best = k->path;
        }
    return best;
}

/* "*" stands for all parts of the surface that are not named. */
static void rivals_add(struct key_alternative *t)
{
    const struct key_alternative old = *t;
    const struct params *p;
    int n = 0;
    for (int k = 0; old.paths[k]; k++) {
        bool rest = !strcmp(old.paths[k], "*");
        if (!rest) t->paths[n++] = old.paths[k];
        for (int i = 0; rest && (p = stages_params(i)); i++) {
            bool named = !p->ground || !p->ground->span;
            for (int m = 0; old.paths[m]; m++)
                named = named || !strcmp(old.paths[m], p->section);
            assert(named || n < KEYS_RIVALS);
            if (!named) t->paths[n++] = p->section;
        }
    }
    t->paths[n] = NULL;
    t->most = old.most == 1 ? 1 : n;
}

struct taken {
    struct key *keys;
    struct key_section *sections;
};

/* Of `in`; NULL: of nobody. */
static void rows_take(struct taken *t, const struct key *row, const struct params *in)
{
    const struct params *p;
    for (; row && row->path; row++)
        if (row->meaning) {
            *t->keys = *row;
            if (in && in->size) {
                t->keys->in = in;
                t->keys->offset += params_at(in);
            }
            t->keys++;
        } else
            for (int i = 0; (p = stages_params(i)); i++) {
                const char *place = place_of(p->section);
                if (!place || strcmp(place, row->path) != 0) continue;
                if (p->meaning)
                    *t->sections++ = (struct key_section){KEY_CONTACT, params_at(p), p->section, p->meaning, p};
                for (const struct key_section *s = p->sections; s && s->path; s++)
                    *t->sections++ = *s;
                rows_take(t, p->keys, p);
            }
}

static void tables_make(void)
{
    enum { MOST = 400, RIVALS = 20 };
    struct key *table = memory_take(MOST * sizeof *table);
    struct key_section *maps = memory_take(MOST * sizeof *maps);
    struct key_alternative *rivals = memory_take(RIVALS * sizeof *rivals), *r = rivals;
    struct taken t = {table, maps};
    const struct params *p;
    rows_take(&t, rows, NULL);
    for (const struct key_section *k = sections; k->path; k++)
        if (k->meaning) *t.sections++ = *k;
    for (const struct key_alternative *a = alternatives; a->paths[0]; a++) {
        *r = *a;
        rivals_add(r++);
    }
    for (int i = 0; (p = stages_params(i)); i++)
        for (const struct key_alternative *a = p->alternatives; a && a->paths[0]; a++) {
            *r = *a;
            rivals_add(r++);
        }
    assert(t.keys - table < MOST && t.sections - maps < MOST && r - rivals < RIVALS);
    t.keys->path = t.sections->path = r->paths[0] = NULL;
    all = (struct keys){table, maps, rivals};
}

const struct keys *keys_all(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, tables_make);
    return &all;
}

void *keys_field(const struct key *k, const void *owner)
{
    return (k->in ? (char *)params_block(owner) : (char *)owner) + k->offset;
}

bool *keys_given(const struct key_section *s, const void *owner)
{
    return (bool *)((s->in ? (char *)params_block(owner) : (char *)owner) + s->offset);
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
    for (const struct key *k = keys_table; k->path; k++)
        if (strcmp(k->path, path) == 0) return k;
    return NULL;
}

const struct key *keys_decider(const struct key *k)
{
    const char *name = k->applies ? k->applies + (k->applies[0] == '!') : "";
    size_t n = strcspn(name, "=");
    for (const struct key *other = keys_table; n > 0 && other->path; other++)
        if (other->path[0] == name[0] && strncmp(other->path, name, n) == 0 && !other->path[n]) return other;
    return NULL;
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
