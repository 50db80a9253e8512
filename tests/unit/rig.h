/* A piece of the pipeline under test: a scene's stages up to an item, and a probe that keeps what that item holds. A
   test may put a surface of its own in the place of the scene's roughness. */
#ifndef RIG_H
#define RIG_H
#include <stdbool.h>

#include "pipeline/plan.h"
#include "pipeline/run.h"
#include "pipeline/stages.h"
#include "scene/params.h"
#include "scene/scene_read.h"
#include "surface/relief.h"
#include "unit.h"

struct rig {
    struct arena *arena;
    struct scene scene;
    struct run run;
    double *x; /* [frames * per_frame] */
    long frames;
    int per_frame;
};

static struct {
    enum item item;
    unsigned also; /* further items that the plan is to make */
    struct rig *rig;
} rig_probe;

static struct arena *rig_pool;

static inline void rig_drain(void) { arena_close(rig_pool); }

/* Memory for a test's texts and scenes, given back when its process ends. */
static inline struct arena *rig_arena(void)
{
    if (!rig_pool) {
        rig_pool = arena_open();
        atexit(rig_drain);
    }
    return rig_pool;
}

/* Parameters of the scene's first contact, to be changed. */
static inline void *rig_edit(struct scene *s, const struct stage *stage)
{
    return params_edit(s->contacts, stage->params, rig_arena());
}

static inline bool rig_wanted(const struct contact *c, const struct scene *s)
{
    (void)c, (void)s;
    return true;
}

static inline double rig_work(const struct contact *c, const struct scene *s)
{
    (void)c, (void)s;
    return 1;
}

static inline unsigned rig_asks(const struct contact *c, const struct scene *s)
{
    (void)c, (void)s;
    return ITEM_BIT(rig_probe.item) | rig_probe.also;
}

static inline bool rig_open(struct stage_run *r, struct err *e)
{
    (void)r, (void)e;
    return true;
}

static inline bool rig_run(struct stage_run *r, long from, long to, struct err *e)
{
    struct rig *g = rig_probe.rig;
    (void)e;
    g->per_frame = r->board->signals[rig_probe.item].per_frame;
    if (!g->x) g->x = calloc((size_t)(g->frames * g->per_frame), sizeof *g->x);
    memcpy(g->x + from * g->per_frame, board_at(r->board, rig_probe.item, from),
           (size_t)((to - from) * g->per_frame) * sizeof *g->x);
    return true;
}

static const struct stage rig_stage = {.name = "probe",
                                       .does = "",
                                       .paper = "",
                                       .idle = "",
                                       .gives = ITEM_BIT(ITEM_TABLE),
                                       .asks = rig_asks,
                                       .wanted = rig_wanted,
                                       .work = rig_work,
                                       .open = rig_open,
                                       .run = rig_run};

/* The test's surface, while it has one; NULL: the scene's. */
static struct relief_part *(*rig_relief)(struct arena *, const struct contact *);

static inline bool rig_relief_open(struct stage_run *r, struct err *e)
{
    (void)e;
    relief_decide(r->board->relief, r->contact);
    relief_add(r->board->relief, rig_relief(r->arena, r->contact));
    return true;
}

static const struct stage rig_relief_stage = {.name = "relief",
                                              .does = "",
                                              .paper = "",
                                              .idle = "",
                                              .needs = ITEM_BIT(ITEM_SURFACE),
                                              .gives = ITEM_BIT(ITEM_SURFACE),
                                              .wanted = rig_wanted,
                                              .work = rig_work,
                                              .open = rig_relief_open};

static inline const struct stage *rig_in_place_of(const struct stage *s)
{
    return s == &force_table_stage ? &rig_stage : s == &roughness_stage && rig_relief ? &rig_relief_stage : s;
}

static inline struct scene rig_scene(struct arena *a, const char *text)
{
    struct scene s;
    struct err e = {0};
    const char *messages = "";
    if (!scene_read_text(text, strlen(text), "rig.yaml", &(struct scene_overrides){0}, a, &s, &messages, &e))
        ck_abort_msg("%s%s", messages, e.text);
    s.output.diagnostics.given = true;
    return s;
}

/* Runs the scene's (only) contact for so many frames, in blocks of `block`, and keeps the item. */
static inline struct rig *rig_record(struct scene *s, enum item item, long frames, int block)
{
    const struct stage *table[64];
    struct rig *g = calloc(1, sizeof *g);
    struct plan p;
    struct err e = {0};
    int n = 0;
    for (; stages_table[n]; n++)
        table[n] = rig_in_place_of(stages_table[n]);
    table[n] = NULL;
    rig_probe.item = item;
    rig_probe.rig = g;
    g->arena = arena_open();
    g->frames = frames;
    ck_assert_msg(plan_make(table, &s->contacts[0], s, g->arena, &p, &e), "%s", e.text);
    ck_assert_msg(run_open(&g->run, &p, s, NULL, &e), "%s", e.text);
    for (long to = block;; to += block) {
        ck_assert_msg(run_block(&g->run, to < frames ? to : frames, &e), "%s", e.text);
        if (to >= frames) break;
    }
    g->scene = *s;
    return g;
}

static inline void rig_close(struct rig *g)
{
    run_close(&g->run);
    free(g->x);
    arena_close(g->arena);
    free(g);
}

#endif
