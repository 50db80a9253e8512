/* error_pilot: what the blocks that are run of a long motion say of all of it, beside the whole motion. */
#include "pipeline/error_pilot.h"

#include "rig.h"
#include "scene/accuracy.h"

/* A second and a half each: strokes with rests between, a circle in the plane, a ball, and grains whose edges lie inside
   cells, so that the difference hardly falls until sub-intervals are shorter than these. */
static const char *const scenes[] = {
    "surface: {roughness: {rms: 5 um}}\nscraper: {mass: 20 g}\n"
    "motion: {path: four_in_line, to: [5 cm, 0], strokes: 4, duration: 1.5 s}\n",
    "surface: {roughness: {rms: 5 um}, along: plane}\nscraper: {mass: 20 g}\n"
    "motion: {path: circle, radius: 1 cm, turns: 2, duration: 1.5 s}\n",
    "surface: {roughness: {rms: 1 um, longest: 2 mm}}\nball: {radius: 5 mm, material: steel}\ncontact: {model: roll}\n"
    "motion: {path: line, to: [30 cm, 0], duration: 1.5 s}\n",
    "surface: {grit: {diameter: 200 um, density: 3e6 /m^2}, along: x}\nscraper: {mass: 7 g}\n"
    "contact: {limiter: {alpha: 8 cm}}\nmotion: {path: line, to: [1.5 m, 0], duration: 1.5 s}\n"};

static struct error_pilot *made(const struct scene *s, bool follows, bool sampled)
{
    struct error_pilot *p = ARENA_TAKE(rig_arena(), struct error_pilot, 1);
    struct err e = {0};
    ck_assert_msg(error_pilot_make(s, s->contacts, 0.5, false, sampled, rig_arena(), p, &e), "%s", e.text);
    ck_assert(p->follows);
    p->follows = follows;
    return p;
}

static void compare(struct error_pilot *p, double over, bool going)
{
    struct accuracy set = p->scene.accuracy, finer = set;
    struct err e = {0};
    accuracy_turn(&set, KNOB_oversampling, over);
    accuracy_turn(&finer, KNOB_oversampling, 2 * over);
    ck_assert_msg(error_pilot_run(p, &set, &finer, going, &e), "%s", e.text);
}

/* A block that is run begins from an empty board, so that its limited trajectory has not settled in quite the same way:
   its difference is that of the whole motion to 2 %. The sum is within 6 dB, which a knob's error has in hand. */
START_TEST(as_the_whole_motion)
{
    for (int k = 0; k < 4; k++)
        for (int seed = 1; seed <= 3; seed++) {
            struct scene s =
                rig_scene(rig_arena(), arena_format(rig_arena(), "rasp: 1\nseed: %d\n%soutput: {quantity: force}\n",
                                                    seed, scenes[k]));
            struct error_pilot *some = made(&s, true, false), *whole = made(&s, false, false);
            for (double over = 1; over <= 8; over *= 2) {
                compare(some, over, over > 1);
                compare(whole, over, over > 1);
                for (int i = 0; over > 2 && i < PILOT_FOLLOWED; i++) {
                    long b = some->block[i].number;
                    ck_assert(i == 0 || b > some->block[i - 1].number);
                    ck_assert_double_eq_tol(some->distance[b], whole->distance[b],
                                            0.02 * whole->distance[b] + 1e-12 * whole->energy / (double)whole->blocks);
                }
                double off = error_pilot_distance(some, true) / error_pilot_distance(whole, true);
                printf("scene %d, seed %d, %g: %.2f dB\n", k, seed, over, 10 * log10(off));
                ck_assert_msg(off > 0.25 && off < 4, "%g", off);
            }
        }
}
END_TEST

/* Six blocks stand for all: errors relative to the energy are within a factor 8 of the whole motion's, of which a preset
   has 4 in hand and the next doubling the rest. Not of strokes, whose error lies at their rests: no block is there. Nor
   below -130 dB, where the two ends of a motion are most of it. */
START_TEST(sampled)
{
    for (int k = 1; k < 4; k++)
        for (int seed = 1; seed <= 3; seed++) {
            struct scene s =
                rig_scene(rig_arena(), arena_format(rig_arena(), "rasp: 1\nseed: %d\n%soutput: {quantity: force}\n",
                                                    seed, scenes[k]));
            struct error_pilot *some = made(&s, true, true), *whole = made(&s, false, false);
            for (double over = 1; over <= 4; over *= 2) {
                compare(some, over, over > 1);
                compare(whole, over, over > 1);
                double off = (1e-13 + error_pilot_distance(some, true) / some->energy) /
                             (1e-13 + error_pilot_distance(whole, true) / whole->energy);
                printf("scene %d, seed %d, %g: sampled %.2f dB\n", k, seed, over, 10 * log10(off));
                fflush(stdout);
                ck_assert_msg(off > 1.0 / 8 && off < 8, "%g", off);
            }
        }
}
END_TEST

/* What output.ramp takes from a force, and output.duration cuts, counts neither as energy nor as error: beside the force
   itself under the same ramp. A pulse of 0.6 ms 5 us, 3 ms and 30 ms after the start, and in a sound that ends within
   it. Windows weigh instants unlike each other, by up to 3 dB. */
START_TEST(under_ramps)
{
    static const struct {
        const char *first, *output;
        double end;
    } cases[] = {{"5 us", "ramp: 10 ms", HUGE_VAL},
                 {"3 ms", "ramp: 10 ms", HUGE_VAL},
                 {"30 ms", "ramp: 10 ms", HUGE_VAL},
                 {"30 ms", "ramp: 1 ms, duration: 30.8 ms", 0.0308}};
    for (int k = 0; k < 4; k++) {
        double energy[2], kept = 0, all = 0;
        for (int plain = 0; plain < 2; plain++) {
            struct scene s = rig_scene(
                rig_arena(), arena_format(rig_arena(),
                                          "rasp: 1\nscraper: {mass: 20 g}\ncontact: {model: strike, strike: {speed: 1 "
                                          "m/s, pulse: half_sine, stiffness: 5e5 N/m, first: %s}}\nmotion: {path: "
                                          "still, duration: 0.1}\noutput: {quantity: force, %s}\n",
                                          cases[k].first, plain ? "ramp: 0" : cases[k].output));
            struct error_pilot *p = ARENA_TAKE(rig_arena(), struct error_pilot, 1);
            struct err e = {0};
            ck_assert_msg(error_pilot_make(&s, s.contacts, 0.5, false, false, rig_arena(), p, &e), "%s", e.text);
            ck_assert_msg(error_pilot_run(p, &s.accuracy, NULL, false, &e), "%s", e.text);
            energy[plain] = p->energy;
            double ramp = s.output.ramp * s.output.sample_rate, end = cases[k].end * s.output.sample_rate;
            for (long i = 0; !plain && i < p->some; i++) {
                double edge = fmin((double)i + 0.5, rint(end) - (double)i - 0.5),
                       gain = edge <= 0     ? 0
                              : edge < ramp ? sin(M_PI / 2 * edge / ramp)
                                            : 1;
                kept += p->last[i] * p->last[i] * pow(gain, 4);
                all += p->last[i] * p->last[i];
            }
        }
        double off = 10 * log10(energy[0] / energy[1] * all / kept);
        printf("case %d: %.2f dB left, %.2f dB off\n", k, 10 * log10(kept / all), off);
        ck_assert_msg(fabs(off) < 3, "%g", off);
    }
}
END_TEST

UNIT("error_pilot", UNIT_PLAIN(as_the_whole_motion), sampled, under_ramps)
