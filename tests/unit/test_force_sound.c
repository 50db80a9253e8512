/* output.quantity: force, from a scene's text to its WAV: momenta in closed form, the stem of the same force, and that nothing rings. */
#include <sys/stat.h>
#include <unistd.h>

#include "file/wav.h"
#include "pipeline/render.h"
#include "response/modes.h"
#include "rig.h"

static char folder[] = "/tmp/rasp_force_XXXXXX";

static const char *in_folder(struct arena *a, const char *name)
{
    return arena_format(a, "%s/%s", folder, name);
}

static struct render_report rendered(struct arena *a, const char *text, const char *base)
{
    struct scene s;
    struct err e = {0};
    const char *messages = "";
    struct render_report report;
    if (!scene_read_text(text, strlen(text), in_folder(a, "scene.yaml"), &(struct scene_overrides){0}, a, &s, &messages, &e))
        ck_abort_msg("%s%s", messages, e.text);
    ck_assert_msg(render_scene(&s, in_folder(a, base), a, &report, &e), "%s", e.text);
    return report;
}

static struct wav sound(struct arena *a, const char *name)
{
    struct wav w;
    struct err e = {0};
    ck_assert_msg(wav_read(in_folder(a, name), a, &w, &e), "%s", e.text);
    return w;
}

static struct arena *setup(void)
{
    ck_assert_ptr_nonnull(mkdtemp(folder));
    return arena_open();
}

static void clean(struct arena *a)
{
    ck_assert_int_eq(system(arena_format(a, "rm -r %s", folder)), 0);
    arena_close(a);
}

#define STILL "  motion: {path: still, duration: 0.2 s}\n"
#define PULSE "strike: {pulse: half_sine, stiffness: 1 MN/m, speed: "
#define TWO "rasp: 1\ncontacts:\n" \
            "- name: hard\n  gain: 3\n  surface: {}\n  scraper: {mass: 10 g}\n" STILL "  contact: {model: strike, " PULSE "1.5 m/s}}\n" \
            "- name: soft\n  gain: -0.5\n  surface: {}\n  scraper: {mass: 4 g}\n" STILL "  contact: {model: strike, " PULSE "2 m/s, first: 0.1 s}}\n"

/* Each impact hands over twice its momentum, times its contact's gain and the level's, whatever the filters on the way: their gain at 0 Hz is 1 to 1e-9. No contact has a response. */
START_TEST(momenta_are_kept)
{
    struct arena *a = setup();
    struct render_report r = rendered(a, TWO "output: {quantity: force, ramp: 0, encoding: float64, level: {full_scale: 2 N}}\n", "two");
    struct wav w = sound(a, "two.wav");
    double first = 0, second = 0;
    ck_assert_int_eq(r.quantity, MODES_FORCE);
    ck_assert_str_eq(modes_quantity_unit(r.quantity), "N");
    ck_assert_uint_le(w.frames, 9601); /* no tail: nothing rings */
    for (size_t n = 0; n < w.frames; n++)
        *(n < 2880 ? &first : &second) += w.x[n] / 48000;
    ck_assert_double_eq_tol(first, 3 * 2 * 0.010 * 1.5 / 2, 1e-9);
    ck_assert_double_eq_tol(second, -0.5 * 2 * 0.004 * 2 / 2, 1e-9);
    clean(a);
}
END_TEST

/* The stem `force` is the force in newtons, as 32-bit floating point; the sound of one contact is that, but for its rounding. */
START_TEST(it_is_the_stem)
{
    struct arena *a = setup();
    rendered(a, "rasp: 1\nsurface: {roughness: {rms: 3 um}}\nscraper: {mass: 10 g}\nmotion: {path: line, to: [3 cm, 0], speed: 20 cm/s}\n"
                "output: {quantity: force, stems: [force], ramp: 0, encoding: float64, level: {full_scale: 1}}\n", "stem");
    struct wav w = sound(a, "stem.wav"), f = sound(a, "stem.force.wav");
    double most = 0;
    ck_assert(w.frames == f.frames && w.frames > 7000);
    for (size_t n = 0; n < w.frames; n++) {
        ck_assert(f.x[n] == (float)w.x[n]);
        most = fmax(most, fabs(w.x[n]));
    }
    ck_assert_double_gt(most, 1e-3);
    clean(a);
}
END_TEST

UNIT("force_sound", momenta_are_kept, it_is_the_stem)
