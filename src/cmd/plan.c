/* rasp plan: what a scene would run, and why. */
#include "base/text.h"
#include "cmd/cmd.h"
#include "pipeline/plan_scene.h"
#include "pipeline/promise.h"
#include "scene/scene_places.h"

static const struct args_option plan_options[] = {
    CMD_SCENE_OPTIONS,
    {0},
};

static bool plan_one(struct cmd_call *c, const char *file, struct err *e)
{
    struct scene s, kept;
    struct promise promise;
    if (!cmd_read_scene(c, file, &s, e))
        return false;
    const struct plan *plans = promise_keep(&s, c->arena, &kept, &promise, e) ? plan_scene(&kept, c->arena, e) : NULL;
    for (int i = 0; plans && i < s.n_contacts; i++)
        plan_print(&plans[i], stdout);
    if (plans && promise.text)
        printf("%s\n", text_shown(c->arena, promise.text));
    return plans || scene_places_tell(&s, e);
}

static int plan_run(struct cmd_call *c, struct err *e)
{
    for (int i = 0; i < c->args.n_operands; i++)
        if (!plan_one(c, c->args.operands[i], e))
            return (int)e->kind;
    return 0;
}

const struct command plan_command = {
    .name = "plan",
    .summary = "shows which stages a scene runs, why, and at what predicted cost",
    .does = "Lists for each contact the stages that will run, in order, with what they read and make, their share of the predicted cost and the "
            "equations they follow; then those that will not run, and why not; where the scene asks for an error (accuracy.error), what knobs are chosen and what they are predicted to leave. Nothing is rendered, but all that "
            "the scene names is read, and what rasp check refuses is refused here, too.",
    .operands = "SCENE...",
    .least = 1,
    .most = -1,
    .options = plan_options,
    .examples = "rasp plan scenes/basswood_scrape.yaml\n"
                "rasp plan scenes/basswood_scrape.yaml --set scraper.weight=0\n",
    .run = plan_run,
};
