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

UNIT("error_pilot", as_the_whole_motion, sampled)
