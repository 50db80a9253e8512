/* What is kept of the scenes of `rasp golden`: files, hashes, or both. */
#include "cmd/golden.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/relpath.h"
#include "base/text.h"
#include "batch/batch.h"
#include "cmd/cmd.h"
#include "file/bytes.h"
#include "output/mark.h"

enum { GAP = 2 /* of blanks between hash and name; the second may be * */ };

static int by_name(const void *a, const void *b)
{
    return strcmp(((const struct golden_file *)a)->name, ((const struct golden_file *)b)->name);
}

void golden_sort(struct golden_files *files)
{
    if (files->n) qsort(files->list, (size_t)files->n, sizeof *files->list, by_name);
}

const struct golden_file *golden_find(const struct golden_files *files, const char *name)
{
    for (int i = 0; i < files->n; i++)
        if (!strcmp(files->list[i].name, name)) return &files->list[i];
    return NULL;
}

struct golden_file *golden_add(struct golden_files *files, const char *name, struct arena *a)
{
    files->list = arena_more(a, files->list, files->n, sizeof *files->list);
    files->list[files->n].name = name;
    return &files->list[files->n++];
}

bool golden_has(const struct golden *g, const char *name, size_t n)
{
    for (int i = 0; i < g->n; i++)
        if (strlen(g->scenes[i].name) == n && !strncmp(g->scenes[i].name, name, n)) return true;
    return false;
}

bool golden_read_hashes(struct golden *g, struct err *e)
{
    struct bytes b;
    size_t n = HASH_TEXT - 1;
    if (!g->hashes) return true;
    if (!bytes_read(g->hashes, g->call->arena, &b, e)) return false;
    char *rest = b.at, *line;
    for (int number = 1; (line = strsep(&rest, "\n")); number++) {
        line[strcspn(line, "\r")] = '\0';
        if (!*line) continue;
        bool good = strlen(line) > n + GAP && strspn(line, "0123456789abcdef") == n && line[n] == ' ' &&
                    strchr(" *", line[n + 1]);
        if (!good || !strchr(line + n + GAP, '/'))
            return err_set(e, ERR_SCENE, "%s:%d: is not of the form SHA256  NAME/FILE, as rasp golden update writes it",
                           g->hashes, number);
        line[n] = '\0';
        memcpy(golden_add(&g->sums, line + n + GAP, g->call->arena)->sha256, line, HASH_TEXT);
    }
    return true;
}

static bool is_output(const char *name)
{
    const char *dot = strrchr(name, '.');
    return *name != '.' && dot && (!strcmp(dot, ".wav") || !strcmp(dot, ".csv") || !strcmp(dot, ".npy"));
}

/* Sounds and tables in a folder, without hashes; none where there is no such folder. */
static struct golden_files in_folder(const char *folder, struct arena *a)
{
    struct golden_files files = {NULL, 0};
    DIR *d = opendir(folder);
    for (struct dirent *entry; d && (entry = readdir(d));)
        if (is_output(entry->d_name)) golden_add(&files, arena_text(a, entry->d_name), a);
    if (d) closedir(d);
    golden_sort(&files);
    return files;
}

struct golden_files golden_files_of(const struct golden *g, const char *scene, struct arena *a, struct err *e)
{
    struct golden_files files = {NULL, 0};
    if (g->saved) {
        const char *folder = arena_format(a, "%s/%s", g->saved, scene);
        files = in_folder(folder, a);
        for (int i = 0; i < files.n; i++)
            hash_file(arena_format(a, "%s/%s", folder, files.list[i].name), files.list[i].sha256, e);
        return files;
    }
    size_t n = strlen(scene);
    for (int i = 0; i < g->sums.n; i++) {
        const struct golden_file *sum = &g->sums.list[i];
        if (!strncmp(sum->name, scene, n) && sum->name[n] == '/')
            memcpy(golden_add(&files, sum->name + n + 1, a)->sha256, sum->sha256, HASH_TEXT);
    }
    golden_sort(&files);
    return files;
}

const char **golden_strays(const struct golden *g, struct arena *a)
{
    struct golden_files all = {NULL, 0};
    struct dirent **entries;
    int n = g->saved ? scandir(g->saved, &entries, NULL, alphasort) : -1;
    for (int i = 0; i < n; i++) {
        const char *name = entries[i]->d_name;
        if (*name != '.' && is_output(name)) golden_add(&all, arena_text(a, name), a);
        if (*name != '.' && !golden_has(g, name, strlen(name))) {
            struct golden_files files = in_folder(arena_format(a, "%s/%s", g->saved, name), a);
            for (int k = 0; k < files.n; k++)
                golden_add(&all, arena_format(a, "%s/%s", name, files.list[k].name), a);
        }
        free(entries[i]);
    }
    if (n >= 0) free(entries);
    for (int i = 0; i < g->sums.n; i++)
        if (!golden_has(g, g->sums.list[i].name, strcspn(g->sums.list[i].name, "/")))
            golden_add(&all, arena_format(a, "%s, in %s", g->sums.list[i].name, g->hashes), a);
    const char **names = ARENA_TAKE(a, const char *, all.n + 1);
    for (int i = 0; i < all.n; i++)
        names[i] = all.list[i].name;
    return names;
}

/* The scenes of `rasp golden`: operands that end in .yaml or .yml are scenes, others are lists, one scene a line:

       # scene                  options
       scenes/strike.yaml       --snr 120 --third-octave 0.01
       scenes/strike.yaml       --name strike_fast --set 'contact.strike.speed=4 m/s'

   '#' begins a comment at a line's start or after a blank; quotes hold blanks. Names of files are seen from the list's
   folder (those in --set from the current one, as everywhere). */

enum { WORDS = 200 };

/* The scenes that the operands stand for, read. What is wrong with a scene is its own failure.
 * ERR_USAGE, ERR_INPUT, ERR_SCENE */
static const struct args_option golden_list_options[] = {
    {"name", 0, "NAME", false, "what the scene's kept files are called"},
    CMD_SCENE_OPTIONS,
    COMPARE_SOUND_LIMITS,
    COMPARE_TABLE_LIMITS,
    {0}};

struct line {
    const char *list, *folder; /* NULL: an operand */
    int number;
    char *words[WORDS];
    int n;
};

/* ------------------------------------------------------------------ a scene */

/* Its own limits count, of each kind for which it has any; else those of the command. */
static bool limits(struct golden *g, struct golden_scene *s, const char *folder, struct err *e)
{
    const struct args *all = &g->call->args;
    struct compare_ask own = {.arena = g->call->arena}, common = own;
    bool sounds = compare_limit_of_sounds(&s->args), tables = compare_limit_of_tables(&s->args);
    if (!compare_limits(&s->args, folder, &own, e) || !compare_limits(all, NULL, &common, e)) return false;
    s->sounds = sounds ? own : common;
    s->tables = tables ? own : common;
    s->sounds.exact = !sounds && !compare_limit_of_sounds(all);
    s->tables.exact = !tables && !compare_limit_of_tables(all);
    return g->saved || (s->sounds.exact && s->tables.exact) ||
           err_set(e, ERR_USAGE,
                   "--%s: where only hashes are kept there is no sound or table to measure from; keep files, too, with "
                   "--kept",
                   sounds            ? compare_limit_of_sounds(&s->args)
                   : tables          ? compare_limit_of_tables(&s->args)
                   : s->sounds.exact ? compare_limit_of_tables(all)
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
    struct golden_scene *s = (g->scenes = arena_more(a, g->scenes, g->n, sizeof *s)) + g->n;
    struct err why = {0};
    s->at = l->list ? arena_format(a, "%s:%d: ", l->list, l->number) : "";
    if (!args_parse(&s->args, golden_list_options, l->n, l->words, a, &why)) return at_line(s, &why, e);
    if (s->args.help || s->args.n_operands != 1)
        return err_set(e, ERR_SCENE, "%sa line is one scene and its options, as in: scenes/strike.yaml --snr 120",
                       s->at);
    const char *file = s->args.operands[0], *name = args_value(&s->args, "name");
    s->file = l->folder && *file != '/' ? arena_format(a, "%s/%s", l->folder, file) : file;
    if (!name) { /* NAME of .../NAME.yaml */
        name = relpath_stem(s->file, a);
        if (text_ends(name, ".scene")) name = relpath_stem(name, a);
    }
    s->name = name;
    static const char letters[] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz+-_.";
    if (!*s->name || *s->name == '.' || s->name[strspn(s->name, letters)])
        return err_set(e, *s->at ? ERR_SCENE : ERR_USAGE,
                       "%s'%s' cannot be the name of kept files: letters, digits and + - _ . are taken; in a list "
                       "--name NAME gives another",
                       s->at, s->name);
    if (!limits(g, s, l->folder, &why)) return at_line(s, &why, e);
    s->arena = arena_open();
    g->n++;
    struct cmd_call call = *g->call;
    call.args = s->args;
    cmd_read_scene(&call, s->file, &s->scene, &s->failed);
    return true;
}

/* ------------------------------------------------------------------ operands */

static bool list_add(struct golden *g, const char *file, struct err *e)
{
    struct arena *a = g->call->arena;
    const char *slash = strrchr(file, '/');
    struct line *l = ARENA_TAKE(a, struct line, 1);
    struct bytes b;
    int before = g->n;
    *l = (struct line){.list = file,
                       .folder = slash ? arena_format(a, "%.*s", slash == file ? 1 : (int)(slash - file), file) : NULL};
    if (access(file, F_OK) != 0 && errno == ENOENT) {
        const char *near = bytes_near(file, a);
        return err_set(e, ERR_INPUT, "%s: %s; %s%s", file, strerror(ENOENT),
                       near ? "did you mean " : "a list is a text file, one scene a line",
                       near ? arena_format(a, "%s?", near) : "");
    }
    if (!bytes_read(file, a, &b, e)) return false;
    if (strlen(b.at) != b.n) return err_set(e, ERR_SCENE, "%s: is no list of scenes, which is text", file);
    for (char *rest = b.at, *p; (p = strsep(&rest, "\n"));) {
        p[strcspn(p, "\r")] = '\0';
        l->number++;
        l->n = 0;
        for (p += strspn(p, " \t"); *p && *p != '#'; p += strspn(p, " \t")) {
            char *word = arena_take(a, strlen(p) + 1, 1), *to = word, quote = '\0';
            for (; *p && (quote || !strchr(" \t", *p)); p++) {
                if (quote ? *p == quote : *p == '\'' || *p == '"')
                    quote = quote ? '\0' : *p;
                else
                    *to++ = *p;
            }
            if (quote) return err_set(e, ERR_SCENE, "%s:%d: a quote is not closed", file, l->number);
            if (l->n == WORDS) return err_set(e, ERR_SCENE, "%s:%d: more than %d words", file, l->number, WORDS);
            l->words[l->n++] = word;
        }
        if (l->n && !scene_add(g, l, e)) return false;
    }
    return g->n > before || err_set(e, ERR_SCENE, "%s: no scene is listed: nothing would be checked", file);
}

static bool golden_list(struct golden *g, struct err *e)
{
    const struct args *args = &g->call->args;
    g->whole = true;
    for (int i = 0; i < args->n_operands; i++) {
        const char *file = args->operands[i];
        struct line l = {.words = {(char[]){"--"}, arena_text(g->call->arena, file)}, .n = 2};
        const char *dot = strrchr(file, '.');
        bool scene = dot && (!strcmp(dot, ".yaml") || !strcmp(dot, ".yml"));
        g->whole = g->whole && !scene;
        if (scene ? !scene_add(g, &l, e) : !list_add(g, file, e)) return false;
    }
    for (int i = 0; i < g->n; i++)
        for (int k = 0; k < i; k++)
            if (!strcmp(g->scenes[i].name, g->scenes[k].name))
                return err_set(e, *g->scenes[i].at ? ERR_SCENE : ERR_USAGE,
                               "%s%s and %s are both called %s; in a list --name NAME tells them apart",
                               g->scenes[i].at, g->scenes[i].file, g->scenes[k].file, g->scenes[i].name);
    return true;
}

/* What `rasp golden` prints: lines for people, or the Test Anything Protocol, version 13, each failure with a YAML
   block; and, into a file, JUnit's XML. */

/* 'text' in YAML. */
static void put_quoted(const struct golden *g, const char *text)
{
    putchar('\'');
    for (const char *p = text_shown(g->call->arena, text); *p; p++)
        fputs(*p == '\'' ? "''" : (const char[]){*p, '\0'}, stdout);
    puts("'");
}

static void put_lines(const char *text, const char *before)
{
    for (const char *p = text; *p;) {
        size_t n = strcspn(p, "\n");
        printf("%s%.*s\n", before, (int)n, p);
        p += n + (p[n] == '\n');
    }
}

void golden_report_scene(const struct golden *g, const struct golden_scene *s, int number)
{
    struct arena *a = g->call->arena;
    if (g->tap) {
        printf("%sok %d - %s", s->n_problems ? "not " : "", number, s->name);
        puts(s->note && !s->n_problems ? arena_format(g->call->arena, " (within its tolerances: %s)", s->note) : "");
        fflush(stdout);
        if (s->n_problems == 0) return;
        fputs("  ---\n  scene: ", stdout);
        put_quoted(g, s->file);
        puts("  severity: fail\n  problems:");
        for (const struct golden_problem *p = s->problems; p < s->problems + s->n_problems; p++) {
            if (*p->file) {
                fputs("    - file: ", stdout);
                put_quoted(g, p->file);
            }
            fputs(*p->file ? "      says: " : "    - says: ", stdout);
            put_quoted(g, p->says);
            if (p->report) puts("      report: |");
            if (p->report) put_lines(p->report, "        ");
        }
        puts("  ...");
    } else if (s->n_problems) {
        printf("FAILED  %s (%s)\n", s->name, text_shown(a, s->file));
        for (int i = 0; i < s->n_problems; i++) {
            const struct golden_problem *p = &s->problems[i];
            printf("    %s%s%s\n", text_shown(a, p->file), *p->file ? ": " : "", text_shown(a, p->says));
            if (p->report) put_lines(p->report, "        ");
        }
    } else if (!g->quiet) {
        printf("ok      %s%s%s%s\n", s->name, s->note ? " (within its tolerances: " : "", s->note ? s->note : "",
               s->note ? ")" : "");
    }
    fflush(stdout);
}

static const char stray_says[] = "is kept, and no scene of the list makes it: remove it, or list its scene";

void golden_report_strays(const struct golden *g, const char *const *strays, int number)
{
    if (g->tap) {
        printf("%sok %d - nothing else is kept\n", *strays ? "not " : "", number);
        if (*strays) puts("  ---\n  severity: fail\n  strays:");
        for (const char *const *p = strays; *p; p++) {
            fputs("    - ", stdout);
            put_quoted(g, *p);
        }
        if (*strays) puts("  ...");
        return;
    }
    for (; *strays; strays++)
        printf("FAILED  %s: %s\n", text_shown(g->call->arena, *strays), stray_says);
}

/* Text in XML, whose lines stay lines. */
static void put_xml(const struct golden *g, const char *text, FILE *f)
{
    for (const char *p = text, *end; *p; p = end + (*end != '\0')) {
        end = p + strcspn(p, "\n");
        const char *line = arena_format(g->call->arena, "%.*s", (int)(end - p), p);
        fprintf(f, "%s%s", text_html(g->call->arena, text_shown(g->call->arena, line)), *end ? "\n" : "");
    }
}

static void put_case(const struct golden *g, const char *name, const char *file, FILE *f)
{
    fputs("<testcase classname=\"rasp.golden\" name=\"", f);
    put_xml(g, name, f);
    if (file) fputs("\" file=\"", f);
    put_xml(g, file ? file : "", f);
    fputs("\">\n", f);
}

static void put_failure(const struct golden *g, const char *what, const char *file, const char *says,
                        const char *report, FILE *f)
{
    fprintf(f, "<%s message=\"", what);
    put_xml(g, arena_format(g->call->arena, "%s%s%s", file, *file ? ": " : "", says), f);
    fputs("\">", f);
    put_xml(g, report ? report : says, f);
    fprintf(f, "</%s>\n", what);
}

void golden_report_junit(const struct golden *g, const char *const *strays, FILE *f)
{
    int failures = strays && *strays, errors = 0;
    for (int i = 0; i < g->n; i++) {
        errors += g->scenes[i].failed.kind != ERR_NONE;
        failures += g->scenes[i].n_problems && !g->scenes[i].failed.kind;
    }
    fprintf(f,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
            "<testsuite name=\"rasp golden check\" tests=\"%d\" failures=\"%d\" errors=\"%d\" skipped=\"0\">\n",
            g->n + (strays != NULL), failures, errors);
    for (const struct golden_scene *s = g->scenes; s < g->scenes + g->n; s++) {
        put_case(g, s->name, s->file, f);
        for (const struct golden_problem *p = s->problems; p && p < s->problems + s->n_problems; p++)
            put_failure(g, s->failed.kind ? "error" : "failure", p->file, p->says, p->report, f);
        fputs("</testcase>\n", f);
    }
    if (strays) put_case(g, "nothing else is kept", NULL, f);
    for (const char *const *p = strays; p && *p; p++)
        put_failure(g, "failure", *p, stray_says, NULL, f);
    fputs(strays ? "</testcase>\n</testsuite>\n</testsuites>\n" MARK_TEXT : "</testsuite>\n</testsuites>\n" MARK_TEXT,
          f);
}

/* rasp golden: sounds and tables that are kept, and whether scenes still make them. */

static int run(struct cmd_call *c, int (*what)(struct golden *g, struct err *e), struct err *e)
{
    struct golden g = {.call = c,
                       .saved = args_value(&c->args, "kept"),
                       .hashes = args_value(&c->args, "hashes"),
                       .junit = args_value(&c->args, "junit"),
                       .effective = args_given(&c->args, "effective"),
                       .tap = args_given(&c->args, "tap"),
                       .quiet = args_given(&c->args, "quiet")};
    int code = 0;
    if ((g.saved && !*g.saved) || (g.hashes && !*g.hashes))
        err_set(e, ERR_USAGE, "--%s is empty", g.saved && !*g.saved ? "kept" : "hashes");
    else if (g.saved && !strcmp(g.saved, "-"))
        err_set(e, ERR_USAGE, "--kept -: what is kept is a folder of files; one of that name is ./-");
    if (!g.saved && !g.hashes) g.saved = "golden";
    if (g.saved) g.saved = batch_folder(c->arena, g.saved);
    if (!e->kind && batch_threads(c, &g.threads, e) && golden_list(&g, e) && golden_run_folder(&g, e))
        code = what(&g, e);
    golden_run_end(&g);
    for (int i = 0; i < g.n; i++)
        arena_close(g.scenes[i].arena);
    if (e->kind && g.tap) printf("Bail out! %s\n", text_shown(c->arena, e->text));
    return e->kind ? (int)e->kind : code;
}

static int check_run(struct cmd_call *c, struct err *e) { return run(c, golden_run_check, e); }
static int update_run(struct cmd_call *c, struct err *e) { return run(c, golden_run_update, e); }

static const struct action actions[] = {
    {"check",
     "LIST|SCENE.yaml...",
     1,
     -1,
     {"kept", "hashes", "output", "jobs", "effective", "tap", "junit", "force", "quiet", "snr", "lsb", "third-octave",
      "within", "tolerance", "column", "abs", "rel"},
     check_run},
    {"update", "LIST|SCENE.yaml...", 1, -1, {"kept", "hashes", "jobs", "force", "quiet"}, update_run},
    {NULL, NULL, 0, 0, {NULL}, NULL},
};

static const struct args_option options[] = {
    {"kept", 'k', "FOLDER", false,
     "where the files are kept, FOLDER/NAME/sound.wav and so on; default: golden, unless --hashes is given"},
    {"hashes", 0, "FILE", false,
     "keeps their SHA-256 in FILE, as sha256sum writes them; with --kept both, alone the hashes only"},
    {"output", 'o', "FOLDER", false,
     "check: what was rendered of a scene that fails stays there, to be listened to; beside a sound a picture shows "
     "the "
     "spectrograms of what is kept, of what was made, and of their difference"},
    {"jobs", 'j', "N", false, "how many scenes are rendered at once, 1 to 256; default: one for each core"},
    {"effective", 0, NULL, false, "check: renders each scene's effective scene, too, which has to make the same"},
    {"tap", 0, NULL, false, "check: prints the Test Anything Protocol, version 13"},
    {"junit", 0, "FILE", false, "check: also writes the verdicts to FILE as JUnit's XML, which CI systems read"},
    COMPARE_SOUND_LIMITS,
    COMPARE_TABLE_LIMITS,
    {"force", 'f', NULL, false,
     "replaces files that rasp did not write (of update those in FOLDER, of check that of --junit), and writes through "
     "symbolic links"},
    {"quiet", 'q', NULL, false, "prints only what fails"},
    {0}};

const struct command golden_command = {
    .name = "golden",
    .summary = "keep what scenes make, and check that they still do",
    .does = "The action update renders every scene of LIST, then every scene again, and keeps the sounds and tables. "
            "Where the two renders of one have not the same bytes, nothing is written and the exit code is 1. The "
            "action check renders every scene and compares with what is kept: the same bytes, or within limits (as of "
            "rasp compare) that the command or a line of the list gives. Of a file that is not, rasp compare's report "
            "says how far it is off.\n"
            "LIST is a text file, one scene a line, with its own options behind it: limits, --set KEY=VALUE, --seed, "
            "and --name for a scene that stands there twice. A # begins a comment. Names of files start at the list's "
            "folder. An operand that ends in .yaml is a scene itself. What is kept is called by the scene's name "
            "without .yaml.\n"
            "A check fails where nothing is kept of a scene (and says what makes it), where a kept file is not made "
            "any more, and where a list is empty. When all operands are lists, it also fails where something is kept "
            "that no scene of theirs makes. With --kept and --hashes, the kept files must have the kept hashes.\n"
            "The exit code is 0 when all is as kept and 1 when it is not. Where a scene could not be rendered it is "
            "that render's own; the others are checked all the same.",
    .operands = "ACTION LIST|SCENE.yaml...",
    .least = 1,
    .most = -1,
    .options = options,
    .actions = actions,
    .examples = "rasp golden update scenes/strike.yaml\n"
                "rasp golden check scenes/strike.yaml\n"
                "printf 'strike.yaml\\nforces_only.yaml --rel 1e-9  # a table\\n' > scenes/list.txt\n"
                "rasp golden update scenes/list.txt --kept out/golden\n"
                "rasp golden check --tap scenes/list.txt --kept out/golden\n"
                "rasp golden update scenes/strike.yaml --hashes golden.sha256   # a line a file; nothing else is kept\n"
                "rasp golden check scenes/strike.yaml --hashes golden.sha256\n",
};
