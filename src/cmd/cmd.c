/* See cmd.h: commands of several actions, recipes, scenes with the changes of the command line, help. */
#include "cmd/cmd.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/text.h"
#include "base/wrap.h"
#include "cmd/tell.h"
#include "file/yaml_bytes.h"
#include "file/yaml_parse.h"
#include "scene/scene_read.h"

static int count(const struct action *table)
{
    int n = 0;
    while (table[n].name)
        n++;
    return n;
}

/* "info, convert or synth" */
static const char *all_names(const struct action *table, struct arena *a)
{
    const char *list = table[0].name;
    for (int i = 1, n = count(table); i < n; i++)
        list = arena_format(a, "%s%s%s", list, i + 1 < n ? ", " : " or ", table[i].name);
    return list;
}

static const struct action *find(const char *command, const struct action *table, struct cmd_call *c, struct err *e)
{
    const char *word = c->args.operands[0], **names = ARENA_TAKE(c->arena, const char *, count(table) + 1);
    for (int i = 0; table[i].name; i++) {
        names[i] = table[i].name;
        if (!strcmp(word, table[i].name)) return &table[i];
    }
    const char *meant = text_nearest(word, names);
    if (meant)
        err_set(e, ERR_USAGE, "no action '%s'; did you mean '%s'?", word, meant);
    else
        err_set(e, ERR_USAGE, "no action '%s': write rasp %s %s", word, command, all_names(table, c->arena));
    return NULL;
}

/* The table of options is shared: one that belongs to another action is refused. */
static bool check_options(const char *command, const struct action *action, const struct args *g, struct err *e)
{
    for (const struct args_option *o = g->options; o->name; o++) {
        bool known = cmd_shared(o);
        for (int i = 0; i < CMD_ACTION_OPTIONS && action->options[i]; i++)
            known = known || !strcmp(o->name, action->options[i]);
        if (!known && args_given(g, o->name))
            return err_set(e, ERR_USAGE, "--%s is no option of rasp %s %s", o->name, command, action->name);
    }
    return true;
}

int cmd_actions(const char *command, const struct action *table, struct cmd_call *c, struct err *e)
{
    struct cmd_call inner = *c;
    const struct action *action = find(command, table, c, e);
    inner.args.operands++;
    int n = --inner.args.n_operands;
    if (!action || !check_options(command, action, &c->args, e)) return (int)e->kind;
    if (n < action->least || (action->most >= 0 && n > action->most)) {
        err_set(e, ERR_USAGE, "rasp %s %s takes %s", command, action->name, action->operands);
        return (int)e->kind;
    }
    return action->run(&inner, e);
}

/* Reading a recipe of surface keys, or a scene: see recipe.h. */

bool cmd_recipe_is_scene(struct cmd_call *c, const char *file, bool *is, struct err *e)
{
    size_t size;
    const char *text = yaml_bytes_text(file, c->arena, &size);
    *is = false;
    if (!text) return err_set(e, errno == EINTR ? ERR_INTERRUPTED : ERR_INPUT, "%s: %s", file, strerror(errno));
    for (const char *line = text; line && !*is; line = strchr(line, '\n')) {
        line += *line == '\n';
        *is = !strncmp(line, "rasp:", 5) || !strncmp(line, "include:", 8);
    }
    return true;
}

/* A double-quoted YAML string. */
static const char *quoted(struct arena *a, const char *text)
{
    char *out = arena_take(a, 4 * strlen(text) + 4, 1), *p = out;
    *p++ = '"';
    for (; *text; text++) {
        bool plain = (unsigned char)*text >= ' ' && *text != 0x7f && *text != '"' && *text != '\\';
        p += snprintf(p, 5, plain ? "%c" : "\\x%02x", (unsigned char)*text);
    }
    *p++ = '"';
    *p = '\0';
    return out;
}

static bool read_recipe(struct cmd_call *c, const char *file, const char *rest, struct scene *s, struct err *e)
{
    int n;
    const char **set = args_values(&c->args, "set", &n), *messages = "";
    const char *text = arena_format(c->arena, "rasp: 1\nsurface: {recipe: %s}\n%s", quoted(c->arena, file), rest);
    struct scene_overrides over = {.set = set, .n = n, .seed = args_value(&c->args, "seed")};
    struct err cause = {0};
    if (scene_read_made(text, file, &over, c->arena, s, &messages, &cause)) return true;
    tell_scene(c, s->diag, messages, cause.kind);
    return err_set(e, cause.kind, "%s %s", file, cause.kind == ERR_SCENE ? "is not a valid recipe" : "cannot be read");
}

bool cmd_recipe_read(struct cmd_call *c, const char *file, const char *rest, struct scene *s, struct err *e)
{
    bool scene;
    if (!cmd_recipe_is_scene(c, file, &scene, e)) return false;
    return scene ? cmd_read_scene(c, file, s, e) : read_recipe(c, file, rest, s, e);
}

const char *cmd_recipe_remark(struct cmd_call *c, const char *file, const char *key)
{
    struct yaml *y = yaml_open(c->arena);
    const struct diag_source *source = yaml_bytes_read(y, file, (struct diag_place){0});
    const struct yaml_node *map = source ? yaml_parse(y, source) : NULL,
                           *value = map && map->kind == YAML_MAP ? yaml_get(map, key) : NULL;
    if (!value || value->kind != YAML_SCALAR) return NULL;
    char *line = arena_text(c->arena, value->text);
    for (char *p = line; *p; p++)
        *p = *p == '\n' ? ' ' : *p;
    return line;
}

bool cmd_spares(const char *output, const char *what, const char *input, const char *cure, struct err *e)
{
    struct stat o, i;
    if (!output || !input || stat(output, &o) != 0 || stat(input, &i) != 0 || o.st_dev != i.st_dev ||
        o.st_ino != i.st_ino)
        return true;
    return err_set(e, ERR_CREATE, "%s: %s would overwrite the input %s; write elsewhere: %s", output, what, input,
                   cure);
}

/* What several subcommands share: reading a scene with the command line's changes, and --help. */

bool cmd_read_scene(struct cmd_call *c, const char *file, struct scene *s, struct err *e)
{
    int n;
    const char **set = args_values(&c->args, "set", &n);
    struct scene_overrides over = (struct scene_overrides){.set = set, .n = n, .seed = args_value(&c->args, "seed")};
    const char *messages = NULL;
    struct err cause = {0};
    if (scene_read(file, &over, c->arena, s, &messages, &cause)) return true;
    if (!messages || !*messages) return err_set(e, cause.kind, "%s", cause.text);
    tell_scene(c, s->diag, messages, cause.kind);
    return err_set(e, cause.kind, "%s %s", file,
                   cause.kind == ERR_SCENE ? "is not a valid scene" : "or a file it includes cannot be read");
}

/* ------------------------------------------------------------------ options */

static const struct args_option shared[] = {
    {"diagnostics", 0, "text|json", false,
     "errors and warnings as text (the default), or as JSON on standard error, one object a line"},
};

enum { SHARED = sizeof shared / sizeof *shared };

bool cmd_shared(const struct args_option *o)
{
    for (int i = 0; i < SHARED; i++)
        if (!strcmp(o->name, shared[i].name)) return true;
    return false;
}

const struct args_option *cmd_options(const struct command *m, struct arena *a)
{
    int n = 0;
    while (m->options[n].name)
        n++;
    struct args_option *all = ARENA_TAKE(a, struct args_option, n + SHARED + 1);
    if (n) memcpy(all, m->options, (size_t)n * sizeof *all);
    memcpy(all + n, shared, sizeof shared);
    return all;
}

/* ------------------------------------------------------------------ help */

static void print_option(const struct args_option *o)
{
    char head[96], letter[8] = "    ";
    if (o->letter) snprintf(letter, sizeof letter, "-%c, ", o->letter);
    int n = snprintf(head, sizeof head, "  %s--%s%s%s", letter, o->name, o->value ? "=" : "", o->value ? o->value : "");
    printf("%-26s  ", head);
    wrap_print(stdout, o->help, n > 26 ? n + 2 : 28, "                            ");
}

void cmd_print_help(const struct command *m)
{
    static const struct args_option help = {"help", 'h', NULL, false, "this text"};
    printf("rasp %s: %s\n\nExamples:\n", m->name, m->summary);
    for (const char *p = m->examples; *p;) {
        size_t n = strcspn(p, "\n");
        printf("  %.*s\n", (int)n, p);
        p += n + (p[n] == '\n');
    }
    printf("\nUsage: rasp %s [OPTION]...%s%s\n\n", m->name, *m->operands ? " " : "", m->operands);
    wrap_print(stdout, m->does, 0, "");
    printf("\nOptions:\n");
    struct arena *a = arena_open();
    for (const struct args_option *o = cmd_options(m, a); o->name; o++)
        print_option(o);
    arena_close(a);
    print_option(&help);
}
