/* The completion for zsh, as a function _rasp that its completion system loads: tables of _arguments. */
#include <string.h>

#include "cmd/commands.h"
#include "cmd/completion.h"
#include "scene/keys_text.h"

static const char head[] =
    "#compdef rasp\n"
    "# Completion of rasp for zsh, made by `rasp completion zsh`.\n"
    "\n"
    "# KEY=VALUE\n"
    "_rasp_setting()\n"
    "{\n"
    "    local -a words\n"
    "    if compset -P 1 '*='; then\n"
    "        words=(${(s: :)_rasp_words[${IPREFIX##*--set=}]:-${_rasp_words[${${IPREFIX%=}##*=}]}})\n"
    "        compadd -a words\n"
    "    else\n"
    "        compadd -S = -a _rasp_keys\n"
    "    fi\n"
    "}\n";

static const char tail[] =
    "\n"
    "_rasp()\n"
    "{\n"
    "    local curcontext=$curcontext state\n"
    "    local -a line _rasp_commands _rasp_keys _rasp_names\n"
    "    local -A _rasp_words opt_args\n"
    "    _rasp_tables\n"
    "    _arguments -C '(-h --help)'{-h,--help}'[the commands]' '(-V --version)'{-V,--version}'[the version]' \\\n"
    "        '(-v --verbose)'{-v,--verbose}'[with --version\\: compiler, flags and libraries]' '1:command:->command' '*::operand:->operand'\n"
    "    case $state in\n"
    "        command) _describe -t commands command _rasp_commands ;;\n"
    "        operand) curcontext=${curcontext%:*:*}:rasp-$line[1]: && (( $+functions[_rasp_of_$line[1]] )) && _rasp_of_$line[1] ;;\n"
    "    esac\n"
    "}\n"
    "_rasp \"$@\"\n";

static const char *quoted(const char *text, struct arena *a)
{
    return completion_quoted(text, "", "'\\''", a);
}

/* In a specification of _arguments. */
static const char *escaped(const char *text, struct arena *a)
{
    const char *q = completion_quoted(text, "[]:\\", "'\\''", a);
    return arena_format(a, "%.*s", (int)strlen(q) - 2, q + 1);
}

/* ":message:action" of _arguments. */
static void put_action(FILE *f, const char *message, const struct completion_place *p, struct arena *a)
{
    fprintf(f, ":%s:", escaped(message, a));
    if (p->settings)
        fputs("_rasp_setting", f);
    else if (p->words[0]) {
        fputs(p->list ? "_values -s , word " : "(", f);
        for (int i = 0; p->words[i]; i++)
            fprintf(f, "%s%s", i ? " " : "", p->words[i]);
        fputs(p->list ? "" : ")", f);
    } else if (p->names)
        fputs("_rasp_name", f);
    else if (p->files)
        fputs("_files", f);
    else if (p->suffixes[0]) {
        fputs("_files -g \"*.(", f);
        for (int i = 0; p->suffixes[i]; i++)
            fprintf(f, "%s%s", i ? "|" : "", p->suffixes[i]);
        fputs(")(-.)\"", f);
    } else if (p->folders)
        fputs("_files -/", f);
}

static void put_option(FILE *f, const struct args_option *o, struct arena *a)
{
    const char *plus = o->value ? "+" : "", *equals = o->value ? "=" : "";
    fputs(" \\\n        ", f);
    if (o->letter && o->many)
        fprintf(f, "'*'{-%c%s,--%s%s}'[%s]", o->letter, plus, o->name, equals, escaped(o->help, a));
    else if (o->letter)
        fprintf(f, "'(-%c --%s)'{-%c%s,--%s%s}'[%s]", o->letter, o->name, o->letter, plus, o->name, equals, escaped(o->help, a));
    else
        fprintf(f, "'%s--%s%s[%s]", o->many ? "*" : "", o->name, equals, escaped(o->help, a));
    if (o->value) {
        struct completion_place p = completion_value(o, a);
        put_action(f, o->value, &p, a);
    }
    fputc('\'', f);
}

static void put_arguments(FILE *f, const struct command *m, const struct action *action, struct arena *a)
{
    struct completion_place p = completion_operands(m, action, a);
    const char *operands = action ? action->operands : m->operands;
    fprintf(f, "    _arguments -s -S : '(-h --help)'{-h,--help}'[this command]'");
    for (const struct args_option *o = cmd_options(m, a); o->name; o++)
        if (completion_takes(action, o))
            put_option(f, o, a);
    if (*operands) {
        fputs(" \\\n        '*", f);
        put_action(f, operands, &p, a);
        fputc('\'', f);
    }
    fputc('\n', f);
}

static void put_actions(FILE *f, const struct command *m, struct arena *a)
{
    fputs("    local state\n    local -a line\n    _arguments -C '1:action:(", f);
    for (const struct action *x = m->actions; x->name; x++)
        fprintf(f, "%s%s", x == m->actions ? "" : " ", x->name);
    fputs(")' '*::operand:->operand'\n    [[ $state = operand ]] || return 0\n    case $line[1] in\n", f);
    for (const struct action *x = m->actions; x->name; x++) {
        fprintf(f, "    %s)\n", x->name);
        put_arguments(f, m, x, a);
        fputs("    ;;\n", f);
    }
    fputs("    esac\n", f);
}

static void put_tables(FILE *f, struct arena *a)
{
    fputs("\n_rasp_tables()\n{\n    _rasp_commands=(\n", f);
    for (int i = 0; commands_at(i); i++)
        fprintf(f, "        %s\n", quoted(arena_format(a, "%s:%s", commands_at(i)->name, commands_at(i)->summary), a));
    fputs("        'help:explains a command'\n    )\n    _rasp_keys=(", f);
    for (const struct completion_setting *s = completion_settings(a); s->path; s++)
        fprintf(f, " %s", s->path);
    fputs(" )\n    _rasp_names=(", f);
    for (const char **names = keys_text_names(a); *names; names++)
        fprintf(f, " %s", *names);
    fputs(" )\n    _rasp_words=(\n", f);
    for (const struct completion_setting *s = completion_settings(a); s->path; s++) {
        if (!s->words)
            continue;
        fprintf(f, "        %s '", s->path);
        for (int i = 0; s->words[i]; i++)
            fprintf(f, "%s%s", i ? " " : "", s->words[i]);
        fputs("'\n", f);
    }
    fputs("    )\n}\n\n_rasp_name()\n{\n    compadd -a _rasp_names\n    _files -g \"*.(yaml|yml)(-.)\"\n}\n", f);
}

void completion_zsh(FILE *f, struct arena *a)
{
    fputs(head, f);
    put_tables(f, a);
    for (int i = 0; commands_at(i); i++) {
        const struct command *m = commands_at(i);
        fprintf(f, "\n_rasp_of_%s()\n{\n", m->name);
        if (m->actions)
            put_actions(f, m, a);
        else
            put_arguments(f, m, NULL, a);
        fputs("}\n", f);
    }
    fputs("\n_rasp_of_help()\n{\n    _arguments '1:command:->command'\n    _describe -t commands command _rasp_commands\n}\n", f);
    fputs(tail, f);
}
