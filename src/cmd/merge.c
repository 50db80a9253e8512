/* rasp merge: the shards of a set into one. */
#include <math.h>
#include <stdio.h>

#include "batch/merge.h"
#include "cmd/batch.h"
#include "cmd/tell.h"
#include "file/json_value.h"
#include "scene/keys_yaml.h"

enum { NAMED = 20 /* stimuli that are missing */ };

static const struct args_option merge_options[] = {
    {"jobs", 'j', "N", false, "how many files are looked at, and levels set, at once, 1 to 256; default: one for each core"},
    {"json", 0, NULL, false, "print what was done on stdout as JSON"},
    {"quiet", 'q', NULL, false, "no summary, only errors"},
    {0},
};

static void tell_missing(struct cmd_call *c, const struct merge_report *r)
{
    int n = 0;
    for (; r->names && r->names[n]; n++)
        if (n < NAMED)
            batch_tell_more(c, "merge", ERR_INPUT, r->whys[n]);
    if (n > NAMED)
        batch_tell_more(c, "merge", ERR_INPUT, arena_format(c->arena, "and %d more", n - NAMED));
}

static json_t *report_json(const struct merge_report *r, const char *folder)
{
    json_t *j = r->already ? json_pack("{s:i}", "stimuli", r->already) : batch_json(&r->set, r->outcomes, r->full_scale), *missing = json_array();
    for (int i = 0; r->names && r->names[i]; i++)
        json_array_append_new(missing, json_string(r->names[i]));
    json_object_set_new(j, "folder", json_value_text(folder));
    json_object_set_new(j, "merged_already", json_boolean(r->already && !r->names[0]));
    json_object_set_new(j, "shards", json_integer(r->shards));
    json_object_set_new(j, "missing_shards", json_string(r->missing));
    json_object_set_new(j, "missing_stimuli", missing);
    json_object_set_new(j, "left_over", batch_left_json(&r->left));
    return j;
}

static void print_report(const struct merge_report *r, const char *folder, struct arena *a)
{
    if (r->already) {
        printf("%s: merged already: all %d stimuli are there as manifest.csv says\n", folder, r->already);
        return;
    }
    printf("%s: %d stimuli of %d shards, %d failed", folder, r->set.n, r->shards, r->failed);
    printf("%s%s\n", isnan(r->full_scale) ? "" : "; full_scale ", isnan(r->full_scale) ? "" : keys_yaml_number(r->full_scale, a));
}

static int merge_command_run(struct cmd_call *c, struct err *e)
{
    struct merge_report r;
    int threads;
    const char *folder = batch_folder(c->arena, c->args.operands[0]);
    if (!batch_threads(c, &threads, e))
        return (int)e->kind;
    bool ok = merge_run(folder, threads, c->arena, &r, e);
    tell_missing(c, &r);
    if (r.outcomes && (ok || r.failed))
        batch_tell(c, "merge", NULL, &(struct results){&r.set, r.outcomes, r.journal});
    if (*r.unheard)
        tell_warning(c, folder, r.unheard);
    batch_tell_left(c, folder, &r.left);
    merge_close(&r);
    if (!r.outcomes && !r.already)
        return (int)e->kind;
    if (args_given(&c->args, "json"))
        batch_print_json(report_json(&r, folder), e);
    else if ((ok || r.failed) && !args_given(&c->args, "quiet"))
        print_report(&r, folder, c->arena);
    return (int)e->kind;
}

const struct command merge_command = {
    .name = "merge",
    .summary = "joins the shards of a set",
    .does = "FOLDER is where all shards of rasp batch --shard went; what was rendered on other machines is copied into it first, with its hidden folder .rasp (rsync -a, cp -r), "
            "out of folders from which the design is seen as it is from here, for scenes name files so. "
            "Checks that all shards are there, of one design and one build of the program, and that every file has the bytes that it had; gives the sounds their common level, if the "
            "design wants one; writes manifest.csv, manifest.json, SHA256SUMS and timings.csv. The folder is then the same as after a batch in one piece, byte for byte but for times. "
            "Shards that are missing are named as a list for a job array, --array=3,17, stimuli by name; the exit code is 66 then. A merge that was cut off goes on when it is run again; of a set that "
            "was merged already it looks whether every file is as it was.",
    .operands = "FOLDER",
    .least = 1,
    .most = 1,
    .options = merge_options,
    .examples = "for i in 1 2; do rasp batch scenes/designs/materials_by_rate.yaml -o parts --shard $i/2 -q; done && rasp merge parts\n",
    .run = merge_command_run,
};
