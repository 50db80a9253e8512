/* Motions that stop and turn back exactly: pauses and reversals of recordings and polylines in the plane, many of them,
   drawn from seeds. At the turns the contact's steps are of the size of the coordinates' last places, so that chords
   point anywhere. The force must be finite (the runner refuses what is not), and from rest to rest its sum is the
   momentum's change: none. */
#include <unistd.h>

#include "rig.h"

static char *drawn_polyline(struct arena *a, int seed)
{
    char *points = arena_format(a, "[[0, 20 mm]");
    int x = 0;
    srand48(seed);
    for (int i = 0; i < 6; i++) {
        x += (i % 2 ? -1 : 1) * (10 + (int)(60 * drand48()));
        points = arena_format(a, "%s, [%d mm, %d mm]", points, x, seed % 3 ? 20 : 20 + i);
    }
    return arena_format(a, "motion: {path: polyline, points: %s], duration: %.17g s}\n", points,
                        0.06 + 0.01 * (seed % 13));
}

static double jerk(double p) { return p < 0 ? 0 : p > 1 ? 1 : p * p * p * (10 + p * (-15 + p * 6)); }

/* There, a pause, half way back, a pause, there again; positions held to `grain` m. */
static void recording(const char *file, int seed, double grain)
{
    FILE *f = fopen(file, "w");
    ck_assert_ptr_nonnull(f);
    fprintf(f, "time_s,x_m,y_m\n");
    srand48(seed);
    double way = 0.01 + 0.04 * drand48(), pause = 0.05 * drand48(), up = seed % 2 ? 0 : 0.02 * drand48();
    for (int i = 0; i <= 48; i++) {
        double t = i / 120.0, s = jerk(t / 0.1) - 0.5 * jerk((t - 0.1 - pause) / 0.08) + 0.5 * jerk((t - 0.25) / 0.1),
               x = 0.1 + way * s, y = 0.03 + up * s;
        if (grain > 0) x = grain * rint(x / grain), y = grain * rint(y / grain);
        fprintf(f, "%.6f,%.9f,%.9f\n", t, x, y);
    }
    fclose(f);
}

/* The sum of the force over the motion, over the sum of its magnitudes. */
static double left_over(struct scene *s, long frames)
{
    struct rig *g = rig_record(s, ITEM_SUBFORCE, frames, 1024);
    double sum = 0, all = 0;
    for (long i = 0; i < frames * g->per_frame; i++) {
        sum += g->x[i];
        all += fabs(g->x[i]);
    }
    ck_assert_double_gt(all, 0);
    rig_close(g);
    return fabs(sum) / all;
}

static const char *const head = "rasp: 1\nsurface: {along: plane, roughness: {rms: 4 um}}\nscraper: {mass: 20 "
                                "g}\naccuracy: draft\noutput: {diagnostics: {}}\n"
                                "load: {approach: 0 s, release: 0 s}\n";
static const char *const forces[] = {"contact: {beta1: 0, smoothing: 0}\n", "contact: {force: paper, smoothing: 0}\n"};

/* Corners of 180 degrees and others; the sum is below the roundings of 10 000 terms. */
START_TEST(polylines_that_go_back)
{
    for (int seed = 0; seed < 6; seed++)
        for (int k = 0; k < 2; k++) {
            struct arena *a = arena_open();
            struct scene s = rig_scene(a, arena_format(a, "%s%s%s", head, forces[k], drawn_polyline(a, seed)));
            double left = left_over(&s, (long)(s.contacts[0].motion.duration * 48000) + 2);
            ck_assert_msg(k == 1 || left < 1e-11, "seed %d: %g is left", seed, left);
            arena_close(a);
        }
}
END_TEST

START_TEST(recordings_with_pauses)
{
    static const double grains[] = {0, 1e-5, 1e-4}, cutoffs[] = {0, 12, 25};
    char file[] = "/tmp/test_turns.XXXXXX.csv";
    int handle = mkstemps(file, 4);
    ck_assert_int_ge(handle, 0);
    close(handle);
    for (int seed = 0; seed < 27; seed += 5) { /* each grain, cutoff and force */
        struct arena *a = arena_open();
        recording(file, seed, grains[seed % 3]);
        struct scene s = rig_scene(a, arena_format(a, "%s%smotion: {path: recorded, file: %s, cutoff: %g}\n", head,
                                                   forces[seed % 4 == 3], file, cutoffs[seed / 3 % 3]));
        left_over(&s, 19203);
        arena_close(a);
    }
    remove(file);
}
END_TEST

UNIT("turns", polylines_that_go_back, recordings_with_pauses)
