/* rasp completion: scripts that complete rasp's words in a shell.

   What may follow an option, or stand as an operand, is read from what the help calls it: words with | between are the words, PATH=VALUE a key of a scene,
   PANEL the panels of rasp plot, X,... several, SCENE, RECIPE and DESIGN YAML files, FILE.csv files that end so, FOLDER a folder, KEY a key; other capitals that mean files are listed below. */
#include "cmd/completion.h"

#include <ctype.h>
#include <string.h>

#include "cmd/commands.h"
#include "cmd/plot.h"
#include "cmd/starters.h"
#include "scene/keys_text.h"

static const char *const any_file[] = {"FILE", "A", "B", "IN", "OUT", "RECORDING", "MESH", "PREFIX", NULL};
static const char *const folder[] = {"FOLDER", "FOLDER/", "DIR", "DIR/", NULL};
static const char *const yaml_file[] = {"SCENE", "RECIPE", "DESIGN", NULL};
static const char *const key_name[] = {"KEY", "SECTION", NULL};

static bool is_one(const char *word, const char *const *list)
{
    for (; *list; list++)
        if (!strcmp(*list, word))
            return true;
    return false;
}

static void add(const char **list, int room, const char *word)
{
    int n = 0;
    while (list[n] && strcmp(list[n], word) != 0)
        n++;
    if (n < room)
        list[n] = word;
}

static void add_token(struct completion_place *p, const char *token)
{
    const char *dot = strchr(token, '.');
    p->settings = p->settings || !strcmp(token, "PATH=VALUE");
    p->names = p->names || is_one(token, key_name);
    for (int k = 0; k < PLOT_PANELS && !strcmp(token, "PANEL"); k++)
        add(p->words, COMPLETION_WORDS, plot_panels_words[k]);
    p->files = p->files || is_one(token, any_file);
    p->folders = p->folders || is_one(token, folder);
    if (dot && isupper((unsigned char)token[0]) && islower((unsigned char)dot[1]))
        add(p->suffixes, COMPLETION_SUFFIXES, dot + 1);
    if (is_one(token, yaml_file) || (dot && !strcmp(dot, ".yaml"))) {
        add(p->suffixes, COMPLETION_SUFFIXES, "yaml");
        add(p->suffixes, COMPLETION_SUFFIXES, "yml");
    }
}

static bool is_word_list(const char *text)
{
    for (const char *p = text; *p; p++)
        if (isupper((unsigned char)*p) || *p == ' ')
            return false;
    return strchr(text, '|');
}

static struct completion_place place_of(const char *text, struct arena *a)
{
    struct completion_place p = {.list = strstr(text, ",...") != NULL};
    bool words = is_word_list(text);
    for (const char *s = text; *s;) {
        size_t n = strcspn(s, " |[],;:()"), end = n;
        while (end > 3 && !strncmp(s + end - 3, "...", 3))
            end -= 3;
        const char *token = arena_format(a, "%.*s", (int)end, s);
        if (words && *token)
            add(p.words, COMPLETION_WORDS, token);
        else
            add_token(&p, token);
        s += n + !!s[n];
    }
    return p;
}

struct completion_place completion_value(const struct args_option *o, struct arena *a)
{
    return place_of(o->value, a);
}

struct completion_place completion_operands(const struct command *m, const struct action *action, struct arena *a)
{
    struct completion_place p = place_of(action ? action->operands : m->operands, a);
    for (const struct starter *s = starters_table; m == &new_command && s->name; s++)
        add(p.words, COMPLETION_WORDS, s->name);
    return p;
}

bool completion_takes(const struct action *action, const struct args_option *o)
{
    for (int i = 0; action && i < ACTIONS_OPTIONS && action->options[i]; i++)
        if (!strcmp(action->options[i], o->name))
            return true;
    return !action || cmd_shared(o);
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

const struct completion_setting *completion_settings(struct arena *a)
{
    int n = 0, most = 4;
    for (const struct key *k = keys_table; k->path; k++)
        most++;
    for (const struct key_knob *k = keys_knobs; k->name; k++)
        most++;
    struct completion_setting *all = ARENA_TAKE(a, struct completion_setting, most);
    for (const struct key *k = keys_table; k->path; k++)
        all[n++] = (struct completion_setting){k->path, words_of(k, a)};
    all[n++] = (struct completion_setting){"accuracy", keys_presets};
    all[n++] = (struct completion_setting){"accuracy.preset", keys_presets};
    all[n++] = (struct completion_setting){"accuracy.error", NULL};
    for (const struct key_knob *k = keys_knobs; k->name; k++)
        all[n++] = (struct completion_setting){arena_format(a, "accuracy.%s", k->name), NULL};
    return all;
}

const char *completion_quoted(const char *text, const char *risky, const char *quote, struct arena *a)
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
        if (strchr(risky, *text))
            out[n++] = '\\';
        out[n++] = *text;
    }
    out[n++] = '\'';
    out[n] = '\0';
    return out;
}

static int completion_run(struct cmd_call *c, struct err *e)
{
    const char *shell = c->args.operands[0];
    if (!strcmp(shell, "bash"))
        completion_bash(stdout, c->arena);
    else if (!strcmp(shell, "zsh"))
        completion_zsh(stdout, c->arena);
    else if (!strcmp(shell, "fish"))
        completion_fish(stdout, c->arena);
    else
        err_set(e, ERR_USAGE, "no completion for '%s': write bash, zsh or fish", shell);
    return (int)e->kind;
}

static const struct args_option options[] = {{0}};

const struct command completion_command = {
    .name = "completion",
    .summary = "prints a script that completes rasp's words in a shell",
    .does = "Completed are commands, actions, options, the words that options take, files by their endings, keys of scenes after --set (and their words behind the "
            "equals sign) and after rasp explain. `make install` puts the three scripts where the shells find them; without it, load one as the examples show.",
    .operands = "bash|zsh|fish",
    .least = 1,
    .most = 1,
    .options = options,
    .examples = "source <(rasp completion bash)                               # bash: in ~/.bashrc\n"
                "rasp completion zsh > ~/.zfunc/_rasp                         # zsh: a folder of $fpath\n"
                "rasp completion fish > ~/.config/fish/completions/rasp.fish  # fish\n",
    .run = completion_run,
};
