/* output.quantity: force, from a scene's text to its WAV: momenta in closed form, the stem of the same force, and that
 * nothing rings. */
#include "renders.h"
#include "response/modes.h"

#define STILL "  motion: {path: still, duration: 0.2 s}\n"
#define PULSE "strike: {pulse: half_sine, stiffness: 1 MN/m, speed: "
#define TWO                                                                                                            \
    "rasp: 1\ncontacts:\n"                                                                                             \
    "- name: hard\n  gain: 3\n  surface: {}\n  scraper: {mass: 10 g}\n" STILL "  contact: {model: strike, " PULSE      \
    "1.5 m/s}}\n"                                                                                                      \
    "- name: soft\n  gain: -0.5\n  surface: {}\n  scraper: {mass: 4 g}\n" STILL "  contact: {model: strike, " PULSE    \
    "2 m/s, first: 0.1 s}}\n"

/* Each impact hands over twice its momentum, times its contact's gain and the level's, whatever the filters on the way:
 * their gain at 0 Hz is 1 to 1e-9. No contact has a response. */
START_TEST(momenta_are_kept)
{
    folder_make();
    struct render_report r =
        renders_made(TWO "output: {quantity: force, ramp: 0, encoding: float64, level: {full_scale: 2 N}}\n", "two");
    struct wav w = renders_sound("two.wav");
    double first = 0, second = 0;
    ck_assert_int_eq(r.quantity, MODES_FORCE);
    ck_assert_str_eq(modes_quantity_unit(r.quantity), "N");
    ck_assert_uint_le(w.frames, 9601); /* no tail: nothing rings */
    for (size_t n = 0; n < w.frames; n++)
        *(n < 2880 ? &first : &second) += w.x[n] / 48000;
    ck_assert_double_eq_tol(first, 3 * 2 * 0.010 * 1.5 / 2, 1e-9);
    ck_assert_double_eq_tol(second, -0.5 * 2 * 0.004 * 2 / 2, 1e-9);
    folder_remove();
}
END_TEST

/* The stem `force` is the force in newtons, as 32-bit floating point; the sound of one contact is that, but for its
 * rounding. */
START_TEST(it_is_the_stem)
{
    folder_make();
    renders_made("rasp: 1\nsurface: {roughness: {rms: 3 um}}\nscraper: {mass: 10 g}\nmotion: {path: line, to: [3 cm, "
                 "0], speed: 20 cm/s}\n"
                 "output: {quantity: force, stems: [force], ramp: 0, encoding: float64, level: {full_scale: 1}}\n",
                 "stem");
    struct wav w = renders_sound("stem.wav"), f = renders_sound("stem.force.wav");
    double most = 0;
    ck_assert(w.frames == f.frames && w.frames > 7000);
    for (size_t n = 0; n < w.frames; n++) {
        ck_assert(f.x[n] == (float)w.x[n]);
        most = fmax(most, fabs(w.x[n]));
    }
    ck_assert_double_gt(most, 1e-3);
    folder_remove();
}
END_TEST

UNIT("force_sound", momenta_are_kept, it_is_the_stem)
