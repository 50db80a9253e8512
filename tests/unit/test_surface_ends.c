/* surface_heights_ends: seams, ends that fall away, rows laid end to end. */
#include "analysis/surface_heights.h"

#include <stdint.h>

#include "unit.h"

static const double pi = 3.14159265358979323846;

enum { N = 40000 };

static double z[N];
static uint64_t state;

static double chance(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) * 0x1p-53 - 0.5;
}

#define PROFILE(n) ((struct heightfile){.columns = (n), .rows = 1, .pitch_x = 2e-6, .pitch_y = NAN, .z = z})

/* A parabola: steps, seam and end slopes in closed form. */
START_TEST(seams)
{
    struct heightfile h = PROFILE(101);
    struct surface_heights_ends s;
    for (int i = 0; i <= 100; i++)
        z[i] = 1e-9 * i * i;
    surface_heights_ends(&h, false, &s);
    double sum = 0;
    for (int i = 0; i < 100; i++)
        sum += (2.0 * i + 1) * (2 * i + 1);
    ck_assert_double_eq_tol(s.jump, 1e-5, 1e-19);
    ck_assert_double_eq_tol(s.step, 1e-9 * sqrt(sum / 100), 1e-20);
    ck_assert_double_eq_tol(s.kink, 2 * sqrt((1.0 + 199 * 199) / 2) * 1e-9 / 2e-6, 1e-14);
}
END_TEST

static void waves(int n)
{
    for (int i = 0; i < n; i++)
        z[i] = 20e-6 + 1e-6 * sin(i * 0.1) + 0.5e-6 * sin(i * 0.0321);
}

START_TEST(falling_ends)
{
    struct heightfile h = PROFILE(5000);
    struct surface_heights_ends s;
    waves(5000);
    surface_heights_ends(&h, false, &s);
    ck_assert(s.fall[0] == 0 && s.fall[1] == 0 && s.drop[0] == 0 && s.drop[1] == 0);
    for (int i = 4993; i < 5000; i++) /* the last seven fall to 1 um */
        z[i] += (1e-6 - z[4992]) * (i - 4992) / 7;
    surface_heights_ends(&h, false, &s);
    ck_assert(s.fall[0] == 0 && s.fall[1] == 7);
    ck_assert_double_eq_tol(s.drop[1], fabs(z[4999] - z[4992]), 1e-18);
    waves(5000);
    z[0] = z[1] = 0;
    surface_heights_ends(&h, false, &s);
    ck_assert(s.fall[0] == 2 && s.fall[1] == 0);
    ck_assert_double_eq_tol(s.drop[0], z[2], 1e-18);
}
END_TEST

/* Down the columns of a map it is the same as along the rows of its transpose. */
START_TEST(down_is_along_the_transpose)
{
    enum { W = 50, H = 80 };
    static double t[W * H];
    struct heightfile h = {.columns = W, .rows = H, .pitch_x = 1e-6, .pitch_y = 3e-6, .z = z},
                      turned = {.columns = H, .rows = W, .pitch_x = 3e-6, .pitch_y = 1e-6, .z = t};
    struct surface_heights_ends a, b;
    state = 5;
    for (int k = 0; k < W * H; k++)
        t[k % W * H + k / W] = z[k] = 1e-6 * chance() + (k / W > 77 ? 5e-6 : 0);
    surface_heights_ends(&h, true, &a);
    surface_heights_ends(&turned, false, &b);
    ck_assert_mem_eq(&a, &b, sizeof a);
    ck_assert(a.fall[1] == 2);
    surface_heights_ends(&h, false, &b);
    ck_assert(b.fall[0] == 0 && b.fall[1] == 0);
}
END_TEST

/* Rows of 500 smooth samples, each 0.8 of the one before and 0.6 of a new one: correlation 0.8 at lag 500. */
static void rows_end_to_end(void)
{
    double row[500] = {0};
    state = 9;
    for (int j = 0; j < N / 500; j++) {
        double fresh[500] = {0};
        for (int m = 1; m < 40; m++) {
            double a = chance(), b = chance();
            for (int i = 0; i < 500; i++)
                fresh[i] += a * cos(2 * pi * m * i / 500) + b * sin(2 * pi * m * i / 500);
        }
        for (int i = 0; i < 500; i++)
            z[500 * j + i] = row[i] = 0.8 * row[i] + 0.6 * fresh[i];
    }
}

START_TEST(flattened_rows)
{
    struct heightfile h = PROFILE(N);
    struct surface_heights_period p;
    rows_end_to_end();
    surface_heights_period(&h, &p);
    ck_assert(p.stands_out && p.lag == 500);
    ck_assert_double_eq_tol(p.peak, 0.8, 0.05);
    h.rows = 2, h.columns = N / 2;
    surface_heights_period(&h, &p);
    ck_assert(!p.stands_out && p.lag == 0 && isnan(p.peak));
}
END_TEST

/* Smooth noise does not; neither do a sine and regular ridges: their period is a few correlation lengths. */
START_TEST(what_does_not_stand_out)
{
    struct heightfile h = PROFILE(N);
    struct surface_heights_period p;
    double s = 0;
    state = 11;
    for (int i = 0; i < N; i++)
        z[i] = s += chance() - 0.1 * s;
    surface_heights_period(&h, &p);
    ck_assert(!p.stands_out && p.peak < 0.2 && p.peak > 0);
    for (int i = 0; i < N; i++)
        z[i] = sin(i * 0.01);
    surface_heights_period(&h, &p);
    ck_assert(!p.stands_out && p.peak <= 1);
    for (int i = 0; i < N; i++)
        z[i] = i % 100 < 30;
    surface_heights_period(&h, &p);
    ck_assert(!p.stands_out && p.peak <= 1.000000001);
    memset(z, 0, sizeof z);
    surface_heights_period(&h, &p);
    ck_assert(!p.stands_out);
}
END_TEST

UNIT("surface_heights_ends", seams, falling_ends, down_is_along_the_transpose, flattened_rows, what_does_not_stand_out)
