/* The scraping force on profiles and straight paths against a slow judge (tests/unit/judge.h): tolerances say what the
 * closed forms leave out. */
#include <complex.h>

#include "force/path_integral.h"
#include "force/scrape.h"
#include "judge.h"
#include "surface/limiter.h"
#include "surface/profile.h"

static const char *const head = "rasp: 1\n"
                                "seed: 5\n"
                                "output: {diagnostics: {}, sample_rate: 48000}\n"
                                "load: {approach: 0, release: 0}\n"
                                "scraper: {mass: 20 g}\n";

static const char *const reversing =
    "motion: {path: back_and_forth, from: [1 cm, 0], to: [1.4 cm, 0], rate: 30 Hz, duration: 0.05 s}\n";

static struct scene made(struct arena *a, const char *rest)
{
    return rig_scene(a, arena_format(a, "%s%s", head, rest));
}

static double against_judge(const char *rest, long frames)
{
    struct scene s = made(rig_arena(), rest);
    return judge_difference(&s, frames);
}

/* Vertical force only, through three reversals and at varying speed. The mean of S' over a piece h leaves out h/l / 60
   of how T differs from a parabola there: some 1e-5 of the pieces in which it saturates. */
START_TEST(vertical_force_through_reversals)
{
    double off = against_judge(arena_format(rig_arena(), "%s%s",
                                            "surface: {roughness: {rms: 5 um}}\ncontact: {beta1: 0, smoothing: 0 s}\n",
                                            reversing),
                               1600);
    ck_assert_double_lt(off, 5e-6);
}
END_TEST

START_TEST(unlimited_force_through_reversals)
{
    double off = against_judge(arena_format(rig_arena(), "%s%s",
                                            "surface: {roughness: {rms: 1 um, shortest: 100 um}}\ncontact: {beta1: 0, "
                                            "smoothing: 0 s, limiter: {curve: none}}\n",
                                            reversing),
                               1600);
    ck_assert_double_lt(off, 5e-9);
}
END_TEST

/* alpha follows the hand's force: it is taken as its mean over each sub-interval, over which it changes by a part in
 * 1e4. */
START_TEST(alpha_that_varies)
{
    double off =
        against_judge("surface: {roughness: {rms: 5 um}}\ngrip: {angle: 20 deg}\ncontact: {beta1: 0, smoothing: 0 s}\n"
                      "motion: {path: back_and_forth, from: [1 cm, 0], to: [4 cm, 0], rate: 5 Hz, duration: 0.15 s}\n",
                      4000);
    ck_assert_double_lt(off, 2e-5);
}
END_TEST

/* Where the horizontal force dominates: zeros of S' inside a piece, where T steps, are met by a parabola; with beta2
   other than 1 Simpson's rule is taken over |S'|^beta2, and the speed as its mean over a sub-interval. */
START_TEST(horizontal_force)
{
    const char *const models[] = {"{beta1: 1000, smoothing: 0 s}", "{beta1: 1000000, beta2: 2, smoothing: 0 s}",
                                  "{beta1: 1000, beta2: 0.8, smoothing: 0 s}"};
    const double bounds[] = {1e-3, 1e-3, 5e-3};
    for (int k = 0; k < 3; k++) {
        double off = against_judge(
            arena_format(rig_arena(), "surface: {roughness: {rms: 5 um}}\ncontact: %s\n%s", models[k], reversing),
            1600);
        ck_assert_double_lt(off, bounds[k]);
    }
}
END_TEST

/* 20.6 sub-intervals a cycle, one a sample, nearly all force horizontal and its memory (the leak) short: in the one
   that holds a turn the way there and back counts, not what is left of it at its end. Hats take the share of the way
   for that of the time, coarse here: compared is what they add up to. */
START_TEST(sub_intervals_are_cut_at_turns)
{
    struct scene s =
        made(rig_arena(),
             "surface: {roughness: {rms: 5 um}}\ncontact: {beta1: 500, smoothing: 0 s, leak: 50 um}\n"
             "accuracy: {oversampling: 1}\n"
             "motion: {path: back_and_forth, from: [1 cm, 0], to: [1.1 cm, 0], rate: 97 Hz, duration: 0.15 s}\n");
    s.output.sample_rate = 2000;
    struct rig *g = rig_record(&s, ITEM_SUBFORCE, 290, 1024);
    struct judge j = judge_of(g);
    double want[290], off = 0, all = 0;
    judge_run(&j, 290, 1 / 2000.0, want, NULL);
    for (int i = 0; i < 290; i++) {
        off += g->x[i] - want[i];
        all += fabs(want[i]);
    }
    rig_close(g);
    printf("momentum off by %.3g\n", off / all);
    ck_assert_double_lt(fabs(off), 3e-4 * all);
}
END_TEST

/* A stroke at 45 degrees over a profile along x: curvature along the path is half of z''. */
START_TEST(oblique_stroke_over_an_extruded_profile)
{
    double off = against_judge("surface: {roughness: {rms: 5 um}, along: x}\ncontact: {beta1: 0.05, smoothing: 0 s}\n"
                               "motion: {path: line, from: [1 cm, 0], to: [0.5 cm, 5 mm], speed: 20 cm/s}\n",
                               1200);
    ck_assert_double_lt(off, 2e-6);
}
END_TEST

/* Exact means: a wide hat is the sum of narrow ones, whatever lies in between (some 1e-5, as above). */
START_TEST(means_are_exact)
{
    double *coarse = NULL, worst = 0, rms = 0;
    struct arena *a = rig_arena();
    for (int over = 1; over <= 4; over *= 4) {
        struct scene s = made(a, arena_format(a,
                                              "surface: {roughness: {rms: 5 um}}\ncontact: {beta1: 0, smoothing: 0 "
                                              "s}\naccuracy: {oversampling: %d}\n%s",
                                              over, reversing));
        struct rig *g = rig_record(&s, ITEM_SUBFORCE, 2400, 1024);
        if (!coarse) {
            coarse = g->x;
            g->x = NULL;
        } else
            for (long n = 0; n < 2400; n++) {
                double mean = 0;
                for (int k = -3; k <= 3; k++)
                    mean += 4 * n + k < 0 ? 0 : (4 - abs(k)) / 16.0 * g->x[4 * n + k];
                worst = fmax(worst, fabs(mean - coarse[n]));
                rms += coarse[n] * coarse[n] / 2400;
            }
        rig_close(g);
    }
    free(coarse);
    printf("worst difference %.3g N of rms %.3g N\n", worst, sqrt(rms));
    ck_assert_double_lt(worst, 1e-4 * sqrt(rms));
    ck_assert_double_gt(rms, 0);
}
END_TEST

/* The same bits however the frames are cut into blocks, with everything on. */
START_TEST(blocks_do_not_matter)
{
    struct arena *a = rig_arena();
    const char *rest = arena_format(a, "surface: {roughness: {rms: 5 um}}\ngrip: {}\n%s", reversing);
    struct scene s = made(a, rest);
    struct rig *one = rig_record(&s, ITEM_FORCE, 3000, 1024), *other = rig_record(&s, ITEM_FORCE, 3000, 77);
    ck_assert_int_eq(memcmp(one->x, other->x, 3000 * sizeof *one->x), 0);
    double most = 0;
    for (long n = 0; n < 3000; n++)
        most = fmax(most, fabs(one->x[n]));
    ck_assert_double_gt(most, 1e-3);
    rig_close(one);
    rig_close(other);
}
END_TEST

/* Half a cycle of 2 Hz is 5512.5 samples at 22050 Hz: that sample begins and ends at the same place, but moves. With
   beta2 < 1 its force is (beta1/dt) integral |S'|^beta2 |v|^(beta2 - 1) ds with the speed moved at, not 0 to a negative
   power; like its neighbours' it is small. */
START_TEST(a_turn_in_the_middle_of_a_sample)
{
    struct arena *a = rig_arena();
    struct scene s = made(
        a, "surface: {roughness: {rms: 5 um}}\ncontact: {beta2: 0.8, smoothing: 0 s}\naccuracy: {oversampling: 1}\n"
           "motion: {path: back_and_forth, from: [1 cm, 0], to: [7 cm, 0], rate: 2 Hz, duration: 0.4 s}\n");
    s.output.sample_rate = 22050;
    struct rig *g = rig_record(&s, ITEM_SUBFORCE, 6000, 1024);
    ck_assert(isfinite(g->x[5512]));
    ck_assert_double_lt(fabs(g->x[5512]), fabs(g->x[5502]) + fabs(g->x[5522]));
    rig_close(g);
}
END_TEST

/* Two ends whose x differ in the last decimals only: the stroke runs straight across the profile. (It was once cut into
 * endless pieces.) */
START_TEST(a_stroke_straight_across_but_for_rounding)
{
    static const char *const ends[] = {"0.07", "0.070000000000000021", "0.070000000000021", "0.070000021"};
    struct arena *a = rig_arena();
    for (int k = 0; k < 4; k++) {
        struct scene s = made(
            a, arena_format(
                   a,
                   "surface: {roughness: {rms: 5 um}, along: x}\nmotion: {path: line, from: [7 cm, 0], to: [%s, 1 cm], "
                   "speed: 20 cm/s}\n",
                   ends[k]));
        struct rig *g = rig_record(&s, ITEM_SUBFORCE, 2400, 1024);
        for (long i = 0; i < 2400 * g->per_frame; i++)
            ck_assert_double_lt(fabs(g->x[i]), k < 3 ? 1e-300 : 1e-6);
        rig_close(g);
    }
}
END_TEST

/* A smoothing of seconds is refused before its kernels are made: 50 us x 1000 m / 3 cm, and 10 ms x 1000 m / 3 cm at
 * the finest rate. */
START_TEST(a_smoothing_of_seconds_is_refused)
{
    static const double smoothing[] = {50e-6, 10e-3, 10e-3};
    static const char *const models[] = {"directional", "directional", "paper"};
    struct arena *a = rig_arena();
    for (int k = 0; k < 3; k++) {
        struct scene s =
            made(a, arena_format(a, "surface: {roughness: {}}\ncontact: {force: %s}\naccuracy: {oversampling: 64}\n%s",
                                 models[k], reversing));
        struct plan p;
        struct run r;
        struct err e = {0};
        s.output.sample_rate = 768000;
        s.output.diagnostics.given = true;
        *(double *)rig_edit(&s, &smooth_stage) = smoothing[k];
        ((struct limiter *)rig_edit(&s, &limiter_stage))->alpha = 1000; /* the scene's text would be refused */
        ck_assert(plan_make(stages_table, &s.contacts[0], &s, a, &p, &e));
        ck_assert(!run_open(&r, &p, &s, NULL, &e)); /* before the table stage opens */
        ck_assert_int_eq(e.kind, ERR_SCENE);
        ck_assert_msg(strstr(e.text, "contact.smoothing") != NULL, "%s", e.text);
    }
}
END_TEST

/* Sample n of the force belongs to n / rate, where a hat has its middle: a force of 40 Hz and less is there the hat's
   mean to second order; half a sub-interval early or late is 1e-3 off. */
START_TEST(the_audio_force_is_not_delayed)
{
    static const int overs[] = {1, 3, 4, 7};
    struct arena *a = rig_arena();
    for (int k = 0; k < 4; k++) {
        struct scene s = made(
            a, arena_format(
                   a,
                   "surface: {roughness: {rms: 5 um, shortest: 5 mm, longest: 10 mm}}\naccuracy: {oversampling: %d}\n"
                   "contact: {beta1: 0, smoothing: 0 s, limiter: {curve: none}}\n"
                   "motion: {path: line, to: [3 cm, 0], speed: 20 cm/s}\n",
                   overs[k]));
        struct rig *fine = rig_record(&s, ITEM_SUBFORCE, 6000, 1024), *g = rig_record(&s, ITEM_FORCE, 6000, 1024);
        double off = 0, all = 0;
        for (long n = 1000; n < 6000; n++) {
            double want = fine->x[n * overs[k]];
            off += (g->x[n] - want) * (g->x[n] - want);
            all += want * want;
        }
        printf("oversampling %d: %.3g\n", overs[k], sqrt(off / all));
        ck_assert_double_lt(sqrt(off / all), 1e-4);
        rig_close(fine);
        rig_close(g);
    }
}
END_TEST

/* The audio force where tanh saturates, against 64 sub-intervals a sample: of third order (plain means are of
   second: 4.4 a doubling), as images of f_v, whose spectrum falls as 1/f, fold in with sinc^2. */
START_TEST(third_order_in_the_sub_intervals)
{
    static const int overs[] = {2, 4, 8, 64};
    struct rig *g[4];
    double off[3] = {0};
    for (int k = 0; k < 4; k++) {
        struct scene s =
            made(rig_arena(),
                 arena_format(rig_arena(),
                              "surface: {roughness: {rms: 5 um, shortest: 20 um}}\naccuracy: {oversampling: %d}\n"
                              "contact: {beta1: 0, smoothing: 0 s, limiter: {alpha: 1 cm}}\n"
                              "motion: {path: line, to: [3 cm, 0], speed: 25 cm/s}\n",
                              overs[k]));
        g[k] = rig_record(&s, ITEM_FORCE, 4000, 1024);
    }
    for (int k = 0; k < 3; k++) {
        for (long n = 500; n < 4000; n++)
            off[k] += pow(g[k]->x[n] - g[3]->x[n], 2) / 3500;
        off[k] = sqrt(off[k]);
        printf("oversampling %d: rms error %.3g N\n", overs[k], off[k]);
    }
    for (int k = 0; k < 2; k++)
        ck_assert_double_gt(off[k] / off[k + 1], pow(2, 2.8));
    for (int k = 0; k < 4; k++)
        rig_close(g[k]);
}
END_TEST

/* A force that stands at 1 N, then jumps: B-splines by their definition, 1 - |t - t_j| / dt; they add up to the mean.
 */
START_TEST(bsplines_add_up)
{
    struct bspline h = {.early = {0.5, 0.5, 0.5, 0}, .late = {0.5, 0.5, 0.25, 0}};
    struct board b = {.rate = 48000, .over = 1};
    double x[4] = {9, 9, 9, 9};
    static const double want[] = {0.5, 1, 1, 0.25};
    b.signals[ITEM_SUBFORCE] = (struct signal){.per_frame = 1, .capacity = 4, .x = x};
    path_integral_lay(&h, &b, 0, 2);
    h.early[0] = h.early[2], h.late[0] = h.late[2], h.early[1] = h.late[1] = 0;
    path_integral_lay(&h, &b, 2, 2);
    for (int i = 0; i < 4; i++)
        ck_assert_double_eq(x[i], want[i]);
    ck_assert_double_eq(x[0] + x[1] + x[2] + x[3], 1 + 1 + 0.75);
}
END_TEST

static struct relief_part *flat_part(struct arena *a, const struct contact *c)
{
    double z[4] = {1e-3, 1e-3, 1e-3, 1e-3};
    (void)c;
    return profile_part(a, profile_from_samples(a, z, 4, 1e-5, OFF_MAP_WRAP), "flat", 0);
}

/* A flat surface (4 samples of the same height) gives no force: what the spline's coefficients leave of it by rounding.
 */
START_TEST(flat_surface_is_silent)
{
    struct scene s = made(rig_arena(), arena_format(rig_arena(), "surface: {roughness: {}}\n%s", reversing));
    rig_relief = flat_part;
    struct rig *g = rig_record(&s, ITEM_FORCE, 2000, 1024);
    for (long n = 0; n < 2000; n++)
        ck_assert(g->x[n] == 0);
    rig_close(g);
}
END_TEST

/* A limiter that never bites is no limiter; one that always bites bounds |S''| by 1/alpha, so |force| <= m v^2/alpha +
 * leak and S' a terms. */
START_TEST(limits_of_the_limiter)
{
    struct arena *a = rig_arena();
    const double alphas[] = {0, 1e-11, 1000};
    double *x[3], largest[3] = {0};
    for (int k = 0; k < 3; k++) {
        struct scene s = made(a, arena_format(a,
                                              "surface: {roughness: {rms: 1 um, shortest: 1 mm, longest: 2 "
                                              "mm}}\ncontact: {beta1: 0, smoothing: 0 s}\n%s",
                                              reversing));
        struct limiter *limiter = rig_edit(&s, &limiter_stage);
        limiter->curve = k == 0 ? LIMITER_NONE : LIMITER_TANH;
        limiter->alpha = alphas[k];
        struct rig *g = rig_record(&s, ITEM_SUBFORCE, 2000, 1024);
        x[k] = g->x;
        g->x = NULL;
        rig_close(g);
        for (long i = 0; i < 8000; i++)
            largest[k] = fmax(largest[k], fabs(x[k][i]));
    }
    for (long i = 0; i < 8000; i++)
        ck_assert_double_eq_tol(x[1][i], x[0][i], 1e-12 * largest[0]);
    for (int k = 0; k < 3; k++)
        free(x[k]);
    /* top speed pi 30 Hz 4 mm = 0.377 m/s; |S'| <= leak/alpha */
    double v = 0.377, acceleration = 71.1;
    ck_assert_double_lt(largest[2], 0.02 * (2 * v * v / 1000 + acceleration * 2e-3 / 1000) * 1.01);
    ck_assert_double_gt(largest[2], 0.02 * v * v / 1000 * 0.2);
}
END_TEST

/* The hand lifts the scraper: exactly no force by a hat both of whose sub-intervals have N < 0; counted. omega^2 L tan
 * theta = 4.2 g here. */
START_TEST(no_force_while_lifted_off)
{
    struct arena *a = rig_arena();
    struct scene s = made(
        a, arena_format(a, "surface: {roughness: {rms: 5 um}}\ngrip: {angle: 30 deg}\ncontact: {smoothing: 0 s}\n%s",
                        reversing));
    struct rig *g = rig_record(&s, ITEM_SUBFORCE, 2400, 1024);
    const struct board *b = &g->run.board;
    double lifted = 0;
    bool before = false;
    for (long i = 0; i < 2400 * 4; i++) {
        double t[2] = {(double)i / 192000, (double)(i + 1) / 192000}, ax[2], ay[2], load[2];
        trajectory_at(b->trajectory, 2, t, (struct trajectory_out){.ax = ax, .ay = ay});
        load_at(b->load, 2, t, ax, ay, load);
        bool up = load[0] + load[1] < 0;
        if (up && before) ck_assert(g->x[i] == 0);
        before = up;
        lifted += up ? 1.0 / 192000 : 0;
    }
    ck_assert_double_gt(lifted, 0.015);
    ck_assert_double_eq_tol(b->lifted, lifted, 1e-4);
    rig_close(g);
}
END_TEST

/* What the table tells of the way, over ten waves of sine ridges at 480 frames a wave: their height, and S, which is they
   behind both leaks, (i q)^2 / (i q + 1/l)^2. To be asked for it changes no bit of the force. */
START_TEST(ground_and_trajectory)
{
    enum { FROM = 4800, FRAMES = 9600 };
    struct scene s = made(rig_arena(), "surface: {along: x, ridges: {spacing: 1 mm, height: 20 um}}\n"
                                       "contact: {smoothing: 0 s, leak: 0.5 mm, limiter: {curve: none}}\n"
                                       "motion: {path: line, to: [20 mm, 0], speed: 10 cm/s}\n");
    struct rig *g = rig_record(&s, ITEM_FOLLOWED, FRAMES, 1000), *plain = rig_record(&s, ITEM_SUBFORCE, FRAMES, 1000);
    double q = 2 * M_PI / 1e-3;
    double _Complex wave[FOLLOWED_VALUES] = {0}, passes = I * q / (I * q + 1 / 0.5e-3);
    ck_assert_int_eq(g->per_frame, FOLLOWED_VALUES);
    for (int n = FROM; n < FRAMES; n++)
        for (int k = 0; k < FOLLOWED_VALUES; k++)
            wave[k] += g->x[n * FOLLOWED_VALUES + k] * cexp(-2 * M_PI * I * (n % 480) / 480) * 2 / (FRAMES - FROM);
    printf("ground %.9g m, S %.9g of it\n", cabs(wave[FOLLOWED_GROUND]),
           cabs(wave[FOLLOWED_TRAJECTORY] / wave[FOLLOWED_GROUND])),
        fflush(stdout);
    ck_assert_double_eq_tol(cabs(wave[FOLLOWED_GROUND]), 1e-5, 1e-17);
    ck_assert_double_lt(cabs(wave[FOLLOWED_TRAJECTORY] / wave[FOLLOWED_GROUND] - passes * passes), 1e-5);
    rig_probe.also = ITEM_BIT(ITEM_FOLLOWED);
    struct rig *told = rig_record(&s, ITEM_SUBFORCE, FRAMES, 1000);
    rig_probe.also = 0;
    ck_assert(memcmp(told->x, plain->x, (size_t)(FRAMES * told->per_frame) * sizeof *told->x) == 0);
    rig_close(g);
    rig_close(plain);
    rig_close(told);
}
END_TEST

UNIT("scrape", vertical_force_through_reversals, unlimited_force_through_reversals, alpha_that_varies, horizontal_force,
     sub_intervals_are_cut_at_turns, oblique_stroke_over_an_extruded_profile, means_are_exact, blocks_do_not_matter,
     a_turn_in_the_middle_of_a_sample, a_stroke_straight_across_but_for_rounding, a_smoothing_of_seconds_is_refused,
     the_audio_force_is_not_delayed, third_order_in_the_sub_intervals, bsplines_add_up, flat_surface_is_silent,
     limits_of_the_limiter, no_force_while_lifted_off, ground_and_trajectory)
