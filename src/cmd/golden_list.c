/* The scenes of `rasp golden`: operands that end in .yaml or .yml are scenes, others are lists, one scene a line:

       # scene                  options
       scenes/strike.yaml       --snr 120 --third-octave 0.01
       scenes/strike.yaml       --name strike_fast --set 'contact.strike.speed=4 m/s'

   '#' begins a comment at a line's start or after a blank; quotes hold blanks. Names of files are seen from the list's folder (those in --set from the current
   one, as everywhere). */
#include <string.h>

#include "cmd/golden.h"
#include "file/bytes.h"

enum { WORDS = 200 };

const struct args_option golden_list_options[] = {
    {"name", 0, "NAME", false, "what the scene's kept files are called"},
    CMD_SCENE_OPTIONS,
    COMPARE_SOUND_LIMITS,
    COMPARE_TABLE_LIMITS,
    {0}};

struct line {
    const char *list, *folder;   /* NULL: an operand */
    int number;
    char *words[WORDS];
    int n;
};

/* ------------------------------------------------------------------ words of a line */

/* One word from *p on, which is left behind it. False: a quote is open. */
static bool take_word(const char **p, char *word)
{
    char quote = '\0';
    for (; **p && (quote || !strchr(" \t", **p)); ++*p) {
        if (quote ? **p == quote : **p == '\'' || **p == '"')
            quote = quote ? '\0' : **p;
        else
            *word++ = **p;
    }
    *word = '\0';
    return !quote;
}

static bool split(struct line *l, const char *text, struct arena *a, struct err *e)
{
    l->n = 0;
    for (const char *p = text;;) {
        p += strspn(p, " \t");
        if (!*p || *p == '#')
            return true;
        char *word = arena_take(a, strlen(p) + 1, 1);
        if (!take_word(&p, word))
            return err_set(e, ERR_SCENE, "%s:%d: a quote is not closed", l->list, l->number);
        if (l->n == WORDS)
            return err_set(e, ERR_SCENE, "%s:%d: more than %d words", l->list, l->number, WORDS);
        l->words[l->n++] = word;
    }
}

/* ------------------------------------------------------------------ a scene */

/* NAME of .../NAME.yaml */
static const char *stem(const char *file, struct arena *a)
{
    const char *slash = strrchr(file, '/'), *name = slash ? slash + 1 : file, *dot = strrchr(name, '.');
    size_t n = dot && dot > name ? (size_t)(dot - name) : strlen(name);
    if (n > 6 && !strncmp(name + n - 6, ".scene", 6))
        n -= 6;
    return arena_format(a, "%.*s", (int)n, name);
}

static bool name_good(const struct golden_scene *s, struct err *e)
{
    static const char letters[] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz+-_.";
    return (*s->name && *s->name != '.' && strspn(s->name, letters) == strlen(s->name)) ||
           err_set(e, *s->at ? ERR_SCENE : ERR_USAGE, "%s'%s' cannot be the name of kept files: letters, digits and + - _ . are taken; in a list --name NAME gives another", s->at,
                   s->name);
}

/* Its own limits count, of each kind for which it has any; else those of the command. */
static bool limits(struct golden *g, struct golden_scene *s, const char *folder, struct err *e)
{
    const struct args *all = &g->call->args;
    struct compare_ask own = {.arena = g->call->arena}, common = own;
    bool sounds = compare_limit_of_sounds(&s->args), tables = compare_limit_of_tables(&s->args);
    if (!compare_limits(&s->args, folder, &own, e) || !compare_limits(all, NULL, &common, e))
        return false;
    s->sounds = sounds ? own : common;
    s->tables = tables ? own : common;
    s->sounds.exact = !sounds && !compare_limit_of_sounds(all);
    s->tables.exact = !tables && !compare_limit_of_tables(all);
    return g->kept || (s->sounds.exact && s->tables.exact) ||
           err_set(e, ERR_USAGE, "--%s: where only hashes are kept there is no sound or table to measure from; keep files, too, with --kept",
                   sounds ? compare_limit_of_sounds(&s->args) : tables ? compare_limit_of_tables(&s->args)
                   : s->sounds.exact                                   ? compare_limit_of_tables(all)
                                                                       : compare_limit_of_sounds(all));
}

/* An error in a line is one in the list's text. */
static bool at_line(const struct golden_scene *s, const struct err *why, struct err *e)
{
    return err_set(e, *s->at && why->kind == ERR_USAGE ? ERR_SCENE : why->kind, "%s%s", s->at, why->text);
}

static bool scene_add(struct golden *g, struct line *l, struct err *e)
{
    struct arena *a = g->call->arena;
    struct golden_scene *s = &g->scenes[g->n];
    struct err why = {0};
    s->at = l->list ? arena_format(a, "%s:%d: ", l->list, l->number) : "";
    if (!args_parse(&s->args, golden_list_options, l->n, l->words, a, &why))
        return at_line(s, &why, e);
    if (s->args.help || s->args.n_operands != 1)
        return err_set(e, ERR_SCENE, "%sa line is one scene and its options, as in: scenes/strike.yaml --snr 120", s->at);
    const char *file = s->args.operands[0], *name = args_value(&s->args, "name");
    s->file = l->folder && *file != '/' ? arena_format(a, "%s/%s", l->folder, file) : file;
    s->name = name ? name : stem(file, a);
    if (!name_good(s, e))
        return false;
    if (!limits(g, s, l->folder, &why))
        return at_line(s, &why, e);
    s->arena = arena_open();
    g->n++;
    struct cmd_call call = *g->call;
    call.args = s->args;
    cmd_read_scene(&call, s->file, &s->scene, &s->failed);
    return true;
}

/* ------------------------------------------------------------------ operands */

static int lines_in(const char *text)
{
    int n = 1;
    for (; *text; text++)
        n += *text == '\n';
    return n;
}

static void make_room(struct golden *g, int more)
{
    struct golden_scene *scenes = ARENA_TAKE(g->call->arena, struct golden_scene, g->n + more);
    if (g->n)
        memcpy(scenes, g->scenes, (size_t)g->n * sizeof *scenes);
    g->scenes = scenes;
}

static bool list_add(struct golden *g, const char *file, struct err *e)
{
    struct arena *a = g->call->arena;
    const char *slash = strrchr(file, '/');
    struct line *l = ARENA_TAKE(a, struct line, 1);
    struct bytes b;
    int before = g->n;
    *l = (struct line){.list = file, .folder = slash ? arena_format(a, "%.*s", slash == file ? 1 : (int)(slash - file), file) : NULL};
    if (!bytes_read(file, a, &b, e))
        return false;
    if (strlen(b.at) != b.n)
        return err_set(e, ERR_SCENE, "%s: is no list of scenes, which is text", file);
    make_room(g, lines_in(b.at));
    for (char *p = b.at, *next; p; p = next) {
        next = strchr(p, '\n');
        if (next)
            *next++ = '\0';
        p[strcspn(p, "\r")] = '\0';
        l->number++;
        if (!split(l, p, a, e) || (l->n && !scene_add(g, l, e)))
            return false;
    }
    return g->n > before || err_set(e, ERR_SCENE, "%s: no scene is listed: nothing would be checked", file);
}

static bool is_scene(const char *file)
{
    const char *dot = strrchr(file, '.');
    return dot && (!strcmp(dot, ".yaml") || !strcmp(dot, ".yml"));
}

static bool names_differ(const struct golden *g, struct err *e)
{
    for (int i = 0; i < g->n; i++)
        for (int k = 0; k < i; k++)
            if (!strcmp(g->scenes[i].name, g->scenes[k].name))
                return err_set(e, *g->scenes[i].at ? ERR_SCENE : ERR_USAGE, "%s%s and %s are both called %s; in a list --name NAME tells them apart", g->scenes[i].at, g->scenes[i].file,
                               g->scenes[k].file, g->scenes[i].name);
    return true;
}

bool golden_list(struct golden *g, struct err *e)
{
    const struct args *args = &g->call->args;
    g->whole = true;
    for (int i = 0; i < args->n_operands; i++) {
        const char *file = args->operands[i];
        struct line l = {.words = {(char[]){"--"}, arena_text(g->call->arena, file)}, .n = 2};
        bool scene = is_scene(file);
        g->whole = g->whole && !scene;
        if (scene)
            make_room(g, 1);
        if (scene ? !scene_add(g, &l, e) : !list_add(g, file, e))
            return false;
    }
    return names_differ(g, e);
}
