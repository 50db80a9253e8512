/* The completion for bash, 4.4 or later. bash breaks words at =, unless COMP_WORDBREAKS says otherwise: the script glues them, and takes from what it answers
   all up to the last = of the word that is completed. */
#include <string.h>

#include "cmd/commands.h"
#include "cmd/completion.h"
#include "scene/keys_text.h"

static const char body[] =
    "\n"
    "# _rasp_add PREFIX COMMAND...: its lines, as answers.\n"
    "_rasp_add()\n"
    "{\n"
    "    local prefix=$1 line\n"
    "    shift\n"
    "    while IFS= read -r line; do COMPREPLY+=(\"$prefix$line\"); done < <(\"$@\")\n"
    "}\n"
    "\n"
    "# _rasp_setting PREFIX TEXT: KEY=VALUE.\n"
    "_rasp_setting()\n"
    "{\n"
    "    if [[ $2 == *=* ]]; then\n"
    "        _rasp_add \"$1${2%%=*}=\" compgen -W \"$(_rasp_words \"${2%%=*}\")\" -- \"${2#*=}\"\n"
    "    else\n"
    "        _rasp_add \"$1\" compgen -S = -W \"$_rasp_keys\" -- \"$2\"\n"
    "        compopt -o nospace 2> /dev/null\n"
    "    fi\n"
    "}\n"
    "\n"
    "# _rasp_fill PREFIX TEXT RULE...: what a text may become by each rule, which is a word or begins with @.\n"
    "_rasp_fill()\n"
    "{\n"
    "    local prefix=$1 text=$2 rule files=\n"
    "    shift 2\n"
    "    for rule; do\n"
    "        case $rule in\n"
    "            @files) files=1 && _rasp_add \"$prefix\" compgen -f -- \"$text\" ;;\n"
    "            @folders) files=1 && _rasp_add \"$prefix\" compgen -d -- \"$text\" ;;\n"
    "            @settings) _rasp_setting \"$prefix\" \"$text\" ;;\n"
    "            @list) [[ $text != *,* ]] || { prefix+=${text%,*}, text=${text##*,}; } ;;\n"
    "            @names) _rasp_add \"$prefix\" compgen -W \"$_rasp_names\" -- \"$text\" ;;\n"
    "            @.*) files=1 && _rasp_add \"$prefix\" compgen -f -X \"!*${rule#@}\" -- \"$text\" ;;\n"
    "            *) [[ $rule != \"$text\"* ]] || COMPREPLY+=(\"$prefix$rule\") ;;\n"
    "        esac\n"
    "    done\n"
    "    [[ ! $files ]] || compopt -o filenames -o bashdefault -o default 2> /dev/null\n"
    "}\n"
    "\n"
    "_rasp()\n"
    "{\n"
    "    local word cur place glue= command= action= expects= ended= i\n"
    "    local -a words=()\n"
    "    COMPREPLY=()\n"
    "    for ((i = 0; i <= COMP_CWORD; i++)); do\n"
    "        word=${COMP_WORDS[i]}\n"
    "        if [[ $glue || $word == =* ]] && ((i > 1)); then\n"
    "            words[-1]+=$word\n"
    "        else\n"
    "            words+=(\"$word\")\n"
    "        fi\n"
    "        glue=\n"
    "        [[ $word != =* ]] || glue=1\n"
    "    done\n"
    "    cur=${words[-1]}\n"
    "    for word in \"${words[@]:1:${#words[@]}-2}\"; do\n"
    "        if [[ $expects ]]; then\n"
    "            expects=\n"
    "            continue\n"
    "        fi\n"
    "        case $ended$word in\n"
    "            --) ended=/ ;;\n"
    "            --*=*) ;;\n"
    "            -?*) ! _rasp_value \"$command\" \"$word\" > /dev/null || expects=$word ;;\n"
    "            *) if [[ ! $command ]]; then command=$word; elif [[ ! $action && $(_rasp_actions \"$command\") ]]; then action=$word; fi ;;\n"
    "        esac\n"
    "    done\n"
    "    place=$command${action:+ $action}\n"
    "    if [[ $expects ]]; then\n"
    "        _rasp_fill '' \"$cur\" $(_rasp_value \"$command\" \"$expects\")\n"
    "    elif [[ ! $ended && $cur == --*=* ]]; then\n"
    "        _rasp_fill \"${cur%%=*}=\" \"${cur#*=}\" $(_rasp_value \"$command\" \"${cur%%=*}\")\n"
    "    elif [[ ! $ended && $cur == -* ]]; then\n"
    "        _rasp_fill '' \"$cur\" $(_rasp_options \"$place\")\n"
    "    elif [[ ! $command ]]; then\n"
    "        _rasp_fill '' \"$cur\" $_rasp_commands\n"
    "    elif [[ ! $action && $(_rasp_actions \"$command\") ]]; then\n"
    "        _rasp_fill '' \"$cur\" $(_rasp_actions \"$command\")\n"
    "    else\n"
    "        _rasp_fill '' \"$cur\" $(_rasp_operands \"$place\")\n"
    "    fi\n"
    "    [[ $COMP_WORDBREAKS != *=* || $cur != *=* ]] || COMPREPLY=(\"${COMPREPLY[@]#\"${cur%=*}=\"}\")\n"
    "}\n"
    "complete -F _rasp rasp\n";

static void put_words(FILE *f, const char *const *words)
{
    for (int i = 0; words && words[i]; i++)
        fprintf(f, "%s%s", i ? " " : "", words[i]);
}

static void put_place(FILE *f, const struct completion_place *p)
{
    const char *gap = "";
    const char *const rules[] = {p->files ? "@files" : NULL, p->folders ? "@folders" : NULL, p->settings ? "@settings" : NULL, p->names ? "@names" : NULL};
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
        if (rules[i]) {
            fprintf(f, "%s%s", gap, rules[i]);
            gap = " ";
        }
    for (int i = 0; !p->files && p->suffixes[i]; i++, gap = " ")
        fprintf(f, "%s@.%s", gap, p->suffixes[i]);
    if (!p->files && !p->folders && p->suffixes[0])
        fputs(" @folders", f);
    if (p->list && p->words[0]) {
        fprintf(f, "%s@list", gap);
        gap = " ";
    }
    fputs(p->words[0] ? gap : "", f);
    put_words(f, p->words);
}

static void put_options(FILE *f, const struct command *m, const struct action *action, struct arena *a)
{
    fprintf(f, "        '%s%s%s') echo '", m->name, action ? " " : "", action ? action->name : "");
    for (const struct args_option *o = cmd_options(m, a); o->name; o++)
        if (completion_takes(action, o)) {
            if (o->letter)
                fprintf(f, "-%c ", o->letter);
            fprintf(f, "--%s ", o->name);
        }
    fputs("-h --help' ;;\n", f);
}

static void put_operands(FILE *f, const struct command *m, const struct action *action, struct arena *a)
{
    struct completion_place p = completion_operands(m, action, a);
    fprintf(f, "        '%s%s%s') echo '", m->name, action ? " " : "", action ? action->name : "");
    put_place(f, &p);
    fputs("' ;;\n", f);
}

static void put_values(FILE *f, const struct command *m, struct arena *a)
{
    for (const struct args_option *o = cmd_options(m, a); o->name; o++) {
        if (!o->value)
            continue;
        struct completion_place p = completion_value(o, a);
        fprintf(f, "        '%s --%s'", m->name, o->name);
        if (o->letter)
            fprintf(f, " | '%s -%c'", m->name, o->letter);
        fputs(") echo '", f);
        put_place(f, &p);
        fputs("' ;;\n", f);
    }
}

static void open_case(FILE *f, const char *name, const char *word)
{
    fprintf(f, "%s()\n{\n    case %s in\n", name, word);
}

static void close_case(FILE *f, const char *last)
{
    fprintf(f, "        *) %s ;;\n    esac\n}\n", last);
}

static void put_commands(FILE *f)
{
    fputs("_rasp_commands='", f);
    for (int i = 0; commands_at(i); i++)
        fprintf(f, "%s ", commands_at(i)->name);
    fputs("help'\n", f);
}

static void put_keys(FILE *f, struct arena *a)
{
    const struct completion_setting *s = completion_settings(a);
    fputs("_rasp_keys='", f);
    for (int i = 0; s[i].path; i++)
        fprintf(f, "%s%s", i ? " " : "", s[i].path);
    fputs("'\n_rasp_names='", f);
    put_words(f, keys_text_names(a));
    fputs("'\n", f);
    open_case(f, "_rasp_words", "$1");
    for (; s->path; s++)
        if (s->words) {
            fprintf(f, "        %s) echo '", s->path);
            put_words(f, s->words);
            fputs("' ;;\n", f);
        }
    close_case(f, ":");
}

static void put_all_operands(FILE *f, struct arena *a)
{
    open_case(f, "_rasp_operands", "$1");
    for (int i = 0; commands_at(i); i++) {
        const struct command *m = commands_at(i);
        if (!m->actions)
            put_operands(f, m, NULL, a);
        for (const struct action *x = m->actions; x && x->name; x++)
            put_operands(f, m, x, a);
    }
    fputs("        help) echo \"$_rasp_commands\" ;;\n", f);
    close_case(f, ":");
}

static void put_all_options(FILE *f, struct arena *a)
{
    open_case(f, "_rasp_options", "$1");
    for (int i = 0; commands_at(i); i++) {
        const struct command *m = commands_at(i);
        put_options(f, m, NULL, a);
        for (const struct action *x = m->actions; x && x->name; x++)
            put_options(f, m, x, a);
    }
    fputs("        '') echo '-h --help -V --version -v --verbose' ;;\n", f);
    close_case(f, ":");
}

void completion_bash(FILE *f, struct arena *a)
{
    fputs("# Completion of rasp for bash, made by `rasp completion bash`.\n", f);
    put_commands(f);
    put_keys(f, a);
    open_case(f, "_rasp_actions", "$1");
    for (int i = 0; commands_at(i); i++)
        if (commands_at(i)->actions) {
            fprintf(f, "        %s) echo '", commands_at(i)->name);
            for (const struct action *x = commands_at(i)->actions; x->name; x++)
                fprintf(f, "%s%s", x == commands_at(i)->actions ? "" : " ", x->name);
            fputs("' ;;\n", f);
        }
    close_case(f, ":");
    put_all_options(f, a);
    put_all_operands(f, a);
    fputs("# _rasp_value COMMAND OPTION: what the option takes; exit code 1: nothing.\n", f);
    open_case(f, "_rasp_value", "\"$1 $2\"");
    for (int i = 0; commands_at(i); i++)
        put_values(f, commands_at(i), a);
    close_case(f, "return 1");
    fputs(body, f);
}
