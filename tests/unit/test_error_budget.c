/* error_budget_apply: what is chosen is the least that keeps the error by its own prediction; what is said stays; what is
   chosen once is not chosen again; what cannot be kept is refused with the best that can be, which can be. That
   predictions hold is measured by cli/promise. */
#include "pipeline/error_budget.h"

#include "rig.h"
#include "scene/accuracy.h"

#define SCENE                                                                                                          \
    "rasp: 1\nseed: 2\nsurface: {roughness: {rms: 5 um}}\nscraper: {mass: 20 g}\nmotion: {path: line, to: [5 cm, 0], " \
    "duration: 0.1 s}\n"                                                                                               \
    "output: {quantity: force, sample_rate: 44100}\naccuracy: {error: %g dB%s}\n"

static struct scene scene_of(double error, const char *more)
{
    return rig_scene(rig_arena(), arena_format(rig_arena(), SCENE, error, more));
}

static struct error_budget applied(double error, const char *more, struct scene *chosen)
{
    struct scene s = scene_of(error, more);
    struct error_budget p;
    struct err e = {0};
    ck_assert_msg(error_budget_apply(&s, rig_arena(), chosen, &p, &e), "%g dB%s: %s", error, more, e.text);
    return p;
}

/* Of one knob a quarter of the value, said, is predicted to miss it (half of it may be refused for its history only). */
START_TEST(the_cheapest)
{
    double before = 0;
    for (double error = -30; error >= -100; error -= 10) {
        struct scene chosen, coarser;
        struct error_budget p = applied(error, "", &chosen);
        double over = chosen.accuracy.oversampling;
        ck_assert_double_le(p.predicted, error);
        ck_assert_int_eq(p.n, 1);
        ck_assert_int_eq(p.parts[0].knob, KNOB_oversampling);
        ck_assert_double_ge(over, before);
        before = over;
        if (over < 8) continue; /* one sub-interval is accepted with more in hand */
        struct err e = {0};
        coarser = scene_of(error, arena_format(rig_arena(), ", oversampling: %g", over / 4));
        ck_assert_msg(!error_budget_apply(&coarser, rig_arena(), &chosen, NULL, &e),
                      "at %g dB %g would do as well as %g", error, over / 4, over);
    }
    ck_assert_double_gt(before, 4);
}
END_TEST

START_TEST(what_is_said_stays)
{
    struct scene chosen;
    struct error_budget p = applied(-40, ", oversampling: 7, gain_ramp: 3", &chosen);
    ck_assert_double_eq(chosen.accuracy.oversampling, 7);
    ck_assert_double_eq(chosen.accuracy.gain_ramp, 3);
    ck_assert(p.parts[0].by_user && p.parts[0].value == 7);
    struct scene plain =
        rig_scene(rig_arena(), "rasp: 1\nsurface: {roughness: {}}\nscraper: {mass: 1 g}\nmotion: {path: line, to: [1 "
                               "cm, 0], duration: 0.1 s}\noutput: {quantity: force}\naccuracy: high\n");
    struct err e = {0};
    ck_assert(error_budget_apply(&plain, rig_arena(), &chosen, &p, &e));
    ck_assert(!p.asked && p.chosen && p.error == -100 && p.predicted < -100);
    plain.accuracy.by_user = KNOB_BIT(oversampling);
    plain.accuracy.oversampling = 3;
    ck_assert(error_budget_apply(&plain, rig_arena(), &chosen, &p, &e));
    ck_assert_double_eq(chosen.accuracy.oversampling, 3);
    accuracy_preset(&plain.accuracy, "reference");
    plain.accuracy.by_user = 0;
    ck_assert(error_budget_apply(&plain, rig_arena(), &chosen, &p, &e));
    ck_assert(!p.asked && !p.chosen && p.text == NULL);
    ck_assert_double_eq(chosen.accuracy.oversampling, 64);
}
END_TEST

/* An ablated scene has the knobs of the whole one; of its own, where the whole one is none: the rod has no modes. */
START_TEST(ablated)
{
    static const char *const text =
        "rasp: 1\nsurface: {roughness: {}, material: glass, object: {shape: plate, length: 20 cm, width: 20 cm, "
        "thickness: 5 mm}}\nscraper: {mass: 1 g, material: steel, object: {shape: rod, length: %s, diameter: 1 mm}}\n"
        "%smotion: {path: line, from: [5 cm, 5 cm], to: [6 cm, 5 cm], duration: 0.1 s}\n";
    struct scene whole = rig_scene(rig_arena(), arena_format(rig_arena(), text, "20 cm", "")),
                 part =
                     rig_scene(rig_arena(), arena_format(rig_arena(), text, "20 cm", "ablation: {sound: scraper}\n")),
                 none = rig_scene(rig_arena(), arena_format(rig_arena(), text, "2 mm", "ablation: {sound: surface}\n")),
                 chosen[3];
    struct error_budget p;
    struct err e = {0};
    ck_assert(error_budget_apply(&whole, rig_arena(), &chosen[0], NULL, &e));
    ck_assert(error_budget_apply(&part, rig_arena(), &chosen[1], NULL, &e));
    for (int k = 0; k < KNOBS; k++)
        ck_assert_double_eq(accuracy_knob(&chosen[0].accuracy, (enum knob)k),
                            accuracy_knob(&chosen[1].accuracy, (enum knob)k));
    ck_assert(chosen[1].contacts->ablation.given);
    ck_assert_msg(error_budget_apply(&none, rig_arena(), &chosen[2], &p, &e), "%s", e.text);
    ck_assert(p.chosen && chosen[2].contacts->ablation.given);
}
END_TEST

/* Its knobs all said, as the effective scene has them, it comes back as it is, and nothing is rehearsed. */
START_TEST(chosen_once)
{
    struct scene chosen, again;
    struct error_budget p;
    struct err e = {0};
    applied(-70, "", &chosen);
    chosen.accuracy.by_user = (1u << KNOBS) - 1;
    ck_assert(error_budget_apply(&chosen, rig_arena(), &again, &p, &e));
    ck_assert(p.asked && !p.chosen && isnan(p.predicted));
    ck_assert_mem_eq(&again.accuracy, &chosen.accuracy, sizeof chosen.accuracy);
}
END_TEST

START_TEST(the_best_is_told)
{
    struct scene s = scene_of(-200, ""), chosen;
    struct err e = {0};
    double best;
    ck_assert(!error_budget_apply(&s, rig_arena(), &chosen, NULL, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    const char *says = strstr(e.text, "the best that can be promised here is ");
    ck_assert_msg(says && sscanf(says + 38, "%lf dB", &best) == 1, "%s", e.text);
    ck_assert_double_lt(best, -90);
    applied(best, "", &chosen);
    struct err worse = {0};
    s = scene_of(best - 1.01, "");
    ck_assert_msg(!error_budget_apply(&s, rig_arena(), &chosen, NULL, &worse), "%g dB can be had, too", best - 1.01);
    struct err said = {0};
    s = scene_of(-80, ", oversampling: 1");
    ck_assert(!error_budget_apply(&s, rig_arena(), &chosen, NULL, &said));
    ck_assert_msg(strstr(said.text, "accuracy.oversampling is 1") != NULL, "%s", said.text);
}
END_TEST

/* What is told as the best: of a scene whose last line gives the error. NAN: it is chosen. */
static double best_of(const char *scene, double error)
{
    struct scene s = rig_scene(rig_arena(), arena_format(rig_arena(), "%saccuracy: {error: %g dB}\n", scene, error)),
                 chosen;
    struct err e = {0};
    double best;
    if (error_budget_apply(&s, rig_arena(), &chosen, NULL, &e)) return NAN;
    const char *says = strstr(e.text, "the best that can be promised here is ");
    ck_assert_msg(says && sscanf(says + 38, "%lf dB", &best) == 1, "%s", e.text);
    return best;
}

/* The best is that of the scene, whatever is asked, and is chosen. The first differences of these scenes fall far more
   slowly than the later ones: the coupled ball's steps by 4 dB, then by 12 (by 12.0 and 0.2: oversampling within the
   steps), the circle's by 17, 11, 19. */
START_TEST(the_best_is_the_same)
{
    static const char *const scenes[] = {"rasp: 1\nseed: 2\nsurface: {fractal: {exponent: -0.5, maximum: 0.1 um, "
                                         "pitch: 0.1 mm}}\nball: {radius: 1 cm, material: steel, patch: 0}\n"
                                         "motion: {path: line, to: [1 cm, 0], duration: 0.05 s}\ncontact: {model: "
                                         "roll_coupled, roll: {kappa: 5e9 N/(m^1.5 kg), mu: 1 s/m, ground: rigid}}\n"
                                         "output: {quantity: force, sample_rate: 44.1 kHz}\n",
                                         "rasp: 1\nseed: 21\nsurface: {roughness: {exponent: -2, rms: 3 um, longest: 1 "
                                         "mm, shortest: 20 um}}\nscraper: {mass: 20 g}\n"
                                         "motion: {path: circle, center: [15 cm, 4 cm], radius: 3 cm, turns: 1, "
                                         "duration: 0.6 s}\noutput: {quantity: force, sample_rate: 44.1 kHz}\n"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        double best = best_of(scenes[i], -240);
        ck_assert_double_lt(best, -105);
        ck_assert_double_eq(best_of(scenes[i], -180), best);
        ck_assert_double_eq(best_of(scenes[i], best - 1), best);
        ck_assert(isnan(best_of(scenes[i], best)));
        ck_assert(isnan(best_of(scenes[i], best + 1)));
        ck_assert(isnan(best_of(scenes[i], -105)));
    }
}
END_TEST

/* A contact whose gain is 0 is there for its table alone, which holds the force as it is: it is given the knobs that
 * the force itself is, whatever rings; output.ramp, which fades the force that is listened to, does not count. */
START_TEST(what_is_mute_has_a_force)
{
    static const char rings[] = ", material: steel, object: {shape: bar, length: 20 cm, width: 3 cm, thickness: 2 mm}";
    for (double error = -40; error >= -90; error -= 25) {
        struct scene chosen, heard;
        struct error_budget p = applied(error, "", &heard);
        double first = NAN;
        for (int i = 0; i < 2; i++) {
            const char *text =
                arena_format(rig_arena(),
                             "rasp: 1\nseed: 2\ngain: 0\nsurface: {roughness: {rms: 5 um}%s}\nscraper: {mass: 20 "
                             "g}\nmotion: {path: line, to: [5 cm, 0], duration: 0.1 s}\n"
                             "output: {%ssample_rate: 44100, diagnostics: {}}\naccuracy: {error: %g dB}\n",
                             i ? rings : "", i ? "" : "quantity: force, ", error);
            struct scene s = rig_scene(rig_arena(), text);
            struct error_budget mute;
            struct err e = {0};
            ck_assert_msg(error_budget_apply(&s, rig_arena(), &chosen, &mute, &e), "%s", e.text);
            ck_assert_double_eq(chosen.accuracy.oversampling, heard.accuracy.oversampling);
            ck_assert_double_eq_tol(mute.predicted, p.predicted, 0.5);
            ck_assert(i == 0 || mute.predicted == first);
            first = mute.predicted;
        }
    }
}
END_TEST

UNIT("promise", UNIT_LONG(the_best_is_the_same), the_cheapest, what_is_said_stays, ablated, chosen_once,
     the_best_is_told, what_is_mute_has_a_force)
