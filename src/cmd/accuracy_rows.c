/* What `rasp accuracy` renders: the presets, the scene as it is, and each knob's values, each once with all other knobs at `reference` (what it spoils alone) and
   once as the scene has them (what it costs). Knobs that turn nothing are left as they are, so that settings which differ in those are one. */
#include <math.h>
#include <string.h>

#include "cmd/accuracy.h"
#include "num/real.h"
#include "scene/accuracy.h"
#include "scene/keys.h"

enum { PRESETS = 4 };

double accuracy_rows_fine(int knob, double value)
{
    return (keys_knobs[knob].scale == KEY_STEPS ? 1 : -1) * real_log(value) / real_log(2.0);
}

static bool same(const struct accuracy_sweep *s, const struct accuracy *x, const struct accuracy *y)
{
    for (int k = 0; k < KNOBS; k++)
        if (s->knobs & 1u << k && accuracy_knob(x, (enum knob)k) != accuracy_knob(y, (enum knob)k))
            return false;
    return true;
}

static int render_of(struct accuracy_sweep *s, const struct accuracy *set, bool timed)
{
    int i = 0;
    while (i < s->n_renders && !same(s, &s->renders[i].set, set))
        i++;
    if (i == s->n_renders)
        s->renders[s->n_renders++] = (struct accuracy_render){.set = *set, .cpu = HUGE_VAL, .contact_share = NAN};
    s->renders[i].timed |= timed;
    return i;
}

static struct accuracy_row *row_add(struct accuracy_sweep *s, int knob, const char *name, const char *value)
{
    struct accuracy_row *r = &s->rows[s->n_rows++];
    *r = (struct accuracy_row){.knob = knob, .name = name, .value = value, .alone = -1, .fine = NAN, .order = NAN};
    return r;
}

static void add_presets(struct accuracy_sweep *s)
{
    bool met = false;
    for (int i = 0; keys_presets[i]; i++) {
        struct accuracy set = s->scene.accuracy;
        accuracy_preset(&set, keys_presets[i]);
        struct accuracy_row *r = row_add(s, -1, "preset", keys_presets[i]);
        r->total = render_of(s, &set, true);
        r->chosen = same(s, &set, &s->scene.accuracy);
        met |= r->chosen;
    }
    if (met)
        return;
    struct accuracy_row *r = row_add(s, -1, "scene", "");
    r->total = render_of(s, &s->scene.accuracy, true);
    r->chosen = true;
}

/* Presets' values and those given, coarse to fine, each once. */
static int values_of(int knob, const struct accuracy_values *given, double *x)
{
    int n = 0;
    double sign = keys_knobs[knob].scale == KEY_STEPS ? 1.0 : -1.0;
    for (int i = 0; i < PRESETS + given->n; i++) {
        double v = i < PRESETS ? keys_knobs[knob].preset[i] : given->x[i - PRESETS];
        int at = 0;
        while (at < n && sign * x[at] < sign * v)
            at++;
        if (at < n && x[at] == v)
            continue;
        memmove(x + at + 1, x + at, (size_t)(n - at) * sizeof *x);
        x[at] = v;
        n++;
    }
    return n;
}

static void add_knob(struct accuracy_sweep *s, int knob, const struct accuracy_values *given)
{
    double x[PRESETS + ACCURACY_VALUES];
    int n = values_of(knob, given, x);
    for (int i = 0; i < n; i++) {
        struct accuracy alone = s->renders[s->reference].set, all = s->scene.accuracy;
        struct accuracy_row *r = row_add(s, knob, keys_knobs[knob].name, arena_format(s->call->arena, "%.9g", x[i]));
        accuracy_turn(&alone, (enum knob)knob, x[i]);
        accuracy_turn(&all, (enum knob)knob, x[i]);
        r->alone = render_of(s, &alone, false);
        r->total = render_of(s, &all, true);
        r->chosen = x[i] == accuracy_knob(&s->scene.accuracy, (enum knob)knob);
        r->fine = accuracy_rows_fine(knob, x[i]);
    }
}

static int preset_render(struct accuracy_sweep *s, const char *preset)
{
    struct accuracy set = s->scene.accuracy;
    accuracy_preset(&set, preset);
    return render_of(s, &set, true);
}

void accuracy_rows(struct accuracy_sweep *s, const struct accuracy_values *own)
{
    int most = PRESETS + 1;
    for (int k = 0; k < KNOBS; k++)
        most += PRESETS + own[k].n;
    s->rows = ARENA_TAKE(s->call->arena, struct accuracy_row, most);
    s->renders = ARENA_TAKE(s->call->arena, struct accuracy_render, 2 * most + 2);
    s->reference = preset_render(s, "reference"); /* rendered first: the others are compared with it */
    s->high = preset_render(s, "high");           /* then this, which shows until when that means anything */
    add_presets(s);
    for (int k = 0; k < KNOBS && !s->presets; k++)
        if (s->knobs & 1u << k)
            add_knob(s, k, &own[k]);
}

const char *accuracy_rows_name(const struct accuracy_sweep *s, int render)
{
    for (int i = 0; i < s->n_rows; i++) {
        const struct accuracy_row *r = &s->rows[i];
        if (r->total == render || r->alone == render)
            return arena_format(s->call->arena, "%s%s%s%s", r->name, *r->value ? " " : "", r->value, r->total == render ? "" : ", else reference");
    }
    return "the scene";
}
