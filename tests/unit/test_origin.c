/* surface.origin with along: x: the profile's first sample lies at x = origin, so that the contact at x meets its place
   x - origin. Whoever turns the sign, or forgets the origin, meets no bump where there is one, and the wrong roughness.
 */
#include <unistd.h>

#include "rig.h"

enum { SAMPLES = 4001, BUMP = 1500, FRAMES = 6600 };

static char map[] = "/tmp/test_origin_XXXXXX.npy";

/* An NPY of float64: flat but for a bump of 1 um whose standard deviation is 40 um, at 15 mm of 40. */
static void write_map(void)
{
    static const char header[] =
        "{'descr': '<f8', 'fortran_order': False, 'shape': (4001,), }                                       \n";
    static double z[SAMPLES];
    FILE *f = fdopen(mkstemps(map, 4), "wb"); /* each test is a process of its own */
    ck_assert_ptr_nonnull(f);
    for (int i = 0; i < SAMPLES; i++)
        z[i] = 1e-6 * exp(-(i - BUMP) * (i - BUMP) / 32.0);
    fwrite("\x93NUMPY\x01", 1, 7, f);
    fputc(0, f);
    fputc((int)strlen(header) & 255, f);
    fputc((int)strlen(header) >> 8, f);
    fputs(header, f);
    fwrite(z, sizeof *z, SAMPLES, f);
    ck_assert_int_eq(fclose(f), 0);
}

static const char bump[] = "height_map: %s, pitch: 10 um", rough[] = "roughness: {rms: 1 um}%.0s";

/* The force along a slanted stroke at 10 cm/s from (x, 1 cm) to (x + 1 cm, 2 cm), without limiter and smoothing. */
static struct rig *force(const char *surface, double x, double origin)
{
    struct arena *a = rig_arena();
    const char *scene = "rasp: 1\nsurface: {%s, along: x, origin: [%.17g, 0]}\nscraper: {mass: 20 g}\n"
                        "motion: {path: line, from: [%.17g, 1 cm], to: [%.17g, 2 cm], speed: 10 cm/s}\n"
                        "contact: {beta1: 0, smoothing: 0, limiter: {curve: none}}\noutput: {diagnostics: {}}\n";
    struct scene s = rig_scene(a, arena_format(a, scene, arena_format(a, surface, map), origin, x, x + 0.01));
    return rig_record(&s, ITEM_FORCE, FRAMES, 512);
}

/* rms of the difference over rms. */
static double apart(const struct rig *x, const struct rig *y)
{
    double off = 0, all = 0;
    for (long n = 0; n < FRAMES; n++) {
        off += (x->x[n] - y->x[n]) * (x->x[n] - y->x[n]);
        all += x->x[n] * x->x[n];
    }
    return sqrt(off / all);
}

static long loudest(const struct rig *g)
{
    long best = 0;
    for (long n = 1; n < FRAMES; n++)
        best = fabs(g->x[n]) > fabs(g->x[best]) ? n : best;
    return best;
}

/* f_v = m v^2 z'' is largest on top of the bump: at x = origin + 15 mm, which the contact, 1/sqrt(2) of its 10 cm/s
   along x, passes at sqrt(2) (origin + 15 mm - start) / (10 cm/s). Within 3 samples of 1/48000 s: a sample and a half
   of the decimator's, and the leak's lean. */
START_TEST(the_bump_is_met_where_it_lies)
{
    static const double starts[] = {0.02, 0.022, -0.031}, origins[] = {0.01, 0.01, -0.042};
    write_map();
    for (int k = 0; k < 3; k++) {
        struct rig *g = force(bump, starts[k], origins[k]);
        double want = sqrt(2) * (origins[k] + 0.015 - starts[k]) / 0.1 * 48000;
        printf("start %g m, origin %g m: frame %ld, expected %.1f\n", starts[k], origins[k], loudest(g), want);
        ck_assert_double_eq_tol((double)loudest(g), want, 3);
        ck_assert_double_gt(fabs(g->x[loudest(g)]),
                            0.3 * 0.02 * 0.005 * 1e-6 /
                                (40e-6 * 40e-6)); /* m v_x^2 z'', less what is lost to averaging */
        rig_close(g);
    }
    remove(map);
}
END_TEST

/* Surface and motion moved together are the same contact; moved alone they are not. Places are rounded to 1e-17 m, of
   which curvature makes less than 1e-8 of the force. */
START_TEST(only_the_difference_counts)
{
    static const char *const surfaces[] = {bump, rough};
    write_map();
    for (int k = 0; k < 2; k++) {
        struct rig *here = force(surfaces[k], 0.02, 0.01), *there = force(surfaces[k], 0.02 + 0.0625, 0.01 + 0.0625);
        struct rig *alone = force(surfaces[k], 0.02, 0.0105), *against = force(surfaces[k], 0.02, -0.01);
        printf("together %.3g, alone %.3g, other sign %.3g\n", apart(here, there), apart(here, alone),
               apart(here, against));
        ck_assert_double_lt(apart(here, there), 1e-8);
        ck_assert_double_gt(apart(here, alone), 0.5);
        ck_assert_double_gt(apart(here, against), 0.5);
        rig_close(here), rig_close(there), rig_close(alone), rig_close(against);
    }
    remove(map);
}
END_TEST

UNIT("origin", the_bump_is_met_where_it_lies, only_the_difference_counts)
