/* rasp golden check: every scene rendered, and again from its effective scene where that is asked for, against what is kept. */
#include "base/interrupt.h"
#include "batch/pool.h"
#include "cmd/golden.h"

static bool interrupted(const struct golden_scene *s)
{
    return s->failed.kind == ERR_INTERRUPTED || interrupt_seen();
}

/* By any thread; all that it touches is the scene's own. */
static bool check_scene(void *self, int i)
{
    const struct golden *g = self;
    struct golden_scene *s = &g->scenes[i];
    if (!s->failed.kind && golden_render(g, s, 0, NULL, &s->failed)) {
        golden_judge(g, s, 0);
        bool again = g->effective && s->n_problems == 0;
        if (again && golden_render(g, s, 1, golden_render_path(g, s, 0, "sound.scene.yaml", s->arena), &s->failed))
            golden_judge(g, s, 1);
        else if (again)
            err_at(&s->failed, "rendered from the effective scene");
    }
    return !interrupted(s);
}

static void check_took(void *self, int i)
{
    const struct golden *g = self;
    struct golden_scene *s = &g->scenes[i];
    if (interrupted(s))
        return;
    if (s->failed.kind)
        golden_judge_add(s, "", NULL, "%s", s->failed.text);
    golden_report_scene(g, s, i + 1);
    if (!g->stays || s->n_problems == 0)
        golden_render_clear(g, s);
}

int golden_check(struct golden *g, struct err *e)
{
    int points = g->n + g->whole, good = 0, code = 0;
    if (!golden_kept_read(g, e))
        return (int)e->kind;
    golden_report_begin(g, points);
    if (pool_run(&(struct pool_work){.n = g->n, .threads = g->threads, .context = g, .job = check_scene, .took = check_took}) < g->n || interrupt_seen()) {
        err_set(e, ERR_INTERRUPTED, "interrupted; run the same command again");
        return (int)e->kind;
    }
    for (int i = 0; i < g->n; i++) {
        good += g->scenes[i].n_problems == 0;
        code = code ? code : (int)g->scenes[i].failed.kind;
    }
    if (g->whole) {
        const char **strays = golden_kept_strays(g, g->call->arena);
        golden_report_strays(g, strays, points);
        good += !*strays;
    }
    golden_report_end(g, good, points);
    return code ? code : good < points ? ERR_DIFFERS : 0;
}
