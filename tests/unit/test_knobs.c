/* Which knobs of accuracy.def turn a scene: every shipped scene, begun, sounds the same to the bit whatever the others
 * are; and every knob turns some scene. */
#include <dirent.h>

#include "output/force_table.h"
#include "output/impact_rows.h"
#include "pipeline/plan.h"
#include "rig.h"
#include "scene/accuracy.h"
#include "scene/keys.h"

enum { FRAMES = 4 * STAGE_BLOCK };

static const char *scenes_folder(struct arena *a)
{
    const char *root = getenv("ROOT");
    ck_assert_ptr_nonnull(root);
    return arena_format(a, "%s/scenes", root);
}

static struct scene scene_of(const char *file, struct arena *a)
{
    struct scene s;
    struct err e = {0};
    const char *messages = "";
    if (!scene_read(file, &(struct scene_overrides){0}, a, &s, &messages, &e)) ck_abort_msg("%s%s", messages, e.text);
    return s;
}

/* The beginning of the contact's sound, or of its force where it has none: [FRAMES * channels]. */
static long begun(const struct scene *s, int contact, double *x, struct arena *a)
{
    struct plan p;
    struct run r;
    struct err e = {0};
    long n = 0;
    FILE *nowhere = fopen("/dev/null", "w");
    struct table_sink rows = {.stream = nowhere};
    struct impact_sink impacts = {.stream = nowhere};
    ck_assert_msg(plan_make(stages_table, &s->contacts[contact], s, a, &p, &e), "%s", e.text);
    ck_assert_msg(run_open(&r, &p, s, &(struct run_sinks){&rows, &impacts}, &e), "%s", e.text);
    enum item item = board_has(&r.board, ITEM_SOUND) ? ITEM_SOUND : ITEM_FORCE;
    for (long to = STAGE_BLOCK; to <= FRAMES; to += STAGE_BLOCK) {
        ck_assert_msg(run_block(&r, to, &e), "%s", e.text);
        long count = STAGE_BLOCK * r.board.signals[item].per_frame;
        memcpy(x + n, board_at(&r.board, item, to - STAGE_BLOCK), (size_t)count * sizeof *x);
        n += count;
    }
    run_close(&r);
    fclose(nowhere);
    return n;
}

static unsigned turned(const struct scene *s, int contact, struct arena *a)
{
    struct plan p;
    struct err e = {0};
    ck_assert_msg(plan_make(stages_table, &s->contacts[contact], s, a, &p, &e), "%s", e.text);
    return plan_knobs(&p);
}

/* All knobs that do not turn it, to each preset's values: no bit changes. */
static void check_contact(const char *file, const struct scene *s, int contact)
{
    struct arena *a = arena_open();
    unsigned knobs = turned(s, contact, a);
    double *x = ARENA_TAKE(a, double, FRAMES * 8), *y = ARENA_TAKE(a, double, FRAMES * 8);
    long n = begun(s, contact, x, a);
    static const char *const others[] = {"reference", "standard"};
    for (int i = 0; i < 2; i++) {
        struct scene t = *s;
        struct accuracy other = s->accuracy;
        bool differs = false;
        accuracy_preset(&other, others[i]);
        for (int k = 0; k < KNOBS; k++)
            if (!(knobs & 1u << k)) {
                differs |= accuracy_knob(&other, (enum knob)k) != accuracy_knob(&s->accuracy, (enum knob)k);
                accuracy_turn(&t.accuracy, (enum knob)k, accuracy_knob(&other, (enum knob)k));
            }
        if (!differs) continue;
        ck_assert_int_eq(begun(&t, contact, y, a), n);
        ck_assert_msg(memcmp(x, y, (size_t)n * sizeof *x) == 0,
                      "%s, contact %d: turned by %s only, but %s of the other knobs changes it", file, contact,
                      plan_knobs_text(knobs, a), others[i]);
    }
    arena_close(a);
}

static void check_folder(bool even)
{
    struct arena *a = arena_open();
    DIR *d = opendir(scenes_folder(a));
    ck_assert_ptr_nonnull(d);
    for (struct dirent *entry; (entry = readdir(d));) {
        size_t length = strlen(entry->d_name);
        if (length < 6 || strcmp(entry->d_name + length - 5, ".yaml") || (entry->d_name[length - 6] % 2 == 0) != even)
            continue;
        struct scene s = scene_of(arena_format(a, "%s/%s", scenes_folder(a), entry->d_name), a);
        accuracy_preset(&s.accuracy, "draft");
        for (int i = 0; i < s.n_contacts; i++)
            check_contact(entry->d_name, &s, i);
    }
    closedir(d);
    arena_close(a);
}

/* In two halves, for the time that a test may take. */
START_TEST(other_knobs_change_no_bit) { check_folder(true); }
END_TEST

START_TEST(other_knobs_change_no_bit_either) { check_folder(false); }
END_TEST

START_TEST(each_knob_turns_some_scene)
{
    struct arena *a = arena_open();
    DIR *d = opendir(scenes_folder(a));
    unsigned all = 0, knobs;
    ck_assert_ptr_nonnull(d);
    for (struct dirent *entry; all != (1u << KNOBS) - 1 && (entry = readdir(d));) {
        struct err e = {0};
        if (!strstr(entry->d_name, ".yaml")) continue;
        struct scene s = scene_of(arena_format(a, "%s/%s", scenes_folder(a), entry->d_name), a);
        ck_assert_msg(plan_scene_knobs(&s, a, &knobs, &e), "%s: %s", entry->d_name, e.text);
        all |= knobs;
    }
    closedir(d);
    ck_assert_msg(all == (1u << KNOBS) - 1, "no shipped scene is turned by %s",
                  plan_knobs_text(~all & ((1u << KNOBS) - 1), a));
    arena_close(a);
}
END_TEST

static const char *const scrape = "rasp: 1\nsurface: {roughness: {rms: 5 um}%s}\nscraper: {mass: 20 g%s}\n"
                                  "motion: {path: line, from: [1 cm, 0], to: [5 cm, 0], duration: 0.1 s}\n%s\n";

START_TEST(only_what_is_read)
{
    struct arena *a = arena_open();
    static const struct {
        const char *surface, *scraper, *rest, *knobs;
    } cases[] = {
        {"", "", "output: {diagnostics: {columns: [force_rms_n]}}", "oversampling"},
        {", material: steel, object: {shape: bar, length: 40 cm, width: 4 cm, thickness: 1 cm}", "", "",
         "oversampling, gain_ramp"},
        {", material: steel, object: {shape: bar, length: 40 cm, width: 4 cm, thickness: 1 cm}, response_length: 10 ms",
         "", "", "oversampling, gain_ramp"},
        {"", ", material: steel, object: {shape: bar, length: 40 cm, width: 4 cm, thickness: 1 cm}", "",
         "oversampling"},
        {"", ", radius: 1 mm", "output: {diagnostics: {columns: [force_rms_n]}}", "oversampling, tip_heights"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct scene s = rig_scene(a, arena_format(a, scrape, cases[i].surface, cases[i].scraper, cases[i].rest));
        ck_assert_str_eq(plan_knobs_text(turned(&s, 0, a), a), cases[i].knobs);
    }
    ck_assert_str_eq(plan_knobs_text(0, a), "none");
    arena_close(a);
}
END_TEST

/* A stage that runs need only name a knob, as a set or by a function. */
static unsigned toy_turns(const struct contact *c, const struct scene *s)
{
    (void)c, (void)s;
    return KNOB_BIT(gain_ramp);
}

START_TEST(a_stage_names_its_knobs)
{
    struct arena *a = arena_open();
    struct scene s = rig_scene(a, arena_format(a, scrape, "", "", "output: {diagnostics: {columns: [force_rms_n]}}"));
    struct stage with = decimate_stage, unneeded = mix_stage;
    const struct stage *table[64];
    struct plan p;
    struct err e = {0};
    with.knobs |= KNOB_BIT(contact_steps);
    with.turns = toy_turns;
    unneeded.knobs = KNOB_BIT(tip_heights);
    for (int n = 0; n == 0 || table[n - 1]; n++)
        table[n] = stages_table[n] == &decimate_stage ? &with
                   : stages_table[n] == &mix_stage    ? &unneeded
                                                      : stages_table[n];
    ck_assert_msg(plan_make(table, &s.contacts[0], &s, a, &p, &e), "%s", e.text);
    ck_assert_str_eq(plan_knobs_text(plan_knobs(&p), a), "oversampling, gain_ramp, contact_steps");
    arena_close(a);
}
END_TEST

UNIT("knobs", other_knobs_change_no_bit, UNIT_LONG(other_knobs_change_no_bit_either), each_knob_turns_some_scene,
     only_what_is_read, a_stage_names_its_knobs)
