/* rasp plan: what a scene would run, and why. */
#include "pipeline/plan.h"

#include "cmd/cmd.h"
#include "pipeline/stages.h"
#include "scene/scene_places.h"

static const struct args_option plan_options[] = {
    CMD_SCENE_OPTIONS,
    {0},
};

static int plan_run(struct cmd_call *c, struct err *e)
{
    for (int i = 0; i < c->args.n_operands; i++) {
        struct scene s;
        if (!cmd_read_scene(c, c->args.operands[i], &s, e))
            return (int)e->kind;
        for (int k = 0; k < s.n_contacts; k++) {
            struct plan p;
            if (!plan_make(stages_table, &s.contacts[k], &s, c->arena, &p, e)) {
                scene_places_tell(&s, e);
                return (int)e->kind;
            }
            plan_print(&p, stdout);
        }
    }
    return 0;
}

const struct command plan_command = {
    .name = "plan",
    .summary = "shows which stages a scene runs, why, and at what predicted cost",
    .does = "Lists for each contact the stages that will run, in order, with what they read and make, their share of the predicted cost and the "
            "equations they follow; then those that will not run, and why not. Nothing is rendered; of the inputs only mode "
            "tables and recorded motions are read, where the plan depends on them.",
    .operands = "SCENE...",
    .least = 1,
    .most = -1,
    .options = plan_options,
    .examples = "rasp plan scenes/basswood_scrape.yaml\n"
                "rasp plan scenes/basswood_scrape.yaml --set scraper.weight=0\n",
    .run = plan_run,
};
