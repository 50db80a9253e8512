/* heightfile_level: planes are found and taken away; what is left is at right angles to every plane. */
#include "file/heightfile.h"

#include "heights.h"

enum { W = 37, H = 23 };

static double z[W * H];

static double wave(int k) { return 1e-6 * (double)((k * 7919 + k * k) % 997) / 997; }

/* mean, slope_x, slope_y of a plane that is nothing else: rounding only. */
START_TEST(plane)
{
    struct heightfile m = {.columns = W, .rows = H, .pitch_x = 2e-6, .pitch_y = 5e-6, .z = z};
    for (int k = 0; k < W * H; k++)
        z[k] = k % 5 == 2 || k < 60 ? NAN : 3e-6 + 0.02 * 2e-6 * (k % W - 18) - 0.007 * 5e-6 * (k / W - 11);
    struct heightfile_plane p = heightfile_level(&m, HEIGHTFILE_LEVEL_PLANE);
    ck_assert_double_eq_tol(p.mean, 3e-6, 1e-19);
    ck_assert_double_eq_tol(p.slope_x, 0.02, 1e-14);
    ck_assert_double_eq_tol(p.slope_y, -0.007, 1e-14);
    for (int k = 0; k < W * H; k++)
        ck_assert(isnan(z[k]) == (k % 5 == 2 || k < 60) && !(fabs(z[k]) > 1e-19));
}
END_TEST

/* Rough heights with holes: the rest sums to nothing against 1, x and y (the normal equations, written out). */
START_TEST(residue)
{
    struct heightfile m = {.columns = W, .rows = H, .pitch_x = 2e-6, .pitch_y = 5e-6, .z = z};
    double sum = 0, sum_x = 0, sum_y = 0;
    for (int k = 0; k < W * H; k++)
        z[k] = k % 7 == 3 ? NAN : wave(k) + 1e-7 * (k / W);
    heightfile_level(&m, HEIGHTFILE_LEVEL_PLANE);
    for (int k = 0; k < W * H; k++)
        if (!isnan(z[k])) {
            sum += z[k];
            sum_x += z[k] * (k % W);
            sum_y += z[k] * (k / W);
        }
    ck_assert(fabs(sum) < 1e-17 && fabs(sum_x) < 1e-16 && fabs(sum_y) < 1e-16);
}
END_TEST

START_TEST(profile_and_mean)
{
    struct heightfile m = {.columns = 5, .rows = 1, .pitch_x = 1e-6, .pitch_y = NAN, .z = z};
    const double heights[] = {1, 2, 4, 5, 8};
    memcpy(z, heights, sizeof heights);
    struct heightfile_plane p = heightfile_level(&m, HEIGHTFILE_LEVEL_NONE);
    ck_assert(p.mean == 0 && p.slope_x == 0 && z[4] == 8);
    p = heightfile_level(&m, HEIGHTFILE_LEVEL_MEAN);
    ck_assert(p.mean == 4 && p.slope_x == 0 && z[0] == -3 && z[4] == 4);
    p = heightfile_level(&m, HEIGHTFILE_LEVEL_PLANE); /* sum x z / sum x^2 = (6 + 2 + 1 + 8)/10 */
    ck_assert_double_eq_tol(p.slope_x, 1.7e6, 1e-9);
    ck_assert(p.slope_y == 0);
    ck_assert_double_eq_tol(z[0], 0.4, 1e-15);
}
END_TEST

/* All heights in one column: no slope across can be known, and none is taken. */
START_TEST(one_column_left)
{
    struct heightfile m = {.columns = W, .rows = H, .pitch_x = 1e-6, .pitch_y = 1e-6, .z = z};
    for (int k = 0; k < W * H; k++)
        z[k] = k % W == 30 ? 0.01 * 1e-6 * (k / W) : NAN;
    struct heightfile_plane p = heightfile_level_fit(&m);
    ck_assert(p.slope_x == 0);
    ck_assert_double_eq_tol(p.slope_y, 0.01, 1e-14);
}
END_TEST

UNIT("heightfile_level", plane, residue, profile_and_mean, one_column_left)
