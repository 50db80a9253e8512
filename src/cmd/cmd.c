/* See cmd.h: the table of commands, commands of several actions, recipes, scenes with the changes of the command line,
   running a command. */
#include "cmd/cmd.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <gsl/gsl_errno.h>
#include <jansson.h>
#include <signal.h>
#include <stdio.h>
#include <stdio_ext.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/err.h"
#include "base/interrupt.h"
#include "base/memory.h"
#include "base/text.h"
#include "cmd/message.h"
#include "file/yaml.h"
#include "scene/keys_yaml.h"
#include "scene/scene_read.h"
#include "scene/units.h"

int cmd_actions(const char *command, const struct action *table, struct cmd_call *c, struct err *e)
{
    const char *word = c->args.operands[0], *names[CMD_ACTIONS + 1] = {NULL}, *list = "";
    const struct action *action = NULL;
    for (int i = 0; table[i].name; i++) {
        names[i] = table[i].name;
        list = arena_format(c->arena, "%s%s%s", list, i == 0 ? "" : table[i + 1].name ? ", " : " or ", names[i]);
        if (!strcmp(word, table[i].name)) action = &table[i];
    }
    const char *meant = action ? NULL : text_nearest(word, names);
    if (meant)
        err_set(e, ERR_USAGE, "no action '%s'; did you mean '%s'?", word, meant);
    else if (!action)
        err_set(e, ERR_USAGE, "no action '%s': write rasp %s %s", word, command, list);
    if (!action) return (int)e->kind;
    /* The table of options is shared: one that belongs to another action is refused. */
    for (const struct args_option *o = c->args.options; o->name; o++) {
        bool known = cmd_shared(o);
        for (int i = 0; i < CMD_ACTION_OPTIONS && action->options[i]; i++)
            known = known || !strcmp(o->name, action->options[i]);
        if (!known && args_given(&c->args, o->name))
            err_set(e, ERR_USAGE, "--%s is no option of rasp %s %s", o->name, command, action->name);
    }
    struct cmd_call inner = *c;
    inner.args.operands++;
    int n = --inner.args.n_operands;
    if (n < action->least || (action->most >= 0 && n > action->most))
        err_set(e, ERR_USAGE, "rasp %s %s takes %s", command, action->name, action->operands);
    return e->kind ? (int)e->kind : action->run(&inner, e);
}

/* ------------------------------------------------------------------ values of options */

bool cmd_either(const struct cmd_call *c, const char *name, const char *const words[2], int *value, struct err *e)
{
    const char *text = args_value(&c->args, name);
    int k = text && strcmp(text, words[0]) != 0;
    if (text && strcmp(text, words[k]) != 0)
        return err_set(e, ERR_USAGE, "--%s: '%s' is neither %s nor %s", name, text, words[0], words[1]);
    if (text) *value = k;
    return true;
}

bool cmd_quantity(const struct cmd_call *c, const char *name, enum key_dimension d, double *value, struct err *e)
{
    const char *text = args_value(&c->args, name);
    struct units_fault fault = {NULL, NULL};
    return !text || units_read(text, d, value, c->arena, &fault) ||
           err_set(e, ERR_USAGE, "--%s: '%s' %s", name, text, fault.text);
}

/* ------------------------------------------------------------------ recipes and scenes */

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

bool cmd_recipe_read(struct cmd_call *c, const char *file, const char *rest, struct scene *s, struct err *e)
{
    bool scene;
    int n;
    const char **set = args_values(&c->args, "set", &n), *messages = "";
    struct scene_overrides over = {.set = set, .n = n, .seed = args_value(&c->args, "seed")};
    struct err cause = {0};
    if (!cmd_recipe_is_scene(c, file, &scene, e)) return false;
    if (scene) return cmd_read_scene(c, file, s, e);
    const char *text =
        arena_format(c->arena, "rasp: 1\nsurface: {recipe: %s}\n%s", keys_yaml_quoted(file, c->arena), rest);
    if (scene_read_made(text, file, &over, c->arena, s, &messages, &cause)) return true;
    message_scene(c, s->diag, messages, cause.kind);
    return err_set(e, cause.kind, "%s %s", file, cause.kind == ERR_SCENE ? "is not a valid recipe" : "cannot be read");
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

bool cmd_same_file(const char *a, const char *b)
{
    struct stat x, y;
    return a && b && stat(a, &x) == 0 && stat(b, &y) == 0 && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

bool cmd_spares(const char *output, const char *what, const char *input, const char *cure, struct err *e)
{
    return !cmd_same_file(output, input) ||
           err_set(e, ERR_CREATE, "%s: %s would overwrite the input %s; write elsewhere: %s", output, what, input,
                   cure);
}

bool cmd_read_scene(struct cmd_call *c, const char *file, struct scene *s, struct err *e)
{
    int n;
    const char **set = args_values(&c->args, "set", &n);
    struct scene_overrides over = {.set = set, .n = n, .seed = args_value(&c->args, "seed")};
    const char *messages = NULL;
    struct err cause = {0};
    if (scene_read(file, &over, c->arena, s, &messages, &cause)) return true;
    if (!messages || !*messages) return err_set(e, cause.kind, "%s", cause.text);
    message_scene(c, s->diag, messages, cause.kind);
    return err_set(e, cause.kind, "%s %s", file,
                   cause.kind == ERR_SCENE ? "is not a valid scene" : "or a file it includes cannot be read");
}

/* ------------------------------------------------------------------ options */

static const struct args_option shared = {
    "diagnostics", 0, "text|json", false,
    "errors and warnings as text (the default), or as JSON on standard error, one object a line"};

bool cmd_shared(const struct args_option *o) { return !strcmp(o->name, shared.name); }

const struct args_option *cmd_options(const struct command *m, struct arena *a)
{
    int n = 0;
    while (m->options[n].name)
        n++;
    struct args_option *all = ARENA_TAKE(a, struct args_option, n + 2);
    if (n) memcpy(all, m->options, (size_t)n * sizeof *all);
    all[n] = shared;
    return all;
}

/* ------------------------------------------------------------------ every command, in the order of the usage */

const struct command *const cmd_table[] = {&render_command,
                                           &play_command,
                                           &plan_command,
                                           &batch_command,
                                           &batch_merge_command,
                                           &export_command,
                                           &new_command,
                                           &explain_command,
                                           &check_command,
                                           &compare_command,
                                           &golden_command,
                                           &plot_command,
                                           &accuracy_command,
                                           &analyse_command,
                                           &decompose_command,
                                           &judge_command,
                                           &surface_command,
                                           &modes_command,
                                           &completion_command,
                                           NULL};

const struct command *cmd_find(const char *name)
{
    const struct command *const *m = cmd_table;
    while (*m && strcmp((*m)->name, name) != 0)
        m++;
    return *m;
}

const char *cmd_nearest(const char *word)
{
    const char *names[sizeof cmd_table / sizeof *cmd_table + 1] = {"help"};
    for (int i = 0; cmd_table[i]; i++)
        names[i + 1] = cmd_table[i]->name;
    return text_nearest(word, names);
}

void cmd_print(FILE *f)
{
    fputs("rasp: the sound of things that scrape, from a description of objects and motion\n\n"
          "Examples:\n"
          "  rasp new -o scrape.yaml          # a starter scene, with comments\n"
          "  rasp render scrape.yaml          # its physics, and its sound if anything rings\n"
          "  rasp explain motion.rate         # what a key means, its unit, range and default\n\n"
          "Usage: rasp COMMAND [OPTION]... [OPERAND]...\n",
          f);
    for (const struct command *const *m = cmd_table; *m; m++) {
        if ((*m)->group) fprintf(f, "\n%s:\n", (*m)->group);
        fprintf(f, "  %-10s %s\n", (*m)->name, (*m)->summary);
    }
    fputs("\n`rasp help COMMAND` explains a command; `rasp --version --verbose` belongs in bug reports.\n"
          "Manual: man rasp, man rasp-scene, man rasp-design\n",
          f);
}

/* ------------------------------------------------------------------ man rasp(1) */

/* A full stop ends a sentence and so a line, as mdoc asks for; \n parts paragraphs. */
static void put_sentences(FILE *f, const char *text)
{
    for (const char *p = text; *p; p++) {
        bool ends = text_ends_sentence(text, p);
        if (*p == '\n')
            fputs("\n.Pp\n", f);
        else
            fputc(*p, f);
        if (ends) fputc('\n', f);
        p += ends;
    }
}

void cmd_print_man(FILE *f)
{
    struct arena *a = arena_open();
    for (const struct command *const *m = cmd_table; *m; m++) {
        if ((*m)->group) fprintf(f, "%s.Ss %s\n.Bl -tag -width Ds\n", m == cmd_table ? "" : ".El\n", (*m)->group);
        fprintf(f, ".It Nm Cm %s Oo Ar OPTION Oc ...%s%s\n%c%s.\n", (*m)->name, *(*m)->operands ? " " : "",
                (*m)->operands, toupper((unsigned char)(*m)->summary[0]), (*m)->summary + 1);
        put_sentences(f, (*m)->does);
        if ((*m)->also) {
            fputs("\n.Pp\n", f);
            put_sentences(f, (*m)->also);
        }
        fputs("\n.Bl -tag -width Ds\n", f);
        for (const struct args_option *o = cmd_options(*m, a); o->name; o++) {
            fputs(".It ", f);
            if (o->letter) fprintf(f, "Fl %c , ", o->letter);
            fprintf(f, "Fl \\-%s", o->name);
            if (o->value) fprintf(f, " Ns = Ns Ar %s", o->value);
            fprintf(f, "\n%c", toupper((unsigned char)o->help[0]));
            put_sentences(f, o->help + 1);
            fputs(".\n", f);
        }
        fputs(".El\n", f);
    }
    fputs(".El\n", f);
    arena_close(a);
}

/* ------------------------------------------------------------------ help */

static void print_option(const struct args_option *o)
{
    char head[96], letter[8] = "    ";
    if (o->letter) snprintf(letter, sizeof letter, "-%c, ", o->letter);
    int n = snprintf(head, sizeof head, "  %s--%s%s%s", letter, o->name, o->value ? "=" : "", o->value ? o->value : "");
    printf("%-26s  ", head);
    text_wrap(stdout, o->help, n > 26 ? n + 2 : 28, "                            ");
}

/* Blank lines part paragraphs. */
static void print_paragraphs(const char *text, struct arena *a)
{
    while (*text) {
        size_t n = strcspn(text, "\n");
        text_wrap(stdout, arena_format(a, "%.*s", (int)n, text), 0, "");
        putchar('\n');
        text += n + (text[n] == '\n');
    }
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
    struct arena *a = arena_open();
    print_paragraphs(m->does, a);
    if (m->also) print_paragraphs(m->also, a);
    printf("Options:\n");
    for (const struct args_option *o = cmd_options(m, a); o->name; o++)
        print_option(o);
    arena_close(a);
    print_option(&help);
}

/* ------------------------------------------------------------------ running a command */

int cmd_complain(const char *command, const struct err *e)
{
    char line[sizeof e->text + 64];
    snprintf(line, sizeof line, "rasp%s%s: error: %s\n", *command ? " " : "", command, e->text);
    message_paint(stderr, line);
    if (e->kind == ERR_USAGE) fprintf(stderr, "Try: rasp %s%s--help\n", command, *command ? " " : "");
    return (int)e->kind;
}

int cmd_run(const struct command *m, int argc, char **argv)
{
    bool json = false; /* known before anything is taken: --diagnostics=json, or two words */
    for (int i = 0; i < argc; i++)
        json = json || !strcmp(argv[i], "--diagnostics=json") ||
               (!strcmp(argv[i], "--diagnostics") && i + 1 < argc && !strcmp(argv[i + 1], "json"));
    if (json) err_last_words_as_json();
    struct err e = {0};
    struct cmd_call c = {.arena = arena_open(), .argc = argc, .argv = argv};
    if (json) message_as_json(&c);
    int code = 0;
    if (!args_parse(&c.args, cmd_options(m, c.arena), argc, argv, c.arena, &e))
        code = (int)e.kind;
    else if (c.args.help)
        cmd_print_help(m);
    else if (!message_begin(&c, &e))
        code = (int)e.kind;
    else if (c.args.n_operands < m->least)
        err_set(&e, ERR_USAGE, "%s missing; usage: rasp %s [OPTION]... %s",
                m->least > 1 ? "operands are" : "an operand is", m->name, m->operands);
    else if (m->most >= 0 && c.args.n_operands > m->most)
        err_set(&e, ERR_USAGE, "extra operand '%s'; usage: rasp %s [OPTION]... %s", c.args.operands[m->most], m->name,
                m->operands);
    else
        code = m->run ? m->run(&c, &e) : cmd_actions(m->name, m->actions, &c, &e);
    message_end(&c);
    if (e.kind == ERR_INTERRUPTED) interrupt_report();
    if (e.kind) {
        message_error(&c, m->name, &e);
        code = (int)e.kind;
    }
    arena_close(c.arena);
    return code;
}

/* GSL's own way with errors, but for one: no memory left is no fault of the program. */
static void gsl_complains(const char *reason, const char *file, int line, int code)
{
    if (code == GSL_ENOMEM) memory_out("GSL: %s", reason);
    fprintf(stderr, "gsl: %s:%d: %s\n", file, line, reason);
    abort();
}

int cmd_main(int (*run)(int argc, char **argv), int argc, char **argv)
{
    /* Where stdin, stdout or stderr is closed, an output file would take its number and messages would land in it.
   Reading this end of /dev/null gives nothing and writing it fails. */
    int fd;
    do
        fd = open("/dev/null", O_RDONLY);
    while (fd >= 0 && fd <= STDERR_FILENO);
    if (fd >= 0) close(fd);
    interrupt_catch();
    gsl_set_error_handler(gsl_complains);
    json_set_alloc_funcs(memory_take, free); /* what jansson gets no memory for is else left out */
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN); /* a file that grows past its limit is a write error, exit 74 */
    int code = run(argc, argv);
    /* What was printed has to have arrived: a full disk or a closed pipe is an error, unless there is a worse one
       already. */
    int failed = ferror(stdout);
    if (failed && __fpending(stdout) == 0)
        putchar('\n'); /* else nothing is left that would say why it cannot be written */
    int pending = __fpending(stdout) != 0;
    errno = 0;
    if (fclose(stdout) != 0) failed |= pending || errno != EBADF;
    if (!failed) return code;
    if (errno != EPIPE) /* of which who reads it knows: rasp explain | head */
        fprintf(stderr, "rasp: error: cannot write to standard output: %s\n",
                errno ? strerror(errno) : "what was printed is not complete");
    return code ? code : ERR_IO;
}
