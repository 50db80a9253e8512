/* Names of stimuli from the template. Names are of the letters that BIDS allows in them; of a label what is not becomes
   _, but "1 Hz" is 1Hz.

   A stimulus NAME has the files NAME.wav, NAME.scene.yaml, NAME.json, and NAME.WORD.wav or NAME.WORD.csv of stems and
   of contacts. Sets are rendered here and played there: what Windows, macOS and memory sticks cannot tell apart, or
   cannot hold, is no name either. They do not tell a from A; Windows takes CON, and CON.wav, for a device, and leaves
   off a dot at the end. */
#include "batch/design_reading.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/relpath.h"
#include "base/text.h"

/* ------------------------------------------------------------------ names that cannot be */

enum { PART_LONGEST = 200, NAME_LONGEST = 1000 };

/* ------------------------------------------------------------------ one name */

static bool is_device(const char *s, size_t n)
{
    static const char *const words[] = {"con", "prn", "aux", "nul", "com", "lpt", NULL};
    size_t stem = strcspn(s, "./");
    stem = stem < n ? stem : n;
    for (int i = 0; words[i]; i++)
        if (strncasecmp(s, words[i], 3) == 0 && (i < 4 ? stem == 3 : stem == 4 && s[3] >= '1' && s[3] <= '9'))
            return true;
    return false;
}

/* What is wrong with a part between slashes; NULL: nothing. */
static const char *part_fault(const char *s, size_t n, const char **cure)
{
    static const char *const endings[] = {".wav", ".flac", ".csv", ".npy", ".json", ".yaml", ".yml", NULL};
    *cure = "write another template for name:, or other labels";
    if (n == 0) return "has a folder without a name";
    if (s[0] == '.')
        return "has a part that begins with a dot: it would be hidden, or lie outside of the output folder";
    if (n > PART_LONGEST) return "has a part of more than 200 letters";
    if (s[n - 1] == '.') return "has a part that ends with a dot, which Windows leaves off";
    if (is_device(s, n)) return "has a part that is a device on Windows, which cannot have such a file";
    *cure = "leave the ending out: each file gets its own";
    for (int i = 0; endings[i]; i++) {
        size_t m = strlen(endings[i]);
        if (n >= m && strncasecmp(s + n - m, endings[i], m) == 0) return "ends as a file does";
    }
    return NULL;
}

static const char *name_fault(const char *name, const char **cure)
{
    const char *fault = NULL;
    for (const char *s = name; !fault; s++) {
        size_t n = strcspn(s, "/");
        fault = part_fault(s, n, cure);
        s += n;
        if (!*s) break;
    }
    if (!fault && strlen(name) > NAME_LONGEST) {
        *cure = "write a shorter template for name:";
        fault = "has more than 1000 letters";
    }
    size_t first = strcspn(name, "/"); /* a folder SHA256SUMS/ would stand where the file shall be */
    if (!fault && (strcasecmp(name, "manifest") == 0 || strncasecmp(name, "manifest.", 9) == 0 ||
                   strcasecmp(name, "timings") == 0 || (first == 10 && strncasecmp(name, "SHA256SUMS", first) == 0))) {
        *cure = "write another template for name:";
        fault = "is that of a table of the set";
    }
    return fault;
}

/* ------------------------------------------------------------------ two names */

static int by_name(const void *pa, const void *pb)
{
    const struct design_stimulus *const *a = pa, *const *b = pb;
    int order = strcasecmp((*a)->name, (*b)->name);
    return order ? order : *a < *b ? -1 : *a > *b;
}

static int name_only(const void *name, const void *p)
{
    return strcasecmp(name, (*(const struct design_stimulus *const *)p)->name);
}

/* "wood, 2 Hz, replicate 2", "the recording wood.wav" */
static const char *called(const struct design_reading *r, const struct design_stimulus *s)
{
    const char *labels = design_reading_labels(r->design, s->level, r->arena);
    if (s->recording) return arena_format(r->arena, "the recording %s", s->recording);
    labels = *labels ? labels : "the scene";
    if (s->sample) labels = arena_format(r->arena, "%s, sample %d", labels, s->sample);
    return r->design->replicates > 1 ? arena_format(r->arena, "%s, replicate %d", labels, s->replicate) : labels;
}

/* What would tell the two apart. */
static const char *difference(const struct design_reading *r, const struct design_stimulus *a,
                              const struct design_stimulus *b)
{
    if (a->recording || b->recording) return "give the recording a name: of its own";
    if (a->sample != b->sample) return "put {sample} into name:";
    for (int f = 0; f < r->design->n_factors; f++)
        if (a->level[f] != b->level[f])
            return yaml_get(r->root, "name")
                       ? arena_format(r->arena, "put {%s} into name:, or write labels that differ in letters or digits",
                                      r->design->factors[f].name)
                       : "write labels that differ in letters or digits, or a template for name:";
    return a->replicate != b->replicate ? "put {replicate} into name:"
                                        : "the cell is listed twice: remove one, or write replicates:";
}

static struct diag_place place_of(const struct design_reading *r, const struct design_stimulus *s)
{
    const struct yaml_node *entry = r->cells[s->cell].entry, *name = yaml_get(s->recording ? entry : r->root, "name"),
                           *factors = yaml_get(r->root, "factors");
    return name ? name->at : entry ? entry->at : factors ? factors->key->at : r->root->at;
}

static void clash(const struct design_reading *r, const struct design_stimulus *a, const struct design_stimulus *b)
{
    const struct design_stimulus *first =
                                     a->cell < b->cell || (a->cell == b->cell && a->replicate < b->replicate) ? a : b,
                                 *second = first == a ? b : a;
    if (strcmp(a->name, b->name) == 0)
        diag_add(r->yaml->diag, place_of(r, second), difference(r, a, b), "two stimuli would be named '%s': %s; and %s",
                 diag_shown(r->yaml->diag, a->name), called(r, first), called(r, second));
    else if (strcasecmp(a->name, b->name) == 0)
        diag_add(r->yaml->diag, place_of(r, second),
                 "write labels that differ in more than capitals, or another template for name:",
                 "two stimuli would be named '%s' and '%s', which Windows and macOS take for one name",
                 diag_shown(r->yaml->diag, first->name), diag_shown(r->yaml->diag, second->name));
    else
        diag_add(r->yaml->diag, place_of(r, second), "write another template for name:, or other labels",
                 "files of '%s' and of '%s' could have one name, as .WORD may follow a name",
                 diag_shown(r->yaml->diag, first->name), diag_shown(r->yaml->diag, second->name));
}

/* The stimulus whose name the name continues with a dot and a word; NULL: there is none. */
static const struct design_stimulus *continued(const struct design_stimulus **sorted, int n, const char *name,
                                               struct arena *a)
{
    const char *slash = strrchr(name, '/');
    for (const char *dot = strchr(slash ? slash : name, '.'); dot; dot = strchr(dot + 1, '.')) {
        if (!isalpha((unsigned char)dot[1]) && dot[1] != '_') continue;
        const char *stem = arena_format(a, "%.*s", (int)(dot - name), name);
        const struct design_stimulus **found = bsearch(stem, sorted, (size_t)n, sizeof *sorted, name_only);
        if (found) return *found;
    }
    return NULL;
}

/* One clash is reported: they come in crowds. */
static void clashes(const struct design_reading *r)
{
    const struct design *d = r->design;
    const struct design_stimulus **sorted = ARENA_TAKE(r->arena, const struct design_stimulus *, d->n_stimuli + 1);
    for (int i = 0; i < d->n_stimuli; i++)
        sorted[i] = &d->stimuli[i];
    qsort(sorted, (size_t)d->n_stimuli, sizeof *sorted, by_name);
    for (int i = 0; i < d->n_stimuli; i++) {
        const struct design_stimulus *other =
            i > 0 && strcasecmp(sorted[i]->name, sorted[i - 1]->name) == 0 ? sorted[i - 1] : NULL;
        other = other ? other : continued(sorted, d->n_stimuli, sorted[i]->name, r->arena);
        if (other) {
            clash(r, other, sorted[i]);
            return;
        }
    }
}

/* ------------------------------------------------------------------ names */

enum { NAME_MAX_BYTES = 1000 };

enum { FIELD_TEXT = -1, FIELD_REPLICATE = -2, FIELD_ORDER = -3, FIELD_CELL = -4, FIELD_SAMPLE = -5 };
enum { SAMPLE_DIGITS = 6 /* of all numbers: more samples change no name */ };

struct piece {        /* of a template */
    int field;        /* a factor, or one of FIELD_ */
    const char *text; /* of FIELD_TEXT              */
};

struct design_template {
    const struct yaml_node *node; /* NULL: the default's */
    struct piece *pieces;
    int n;
};

struct names {
    struct design_reading *r;
    const char ***labels; /* [n_factors][n_levels], as names have them */
    int width[4];         /* digits of replicate, order, cell, sample  */
};

/* ------------------------------------------------------------------ labels */

static bool is_letter(char c) { return isalnum((unsigned char)c) || (c && strchr("+_.-", c)); }

static const char *label_name(const char *label, struct arena *a)
{
    static const char *const signs[][2] = {
        {"\xc2\xb5", "u"}, {"\xce\xbc", "u"}, {"\xc2\xb2", "2"}, {"\xc2\xb3", "3"}, {"\xc2\xb0", "deg"}};
    char *name = arena_take(a, 2 * strlen(label) + 4, 1), *to = name;
    for (const char *s = label; *s;) {
        uint32_t code;
        int n = text_utf8(s, strlen(s), &code);
        n = n ? n : 1;
        /* the blank between a number and its unit goes; "1 Hz" is 1Hz */
        bool gap =
            *s == ' ' && s > label && isdigit((unsigned char)s[-1]) && text_number_length(label) == (size_t)(s - label);
        const char *instead = gap ? "" : "_";
        for (size_t i = 0; n == 2 && i < sizeof signs / sizeof signs[0]; i++)
            if (strncmp(s, signs[i][0], 2) == 0) instead = signs[i][1];
        if (is_letter(*s))
            *to++ = *s;
        else
            to = stpcpy(to, instead);
        s += n;
    }
    return name;
}

/* ------------------------------------------------------------------ templates */

static int field_of(const struct design_reading *r, const struct yaml_node *node, const char *word)
{
    static const char *const own[] = {"replicate", "order", "cell", "sample"};
    for (int i = 0; i < 3 + (r->design->samples > 0); i++)
        if (strcmp(word, own[i]) == 0) return FIELD_REPLICATE - i;
    const char **names = ARENA_TAKE(r->arena, const char *, r->design->n_factors + 5);
    for (int f = 0; f < r->design->n_factors; f++) {
        if (strcmp(word, r->design->factors[f].name) == 0) return f;
        names[f] = r->design->factors[f].name;
    }
    memcpy(names + r->design->n_factors, own, sizeof own);
    const char *near = text_nearest(word, names);
    diag_add(r->yaml->diag, node->at,
             near ? arena_format(r->arena, "did you mean {%s}?", near)
                  : arena_format(r->arena, "fields: %s", design_reading_joined(r, names)),
             "no field {%s}", diag_shown(r->yaml->diag, word));
    return FIELD_TEXT;
}

/* One piece from s on; returns where the next begins. */
static const char *piece_read(const struct design_reading *r, struct design_template *t, const char *s)
{
    const char *end = s + strcspn(s, "{}");
    if (end > s) {
        const char *text = arena_format(r->arena, "%.*s", (int)(end - s), s), *bad = text;
        uint32_t code;
        while (is_letter(*bad) || *bad == '/')
            bad++;
        if (*bad)
            diag_add(r->yaml->diag, t->node->at, "names are of letters a-z, digits, + _ . - and / for folders",
                     "a name cannot hold '%.*s'", text_utf8(bad, strlen(bad), &code), bad);
        t->pieces[t->n++] = (struct piece){FIELD_TEXT, text};
        return end;
    }
    size_t n = strcspn(s + 1, "{}");
    if (*s == '}' || s[1 + n] != '}') {
        diag_add(r->yaml->diag, t->node->at, "write for instance: name: \"{material}_r{replicate}\"",
                 "a brace is left open in '%s'", diag_shown(r->yaml->diag, t->node->text));
        return s + strlen(s);
    }
    t->pieces[t->n++] = (struct piece){field_of(r, t->node, arena_format(r->arena, "%.*s", (int)n, s + 1)), ""};
    return s + n + 2;
}

static struct design_template template_of(const struct design_reading *r, const struct yaml_node *node,
                                          const char *text)
{
    struct design_template t = {.node = node, .pieces = ARENA_TAKE(r->arena, struct piece, strlen(text) + 1)};
    while (*text)
        text = piece_read(r, &t, text);
    return t;
}

static struct design_template template_read(const struct design_reading *r, const struct yaml_node *node)
{
    if (node->kind == YAML_SCALAR && *node->text && strlen(node->text) <= NAME_MAX_BYTES)
        return template_of(r, node, node->text);
    design_reading_must(r, node, "name", "a text of at most 1000 letters",
                        "write for instance: name: \"{material}_r{replicate}\"");
    return (struct design_template){.node = node};
}

/* ------------------------------------------------------------------ making */

/* The name of stimulus i; one that is too long is cut, which is reported later. */
static const char *expanded(const struct names *x, const struct design_template *t, int i)
{
    char name[NAME_MAX_BYTES + 2], digits[24];
    size_t n = 0, room = sizeof name - 1;
    const struct design_stimulus *s = &x->r->design->stimuli[i];
    const long numbers[4] = {s->replicate, i + 1, s->cell + 1, s->sample};
    for (int k = 0; k < t->n && n < room; k++) {
        int field = t->pieces[k].field;
        const char *text = field == FIELD_TEXT   ? t->pieces[k].text
                           : field < 0           ? ""
                           : s->level[field] < 0 ? "na"
                                                 : x->labels[field][s->level[field]];
        if (field < FIELD_TEXT) {
            snprintf(digits, sizeof digits, "%0*ld", x->width[FIELD_REPLICATE - field],
                     numbers[FIELD_REPLICATE - field]);
            text = digits;
        }
        size_t size = strlen(text) < room - n ? strlen(text) : room - n;
        memcpy(name + n, text, size);
        n += size;
    }
    name[n] = '\0';
    return arena_text(x->r->arena, name);
}

void design_names_template(struct design_reading *r)
{
    const struct yaml_node *node = design_reading_value(r, "name");
    struct design_template *t = ARENA_TAKE(r->arena, struct design_template, 1);
    if (node) *t = template_read(r, node);
    r->template = t;
}

void design_names_make(struct design_reading *r)
{
    struct design *d = r->design;
    int errors = r->yaml->diag->n;
    struct names x = {.r = r};
    struct design_template t = *r->template;
    if (!t.node) { /* all factors that are listed, the sample, the replicate; without any the name of the base */
        const char *text = d->n_factors ? "" : label_name(relpath_stem(d->base, r->arena), r->arena);
        for (int f = 0; f < d->n_factors; f++)
            if (!d->factors[f].drawn)
                text = arena_format(r->arena, "%s%s{%s}", text, *text ? "_" : "", d->factors[f].name);
        if (d->samples) text = arena_format(r->arena, "%s%ss{sample}", text, *text ? "/" : "");
        t = template_of(r, r->root, arena_format(r->arena, "%s%s", text, d->replicates > 1 ? "_r{replicate}" : ""));
    }
    const long most[3] = {d->replicates, d->n_stimuli, r->n_cells};
    for (int k = 0; k < 3; k++)
        x.width[k] = snprintf(NULL, 0, "%ld", most[k]);
    x.width[3] = SAMPLE_DIGITS;
    struct arena *own = arena_open();
    x.labels = ARENA_TAKE(own, const char **, d->n_factors + 1);
    for (int f = 0; f < d->n_factors; f++) {
        x.labels[f] = ARENA_TAKE(own, const char *, d->factors[f].n_levels);
        for (int i = 0; i < d->factors[f].n_levels; i++)
            x.labels[f][i] = label_name(d->factors[f].levels[i].label, own);
    }
    for (int i = 0; i < d->n_stimuli && r->yaml->diag->n == errors; i++) {
        const struct design_cell *cell = &r->cells[d->stimuli[i].cell];
        const struct yaml_node *node = cell->recording ? yaml_get(cell->entry, "name") : NULL;
        struct design_template named = node ? template_read(r, node) : t;
        d->stimuli[i].name = cell->recording && !node ? label_name(relpath_stem(cell->recording, r->arena), r->arena)
                                                      : expanded(&x, &named, i);
    }
    arena_close(own);
    for (int i = 0; i < d->n_stimuli && r->yaml->diag->n == errors; i++) {
        const struct design_stimulus *s = &d->stimuli[i];
        const char *cure, *fault = name_fault(s->name, &cure);
        if (fault)
            diag_add(r->yaml->diag, place_of(r, s), cure, "the name '%s' of %s %s", diag_shown(r->yaml->diag, s->name),
                     called(r, s), fault);
    }
    if (r->yaml->diag->n == errors) clashes(r);
}
