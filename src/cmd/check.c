/* rasp check: what can be known to be wrong with a scene before anything is computed. */
#include <stdio.h>

#include "cmd/cmd.h"
#include "output/force_table.h"
#include "output/impact_rows.h"
#include "pipeline/inputs.h"
#include "pipeline/plan.h"
#include "pipeline/run.h"
#include "pipeline/stages.h"
#include "scene/scene_places.h"

/* Every contact has something to compute, and all that it needs. */
static bool check_plans(const struct scene *s, struct arena *a, struct err *e)
{
    struct plan p;
    for (int i = 0; i < s->n_contacts; i++)
        if (!plan_make(stages_table, &s->contacts[i], s, a, &p, e))
            return false;
    return true;
}

/* Every stage can begin: the files are what they should be, and the motion stays where they are valid. */
static bool check_opens(const struct scene *s, struct arena *a, struct err *e)
{
    struct table_sink rows = {fopen("/dev/null", "w")};
    struct impact_sink impacts = {rows.stream};
    struct plan p;
    struct run r;
    bool ok = rows.stream || err_set(e, ERR_IO, "/dev/null cannot be opened");
    for (int i = 0; ok && i < s->n_contacts; i++) {
        ok = plan_make(stages_table, &s->contacts[i], s, a, &p, e) && run_open(&r, &p, s, &(struct run_sinks){&rows, &impacts}, e);
        if (ok)
            run_close(&r);
    }
    if (rows.stream)
        fclose(rows.stream);
    return ok;
}

/* What a scene that has been read must pass, in this order. */
static bool (*const checks[])(const struct scene *, struct arena *, struct err *) = {inputs_check, check_plans, check_opens};

static bool check_scene(struct cmd_call *c, const char *file, struct err *e)
{
    struct scene s;
    if (!cmd_read_scene(c, file, &s, e))
        return false;
    for (size_t i = 0; i < sizeof checks / sizeof checks[0]; i++)
        if (!checks[i](&s, c->arena, e))
            return scene_places_tell(&s, e);
    return true;
}

static int check_run(struct cmd_call *c, struct err *e)
{
    int worst = 0;
    (void)e;
    for (int i = 0; i < c->args.n_operands; i++) {
        struct err mine = {0};
        const char *file = c->args.operands[i];
        if (check_scene(c, file, &mine))
            printf("%s: ok\n", file);
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
