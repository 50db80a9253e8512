/* rasp plan: what a scene would run, and why. */
#include "base/text.h"
#include "cmd/cmd.h"
#include "cmd/tell.h"
#include "cmd/plan_json.h"
#include "pipeline/plan_scene.h"
#include "pipeline/promise.h"
#include "scene/scene_places.h"

static const struct args_option plan_options[] = {
    CMD_SCENE_OPTIONS,
    {"json", 'j', NULL, false, "print the plans as JSON, an array with an object for each scene: contacts, their stages, costs in cycles per audio sample"},
    {0},
};

static void plan_text(struct cmd_call *c, const struct scene *s, const struct plan *plans, const struct promise *promise)
{
    for (int i = 0; i < s->n_contacts; i++)
        plan_print(&plans[i], stdout);
    if (promise->text)
        printf("%s\n", text_shown(c->arena, promise->text));
}

/* rows: NULL: text. */
static bool plan_one(struct cmd_call *c, const char *file, json_t *rows, struct err *e)
{
    struct scene s, kept;
    struct promise promise;
    const char **warnings = NULL;
    if (!cmd_read_scene(c, file, &s, e))
        return false;
    const struct plan *plans = promise_keep(&s, c->arena, &kept, &promise, e) ? plan_scene(&kept, c->arena, &warnings, e) : NULL;
    for (int i = 0; plans && i < s.n_contacts; i++)
        if (!plan_known(&plans[i], e))
            return false;
    if (!plans)
        return scene_places_tell(&s, e);
    for (int i = 0; warnings[i]; i++)
        tell_warning(c, file, warnings[i]);
    if (rows)
        json_array_append_new(rows, plan_json(&s, plans, promise.text));
    else
        plan_text(c, &s, plans, &promise);
    return true;
}

static int plan_run(struct cmd_call *c, struct err *e)
{
    json_t *rows = args_given(&c->args, "json") ? json_array() : NULL;
    bool ok = true;
    for (int i = 0; ok && i < c->args.n_operands; i++)
        ok = plan_one(c, c->args.operands[i], rows, e);
    if (rows && ok) {
        json_dumpf(rows, stdout, JSON_INDENT(2));
        putchar('\n');
    }
    json_decref(rows);
    return (int)e->kind;
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
                "rasp plan scenes/basswood_scrape.yaml --set scraper.weight=0\n"
                "rasp plan --json scenes/basswood_scrape.yaml\n",
    .run = plan_run,
};
