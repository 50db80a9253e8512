/* rasp check: what can be known to be wrong with a scene before anything is computed. */
#include <stdio.h>

#include "base/text.h"
#include "cmd/cmd.h"
#include "pipeline/plan_scene.h"
#include "pipeline/promise.h"
#include "scene/scene_places.h"

static bool check_scene(struct cmd_call *c, const char *file, struct err *e)
{
    struct scene s, kept;
    return cmd_read_scene(c, file, &s, e) && ((promise_keep(&s, c->arena, &kept, NULL, e) && plan_scene(&kept, c->arena, e)) || scene_places_tell(&s, e));
}

static int check_run(struct cmd_call *c, struct err *e)
{
    int worst = 0;
    (void)e;
    for (int i = 0; i < c->args.n_operands; i++) {
        struct err mine = {0};
        const char *file = c->args.operands[i];
        if (check_scene(c, file, &mine))
            printf("%s: ok\n", text_shown(c->arena, file));
        else
            fprintf(stderr, "rasp check: error: %s\n", mine.text);
        worst = (int)mine.kind > worst ? (int)mine.kind : worst;
    }
    return worst;
}

static const struct args_option options[] = {CMD_SCENE_OPTIONS, {0}};

const struct command check_command = {
    .name = "check",
    .summary = "finds what is wrong with scenes, without rendering them",
    .does = "Reads each scene and says all that is wrong with its text, each fault with its line: unknown keys, wrong units, values out of range or at odds "
            "with each other, columns that are not there, nothing to compute. If nothing is, then the first that is wrong with the rest: files that are "
            "missing, damaged or have changed, a motion that leaves them. "
            "Only what shows in the sound itself, such as clipping, it cannot know. "
            "A scene without fault is reported on standard output as ok. The exit code is the worst of the scenes'.",
    .operands = "SCENE...",
    .least = 1,
    .most = -1,
    .options = options,
    .examples = "rasp check scrape.yaml\n"
                "rasp check scenes/*.yaml\n"
                "rasp check --set motion.rate='4 Hz' scrape.yaml\n",
    .run = check_run,
};
