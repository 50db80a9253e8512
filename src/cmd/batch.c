/* rasp batch: a design into a set of stimuli. */
#include "cmd/batch.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/hash.h"
#include "batch/progress.h"
#include "cmd/cmd.h"
#include "cmd/tell.h"
#include "file/json_value.h"
#include "scene/keys_yaml.h"

enum { TOLD = 20 /* failures that are told one by one */, STALE_TOLD = 6 /* files of earlier states */ };

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

/* "rasp 0.1.0 f650ae05d2ab", or, when that does not say which source it was made from (changes that are not committed,
   no git), with the program's own hash behind it, so that results of two builds are never taken for each other's. NULL:
   *e */
static const char *program_of(struct arena *a, struct err *e)
{
    char hex[HASH_TEXT];
    if (!strstr(version_revision, "dirty") && strcmp(version_revision, "unknown") != 0)
        return arena_format(a, "rasp %s %s", version_number, version_revision);
    if (!hash_file("/proc/self/exe", hex, e)) return NULL;
    return arena_format(a, "rasp %s %s %.12s", version_number, version_revision, hex);
}

/* ------------------------------------------------------------------ what went wrong */

static void tell_more(struct cmd_call *c, const char *command, enum err_kind kind, const char *text)
{
    struct err told = {0};
    err_set(&told, kind, "%s", text);
    tell_error(c, command, &told);
}

void batch_tell_unread(struct cmd_call *c, const char *file, const struct batch_report *r, struct err *e)
{
    enum err_kind kind = e->kind;
    if (!*r->messages) return;
    tell_scene(c, r->design.diag, r->messages, kind);
    *e = (struct err){0};
    err_set(e, kind, "%s %s", file, kind == ERR_SCENE ? "is not a valid design" : "cannot be read");
}

void batch_tell_faults(struct cmd_call *c, const char *command, const char *file, const struct set_plan *p)
{
    for (int k = 0; k < p->n_faults && k < TOLD; k++) {
        const struct set_fault *f = &p->faults[k];
        const char *whose = f->n > 1 ? arena_format(c->arena, "%s and %d more", f->name, f->n - 1) : f->name;
        struct err told = {0};
        if (*f->messages) {
            tell_scene(c, f->diag, f->messages, f->err->kind);
            err_set(&told, f->err->kind, "%s: the scene of %s is not valid", file, whose);
        } else
            err_set(&told, f->err->kind, "%s (%s)", f->err->text, whose);
        told.place = *f->messages ? told.place : f->err->place;
        tell_error(c, command, &told);
    }
    if (p->n_faults > TOLD)
        tell_more(c, command, p->faults[TOLD].err->kind,
                  arena_format(c->arena, p->n_faults > SET_FAULTS ? "and many more errors" : "and %d more errors",
                               p->n_faults - TOLD));
}

void batch_tell_warnings(struct cmd_call *c, const struct set_plan *p)
{
    for (int k = 0; k < p->n_warnings; k++)
        tell_stimulus_warning(c, p->warnings[k].name, p->warnings[k].text);
}

static void tell_warnings(struct cmd_call *c, const char *folder, const char *name)
{
    struct arena *a = arena_open();
    struct record r;
    if (record_read(folder, name, a, &r))
        for (int k = 0; r.warnings[k]; k++)
            tell_stimulus_warning(c, name, r.warnings[k]);
    arena_close(a);
}

/* Failures of single stimuli, each error once, and warnings of those that were rendered now. */
static void tell_stimuli(struct cmd_call *c, const struct batch_ask *ask, const struct batch_report *r)
{
    int failed = 0;
    enum err_kind worst = ERR_NONE;
    for (int i = 0; i < r->set.n; i++) {
        const struct tables_row *o = &r->rows[i];
        const char *name = r->design.stimuli[i].name;
        struct err told = {0};
        if (o->there && o->made) tell_warnings(c, ask->folder, name);
        if (!o->kind) continue;
        err_set(&told, o->kind, "%s", o->text);
        if (++failed <= TOLD)
            tell_stimulus(c, "batch", name, ask->design, &told);
        else
            worst = o->kind > worst ? o->kind : worst;
    }
    if (worst) tell_more(c, "batch", worst, arena_format(c->arena, "and %d more that failed", failed - TOLD));
}

static void tell_stale(struct cmd_call *c, const char *folder, const struct folder_stale *l)
{
    const char *list = "";
    if (!l->n_files) return;
    for (int i = 0; i < l->n_files && i < STALE_TOLD; i++)
        list = arena_format(c->arena, "%s%s%s", list, i ? ", " : "", l->files[i]);
    if (l->n_files > STALE_TOLD) list = arena_format(c->arena, "%s and %d more", list, l->n_files - STALE_TOLD);
    bool one = l->n_files == 1;
    tell_warning(
        c, folder,
        arena_format(c->arena,
                     "%d file%s of an earlier state of the set %s still there, outside the manifest: %s; rasp batch "
                     "--prune removes %s",
                     l->n_files, one ? "" : "s", one ? "is" : "are", list,
                     one ? "it unless it was changed since" : "those of stimuli of which nobody changed a file"));
}

/* ------------------------------------------------------------------ what was done */

static bool print_json(json_t *j, struct err *e)
{
    bool ok = j && json_dumpf(j, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(17) | JSON_ENSURE_ASCII) == 0;
    putchar('\n');
    json_decref(j);
    return ok || err_set(e, ERR_IO, "the report cannot be written as JSON");
}

/* What a dry run lists. */
static json_t *stimulus_json(const struct batch_report *r, int i)
{
    const struct design *d = &r->design;
    const struct design_stimulus *s = &d->stimuli[i];
    char seed[24];
    json_t *factors = json_object();
    snprintf(seed, sizeof seed, "%" PRIu64, s->seed); /* as text: many readers of JSON have no 64 bits */
    for (int f = 0; f < d->n_factors; f++)
        json_object_set_new(factors, d->factors[f].name,
                            s->level[f] < 0 ? json_null() : json_string(design_label(d, i, f)));
    json_t *j = json_pack("{s:i, s:s, s:o, s:o, s:o, s:o, s:f}", "row", i + 1, "name", s->name, "factors", factors,
                          "replicate", s->recording ? json_null() : json_integer(s->replicate), "seed",
                          s->recording ? json_null() : json_string(seed), "recording",
                          s->recording ? json_value_shown(s->recording) : json_null(), "length_s", r->set.lengths[i]);
    if (r->states) json_object_set_new(j, "state", json_string(stimulus_states[r->states[i]]));
    return j;
}

static json_t *list_json(const struct batch_report *r)
{
    json_t *all = json_array();
    for (int i = 0; i < r->set.n; i++)
        if (!r->mine || r->mine[i]) json_array_append_new(all, stimulus_json(r, i));
    return all;
}

static json_t *failed_json(const struct batch_report *r)
{
    json_t *failed = json_array();
    for (int i = 0; i < r->set.n; i++)
        if (r->rows[i].kind)
            json_array_append_new(failed, json_pack("{s:s, s:i, s:o}", "stimulus", r->design.stimuli[i].name, "code",
                                                    (int)r->rows[i].kind, "error", json_value_shown(r->rows[i].text)));
    return failed;
}

static json_t *report_json(const struct batch_ask *ask, const struct batch_report *r)
{
    json_t *stale = json_array();
    for (int i = 0; i < r->stale.n_files; i++)
        json_array_append_new(stale, json_value_shown(r->stale.files[i]));
    json_t *j = json_pack(
        "{s:s?, s:s, s:i, s:i, s:i, s:o, s:o, s:o, s:[i, i], s:i, s:i, s:i, s:o, s:i, s:f, s:I, s:f, s:f}", "title",
        r->design.title, "design_sha256", r->set.sha256, "stimuli", r->set.n, "ok", r->rendered + r->kept - r->waiting,
        "waiting", r->waiting, "full_scale", json_value_number(r->full_scale), "failed", failed_json(r), "folder",
        json_value_text(ask->folder), "shard", ask->shard.i, ask->shard.n, "mine", r->n_mine, "rendered", r->rendered,
        "kept", r->kept, "left_over", stale, "pruned", r->stale.removed, "sound_s", r->plan.seconds, "wav_bytes",
        (json_int_t)r->plan.bytes, "predicted_cpu_s", r->plan.cycles / 3e9, "wall_s", r->seconds);
    if (r->missing) json_object_set_new(j, "missing_shards", json_string(r->missing));
    if (ask->dry) json_object_set_new(j, "list", list_json(r));
    return j;
}

static void print_silence(const struct batch_report *r)
{
    if (!r->plan.n_sounds)
        printf("no stimulus makes a sound, only tables: what is touched or what scrapes needs a response, as in set: "
               "{surface.response: table.csv}\n");
}

static const char **states_of(const struct batch_report *r, struct arena *a)
{
    const char **all = r->states ? ARENA_TAKE(a, const char *, r->set.n) : NULL;
    for (int i = 0; all && i < r->set.n; i++)
        all[i] = stimulus_states[r->states[i]];
    return all;
}

static void print_report(const struct batch_ask *ask, const struct batch_report *r, struct arena *a)
{
    char took[24];
    progress_time(r->seconds, took);
    if (ask->shard.n > 1) {
        printf("%s: shard %d/%d: %d stimuli rendered, %d there already, %d failed, in %s; when all are there: the same "
               "command without --shard\n",
               ask->folder, ask->shard.i, ask->shard.n, r->rendered, r->kept, r->failed, took);
        return;
    }
    printf("%s: %d stimuli rendered, %d there already, %d %s, in %s", ask->folder, r->rendered, r->kept, r->failed,
           ask->no_render ? "missing" : "failed", took);
    if (r->stale.removed) printf("; %d file%s left over removed", r->stale.removed, r->stale.removed == 1 ? "" : "s");
    if (!isnan(r->full_scale)) printf("; full_scale %s", keys_yaml_number(r->full_scale, a));
    printf("\n");
    print_silence(r);
}

/* ------------------------------------------------------------------ command */

bool batch_threads(const struct cmd_call *c, int *threads, struct err *e)
{
    long n = batch_cores();
    if (!args_whole(&c->args, "jobs", (const long[2]){1, 256}, &n, e)) return false;
    *threads = (int)n;
    return true;
}

static bool read_numbers(const struct cmd_call *c, struct batch_ask *ask, struct err *e)
{
    long missing = 0;
    bool ok = batch_threads(c, &ask->threads, e) &&
              args_whole(&c->args, "missing", (const long[2]){1, SET_SHARDS}, &missing, e);
    ask->missing = (int)missing;
    return ok;
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
    if ((shard && !set_shard_read(shard, &ask->shard, e)) || !read_numbers(c, ask, e)) return false;
    if (ask->missing && ask->dry) return err_set(e, ERR_USAGE, "--missing: writes nothing anyway: leave --dry-run out");
    ask->program = program_of(c->arena, e);
    return ask->program != NULL;
}

static int batch_command_run(struct cmd_call *c, struct err *e)
{
    struct batch_ask ask;
    struct batch_report r;
    bool json = args_given(&c->args, "json");
    if (!read_ask(c, &ask, e)) return (int)e->kind;
    tell_group(c);
    bool ok = batch_run(&ask, c->arena, &r, e);
    batch_tell_unread(c, ask.design, &r, e);
    batch_tell_faults(c, "batch", ask.design, &r.plan);
    if (ask.dry) batch_tell_warnings(c, &r.plan);
    if (r.rendering) tell_stimuli(c, &ask, &r);
    if (*r.no_effect) tell_warning(c, ask.design, r.no_effect);
    tell_stale(c, ask.folder, &r.stale);
    batch_close(&r);
    if (!r.rows) return (int)e->kind;
    if (json)
        print_json(report_json(&ask, &r), e);
    else if (ok && ask.missing)
        puts(r.missing);
    else if (ok && ask.dry) {
        char cpu[24];
        design_print(&r.design, r.mine, states_of((&r), c->arena), stdout);
        progress_time(r.plan.cycles / 3e9, cpu);
        printf("%d stimuli, %.4g s of sound, %.3g MB of WAVs; predicted CPU time %s (a core of 3 GHz)\n", r.set.n,
               r.plan.seconds, r.plan.bytes / 1e6, cpu);
        if (r.plan.raw_bytes > 0) printf("%.3g MB more while the common level is not known\n", r.plan.raw_bytes / 1e6);
        const char *lengths = set_lengths_text(&r.set, &r.plan, c->arena);
        if (lengths) printf("%s\n", lengths);
        print_silence((&r));
        if (ask.shard.n > 1) printf("shard %d/%d: %d of them\n", ask.shard.i, ask.shard.n, r.n_mine);
    } else if ((ok || r.failed) && !ask.quiet)
        print_report(&ask, &r, c->arena);
    return (int)e->kind;
}

const struct command batch_command = {
    .name = "batch",
    .group = "Sets of stimuli",
    .summary = "renders the set of stimuli that a design describes",
    .does =
        "A design (rasp-design(5)) has a base scene, factors and levels, replicates, an order, one rule for the level "
        "and one for the length. Everything is read and checked before anything is rendered, but for promised errors "
        "(accuracy.error), which rasp check looks at beforehand. FOLDER then has NAME.wav, NAME.scene.yaml (rendering "
        "it gives the same bytes) and NAME.json of every stimulus, with whatever else its scene writes; manifest.csv, "
        "a row for each with factors, seed, levels and hashes; manifest.json, which says what its columns mean; "
        "SHA256SUMS, for sha256sum -c; timings.csv. None of them may take the place of a file that the set is made "
        "from. All but the last are the same bytes whatever the number of threads and shards.\n"
        "NAME.json is the record of its stimulus: a hash of all that made it, the hashes of its files, its levels, and "
        "what rasp render tells of a render, without times. It takes its name last, so that what a record says is "
        "there is there. Run again, the same command makes each stimulus whose record is not right: after a change of "
        "the design, of an input or of the program, after an interruption (exit code 75), a crash or a full disk. A "
        "file whose size and time are as they were is not read again, unless the last run did not end. Files that a "
        "stimulus does not write any more go when it is made again, if nobody changed them. Maps, responses, mode "
        "tables and forces in WAV or NPY are read once for all stimuli, up to 256 MB of them; an input that changes "
        "while the set is made is told at the end (exit code 66), and the next run renders what may be of the old one. "
        "A stimulus that fails does not stop the others: the manifest has its error, and the exit code is the worst of "
        "all. Where the level is common, the set's gain is known only when all stimuli are: until then their raw "
        "sounds wait in FOLDER/.rasp, 8 bytes a sample.\n"
        "With --shard the set is rendered by several runs, on several machines perhaps. What they made elsewhere is "
        "copied into one folder, with its hidden folder .rasp (rsync -a, cp -r); the same command without --shard then "
        "sets the level, writes the tables and renders what is missing, and the folder is as after one run, byte for "
        "byte. --no-render instead names what is missing; --missing N prints which of N shards are to be run again, "
        "also while they run.\n"
        "A folder holds the set of one design, which is known by its file and by what it says, its scenes and what "
        "they read included: the file may be edited, or be moved or renamed as it is; what comes through a pipe is "
        "known by what it says alone. Another design is refused (exit code 73) unless --replace gives it the folder. "
        "While a run is at work in the folder another one is refused (exit code 75); shards of one state of the set "
        "get along. A folder that holds nobody's set is taken if no file in it has the name of one of the set's. Files "
        "of an earlier state of the set (a level was taken out, a label changed, a stimulus failed that was there "
        "before) stay, are named in a warning at the end, and are in no table; --prune removes those stimuli of which "
        "no file was changed.",
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
