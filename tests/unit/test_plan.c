/* The planner on real scenes and on tables made to be wrong; the runner's promise that what is not planned is not
 * touched. */
#include "output/force_table.h"
#include "rig.h"
#include "toy_echo.c"

static const char *const scrape =
    "rasp: 1\n"
    "surface: {roughness: {rms: 5 um}%s}\n"
    "scraper: {mass: 20 g%s}\n"
    "motion: {path: back_and_forth, from: [1 cm, 0], to: [5 cm, 0], rate: 4 Hz, duration: 0.1 s}\n"
    "%s\n";

static struct scene scene_of(struct arena *a, const char *surface, const char *scraper, const char *rest)
{
    struct scene s;
    struct err e = {0};
    const char *messages = "", *text = arena_format(a, scrape, surface, scraper, rest);
    if (!scene_read_text(text, strlen(text), "plan.yaml", &(struct scene_overrides){0}, a, &s, &messages, &e))
        ck_abort_msg("%s%s", messages, e.text);
    return s;
}

/* Names of the stages that run, in order. */
static const char *running(struct arena *a, const struct plan *p)
{
    const char *all = "";
    for (int i = 0; i < p->n; i++)
        if (p->rows[i].verdict == PLAN_RUNS) all = arena_format(a, "%s%s ", all, p->rows[i].stage->name);
    return all;
}

static const char *plan_of(struct arena *a, struct scene s)
{
    struct plan p;
    struct err e = {0};
    ck_assert_msg(plan_make(stages_table, &s.contacts[0], &s, a, &p, &e), "%s", e.text);
    return running(a, &p);
}

#define BAR ", material: steel, object: {shape: bar, length: 40 cm, width: 4 cm, thickness: 1 cm}"
static const char *const bar = BAR;

START_TEST(only_what_a_scene_calls_for)
{
    struct arena *a = arena_open();
    const struct {
        const char *surface, *scraper, *rest, *plan;
    } cases[] = {
        {"", "", "output: {diagnostics: {}}",
         "trajectory surface roughness scrape approach smooth decimate force_table "},
        {bar, "", "", "trajectory surface roughness scrape approach smooth decimate surface_resonators mix "},
        {bar, bar, "",
         "trajectory surface roughness scrape approach smooth decimate surface_resonators scraper_resonators mix "},
        {bar, ", weight: 0, response: x.csv", "",
         "trajectory surface roughness scrape approach smooth decimate surface_resonators mix "},
        {bar, "", "grip: {}",
         "trajectory load limiter surface roughness scrape approach smooth decimate surface_resonators mix "},
        {bar, "", "grip: {}\ncontact: {limiter: {curve: none}}",
         "trajectory load surface roughness scrape approach smooth decimate surface_resonators mix "},
        {bar, "", "contact: {smoothing: 0 s}",
         "trajectory surface roughness scrape approach decimate surface_resonators mix "},
        {bar, "", "contact: {force: paper}",
         "trajectory surface roughness paper_curvature smooth_curvature paper approach decimate surface_resonators "
         "mix "},
        {", response: a.wav", "", "",
         "trajectory surface roughness scrape approach smooth decimate surface_overlap_add mix "},
        {BAR ", response_length: 1 s", "", "",
         "trajectory surface roughness scrape approach smooth decimate surface_overlap_add mix "},
        {BAR ", convolution: overlap_add", "", "",
         "trajectory surface roughness scrape approach smooth decimate surface_overlap_add mix "},
        {BAR ", moving: launch, convolution: resonators", "", "",
         "trajectory surface roughness scrape approach smooth decimate surface_launch mix "},
        {BAR ", moving: glide", "", "",
         "trajectory surface roughness scrape approach smooth decimate surface_resonators mix "},
        {BAR ", moving: readout", "", "",
         "trajectory surface roughness scrape approach smooth decimate surface_overlap_add mix "},
        {", space: {to: [1, 0]}", "", "",
         "trajectory surface roughness scrape approach smooth decimate surface_resonators mix "},
        {BAR, "", "output: {stems: [force]}",
         "trajectory surface roughness scrape approach smooth decimate surface_resonators mix "},
        {"", ", response: a.wav", "",
         "trajectory surface roughness scrape approach smooth decimate scraper_overlap_add mix "},
        {"", "", "output: {diagnostics: {columns: [time_s, speed_m_per_s]}}", "trajectory force_table "},
        {"", "", "grip: {}\noutput: {diagnostics: {columns: [normal_force_n]}}", "trajectory load force_table "},
        {"", "", "grip: {}\noutput: {diagnostics: {columns: [alpha_m]}}", "trajectory load limiter force_table "},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        ck_assert_str_eq(plan_of(a, scene_of(a, cases[i].surface, cases[i].scraper, cases[i].rest)), cases[i].plan);
    arena_close(a);
}
END_TEST

static bool always(const struct contact *c, const struct scene *s)
{
    (void)c, (void)s;
    return true;
}

START_TEST(wrong_tables_are_refused)
{
    struct arena *a = arena_open();
    struct scene s = scene_of(a, bar, "", "");
    struct stage second = scrape_stage, orphan = mix_stage;
    struct plan p;
    struct err e = {0};
    second.name = "second_scrape";
    second.wanted = always;
    const struct stage *twice[] = {&trajectory_stage, &roughness_stage,
                                   &second,           &scrape_stage,
                                   &decimate_stage,   &ring_resonators_surface_stage,
                                   &mix_stage,        NULL};
    ck_assert(!plan_make(twice, &s.contacts[0], &s, a, &p, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(strstr(e.text, "two stages give subforce") != NULL, "%s", e.text);
    e = (struct err){0};
    const struct stage *hole[] = {
        &trajectory_stage, &roughness_stage, &scrape_stage, &ring_resonators_surface_stage, &orphan, NULL};
    ck_assert(!plan_make(hole, &s.contacts[0], &s, a, &p, &e));
    ck_assert_msg(strstr(e.text, "nothing in this scene gives its force") != NULL, "%s", e.text);
    e = (struct err){0};
    s = scene_of(a, bar, "", "");
    s.contacts[0].surface.response.object.given = false;
    ck_assert(!plan_make(stages_table, &s.contacts[0], &s, a, &p, &e));
    ck_assert_msg(strstr(e.text, "nothing is asked of it") != NULL, "%s", e.text);
    arena_close(a);
}
END_TEST

/* ------------------------------------------------------------------ a spy in place of every stage */

enum { MOST = 64 };
static struct stage spied[MOST];
static int opened[MOST], ran[MOST], closed[MOST];

static int spy_index(const struct stage_run *r) { return (int)(r->stage - spied); }

static bool spy_open(struct stage_run *r, struct err *e)
{
    opened[spy_index(r)]++;
    return stages_table[spy_index(r)]->open(r, e);
}

static bool spy_run(struct stage_run *r, long from, long to, struct err *e)
{
    ran[spy_index(r)]++;
    return stages_table[spy_index(r)]->run(r, from, to, e);
}

static void spy_close(struct stage_run *r)
{
    closed[spy_index(r)]++;
    if (stages_table[spy_index(r)]->close) stages_table[spy_index(r)]->close(r);
}

/* What is not in the plan is not opened, not run, not closed, and its items get no memory; what is in it is. */
START_TEST(the_rest_is_not_touched)
{
    const struct stage *table[MOST + 1] = {0};
    struct arena *a = arena_open();
    struct scene s = scene_of(a, "", "", "load: {constant: 1 N}\noutput: {diagnostics: {columns: [force_rms_n]}}");
    struct plan p;
    struct run r;
    struct err e = {0};
    struct table_sink sink = {tmpfile()};
    for (int i = 0; stages_table[i]; i++) {
        spied[i] = *stages_table[i];
        spied[i].open = spy_open;
        spied[i].run = spied[i].run ? spy_run : NULL;
        spied[i].close = spy_close;
        table[i] = &spied[i];
    }
    ck_assert(plan_make(table, &s.contacts[0], &s, a, &p, &e));
    ck_assert_str_eq(running(a, &p), "trajectory surface roughness scrape approach smooth decimate force_table ");
    ck_assert(run_open(&r, &p, &s, &(struct run_sinks){&sink, NULL}, &e));
    for (int k = 1; k <= 4; k++)
        ck_assert(run_block(&r, k * 1000, &e));
    ck_assert_int_eq(r.n, 8);
    for (int i = 0; i < ITEM_COUNT; i++) {
        bool alive = i == ITEM_POSITION || i == ITEM_VELOCITY || i == ITEM_SUBFORCE || i == ITEM_FORCE;
        ck_assert_msg((r.board.signals[i].x != NULL) == alive, "memory of %s", plan_item((enum item)i));
    }
    run_close(&r);
    for (int i = 0; stages_table[i]; i++) {
        bool in = p.rows[i].verdict == PLAN_RUNS;
        ck_assert_msg((opened[i] == 1) == in && (closed[i] == 1) == in, "%s", spied[i].name);
        ck_assert_msg((ran[i] > 0) == (in && spied[i].run), "%s", spied[i].name);
    }
    fclose(sink.stream);
    arena_close(a);
}
END_TEST

/* ------------------------------------------------------------------ traps */

static const double planted[3] = {0, -1, 1e300};
static int plants; /* which of them a stage works with, in its third block; -1: none */

static bool faulty_run(struct stage_run *r, long from, long to, struct err *e)
{
    static volatile double nowhere; /* what is planted comes to nothing in the sound */
    if (ran[spy_index(r)]++ == 2 && plants >= 0 && !strcmp(r->stage->name, "smooth")) {
        volatile double x = planted[plants];
        nowhere = plants == 0 ? 1 / x : plants == 1 ? sqrt(x) : x * x;
    }
    (void)nowhere;
    return stages_table[spy_index(r)]->run(r, from, to, e);
}

/* Operations without a result in one stage's third block: with traps the run ends there and names it, without it goes on.
 */
START_TEST(traps_name_the_stage)
{
    const struct stage *table[MOST + 1] = {0};
    struct arena *a = arena_open();
    struct scene s = scene_of(a, "", "", "load: {constant: 1 N}\noutput: {diagnostics: {columns: [force_rms_n]}}");
    struct table_sink sink = {tmpfile()};
    static const char *const words[] = {"divided by 0", "no result", "overflowed"};
    for (int i = 0; stages_table[i]; i++) {
        spied[i] = *stages_table[i];
        spied[i].run = spied[i].run ? faulty_run : NULL;
        table[i] = &spied[i];
    }
    for (int on = 0; on < 2; on++) {
        if (on) run_traps();
        for (plants = -1; plants < 3; plants++) {
            struct plan p;
            struct run r;
            struct err e = {0};
            bool ok = true;
            memset(ran, 0, sizeof ran);
            ck_assert(plan_make(table, &s.contacts[0], &s, a, &p, &e));
            ck_assert(run_open(&r, &p, &s, &(struct run_sinks){&sink, NULL}, &e));
            for (int k = 1; ok && k <= 8; k++)
                ok = run_block(&r, k * 1000, &e);
            ck_assert_msg(ok == (!on || plants < 0), "%s", e.text);
            if (!ok) {
                ck_assert(e.kind == ERR_NUMBERS && strstr(e.text, "'smooth'") && strstr(e.text, words[plants]));
                ck_assert_msg(strstr(e.text, "between 0.02") || strstr(e.text, "between 0.04"), "%s",
                              e.text); /* the third run, wherever its block begins */
            }
            run_close(&r);
        }
    }
    fclose(sink.stream);
    arena_close(a);
}
END_TEST

/* ------------------------------------------------------------------ one file, one line */

static const struct stage *const with_toy[] = {
#define STAGE(name) &name##_stage,
#include "stages_with_toy.def"
#undef STAGE
    NULL,
};

static void render_with(const struct stage *const *table, struct scene *s, double *y, long frames)
{
    struct arena *a = arena_open();
    struct plan p;
    struct run r;
    struct err e = {0};
    ck_assert_msg(plan_make(table, &s->contacts[0], s, a, &p, &e), "%s", e.text);
    ck_assert_msg(run_open(&r, &p, s, NULL, &e), "%s", e.text);
    for (long from = 0; from < frames; from += 512) {
        ck_assert_msg(run_block(&r, from + 512, &e), "%s", e.text);
        memcpy(y + from, board_at(&r.board, ITEM_SOUND, from), 512 * sizeof *y);
    }
    run_close(&r);
    arena_close(a);
}

START_TEST(a_toy_stage_takes_one_file_and_one_line)
{
    static double dry[5120], wet[5120];
    struct arena *a = arena_open();
    struct scene s = scene_of(
        a, arena_format(a, ", extrapolate: nearest, response: %s/irs/basswood_plank.csv", getenv("ROOT")), "", "");
    s.contacts[0].gain = 1;
    render_with(with_toy, &s, wet, 5120);
    render_with(stages_table, &s, dry, 5120);
    ck_assert_int_eq(memcmp(wet, dry, sizeof dry), 0); /* not called for: not there */
    s.contacts[0].gain = -1;
    render_with(with_toy, &s, wet, 5120);
    render_with(stages_table, &s, dry, 5120);
    for (long n = 100; n < 5120; n++)
        ck_assert_double_eq_tol(wet[n], dry[n] + 0.5 * dry[n - 100], 1e-15 * fabs(dry[n]) + 1e-18);
    ck_assert(dry[4000] != 0);
    arena_close(a);
}
END_TEST

UNIT("plan", only_what_a_scene_calls_for, wrong_tables_are_refused, the_rest_is_not_touched, traps_name_the_stage,
     a_toy_stage_takes_one_file_and_one_line)
