/* A finished tail is not worked on: every shipped scene with silence behind its motion gives the same forces, sounds,
   tables and reports to the bit as where all stages work to the end, and the stages before the modes have stopped. */
#include <dirent.h>
#include <jansson.h>
#include <limits.h>

#include "output/force_table.h"
#include "output/impact_rows.h"
#include "pipeline/plan.h"
#include "rig.h"
#include "scene/accuracy.h"

struct rendered {
    json_t *reports;
    double *force, *sound;
    long forces, sounds;
    char *rows;
    size_t n_rows;
    struct board board; /* reports; signals and laws are gone */
    int stopped;        /* stages with a limit before the end */
};

/* Appends what the board holds of an item, if it does. */
static void keep(const struct board *b, enum item item, long from, long to, double *x, long *n)
{
    if (!board_has(b, item)) return;
    long count = (to - from) * b->signals[item].per_frame;
    memcpy(x + *n, board_at(b, item, from), (size_t)count * sizeof *x);
    *n += count;
}

static void render(const struct scene *s, int contact, bool limits, struct rendered *to, struct arena *a)
{
    struct plan p;
    struct run r;
    struct err e = {0};
    FILE *rows = open_memstream(&to->rows, &to->n_rows), *nowhere = fopen("/dev/null", "w");
    struct table_sink table = {.stream = rows};
    struct impact_sink impacts = {.stream = nowhere};
    ck_assert_msg(plan_make(stages_table, &s->contacts[contact], s, a, &p, &e), "%s", e.text);
    ck_assert_msg(run_open(&r, &p, s, &(struct run_sinks){&table, &impacts}, &e), "%s", e.text);
    long frames = r.board.moving + 4 * STAGE_BLOCK;
    to->force = ARENA_TAKE(a, double, frames);
    to->sound = ARENA_TAKE(a, double, frames *r.board.channels);
    to->forces = to->sounds = 0;
    for (int i = 0; i < r.n; i++) {
        if (!limits) r.stages[i].limit = LONG_MAX;
        to->stopped += r.stages[i].limit < frames - STAGE_BLOCK;
    }
    for (long done = 0; done < frames;) {
        long end = done + STAGE_BLOCK < frames ? done + STAGE_BLOCK : frames;
        ck_assert_msg(run_block(&r, end, &e), "%s", e.text);
        keep(&r.board, ITEM_FORCE, done, end, to->force, &to->forces);
        keep(&r.board, ITEM_SOUND, done, end, to->sound, &to->sounds);
        done = end;
    }
    to->board = r.board;
    to->reports = json_array();
    for (int i = 0; i < r.n; i++)
        if (r.stages[i].stage->report)
            json_array_append_new(to->reports, r.stages[i].stage->report(&r.stages[i], a).value);
    run_close(&r);
    fclose(rows);
    fclose(nowhere);
}

static void check_contact(const char *file, const struct scene *s, int contact, int *stopped)
{
    struct arena *a = arena_open();
    struct rendered x = {0}, y = {0};
    render(s, contact, true, &x, a);
    render(s, contact, false, &y, a);
    ck_assert_msg(x.forces == y.forces && memcmp(x.force, y.force, (size_t)x.forces * sizeof *x.force) == 0,
                  "%s: another force", file);
    ck_assert_msg(x.sounds == y.sounds && memcmp(x.sound, y.sound, (size_t)x.sounds * sizeof *x.sound) == 0,
                  "%s: another sound", file);
    ck_assert_msg(x.n_rows == y.n_rows && memcmp(x.rows, y.rows, x.n_rows) == 0, "%s: another table", file);
    ck_assert_msg(memcmp(&x.board.roll, &y.board.roll, sizeof x.board.roll) == 0, "%s: another report of the ball",
                  file);
    ck_assert_msg(x.board.lifted == y.board.lifted && json_equal(x.reports, y.reports), "%s: another report", file);
    ck_assert_int_eq(y.stopped, 0);
    *stopped += x.stopped > 1;
    json_decref(x.reports);
    json_decref(y.reports);
    free(x.rows);
    free(y.rows);
    arena_close(a);
}

START_TEST(shipped_scenes_end_as_if_all_worked_on)
{
    struct arena *a = arena_open();
    const char *root = getenv("ROOT");
    ck_assert_ptr_nonnull(root);
    const char *folder = arena_format(a, "%s/scenes", root);
    DIR *d = opendir(folder);
    int contacts = 0, stopped = 0;
    ck_assert_ptr_nonnull(d);
    for (struct dirent *entry; (entry = readdir(d));) {
        struct scene s;
        struct err e = {0};
        const char *messages = "", *file = arena_format(a, "%s/%s", folder, entry->d_name);
        if (!strstr(entry->d_name, ".yaml")) continue;
        if (!scene_read(file, &(struct scene_overrides){0}, a, &s, &messages, &e))
            ck_abort_msg("%s%s", messages, e.text);
        accuracy_preset(&s.accuracy, "draft");
        s.output.sample_rate = 16000; /* a third of the time */
        for (int k = 0; k < s.n_contacts; k++, contacts++)
            check_contact(file, &s, k, &stopped);
    }
    closedir(d);
    arena_close(a);
    ck_assert_int_ge(contacts, 30);
    ck_assert_int_ge(stopped, 15); /* those that scrape or roll */
}
END_TEST

UNIT("run_limits", shipped_scenes_end_as_if_all_worked_on)
