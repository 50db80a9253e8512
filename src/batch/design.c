/* See design.h. The parts in order: rules (design_rules), what is changed (design_factors, design_changes, design_columns), cells (design_cells), stimuli
   (design_stimuli), names (design_names). Each step tells all its errors; the later ones need the earlier ones whole. */
#include "batch/design.h"

#include <string.h>

#include "base/interrupt.h"
#include "batch/design_cells.h"
#include "batch/design_factors.h"
#include "batch/design_names.h"
#include "batch/design_rules.h"
#include "batch/design_stimuli.h"
#include "batch/design_text.h"
#include "file/yaml_bytes.h"
#include "file/yaml_parse.h"
#include "scene/keys_text.h"

static const char *const keys[] = {"rasp-design", "title", "text", "base", "seed",  "set",  "factors", "exclude", "cells", "recordings", "replicates",
                                   "independent", "order", "name", "level", "length", NULL};

/* The parts after another, as far as the earlier ones are good. */
static void parts_read(struct design_reading *r)
{
    const struct diag *errors = r->yaml->diag;
    design_reading_known(r, r->root, keys, "");
    design_rules_read(r);
    design_factors_read(r);
    design_rules_independent(r);
    design_names_template(r);
    design_text_read(r);
    if (errors->n == 0)
        design_cells_make(r);
    if (errors->n == 0)
        design_stimuli_make(r);
    if (errors->n == 0)
        design_names_make(r);
    r->texts->cells = r->cells;
    if (errors->n == 0)
        design_stimuli_hash(r);
}

/* A design of another version: what else looks wrong in it need not be. */
static bool another_version(struct yaml *y, const struct yaml_node *root)
{
    const struct yaml_node *node = yaml_get(root, "rasp-design");
    if (!node || node->kind != YAML_SCALAR || !*node->text || strspn(node->text, "0123456789") != strlen(node->text) || strcmp(node->text, "1") == 0)
        return false;
    diag_add(y->diag, node->at, "this program reads designs of version 1, written rasp-design: 1; a newer one may read this design",
             "rasp-design must be 1, not '%s'", diag_shown(y->diag, node->text));
    return true;
}

/* Which a design was asked for: what is wrong with it as one is no help. */
static bool a_scene(struct yaml *y, const struct yaml_node *root)
{
    const struct yaml_node *node = yaml_get(root, "rasp");
    if (!node || yaml_get(root, "rasp-design"))
        return false;
    y->diag->n = 0;
    diag_add(y->diag, node->key->at, "rasp render renders it, rasp check checks it; rasp new design writes a starter design", "this is a scene, not a design of many scenes");
    return true;
}

static void text_read(struct yaml *y, const struct diag_source *source, struct design *d)
{
    struct yaml_node *root = yaml_parse(y, source);
    struct design_reading r = {.yaml = y, .arena = y->arena, .root = root, .design = d, .texts = ARENA_TAKE(y->arena, struct design_texts, 1)};
    d->texts = r.texts;
    if (!root)
        return;
    if (root->kind != YAML_MAP) {
        diag_add(y->diag, root->at, "write keys with values, such as: base: scrape.yaml", "a design must be a map of keys");
        return;
    }
    if (another_version(y, root) || a_scene(y, root))
        return;
    r.keys = keys_text_names(y->arena);
    parts_read(&r);
}

bool design_read(const char *file, struct arena *a, struct design *d, const char **messages, struct err *e)
{
    struct yaml *y = yaml_open(a);
    struct diag_source *source = yaml_bytes_read(y, file, (struct diag_place){NULL, 0, 0, 0});
    *d = (struct design){.file = arena_text(a, file), .sources = ARENA_TAKE(a, const char *, 2)};
    d->sources[0] = d->file;
    d->diag = y->diag;
    *messages = "";
    if (source)
        text_read(y, source, d);
    if (y->diag->n == 0)
        return true;
    *messages = diag_text(y->diag);
    return err_set(e, y->missing ? interrupt_seen() ? ERR_INTERRUPTED : ERR_INPUT : ERR_SCENE, "%s", diag_first(y->diag));
}

const char *design_label(const struct design *d, int i, int factor)
{
    int level = d->stimuli[i].level[factor];
    return level < 0 ? "n/a" : d->factors[factor].levels[level].label;
}

const char *design_value(const struct design *d, int i, int factor)
{
    int level = d->stimuli[i].level[factor];
    return level < 0 ? "n/a" : d->factors[factor].levels[level].value;
}

/* A line's beginning, after { in flow style ({rasp-design: 1, ...}), is the key, quoted perhaps. */
static bool names_design(const char *line, bool flow)
{
    static const char key[] = "rasp-design";
    const char *at = line + (flow ? strspn(line, "{ \t") : 0), *s = at + (*at == '"' || *at == '\'');
    size_t n = strlen(key);
    return !strncmp(s, key, n) && (s[n] == ':' || s[n] == ' ' || (s != at && s[n] == *at));
}

bool design_is(const char *file)
{
    struct arena *a = arena_open();
    size_t size;
    const char *text = yaml_bytes_text(file, a, &size), *end = text ? text + size : NULL;
    bool found = false, flow = false;
    for (const char *line = text; line && line < end && !found;) {
        flow = flow || *line == '{';
        found = names_design(line, flow);
        line = memchr(line, '\n', (size_t)(end - line));
        line = line ? line + 1 : NULL;
    }
    arena_close(a);
    return found;
}
