/* The completion for fish: one `complete` for each option, action and operand, with the place where it holds. */
#include <string.h>

#include "cmd/commands.h"
#include "cmd/completion.h"
#include "scene/keys_text.h"

static const char head[] =
    "# Completion of rasp for fish, made by `rasp completion fish`.\n"
    "\n"
    "# __rasp_in [COMMAND [ACTION]]: are these the words before the one that is completed? Without: is there none yet?\n"
    "function __rasp_in\n"
    "    set -l words (commandline -opc)\n"
    "    set -e words[1]\n"
    "    test (count $argv) = 0; and test (count $words) = 0; and return 0\n"
    "    test (count $argv) = 0; and return 1\n"
    "    test \"$words[1]\" = $argv[1]; or return 1\n"
    "    test (count $argv) = 1; or test \"$words[2]\" = $argv[2]\n"
    "end\n"
    "function __rasp_no_action\n"
    "    test (count (commandline -opc)) = 2\n"
    "end\n"
    "\n"
    "# KEY=VALUE\n"
    "function __rasp_settings\n"
    "    set -l key (string match -r '(?:^|--set=|-s)([a-z0-9_.]+)=[^=]*$' -- (commandline -ct))[2]\n"
    "    test -n \"$key\"; and __rasp_words $key; and return\n"
    "    printf '%s=\\n' $__rasp_keys\n"
    "end\n";

static const char *quoted(const char *text, struct arena *a)
{
    return completion_quoted(text, "\\", "\\'", a);
}

/* -a and what else a place asks for. */
static void put_place(FILE *f, const struct completion_place *p, struct arena *a)
{
    const char *all = "";
    if (p->settings)
        all = "(__rasp_settings)";
    for (int i = 0; p->words[i]; i++)
        all = arena_format(a, "%s%s%s", all, *all ? " " : "", p->words[i]);
    if (p->list && *all)
        all = arena_format(a, "(__fish_append , %s)", all);
    if (p->names)
        all = arena_format(a, "%s $__rasp_names", all);
    for (int i = 0; !p->files && p->suffixes[i]; i++)
        all = arena_format(a, "%s (__fish_complete_suffix .%s)", all, p->suffixes[i]);
    if (p->folders && !p->files)
        all = arena_format(a, "%s (__fish_complete_directories)", all);
    if (!p->files)
        fputs(" -f", f);
    if (p->suffixes[0] && !p->files)
        fputs(" -k", f);
    if (*all)
        fprintf(f, " -a %s", quoted(all, a));
}

static void put_option(FILE *f, const char *where, const struct args_option *o, struct arena *a)
{
    fprintf(f, "complete -c rasp -n %s", quoted(where, a));
    if (o->letter)
        fprintf(f, " -s %c", o->letter);
    fprintf(f, " -l %s -d %s", o->name, quoted(o->help, a));
    if (o->value) {
        struct completion_place p = completion_value(o, a);
        fputs(" -r", f);
        put_place(f, &p, a);
    }
    fputc('\n', f);
}

static void put_group(FILE *f, const struct command *m, const struct action *action, struct arena *a)
{
    static const struct args_option help = {"help", 'h', NULL, false, "this command"};
    struct completion_place p = completion_operands(m, action, a);
    const char *where = arena_format(a, "__rasp_in %s%s%s", m->name, action ? " " : "", action ? action->name : "");
    for (const struct args_option *o = cmd_options(m, a); o->name; o++)
        if (completion_takes(action, o))
            put_option(f, where, o, a);
    put_option(f, where, &help, a);
    fprintf(f, "complete -c rasp -n %s", quoted(where, a));
    put_place(f, &p, a);
    fputc('\n', f);
}

static void put_command(FILE *f, const struct command *m, struct arena *a)
{
    fprintf(f, "\ncomplete -c rasp -f -n __rasp_in -a %s -d %s\n", m->name, quoted(m->summary, a));
    if (!m->actions)
        put_group(f, m, NULL, a);
    for (const struct action *x = m->actions; x && x->name; x++) {
        fprintf(f, "complete -c rasp -f -n '__rasp_in %s; and __rasp_no_action' -a %s\n", m->name, x->name);
        put_group(f, m, x, a);
    }
}

static void put_keys(FILE *f, struct arena *a)
{
    fputs("set -g __rasp_keys", f);
    for (const struct completion_setting *s = completion_settings(a); s->path; s++)
        fprintf(f, " %s", s->path);
    fputs("\nset -g __rasp_names", f);
    for (const char **names = keys_text_names(a); *names; names++)
        fprintf(f, " %s", *names);
    fputs("\nfunction __rasp_words\n    switch $argv[1]\n", f);
    for (const struct completion_setting *s = completion_settings(a); s->path; s++) {
        if (!s->words)
            continue;
        fprintf(f, "        case %s\n            printf '%s=%%s\\n'", s->path, s->path);
        for (int i = 0; s->words[i]; i++)
            fprintf(f, " %s", s->words[i]);
        fputc('\n', f);
    }
    fputs("        case '*'\n            return 1\n    end\nend\n", f);
}

void completion_fish(FILE *f, struct arena *a)
{
    fputs(head, f);
    put_keys(f, a);
    fputs("\ncomplete -c rasp -n __rasp_in -s h -l help -d 'the commands'\n"
          "complete -c rasp -n __rasp_in -s V -l version -d 'the version'\n"
          "complete -c rasp -n __rasp_in -s v -l verbose -d 'with --version: compiler, flags and libraries'\n"
          "complete -c rasp -f -n __rasp_in -a help -d 'explains a command'\n"
          "complete -c rasp -f -n '__rasp_in help' -a '", f);
    for (int i = 0; commands_at(i); i++)
        fprintf(f, "%s%s", i ? " " : "", commands_at(i)->name);
    fputs("'\n", f);
    for (int i = 0; commands_at(i); i++)
        put_command(f, commands_at(i), a);
}
