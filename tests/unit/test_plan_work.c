/* The predicted work of every stage is a number, whatever a scene leaves unsaid: work functions read keys, and a key
 * that is not given is NAN. */
#include <dirent.h>

#include "pipeline/render.h"
#include "rig.h"
#include "scene/keys.h"

/* Reads a scene with keys set; false: it is refused. */
static bool read_it(const char *file, const char *text, const char **set, int n, struct arena *a, struct scene *s)
{
    struct scene_overrides over = {.set = set, .n = n};
    struct err e = {0};
    const char *messages;
    return text ? scene_read_text(text, strlen(text), file, &over, a, s, &messages, &e)
                : scene_read(file, &over, a, s, &messages, &e);
}

/* Every stage that the scene wants, whether it is needed or not. Engines for what rings are not chosen: their work is
 * summed there, of what was read and measured. */
static void stages_known(const struct scene *s, const char *what)
{
    for (int i = 0; i < s->n_contacts; i++)
        for (int k = 0; stages_table[k]; k++) {
            const struct stage *st = stages_table[k];
            double work = stages_wanted(st, &s->contacts[i], s) ? stages_work(st, &s->contacts[i], s) : 0;
            ck_assert_msg(work >= 0 && isfinite(work), "%s: contact '%s': %g cycles of '%s'", what, s->contacts[i].name,
                          work, st->name);
        }
}

/* 1: it is read, and then its work is known. */
static int known_with(const char *file, const char *text, const char **set, int n)
{
    struct arena *a = arena_open();
    struct scene s;
    int good = read_it(file, text, set, n, a, &s);
    if (good) stages_known(&s, arena_format(a, "%s%s%s", file, n ? " with " : "", n ? set[n - 1] : ""));
    arena_close(a);
    return good;
}

/* The whole plan. */
static void planned(const char *file)
{
    struct arena *a = arena_open();
    struct scene s;
    struct err e = {0};
    ck_assert_msg(read_it(file, NULL, NULL, 0, a, &s), "%s", file);
    struct render_parts p = render_parts_make(&s, a);
    ck_assert_msg(render_parts_plan(&p, &e), "%s: %s", file, e.text);
    for (int i = 0; i < s.n_contacts; i++) {
        double whole = 0;
        ck_assert_msg(plan_known(&p.parts[i].plan, &e), "%s: %s", file, e.text);
        for (int k = 0; k < p.parts[i].plan.n; k++)
            whole += p.parts[i].plan.rows[k].verdict == PLAN_RUNS ? p.parts[i].plan.rows[k].work : 0;
        ck_assert_msg(!p.parts[i].plan.targets || whole > 0, "%s: contact '%s': %g cycles", file, s.contacts[i].name,
                      whole);
    }
    arena_close(a);
}

/* Every scene that ships, with each key that may be left out left out. */
START_TEST(shipped_scenes_with_each_key_left_out)
{
    struct arena *a = arena_open();
    const char *folder = arena_format(a, "%s/scenes", getenv("ROOT"));
    DIR *d = opendir(folder);
    int scenes = 0, left_out = 0;
    ck_assert_ptr_nonnull(d);
    for (const struct dirent *f; (f = readdir(d));) {
        const char *end = strrchr(f->d_name, '.'), *file = arena_format(a, "%s/%s", folder, f->d_name);
        if (!end || strcmp(end, ".yaml") != 0) continue;
        scenes++;
        planned(file);
        for (const struct key *k = keys_table; k->path; k++)
            if (k->standard && !*k->standard)
                left_out += known_with(file, NULL, (const char *[]){arena_format(a, "%s=null", k->path)}, 1);
    }
    closedir(d);
    arena_close(a);
    ck_assert_int_ge(scenes, 25);
    ck_assert_int_ge(left_out, 20 * scenes);
}
END_TEST

/* Grounds of each kind, under a scraper, tips and balls, along a path, an axis and in the plane, straight, turning and
 * at rest. */
START_TEST(grounds_under_what_goes_over_them)
{
    static const char *const grounds[] = {"roughness: {like: m.gsf}",
                                          "roughness: {like: m.gsf, like_pitch: 3 um}",
                                          "roughness: {like: m.gsf, grain: 2}",
                                          "roughness: {}",
                                          "height_map: m.gsf",
                                          "height_map: m.gsf, pitch: 2 um",
                                          "height_map: m.gsf, roughness: {like: m.gsf}",
                                          "height_map: m.gsf, continuation: {}",
                                          "ridges: {spacing: 1 mm, height: 5 um}",
                                          "grit: {density: 30 /mm^2}",
                                          "fractal: {}",
                                          "ridges: {spacing: 1 mm, height: 5 um}, roughness: {like: m.gsf}"};
    static const char *const bodies[] = {"scraper: {mass: 10 g}",
                                         "scraper: {mass: 10 g, radius: 1 mm}",
                                         "scraper: {mass: 10 g, radius: 1 mm, patch: 0 m}",
                                         "scraper: {mass: 10 g}\ngrip: {}",
                                         "ball: {radius: 5 mm, mass: 4 g}\ncontact: {model: roll}",
                                         "ball: {radius: 5 mm, mass: 4 g}\ncontact: {model: roll, force: paper}",
                                         "ball: {radius: 5 mm, mass: 4 g}\ncontact: {model: roll_coupled}",
                                         "scraper: {mass: 10 g}\ncontact: {model: playback}",
                                         "scraper: {mass: 10 g}\ncontact: {force: paper}"};
    static const char *const motions[] = {"path: line, to: [1 cm, 0], duration: 0.1 s",
                                          "path: line, to: [1 cm, 2 mm], speed: 3 cm/s",
                                          "path: back_and_forth, to: [1 cm, 0], rate: 3 Hz, duration: 1 s",
                                          "path: circle, radius: 4 mm, duration: 1 s",
                                          "path: scribble, size: [1 cm, 1 cm], rate: 3 Hz, duration: 1 s",
                                          "path: polyline, points: [[0, 0], [1 cm, 0], [1 cm, 1 cm]], speed: 5 cm/s",
                                          "path: still, at: [0, 0], duration: 0.1 s",
                                          "path: incline, to: [3 cm, 0]"};
    static const char *const alongs[] = {"", "along: path, ", "along: x, ", "along: plane, "};
    int good = 0, of_like = 0;
    struct arena *a = arena_open();
    for (size_t g = 0; g < sizeof grounds / sizeof *grounds; g++)
        for (size_t b = 0; b < sizeof bodies / sizeof *bodies; b++)
            for (size_t m = 0; m < sizeof motions / sizeof *motions; m++)
                for (size_t w = 0; w < sizeof alongs / sizeof *alongs; w++) {
                    const char *text =
                        arena_format(a, "rasp: 1\nsurface: {%s%s}\n%s\nmotion: {%s}\noutput: {quantity: force}\n",
                                     alongs[w], grounds[g], bodies[b], motions[m]);
                    int one = known_with(text, text, NULL, 0);
                    good += one;
                    of_like += one && strstr(grounds[g], "like") ? 1 : 0;
                }
    arena_close(a);
    ck_assert_int_ge(good, 1000);
    ck_assert_int_ge(of_like, 400);
}
END_TEST

UNIT("plan_work", shipped_scenes_with_each_key_left_out, grounds_under_what_goes_over_them)
