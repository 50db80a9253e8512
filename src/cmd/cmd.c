/* What several subcommands share: reading a scene with the command line's changes, and --help. */
#include "cmd/cmd.h"

#include <string.h>

#include "base/wrap.h"
#include "cmd/tell.h"
#include "scene/scene_read.h"

static struct scene_overrides overrides(struct cmd_call *c)
{
    int n;
    const char **set = args_values(&c->args, "set", &n);
    return (struct scene_overrides){.set = set, .n = n, .seed = args_value(&c->args, "seed")};
}

bool cmd_read_scene(struct cmd_call *c, const char *file, struct scene *s, struct err *e)
{
    struct scene_overrides over = overrides(c);
    const char *messages = NULL;
    struct err cause = {0};
    if (scene_read(file, &over, c->arena, s, &messages, &cause))
        return true;
    if (!messages || !*messages)
        return err_set(e, cause.kind, "%s", cause.text);
    tell_scene(c, s->diag, messages, cause.kind);
    return err_set(e, cause.kind, "%s %s", file, cause.kind == ERR_SCENE ? "is not a valid scene" : "or a file it includes cannot be read");
}

/* ------------------------------------------------------------------ options */

static const struct args_option shared[] = {
    {"diagnostics", 0, "text|json", false, "errors and warnings as text (the default), or as JSON on standard error, one object a line"},
};

enum { SHARED = sizeof shared / sizeof *shared };

bool cmd_shared(const struct args_option *o)
{
    for (int i = 0; i < SHARED; i++)
        if (!strcmp(o->name, shared[i].name))
            return true;
    return false;
}

const struct args_option *cmd_options(const struct command *m, struct arena *a)
{
    int n = 0;
    while (m->options[n].name)
        n++;
    struct args_option *all = ARENA_TAKE(a, struct args_option, n + SHARED + 1);
    if (n)
        memcpy(all, m->options, (size_t)n * sizeof *all);
    memcpy(all + n, shared, sizeof shared);
    return all;
}

/* ------------------------------------------------------------------ help */

static void print_option(const struct args_option *o)
{
    char head[96], letter[8] = "    ";
    if (o->letter)
        snprintf(letter, sizeof letter, "-%c, ", o->letter);
    int n = snprintf(head, sizeof head, "  %s--%s%s%s", letter, o->name, o->value ? "=" : "", o->value ? o->value : "");
    printf("%-26s  ", head);
    wrap_print(stdout, o->help, n > 26 ? n + 2 : 28, "                            ");
}

static void print_indented(const char *lines)
{
    for (const char *p = lines; *p;) {
        size_t n = strcspn(p, "\n");
        printf("  %.*s\n", (int)n, p);
        p += n + (p[n] == '\n');
    }
}

void cmd_print_help(const struct command *m)
{
    static const struct args_option help = {"help", 'h', NULL, false, "this text"};
    printf("rasp %s: %s\n\nExamples:\n", m->name, m->summary);
    print_indented(m->examples);
    printf("\nUsage: rasp %s [OPTION]...%s%s\n\n", m->name, *m->operands ? " " : "", m->operands);
    wrap_print(stdout, m->does, 0, "");
    printf("\nOptions:\n");
    struct arena *a = arena_open();
    for (const struct args_option *o = cmd_options(m, a); o->name; o++)
        print_option(o);
    arena_close(a);
    print_option(&help);
}
