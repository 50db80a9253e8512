/* surface_heights: sines have known figures, rounding a known noise. */
#include "analysis/surface_heights.h"

#include "base/arena.h"
#include "unit.h"

static const double pi = 3.14159265358979323846;

enum { N = 4000, W = 200, H = 160 };

static double z[N > W *H ? N : W *H];

/* A whole number of waves of 40 samples: all sums over them are those of the closed forms. */
START_TEST(sine_profile)
{
    const double a = 3e-6, pitch = 2e-6, wave = 40;
    struct heightfile h = {.columns = N, .rows = 1, .pitch_x = pitch, .pitch_y = NAN, .z = z};
    struct surface_heights s;
    for (int i = 0; i < N; i++)
        z[i] = 7e-6 + a * sin(2 * pi * (i + 0.5) / wave);
    surface_heights(&h, &s);
    double d = 2 * sin(pi / wave) / pitch; /* what the first difference makes of the wave */
    ck_assert_double_eq_tol(s.mean, 7e-6, 1e-17);
    ck_assert_double_eq_tol(s.sq, a / sqrt(2), 1e-16);
    ck_assert_double_eq_tol(s.sa / (a * 2 / wave / sin(pi / wave)), 1,
                            1e-12); /* the midpoint sum of |sin| over 40 samples */
    ck_assert(fabs(s.ssk) < 1e-9);
    ck_assert_double_eq_tol(s.sku, 1.5, 1e-9);
    ck_assert_double_eq_tol(s.sz, 2 * a * cos(pi / wave), 1e-16);
    ck_assert_double_eq_tol(s.slope / (a * d / sqrt(2)), 1, 1e-3); /* N - 1 differences, not whole waves */
    ck_assert_double_eq_tol(s.curvature / (a * d * d / sqrt(2)), 1, 1e-3);
    ck_assert(isnan(s.slope_y) && isnan(s.curvature_y));
}
END_TEST

/* Waves along x only, 5 times longer ones along y; a hole changes nothing but what it touches. */
START_TEST(map_with_a_hole)
{
    struct heightfile h = {.columns = W, .rows = H, .pitch_x = 1e-6, .pitch_y = 3e-6, .z = z};
    struct surface_heights s;
    for (int k = 0; k < W * H; k++)
        z[k] = 1e-6 * sin(2 * pi * (k % W) / 20.0) + 0.5e-6 * cos(2 * pi * (k / W) / 80.0);
    z[77 * W + 31] = NAN;
    surface_heights(&h, &s);
    double dx = 2 * sin(pi / 20) / 1e-6, dy = 2 * sin(pi / 80) / 3e-6;
    ck_assert_double_eq_tol(s.sq / (1e-6 * sqrt(0.5 + 0.125)), 1, 1e-3);
    ck_assert_double_eq_tol(s.slope / (1e-6 * dx / sqrt(2)), 1, 5e-3);
    ck_assert_double_eq_tol(s.slope_y / (0.5e-6 * dy / sqrt(2)), 1, 5e-3);
    ck_assert_double_eq_tol(s.curvature_y / (0.5e-6 * dy * dy / sqrt(2)), 1, 1e-2); /* 158 differences of 160 heights */
}
END_TEST

/* One tall spike in a thousand: skewness and kurtosis of a two-valued distribution, (1 - 2p)/sqrt(p q) and 1/(p q) - 3.
 */
START_TEST(skewness_and_kurtosis)
{
    struct heightfile h = {.columns = 1000, .rows = 1, .pitch_x = 1e-6, .pitch_y = NAN, .z = z};
    struct surface_heights s;
    for (int i = 0; i < 1000; i++)
        z[i] = i == 500 ? 1e-6 : 0;
    surface_heights(&h, &s);
    double p = 1e-3, q = 1 - p;
    ck_assert_double_eq_tol(s.ssk, (1 - 2 * p) / sqrt(p * q), 1e-9);
    ck_assert_double_eq_tol(s.sku, 1 / (p * q) - 3, 1e-6);
    z[500] = 0;
    surface_heights(&h, &s);
    ck_assert(s.sq == 0 && s.sz == 0 && isnan(s.ssk) && isnan(s.sku));
}
END_TEST

/* Rounded to steps of 5 nm: the step is found, and the noise it says is that of rounded minus exact heights. */
START_TEST(steps)
{
    static double exact[N];
    struct heightfile h = {.columns = N, .rows = 1, .pitch_x = 2e-6, .pitch_y = NAN, .z = z};
    struct surface_heights_steps s;
    double sum = 0, q = 5e-9;
    for (int i = 0; i < N; i++) {
        exact[i] = 0.4e-6 * sin(i * 0.7) + 0.3e-6 * sin(i * 0.321) + 0.2e-6 * sin(i * 1.9);
        z[i] = q * rint(exact[i] / q);
    }
    surface_heights_steps(&h, &s);
    ck_assert_double_eq_tol(s.step / q, 1, 1e-6);
    ck_assert(s.levels > 200 && s.levels < 400 && s.looked_at == N);
    for (int i = 1; i + 1 < N; i++) {
        double d = (z[i - 1] - exact[i - 1]) - 2 * (z[i] - exact[i]) + (z[i + 1] - exact[i + 1]);
        sum += d * d;
    }
    ck_assert_double_eq_tol(s.noise / (sqrt(sum / (N - 2)) / (2e-6 * 2e-6)), 1, 0.04); /* 4000 draws: 2 % rms */
    memcpy(z, exact, sizeof exact);
    h.quantum = 1e-15;
    surface_heights_steps(&h, &s); /* all different: what the file says */
    ck_assert(s.levels == N && s.step == 1e-15);
}
END_TEST

/* Closed forms at that pitch, and the 2.45 at a spline's knots: over all wavelengths t the spline's second derivative
   is 6 (2 - 2 cos t)/(4 + 2 cos t), the plain second difference 2 - 2 cos t. */
START_TEST(noise_figures)
{
    struct heightfile h = {.columns = 4, .rows = 1, .pitch_x = 5.6e-6, .pitch_y = NAN, .z = z, .quantum = 0.1e-9};
    struct surface_heights_steps s;
    double spline = 0, plain = 0;
    for (int i = 0; i < 4; i++)
        z[i] = i * i;
    surface_heights_steps(&h, &s);
    ck_assert_double_eq_tol(s.noise, 2.25, 0.01);
    for (int i = 0; i < 1000; i++) {
        double c = cos(pi * (i + 0.5) / 1000), d = 2 - 2 * c;
        plain += d * d;
        spline += 36 * d * d / ((4 + 2 * c) * (4 + 2 * c));
    }
    ck_assert_double_eq_tol(sqrt(plain / 1000), sqrt(6), 1e-9);
    ck_assert_double_eq_tol(sqrt(spline / plain), 2.45, 0.005);
}
END_TEST

UNIT("surface_heights", sine_profile, map_with_a_hole, skewness_and_kurtosis, steps, noise_figures)
