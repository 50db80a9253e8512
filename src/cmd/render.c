/* rasp render: scenes into sounds. With --verify compared is what was computed, before its level is set and its samples
 * are rounded to the file's encoding. */
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file_cache.h"
#include "base/interrupt.h"
#include "base/outfile.h"
#include "base/relpath.h"
#include "base/text.h"
#include "batch/pool.h"
#include "cmd/accuracy.h"
#include "cmd/cmd.h"
#include "cmd/message.h"
#include "file/json_value.h"
#include "file/wav.h"
#include "output/sound.h"
#include "pipeline/outputs.h"
#include "pipeline/plan.h"
#include "pipeline/render.h"
#include "scene/accuracy.h"
#include "scene/keys.h"
#include "scene/scene_places.h"

enum { REFERENCE, OWN };

/* ------------------------------------------------------------------ the reference

   The preset reference, but of every knob at least twice as fine as what is verified, so that no more than a fraction
   of its error (2^-order of it) is left out of what is measured. Where that is beyond the knob's range, or a stage
   refuses it (memory), the reference is as fine as it may be, and the knob is reported. Ramps of one sample are as fine
   as they go. */

static bool steps(int knob) { return keys_knobs[knob].scale == KEY_STEPS; }

/* What of the reference is raised and refused (heights that take too much memory) is had one and a half times as fine
   as what is verified, or as fine, never coarser than the preset has it: one knob after another, until the reference is
   rendered. */
static bool measure(struct accuracy_sweep *s, unsigned raised, struct err *e)
{
    struct accuracy_render *r = &s->renders[REFERENCE];
    struct accuracy preset = r->set;
    if (!accuracy_child_folder(s, e)) return false;
    accuracy_preset(&preset, "reference");
    s->reference = -1; /* that a reference is refused would be an error */
    bool ok = accuracy_child(s, REFERENCE, e);
    for (int i = 0; ok && r->code != 0 && i < 2 * KNOBS; i++) {
        enum knob k = (enum knob)(i / 2);
        double own = accuracy_knob(&s->renders[OWN].set, k), least = accuracy_knob(&preset, k);
        if (!(raised & 1u << k) || (!steps(k) && i % 2 == 0)) continue;
        accuracy_turn(&r->set, k, steps(k) ? fmax(i % 2 ? own : floor(1.5 * own), least) : fmin(own, least));
        ok = accuracy_child(s, REFERENCE, e);
    }
    s->reference = REFERENCE;
    for (int i = 0; ok && i < s->n_renders; i++) {
        r = &s->renders[i];
        ok = (i == REFERENCE || accuracy_child(s, i, e)) &&
             (r->code == 0 || err_set(e, (enum err_kind)r->code, "%s", r->words)) && accuracy_child_compare(s, i, e);
    }
    accuracy_child_end(s);
    return ok;
}

/* The summary once more, with what was measured. */
static bool summary_again(struct render_report *r, double measured, struct arena *a, struct err *e)
{
    json_t *whole = json_loads(r->summary, 0, NULL), *accuracy = json_object_get(whole, "accuracy");
    struct outfile file = {.fd = -1};
    const char *path = NULL;
    if (!accuracy) json_object_set_new(whole, "accuracy", accuracy = json_object());
    json_value_set(accuracy, "measured_db:n", measured);
    char *text = json_dumps(whole, JSON_INDENT(2) | JSON_REAL_PRECISION(9) | JSON_ENSURE_ASCII);
    r->summary = arena_format(a, "%s\n", text ? text : "{}");
    free(text);
    json_decref(whole);
    for (int i = 0; i < r->n_files; i++)
        path = strcmp(r->files[i].kind, "summary") ? path : r->files[i].path;
    bool ok = outfile_open(&file, path, e);
    if (ok) fputs(r->summary, file.stream);
    ok = ok && outfile_finalise(&file, e) && outfile_commit(&file, e);
    outfile_drop(&file);
    return ok;
}

/* Renders the scene twice more, each in a process of its own and as doubles: with the knobs that it was rendered with,
   and with the reference's (preset reference, or twice as fine as those); adds a note and, in the summary on disk and
   in the report, accuracy.measured_db: their difference over the reference, rms, in dB. The note says of which knobs
   there is nothing twice as fine, so that their error is not or not wholly in it. ERR_DIFFERS: it is more than
   accuracy.error; the files stay. Else as renders. */
static bool render_verify(struct cmd_call *c, const char *file, const struct scene *asked, struct render_report *r,
                          struct err *e)
{
    struct accuracy_sweep s = {.call = c,
                               .file = file,
                               .scene = *asked,
                               .until = INFINITY,
                               .near = -1,
                               .n_renders = 2,
                               .reference = REFERENCE};
    s.renders = ARENA_TAKE(c->arena, struct accuracy_render, 2);
    s.force = accuracy_silent(asked);
    unsigned used, raised = 0; /* sets of knobs; raised: those finer than the preset has them */
    s.scene.accuracy = r->accuracy;
    if (!plan_scene_knobs(&s.scene, c->arena, &used, e)) return false;
    struct accuracy preset = r->accuracy, reference;
    accuracy_preset(&preset, "reference");
    accuracy_finer(memcpy(&reference, &preset, sizeof preset), &r->accuracy, used);
    for (int k = 0; k < KNOBS; k++)
        raised |= accuracy_knob(&reference, (enum knob)k) != accuracy_knob(&preset, (enum knob)k) ? 1u << k : 0;
    s.renders[REFERENCE] = (struct accuracy_render){.set = reference, .contact_share = NAN};
    s.renders[OWN] = (struct accuracy_render){.set = r->accuracy, .contact_share = NAN};
    if (!measure(&s, raised, e)) return false;
    double measured = -s.renders[OWN].error.snr;
    if (!summary_again(r, measured, c->arena, e)) return false;
    /* Of which knobs there is nothing twice as fine: "" or what is reported. */
    const char *text = "";
    for (int k = 0; k < KNOBS; k++) {
        double own = accuracy_knob(&s.renders[OWN].set, (enum knob)k),
               than = accuracy_knob(&s.renders[REFERENCE].set, (enum knob)k);
        if (used & 1u << k && !(steps(k) ? than >= 2 * own : own <= 1 || than <= own / 2))
            text = arena_format(c->arena, "%s; %s of %s %.6g, as the reference has no finer than %.6g", text,
                                than == own ? "nothing" : "less than all", keys_knobs[k].name, own, than);
    }
    r->notes =
        memcpy(ARENA_TAKE(c->arena, const char *, r->n_notes + 1), r->notes, (size_t)r->n_notes * sizeof *r->notes);
    r->notes[r->n_notes++] =
        isfinite(measured)
            ? arena_format(c->arena, "accuracy: %.1f dB measured, against the reference%s%s", measured, text,
                           r->error_budget.diverges ? "; two renders of a ball that bounces part: what can be compared "
                                                      "are statistics (rasp accuracy)"
                                                    : "")
            : arena_format(c->arena, "accuracy: measured: the same bits as the reference%s", text);
    return isnan(asked->accuracy.error) || measured <= asked->accuracy.error || err_about(e, NULL, "accuracy.error") ||
           err_set(e, ERR_DIFFERS,
                   "accuracy.error: %.6g dB is not kept: %.1f dB measured against the reference; the files stay as "
                   "they are: ask for less (accuracy.error: %.0f dB), or say the knobs",
                   asked->accuracy.error, measured, ceil(measured)) ||
           scene_places_report(asked, e);
}

static const struct args_option render_options[] = {
    {"output", 'o', "FILE|FOLDER/", false,
     "where to write: NAME.wav, or NAME.flac, for one scene, a folder (ending in /), or -, the sound alone to standard "
     "output; "
     "default: the current folder"},
    CMD_SCENE_OPTIONS,
    {"json", 0, NULL, false,
     "print the summary (level, cost per stage, real-time factor) on stdout as JSON; of several scenes, an array"},
    {"verify", 0, NULL, false,
     "render the reference, too, and measure what accuracy was kept; exit code 1 if that is less than accuracy.error "
     "asks for"},
    {"traps", 0, NULL, false,
     "stop at the first invalid operation (0/0, a division by 0, an overflow) of a stage, and name it, also where it "
     "comes to nothing in the sound"},
    {"force", 'f', NULL, false, "replaces files that rasp did not write, and writes through symbolic links"},
    {"jobs", 'j', "N", false, "how many scenes are rendered at once, 1 to 256; default: 1"},
    {"keep-going", 'k', NULL, false,
     "render the others where one fails, whose error is reported; the exit code is that of the first that failed"},
    {"quiet", 'q', NULL, false, "print only warnings and errors"},
    {0},
};

static const char *render_base(struct cmd_call *c, const char *file, struct err *e)
{
    const char *o = args_value(&c->args, "output"), *stem = basename(file);
    static const char *const endings[] = {".yaml", ".yml", ".scene"};
    for (int k = 0; k < 3; k++) /* NAME of .../NAME.yaml, NAME.yml or NAME.scene.yaml */
        if (text_ends(stem, endings[k])) stem = relpath_stem(stem, c->arena);
    size_t n = o ? strlen(o) : 0;
    struct stat st;
    if (!o) return stem;
    if (n == 0) return err_set(e, ERR_USAGE, "--output is empty"), NULL;
    if (o[n - 1] == '/' || (stat(o, &st) == 0 && S_ISDIR(st.st_mode)))
        return arena_format(c->arena, "%s%s%s", o, o[n - 1] == '/' ? "" : "/", stem);
    if (c->args.n_operands > 1)
        return err_set(e, ERR_USAGE, "--output %s: for several scenes it must be a folder that exists, or end in /", o),
               NULL;
    if (!wav_is_name(o) || *basename(o) == '.')
        return err_set(e, ERR_USAGE,
                       "--output %s: must end in .wav or .flac (the other files are named after it) or in / (a folder)",
                       o),
               NULL;
    return relpath_base(o, c->arena);
}

/* NAME.flac asks for a FLAC of as many bits. */
static bool encoding_of_name(const char *o, int *encoding, struct err *e)
{
    const char *ending = sound_ending(*encoding);
    if (!o || !wav_is_name(o) || text_ends(o, ending)) return true;
    if (*encoding == ENCODING_PCM16 || *encoding == ENCODING_PCM24) {
        *encoding = *encoding == ENCODING_PCM16 ? ENCODING_FLAC16 : ENCODING_FLAC24;
        return true;
    }
    return err_set(
        e, ERR_USAGE, "--output %s: output.encoding is %s, which is written as NAME%s: --set output.encoding=%s", o,
        keys_find("output.encoding")->choices[*encoding].word, ending, text_ends(o, ".wav") ? "pcm24" : "flac24");
}

/* With --keep-going: how many scenes failed, and the kind of the first's error, which is the exit code. */
struct failures {
    int n;
    enum err_kind first;
};

/* One scene's error, where the others go on: it is reported at once. */
static void render_failed(struct cmd_call *c, struct failures *failures, struct err *e)
{
    message_error(c, "render", e);
    if (failures->n++ == 0) failures->first = e->kind;
    *e = (struct err){0};
}

/* All scenes, and what each would write; nothing is written yet. With --keep-going those that are none are reported and
   left out. */
static struct outputs *render_read(struct cmd_call *c, struct file_cache *file_cache, int *n_read,
                                   struct failures *failures, struct err *e)
{
    int n = 0;
    struct scene *scenes = ARENA_TAKE(c->arena, struct scene, c->args.n_operands);
    struct outputs *all = ARENA_TAKE(c->arena, struct outputs, c->args.n_operands);
    for (int i = 0; i < c->args.n_operands; i++) {
        const char *file = c->args.operands[i], *base = render_base(c, file, e);
        if (!base) return NULL;
        if (!cmd_read_scene(c, file, &scenes[n], e)) {
            if (!args_given(&c->args, "keep-going") || e->kind == ERR_INTERRUPTED) return NULL;
            render_failed(c, failures, e);
            continue;
        }
        scenes[n].file_cache = file_cache;
        if (!encoding_of_name(args_value(&c->args, "output"), &scenes[n].output.encoding, e)) return NULL;
        all[n] = outputs_make(&scenes[n], base, c->arena);
        n++;
    }
    *n_read = n;
    if (!outputs_distinct(all, n, c->arena, e) || !outputs_check_overwrite(all, n, c->arena, e) ||
        !outputs_replace(all, n, args_given(&c->args, "force"), c->arena, e))
        return NULL;
    /* The folder of -o FOLDER/ is created when it is not there; its parent must be. */
    const char *o = args_value(&c->args, "output");
    struct stat st;
    if (o && text_ends(o, "/") && stat(o, &st) != 0 && mkdir(o, 0777) != 0)
        return err_set(e, ERR_CREATE, "the folder %s cannot be created: is its parent there, and writable?", o), NULL;
    return all;
}

/* ------------------------------------------------------------------ a sound that is not kept */

const char *render_scratch(struct cmd_call *c, const char *file, const char **folder, struct err *e)
{
    struct scene *s = ARENA_TAKE(c->arena, struct scene, 1);
    struct render_report report;
    *folder = outfile_scratch_make_folder("rasp-sound", c->arena, e);
    if (!*folder || !cmd_read_scene(c, file, s, e)) return NULL;
    s->output.diagnostics.given = false;
    s->output.stems = NULL;
    s->output.impacts = LISTING_NONE;
    if (sound_bits(s->output.encoding) > 0) /* a WAV for whoever plays it, of a FLAC, too */
        s->output.encoding = sound_bits(s->output.encoding) == 16 ? ENCODING_PCM16 : ENCODING_PCM24;
    if (!render_scene(s, arena_format(c->arena, "%s/sound", *folder), c->arena, &report, e)) {
        scene_places_report(s, e);
        return NULL;
    }
    for (int k = 0; k < report.n_warnings; k++)
        message_warning(c, s->file, report.warnings[k]);
    for (int k = 0; k < report.n_files; k++)
        if (text_ends(report.files[k].path, ".wav")) return report.files[k].path;
    return err_set(e, ERR_SCENE,
                   "%s makes no sound: give surface.response or surface.object, or set output.quantity to force", file),
           NULL;
}

void render_scratch_end(const char *folder, struct arena *a)
{
    static const char *const files[] = {"sound.wav", "sound.scene.yaml", "sound.json"};
    if (!folder) return;
    for (int i = 0; i < 3; i++)
        unlink(arena_format(a, "%s/%s", folder, files[i]));
    rmdir(folder);
    interrupt_forget(folder);
}

/* -o -: the sound to standard output. */
static int render_stream(struct cmd_call *c, struct err *e)
{
    const char *folder = NULL, *sound;
    char some[1 << 16];
    size_t n;
    for (int i = 0; i < 2; i++) {
        const char *without = i ? "verify" : "json";
        if (args_given(&c->args, without))
            return err_set(e, ERR_USAGE, "--%s and --output - exclude each other", without), 0;
    }
    if (c->args.n_operands > 1) return err_set(e, ERR_USAGE, "--output - takes one scene"), 0;
    if (isatty(STDOUT_FILENO))
        return err_set(e, ERR_USAGE,
                       "--output - writes a WAV, and standard output is a terminal: send it to a program or a file"),
               0;
    FILE *f = (sound = render_scratch(c, c->args.operands[0], &folder, e)) ? fopen(sound, "rb") : NULL;
    if (sound && !f) err_set(e, ERR_IO, "%s cannot be read again", sound);
    while (f && (n = fread(some, 1, sizeof some, f)) > 0 && fwrite(some, 1, n, stdout) == n)
        ;
    if (f) fclose(f);
    render_scratch_end(folder, c->arena);
    return (int)e->kind;
}

/* ------------------------------------------------------------------ the command */

/* Scenes rendered by several threads, each with an arena of its own, and reported in order. */
struct render_job {
    struct arena *arena;
    struct render_report report;
    struct err error;
};

struct render_all {
    struct cmd_call *call;
    const struct outputs *outputs;
    struct render_job *jobs;
    int done; /* summaries that are printed */
    struct failures failures;
    struct err ends; /* what ends the run */
};

static bool job(void *all, int i)
{
    struct render_all *r = all;
    struct render_job *j = &r->jobs[i];
    j->arena = arena_open();
    return render_scene(r->outputs[i].scene, r->outputs[i].base, j->arena, &j->report, &j->error) ||
           args_given(&r->call->args, "keep-going");
}

static void took(void *all, int i)
{
    struct render_all *r = all;
    struct render_job *j = &r->jobs[i];
    struct render_report *report = &j->report;
    const struct args *args = &r->call->args;
    const struct outputs *o = &r->outputs[i];
    struct err *e = &j->error;
    bool ok = !e->kind || scene_places_report(o->scene, e), json = args_given(args, "json"),
         stopped = r->ends.kind != ERR_NONE;
    if (stopped || !j->arena) return;
    if (ok) {
        ok = !args_given(args, "verify") || render_verify(r->call, o->scene->file, o->scene, report, e);
        fputs(!json || args->n_operands == 1 ? "" : r->done++ ? "," : "[", stdout); /* several are one array */
        for (int k = 0; k < report->n_warnings; k++)
            message_warning(r->call, o->scene->file, arena_text(r->call->arena, report->warnings[k]));
        if (json) fputs(report->summary, stdout);
        double seconds = (double)report->frames / o->scene->output.sample_rate;
        bool words = !json && !args_given(args, "quiet");
        for (int k = 0; words && k < report->n_files; k++)
            if (strcmp(report->files[k].kind, "scene") != 0 && strcmp(report->files[k].kind, "summary") != 0)
                printf("%s  %.3f s, %.3g times real time\n", text_shown(j->arena, report->files[k].path), seconds,
                       seconds / (report->cpu > 1e-9 ? report->cpu : 1e-9));
        for (int k = 0; words && k < report->n_notes; k++)
            printf("%s\n", text_shown(j->arena, report->notes[k]));
    }
    if (!ok && args_given(args, "keep-going") && e->kind != ERR_INTERRUPTED)
        render_failed(r->call, &r->failures, e);
    else if (!ok)
        r->ends = *e;
    arena_close(j->arena);
}

static int render_run(struct cmd_call *c, struct err *e)
{
    int n = 0;
    long threads = 1;
    const char *to = args_value(&c->args, "output");
    if (to && !strcmp(to, "-")) return render_stream(c, e);
    if (!args_whole(&c->args, "jobs", (const long[2]){1, 256}, &threads, e)) return 0;
    if (c->args.n_operands > 1) message_group(c);
    if (args_given(&c->args, "traps")) run_traps();
    struct file_cache *file_cache = file_cache_open(FILE_CACHE_MOST);
    struct render_all all = {.call = c};
    all.outputs = render_read(c, file_cache, &n, &all.failures, e);
    all.jobs = ARENA_TAKE(c->arena, struct render_job, n + 1);
    if (all.outputs)
        pool_run(&(struct pool_work){.n = n, .threads = (int)threads, .context = &all, .job = job, .took = took});
    if (all.done) puts("]");
    file_cache_close(file_cache);
    if (!e->kind && all.ends.kind) *e = all.ends;
    if (!e->kind && all.failures.n)
        err_set(e, all.failures.first, "%d of %d scenes failed", all.failures.n, c->args.n_operands);
    return (int)e->kind;
}

const struct command render_command = {
    .name = "render",
    .group = "Sound from scenes",
    .summary = "renders scenes into sound files",
    .does = "For NAME.yaml this writes NAME.wav, if anything rings, and NAME.scene.yaml, the effective scene, whose "
            "render gives the same bytes. NAME.json has the level, the cost per stage, the real-time factor and which "
            "files were written. NAME.csv or NAME.npy is there if the scene asks for diagnostics, NAME.impacts.csv if "
            "it asks for the series of impacts.\n"
            "Nothing half-written is ever left behind. An output that would replace a file that one of the scenes "
            "reads is refused, whatever the names are. So are two scenes that would write the same file. An effective "
            "scene may be rendered onto itself: its bytes stay the same. What an earlier render wrote is replaced. "
            "Another file, or a symbolic link, is only with --force: rasp(1), FILES. A NAME.csv or NAME.wav of an "
            "earlier render that this one does not replace stays, with a warning.\n"
            "A file whose samples are all 0 is warned of, and so is each silent channel of several. Samples beyond "
            "full scale, which integers refuse and floating point holds, are warned of, too: how many they are and "
            "how far beyond.\n"
            "Where the scene asks for an error (accuracy.error), the knobs that it leaves unsaid are chosen as the "
            "cheapest that keep it. What cannot be kept is refused.\n"
            "Several scenes are all read before the first is rendered. The first that fails ends the run, unless "
            "--keep-going is given.",
    .operands = "SCENE...",
    .least = 1,
    .most = -1,
    .options = render_options,
    .examples = "rasp render scenes/basswood_scrape.yaml\n"
                "rasp render scenes/basswood_scrape.yaml -o fast.wav --set 'motion.rate=4 Hz'\n"
                "rasp render scenes/strike.yaml --set 'accuracy.error=-60 dB' --verify\n"
                "rasp render scenes/*.yaml -o out/ --set accuracy=draft\n"
                "rasp new wood_on_sandpaper | rasp render /dev/stdin -o - > sandpaper.wav\n",
    .run = render_run,
};
