/* rasp plan: what a scene would run, and why. As JSON it has what the text has, stage by stage in the order of the
 * table; cost in cycles per audio sample. */
#include <math.h>

#include "base/text.h"
#include "cmd/cmd.h"
#include "cmd/message.h"
#include "cmd/plan_without.h"
#include "cmd/report.h"
#include "pipeline/error_budget.h"
#include "pipeline/plan.h"
#include "scene/keys.h"
#include "scene/scene_places.h"
#include "trajectory/contact.h"

/* Names of bits [0, n) of a set. */
static void set_names(struct report *r, const char *key, unsigned set, int n, const char *(*name)(int i))
{
    report_set(r, "$:[", key);
    for (int i = 0; i < n; i++)
        if (set & 1u << i) report_set(r, ":s", name(i));
    report_set(r, "]");
}

static const char *item_name(int i) { return plan_item((enum item)i); }

static const char *knob_name(int i) { return keys_knobs[i].name; }

static const struct args_option plan_options[] = {
    CMD_SCENE_OPTIONS,
    {"json", 'j', NULL, false,
     "print the plans as JSON, an array with an object for each scene: contacts, their stages, costs in cycles per "
     "audio sample"},
    {"without", 0, NULL, false,
     "print, in place of the plan, what each effect of the scene costs: predicted with and without, and the setting "
     "that leaves it out"},
    {"measure", 0, NULL, false, "with --without: renders a second at most of each, too, and measures it"},
    {0},
};

static bool plan_one(struct cmd_call *c, const char *file, struct report *r, struct err *e)
{
    struct scene s, chosen;
    struct error_budget error_budget;
    const char **warnings = NULL;
    if (!cmd_read_scene(c, file, &s, e)) return false;
    const struct plan *plans = error_budget_apply(&s, c->arena, &chosen, &error_budget, e)
                                   ? plan_scene(&chosen, c->arena, &warnings, e)
                                   : NULL;
    for (int i = 0; plans && i < s.n_contacts; i++)
        if (!plan_known(&plans[i], e)) return false;
    if (!plans) return scene_places_report(&s, e);
    for (int i = 0; warnings[i]; i++)
        message_warning(c, file, warnings[i]);
    report_set(r, ":{ file:e accuracy:e contacts:[", s.file, error_budget.text);
    for (int i = 0; i < s.n_contacts; i++) {
        const struct plan *p = &plans[i];
        double whole = 0;
        for (int k = 0; k < p->n; k++)
            whole += p->rows[k].verdict == PLAN_RUNS ? p->rows[k].work : 0;
        report_set(r, ":{ name:e", p->contact->name);
        set_names(r, "targets", p->targets, ITEM_COUNT, item_name);
        report_set(r, "cycles_per_sample:n", whole);
        set_names(r, "knobs", plan_knobs(p), KNOBS, knob_name);
        report_set(r, "ablation:e stages:[", contact_ablation(p->contact, c->arena));
        for (const struct plan_row *row = p->rows; row < p->rows + p->n; row++) {
            bool runs = row->verdict == PLAN_RUNS;
            const char *why = runs                            ? NULL
                              : row->verdict == PLAN_UNWANTED ? row->stage->idle
                                                              : "nothing that is asked for needs it";
            report_set(r, ":{ name:s runs:b why_not:e does:s equations:e", row->stage->name, runs, why,
                       row->stage->does, row->stage->paper);
            set_names(r, "reads", runs ? row->reads & p->alive : 0, ITEM_COUNT, item_name);
            set_names(r, "gives", runs ? row->stage->gives & p->alive : 0, ITEM_COUNT, item_name);
            report_set(r, "cycles_per_sample:n", runs ? row->work : NAN);
            set_names(r, "knobs", runs ? row->knobs : 0, KNOBS, knob_name);
            report_set(r, "}");
        }
        report_set(r, "] }");
        if (!r->json && !args_given(&c->args, "without")) plan_print(p, r->out);
    }
    report_set(r, "]");
    if (args_given(&c->args, "without") && !plan_without(c, file, &chosen, args_given(&c->args, "measure"), r, e))
        return false;
    report_set(r, "}");
    if (error_budget.text) report_text(r, "%s\n", text_shown(c->arena, error_budget.text));
    return true;
}

static int plan_run(struct cmd_call *c, struct err *e)
{
    if (args_given(&c->args, "measure") && !args_given(&c->args, "without"))
        return err_set(e, ERR_USAGE, "--measure is for --without"), (int)e->kind;
    struct report r = report_open_list(stdout, args_given(&c->args, "json"));
    bool ok = true;
    for (int i = 0; ok && i < c->args.n_operands; i++)
        ok = plan_one(c, c->args.operands[i], &r, e);
    if (ok)
        report_close(&r, 0, e);
    else
        json_decref(r.open.at[0]);
    return (int)e->kind;
}

const struct command plan_command = {
    .name = "plan",
    .summary = "shows which stages a scene runs, why, and at what predicted cost",
    .does =
        "Lists for each contact the stages that will run, in order, with what they read and make, their share of the "
        "predicted cost and the equations they follow; then those that will not run, and why not; where the scene asks "
        "for an error (accuracy.error), what knobs are chosen and what they are predicted to leave. Nothing is "
        "rendered, but all that the scene names is read, and what rasp check refuses is refused here, too.",
    .operands = "SCENE...",
    .least = 1,
    .most = -1,
    .options = plan_options,
    .examples = "rasp plan scenes/basswood_scrape.yaml\n"
                "rasp plan scenes/basswood_scrape.yaml --set scraper.weight=0\n"
                "rasp plan --json scenes/basswood_scrape.yaml\n"
                "rasp plan --without scenes/basswood_scrape.yaml\n",
    .run = plan_run,
};
