/* rasp plan: what a scene would run, and why. As JSON it has what the text has, stage by stage in the order of the
 * table; cost in cycles. */
#include <math.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "base/outfile.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "cmd/cmd.h"
#include "cmd/message.h"
#include "cmd/plan_without.h"
#include "cmd/report.h"
#include "num/real.h"
#include "pipeline/error_budget.h"
#include "pipeline/plan.h"
#include "pipeline/render.h"
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
     "print the plans as JSON, an array with an object for each scene: contacts, their stages, costs in cycles"},
    {"without", 0, NULL, false,
     "print, in place of the plan, what each effect of the scene costs: predicted with and without, and the setting "
     "that leaves it out"},
    {"measure", 0, NULL, false,
     "renders the scene, too, leaving no file, and puts the measured beside the predicted; with --without: a second at "
     "most of each"},
    {0},
};

/* ------------------------------------------------------------------ measured */

struct measured { /* CPU s of one render of the whole scene, without a file that is left */
    bool given;
    double clock; /* Hz */
    struct render_report report;
    double beside[PLAN_BESIDE];
};

/* The core's clock: a chain of multiplications of integers, each of which waits 3 cycles for the one before. */
static double core_clock(void)
{
    enum { CHAIN = 3000000 };
    unsigned long x = 3;
    double least = HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        double start = stopwatch_cpu();
        for (int i = 0; i < CHAIN; i++) {
            x *= 6364136223846793005u;
            __asm__ volatile("" : "+r"(x));
        }
        least = fmin(least, stopwatch_cpu() - start);
    }
    return 3.0 * CHAIN / least;
}

static bool measure(const struct scene *s, const struct plan_scene_estimate *x, struct arena *a, struct measured *m,
                    struct err *e)
{
    const char *folder = outfile_scratch_make_folder("rasp-plan", a, e),
               *base = folder ? arena_format(a, "%s/x", folder) : NULL;
    struct render *r = folder ? render_make(s, &(struct render_names){.base = base}, a, &m->report, e) : NULL;
    double stages = 0;
    if (r) render_drop(r);
    if (folder) rmdir(folder);
    if (folder) interrupt_forget(folder);
    if (!r) return false;
    const struct render_time *t = m->report.times;
    for (int i = 0; i < s->n_contacts; i++)
        for (int k = 0; k < x->plans[i].n; k++)
            if (x->plans[i].targets && x->plans[i].rows[k].verdict == PLAN_RUNS) stages += t++->all;
    m->given = true;
    m->clock = core_clock();
    m->beside[PLAN_CHOOSES] = m->report.error_budget.cpu - m->report.error_budget.read[0];
    m->beside[PLAN_READS] = m->report.planned + m->report.error_budget.read[0];
    m->beside[PLAN_WRITES] = fmax(0, m->report.cpu - m->beside[PLAN_CHOOSES] - m->beside[PLAN_READS] - stages);
    return true;
}

/* ------------------------------------------------------------------ the report */

static const struct render_time *contact_report(struct report *r, const struct plan *p, const struct measured *m,
                                                const struct render_time *time, struct arena *a)
{
    double whole = 0, once = 0;
    for (int k = 0; k < p->n; k++) {
        whole += p->rows[k].work;
        once += p->rows[k].once;
    }
    report_set(r, ":{ name:e", p->contact->name);
    set_names(r, "targets", p->targets, ITEM_COUNT, item_name);
    report_set(r, "cycles_per_sample:n cycles_once:n", whole, once);
    set_names(r, "knobs", plan_knobs(p), KNOBS, knob_name);
    report_set(r, "ablation:e stages:[", contact_ablation(p->contact, a));
    for (const struct plan_row *row = p->rows; row < p->rows + p->n; row++) {
        bool runs = row->verdict == PLAN_RUNS;
        const char *why = runs                            ? NULL
                          : row->verdict == PLAN_UNWANTED ? row->stage->idle
                                                          : "nothing that is asked for needs it";
        report_set(r, ":{ name:s runs:b why_not:e does:s equations:e", row->stage->name, runs, why, row->stage->does,
                   row->stage->paper);
        set_names(r, "reads", runs ? row->reads & p->alive : 0, ITEM_COUNT, item_name);
        set_names(r, "gives", runs ? row->stage->gives & p->alive : 0, ITEM_COUNT, item_name);
        report_set(r, "cycles_per_sample:n cycles_once:n samples:n", runs ? row->work : NAN, runs ? row->once : NAN,
                   runs ? row->frames : NAN);
        if (m->given && runs && p->targets) {
            report_set(r, "measured_per_sample:n measured_once:n",
                       row->frames > 0 ? (time->all - time->opened) * m->clock / row->frames : 0,
                       time->opened * m->clock);
            time++;
        }
        set_names(r, "knobs", runs ? row->knobs : 0, KNOBS, knob_name);
        report_set(r, "}");
    }
    report_set(r, "] }");
    return time;
}

/* To two digits, for "%.9g". */
static double two(double x)
{
    double unit = x > 0 ? real_exp10(floor(real_log10(x)) - 1) : 1;
    return rint(x / unit) * unit;
}

static void beside_report(struct report *r, const struct plan_scene_estimate *x, const struct measured *m)
{
    report_set(r, "$:[", "in_no_stage");
    for (int k = 0; k < PLAN_BESIDE; k++) {
        double whole = x->once[k] + x->work[k] * (double)x->length.frames;
        report_set(r, ":{ does:s cycles_once:n cycles_per_sample:n", plan_beside_does[k], x->once[k], x->work[k]);
        if (m->given) report_set(r, "measured:n", m->beside[k] * m->clock);
        report_set(r, "}");
        report_text(r, "in no stage: %-40s %8.9g million cycles", plan_beside_does[k], two(whole / 1e6));
        report_text(r, m->given ? ", measured %.3g\n" : "\n", m->beside[k] * m->clock / 1e6);
    }
    report_set(r, "] samples:l cycles:n", x->length.frames, x->cycles);
    if (m->given)
        report_set(r, "measured:{ cycles:n cpu_s:n clock_hz:n }", m->report.cpu * m->clock, m->report.cpu, m->clock);
    report_text(r, "in all %.9g million cycles for %ld samples: %.2g s of a core of 3 GHz\n", two(x->cycles / 1e6),
                x->length.frames, x->cycles / 3e9);
    if (m->given)
        report_text(r, "measured %.3g million: %.2g s at %.2f GHz\n", m->report.cpu * m->clock / 1e6, m->report.cpu,
                    m->clock / 1e9);
}

/* What stages took, beside what was predicted. */
static const struct render_time *measured_text(struct report *r, const struct plan *p, const struct measured *m,
                                               const struct render_time *time)
{
    report_text(r, "  %-20s %15s %9s %15s %9s\n", "measured", "cycles a sample", "predicted", "million once",
                "predicted");
    for (const struct plan_row *row = p->rows; row < p->rows + p->n && p->targets; row++)
        if (row->verdict == PLAN_RUNS) {
            report_text(r, "  %-20s %15.0f %9.0f %15.2f %9.2f\n", row->stage->name,
                        row->frames > 0 ? (time->all - time->opened) * m->clock / row->frames : 0, row->work,
                        time->opened * m->clock / 1e6, row->once / 1e6);
            time++;
        }
    return time;
}

static bool plan_one(struct cmd_call *c, const char *file, struct report *r, struct err *e)
{
    struct scene s, chosen;
    struct error_budget error_budget;
    struct plan_scene_estimate x;
    struct measured m = {.given = false};
    bool without = args_given(&c->args, "without");
    if (!cmd_read_scene(c, file, &s, e)) return false;
    bool ok = error_budget_apply(&s, c->arena, &chosen, &error_budget, e) && plan_scene(&chosen, c->arena, &x, e);
    for (int i = 0; ok && i < s.n_contacts; i++)
        if (!plan_known(&x.plans[i], e)) return false;
    if (!ok) return scene_places_report(&s, e);
    x.once[PLAN_CHOOSES] = error_budget.cycles - error_budget.read[1];
    x.once[PLAN_READS] += error_budget.read[1];
    x.cycles += error_budget.cycles;
    for (int i = 0; x.warnings[i]; i++)
        message_warning(c, file, x.warnings[i]);
    if (args_given(&c->args, "measure") && !without && !measure(&s, &x, c->arena, &m, e)) return false;
    report_set(r, ":{ file:e accuracy:e contacts:[", s.file, error_budget.text);
    const struct render_time *time = m.report.times, *shown = time;
    for (int i = 0; i < s.n_contacts; i++) {
        time = contact_report(r, &x.plans[i], &m, time, c->arena);
        if (!r->json && !without) plan_print(&x.plans[i], r->out);
        if (m.given) shown = measured_text(r, &x.plans[i], &m, shown);
    }
    report_set(r, "]");
    if (!without) beside_report(r, &x, &m);
    if (without && !plan_without(c, file, &chosen, args_given(&c->args, "measure"), r, e)) return false;
    report_set(r, "}");
    if (error_budget.text) report_text(r, "%s\n", text_shown(c->arena, error_budget.text));
    return true;
}

static int plan_run(struct cmd_call *c, struct err *e)
{
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
        "Lists for each contact the stages that will run, in order. Each stage has what it reads and makes, the "
        "equations it follows and its share of the predicted cost. It also has what it costs once, when it is opened, "
        "and per audio sample while it works.\n"
        "Then the plan lists the stages that will not run, and why not, and what the render does in no stage, such as "
        "finding a plate's modes. Where the scene asks for an error (accuracy.error), it says what knobs are chosen "
        "and what error they are predicted to leave.\n"
        "Nothing is rendered. But all that the scene names is read, and what rasp check refuses is refused here, too.",
    .operands = "SCENE...",
    .least = 1,
    .most = -1,
    .options = plan_options,
    .examples = "rasp plan scenes/basswood_scrape.yaml\n"
                "rasp plan scenes/basswood_scrape.yaml --set scraper.weight=0\n"
                "rasp plan --json scenes/basswood_scrape.yaml\n"
                "rasp plan --measure scenes/basswood_scrape.yaml\n"
                "rasp plan --without scenes/basswood_scrape.yaml\n",
    .run = plan_run,
};
