/* rasp batch: a design into a set of stimuli. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/hash.h"
#include "batch/batch.h"
#include "batch/pool.h"
#include "cmd/cmd.h"
#include "cmd/message.h"
#include "cmd/report.h"
#include "file/json_value.h"
#include "scene/keys_yaml.h"

enum { FAULTS_SHOWN = 20 /* failures that are reported one by one */, STALE_NAMED = 6 /* files of earlier states */ };

static const struct args_option batch_options[] = {
    {"output", 'o', "FOLDER", false, "where the set goes; it is made if its parent is there"},
    {"jobs", 'j', "N", false, "how many stimuli are rendered at once, 1 to 256; default: one for each core"},
    {"shard", 0, "I/N", false,
     "render part I of N only (from 1/N to N/N); the same command without --shard makes the set of all parts"},
    {"no-render", 0, NULL, false,
     "render nothing: set the level and write the tables, or say what is missing (exit code 66)"},
    {"missing", 0, "N", false, "write nothing; of N shards print those that are not whole, as 3,17"},
    {"dry-run", 'n', NULL, false,
     "read and check everything, list the stimuli (with --json as \"list\"), with -o also what is there, write "
     "nothing"},
    {"force", 'f', NULL, false, "render what is there already, too"},
    {"replace", 0, NULL, false, "take over a folder that holds the set of another design"},
    {"prune", 0, NULL, false, "remove what was a stimulus of the set once, and is none of it as it is now"},
    {"json", 0, NULL, false, "print what was done on stdout as JSON"},
    {"quiet", 'q', NULL, false, "no progress and no summary, only warnings and errors"},
    {0},
};

const char *batch_folder(struct arena *a, const char *given)
{
    size_t n = strlen(given);
    while (n > 1 && given[n - 1] == '/')
        n--;
    return arena_format(a, "%.*s", (int)n, given);
}

int batch_cores(void)
{
    long n = sysconf(_SC_NPROCESSORS_ONLN);
    return (int)(n < 1 ? 1 : n > 256 ? 256 : n);
}

/* ------------------------------------------------------------------ what went wrong */

static void report_more(struct cmd_call *c, const char *command, enum err_kind kind, const char *text)
{
    struct err shown = {0};
    err_set(&shown, kind, "%s", text);
    message_error(c, command, &shown);
}

void batch_message_unread(struct cmd_call *c, const char *file, const struct batch_report *r, struct err *e)
{
    enum err_kind kind = e->kind;
    if (!*r->messages) return;
    message_scene(c, r->design.diag, r->messages, kind);
    *e = (struct err){0};
    err_set(e, kind, "%s %s", file, kind == ERR_SCENE ? "is not a valid design" : "cannot be read");
}

void batch_message_faults(struct cmd_call *c, const char *command, const char *file, const struct set_plan *p)
{
    for (int k = 0; k < p->n_faults && k < FAULTS_SHOWN; k++) {
        const struct set_fault *f = &p->faults[k];
        const char *whose = f->n > 1 ? arena_format(c->arena, "%s and %d more", f->name, f->n - 1) : f->name;
        struct err shown = {0};
        if (*f->messages) {
            message_scene(c, f->diag, f->messages, f->err->kind);
            err_set(&shown, f->err->kind, "%s: the scene of %s is not valid", file, whose);
        } else
            err_set(&shown, f->err->kind, "%s (%s)", f->err->text, whose);
        shown.place = *f->messages ? shown.place : f->err->place;
        message_error(c, command, &shown);
    }
    if (p->n_faults > FAULTS_SHOWN)
        report_more(c, command, p->faults[FAULTS_SHOWN].err->kind,
                    arena_format(c->arena, p->n_faults > SET_FAULTS ? "and many more errors" : "and %d more errors",
                                 p->n_faults - FAULTS_SHOWN));
}

void batch_message_warnings(struct cmd_call *c, const struct set_plan *p)
{
    for (int k = 0; k < p->n_warnings; k++)
        message_stimulus_warning(c, p->warnings[k].name, p->warnings[k].text);
}

/* Failures of single stimuli, each error once, and warnings of those that were rendered now. */
static void report_stimuli(struct cmd_call *c, const struct batch_ask *ask, const struct batch_report *r)
{
    int failed = 0;
    enum err_kind worst = ERR_NONE;
    for (int i = 0; i < r->set.n; i++) {
        const struct tables_row *o = &r->rows[i];
        const char *name = r->design.stimuli[i].name;
        struct err shown = {0};
        struct arena *a = arena_open();
        struct record record;
        if (o->there && o->made && record_read(ask->folder, name, a, &record))
            for (int k = 0; record.warnings[k]; k++)
                message_stimulus_warning(c, name, record.warnings[k]);
        arena_close(a);
        if (!o->kind) continue;
        err_set(&shown, o->kind, "%s", o->text);
        if (++failed <= FAULTS_SHOWN)
            message_stimulus(c, "batch", name, ask->design, &shown);
        else
            worst = o->kind > worst ? o->kind : worst;
    }
    if (worst) report_more(c, "batch", worst, arena_format(c->arena, "and %d more that failed", failed - FAULTS_SHOWN));
}

/* ------------------------------------------------------------------ what was done */

static bool report_json(const struct batch_ask *ask, const struct batch_report *b, struct err *e)
{
    struct report r = report_open(stdout, true);
    r.ascii = true;
    report_set(&r, "title:s design_sha256:s stimuli:i ok:i waiting:i full_scale:n failed:[", b->design.title,
               b->set.sha256, b->set.n, b->rendered + b->reused - b->waiting, b->waiting, b->full_scale);
    for (int i = 0; i < b->set.n; i++)
        if (b->rows[i].kind)
            report_set(&r, ":{ stimulus:s code:i error:v }", b->design.stimuli[i].name, (int)b->rows[i].kind,
                       b->rows[i].text);
    report_set(&r, "] folder:s shard:[ :i :i ] mine:i rendered:i kept:i left_over:[", ask->folder, ask->shard.i,
               ask->shard.n, b->n_mine, b->rendered, b->reused);
    for (int i = 0; i < b->stale.n_files; i++)
        report_set(&r, ":v", b->stale.files[i]);
    report_set(&r, "] pruned:i sound_s:n wav_bytes:l predicted_cpu_s:n wall_s:n", b->stale.removed, b->plan.seconds,
               (long)b->plan.bytes, b->plan.cycles / 3e9, b->seconds);
    if (b->missing) report_set(&r, "missing_shards:s", b->missing);
    if (ask->dry) report_set(&r, "list:[");
    for (int i = 0; ask->dry && i < b->set.n; i++) {
        const struct design *d = &b->design;
        const struct design_stimulus *s = &d->stimuli[i];
        char seed[24];
        if (b->mine && !b->mine[i]) continue;
        snprintf(seed, sizeof seed, "%" PRIu64, s->seed); /* as text: many readers of JSON have no 64 bits */
        report_set(&r, ":{ row:i name:s factors:{", i + 1, s->name);
        for (int f = 0; f < d->n_factors; f++)
            report_set(&r, "$:s", d->factors[f].name, s->level[f] < 0 ? NULL : design_label(d, i, f));
        report_set(&r, "}");
        if (d->samples) report_set(&r, "sample:i", s->sample);
        report_set(&r, "replicate:c seed:s recording:v length_s:n", s->recording ? -1L : (long)s->replicate,
                   s->recording ? NULL : seed, s->recording, b->set.lengths[i]);
        if (b->states) report_set(&r, "state:s", stimulus_states[b->states[i]]);
        report_set(&r, "}");
    }
    return report_close(&r, 17, e);
}

static void print_report(const struct batch_ask *ask, const struct batch_report *r, struct arena *a)
{
    char took[24];
    pool_progress_time(ask->dry ? r->plan.cycles / 3e9 : r->seconds, took);
    if (ask->dry) {
        const char **states = r->states ? ARENA_TAKE(a, const char *, r->set.n) : NULL,
                   *lengths = set_lengths_text(&r->set, &r->plan, a);
        for (int i = 0; states && i < r->set.n; i++)
            states[i] = stimulus_states[r->states[i]];
        design_print(&r->design, r->mine, states, stdout);
        printf("%d stimuli, %.4g s of sound, %.3g MB of WAVs; predicted CPU time at least %s (a core of 3 GHz)\n",
               r->set.n, r->plan.seconds, r->plan.bytes / 1e6, took);
        if (r->plan.raw_bytes > 0)
            printf("%.3g MB more while the common level is not known\n", r->plan.raw_bytes / 1e6);
        if (lengths) printf("%s\n", lengths);
    } else if (ask->shard.n > 1) {
        printf("%s: shard %d/%d: %d stimuli rendered, %d there already, %d failed, in %s; when all are there: the same "
               "command without --shard\n",
               ask->folder, ask->shard.i, ask->shard.n, r->rendered, r->reused, r->failed, took);
        return;
    } else {
        printf("%s: %d stimuli rendered, %d there already, %d %s, in %s", ask->folder, r->rendered, r->reused,
               r->failed, ask->no_render ? "missing" : "failed", took);
        if (r->stale.removed)
            printf("; %d file%s left over removed", r->stale.removed, r->stale.removed == 1 ? "" : "s");
        if (!isnan(r->full_scale)) printf("; full_scale %s", keys_yaml_number(r->full_scale, a));
        printf("\n");
    }
    if (!r->plan.n_sounds)
        printf("no stimulus makes a sound, only tables: what is touched or what scrapes needs a response, as in set: "
               "{surface.response: table.csv}\n");
    if (ask->shard.n > 1) printf("shard %d/%d: %d of them\n", ask->shard.i, ask->shard.n, r->n_mine);
}

/* ------------------------------------------------------------------ command */

bool batch_threads(const struct cmd_call *c, int *threads, struct err *e)
{
    long n = batch_cores();
    if (!args_whole(&c->args, "jobs", (const long[2]){1, 256}, &n, e)) return false;
    *threads = (int)n;
    return true;
}

static bool read_ask(struct cmd_call *c, struct batch_ask *ask, struct err *e)
{
    const char *folder = args_value(&c->args, "output"), *shard = args_value(&c->args, "shard");
    *ask = (struct batch_ask){.design = c->args.operands[0],
                              .shard = {1, 1},
                              .force = args_given(&c->args, "force"),
                              .dry = args_given(&c->args, "dry-run"),
                              .quiet = args_given(&c->args, "quiet"),
                              .replace = args_given(&c->args, "replace"),
                              .prune = args_given(&c->args, "prune"),
                              .no_render = args_given(&c->args, "no-render")};
    if (!ask->dry && (!folder || !*folder))
        return err_set(e, ERR_USAGE, "--output: a folder for the set is needed, as in -o out");
    if (folder && !strcmp(folder, "-"))
        return err_set(
            e, ERR_USAGE,
            "--output -: a set is a folder of files, and cannot go to standard output; a folder of that name is ./-");
    ask->folder = folder ? batch_folder(c->arena, folder) : NULL;
    if (shard && ask->prune)
        return err_set(e, ERR_USAGE,
                       "--prune: a shard does not know what is left over: run rasp batch --prune without --shard");
    if (ask->no_render && (shard || ask->force))
        return err_set(e, ERR_USAGE, "--no-render: goes with neither --shard nor --force, which render");
    long missing = 0;
    if ((shard && !set_shard_read(shard, &ask->shard, e)) || !batch_threads(c, &ask->threads, e) ||
        !args_whole(&c->args, "missing", (const long[2]){1, SET_SHARDS}, &missing, e))
        return false;
    ask->missing = (int)missing;
    if (ask->missing && ask->dry) return err_set(e, ERR_USAGE, "--missing: writes nothing anyway: leave --dry-run out");
    /* "rasp 0.1.0 f650ae05d2ab", or, when that does not say which source it was made from (changes that are not
       committed, no git), with the program's own hash behind it, so that results of two builds are never taken for each
       other's. */
    char hex[HASH_TEXT];
    ask->program = arena_format(c->arena, "rasp %s %s", version_number, version_revision);
    if (!strstr(version_revision, "dirty") && strcmp(version_revision, "unknown") != 0) return true;
    if (!hash_file("/proc/self/exe", hex, e)) return false;
    ask->program = arena_format(c->arena, "%s %.12s", ask->program, hex);
    return true;
}

static int batch_command_run(struct cmd_call *c, struct err *e)
{
    struct batch_ask ask;
    struct batch_report r;
    if (!read_ask(c, &ask, e)) return (int)e->kind;
    message_group(c);
    bool ok = batch_run(&ask, c->arena, &r, e);
    batch_message_unread(c, ask.design, &r, e);
    batch_message_faults(c, "batch", ask.design, &r.plan);
    if (ask.dry) batch_message_warnings(c, &r.plan);
    if (r.rendering) report_stimuli(c, &ask, &r);
    if (*r.no_effect) message_warning(c, ask.design, r.no_effect);
    const struct folder_stale *l = &r.stale;
    const char *list = "";
    for (int i = 0; i < l->n_files && i < STALE_NAMED; i++)
        list = arena_format(c->arena, "%s%s%s", list, i ? ", " : "", l->files[i]);
    if (l->n_files > STALE_NAMED) list = arena_format(c->arena, "%s and %d more", list, l->n_files - STALE_NAMED);
    bool one = l->n_files == 1;
    if (l->n_files)
        message_warning(
            c, ask.folder,
            arena_format(
                c->arena,
                "%d file%s of an earlier state of the set %s still there, outside the manifest: %s; rasp batch "
                "--prune removes %s",
                l->n_files, one ? "" : "s", one ? "is" : "are", list,
                one ? "it unless it was changed since" : "those of stimuli of which nobody changed a file"));
    batch_close(&r);
    if (!r.rows) return (int)e->kind;
    if (args_given(&c->args, "json"))
        report_json(&ask, &r, e);
    else if (ok && ask.missing)
        puts(r.missing);
    else if ((ok && ask.dry) || (!ask.dry && (ok || r.failed) && !ask.quiet))
        print_report(&ask, &r, c->arena);
    return (int)e->kind;
}

const struct command batch_command = {
    .name = "batch",
    .group = "Sets of stimuli",
    .summary = "renders the set of stimuli that a design describes",
    .does = "A design (rasp-design(5)) has a base scene, factors and levels, replicates, an order, one rule for the "
            "level and one for the length. Everything is read and checked before anything is rendered. Only promised "
            "errors (accuracy.error) are looked at while rendering; rasp check looks at them beforehand.\n"
            "FOLDER then has NAME.wav, NAME.scene.yaml and NAME.json of every stimulus, with whatever else its scene "
            "writes. The table manifest.csv has a row for each, with factors, seed, levels and hashes. The same as "
            "lines of JSON is manifest.jsonl, and manifest.json says what its columns mean. SHA256SUMS is for "
            "sha256sum -c, and timings.csv says what it took. All but the last are the same bytes whatever the number "
            "of threads and shards. None of them may take the place of a file that the set is made from.\n"
            "NAME.json is the record of its stimulus: a hash of all that made it, the hashes of its files, its "
            "levels, and what rasp render says of a render, without times. It takes its name last, so that what a "
            "record says is there is there.\n"
            "Run again, the same command makes each stimulus whose record is not right. That is so after a change of "
            "the design, of an input or of the program, after an interruption (exit code 75), a crash or a full disk. "
            "A file whose size and time are as they were is not read again, unless the last run did not end. Files "
            "that a stimulus does not write any more go when it is made again, if nobody changed them.\n"
            "A stimulus that fails does not stop the others: the manifest has its error, and the exit code is the "
            "worst of all. Where the level is common, the set's gain is known only when all stimuli are. Until then "
            "their raw sounds wait in FOLDER/.rasp, 8 bytes a sample. Maps, responses, mode tables and forces are "
            "read once for all stimuli, up to 256 MB of them. An input that changes while the set is made is reported "
            "at the end (exit code 66), and the next run renders what may be of the old one.\n"
            "With --shard the set is rendered by several runs, on several machines perhaps. What they made elsewhere "
            "is copied into one folder, with its hidden folder .rasp (rsync -a, cp -r). The same command without "
            "--shard then sets the level, writes the tables and renders what is missing. The folder is as after one "
            "run, byte for byte. With --no-render that command names what is missing instead. With --missing N it "
            "prints which of N shards are to be run again, also while they run.\n"
            "A folder holds the set of one design. The design is known by its file and by what it says, its scenes "
            "and what they read included: the file may be edited, or be moved or renamed as it is. What comes through "
            "a pipe is known by what it says alone. Another design is refused (exit code 73) unless --replace gives "
            "it the folder. While a run is at work in the folder another one is refused (exit code 75), but shards of "
            "one state of the set get along. A folder that holds nobody's set is taken if no file in it has the name "
            "of one of the set's.\n"
            "Files of an earlier state of the set stay: a level was taken out, a label changed, a stimulus failed "
            "that was there before. They are named in a warning at the end, and are in no table. The option --prune "
            "removes those stimuli of which no file was changed.",
    .operands = "DESIGN",
    .least = 1,
    .most = 1,
    .options = batch_options,
    .examples = "rasp batch scenes/designs/materials_by_rate.yaml -o out\n"
                "rasp batch scenes/designs/materials_by_rate.yaml --dry-run\n"
                "rasp batch scenes/designs/materials_by_rate.yaml -o out -j 2 --quiet\n"
                "for i in 1 2 3; do rasp batch scenes/designs/materials_by_rate.yaml -o parts --shard $i/3; done && "
                "rasp batch scenes/designs/materials_by_rate.yaml -o parts\n",
    .run = batch_command_run,
};

/* rasp merge: how the shards of a set are joined. There is nothing to merge: the records of copied stimuli are as good
 * as those that were made here. */

static const struct args_option merge_options[] = {
    /* of earlier versions, so that a script is told what to do now */
    {"jobs", 'j', "N", false, "taken, without effect"},
    {"json", 0, NULL, false, "taken, without effect"},
    {"quiet", 'q', NULL, false, "taken, without effect"},
    {0},
};

static int merge_run(struct cmd_call *c, struct err *e)
{
    const char *folder = c->args.n_operands ? c->args.operands[0] : "FOLDER";
    return err_set(e, ERR_USAGE,
                   "shards need no merging: copy what they made into one folder, with its hidden folder .rasp (rsync "
                   "-a, cp -r), and run the same command once more without --shard: rasp batch DESIGN -o %s",
                   folder);
}

const struct command batch_merge_command = {
    .name = "merge",
    .summary = "says how the shards of a set are joined",
    .does =
        "The shards of rasp batch --shard need no merging. What they made on other machines is copied into one folder, "
        "with its hidden folder .rasp; the same rasp batch command, without --shard, then sets the level and writes "
        "the tables. With --no-render it renders nothing, and names what is missing. The exit code is 64.",
    .operands = "[FOLDER]",
    .most = 1,
    .options = merge_options,
    .examples = "for i in 1 2; do rasp batch scenes/designs/materials_by_rate.yaml -o parts --shard $i/2 -q; done && "
                "rasp batch scenes/designs/materials_by_rate.yaml -o parts\n",
    .run = merge_run,
};
