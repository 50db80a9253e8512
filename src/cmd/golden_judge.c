/* What `rasp golden` has against a scene: files that are missing, stray, or not the same bytes; of these, how far they are off, by `rasp compare`. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cmd/golden.h"

void golden_judge_add(struct golden_scene *s, const char *file, const char *report, const char *format, ...)
{
    char text[1200];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    if (s->n_problems == s->room) {
        struct golden_problem *more = ARENA_TAKE(s->arena, struct golden_problem, s->room = 2 * s->room + 4);
        if (s->n_problems)
            memcpy(more, s->problems, (size_t)s->n_problems * sizeof *more);
        s->problems = more;
    }
    s->problems[s->n_problems++] = (struct golden_problem){file, arena_text(s->arena, text), report};
}

/* Two files that have not the same bytes, as `rasp compare` sees them: 0, ERR_DIFFERS, or its error. */
static int measure(struct golden_scene *s, const char *const files[2], const char **report, struct err *e)
{
    char *text = NULL;
    size_t size;
    bool sound = false;
    struct arena *a = arena_open();
    FILE *out = open_memstream(&text, &size);
    int code = ERR_MEMORY;
    if (out && compare_is_sound(files[1], &sound, e)) {
        struct compare_ask ask = sound ? s->sounds : s->tables;
        ask.files[0] = files[0];
        ask.files[1] = files[1];
        ask.out = out;
        ask.arena = a;
        code = sound ? compare_sound(&ask, e) : compare_table(&ask, e);
    }
    if (out)
        fclose(out);
    *report = arena_text(s->arena, text ? text : "");
    free(text);
    arena_close(a);
    return code;
}

/* The first file is what it should be. `what`: "what is kept". */
static void judge_bytes(struct golden_scene *s, const char *name, const char *const files[2], const char *what)
{
    struct err why = {0};
    const char *report;
    int code = measure(s, files, &report, &why);
    bool sound = strlen(name) > 4 && !strcmp(name + strlen(name) - 4, ".wav"), exact = sound ? s->sounds.exact : s->tables.exact;
    if (why.kind)
        golden_judge_add(s, name, NULL, "is not %s, and cannot be compared with it: %s", what, why.text);
    else if (code)
        golden_judge_add(s, name, report, "is not %s%s", what, exact ? "" : ", nor within its tolerances");
    else if (exact)
        golden_judge_add(s, name, NULL, "has the same %s as %s, but not the same bytes: what stands around them differs", sound ? "samples" : "cells", what);
    else
        s->note = arena_format(s->arena, "%s%s%s", s->note ? s->note : "", s->note ? ", " : "", name);
}

/* Is the kept file the one that was written? */
static void judge_kept(const struct golden *g, struct golden_scene *s, const struct golden_file *kept)
{
    const struct golden_sum *sum = g->hashes && g->kept ? golden_kept_sum(g, s->name, kept->name, s->arena) : NULL;
    if (sum && strcmp(sum->sha256, kept->sha256) != 0)
        golden_judge_add(s, kept->name, NULL, "the kept file is not the one whose hash is kept in %s: it was changed or damaged since", g->hashes);
    else if (!sum && g->hashes && g->kept)
        golden_judge_add(s, kept->name, NULL, "has no hash in %s", g->hashes);
}

static void judge_file(const struct golden *g, struct golden_scene *s, const struct golden_file *kept, int pass)
{
    const struct golden_file *made = golden_kept_find(&s->made[pass], kept->name);
    const char *new = golden_render_path(g, s, pass, kept->name, s->arena);
    if (pass == 0)
        judge_kept(g, s, kept);
    if (!made)
        golden_judge_add(s, kept->name, NULL, "is kept, but not made any more");
    else if (strcmp(made->sha256, kept->sha256) == 0)
        return;
    else if (g->kept)
        judge_bytes(s, kept->name, (const char *[]){arena_format(s->arena, "%s/%s/%s", g->kept, s->name, kept->name), new}, pass ? "what is kept (rendered from the effective scene)" : "what is kept");
    else
        golden_judge_add(s, kept->name, NULL, "is not what is kept%s: its sha256 is %s, where %s has %s; how far it is off only kept files could tell",
                         pass ? " (rendered from the effective scene)" : "", made->sha256, g->hashes, kept->sha256);
}

static void judge_nothing(const struct golden *g, struct golden_scene *s)
{
    struct arena *a = s->arena;
    golden_judge_add(s, "", NULL, "nothing is kept of it; this makes it: rasp golden update%s%s%s%s %s", g->kept ? " --kept " : "", g->kept ? g->kept : "", g->hashes ? " --hashes " : "",
                     g->hashes ? g->hashes : "", *s->at ? arena_format(a, "%.*s", (int)(strchr(s->at, ':') - s->at), s->at) : s->file);
}

void golden_judge(const struct golden *g, struct golden_scene *s, int pass)
{
    struct err why = {0};
    struct golden_files kept = golden_kept_of(g, s->name, s->arena, &why);
    if (why.kind)
        golden_judge_add(s, "", NULL, "%s", why.text);
    else if (s->made[pass].n == 0)
        golden_judge_add(s, "", NULL, "it makes neither a sound nor a table: there is nothing to keep");
    else if (kept.n == 0)
        judge_nothing(g, s);
    for (int i = 0; !why.kind && i < kept.n; i++)
        judge_file(g, s, &kept.list[i], pass);
    for (int i = 0; !why.kind && kept.n && i < s->made[pass].n; i++)
        if (!golden_kept_find(&kept, s->made[pass].list[i].name))
            golden_judge_add(s, s->made[pass].list[i].name, NULL, "is made, but not kept");
}

void golden_judge_twice(const struct golden *g, struct golden_scene *s)
{
    s->sounds.exact = s->tables.exact = true;
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < s->made[pass].n; i++) {
            const struct golden_file *one = &s->made[pass].list[i], *other = golden_kept_find(&s->made[1 - pass], one->name);
            const char *files[2] = {golden_render_path(g, s, 0, one->name, s->arena), golden_render_path(g, s, 1, one->name, s->arena)};
            if (!other)
                golden_judge_add(s, one->name, NULL, "was made by the %s render only", pass ? "second" : "first");
            else if (pass == 0 && strcmp(one->sha256, other->sha256) != 0)
                judge_bytes(s, one->name, files, "what the first render made");
        }
    if (s->made[0].n == 0)
        golden_judge_add(s, "", NULL, "it makes neither a sound nor a table: there is nothing to keep");
}
