/* Smoothing against its definition by brute force, and momentum. */
#include "num/filter.h"
#include "rig.h"
#include "surface/limiter.h"
#include "trajectory/load.h"
#include "trajectory/trajectory.h"

static const char *const text = "rasp: 1\n"
                                "seed: 5\n"
                                "output: {diagnostics: {}}\n"
                                "scraper: {mass: 20 g}\n"
                                "surface: {roughness: {rms: 5 um}}\n"
                                "%s\n";
#define SLOW "motion: {path: back_and_forth, from: [1 cm, 0], to: [5 cm, 0], rate: 4 Hz, duration: 0.1 s}\n"
#define FAST "motion: {path: back_and_forth, from: [1 cm, 0], to: [1.1 cm, 0], rate: 99 Hz, duration: 0.1 s}\n"
enum { FRAMES = 6000, OVER = 4 };

static struct rig *recorded(const char *rest, double smoothing)
{
    struct arena *a = rig_arena();
    struct scene s = rig_scene(a, arena_format(a, text, rest));
    *(double *)rig_edit(&s, &smooth_stage) = smoothing;
    return rig_record(&s, ITEM_SUBFORCE, FRAMES, 1024);
}

static double sigma_at(const struct rig *g, long i, double smoothing)
{
    const struct board *b = &g->run.board;
    double t = (double)i / (48000.0 * OVER), ax, ay, alpha, n;
    if (!b->limiter) return smoothing * limiter_constant(&g->scene.contacts[0]) / 0.03 * 48000 * OVER;
    trajectory_at(b->trajectory, 1, &t, (struct trajectory_out){.ax = &ax, .ay = &ay});
    load_at(b->load, 1, &t, &ax, &ay, &n);
    limiter_alpha(b->limiter, 1, &n, &alpha);
    return smoothing * alpha / 0.03 * 48000 * OVER;
}

/* Every element spreads with a Gaussian of its own width. Returns the relative rms difference. */
static double against_definition(const char *rest, double smoothing)
{
    struct rig *raw = recorded(rest, 0), *smooth = recorded(rest, smoothing);
    static double want[FRAMES * OVER], kernel[4001];
    double off = 0, all = 0, before = 0, after = 0, wanted = 0;
    memset(want, 0, sizeof want);
    for (long i = 0; i < FRAMES * OVER; i++) {
        double sigma = sigma_at(smooth, i, smoothing), sum = 0;
        long reach = (long)ceil(7 * sigma);
        for (long k = -reach; k <= reach; k++)
            sum += kernel[k + reach] = exp(-0.5 * (double)(k * k) / (sigma * sigma));
        for (long k = -reach; k <= reach; k++)
            if (i + k < FRAMES * OVER)
                want[i + k >= 0 ? i + k : -1 - (i + k)] += raw->x[i] * kernel[k + reach] / sum; /* or reflected */
    }
    for (long i = 0; i < FRAMES * OVER; i++) {
        off += (smooth->x[i] - want[i]) * (smooth->x[i] - want[i]);
        all += want[i] * want[i];
        before += raw->x[i];
        wanted += want[i];
        after += smooth->x[i];
    }
    printf("relative rms difference %.3g, sums %.9g %.9g\n", sqrt(off / all), before, after);
    ck_assert_double_eq_tol(after, wanted, 1e-5 * fabs(wanted));
    ck_assert_double_eq_tol(after, before, 1e-9 * fabs(before)); /* 20000 terms, of 100 times that sum, are rounded */
    rig_close(raw);
    rig_close(smooth);
    return sqrt(off / all);
}

START_TEST(constant_width)
{
    ck_assert_double_lt(against_definition(SLOW "load: {constant: 1 N}", 50e-6),
                        1e-9); /* cut at 6.5 sigma: 8e-11 of the sum */
}
END_TEST

/* The stage takes a parabola through three kernels of a table: 2.5e-6. Slowly, and 25 times as fast. */
START_TEST(width_that_follows_alpha)
{
    static const char *const fast =
        FAST "grip: {angle: 20 deg, friction: 0.3}\ncontact: {limiter: {force_range: [0.01 N, 0.3 N]}}";
    ck_assert_double_lt(against_definition(SLOW "grip: {angle: 20 deg}", 50e-6), 1e-5);
    ck_assert_double_lt(against_definition(fast, 50e-6), 1e-5);
}
END_TEST

/* Amplitude of the force at a frequency, behind the approach; a sin^4 window. */
static double tone(const struct rig *g, double hz)
{
    double re = 0, im = 0;
    for (int i = 0; i < FRAMES / 2; i++) {
        double w = pow(sin(M_PI * (i + 0.5) / (FRAMES / 2)), 4), phase = 2 * M_PI * hz * i / 48000;
        re += w * g->x[i + FRAMES / 2] * cos(phase);
        im += w * g->x[i + FRAMES / 2] * sin(phase);
    }
    return hypot(re, im);
}

/* An uneven ball on smooth ground: its force swings slowly, and so does sigma. Kernels that meet with a kink every 64
   elements, 3 kHz here, put a tone there, 30 dB over what lies beside it. */
START_TEST(width_that_varies_makes_no_tone)
{
    struct scene s =
        rig_scene(rig_arena(), "rasp: 1\nball: {radius: 5 mm, material: steel, offset: 0.5 mm}\n"
                               "surface: {roughness: {rms: 0.1 nm}}\ncontact: {model: roll, smoothing: 200 us}\n"
                               "motion: {path: line, to: [20 cm, 0], duration: 0.3 s}\noutput: {diagnostics: {}}\n");
    struct rig *g = rig_record(&s, ITEM_FORCE, FRAMES, 1024);
    double at = tone(g, 3000), beside = 0;
    for (int k = -8; k <= 8; k++)
        beside += abs(k) > 3 ? tone(g, 3000 + 16 * k) / 10 : 0;
    printf("at 3 kHz %.3g, beside it %.3g\n", at, beside);
    ck_assert_double_lt(at, 4 * beside);
    rig_close(g);
}
END_TEST

/* The spectrum of smoothed noise falls as the Gaussian's does: compare energies of first differences, coarse but
 * independent. */
START_TEST(smoothing_removes_high_frequencies)
{
    struct rig *raw = recorded(SLOW "load: {constant: 1 N}", 0),
               *smooth = recorded(SLOW "load: {constant: 1 N}", 50e-6);
    double rough[2] = {0}, level[2] = {0};
    for (long i = 1; i < FRAMES * OVER; i++) {
        rough[0] += pow(raw->x[i] - raw->x[i - 1], 2);
        rough[1] += pow(smooth->x[i] - smooth->x[i - 1], 2);
        level[0] += raw->x[i] * raw->x[i];
        level[1] += smooth->x[i] * smooth->x[i];
    }
    ck_assert_double_lt(rough[1] / level[1], 0.5 * rough[0] / level[0]);
    rig_close(raw);
    rig_close(smooth);
}
END_TEST

/* Where the force at the audio rate is asked for, smoothing and decimation are one kernel: against one after the other,
 * output by output. 1e-7 of the kernel is cut off, of what the unsmoothed force can be. */
static void joined_to_decimation(const char *rest, double smoothing)
{
    struct arena *a = rig_arena();
    struct scene s = rig_scene(a, arena_format(a, text, rest));
    struct filter f = filter_decimator_bspline(a, OVER);
    struct rig *raw = recorded(rest, 0), *smooth = recorded(rest, smoothing), *both[2];
    double off = 0, most = 0;
    *(double *)rig_edit(&s, &smooth_stage) = smoothing;
    both[0] = rig_record(&s, ITEM_FORCE, FRAMES, 1024);
    both[1] = rig_record(&s, ITEM_FORCE, FRAMES, 77);
    ck_assert(both[0]->run.board.smoothing->taken && !smooth->run.board.smoothing->taken);
    ck_assert(memcmp(both[0]->x, both[1]->x, FRAMES * sizeof *both[0]->x) == 0);
    for (long n = f.reach / OVER + 1; n < FRAMES - f.reach / OVER - 1; n++) {
        double sum = 0;
        for (int j = 0; j < f.taps; j++)
            sum += f.tap[j] * smooth->x[n * OVER + j - f.reach];
        off = fmax(off, fabs(sum - both[0]->x[n]));
    }
    for (long i = 0; i < FRAMES * OVER; i++)
        most = fmax(most, fabs(raw->x[i]));
    printf("joined: off by %.3g of the largest force\n", off / most);
    ck_assert_double_lt(off, 3e-7 * most); /* 1e-7, and as much as the rest is raised by */
    for (int k = 0; k < 2; k++)
        rig_close(both[k]);
    rig_close(raw);
    rig_close(smooth);
}

START_TEST(constant_joined_to_decimation) { joined_to_decimation(SLOW "load: {constant: 1 N}", 50e-6); }
END_TEST

/* At the start what would come before it is reflected at another rate: the approach leaves little there. */
START_TEST(varying_joined_to_decimation)
{
    joined_to_decimation(SLOW "grip: {angle: 20 deg}", 50e-6);
    joined_to_decimation(SLOW "grip: {angle: 20 deg}", 2e-6);
    joined_to_decimation(SLOW "grip: {angle: 20 deg}", 1e-3);
}
END_TEST

UNIT("smooth", width_that_varies_makes_no_tone, constant_width, width_that_follows_alpha,
     smoothing_removes_high_frequencies, constant_joined_to_decimation, varying_joined_to_decimation)
