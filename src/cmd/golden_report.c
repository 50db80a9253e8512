/* What `rasp golden` prints: lines for people, or the Test Anything Protocol, version 13, each failure with a YAML block. */
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "cmd/golden.h"

void golden_report_begin(const struct golden *g, int points)
{
    if (g->tap)
        printf("TAP version 13\n1..%d\n", points);
}

/* 'text' in YAML. */
static void put_quoted(const struct golden *g, const char *text)
{
    putchar('\'');
    for (const char *p = text_shown(g->call->arena, text); *p; p++)
        fputs(*p == '\'' ? "''" : (const char[]){*p, '\0'}, stdout);
    puts("'");
}

static void put_lines(const char *text, const char *before)
{
    for (const char *p = text; *p;) {
        size_t n = strcspn(p, "\n");
        printf("%s%.*s\n", before, (int)n, p);
        p += n + (p[n] == '\n');
    }
}

static void put_yaml(const struct golden *g, const struct golden_scene *s)
{
    fputs("  ---\n  scene: ", stdout);
    put_quoted(g, s->file);
    puts("  severity: fail\n  problems:");
    for (int i = 0; i < s->n_problems; i++) {
        const struct golden_problem *p = &s->problems[i];
        if (*p->file) {
            fputs("    - file: ", stdout);
            put_quoted(g, p->file);
        }
        fputs(*p->file ? "      says: " : "    - says: ", stdout);
        put_quoted(g, p->says);
        if (p->report) {
            puts("      report: |");
            put_lines(p->report, "        ");
        }
    }
    puts("  ...");
}

static void tap_scene(const struct golden *g, const struct golden_scene *s, int number)
{
    printf("%sok %d - %s", s->n_problems ? "not " : "", number, s->name);
    puts(s->note && !s->n_problems ? arena_format(g->call->arena, " (within its tolerances: %s)", s->note) : "");
    if (s->n_problems)
        put_yaml(g, s);
}

void golden_report_scene(const struct golden *g, const struct golden_scene *s, int number)
{
    struct arena *a = g->call->arena;
    if (g->tap) {
        tap_scene(g, s, number);
    } else if (s->n_problems) {
        printf("FAILED  %s (%s)\n", s->name, text_shown(a, s->file));
        for (int i = 0; i < s->n_problems; i++) {
            const struct golden_problem *p = &s->problems[i];
            printf("    %s%s%s\n", text_shown(a, p->file), *p->file ? ": " : "", text_shown(a, p->says));
            if (p->report)
                put_lines(p->report, "        ");
        }
    } else if (!g->quiet) {
        printf("ok      %s%s%s%s\n", s->name, s->note ? " (within its tolerances: " : "", s->note ? s->note : "", s->note ? ")" : "");
    }
    fflush(stdout);
}

void golden_report_strays(const struct golden *g, const char *const *strays, int number)
{
    static const char says[] = "is kept, and no scene of the list makes it: remove it, or list its scene";
    if (g->tap) {
        printf("%sok %d - nothing else is kept\n", *strays ? "not " : "", number);
        if (*strays)
            puts("  ---\n  severity: fail\n  strays:");
        for (const char *const *p = strays; *p; p++) {
            fputs("    - ", stdout);
            put_quoted(g, *p);
        }
        if (*strays)
            puts("  ...");
        return;
    }
    for (; *strays; strays++)
        printf("FAILED  %s: %s\n", text_shown(g->call->arena, *strays), says);
}

void golden_report_end(const struct golden *g, int good, int points)
{
    if (!g->tap && (!g->quiet || good < points))
        printf("%d passed, %d failed\n", good, points - good);
}
