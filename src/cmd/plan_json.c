/* See plan_json.h: what rasp plan prints, stage by stage in the order of the table; cost in cycles per audio sample. */
#include "cmd/plan_json.h"

#include "scene/ablation.h"
#include "scene/keys.h"

static json_t *text_or_null(const char *s)
{
    json_t *j = s && *s ? json_string(s) : NULL;
    return j ? j : json_null();
}

static json_t *items(unsigned set)
{
    json_t *all = json_array();
    for (int i = 0; i < ITEM_COUNT; i++)
        if (set & ITEM_BIT(i))
            json_array_append_new(all, json_string(plan_item((enum item)i)));
    return all;
}

static json_t *knobs(unsigned set)
{
    json_t *all = json_array();
    for (int k = 0; k < KNOBS; k++)
        if (set & 1u << k)
            json_array_append_new(all, json_string(keys_knobs[k].name));
    return all;
}

static const char *why_not(const struct plan_row *r)
{
    if (r->verdict == PLAN_RUNS)
        return NULL;
    return r->verdict == PLAN_UNWANTED ? r->stage->idle : "nothing that is asked for needs it";
}

static json_t *stage(const struct plan *p, const struct plan_row *r)
{
    bool runs = r->verdict == PLAN_RUNS;
    return json_pack("{s:s, s:b, s:o, s:s, s:o, s:o, s:o, s:o, s:o}", "name", r->stage->name, "runs", runs, "why_not", text_or_null(why_not(r)), "does",
                     r->stage->does, "equations", text_or_null(r->stage->paper), "reads", items(runs ? r->reads & p->alive : 0), "gives",
                     items(runs ? r->stage->gives & p->alive : 0), "cycles_per_sample", runs ? json_real(r->work) : json_null(), "knobs",
                     knobs(runs ? r->knobs : 0));
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
    o = json_pack("{s:o, s:o, s:f, s:o, s:o, s:o}", "name", text_or_null(p->contact->name), "targets", items(p->targets), "cycles_per_sample", whole, "knobs",
                  knobs(plan_knobs(p)), "ablation", text_or_null(ablation_text(p->contact, a)), "stages", stages);
    arena_close(a);
    return o;
}

json_t *plan_json(const struct scene *s, const struct plan *plans, const char *promise)
{
    json_t *contacts = json_array();
    for (int i = 0; i < s->n_contacts; i++)
        json_array_append_new(contacts, contact(&plans[i]));
    return json_pack("{s:o, s:o, s:o}", "file", text_or_null(s->file), "accuracy", text_or_null(promise), "contacts", contacts);
}
