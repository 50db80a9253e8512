/* See plan_scene.h. The parts of a render are opened and closed again; what they write into their tables goes nowhere. */
#include "pipeline/plan_scene.h"

#include "base/memory.h"
#include "output/sound.h"
#include "pipeline/inputs.h"
#include "pipeline/render_parts.h"
#include "scene/accuracy.h"
#include "scene/keys.h"

static bool open_part(const struct scene *s, struct render_part *one, FILE *nowhere, struct err *e)
{
    one->rows.stream = one->impacts.stream = nowhere;
    if (!one->plan.targets)
        return true;
    one->open = run_open(&one->run, &one->plan, s, &(struct run_sinks){&one->rows, &one->impacts}, e);
    return one->open;
}

/* quantity: as of struct plan_scene_estimate. */
static bool open_parts(struct render_parts *p, struct render_length *length, int *quantity, struct err *e)
{
    FILE *nowhere = memory_fopen("/dev/null", "w");
    bool ok = nowhere || err_set(e, ERR_IO, "/dev/null cannot be opened");
    for (int i = 0; ok && i < p->scene->n_contacts; i++)
        ok = open_part(p->scene, &p->parts[i], nowhere, e);
    ok = ok && render_parts_agree(p, e) && render_parts_length(p, length, e);
    *quantity = ok ? render_parts_quantity(p) : -1;
    render_parts_close(p);
    if (nowhere)
        fclose(nowhere);
    return ok;
}

const struct plan *plan_scene(const struct scene *s, struct arena *a, struct err *e)
{
    struct render_parts p = render_parts_make(s, "", a);
    struct plan *plans = ARENA_TAKE(a, struct plan, s->n_contacts);
    struct render_length length;
    int quantity;
    if (!inputs_check(s, a, e) || !render_parts_plan(&p, e) || !open_parts(&p, &length, &quantity, e) || (p.asked & ITEM_BIT(ITEM_SOUND) && !sound_long_enough(s, length.frames, e)))
        return NULL;
    for (int i = 0; i < s->n_contacts; i++)
        plans[i] = p.parts[i].plan;
    return plans;
}

bool plan_scene_estimate(const struct scene *s, struct arena *a, struct plan_scene_estimate *x, struct err *e)
{
    struct render_parts p = render_parts_make(s, "", a);
    if (!inputs_check(s, a, e) || !render_parts_plan(&p, e) || !open_parts(&p, &x->length, &x->quantity, e))
        return false;
    x->cycles = 0;
    x->sounds = p.asked & ITEM_BIT(ITEM_SOUND);
    for (int i = 0; i < s->n_contacts; i++)
        for (int k = 0; k < p.parts[i].plan.n; k++)
            x->cycles += p.parts[i].plan.rows[k].verdict == PLAN_RUNS ? p.parts[i].plan.rows[k].work * (double)x->length.frames : 0;
    return true;
}

static bool add_knobs(const struct scene *s, struct arena *a, unsigned *knobs, struct err *e)
{
    struct render_parts p = render_parts_make(s, "", a);
    bool ok = render_parts_plan(&p, e);
    for (int i = 0; ok && i < s->n_contacts; i++)
        *knobs |= plan_knobs(&p.parts[i].plan);
    return ok;
}

bool plan_scene_knobs(const struct scene *s, struct arena *a, unsigned *knobs, struct err *e)
{
    *knobs = 0;
    if (!inputs_check(s, a, e) || !add_knobs(s, a, knobs, e))
        return false;
    for (int i = 0; keys_presets[i]; i++) {
        struct scene other = *s;
        struct err refused = {0};
        accuracy_preset(&other.accuracy, keys_presets[i]);
        add_knobs(&other, a, knobs, &refused);
    }
    return true;
}
