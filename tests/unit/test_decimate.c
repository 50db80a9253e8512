/* Down to the audio rate from the first sample on: what every contact model that may begin at full height has handed
   over by its sub-intervals, the samples hold, too. The sums of both are taken from the pipeline itself, once before
   decimation and once after; the smoothing that decimation may join to its kernel is in both. */
#include "rig.h"

enum { FRAMES = 3000 };

struct start {
    const char *name, *text;
};

#define HEAD                                                                                                           \
    "rasp: 1\nseed: 3\naccuracy: {oversampling: %d}\n"                                                                 \
    "output: {sample_rate: %d, ramp: 0, quantity: force, diagnostics: {}}\n"
#define GROUND "surface: {roughness: {rms: 5 um}}\n"
#define STILL "motion: {path: still, duration: 0.05 s}\n"
#define PRESSED "scraper: {mass: 20 g}\nload: {constant: 1 N, approach: 0}\n"
#define BALL "ball: {radius: 1 cm, material: steel}\nload: {approach: 0}\n"
#define LINE "motion: {path: line, law: constant, from: [1 cm, 0], to: [5 cm, 0], duration: 0.05 s}\n"

static const struct start starts[] = {
    {"scrape", HEAD GROUND LINE PRESSED},
    {"scrape, unsmoothed", HEAD GROUND LINE PRESSED "contact: {smoothing: 0}\n"},
    {"scrape, paper", HEAD GROUND LINE PRESSED "contact: {force: paper}\n"},
    {"scrape, grip", HEAD GROUND LINE "scraper: {mass: 20 g}\ngrip: {angle: 20 deg}\nload: {approach: 0}\n"},
    {"roll", HEAD GROUND LINE BALL "contact: {model: roll}\n"},
    {"roll_coupled", HEAD GROUND LINE BALL "contact: {model: roll_coupled, roll: {stiffness: 1e8}}\n"},
    {"playback", HEAD GROUND LINE "load: {approach: 0}\ncontact: {model: playback}\n"},
    {"impacts", HEAD STILL "load: {approach: 0}\ncontact: {model: impacts, impacts: {prototype: rub}}\n"},
    {"strike",
     HEAD STILL "scraper: {mass: 3 g}\n"
                "contact: {model: strike, strike: {first: 0, pulse: half_sine, stiffness: 1e9, speed: 1 m/s}}\n"},
};
enum { STARTS = sizeof starts / sizeof starts[0] };

static struct rig *rigged(const struct start *s, int rate, int over, enum item item, int block)
{
    struct arena *a = rig_arena();
    struct scene scene = rig_scene(a, arena_format(a, s->text, over, rate));
    return rig_record(&scene, item, FRAMES, block);
}

/* 1e-6 of the sum of magnitudes: the kernel's phases differ by 2e-7. Where a smoothing is joined 1e-7 of that kernel is
   cut off. */
START_TEST(momentum_from_the_first_sample)
{
    static const int rates[] = {22050, 48000}, overs[] = {1, 4, 16};
    for (int n = 0; n < STARTS * 6; n++) {
        const struct start *start = &starts[n / 6];
        int r = n % 2, k = n / 2 % 3;
        struct rig *before = rigged(start, rates[r], overs[k], ITEM_SUBFORCE, 1024);
        struct rig *after = rigged(start, rates[r], overs[k], ITEM_FORCE, 1024);
        double in = 0, out = 0, size = 0, early = 0;
        for (long i = 0; i < (long)FRAMES * overs[k]; i++) {
            in += before->x[i] / overs[k];
            size += fabs(before->x[i]) / overs[k];
            early = fmax(early, i < overs[k] ? fabs(before->x[i]) : 0);
        }
        for (long i = 0; i < FRAMES; i++)
            out += after->x[i];
        ck_assert_msg(early > 0.02 * size / FRAMES, "%s does not begin at full height: %g of %g", start->name, early,
                      size / FRAMES);
        ck_assert_msg(fabs(out - in) < 1e-6 * size, "%s, %d Hz by %d: %.9g becomes %.9g, of %.3g", start->name,
                      rates[r], overs[k], in, out, size);
        rig_close(before);
        rig_close(after);
    }
}
END_TEST

/* However the first frames are cut into blocks. */
START_TEST(blocks_of_any_length)
{
    const struct start *start = &starts[STARTS - 1];
    struct rig *whole = rigged(start, 48000, 4, ITEM_FORCE, 1024);
    for (int block = 1; block < 200; block = 3 * block + 2) {
        struct rig *cut = rigged(start, 48000, 4, ITEM_FORCE, block);
        ck_assert_mem_eq(whole->x, cut->x, FRAMES * sizeof *cut->x);
        rig_close(cut);
    }
    rig_close(whole);
}
END_TEST

UNIT("decimate", momentum_from_the_first_sample, blocks_of_any_length)
