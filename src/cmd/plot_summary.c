/* See plot_summary.h. A table is known by its hash, not by its name: files may have been renamed together. */
#include "cmd/plot_summary.h"

#include <jansson.h>
#include <string.h>

#include "base/hash.h"

static const char *text_of(const json_t *object, const char *key, struct arena *a)
{
    const char *text = json_string_value(json_object_get(object, key));
    return arena_text(a, text ? text : "");
}

static void contacts_read(struct plot_summary *s, const json_t *list, struct arena *a)
{
    size_t n = json_array_size(list);
    s->contacts = ARENA_TAKE(a, const char *, n);
    for (size_t i = 0; i < n; i++)
        s->contacts[s->n_contacts++] = text_of(json_array_get(list, i), "name", a);
}

static void files_read(struct plot_summary *s, const json_t *list, struct arena *a)
{
    size_t n = json_array_size(list);
    s->lists = json_is_array(list);
    for (int k = 0; k < 2; k++)
        s->tables[k] = ARENA_TAKE(a, const char *, n);
    for (size_t i = 0; i < n; i++) {
        const json_t *file = json_array_get(list, i);
        const char *kind = text_of(file, "kind", a);
        s->sounds = s->sounds || strcmp(kind, "wav") == 0;
        if (strcmp(kind, "scene") == 0)
            s->effective = text_of(file, "sha256", a);
        if (strcmp(kind, "csv") != 0 && strcmp(kind, "npy") != 0)
            continue;
        s->tables[0][s->n_tables] = text_of(file, "contact", a);
        s->tables[1][s->n_tables++] = text_of(file, "sha256", a);
    }
}

struct plot_summary plot_summary_read(const char *file, struct arena *a)
{
    json_t *whole = json_load_file(file, 0, NULL);
    struct plot_summary s = {.file = file, .title = text_of(whole, "scene", a), .there = whole, .effective = ""};
    contacts_read(&s, json_object_get(whole, "contacts"), a);
    files_read(&s, json_object_get(whole, "files"), a);
    json_decref(whole);
    return s;
}

/* NULL: it is not listed. Of several contacts each has a table, of one contact it needs no name. */
static const char *hash_of(const struct plot_summary *s, const char *contact)
{
    for (int i = 0; i < s->n_tables; i++)
        if (*contact ? s->n_tables > 1 && strcmp(s->tables[0][i], contact) == 0 : s->n_tables == 1)
            return s->tables[1][i];
    return NULL;
}

bool plot_summary_has(const struct plot_summary *s, const char *path, const char *contact, const char **why, struct err *e)
{
    char hex[HASH_TEXT];
    const char *hash = hash_of(s, contact);
    *why = hash ? "gives another sha256" : "does not list it";
    return hash && hash_file(path, hex, e) && strcmp(hash, hex) == 0;
}
