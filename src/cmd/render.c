/* rasp render: scenes into sounds. */
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/text.h"
#include "cmd/cmd.h"
#include "cmd/render_verify.h"
#include "cmd/tell.h"
#include "pipeline/outputs.h"
#include "pipeline/render.h"
#include "scene/scene_places.h"

static const struct args_option render_options[] = {
    {"output", 'o', "FILE|FOLDER/", false, "where to write: NAME.wav for one scene, or a folder (ending in /); default: the current folder"},
    CMD_SCENE_OPTIONS,
    {"json", 0, NULL, false, "print the summary (level, cost per stage, real-time factor) on stdout as JSON; of several scenes, an array"},
    {"verify", 0, NULL, false, "render the reference, too, and measure what accuracy was kept; exit code 1 if that is less than accuracy.error asks for"},
    {"force", 'f', NULL, false, "replaces files that rasp did not write, and writes through symbolic links"},
    {"quiet", 'q', NULL, false, "print only warnings and errors"},
    {0},
};

/* NAME of .../NAME.yaml, NAME.yml or NAME.scene.yaml */
static char *scene_stem(struct arena *a, const char *file)
{
    static const char *const endings[] = {".yaml", ".yml", ".scene"};
    const char *slash = strrchr(file, '/');
    char *stem = arena_text(a, slash ? slash + 1 : file);
    for (int k = 0; k < 3; k++) {
        size_t n = strlen(stem), m = strlen(endings[k]);
        if (n > m && strcmp(stem + n - m, endings[k]) == 0)
            stem[n - m] = '\0';
    }
    return stem;
}

static const char *render_base(struct cmd_call *c, const char *file, struct err *e)
{
    const char *o = args_value(&c->args, "output"), *stem = scene_stem(c->arena, file);
    size_t n = o ? strlen(o) : 0;
    struct stat st;
    if (!o)
        return stem;
    if (n == 0)
        return err_set(e, ERR_USAGE, "--output is empty"), NULL;
    if (o[n - 1] == '/' || (stat(o, &st) == 0 && S_ISDIR(st.st_mode)))
        return arena_format(c->arena, "%s%s%s", o, o[n - 1] == '/' ? "" : "/", stem);
    if (c->args.n_operands > 1)
        return err_set(e, ERR_USAGE, "--output %s: for several scenes it must be a folder that exists, or end in /", o), NULL;
    if (n < 5 || strcmp(o + n - 4, ".wav") != 0 || o[n - 5] == '/')
        return err_set(e, ERR_USAGE, "--output %s: must end in .wav (the other files are named after it) or in / (a folder)", o), NULL;
    return arena_format(c->arena, "%.*s", (int)n - 4, o);
}

/* Creates the folder of -o FOLDER/ when it is not there; its parent must be. */
static bool render_folder(struct cmd_call *c, struct err *e)
{
    const char *o = args_value(&c->args, "output");
    struct stat st;
    if (!o || o[0] == '\0' || o[strlen(o) - 1] != '/' || stat(o, &st) == 0)
        return true;
    return mkdir(o, 0777) == 0 || err_set(e, ERR_CREATE, "the folder %s cannot be created: is its parent there, and writable?", o);
}

/* Several scenes' summaries are one array. */
static void render_print(struct cmd_call *c, const struct scene *s, const struct render_report *r)
{
    for (int i = 0; i < r->n_warnings; i++)
        tell_warning(c, s->file, r->warnings[i]);
    if (args_given(&c->args, "json"))
        fputs(r->summary, stdout);
    else if (!args_given(&c->args, "quiet")) {
        for (int i = 0; i < r->n_files; i++)
            if (strcmp(r->files[i].kind, "scene") != 0 && strcmp(r->files[i].kind, "summary") != 0)
                printf("%s  %.3f s, %.3g times real time\n", text_shown(c->arena, r->files[i].path), (double)r->frames / s->output.sample_rate,
                       (double)r->frames / s->output.sample_rate / (r->cpu > 1e-9 ? r->cpu : 1e-9));
        for (int i = 0; i < r->n_notes; i++)
            printf("%s\n", text_shown(c->arena, r->notes[i]));
    }
}

/* All scenes, and what each would write; nothing is written yet. */
static struct outputs *render_read(struct cmd_call *c, struct err *e)
{
    int n = c->args.n_operands;
    struct scene *scenes = ARENA_TAKE(c->arena, struct scene, n);
    struct outputs *all = ARENA_TAKE(c->arena, struct outputs, n);
    for (int i = 0; i < n; i++) {
        const char *file = c->args.operands[i], *base = render_base(c, file, e);
        if (!base || !cmd_read_scene(c, file, &scenes[i], e))
            return NULL;
        all[i] = outputs_make(&scenes[i], base, c->arena);
    }
    return outputs_distinct(all, n, c->arena, e) && outputs_spare(all, n, c->arena, e) &&
                   outputs_replace(all, n, args_given(&c->args, "force"), c->arena, e) && render_folder(c, e)
               ? all
               : NULL;
}

/* printed: how many scenes' summaries are. */
static bool render_one(struct cmd_call *c, int i, const struct outputs *o, bool array, int *printed, struct err *e)
{
    struct render_report report;
    if (!render_scene(o->scene, o->base, c->arena, &report, e))
        return scene_places_tell(o->scene, e);
    bool kept = !args_given(&c->args, "verify") || render_verify(c, c->args.operands[i], o->scene, &report, e);
    fputs(!array ? "" : (*printed)++ ? "," : "[", stdout);
    render_print(c, o->scene, &report);
    return kept;
}

static int render_run(struct cmd_call *c, struct err *e)
{
    int n = c->args.n_operands, done = 0;
    if (n > 1)
        tell_group(c);
    bool array = n > 1 && args_given(&c->args, "json");
    const struct outputs *all = render_read(c, e);
    bool ok = all != NULL;
    for (int i = 0; ok && i < n; i++)
        ok = render_one(c, i, &all[i], array, &done, e);
    if (array && done)
        puts("]");
    return (int)e->kind;
}

const struct command render_command = {
    .name = "render",
    .summary = "renders scenes into sound files",
    .does = "For NAME.yaml writes NAME.wav (if anything rings), NAME.csv or NAME.npy (if the scene asks for diagnostics), NAME.impacts.csv (if it asks for the series of "
            "impacts), NAME.scene.yaml (the effective scene: rendering it gives the same bytes) and NAME.json (level, cost per stage, real-time factor, which files were written). "
            "A file whose samples are all 0, for nothing was there or for it was rounded away, is warned of, and so is each silent channel of several; and so are samples beyond full scale, which "
            "floating point holds (integers refuse them), with how many they are and how far beyond: in words and in the summary (silent, samples_beyond_full_scale). "
            "Nothing half-written is ever left behind. An output that would replace a file that one of the scenes reads is refused, whatever "
            "the names are (an effective scene may be rendered onto itself: its bytes stay the same), and so are two scenes that would write "
            "the same file. What an earlier render wrote is replaced; another file, or a symbolic link, is only with --force: rasp(1), FILES. Where the scene asks for an error (accuracy.error), the knobs that it leaves unsaid are chosen as the cheapest that keep it, and told; what cannot be kept "
            "is refused. A NAME.csv or NAME.wav of an earlier render that this one does not replace stays, with a warning. Several scenes "
            "are all read before the first is rendered; the first that fails ends the run.",
    .operands = "SCENE...",
    .least = 1,
    .most = -1,
    .options = render_options,
    .examples = "rasp render scenes/basswood_scrape.yaml\n"
                "rasp render scenes/basswood_scrape.yaml -o fast.wav --set 'motion.rate=4 Hz'\n"
                "rasp render scenes/strike.yaml --set 'accuracy.error=-60 dB' --verify\n"
                "rasp render scenes/*.yaml -o out/ --set accuracy=draft\n",
    .run = render_run,
};
