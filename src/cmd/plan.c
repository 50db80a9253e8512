/* rasp plan: what a scene would run, and why. As JSON it has what the text has, stage by stage in the order of the
 * table; cost in cycles per audio sample. */
#include <jansson.h>

#include "base/text.h"
#include "cmd/cmd.h"
#include "cmd/tell.h"
#include "pipeline/plan.h"
#include "pipeline/plan_scene.h"
#include "pipeline/promise.h"
#include "scene/ablation.h"
#include "scene/keys.h"
#include "scene/scene_places.h"

static json_t *stage(const struct plan *p, const struct plan_row *r);

static json_t *text_or_null(const char *s)
{
    json_t *j = s && *s ? json_string(s) : NULL;
    return j ? j : json_null();
}

static json_t *items(unsigned set)
{
    json_t *all = json_array();
    for (int i = 0; i < ITEM_COUNT; i++)
        if (set & ITEM_BIT(i)) json_array_append_new(all, json_string(plan_item((enum item)i)));
    return all;
}

static json_t *knobs(unsigned set)
{
    json_t *all = json_array();
    for (int k = 0; k < KNOBS; k++)
        if (set & 1u << k) json_array_append_new(all, json_string(keys_knobs[k].name));
    return all;
}

static const char *why_not(const struct plan_row *r)
{
    if (r->verdict == PLAN_RUNS) return NULL;
    return r->verdict == PLAN_UNWANTED ? r->stage->idle : "nothing that is asked for needs it";
}

static json_t *stage(const struct plan *p, const struct plan_row *r)
{
    bool runs = r->verdict == PLAN_RUNS;
    return json_pack("{s:s, s:b, s:o, s:s, s:o, s:o, s:o, s:o, s:o}", "name", r->stage->name, "runs", runs, "why_not",
                     text_or_null(why_not(r)), "does", r->stage->does, "equations", text_or_null(r->stage->paper),
                     "reads", items(runs ? r->reads & p->alive : 0), "gives",
                     items(runs ? r->stage->gives & p->alive : 0), "cycles_per_sample",
                     runs ? json_real(r->work) : json_null(), "knobs", knobs(runs ? r->knobs : 0));
}

static json_t *contact(const struct plan *p)
{
    struct arena *a = arena_open();
    json_t *stages = json_array(), *o;
    double whole = 0;
    for (int i = 0; i < p->n; i++) {
        json_array_append_new(stages, stage(p, &p->rows[i]));
        whole += p->rows[i].verdict == PLAN_RUNS ? p->rows[i].work : 0;
    }
    o = json_pack("{s:o, s:o, s:f, s:o, s:o, s:o}", "name", text_or_null(p->contact->name), "targets",
                  items(p->targets), "cycles_per_sample", whole, "knobs", knobs(plan_knobs(p)), "ablation",
                  text_or_null(ablation_text(p->contact, a)), "stages", stages);
    arena_close(a);
    return o;
}

/* plans: [s->n_contacts]; promise: what accuracy.error chose, as text, NULL: nothing was asked. */
static json_t *plan_json(const struct scene *s, const struct plan *plans, const char *promise)
{
    json_t *contacts = json_array();
    for (int i = 0; i < s->n_contacts; i++)
        json_array_append_new(contacts, contact(&plans[i]));
    return json_pack("{s:o, s:o, s:o}", "file", text_or_null(s->file), "accuracy", text_or_null(promise), "contacts",
                     contacts);
}

static const struct args_option plan_options[] = {
    CMD_SCENE_OPTIONS,
    {"json", 'j', NULL, false,
     "print the plans as JSON, an array with an object for each scene: contacts, their stages, costs in cycles per "
     "audio sample"},
    {0},
};

/* rows: NULL: text. */
static bool plan_one(struct cmd_call *c, const char *file, json_t *rows, struct err *e)
{
    struct scene s, kept;
    struct promise promise;
    const char **warnings = NULL;
    if (!cmd_read_scene(c, file, &s, e)) return false;
    const struct plan *plans =
        promise_keep(&s, c->arena, &kept, &promise, e) ? plan_scene(&kept, c->arena, &warnings, e) : NULL;
    for (int i = 0; plans && i < s.n_contacts; i++)
        if (!plan_known(&plans[i], e)) return false;
    if (!plans) return scene_places_tell(&s, e);
    for (int i = 0; warnings[i]; i++)
        tell_warning(c, file, warnings[i]);
    if (rows)
        json_array_append_new(rows, plan_json(&s, plans, promise.text));
    else {
        for (int i = 0; i < s.n_contacts; i++)
            plan_print(&plans[i], stdout);
        if (promise.text) printf("%s\n", text_shown(c->arena, promise.text));
    }
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
    .does = "Lists for each contact the stages that will run, in order, with what they read and make, their share of "
            "the predicted cost and the "
            "equations they follow; then those that will not run, and why not; where the scene asks for an error "
            "(accuracy.error), what knobs are chosen and what they are predicted to leave. Nothing is rendered, but "
            "all that "
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
