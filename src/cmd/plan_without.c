#include "cmd/plan_without.h"

#include <gsl/gsl_sort_double.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <string.h>

#include "base/stopwatch.h"
#include "output/force_table.h"
#include "output/impact_rows.h"
#include "pipeline/inputs.h"
#include "pipeline/plan.h"
#include "pipeline/run.h"
#include "pipeline/stages.h"
#include "scene/scene_read.h"
#include "scene/scene_write.h"
#include "trajectory/contact.h"

/* ------------------------------------------------------------------ effects

   An effect is what a setting takes away. One that leaves the effective scene as it is is not in it; one that makes the
   scene none, such as its only surface, cannot be left out. */

static const struct effect {
    const char *name, *without;
    bool whole; /* of the scene, not of a contact */
} effects[] = {
    {"limiter", "contact.limiter.curve=none", false},
    {"smoothing", "contact.smoothing=0", false},
    {"variation of the normal force", "ablation.normal_force=constant", false},
    {"horizontal force", "contact.beta1=0", false},
    {"lowering and raising", "load.approach=0;load.release=0", false},
    {"round tip", "scraper.radius=null", false},
    {"ridges", "surface.ridges=null", false},
    {"grit", "surface.grit=null", false},
    {"roughness beside another surface", "surface.roughness=null", false},
    {"height map beside another surface", "surface.height_map=null", false},
    {"continuation", "surface.continuation=null", false},
    {"plane, in place of the path", "surface.along=path", false},
    {"gesture", "contact.gesture=null", false},
    {"modulation", "contact.modulation=null", false},
    {"comb", "contact.comb=null", false},
    {"enhancement", "contact.enhance=null", false},
    {"ball off its centre", "ball.offset=0", false},
    {"lobes of the ball", "ball.lobe_height=0", false},
    {"slip of the ball", "contact.roll.scraping=0", false},
    {"ground that gives way", "contact.roll.ground=rigid", false},
    {"response by place", "ablation.response=constant", true},
    {"scraper's response", "scraper.weight=0", false},
    {"ball's response", "ball.weight=0", false},
    {"soft onset of the modes", "surface.gammatone=1", false},
    {"residual", "surface.residual_gain=0", false},
    {"listening place", "output.listen=null", true},
    {"envelope", "output.envelope=none", true},
    {"stems", "output.stems=null", true},
    {"diagnostics", "output.diagnostics=null", true},
    {"list of impacts", "output.impacts=none", true},
    {"contact", "gain=0", false},
};

enum { EFFECTS = sizeof effects / sizeof *effects, SETTINGS = 4, PASSES = 7 };
static const double longest = 1.0; /* s of each contact that are run to be measured */

struct variant {
    const char *name, *set; /* set: as of --set */
    struct scene scene;
    double cycles; /* a sample, of all contacts, as predicted */
    double seconds[PASSES];
};

/* ------------------------------------------------------------------ costs */

static bool predicted(struct variant *v, struct arena *a, struct err *e)
{
    struct plan_scene_estimate x;
    bool ok = plan_scene(&v->scene, a, &x, e);
    v->cycles = 0.0;
    for (int i = 0; ok && i < v->scene.n_contacts; i++)
        for (int k = 0; k < x.plans[i].n; k++)
            v->cycles += x.plans[i].rows[k].verdict == PLAN_RUNS ? x.plans[i].rows[k].work : 0.0;
    return ok;
}

/* CPU time of the stages of all contacts, of what runs block by block: to the motion's end, and `longest` at most. */
static bool measure(const struct variant *v, double *seconds, struct err *e)
{
    struct arena *a = arena_open();
    bool ok = inputs_check(&v->scene, a, e);
    *seconds = 0.0;
    for (int i = 0; ok && i < v->scene.n_contacts; i++) {
        struct plan p;
        struct run r;
        if (!plan_targets(&v->scene.contacts[i], &v->scene)) continue;
        struct run_sinks sinks = {.table = &(struct table_sink){.stream = fopen("/dev/null", "w")},
                                  .listing = &(struct impact_sink){.stream = fopen("/dev/null", "w")}};
        ok = plan_make(stages_table, &v->scene.contacts[i], &v->scene, a, &p, e) &&
             run_open(&r, &p, &v->scene, &sinks, e);
        if (!ok) break;
        double before = stopwatch_cpu();
        long end = (long)fmin((double)r.board.moving, longest * r.board.rate);
        for (long to = 0; ok && to < end;) {
            to = to + STAGE_BLOCK < end ? to + STAGE_BLOCK : end;
            ok = run_block(&r, to, e);
        }
        *seconds += stopwatch_cpu() - before;
        run_close(&r);
        fclose(sinks.table->stream);
        fclose(sinks.listing->stream);
    }
    arena_close(a);
    return ok;
}

/* ------------------------------------------------------------------ the scene without */

/* The scene with those settings besides, knobs as they were chosen; false: it is none, or the same. */
static bool without(struct cmd_call *c, const char *file, const struct scene *chosen, const char *prefix,
                    const struct effect *f, struct variant *v)
{
    struct arena *a = c->arena;
    int n;
    const char **given = args_values(&c->args, "set", &n), *messages, *all[SETTINGS];
    const char **set = ARENA_TAKE(a, const char *, n + SETTINGS);
    struct scene_overrides over = {.set = set, .n = n, .seed = args_value(&c->args, "seed")};
    struct err none = {0};
    char *rest = arena_text(a, f->without);
    if (n) memcpy(set, given, (size_t)n * sizeof *set);
    for (int i = 0; i < SETTINGS && (all[i] = strsep(&rest, ";")); i++)
        set[over.n++] = arena_format(a, "%s%s", f->whole ? "" : prefix, all[i]);
    v->name = f->name;
    v->set = set[n];
    for (int i = n + 1; i < over.n; i++)
        v->set = arena_format(a, "%s; %s", v->set, set[i]);
    if (!scene_read(file, &over, a, &v->scene, &messages, &none)) return false;
    v->scene.accuracy = chosen->accuracy;
    return strcmp(scene_write(&v->scene, ".", a), scene_write(chosen, ".", a)) != 0 && predicted(v, a, &none);
}

/* ------------------------------------------------------------------ the report */

/* Median and quartiles of what a render takes longer with than without. */
static void more(const struct variant *with, const struct variant *v, double out[3])
{
    double x[PASSES];
    for (int i = 0; i < PASSES; i++)
        x[i] = with->seconds[i] - v->seconds[i];
    gsl_sort(x, 1, PASSES);
    for (int i = 0; i < 3; i++)
        out[i] = gsl_stats_quantile_from_sorted_data(x, 1, PASSES, i == 0 ? 0.5 : i == 1 ? 0.25 : 0.75);
}

/* shown: as text. */
static void row(struct report *r, const struct variant *with, const struct variant *v, bool measured, bool shown)
{
    double by = with->cycles - v->cycles, seconds[3], whole[PASSES];
    report_set(r, ":{ effect:s without:s cycles_per_sample:n more_cycles_per_sample:n", v->name, v->set, v->cycles, by);
    if (shown)
        report_text(r, "  %-34s %9.0f %9.0f %+9.0f %5.1f %%", v->name, v->cycles, with->cycles, by,
                    with->cycles > 0.0 ? 100.0 * by / with->cycles : 0.0);
    if (measured) {
        more(with, v, seconds);
        memcpy(whole, with->seconds, sizeof whole);
        double median = gsl_stats_median(whole, 1, PASSES);
        report_set(r, "more_s:n more_quartiles_s:[ :n :n ]", seconds[0], seconds[1], seconds[2]);
        report_text(r, " %+9.2f (%+.2f to %+.2f) %6.1f %%", 1e3 * seconds[0], 1e3 * seconds[1], 1e3 * seconds[2],
                    median > 0.0 ? 100.0 * seconds[0] / median : 0.0);
    }
    report_set(r, "}");
    if (shown) report_text(r, "  %s\n", v->set);
}

bool plan_without(struct cmd_call *c, const char *file, const struct scene *chosen, bool measured, struct report *r,
                  struct err *e)
{
    struct variant with = {.scene = *chosen}, *all = ARENA_TAKE(c->arena, struct variant, EFFECTS * chosen->n_contacts);
    int n = 0;
    if (!predicted(&with, c->arena, e)) return false;
    for (int k = 0; k < chosen->n_contacts; k++) {
        const char *name = chosen->contacts[k].name,
                   *prefix = chosen->n_contacts > 1 ? arena_format(c->arena, "contacts.%s.", name) : "";
        for (int i = 0; i < EFFECTS; i++) {
            bool last = i == EFFECTS - 1;
            if ((effects[i].whole && k > 0) || (last && chosen->n_contacts == 1)) continue;
            if (!without(c, file, chosen, prefix, &effects[i], &all[n])) continue;
            if (chosen->n_contacts > 1 && !effects[i].whole)
                all[n].name = arena_format(c->arena, last ? "%s %s" : "%s, %s", all[n].name, name);
            n++;
        }
    }
    for (int pass = 0; measured && pass < PASSES; pass++) {
        if (!measure(&with, &with.seconds[pass], e)) return false;
        for (int i = 0; i < n; i++)
            if (!measure(&all[i], &all[i].seconds[pass], e)) return false;
    }
    int costly = 0;
    for (int i = 0; i < n; i++)
        costly += all[i].cycles != with.cycles || measured;
    report_text(r, "%s: %.0f cycles a sample; %s\n", file, with.cycles,
                costly ? "without each effect:" : "no effect of it has a cost of its own");
    if (costly)
        report_text(r, "  %-34s %9s %9s %9s %7s%s  %s\n", "effect", "without", "with", "more", "share",
                    measured ? "  measured, ms (quartiles), share" : "", "--set");
    const char *free_of = NULL;
    report_set(r, "$:[", "without");
    for (int i = 0; i < n; i++) {
        bool costs = all[i].cycles != with.cycles || measured;
        row(r, &with, &all[i], measured, costs);
        if (!costs) free_of = free_of ? arena_format(c->arena, "%s; %s", free_of, all[i].name) : all[i].name;
    }
    report_set(r, "]");
    if (free_of) report_note(r, "  no predicted cost: ", free_of);
    return true;
}
