/* See design_names.h. Names are of the letters that BIDS allows in them; of a label what is not becomes _, but "1 Hz" is 1Hz. */
#include "batch/design_names.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "batch/design_names_check.h"

enum { NAME_MAX_BYTES = 1000, CHUNK = 1 << 16 };

enum { FIELD_TEXT = -1, FIELD_REPLICATE = -2, FIELD_ORDER = -3, FIELD_CELL = -4 };

struct piece {          /* of a template */
    int field;          /* a factor, or one of FIELD_ */
    const char *text;   /* of FIELD_TEXT              */
};

struct design_template {
    const struct yaml_node *node; /* NULL: the default's */
    struct piece *pieces;
    int n;
};

struct names {
    struct design_reading *r;
    const char ***labels;         /* [n_factors][n_levels], as names have them */
    char *chunk;
    size_t left;
    int width[3];                 /* digits of replicate, order, cell          */
};

/* ------------------------------------------------------------------ labels */

static bool is_letter(char c)
{
    return isalnum((unsigned char)c) || (c && strchr("+_.-", c));
}

/* What stands in a name for the character at s, of `size` bytes, that is no letter of names. */
static const char *instead(const char *label, const char *s, int size)
{
    static const char *const signs[][2] = {{"\xc2\xb5", "u"}, {"\xce\xbc", "u"}, {"\xc2\xb2", "2"}, {"\xc2\xb3", "3"}, {"\xc2\xb0", "deg"}};
    for (size_t i = 0; i < sizeof signs / sizeof signs[0]; i++)
        if (size == 2 && strncmp(s, signs[i][0], 2) == 0)
            return signs[i][1];
    return *s == ' ' && s > label && isdigit((unsigned char)s[-1]) && text_number_length(label) == (size_t)(s - label) ? "" : "_";
}

static const char *label_name(const char *label, struct arena *a)
{
    char *name = arena_take(a, 2 * strlen(label) + 4, 1), *to = name;
    for (const char *s = label; *s;) {
        uint32_t code;
        int n = text_utf8(s, strlen(s), &code);
        n = n ? n : 1;
        if (is_letter(*s))
            *to++ = *s;
        else
            to = stpcpy(to, instead(label, s, n));
        s += n;
    }
    return name;
}

/* ------------------------------------------------------------------ templates */

static int field_of(const struct design_reading *r, const struct yaml_node *node, const char *word)
{
    static const char *const own[] = {"replicate", "order", "cell"};
    for (int i = 0; i < 3; i++)
        if (strcmp(word, own[i]) == 0)
            return FIELD_REPLICATE - i;
    const char **names = ARENA_TAKE(r->arena, const char *, r->design->n_factors + 4);
    for (int f = 0; f < r->design->n_factors; f++) {
        if (strcmp(word, r->design->factors[f].name) == 0)
            return f;
        names[f] = r->design->factors[f].name;
    }
    memcpy(names + r->design->n_factors, own, sizeof own);
    const char *near = text_nearest(word, names);
    diag_add(r->yaml->diag, node->at, near ? arena_format(r->arena, "did you mean {%s}?", near) : arena_format(r->arena, "fields: %s", design_reading_joined(r, names)),
             "no field {%s}", diag_shown(r->yaml->diag, word));
    return FIELD_TEXT;
}

static void letters_check(const struct design_reading *r, const struct yaml_node *node, const char *text)
{
    uint32_t code;
    while (is_letter(*text) || *text == '/')
        text++;
    if (*text)
        diag_add(r->yaml->diag, node->at, "names are of letters a-z, digits, + _ . - and / for folders", "a name cannot hold '%.*s'",
                 text_utf8(text, strlen(text), &code), text);
}

/* One piece from s on; returns where the next begins. */
static const char *piece_read(const struct design_reading *r, struct design_template *t, const char *s)
{
    const char *end = s + strcspn(s, "{}");
    if (end > s) {
        const char *text = arena_format(r->arena, "%.*s", (int)(end - s), s);
        letters_check(r, t->node, text);
        t->pieces[t->n++] = (struct piece){FIELD_TEXT, text};
        return end;
    }
    size_t n = strcspn(s + 1, "{}");
    if (*s == '}' || s[1 + n] != '}') {
        diag_add(r->yaml->diag, t->node->at, "write for instance: name: \"{material}_r{replicate}\"", "a brace is left open in '%s'", diag_shown(r->yaml->diag, t->node->text));
        return s + strlen(s);
    }
    t->pieces[t->n++] = (struct piece){field_of(r, t->node, arena_format(r->arena, "%.*s", (int)n, s + 1)), ""};
    return s + n + 2;
}

static struct design_template template_read(const struct design_reading *r, const struct yaml_node *node)
{
    struct design_template t = {.node = node};
    if (node->kind != YAML_SCALAR || !*node->text || strlen(node->text) > NAME_MAX_BYTES) {
        design_reading_must(r, node, "name", "a text of at most 1000 letters", "write for instance: name: \"{material}_r{replicate}\"");
        return t;
    }
    t.pieces = ARENA_TAKE(r->arena, struct piece, strlen(node->text));
    for (const char *s = node->text; *s;)
        s = piece_read(r, &t, s);
    return t;
}

/* Of a path what stands between folder and ending, in the letters of names. */
static const char *stem_of(const char *file, struct arena *a)
{
    const char *slash = strrchr(file, '/'), *name = slash ? slash + 1 : file, *dot = strrchr(name, '.');
    return label_name(arena_format(a, "%.*s", (int)(dot && dot > name ? (size_t)(dot - name) : strlen(name)), name), a);
}

static void piece_add(struct design_template *t, int field, const char *text)
{
    t->pieces[t->n++] = (struct piece){field, text};
}

/* All factors, and the replicate where there are several; without either the name of the base. */
static struct design_template template_default(const struct design_reading *r)
{
    const struct design *d = r->design;
    struct design_template t = {.pieces = ARENA_TAKE(r->arena, struct piece, 2 * d->n_factors + 4)};
    for (int f = 0; f < d->n_factors; f++) {
        if (f)
            piece_add(&t, FIELD_TEXT, "_");
        piece_add(&t, f, "");
    }
    if (t.n == 0)
        piece_add(&t, FIELD_TEXT, stem_of(d->base, r->arena));
    if (d->replicates > 1) {
        piece_add(&t, FIELD_TEXT, "_r");
        piece_add(&t, FIELD_REPLICATE, "");
    }
    return t;
}

/* ------------------------------------------------------------------ making */

static const char *kept(struct names *x, const char *text, size_t n)
{
    if (x->left < n + 1) {
        x->chunk = arena_take(x->r->arena, CHUNK, 1);
        x->left = CHUNK;
    }
    char *to = memcpy(x->chunk, text, n);
    x->chunk += n + 1;
    x->left -= n + 1;
    return to;
}

static size_t number_put(char *to, size_t room, int digits, long number)
{
    int n = snprintf(to, room, "%0*ld", digits, number);
    return (size_t)n < room ? (size_t)n : room;
}

/* The name of stimulus i; one that is too long is cut, which is told later. */
static const char *expanded(struct names *x, const struct design_template *t, int i)
{
    char name[NAME_MAX_BYTES + 2];
    size_t n = 0, room = sizeof name - 1;
    const struct design_stimulus *s = &x->r->design->stimuli[i];
    const long numbers[3] = {s->replicate, i + 1, s->cell + 1};
    for (int k = 0; k < t->n && n < room; k++) {
        int field = t->pieces[k].field;
        const char *text = field == FIELD_TEXT ? t->pieces[k].text : field < 0 ? "" : s->level[field] < 0 ? "na" : x->labels[field][s->level[field]];
        if (field < FIELD_TEXT)
            n += number_put(name + n, room - n, x->width[FIELD_REPLICATE - field], numbers[FIELD_REPLICATE - field]);
        size_t size = strlen(text) < room - n ? strlen(text) : room - n;
        memcpy(name + n, text, size);
        n += size;
    }
    return kept(x, name, n);
}

static int digits_of(long n)
{
    return snprintf(NULL, 0, "%ld", n);
}

static void labels_make(struct names *x)
{
    const struct design *d = x->r->design;
    x->labels = ARENA_TAKE(x->r->arena, const char **, d->n_factors + 1);
    for (int f = 0; f < d->n_factors; f++) {
        x->labels[f] = ARENA_TAKE(x->r->arena, const char *, d->factors[f].n_levels);
        for (int i = 0; i < d->factors[f].n_levels; i++)
            x->labels[f][i] = label_name(d->factors[f].levels[i].label, x->r->arena);
    }
    x->width[0] = digits_of(d->replicates);
    x->width[1] = digits_of(d->n_stimuli);
    x->width[2] = digits_of(x->r->n_cells);
}

static const char *recording_name(struct names *x, int i, const struct design_cell *cell)
{
    const struct yaml_node *node = yaml_get(cell->entry, "name");
    if (!node)
        return stem_of(cell->recording, x->r->arena);
    struct design_template own = template_read(x->r, node);
    return expanded(x, &own, i);
}

void design_names_template(struct design_reading *r)
{
    const struct yaml_node *node = design_reading_value(r, "name");
    struct design_template *t = ARENA_TAKE(r->arena, struct design_template, 1);
    if (node)
        *t = template_read(r, node);
    r->template = t;
}

void design_names_make(struct design_reading *r)
{
    struct design *d = r->design;
    int errors = r->yaml->diag->n;
    struct names x = {.r = r};
    struct design_template t = r->template->node ? *r->template : template_default(r);
    labels_make(&x);
    for (int i = 0; i < d->n_stimuli && r->yaml->diag->n == errors; i++) {
        const struct design_cell *cell = &r->cells[d->stimuli[i].cell];
        d->stimuli[i].name = cell->recording ? recording_name(&x, i, cell) : expanded(&x, &t, i);
    }
    if (r->yaml->diag->n == errors)
        design_names_check(r);
}
