/* See message.h. Painted are the first "error:" or "warning:" at a line's start or after ": ", and what a message adds
 * below the line it shows. */
#include "cmd/message.h"

#include <ctype.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"
#include "cmd/cmd.h"
#include "file/json_value.h"

#define RED "\033[1;31m"
#define MAGENTA "\033[1;35m"
#define GREEN "\033[1;32m"
#define CYAN "\033[1;36m"
#define PLAIN "\033[m"

/* The text in line[0..n), at its start or after ": ". */
static const char *find(const char *line, size_t n, const char *text)
{
    size_t m = strlen(text);
    for (size_t i = 0; i + m <= n; i++)
        if (!strncmp(line + i, text, m) && (i == 0 || (i >= 2 && line[i - 1] == ' ' && line[i - 2] == ':')))
            return line + i;
    return NULL;
}

void message_paint(FILE *f, const char *lines)
{
    /* A terminal, whose TERM is neither empty nor dumb, and NO_COLOR is not set or empty (no-color.org). */
    const char *off = getenv("NO_COLOR"), *term = getenv("TERM");
    bool colours = !(off && *off) && term && *term && strcmp(term, "dumb") != 0 && isatty(fileno(f));
    if (!colours) fputs(lines, f);
    for (size_t n; colours && *lines; lines += n) {
        n = strcspn(lines, "\n");
        size_t bar = strspn(lines, " 0123456789"), mark = bar < n ? bar + 1 + strspn(lines + bar + 1, " \t") : n;
        const char *error = find(lines, n, "error:"), *warning = find(lines, n, "warning:"), *at = NULL, *colour = RED;
        size_t size = 6;
        if (bar < n && bar >= 4 && lines[bar] == '|') {
            at = mark < n && lines[mark] == '^' && strspn(lines, " ") == bar ? lines + mark : NULL;
            size = n - mark;
            colour = GREEN;
        } else if (!strncmp(lines, "      = help:", 13)) {
            at = lines + 8;
            size = 5;
            colour = CYAN;
        } else if (error && (!warning || error < warning))
            at = error;
        else if ((at = warning)) {
            size = 8;
            colour = MAGENTA;
        }
        if (at)
            fprintf(f, "%.*s%s%.*s%s%.*s", (int)(at - lines), lines, colour, (int)size, at, PLAIN,
                    (int)(lines + n - at - (ptrdiff_t)size), at + size);
        else
            fwrite(lines, 1, n, f);
        if (lines[n]) fputc(lines[n++], f);
    }
}

/* Where a number that stands by itself ends, NULL: none begins here. Those in names, c2 or hit-3.wav, do not stand by
 * themselves. */
static const char *number_end(const char *at, char before)
{
    bool sign = *at == '-' || *at == '+';
    if (!strchr(" (", before) || !isdigit((unsigned char)at[sign])) return NULL;
    char *end;
    strtod(at, &end);
    return end;
}

static bool alike(const char *a, const char *b)
{
    char before = 0;
    while (*a && *b) {
        const char *past[2] = {number_end(a, before), number_end(b, before)};
        if (past[0] && past[1]) {
            a = past[0];
            b = past[1];
        } else if (*a++ != *b++)
            return false;
        before = a[-1];
    }
    return *a == *b;
}

struct warning *message_add(struct warning **all, const char *file, const char *text, bool exact, struct arena *a)
{
    struct warning **at = all, *w = NULL, *near = NULL;
    for (; *at && !w; at = &(*at)->next) {
        bool last = strcmp((*at)->files[(*at)->n - 1], file) == 0;
        if (strcmp((*at)->text, text) == 0 && !(last && (*at)->other))
            w = *at;
        else if (!exact && !near && !last && alike((*at)->text, text))
            near = *at;
    }
    if (w)
        w->other = false;
    else if (near) {
        w = near;
        w->numbers = w->other = true;
    } else {
        w = *at = ARENA_TAKE(a, struct warning, 1);
        w->text = text;
    }
    if (w->n > 0 && !strcmp(w->files[w->n - 1], file)) return w;
    w->files = arena_more(a, w->files, w->n, sizeof *w->files);
    w->files[w->n++] = file;
    return w;
}

enum { FILES_NAMED = 4 /* of a warning that several scenes have */ };

struct messages {
    bool json, group;
    bool reported;     /* message_scene has said what message_error would */
    json_t *collected; /* NULL: nothing is collected */
    struct warning *warnings;
};

static struct messages *of(struct cmd_call *c)
{
    if (!c->messages) c->messages = ARENA_TAKE(c->arena, struct messages, 1);
    return c->messages;
}

void message_as_json(struct cmd_call *c) { of(c)->json = true; }

bool message_begin(struct cmd_call *c, struct err *e)
{
    static const char *const formats[] = {"text", "json"};
    int json = 0;
    if (!cmd_either(c, "diagnostics", formats, &json, e)) return false;
    of(c)->json = json;
    return true;
}

/* ------------------------------------------------------------------ JSON */

static json_t *object(const char *severity, enum err_kind kind)
{
    return json_value_object("severity:s file:0 line:0 column:0 width:0 message:0 help:0 code:w", severity, (int)kind);
}

static void set_place(json_t *o, int line, int column, int width)
{
    json_value_set(o, "line:w column:w width:w", line, line > 0 ? column : 0, line > 0 ? width : 0);
}

/* An option, such as --set motion.rate, has neither file nor line. */
static void set_source(json_t *o, const struct diag_place *at, struct arena *a)
{
    bool lines = at->source && !at->source->option && !at->source->made;
    json_value_set(o, "$:s", at->source && at->source->option ? "option" : "file",
                   at->source ? text_shown(a, at->source->name) : NULL);
    set_place(o, lines ? at->line : 0, at->column, at->width);
}

static json_t *of_err(const struct err *e)
{
    json_t *o = object("error", e->kind);
    const struct err_place *p = &e->place;
    json_t *file = p->file > 0 ? json_stringn(e->text, (size_t)p->file) : NULL;
    json_value_set(o, "file:o message:s", file ? file : json_null(),
                   p->message < (int)strlen(e->text) ? e->text + p->message : e->text);
    set_place(o, p->line, p->column, p->width);
    return o;
}

static void print(json_t *o)
{
    char *text = json_dumps(o, JSON_ENSURE_ASCII);
    fprintf(stderr, "%s\n", text ? text : "{}");
    free(text);
}

static void put(struct cmd_call *c, json_t *o)
{
    if (of(c)->collected) json_array_append(of(c)->collected, o);
    if (of(c)->json) print(o);
    json_decref(o);
}

/* ------------------------------------------------------------------ errors */

void message_scene(struct cmd_call *c, const struct diag *d, const char *messages, enum err_kind kind)
{
    struct messages *t = of(c);
    for (int i = 0; (t->json || t->collected) && d && i < d->n && i < DIAG_STORED; i++) {
        const struct diag_error *x = &d->errors[i];
        json_t *o = object("error", kind), *named = json_array();
        set_source(o, &x->at, c->arena);
        json_value_set(o, "message:s help:s", x->text, x->help);
        const struct diag_place *at = x->at.source ? &x->at.source->named : NULL;
        if (at && at->source) json_object_set(o, "named_at", named);
        for (; at && at->source && !at->source->made; at = &at->source->named) {
            json_t *one = json_object();
            set_source(one, at, c->arena);
            json_array_append_new(named, one);
        }
        json_decref(named);
        put(c, o);
    }
    t->reported = (t->json || t->collected) && d && d->n > 0;
    if (t->json) return;
    message_paint(stderr, messages);
    if (*messages && messages[strlen(messages) - 1] != '\n') fputc('\n', stderr);
}

/* ":12" at the beginning of a text; the rest is behind it, NULL: there is none. */
static const char *number_at(const char *text, int *n)
{
    size_t digits = *text == ':' ? strspn(text + 1, "0123456789") : 0;
    *n = digits && digits < 10 ? (int)strtol(text + 1, NULL, 10) : 0;
    return *n > 0 ? text + 1 + digits : NULL;
}

/* "FILE:LINE:COLUMN: " or "FILE:LINE: " at the beginning of a text. */
static struct err_place place_in(const char *text)
{
    for (const char *at = strchr(text, ':'); at; at = strchr(at + 1, ':')) {
        struct err_place p = {.file = (int)(at - text)};
        const char *line = at > text ? number_at(at, &p.line) : NULL,
                   *column = line ? number_at(line, &p.column) : NULL, *end = column ? column : line;
        if (end && !strncmp(end, ": ", 2)) {
            p.message = (int)(end - text) + 2;
            return p;
        }
    }
    return (struct err_place){0};
}

void message_error(struct cmd_call *c, const char *command, const struct err *e)
{
    struct messages *t = of(c);
    struct err placed = *e;
    for (int i = 0; !placed.place.file && i < c->args.n_operands; i++) { /* one of the operands, or "OPERAND: " */
        int n = (int)strlen(c->args.operands[i]);
        if (!n || strncmp(e->text, c->args.operands[i], (size_t)n) != 0 || e->text[n] != ':') continue;
        placed.place = place_in(e->text);
        if (placed.place.file == n) break;
        placed.place = e->text[n + 1] == ' ' ? (struct err_place){.file = n, .message = n + 2} : (struct err_place){0};
        break;
    }
    if ((t->json || t->collected) && !t->reported) put(c, of_err(&placed));
    t->reported = false;
    if (!t->json) cmd_complain(command, e);
}

void message_stimulus(struct cmd_call *c, const char *command, const char *stimulus, const char *file,
                      const struct err *e)
{
    struct messages *t = of(c);
    if (t->json) {
        struct err placed = *e;
        placed.place = place_in(e->text);
        json_t *o = of_err(&placed);
        if (!placed.place.file && file) json_value_set(o, "file:s", file);
        json_value_set(o, "stimulus:s", stimulus);
        put(c, o);
    } else {
        struct err named = {0};
        err_set(&named, e->kind, "%s: %s", stimulus, e->text);
        cmd_complain(command, &named);
    }
}

void message_collect(struct cmd_call *c) { of(c)->collected = json_array(); }

json_t *message_collected(struct cmd_call *c)
{
    json_t *collected = of(c)->collected;
    of(c)->collected = NULL;
    return collected;
}

/* ------------------------------------------------------------------ warnings */

static void warn_json(const struct warning *w)
{
    json_t *o = object("warning", ERR_NONE);
    json_value_set(o, "$:s message:s", w->stimuli ? "stimulus" : "file", w->files[0], w->text);
    if (w->n > 1) json_value_set(o, "$:t", w->stimuli ? "stimuli" : "files", w->files, w->n);
    print(o);
    json_decref(o);
}

/* In text "... (and of 2 other scenes: b.yaml, c.yaml)", or "... (and, with other numbers, of ...". */
static void warn(struct cmd_call *c, const struct warning *w)
{
    struct arena *a = c->arena;
    if (of(c)->json) {
        warn_json(w);
        return;
    }
    const char *all = arena_format(a, "%s: warning: %s", w->files[0], w->text);
    if (w->n > 1)
        all = arena_format(a, "%s (and%s of %d other scene%s:", all, w->numbers ? ", with other numbers," : "",
                           w->n - 1, w->n > 2 ? "s" : "");
    for (int i = 1; i < w->n && i <= FILES_NAMED; i++)
        all = arena_format(a, "%s%s %s", all, i > 1 ? "," : "", w->files[i]);
    if (w->n > 1) all = arena_format(a, "%s%s)", all, w->n - 1 > FILES_NAMED ? ", ..." : "");
    message_paint(stderr, arena_format(a, "%s\n", all));
}

static void warn_of(struct cmd_call *c, const char *name, const char *text, bool stimulus)
{
    const char *shown = text_shown(c->arena, name);
    text = text_shown(c->arena, text);
    if (of(c)->group)
        message_add(&c->messages->warnings, shown, text, c->messages->json, c->arena)->stimuli = stimulus;
    else
        warn(c, &(struct warning){.text = text, .files = &shown, .n = 1, .stimuli = stimulus});
}

void message_warning(struct cmd_call *c, const char *file, const char *text) { warn_of(c, file, text, false); }

void message_stimulus_warning(struct cmd_call *c, const char *stimulus, const char *text)
{
    warn_of(c, stimulus, text, true);
}

void message_remark(struct cmd_call *c, const char *command, const char *text)
{
    text = text_shown(c->arena, text);
    if (of(c)->json)
        warn_json(&(struct warning){.text = text, .files = &(const char *){NULL}, .n = 1});
    else
        message_paint(stderr, arena_format(c->arena, "rasp %s: warning: %s\n", command, text));
}

void message_group(struct cmd_call *c) { of(c)->group = true; }

void message_end(struct cmd_call *c)
{
    for (const struct warning *w = c->messages ? c->messages->warnings : NULL; w; w = w->next)
        warn(c, w);
    if (c->messages) c->messages->warnings = NULL;
}
