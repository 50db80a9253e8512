/* rasp completion: what a word of a command line may become, and the scripts by which shells ask for it.

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

/* ------------------------------------------------------------------ answers

   The first line is what stays of the word; behind it stands one of the answers, each a line: a word, maybe a tab and
   what it means; an option that takes a value ends in =. @files, @folders and @.yaml stand for files, folders and files
   of that ending; @list says that words may be strung together with commas. */

/* What may stand where the text does, behind a prefix that stays. */
static void put_place(const char *prefix, const char *text, const struct place *p, struct arena *a)
{
    static const char *const own[] = {"accuracy", "accuracy.preset", "accuracy.error", NULL};
    const char *comma = p->list && p->words[0] ? strrchr(text, ',') : NULL, *equals = strchr(text, '=');
    if (p->settings && equals) { /* KEY=VALUE: the words of the key */
        const char *path = arena_format(a, "%.*s", (int)(equals - text), text);
        const struct key *key = keys_find(path);
        printf("%s%s=\n", prefix, path);
        for (const struct choice *c = key ? key->choices : NULL; c && c->word; c++)
            puts(c->word);
        for (int i = 0; (!strcmp(path, own[0]) || !strcmp(path, own[1])) && keys_presets[i]; i++)
            puts(keys_presets[i]);
        return;
    }
    if (p->settings) { /* the keys */
        puts(prefix);
        for (const struct key *k = keys_table; k->path; k++)
            printf("%s=\n", k->path);
        for (int i = 0; own[i]; i++)
            printf("%s=\n", own[i]);
        for (const struct key_knob *k = keys_knobs; k->name; k++)
            printf("accuracy.%s=\n", k->name);
        return;
    }
    printf("%s%.*s\n", prefix, comma ? (int)(comma + 1 - text) : 0, text);
    if (p->files) puts("@files");
    if (p->folders) puts("@folders");
    for (const char **names = p->names ? keys_text_names(a) : NULL; names && *names; names++)
        puts(*names);
    for (int i = 0; !p->files && p->suffixes[i]; i++)
        printf("@.%s\n", p->suffixes[i]);
    if (!p->files && !p->folders && p->suffixes[0]) puts("@folders");
    if (p->list && p->words[0]) puts("@list");
    for (int i = 0; p->words[i]; i++)
        puts(p->words[i]);
}

/* The option that a word names, with the value behind = if it has one; NULL: none. */
static const struct args_option *option_named(const struct command *m, const char *word, struct arena *a)
{
    const struct args_option *o = m ? cmd_options(m, a) : NULL;
    bool letter = word[1] != '-';
    size_t n = letter ? 0 : strcspn(word + 2, "=");
    while (o && o->name &&
           (letter ? o->letter != word[1] || word[2] : strlen(o->name) != n || strncmp(o->name, word + 2, n)))
        o++;
    return o && o->name ? o : NULL;
}

static void put_options(const struct command *m, const struct action *action, struct arena *a)
{
    static const struct args_option bare[] = {
        {"version", 'V', NULL, false, "the version"},
        {"verbose", 'v', NULL, false, "with --version: compiler, flags and libraries"},
        {0}};
    printf(m ? "\n" : "\n-h\tthe commands\n--help\tthe commands\n");
    for (const struct args_option *o = m ? cmd_options(m, a) : bare; o->name; o++) {
        bool taken = !action || cmd_shared(o);
        for (int i = 0; action && i < CMD_ACTION_OPTIONS && action->options[i]; i++)
            taken = taken || !strcmp(action->options[i], o->name);
        if (!taken) continue;
        if (o->letter) printf("-%c\t%s\n", o->letter, o->help);
        printf("--%s%s\t%s\n", o->name, o->value ? "=" : "", o->help);
    }
    if (m) printf("-h\tthis command\n--help\tthis command\n");
}

/* What the last of the words behind `rasp` may become. */
static void put_answers(const char **words, int n, struct arena *a)
{
    const struct command *m = NULL;
    const struct action *action = NULL;
    const struct args_option *expects = NULL; /* whose value comes next */
    const char *name = NULL, *last = n > 0 ? words[n - 1] : "",
               *equals = strncmp(last, "--", 2) ? NULL : strchr(last, '=');
    bool ended = false, acts = false;
    for (int i = 0; i + 1 < n; i++) {
        const char *word = words[i];
        if (expects)
            expects = NULL;
        else if (!ended && !strcmp(word, "--"))
            ended = true;
        else if (!ended && word[0] == '-' && word[1]) {
            expects = strncmp(word, "--", 2) || !strchr(word, '=') ? option_named(m, word, a) : NULL;
            if (expects && !expects->value) expects = NULL;
        } else if (!name)
            m = cmd_find(name = word);
        else if (m && m->actions && !acts) {
            acts = true;
            for (const struct action *x = m->actions; x->name; x++)
                action = strcmp(x->name, word) ? action : x;
        }
    }
    if (!expects && !ended && equals) {
        const struct args_option *o = option_named(m, last, a);
        struct place p = place_of(o && o->value ? o->value : "", a);
        put_place(arena_format(a, "%.*s", (int)(equals + 1 - last), last), equals + 1, &p, a);
    } else if (!expects && !ended && *last == '-')
        put_options(m, action, a);
    else if (!expects && (!name || !strcmp(name, "help"))) {
        putchar('\n');
        for (const struct command *const *c = cmd_table; *c; c++)
            printf("%s\t%s\n", (*c)->name, (*c)->summary);
        puts("help\texplains a command");
    } else if (!expects && m && m->actions && !acts) {
        putchar('\n');
        for (const struct action *x = m->actions; x->name; x++)
            puts(x->name);
    } else if (expects || (m && (!m->actions || action))) {
        struct place p = place_of(expects ? expects->value : action ? action->operands : m->operands, a);
        for (const struct new_starter *s = new_starters; !expects && m == &new_command && s->name; s++)
            add(p.words, WORDS, s->name);
        put_place("", last, &p, a);
    }
}

/* ------------------------------------------------------------------ scripts */

/* For bash, 4.4 or later. bash breaks words at =, unless COMP_WORDBREAKS says otherwise: the script glues them, and
   takes from its answers all up to the last = of the word that is completed. */
static const char bash[] =
    "# Completion of rasp for bash, made by `rasp completion bash`.\n"
    "_rasp()\n"
    "{\n"
    "    local word cur prefix glue= files= i\n"
    "    local -a words=()\n"
    "    COMPREPLY=()\n"
    "    for ((i = 0; i <= COMP_CWORD; i++)); do\n"
    "        word=${COMP_WORDS[i]}\n"
    "        if [[ $glue || $word == =* ]] && ((i > 1)); then words[-1]+=$word; else words+=(\"$word\"); fi\n"
    "        glue=\n"
    "        [[ $word != =* ]] || glue=1\n"
    "    done\n"
    "    cur=${words[-1]}\n"
    "    while IFS=$'\\t' read -r word _; do\n"
    "        if [[ ! ${prefix+read} ]]; then prefix=$word cur=${cur#\"$word\"}; continue; fi\n"
    "        case $word in\n"
    "            @list) continue ;;\n"
    "            @files) set -- -f ;;\n"
    "            @folders) set -- -d ;;\n"
    "            @.*) set -- -f -X \"!*${word#@}\" ;;\n"
    "            --*=) word=${word%=} ;;&\n"
    "            *=) compopt -o nospace 2> /dev/null ;;&\n"
    "            *) [[ $word != \"$cur\"* ]] || COMPREPLY+=(\"$prefix$word\"); continue ;;\n"
    "        esac\n"
    "        files=1\n"
    "        while IFS= read -r word; do COMPREPLY+=(\"$prefix$word\"); done < <(compgen \"$@\" -- \"$cur\")\n"
    "    done < <(\"${words[0]/#\\~\\//$HOME/}\" completion words -- \"${words[@]:1}\" 2> /dev/null)\n"
    "    [[ ! $files ]] || compopt -o filenames -o bashdefault -o default 2> /dev/null\n"
    "    [[ $COMP_WORDBREAKS != *=* || ${prefix-}$cur != *=* ]] || "
    "COMPREPLY=(\"${COMPREPLY[@]#\"${words[-1]%=*}=\"}\")\n"
    "}\n"
    "complete -F _rasp rasp\n";

/* For zsh, as a function _rasp that its completion system loads. */
static const char zsh[] =
    "#compdef rasp\n"
    "# Completion of rasp for zsh, made by `rasp completion zsh`.\n"
    "_rasp()\n"
    "{\n"
    "    local line word folders\n"
    "    local -a lines globs list plain open plain_shown open_shown\n"
    "    lines=(\"${(@f)$(${(Q)~words[1]} completion words -- \"${(@Q)words[2,CURRENT-1]}\" \"${(Q)PREFIX}\" 2> "
    "/dev/null)}\")\n"
    "    compset -p ${#lines[1]}\n"
    "    for line in \"${(@)lines[2,-1]}\"; do\n"
    "        word=${line%%$'\\t'*}\n"
    "        [[ $line != *$'\\t'* ]] || line=\"$word  -- ${line#*$'\\t'}\"\n"
    "        case $word in\n"
    "            @files) _files ;;\n"
    "            @folders) folders=1 ;;\n"
    "            @list) list=(-q -S ,) ;;\n"
    "            @.*) globs+=(${word#@.}) ;;\n"
    "            *=) open+=($word) open_shown+=($line) ;;\n"
    "            ?*) plain+=($word) plain_shown+=($line) ;;\n"
    "        esac\n"
    "    done\n"
    "    compadd $list -l -d plain_shown -a plain\n"
    "    compadd -S '' -l -d open_shown -a open\n"
    "    if (( $#globs )); then _files -g \"*.(${(j:|:)globs})(-.)\"; elif [[ $folders ]]; then _files -/; fi\n"
    "}\n"
    "_rasp \"$@\"\n";

static const char fish[] =
    "# Completion of rasp for fish, made by `rasp completion fish`.\n"
    "function __rasp\n"
    "    set -l words (commandline -opc) (commandline -ct)\n"
    "    set -l lines ($words[1] completion words -- $words[2..-1] 2> /dev/null)\n"
    "    set -l prefix $lines[1]\n"
    "    set -l rest (string sub -s (math 1 + (string length -- \"$prefix\")) -- \"$words[-1]\")\n"
    "    set -l ends\n"
    "    for line in $lines[2..-1]\n"
    "        switch $line\n"
    "            case '@list'\n"
    "            case '@files'\n"
    "                set -a ends ''\n"
    "            case '@folders'\n"
    "                set -a ends /\n"
    "            case '@*'\n"
    "                set -a ends / (string escape --style=regex -- (string sub -s 2 -- $line))\n"
    "            case '-*'\n"
    "                string replace -r '=?(\\t|$)' '$1' -- $line | string match -- \"$rest*\"\n"
    "            case '*'\n"
    "                printf '%s\\n' $prefix$line\n"
    "        end\n"
    "    end\n"
    "    set -q ends[1] || return\n"
    "    printf '%s\\n' $prefix(complete -C \"__fish_command_without_completions $rest\" | string match -r "
    "\".*(?:\"(string join '|' $ends)\")\\$\")\n"
    "end\n"
    "complete -c rasp -f -a '(__rasp)'\n";

static int completion_run(struct cmd_call *c, struct err *e)
{
    const char *shell = c->args.operands[0];
    if (!strcmp(shell, "words"))
        put_answers(c->args.operands + 1, c->args.n_operands - 1, c->arena);
    else if (c->args.n_operands > 1)
        err_set(e, ERR_USAGE, "extra operand '%s'; usage: rasp completion [OPTION]... bash|zsh|fish",
                c->args.operands[1]);
    else if (!strcmp(shell, "bash"))
        fputs(bash, stdout);
    else if (!strcmp(shell, "zsh"))
        fputs(zsh, stdout);
    else if (!strcmp(shell, "fish"))
        fputs(fish, stdout);
    else
        err_set(e, ERR_USAGE, "no completion for '%s': write bash, zsh or fish", shell);
    return (int)e->kind;
}

static const struct args_option options[] = {{0}};

const struct command completion_command = {
    .name = "completion",
    .group = "The shell",
    .summary = "prints a script that completes rasp's words in a shell",
    .does =
        "Completes commands, actions, options, the words that options take, files by their endings, and keys of "
        "scenes after rasp explain and after --set, with their words behind the equals sign. `make install` puts the "
        "three scripts where the shells find them; without it, load one as the examples show. The scripts ask rasp: "
        "rasp completion words -- WORD... says what the last word may become.",
    .operands = "bash|zsh|fish",
    .least = 1,
    .most = -1, /* words: those of a command line */
    .options = options,
    .examples = "source <(rasp completion bash)                               # bash: in ~/.bashrc\n"
                "rasp completion zsh > ~/.zfunc/_rasp                         # zsh: a folder of $fpath\n"
                "rasp completion fish > ~/.config/fish/completions/rasp.fish  # fish\n",
    .run = completion_run,
};
