/* rasp completion: scripts that complete rasp's words in a shell.

   What may follow an option, or stand as an operand, is read from what the help calls it: words with | between are the
   words, PATH=VALUE a key of a scene, PANEL the panels of rasp plot, X,... several, SCENE, RECIPE and DESIGN YAML
   files, FILE.csv files that end so, FOLDER a folder, KEY a key; other capitals that mean files are listed below. */
#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "base/arena.h"
#include "base/text.h"
#include "cmd/cmd.h"
#include "cmd/plot.h"
#include "scene/keys_text.h"

enum { WORDS = 63, SUFFIXES = 7 };

/* What may stand in a place; all false: anything, of which nothing is known. */
struct place {
    bool files, folders;                /* any file; folders                                           */
    bool settings, names;               /* KEY=VALUE as of --set; what `rasp explain` takes            */
    const char *suffixes[SUFFIXES + 1]; /* files that end so ("yaml"); NULL-terminated                 */
    const char *words[WORDS + 1];       /* NULL-terminated                                             */
    bool list;                          /* several of the words, with commas between                   */
};

/* A key that --set takes, and its words if it has any. */
struct setting {
    const char *path;
    const char *const *words; /* NULL-terminated; NULL: none */
};

static void add(const char **list, int room, const char *word)
{
    int n = 0;
    while (list[n] && strcmp(list[n], word) != 0)
        n++;
    if (n < room) list[n] = word;
}

/* What the text stands for: the value of an option, or operands. */
static struct place place_of(const char *text, struct arena *a)
{
    static const char *const any_file[] = {"FILE", "A", "B", "IN", "OUT", "RECORDING", "MESH", "PREFIX", NULL},
                             *const folder[] = {"FOLDER", "FOLDER/", "DIR", "DIR/", NULL},
                             *const yaml_file[] = {"SCENE", "RECIPE", "DESIGN", NULL},
                             *const key_name[] = {"KEY", "SECTION", NULL};
    struct place p = {.list = strstr(text, ",...") != NULL};
    bool words = strchr(text, '|');
    for (const char *s = text; *s; s++)
        words = words && !isupper((unsigned char)*s) && *s != ' ';
    for (const char *s = text; *s;) {
        size_t n = strcspn(s, " |[],;:()"), end = n;
        while (end > 3 && !strncmp(s + end - 3, "...", 3))
            end -= 3;
        const char *token = arena_format(a, "%.*s", (int)end, s), *dot = strchr(token, '.');
        s += n + !!s[n];
        if (words) {
            if (*token) add(p.words, WORDS, token);
            continue;
        }
        p.settings = p.settings || !strcmp(token, "PATH=VALUE");
        p.names = p.names || text_is_one(token, key_name);
        for (int k = 0; k < PLOT_PANELS && !strcmp(token, "PANEL"); k++)
            add(p.words, WORDS, plot_panels_words[k]);
        p.files = p.files || text_is_one(token, any_file);
        p.folders = p.folders || text_is_one(token, folder);
        if (dot && isupper((unsigned char)token[0]) && islower((unsigned char)dot[1]))
            add(p.suffixes, SUFFIXES, dot + 1);
        if (text_is_one(token, yaml_file) || (dot && !strcmp(dot, ".yaml"))) {
            add(p.suffixes, SUFFIXES, "yaml");
            add(p.suffixes, SUFFIXES, "yml");
        }
    }
    return p;
}

/* The operands of a command, or of an action of it (NULL: of the command). */
static struct place operands_of(const struct command *m, const struct action *action, struct arena *a)
{
    struct place p = place_of(action ? action->operands : m->operands, a);
    for (const struct new_starter *s = new_starters; m == &new_command && s->name; s++)
        add(p.words, WORDS, s->name);
    return p;
}

/* The command itself (NULL), then its actions, then NULL. */
static const struct action *next_action(const struct command *m, const struct action *x)
{
    x = x ? x + 1 : m->actions;
    return x && x->name ? x : NULL;
}

/* Does the action (NULL: all do) take the option? */
static bool takes(const struct action *action, const struct args_option *o)
{
    for (int i = 0; action && i < CMD_ACTION_OPTIONS && action->options[i]; i++)
        if (!strcmp(action->options[i], o->name)) return true;
    return !action || cmd_shared(o);
}

static void put_list(FILE *f, const char *between, const char *const *words)
{
    for (int i = 0; words && words[i]; i++)
        fprintf(f, "%s%s", i ? between : "", words[i]);
}

/* The names of commands, or of a command's actions. */
static void put_names(FILE *f, const struct command *m)
{
    for (int i = 0; !m && cmd_table[i]; i++)
        fprintf(f, "%s%s", i ? " " : "", cmd_table[i]->name);
    for (const struct action *x = NULL; m && (x = next_action(m, x));)
        fprintf(f, "%s%s", x == m->actions ? "" : " ", x->name);
}

static const char *const *words_of(const struct key *k, struct arena *a)
{
    int n = 0;
    while (k->choices && k->choices[n].word)
        n++;
    const char **words = n ? ARENA_TAKE(a, const char *, n + 1) : NULL;
    for (int i = 0; i < n; i++)
        words[i] = k->choices[i].word;
    return words;
}

/* ends with path NULL; keys: the paths alone */
static const struct setting *settings(const char ***keys, struct arena *a)
{
    int n = 0, most = 4;
    for (const struct key *k = keys_table; k->path; k++)
        most++;
    for (const struct key_knob *k = keys_knobs; k->name; k++)
        most++;
    struct setting *all = ARENA_TAKE(a, struct setting, most);
    for (const struct key *k = keys_table; k->path; k++)
        all[n++] = (struct setting){k->path, words_of(k, a)};
    all[n++] = (struct setting){"accuracy", keys_presets};
    all[n++] = (struct setting){"accuracy.preset", keys_presets};
    all[n++] = (struct setting){"accuracy.error", NULL};
    for (const struct key_knob *k = keys_knobs; k->name; k++)
        all[n++] = (struct setting){arena_format(a, "accuracy.%s", k->name), NULL};
    *keys = ARENA_TAKE(a, const char *, n + 1);
    for (int i = 0; i < n; i++)
        (*keys)[i] = all[i].path;
    return all;
}

/* The text between single quotes, each character of `risky` with a backslash before it, each single quote as `quote`
 * has it. */
static const char *quoted_as(const char *text, const char *risky, const char *quote, struct arena *a)
{
    size_t longest = strlen(quote) > 2 ? strlen(quote) : 2, n = 0;
    char *out = arena_take(a, longest * strlen(text) + 3, 1);
    out[n++] = '\'';
    for (; *text; text++) {
        if (*text == '\'') {
            memcpy(out + n, quote, strlen(quote));
            n += strlen(quote);
            continue;
        }
        if (strchr(risky, *text)) out[n++] = '\\';
        out[n++] = *text;
    }
    out[n++] = '\'';
    out[n] = '\0';
    return out;
}

/* The completion for bash, 4.4 or later. bash breaks words at =, unless COMP_WORDBREAKS says otherwise: the script
   glues them, and takes from what it answers all up to the last = of the word that is completed. */

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
    "            *) if [[ ! $command ]]; then command=$word; elif [[ ! $action && $(_rasp_actions \"$command\") ]]; "
    "then action=$word; fi ;;\n"
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

static void bash_place(FILE *f, struct place p)
{
    const char *rules[6 + SUFFIXES] = {NULL};
    int n = 0;
    if (p.files) rules[n++] = "@files";
    if (p.folders) rules[n++] = "@folders";
    if (p.settings) rules[n++] = "@settings";
    if (p.names) rules[n++] = "@names";
    put_list(f, " ", rules);
    const char *gap = n ? " " : "";
    for (int i = 0; !p.files && p.suffixes[i]; i++, gap = " ")
        fprintf(f, "%s@.%s", gap, p.suffixes[i]);
    if (!p.files && !p.folders && p.suffixes[0]) fputs(" @folders", f);
    if (p.list && p.words[0]) {
        fprintf(f, "%s@list", gap);
        gap = " ";
    }
    fputs(p.words[0] ? gap : "", f);
    put_list(f, " ", p.words);
    fputs("' ;;\n", f);
}

static void bash_case(FILE *f, const struct command *m, const struct action *x)
{
    fprintf(f, "        '%s%s%s') echo '", m->name, x ? " " : "", x ? x->name : "");
}

static void bash(FILE *f, struct arena *a)
{
    static const char begin[] = "%s()\n{\n    case %s in\n", end[] = "        *) %s ;;\n    esac\n}\n";
    const char **keys;
    fputs("# Completion of rasp for bash, made by `rasp completion bash`.\n_rasp_commands='", f);
    put_names(f, NULL);
    fputs(" help'\n_rasp_keys='", f);
    const struct setting *s = settings(&keys, a);
    put_list(f, " ", keys);
    fputs("'\n_rasp_names='", f);
    put_list(f, " ", keys_text_names(a));
    fputs("'\n", f);
    fprintf(f, begin, "_rasp_words", "$1");
    for (; s->path; s++)
        if (s->words) {
            fprintf(f, "        %s) echo '", s->path);
            put_list(f, " ", s->words);
            fputs("' ;;\n", f);
        }
    fprintf(f, end, ":");
    fprintf(f, begin, "_rasp_actions", "$1");
    for (const struct command *const *m = cmd_table; *m; m++)
        if ((*m)->actions) {
            fprintf(f, "        %s) echo '", (*m)->name);
            put_names(f, *m);
            fputs("' ;;\n", f);
        }
    fprintf(f, end, ":");
    fprintf(f, begin, "_rasp_options", "$1");
    for (const struct command *const *m = cmd_table; *m; m++) {
        const struct action *x = NULL;
        do {
            bash_case(f, *m, x);
            for (const struct args_option *o = cmd_options(*m, a); o->name; o++) {
                if (!takes(x, o)) continue;
                if (o->letter) fprintf(f, "-%c ", o->letter);
                fprintf(f, "--%s ", o->name);
            }
            fputs("-h --help' ;;\n", f);
        } while ((x = next_action(*m, x)));
    }
    fputs("        '') echo '-h --help -V --version -v --verbose' ;;\n", f);
    fprintf(f, end, ":");
    fprintf(f, begin, "_rasp_operands", "$1");
    for (const struct command *const *m = cmd_table; *m; m++) {
        const struct action *x = (*m)->actions;
        do {
            bash_case(f, *m, x);
            bash_place(f, operands_of(*m, x, a));
        } while (x && (x = next_action(*m, x)));
    }
    fputs("        help) echo \"$_rasp_commands\" ;;\n", f);
    fprintf(f, end, ":");
    fputs("# _rasp_value COMMAND OPTION: what the option takes; exit code 1: nothing.\n", f);
    fprintf(f, begin, "_rasp_value", "\"$1 $2\"");
    for (const struct command *const *m = cmd_table; *m; m++)
        for (const struct args_option *o = cmd_options(*m, a); o->name; o++) {
            if (!o->value) continue;
            fprintf(f, "        '%s --%s'", (*m)->name, o->name);
            if (o->letter) fprintf(f, " | '%s -%c'", (*m)->name, o->letter);
            fputs(") echo '", f);
            bash_place(f, place_of(o->value, a));
        }
    fprintf(f, end, "return 1");
    fputs(body, f);
}

/* The completion for zsh, as a function _rasp that its completion system loads: tables of _arguments. */

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
    "        '(-v --verbose)'{-v,--verbose}'[with --version\\: compiler, flags and libraries]' '1:command:->command' "
    "'*::operand:->operand'\n"
    "    case $state in\n"
    "        command) _describe -t commands command _rasp_commands ;;\n"
    "        operand) curcontext=${curcontext%:*:*}:rasp-$line[1]: && (( $+functions[_rasp_of_$line[1]] )) && "
    "_rasp_of_$line[1] ;;\n"
    "    esac\n"
    "}\n"
    "_rasp \"$@\"\n";

/* In a specification of _arguments. */
static const char *escaped(const char *text, struct arena *a)
{
    const char *q = quoted_as(text, "[]:\\", "'\\''", a);
    return arena_format(a, "%.*s", (int)strlen(q) - 2, q + 1);
}

/* ":message:action" of _arguments. */
static void put_action(FILE *f, const char *message, struct place p, struct arena *a)
{
    fprintf(f, ":%s:", escaped(message, a));
    if (p.settings)
        fputs("_rasp_setting", f);
    else if (p.words[0]) {
        fputs(p.list ? "_values -s , word " : "(", f);
        put_list(f, " ", p.words);
        fputs(p.list ? "" : ")", f);
    } else if (p.names)
        fputs("_rasp_name", f);
    else if (p.files)
        fputs("_files", f);
    else if (p.suffixes[0]) {
        fputs("_files -g \"*.(", f);
        put_list(f, "|", p.suffixes);
        fputs(")(-.)\"", f);
    } else if (p.folders)
        fputs("_files -/", f);
    fputc('\'', f);
}

static void put_arguments(FILE *f, const struct command *m, const struct action *action, struct arena *a)
{
    const char *operands = action ? action->operands : m->operands;
    fprintf(f, "    _arguments -s -S : '(-h --help)'{-h,--help}'[this command]'");
    for (const struct args_option *o = cmd_options(m, a); o->name; o++) {
        if (!takes(action, o)) continue;
        const char *plus = o->value ? "+" : "", *equals = o->value ? "=" : "", *help = escaped(o->help, a);
        fputs(" \\\n        ", f);
        if (o->letter && o->many)
            fprintf(f, "'*'{-%c%s,--%s%s}'[%s]", o->letter, plus, o->name, equals, help);
        else if (o->letter)
            fprintf(f, "'(-%c --%s)'{-%c%s,--%s%s}'[%s]", o->letter, o->name, o->letter, plus, o->name, equals, help);
        else
            fprintf(f, "'%s--%s%s[%s]", o->many ? "*" : "", o->name, equals, help);
        if (o->value)
            put_action(f, o->value, place_of(o->value, a), a);
        else
            fputc('\'', f);
    }
    if (*operands) {
        fputs(" \\\n        '*", f);
        put_action(f, operands, operands_of(m, action, a), a);
    }
    fputc('\n', f);
}

static void zsh(FILE *f, struct arena *a)
{
    const char **keys;
    const struct setting *s = settings(&keys, a);
    fputs(head, f);
    fputs("\n_rasp_tables()\n{\n    _rasp_commands=(\n", f);
    for (const struct command *const *m = cmd_table; *m; m++)
        fprintf(f, "        %s\n", quoted_as(arena_format(a, "%s:%s", (*m)->name, (*m)->summary), "", "'\\''", a));
    fputs("        'help:explains a command'\n    )\n    _rasp_keys=( ", f);
    put_list(f, " ", keys);
    fputs(" )\n    _rasp_names=( ", f);
    put_list(f, " ", keys_text_names(a));
    fputs(" )\n    _rasp_words=(\n", f);
    for (; s->path; s++)
        if (s->words) {
            fprintf(f, "        %s '", s->path);
            put_list(f, " ", s->words);
            fputs("'\n", f);
        }
    fputs("    )\n}\n\n_rasp_name()\n{\n    compadd -a _rasp_names\n    _files -g \"*.(yaml|yml)(-.)\"\n}\n", f);
    for (const struct command *const *m = cmd_table; *m; m++) {
        fprintf(f, "\n_rasp_of_%s()\n{\n", (*m)->name);
        if ((*m)->actions) {
            fputs("    local state\n    local -a line\n    _arguments -C '1:action:(", f);
            put_names(f, *m);
            fputs(")' '*::operand:->operand'\n    [[ $state = operand ]] || return 0\n    case $line[1] in\n", f);
            for (const struct action *x = NULL; (x = next_action(*m, x));) {
                fprintf(f, "    %s)\n", x->name);
                put_arguments(f, *m, x, a);
                fputs("    ;;\n", f);
            }
            fputs("    esac\n", f);
        } else
            put_arguments(f, *m, NULL, a);
        fputs("}\n", f);
    }
    fputs("\n_rasp_of_help()\n{\n    _arguments '1:command:->command'\n    _describe -t commands command "
          "_rasp_commands\n}\n",
          f);
    fputs(tail, f);
}

/* The completion for fish: one `complete` for each option, action and operand, with the place where it holds. */

static const char fish_head[] =
    "# Completion of rasp for fish, made by `rasp completion fish`.\n"
    "\n"
    "# __rasp_in [COMMAND [ACTION]]: are these the words before the one that is completed? Without: is there none "
    "yet?\n"
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

static const char *fish_quoted(const char *text, struct arena *a) { return quoted_as(text, "\\", "\\'", a); }

/* -a and what else a place asks for. */
static void fish_place(FILE *f, struct place p, struct arena *a)
{
    const char *all = p.settings ? "(__rasp_settings)" : "";
    for (int i = 0; p.words[i]; i++)
        all = arena_format(a, "%s%s%s", all, *all ? " " : "", p.words[i]);
    if (p.list && *all) all = arena_format(a, "(__fish_append , %s)", all);
    if (p.names) all = arena_format(a, "%s $__rasp_names", all);
    for (int i = 0; !p.files && p.suffixes[i]; i++)
        all = arena_format(a, "%s (__fish_complete_suffix .%s)", all, p.suffixes[i]);
    if (p.folders && !p.files) all = arena_format(a, "%s (__fish_complete_directories)", all);
    if (!p.files) fputs(" -f", f);
    if (p.suffixes[0] && !p.files) fputs(" -k", f);
    if (*all) fprintf(f, " -a %s", fish_quoted(all, a));
    fputc('\n', f);
}

static void fish_option(FILE *f, const char *where, const struct args_option *o, struct arena *a)
{
    fprintf(f, "complete -c rasp -n %s", where);
    if (o->letter) fprintf(f, " -s %c", o->letter);
    fprintf(f, " -l %s -d %s%s", o->name, fish_quoted(o->help, a), o->value ? " -r" : "\n");
    if (o->value) fish_place(f, place_of(o->value, a), a);
}

static void fish_group(FILE *f, const struct command *m, const struct action *x, struct arena *a)
{
    static const struct args_option help = {"help", 'h', NULL, false, "this command"};
    const char *where = fish_quoted(arena_format(a, "__rasp_in %s%s%s", m->name, x ? " " : "", x ? x->name : ""), a);
    for (const struct args_option *o = cmd_options(m, a); o->name; o++)
        if (takes(x, o)) fish_option(f, where, o, a);
    fish_option(f, where, &help, a);
    fprintf(f, "complete -c rasp -n %s", where);
    fish_place(f, operands_of(m, x, a), a);
}

static void fish(FILE *f, struct arena *a)
{
    const char **keys;
    const struct setting *s = settings(&keys, a);
    fputs(fish_head, f);
    fputs("set -g __rasp_keys ", f);
    put_list(f, " ", keys);
    fputs("\nset -g __rasp_names ", f);
    put_list(f, " ", keys_text_names(a));
    fputs("\nfunction __rasp_words\n    switch $argv[1]\n", f);
    for (; s->path; s++)
        if (s->words) {
            fprintf(f, "        case %s\n            printf '%s=%%s\\n' ", s->path, s->path);
            put_list(f, " ", s->words);
            fputc('\n', f);
        }
    fputs("        case '*'\n            return 1\n    end\nend\n", f);
    fputs("\ncomplete -c rasp -n __rasp_in -s h -l help -d 'the commands'\n"
          "complete -c rasp -n __rasp_in -s V -l version -d 'the version'\n"
          "complete -c rasp -n __rasp_in -s v -l verbose -d 'with --version: compiler, flags and libraries'\n"
          "complete -c rasp -f -n __rasp_in -a help -d 'explains a command'\n"
          "complete -c rasp -f -n '__rasp_in help' -a '",
          f);
    put_names(f, NULL);
    fputs("'\n", f);
    for (const struct command *const *m = cmd_table; *m; m++) {
        fprintf(f, "\ncomplete -c rasp -f -n __rasp_in -a %s -d %s\n", (*m)->name, fish_quoted((*m)->summary, a));
        if (!(*m)->actions) fish_group(f, *m, NULL, a);
        for (const struct action *x = NULL; (x = next_action(*m, x));) {
            fprintf(f, "complete -c rasp -f -n '__rasp_in %s; and __rasp_no_action' -a %s\n", (*m)->name, x->name);
            fish_group(f, *m, x, a);
        }
    }
}

static int completion_run(struct cmd_call *c, struct err *e)
{
    const char *shell = c->args.operands[0];
    if (!strcmp(shell, "bash"))
        bash(stdout, c->arena);
    else if (!strcmp(shell, "zsh"))
        zsh(stdout, c->arena);
    else if (!strcmp(shell, "fish"))
        fish(stdout, c->arena);
    else
        err_set(e, ERR_USAGE, "no completion for '%s': write bash, zsh or fish", shell);
    return (int)e->kind;
}

static const struct args_option options[] = {{0}};

const struct command completion_command = {
    .name = "completion",
    .group = "The shell",
    .summary = "prints a script that completes rasp's words in a shell",
    .does = "Completed are commands, actions, options, the words that options take, files by their endings, keys of "
            "scenes after --set (and their words behind the equals sign) and after rasp explain. `make install` puts "
            "the three scripts where the shells find them; without it, load one as the examples show.",
    .operands = "bash|zsh|fish",
    .least = 1,
    .most = 1,
    .options = options,
    .examples = "source <(rasp completion bash)                               # bash: in ~/.bashrc\n"
                "rasp completion zsh > ~/.zfunc/_rasp                         # zsh: a folder of $fpath\n"
                "rasp completion fish > ~/.config/fish/completions/rasp.fish  # fish\n",
    .run = completion_run,
};
