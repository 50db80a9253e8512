/* rasp accuracy: what accuracy costs in time. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/outfile.h"
#include "cmd/accuracy.h"
#include "output/mark.h"
#include "output/picture.h"
#include "pipeline/outputs.h"
#include "pipeline/plan_scene.h"
#include "pipeline/promise.h"
#include "scene/rules.h"
#include "scene/scene_places.h"

static const struct args_option accuracy_options[] = {
    {"presets", 'p', NULL, false, "render only the presets (and the scene as it is), no single knobs"},
    {"values", 0, "KNOB=N,N...", true, "further values of a knob besides those of the presets, as in oversampling=2,16; may be repeated"},
    {"runs", 'n', "N", false, "how often each setting is rendered for its CPU time, in turns; the least counts (3)"},
    {"csv", 0, "FILE", false, "write the table to FILE, which ends in .csv"},
    {"plot", 0, "FILE", false, "draw error against real-time factor into FILE, which ends in .png or .svg"},
    {"json", 0, NULL, false, "print the table as JSON"},
    {"force", 'f', NULL, false, "replaces the files of --csv and --plot if they exist"},
    CMD_SCENE_OPTIONS,
    {0},
};

static bool ends(const char *text, const char *ending)
{
    size_t n = strlen(text), m = strlen(ending);
    return n > m && strcmp(text + n - m, ending) == 0;
}

/* ------------------------------------------------------------------ asking */

static bool ask_read(struct accuracy_sweep *s, struct err *e)
{
    const struct args *g = &s->call->args;
    long runs = 3;
    if (!args_whole(g, "runs", (const long[2]){1, 1000}, &runs, e))
        return false;
    s->runs = (int)runs;
    s->json = args_given(g, "json");
    s->presets = args_given(g, "presets");
    if (s->presets && args_given(g, "values"))
        return err_set(e, ERR_USAGE, "--presets leaves no room for --values");
    s->csv = args_value(g, "csv");
    s->plot = args_value(g, "plot");
    if (s->csv && !ends(s->csv, ".csv"))
        return err_set(e, ERR_USAGE, "--csv %s: must end in .csv", s->csv);
    return !s->plot || ends(s->plot, ".png") || ends(s->plot, ".svg") || err_set(e, ERR_USAGE, "--plot %s: must end in .png or .svg", s->plot);
}

bool accuracy_silent(const struct scene *s)
{
    for (int i = 0; i < s->n_contacts; i++)
        if (s->contacts[i].gain != 0 && rules_heard(&s->contacts[i], &s->output))
            return false;
    return true;
}

/* What is written must not be what is read; and can it be written? */
static bool ask_files(const struct accuracy_sweep *s, struct err *e)
{
    const char *paths[] = {s->csv, s->plot};
    for (int i = 0; i < 2; i++) {
        enum output_kind kind = OUTPUT_TABLE;
        struct outputs o = {.scene = &s->scene, .base = "", .paths = &paths[i], .kinds = &kind, .n = 1};
        struct outfile probe;
        if (!paths[i])
            continue;
        if (!outputs_spare(&o, 1, s->call->arena, &(struct err){0}))
            return err_set(e, ERR_CREATE, "%s is a file that the scene reads: give --%s another name", paths[i], i ? "plot" : "csv");
        bool force = args_given(&s->call->args, "force");
        bool may = i ? mark_permits(paths[i], NULL, force, e) : mark_absent(paths[i], force, e);
        if (!may || !outfile_open_fd(&probe, paths[i], e))
            return false;
        outfile_drop(&probe);
    }
    return true;
}

static bool ask_scene(struct accuracy_sweep *s, struct err *e)
{
    struct accuracy_values own[KNOBS] = {{0}};
    if (!accuracy_values(&s->call->args, s->call->arena, own, e) || !cmd_read_scene(s->call, s->file, &s->scene, e))
        return false;
    struct scene asked = s->scene;
    if (!promise_keep(&asked, s->call->arena, &s->scene, NULL, e))
        return scene_places_tell(&asked, e);
    s->scene.contacts = asked.contacts; /* engines are chosen for each setting */
    s->force = accuracy_silent(&s->scene);
    if (s->force)
        s->scene.output.quantity = QUANTITY_FORCE;
    if (!ask_files(s, e))
        return false;
    if (!plan_scene_knobs(&s->scene, s->call->arena, &s->knobs, e))
        return scene_places_tell(&s->scene, e);
    accuracy_rows(s, own);
    return true;
}

/* ------------------------------------------------------------------ doing */

static void told(const struct accuracy_sweep *s, int done, int all)
{
    if (isatty(STDERR_FILENO))
        fprintf(stderr, done < all ? "\r%s: render %d of %d " : "\r\033[K", s->file, done + 1, all);
}

/* How many renders there will be: each once, those whose cost counts again and again. */
static int renders_in_all(const struct accuracy_sweep *s)
{
    int timed = 0;
    for (int i = 0; i < s->n_renders; i++)
        timed += s->renders[i].timed;
    return s->n_renders + (s->runs - 1) * timed;
}

/* Runs of one setting lie apart, so that what slows the machine for a while slows one run of each. */
static bool sweep(struct accuracy_sweep *s, struct err *e)
{
    int all = renders_in_all(s), done = 0;
    bool ok = true;
    for (int run = 0; ok && run < s->runs; run++)
        for (int i = 0; ok && i < s->n_renders; i++) {
            struct accuracy_render *r = &s->renders[i];
            if (run > 0 && (!r->timed || r->code != 0))
                continue;
            told(s, done++, all);
            ok = accuracy_child(s, i, e) && (run > 0 || r->code != 0 || accuracy_compare(s, i, e));
            accuracy_child_clear(s);
        }
    told(s, all, all);
    return ok;
}

/* All that can fail is done before the first file gets its name. */
static bool tell(struct accuracy_sweep *s, struct err *e)
{
    struct outfile csv = {.fd = -1}, plot = {.fd = -1};
    bool ok = !s->csv || outfile_open(&csv, s->csv, e);
    if (ok && s->csv) {
        accuracy_table(s, csv.stream);
        ok = outfile_settle(&csv, e);
    }
    ok = ok && (!s->plot || picture_draw(&plot, s->plot, ends(s->plot, ".svg"), accuracy_plot, s, e));
    interrupt_hold();
    ok = ok && (!s->plot || outfile_commit(&plot, e)) && (!s->csv || outfile_commit(&csv, e));
    interrupt_go();
    outfile_drop(&csv);
    outfile_drop(&plot);
    if (ok && !s->json)
        accuracy_print(s);
    return ok && (!s->json || accuracy_json(s, e));
}

static int accuracy_run(struct cmd_call *c, struct err *e)
{
    struct accuracy_sweep s = {.call = c, .file = c->args.operands[0], .until = INFINITY};
    if (!ask_read(&s, e) || !ask_scene(&s, e) || !accuracy_child_folder(&s, e))
        return (int)e->kind;
    bool ok = sweep(&s, e);
    accuracy_child_end(&s);
    if (ok) {
        accuracy_judge(&s);
        tell(&s, e);
    }
    return (int)e->kind;
}

const struct command accuracy_command = {
    .name = "accuracy",
    .summary = "shows what accuracy costs: error and time of each preset and knob",
    .does = "Renders the scene with each preset, and with each value that a preset has of each knob that turns it (rasp plan lists them), and prints how far each is from the "
            "preset reference: the samples' error in dB, the worst difference of third octaves, the distance of spectra (windows of 5, 20 and 80 ms); and what it costs: CPU time, times "
            "real time, peak memory. alone: all other knobs at reference, so that the knob's own error shows; order: the power of the knob with which that falls (of a knob in dB, dB per dB); "
            "total: all other knobs as the scene has them. The error that reference has itself is extrapolated from that, and smaller ones are marked. * marks what nothing else beats in both "
            "error and CPU time. Where two renders diverge, as of a ball that bounces, it says from when on, and compares levels and spectra of what comes after. A scene without a sound is "
            "compared by its contact force. Each render is a process of its own, one at a time, in a temporary folder.",
    .operands = "SCENE",
    .least = 1,
    .most = 1,
    .options = accuracy_options,
    .examples = "rasp accuracy scenes/strike.yaml\n"
                "rasp accuracy scenes/basswood_scrape.yaml --set 'motion.duration=0.5 s' --csv cost.csv --plot cost.png\n"
                "rasp accuracy scenes/strike.yaml --values oversampling=2,16 --runs 1 --json\n",
    .run = accuracy_run,
};
