/* See design_text.h. {FACTOR} stands for the text of the stimulus's level, or its label where it has none; {replicate} for its number. */
#include "batch/design_text.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

static const char cure[] = "write for instance: text: \"a {motion} on {material}\"";

static bool is_field(const char *s, size_t n, const char *name)
{
    return strlen(name) == n && strncmp(s, name, n) == 0;
}

/* ------------------------------------------------------------------ checking */

static void field_check(const struct design_reading *r, const struct yaml_node *node, const char *s, size_t n)
{
    if (!is_field(s, n, "replicate"))
        design_reading_factor(r, yaml_make(r->yaml, YAML_SCALAR, node->at, arena_format(r->arena, "%.*s", (int)n, s)));
}

static void fields_check(const struct design_reading *r, const struct yaml_node *node)
{
    for (const char *s = node->text + strcspn(node->text, "{}"); *s; s += strcspn(s, "{}")) {
        size_t n = strcspn(s + 1, "{}");
        if (*s == '}' || s[1 + n] != '}') {
            diag_add(r->yaml->diag, node->at, cure, "a brace is left open in '%s'", diag_shown(r->yaml->diag, node->text));
            return;
        }
        field_check(r, node, s + 1, n);
        s += n + 2;
    }
}

void design_text_read(const struct design_reading *r)
{
    const struct yaml_node *node = design_reading_value(r, "text");
    if (!node)
        return;
    if (node->kind != YAML_SCALAR || !*node->text) {
        design_reading_must(r, node, "text", "what the text of a trial is", cure);
        return;
    }
    r->design->text = node->text;
    fields_check(r, node);
}

/* ------------------------------------------------------------------ making */

/* False: the factor has no level here. */
static bool field_put(FILE *f, const struct design *d, const struct design_stimulus *s, const char *name, size_t n)
{
    if (is_field(name, n, "replicate"))
        return fprintf(f, "%d", s->replicate) > 0;
    for (int k = 0; k < d->n_factors; k++) {
        if (!is_field(name, n, d->factors[k].name))
            continue;
        const struct design_level *l = s->level[k] < 0 ? NULL : &d->factors[k].levels[s->level[k]];
        return l && fputs(l->text ? l->text : l->label, f) >= 0;
    }
    return false;
}

static bool template_put(FILE *f, const struct design *d, const struct design_stimulus *s)
{
    for (const char *t = d->text; *t;) {
        size_t n = strcspn(t, "{");
        fprintf(f, "%.*s", (int)n, t);
        t += n;
        size_t m = *t ? strcspn(t + 1, "}") : 0;
        if (*t && !field_put(f, d, s, t + 1, m))
            return false;
        t += *t ? m + 2 : 0;
    }
    return true;
}

/* Of a recording, what it says itself. */
static const char *own_text(const struct design *d, const struct design_stimulus *s)
{
    const struct yaml_node *entry = s->recording ? d->texts->cells[s->cell].entry : NULL, *own = entry ? yaml_get(entry, "text") : NULL;
    return own ? own->text : NULL;
}

const char *design_text(const struct design *d, int i, struct arena *a)
{
    const struct design_stimulus *s = &d->stimuli[i];
    char *memory = NULL;
    size_t size = 0;
    if (own_text(d, s) || !d->text)
        return own_text(d, s);
    FILE *f = memory_stream(&memory, &size);
    bool whole = template_put(f, d, s);
    memory_stream_end(f, &memory);
    const char *text = whole ? arena_text(a, memory) : NULL;
    free(memory);
    return text;
}
