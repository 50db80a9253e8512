/* rasp merge: how the shards of a set are joined. There is nothing to merge: the records of copied stimuli are as good
 * as those that were made here. */
#include <stdio.h>

#include "cmd/cmd.h"

static const struct args_option merge_options[] = {
    /* of earlier versions, so that a script is told what to do now */
    {"jobs", 'j', "N", false, "taken, without effect"},
    {"json", 0, NULL, false, "taken, without effect"},
    {"quiet", 'q', NULL, false, "taken, without effect"},
    {0},
};

static int merge_command_run(struct cmd_call *c, struct err *e)
{
    const char *folder = c->args.n_operands ? c->args.operands[0] : "FOLDER";
    return err_set(e, ERR_USAGE,
                   "shards need no merging: copy what they made into one folder, with its hidden folder .rasp (rsync "
                   "-a, cp -r), and run the same command once more without --shard: rasp batch DESIGN -o %s",
                   folder);
}

const struct command merge_command = {
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
    .run = merge_command_run,
};
