/* gesture: the low-pass at steady speeds against its closed form, what it does at rest, under any modulation and above
   its limit, on straight and curved motions, and how the force begins and ends. */
#include "contacts.h"
#include "force/gesture.h"
#include "num/noise.h"
#include "rig.h"
#include "scene/params.h"

extern const struct stage gesture_stage;

struct hand {
    struct arena *arena;
    struct scene scene;
    struct contact contact;
    struct trajectory trajectory;
    struct board board;
    struct stage_run run;
    double *force, *velocity;
    long n;
};

/* A line gone along at 1 m/s for 100 s; the tests say how fast it goes by `velocity`. */
static struct hand hand_open(double rate, double cutoff, int order, long n)
{
    struct hand h = {.arena = arena_open(), .n = n, .board = {.rate = rate, .over = 1}};
    h.contact = shot_contact(CONTACT_IMPACTS, 100);
    h.contact.motion = (struct motion){.path = PATH_LINE, .to = {100, 0}, .speed = NAN, .duration = 100};
    *(struct gesture *)params_edit(&h.contact, gesture_stage.params, h.arena) =
        (struct gesture){true, cutoff, 1, order};
    return h;
}

static void hand_begin(struct hand *h)
{
    struct err e = {0};
    ck_assert_msg(trajectory_make(&h->contact.motion, 1, h->arena, &h->trajectory, &e), "%s", e.text);
    h->board.trajectory = &h->trajectory;
    h->run = (struct stage_run){
        .stage = &gesture_stage, .scene = &h->scene, .contact = &h->contact, .board = &h->board, .arena = h->arena};
    ck_assert_msg(gesture_stage.open(&h->run, &e), "%s", e.text);
    for (int k = 0; k < 2; k++) {
        struct signal *s = &h->board.signals[k ? ITEM_VELOCITY : ITEM_FORCE];
        *s = (struct signal){1, 0, h->n, 0, ARENA_TAKE(h->arena, double, h->n + 8)};
    }
    h->force = h->board.signals[ITEM_FORCE].x;
    h->velocity = h->board.signals[ITEM_VELOCITY].x;
}

static void hand_run(struct hand *h)
{
    struct err e = {0};
    for (long from = 0; from < h->n; from += 777)
        ck_assert(gesture_stage.run(&h->run, from, from + 777 < h->n ? from + 777 : h->n, &e));
}

/* No approach, no release. */
static struct hand hand_bare(double rate, double cutoff, int order, long n)
{
    struct hand h = hand_open(rate, cutoff, order, n);
    h.contact.load.approach = h.contact.load.release = 0;
    return h;
}

/* ------------------------------------------------------------------ steady speeds */

static double gain_at(const double *x, long n, double f, double rate)
{
    double re = 0, im = 0;
    for (long i = 0; i < n; i++) {
        re += x[i] * cos(2 * M_PI * f * (double)i / rate);
        im += x[i] * sin(2 * M_PI * f * (double)i / rate);
    }
    return sqrt(re * re + im * im);
}

/* |H| = 1 / sqrt(1 + r^(2 order)), r = tan(pi f / rate) / tan(pi f_c / rate): Butterworth's under the bilinear
   transform, -3 dB at f_c = cutoff v. The impulse response has died to 1e-13 within 30 / (2 pi f_c) s. Either direction
   of the motion is the same. */
START_TEST(steady_speeds)
{
    const double rates[] = {22050, 48000, 192000}, speeds[] = {-0.3, 0.05, 1, 2.2},
                 parts[] = {0.01, 0.25, 0.5, 1, 2, 4};
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < 4; k++)
            for (int order = 1; order <= 2; order++) {
                double cutoff = 4000 * fabs(speeds[k]);
                struct hand h = hand_bare(rates[r], 4000, order, (long)(rates[r] * (8 / cutoff)) + 64);
                hand_begin(&h);
                for (long i = 0; i < h.n; i++)
                    h.velocity[i] = speeds[k];
                h.force[0] = 1;
                hand_run(&h);
                ck_assert_double_eq_tol(gain_at(h.force, h.n, cutoff, rates[r]), sqrt(0.5), 1e-11);
                for (int p = 0; p < 6; p++) {
                    double f = parts[p] * cutoff, ratio = tan(M_PI * f / rates[r]) / tan(M_PI * cutoff / rates[r]);
                    if (f < rates[r] / 2)
                        ck_assert_double_eq_tol(gain_at(h.force, h.n, f, rates[r]), 1 / sqrt(1 + pow(ratio, 2 * order)),
                                                1e-11);
                }
                arena_close(h.arena);
            }
}
END_TEST

/* 6 and 12 dB an octave, far above the cutoff and far below half the rate: to 0.1 dB. */
START_TEST(slopes)
{
    for (int order = 1; order <= 2; order++) {
        struct hand h = hand_bare(192000, 200, order, 40000);
        hand_begin(&h);
        for (long i = 0; i < h.n; i++)
            h.velocity[i] = 1;
        h.force[0] = 1;
        hand_run(&h);
        double octave = 20 * log10(gain_at(h.force, h.n, 2000, 192000) / gain_at(h.force, h.n, 4000, 192000));
        ck_assert_double_eq_tol(octave, 6.02 * order, 0.1);
        arena_close(h.arena);
    }
}
END_TEST

/* ------------------------------------------------------------------ at rest, and in between */

/* A constant force passes whatever the speed does; at rest what there is stands still to the bit, and goes on from
 * there. */
START_TEST(at_rest)
{
    for (int order = 1; order <= 2; order++) {
        struct hand h = hand_bare(48000, 5000, order, 9000);
        hand_begin(&h);
        for (long i = 0; i < h.n; i++) {
            h.velocity[i] = i < 3000 ? 1 : i < 6000 ? 0 : 0.5 + 0.5 * sin((double)i / 20);
            h.force[i] = i < 2500 ? sin((double)i * (double)i / 3000) : i < 3000 ? 2 : i < 6000 ? 100 : 2;
        }
        hand_run(&h);
        ck_assert_double_eq_tol(h.force[2999], 2, 1e-10);
        for (long i = 3001; i < 6000; i++)
            ck_assert(h.force[i] == h.force[3000]);
        for (long i = 3000; i < 9000; i++)
            ck_assert_double_eq_tol(h.force[i], 2, 1e-9);
        arena_close(h.arena);
    }
}
END_TEST

/* A motion that starts from rest starts without a force: nothing comes through while it rests. */
START_TEST(from_rest)
{
    struct hand h = hand_bare(48000, 5000, 2, 1000);
    hand_begin(&h);
    for (long i = 0; i < h.n; i++)
        h.force[i] = 1;
    hand_run(&h);
    for (long i = 0; i < h.n; i++)
        ck_assert(h.force[i] == 0);
    arena_close(h.arena);
}
END_TEST

/* Speeds that jump about from sample to sample, from 0 to beyond the limit, and that swing at any audio frequency: a
   white force within 1 stays within 30, what is left of it when it ends does not grow for 10 s, and at a steady speed
   dies away. */
START_TEST(any_modulation)
{
    struct noise noise = noise_make(1, "modulation");
    for (int k = 0; k < 12; k++) {
        struct hand h = hand_bare(48000, 20000, 1 + k % 2, 490000);
        double most = 0, after = 0;
        hand_begin(&h);
        for (long i = 0; i < h.n; i++) {
            double u = noise_uniform(noise, (uint64_t)i, (uint64_t)k),
                   swing = 0.5 + 0.5 * sin(2 * M_PI * pow(4, k / 2) * 20 * (double)i / 48000);
            h.velocity[i] = i >= 480000 ? 0.5 : k < 2 ? 2 * u * u * u : 1.2 * swing * swing;
            h.force[i] = i < 24000 ? 2 * noise_uniform(noise, (uint64_t)i, 100) - 1 : 0;
        }
        hand_run(&h);
        for (long i = 0; i < h.n; i++) {
            double *greatest = i < 24000 ? &most : &after;
            *greatest = fmax(*greatest, fabs(h.force[i]));
        }
        ck_assert_double_le(most, 30);
        ck_assert_double_le(after, 30);
        ck_assert_double_le(fabs(h.force[h.n - 1]), 1e-12);
        arena_close(h.arena);
    }
}
END_TEST

/* Above 0.49 of the rate it counts as open: a tenth of a decibel at 0.35 of the rate; and that is told. */
START_TEST(above_the_limit)
{
    struct hand h = hand_bare(48000, 1e6, 2, 4000);
    hand_begin(&h);
    ck_assert_int_eq(h.board.n_warnings, 1);
    ck_assert_msg(strstr(h.board.warnings[0], "the cutoff reaches 1e+06 Hz at 1 m/s; above 23520 Hz, 0.49 of the "
                                              "sample rate, the low-pass counts as open") != NULL,
                  "%s", h.board.warnings[0]);
    for (long i = 0; i < h.n; i++)
        h.velocity[i] = 1;
    h.force[0] = 1;
    hand_run(&h);
    ck_assert_double_eq_tol(gain_at(h.force, h.n, 0.35 * 48000, 48000), 1, 0.01);
    arena_close(h.arena);
    h = hand_bare(48000, 23500, 2, 10);
    hand_begin(&h);
    ck_assert_int_eq(h.board.n_warnings, 0);
    arena_close(h.arena);
}
END_TEST

/* ------------------------------------------------------------------ beginning and end */

/* What is lowered and raised: from 0, over 5 ms, to 0 at the motion's end and after it, also where what is held at rest
   would stay. A given force begins as it is, and is let go too. */
START_TEST(begins_and_ends)
{
    for (int given = 0; given < 2; given++) {
        struct hand h = hand_open(48000, 5000, 2, 6000);
        h.contact.contact.model = given ? CONTACT_GIVEN : CONTACT_IMPACTS;
        h.contact.load.approach = h.contact.load.release = NAN;
        h.contact.motion.duration = 0.1;
        hand_begin(&h);
        for (long i = 0; i < h.n; i++) {
            h.velocity[i] = i < 4000 ? 1 : 0;
            h.force[i] = 1;
        }
        hand_run(&h);
        ck_assert(given ? h.force[0] > 0.05 : h.force[0] == 0);
        ck_assert_double_eq_tol(h.force[120], given ? 1 : 0.5, 0.03);
        ck_assert_double_eq_tol(h.force[4559], 1, 1e-9);
        ck_assert_double_eq_tol(h.force[4680], 0.5, 0.03);
        for (long i = 4800; i < h.n; i++)
            ck_assert(h.force[i] == 0);
        arena_close(h.arena);
    }
}
END_TEST

/* ------------------------------------------------------------------ in the pipeline */

static const char *const rubs = "rasp: 1\n"
                                "motion: %s\n"
                                "contact: {model: impacts, impacts: {prototype: rub}, gesture: {cutoff: %s}}\n"
                                "output: {sample_rate: 44100, diagnostics: {}}\n";

static struct rig *rubbed(const char *motion, const char *cutoff, enum item item)
{
    struct scene s = rig_scene(rig_arena(), arena_format(rig_arena(), rubs, motion, cutoff));
    return rig_record(&s, item, 8820, STAGE_BLOCK);
}

/* Round a circle and along a line at the same speed: the same force, but for rounding. The cutoff is that of the speed,
   on both: with the speed halved and the cutoff doubled it is the same again. */
START_TEST(motions)
{
    struct rig *line = rubbed("{path: line, to: [10 cm, 0], speed: 50 cm/s}", "2 kHz", ITEM_FORCE);
    struct rig *circle =
        rubbed("{path: circle, radius: 2 cm, turns: 0.7957747154594768, speed: 50 cm/s}", "2 kHz", ITEM_FORCE);
    struct rig *slow = rubbed("{path: line, to: [5 cm, 0], speed: 25 cm/s}", "4 kHz", ITEM_FORCE),
               *other = rubbed("{path: line, to: [5 cm, 0], speed: 25 cm/s}", "2 kHz", ITEM_FORCE);
    double most = 0, apart = 0;
    for (long i = 0; i < 8820; i++) {
        ck_assert_double_eq_tol(circle->x[i], line->x[i], 1e-9);
        ck_assert_double_eq_tol(slow->x[i], line->x[i], 1e-9);
        most = fmax(most, fabs(line->x[i]));
        apart = fmax(apart, fabs(other->x[i] - line->x[i]));
    }
    ck_assert_double_ge(most, 0.05);
    ck_assert_double_ge(apart, 0.02);
    rig_close(line);
    rig_close(circle);
    rig_close(slow);
    rig_close(other);
}
END_TEST

/* Under a gesture nothing is lowered before the low-pass: the stage approach does not run. */
START_TEST(no_approach_beside_it)
{
    struct rig *g = rubbed("{path: line, to: [10 cm, 0], speed: 50 cm/s}", "2 kHz", ITEM_FORCE);
    for (int i = 0; i < g->run.n; i++)
        ck_assert_str_ne(g->run.stages[i].stage->name, "approach");
    ck_assert(g->x[0] == 0);
    rig_close(g);
}
END_TEST

UNIT("gesture", steady_speeds, slopes, at_rest, from_rest, any_modulation, above_the_limit, begins_and_ends, motions,
     no_approach_beside_it)
