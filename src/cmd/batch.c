/* rasp batch: a design into a set of stimuli. */
#include "cmd/batch.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "batch/progress.h"
#include "cmd/batch_build.h"
#include "cmd/tell.h"
#include "file/json_value.h"
#include "scene/keys_yaml.h"

enum { TOLD = 20 /* failures that are told one by one */, LEFT_TOLD = 6 /* files that are left over */ };

static const struct args_option batch_options[] = {
    {"output", 'o', "FOLDER", false, "where the set goes; it is made if its parent is there"},
    {"jobs", 'j', "N", false, "how many stimuli are rendered at once, 1 to 256; default: one for each core"},
    {"shard", 0, "I/N", false, "render part I of N only (from 1/N to N/N), of about equal cost; rasp merge joins them"},
    {"dry-run", 'n', NULL, false, "read and check everything, list the stimuli (with --json as \"list\"), write nothing"},
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

bool batch_threads(const struct cmd_call *c, int *threads, struct err *e)
{
    long n = batch_cores();
    if (!args_whole(&c->args, "jobs", (const long[2]){1, 256}, &n, e))
        return false;
    *threads = (int)n;
    return true;
}

/* ------------------------------------------------------------------ what went wrong */

void batch_tell_more(struct cmd_call *c, const char *command, enum err_kind kind, const char *text)
{
    struct err told = {0};
    err_set(&told, kind, "%s", text);
    tell_error(c, command, &told);
}

void batch_tell_unread(struct cmd_call *c, const char *file, const struct batch_report *r, struct err *e)
{
    enum err_kind kind = e->kind;
    if (!*r->messages)
        return;
    tell_scene(c, r->design.diag, r->messages, kind);
    *e = (struct err){0};
    err_set(e, kind, "%s %s", file, kind == ERR_SCENE ? "is not a valid design" : "cannot be read");
}

void batch_tell_faults(struct cmd_call *c, const char *command, const char *file, const struct prepare *p)
{
    for (int k = 0; k < p->n_faults && k < TOLD; k++) {
        const struct prepare_fault *f = &p->faults[k];
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
        batch_tell_more(c, command, p->faults[TOLD].err->kind,
                        arena_format(c->arena, p->n_faults > PREPARE_FAULTS ? "and many more errors" : "and %d more errors", p->n_faults - TOLD));
}

void batch_tell_remarks(struct cmd_call *c, const struct prepare *p)
{
    for (int k = 0; k < p->n_remarks; k++)
        tell_stimulus_warning(c, p->remarks[k].name, p->remarks[k].text);
}

static void tell_remarks(struct cmd_call *c, const struct results *all, int i)
{
    struct arena *a = arena_open();
    struct err unreadable = {0};
    const struct record *r = journal_read(all->journal, all->of[i].record, a, &unreadable);
    for (int k = 0; r && r->remarks[k]; k++)
        tell_stimulus_warning(c, all->set->rows[i].name, r->remarks[k]);
    arena_close(a);
}

struct failure {
    const char *name;
    const struct outcome *is;
};

static void tell_failure(struct cmd_call *c, const char *command, const char *file, const struct failure *f)
{
    struct err told = {0};
    err_set(&told, f->is->kind, "%s", f->is->text);
    tell_stimulus(c, command, f->name, file, &told);
}

void batch_tell(struct cmd_call *c, const char *command, const char *file, const struct results *all)
{
    int failed = 0;
    enum err_kind worst = ERR_NONE;
    for (int i = 0; i < all->set->n; i++) {
        const struct outcome *o = &all->of[i];
        if (o->record.size && !o->kept)
            tell_remarks(c, all, i);
        if (!o->kind)
            continue;
        if (++failed <= TOLD)
            tell_failure(c, command, file, &(struct failure){all->set->rows[i].name, o});
        else
            worst = o->kind > worst ? o->kind : worst;
    }
    if (worst)
        batch_tell_more(c, command, worst, arena_format(c->arena, "and %d more that failed", failed - TOLD));
}

void batch_tell_left(struct cmd_call *c, const char *folder, const struct leftover *l)
{
    const char *list = "";
    if (!l->n_files)
        return;
    for (int i = 0; i < l->n_files && i < LEFT_TOLD; i++)
        list = arena_format(c->arena, "%s%s%s", list, i ? ", " : "", l->files[i]);
    if (l->n_files > LEFT_TOLD)
        list = arena_format(c->arena, "%s and %d more", list, l->n_files - LEFT_TOLD);
    bool one = l->n_files == 1;
    tell_warning(c, folder, arena_format(c->arena, "%d file%s of an earlier state of the set %s still there, outside the manifest: %s; rasp batch --prune removes %s (of a NAME.json it cannot tell)", l->n_files, one ? "" : "s",
                                         one ? "is" : "are", list, one ? "it unless it was changed since" : "those that nobody changed since"));
}

/* ------------------------------------------------------------------ what was done */

bool batch_print_json(json_t *j, struct err *e)
{
    bool ok = j && json_dumpf(j, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(17) | JSON_ENSURE_ASCII) == 0;
    putchar('\n');
    json_decref(j);
    return ok || err_set(e, ERR_IO, "the report cannot be written as JSON");
}

json_t *batch_json(const struct set *s, const struct outcome *outcomes, double full_scale)
{
    json_t *failed = json_array();
    int ok = 0, waiting = 0;
    for (int i = 0; i < s->n; i++) {
        const struct outcome *o = &outcomes[i];
        ok += o->record.size && !o->waits;
        waiting += o->record.size && o->waits;
        if (o->kind)
            json_array_append_new(failed, json_pack("{s:s, s:i, s:o}", "stimulus", s->rows[i].name, "code", (int)o->kind, "error", json_value_shown(o->text ? o->text : "")));
    }
    return json_pack("{s:s?, s:s, s:i, s:i, s:i, s:o, s:o}", "title", s->title, "design_sha256", s->sha256, "stimuli", s->n, "ok", ok, "waiting", waiting, "full_scale",
                     isnan(full_scale) ? json_null() : json_real(full_scale), "failed", failed);
}

json_t *batch_left_json(const struct leftover *l)
{
    json_t *files = json_array();
    for (int i = 0; i < l->n_files; i++)
        json_array_append_new(files, json_value_shown(l->files[i]));
    return files;
}

/* What a dry run lists. */
static json_t *stimulus_json(const struct design *d, const struct prepare *p, int i)
{
    const struct design_stimulus *s = &d->stimuli[i];
    char seed[24];
    json_t *factors = json_object();
    snprintf(seed, sizeof seed, "%" PRIu64, s->seed); /* as text: many readers of JSON have no 64 bits */
    for (int f = 0; f < d->n_factors; f++)
        json_object_set_new(factors, d->factors[f].name, s->level[f] < 0 ? json_null() : json_string(design_label(d, i, f)));
    return json_pack("{s:i, s:s, s:o, s:o, s:o, s:o, s:f}", "row", i + 1, "name", s->name, "factors", factors, "replicate", s->recording ? json_null() : json_integer(s->replicate), "seed",
                     s->recording ? json_null() : json_string(seed), "recording", s->recording ? json_value_shown(s->recording) : json_null(), "length_s", p->lengths[i]);
}

static json_t *list_json(const struct batch_report *r)
{
    json_t *all = json_array();
    for (int i = 0; i < r->set.n; i++)
        if (!r->mine || r->mine[i])
            json_array_append_new(all, stimulus_json(&r->design, &r->prepare, i));
    return all;
}

static json_t *report_json(const struct batch_ask *ask, const struct batch_report *r)
{
    json_t *j = batch_json(&r->set, r->outcomes, r->full_scale);
    json_object_set_new(j, "folder", json_value_text(ask->folder));
    json_object_set_new(j, "shard", json_pack("[i, i]", ask->shard.i, ask->shard.n));
    json_object_set_new(j, "mine", json_integer(r->n_mine));
    json_object_set_new(j, "rendered", json_integer(r->rendered));
    json_object_set_new(j, "kept", json_integer(r->kept));
    json_object_set_new(j, "left_over", batch_left_json(&r->left));
    json_object_set_new(j, "pruned", json_integer(r->left.removed));
    json_object_set_new(j, "sound_s", json_real(r->prepare.seconds));
    json_object_set_new(j, "wav_bytes", json_integer((json_int_t)r->prepare.bytes));
    json_object_set_new(j, "predicted_cpu_s", json_real(r->prepare.cycles / 3e9));
    json_object_set_new(j, "wall_s", json_real(r->seconds));
    if (ask->dry)
        json_object_set_new(j, "list", list_json(r));
    return j;
}

static void print_silence(const struct batch_report *r)
{
    if (!r->prepare.n_sounds)
        printf("no stimulus makes a sound, only tables: what is touched or what scrapes needs a response, as in set: {surface.response: table.csv}\n");
}

static void print_plan(const struct batch_ask *ask, const struct batch_report *r, struct arena *a)
{
    char cpu[24];
    design_print(&r->design, r->mine, stdout);
    progress_time(r->prepare.cycles / 3e9, cpu);
    printf("%d stimuli, %.4g s of sound, %.3g MB of WAVs; predicted CPU time %s (a core of 3 GHz)\n", r->set.n, r->prepare.seconds, r->prepare.bytes / 1e6, cpu);
    if (r->prepare.raw_bytes > 0)
        printf("%.3g MB more while the common level is not known\n", r->prepare.raw_bytes / 1e6);
    const char *lengths = lengths_told(&r->prepare.own, &r->design, a);
    if (lengths)
        printf("%s\n", lengths);
    print_silence(r);
    if (ask->shard.n > 1)
        printf("shard %d/%d: %d of them\n", ask->shard.i, ask->shard.n, r->n_mine);
}

static void print_report(const struct batch_ask *ask, const struct batch_report *r, struct arena *a)
{
    char took[24];
    progress_time(r->seconds, took);
    if (ask->shard.n > 1) {
        printf("%s: shard %d/%d: %d stimuli rendered, %d there already, %d failed, in %s; when all are there: rasp merge %s\n", ask->folder, ask->shard.i, ask->shard.n, r->rendered,
               r->kept, r->failed, took, ask->folder);
        return;
    }
    printf("%s: %d stimuli rendered, %d there already, %d failed, in %s", ask->folder, r->rendered, r->kept, r->failed, took);
    if (r->left.removed)
        printf("; %d file%s left over removed", r->left.removed, r->left.removed == 1 ? "" : "s");
    if (!isnan(r->full_scale))
        printf("; full_scale %s", keys_yaml_number(r->full_scale, a));
    printf("\n");
    print_silence(r);
}

/* ------------------------------------------------------------------ command */

static bool read_ask(struct cmd_call *c, struct batch_ask *ask, struct err *e)
{
    const char *folder = args_value(&c->args, "output"), *shard = args_value(&c->args, "shard");
    *ask = (struct batch_ask){.design = c->args.operands[0], .shard = {1, 1}, .force = args_given(&c->args, "force"), .dry = args_given(&c->args, "dry-run"),
                              .quiet = args_given(&c->args, "quiet"), .replace = args_given(&c->args, "replace"), .prune = args_given(&c->args, "prune")};
    if (!ask->dry && (!folder || !*folder))
        return err_set(e, ERR_USAGE, "--output: a folder for the set is needed, as in -o out");
    if (folder && !strcmp(folder, "-"))
        return err_set(e, ERR_USAGE, "--output -: a set is a folder of files, and cannot go to standard output; a folder of that name is ./-");
    ask->folder = folder ? batch_folder(c->arena, folder) : NULL;
    if (shard && ask->prune)
        return err_set(e, ERR_USAGE, "--prune: a shard does not know what is left over: merge first, then run rasp batch --prune without --shard");
    if ((shard && !shard_read(shard, &ask->shard, e)) || !batch_threads(c, &ask->threads, e))
        return false;
    ask->build = batch_build(c->arena, e);
    return ask->build != NULL;
}

static int batch_command_run(struct cmd_call *c, struct err *e)
{
    struct batch_ask ask;
    struct batch_report r;
    bool json = args_given(&c->args, "json");
    if (!read_ask(c, &ask, e))
        return (int)e->kind;
    tell_group(c);
    bool ok = batch_run(&ask, c->arena, &r, e);
    batch_tell_unread(c, ask.design, &r, e);
    batch_tell_faults(c, "batch", ask.design, &r.prepare);
    if (ask.dry)
        batch_tell_remarks(c, &r.prepare);
    if (r.journal)
        batch_tell(c, "batch", ask.design, &(struct results){&r.set, r.outcomes, r.journal});
    if (*r.unheard)
        tell_warning(c, ask.design, r.unheard);
    batch_tell_left(c, ask.folder, &r.left);
    batch_close(&r);
    if (!r.outcomes)
        return (int)e->kind;
    if (json)
        batch_print_json(report_json(&ask, &r), e);
    else if (ok && ask.dry)
        print_plan(&ask, &r, c->arena);
    else if ((ok || r.failed) && !ask.quiet)
        print_report(&ask, &r, c->arena);
    return (int)e->kind;
}

const struct command batch_command = {
    .name = "batch",
    .summary = "renders the set of stimuli that a design describes",
    .does = "A design (rasp-design(5)) has a base scene, factors and levels, replicates, an order, one rule for the level and one for the length. Everything is read and checked before "
            "anything is rendered, but for promised errors (accuracy.error), which rasp check looks at beforehand. FOLDER then has NAME.wav, NAME.scene.yaml (rendering it gives the same bytes) and NAME.json of every stimulus, with whatever else its scene "
            "writes; manifest.csv, a row for each with factors, seed, levels and hashes; manifest.json, which says what its columns mean; SHA256SUMS, for sha256sum -c; timings.csv. "
            "None of them may take the place of a file that the set is made from. All but the last, and the NAME.json, are the same bytes whatever the number of threads and shards.\n"
            "Run again, it renders only what is not there as it should be: after a change of the design, of an input or of the program, after an interruption (exit code 75), a crash or a "
            "full disk. Maps, responses, mode tables and forces in WAV or NPY are read once for all stimuli, up to 256 MB of them; an input that changes while the set is made is told at the "
            "end (exit code 66), and the next run renders what may be of the old one. A stimulus that fails does not stop the others: the manifest has its error, and the exit code is the worst of all. Where the level is common, the set's gain is "
            "known only when all stimuli are: until then their raw sounds wait in FOLDER/.rasp, 8 bytes a sample. With --shard the set is rendered by several runs, on several machines "
            "perhaps, each with a manifest.I-of-N.csv; rasp merge makes one set of them. FOLDER/.rasp also keeps the list of what is done.\n"
            "A folder holds the set of one design, which is known by its file and by what it says, its scenes and what they read included: the file may be edited, or be moved or renamed as it is; what comes through a pipe is known by what it says alone. Another design is refused (exit code 73) "
            "unless --replace gives it the folder; so is a second batch while one is at work for another state of the design; two of the same state get along, and what both are at they both render, to the same bytes. A folder that holds "
            "nobody's set is taken if no file in it has the name of one of the set's. "
            "Files of an earlier state of the set (a level was taken out, a label changed; a stimulus failed, or waits for its level, that was there before) stay, are named in a warning at the end, "
            "and are in no table; --prune removes those stimuli of which no file was changed, with their NAME.json, whose bytes are not kept account of: rename one with notes in it.",
    .operands = "DESIGN",
    .least = 1,
    .most = 1,
    .options = batch_options,
    .examples = "rasp batch scenes/designs/materials_by_rate.yaml -o out\n"
                "rasp batch scenes/designs/materials_by_rate.yaml --dry-run\n"
                "rasp batch scenes/designs/materials_by_rate.yaml -o out -j 2 --quiet\n"
                "for i in 1 2 3; do rasp batch scenes/designs/materials_by_rate.yaml -o parts --shard $i/3; done && rasp merge parts\n",
    .run = batch_command_run,
};
