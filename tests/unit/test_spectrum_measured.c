/* The spectrum of a measured map, roughness like a map, continuation: on fields whose statistics are known. */
#include "surface/spectrum.h"

#include "file/heightfile.h"
#include "num/noise.h"
#include "parts.h"
#include "surface/continuation.h"
#include "surface/heights.h"
#include "surface/roughness.h"
#include "surface/tiles.h"

enum { N = 100000 };

/* n heights of a part along x, `pitch` apart. */
static double *sampled(struct arena *a, struct relief_part *p, size_t n, double pitch)
{
    double *x = ARENA_TAKE(a, double, n), *z = ARENA_TAKE(a, double, n);
    for (size_t i = 0; i < n; i++)
        x[i] = (double)i * pitch;
    p->add(p, &(struct relief_points){n, x, NULL}, &(struct relief_values){.z = z});
    return z;
}

static struct relief_part *line(struct arena *a, const struct spectrum *s, const char *name)
{
    return profile_part(a, roughness_blocks(a, s, noise_make(3, name)), "line", 0);
}

/* Between 4 times the roll-off and the cut-off: a third of an octave of n lines and 15 segments has the relative
 * deviation sqrt(2/(15 n)). */
START_TEST(spectrum_of_a_known_one)
{
    static const double exponents[] = {-2.4, -1, -4};
    for (int e = 0; e < 3; e++) {
        struct arena *a = arena_open();
        struct spectrum s = spectrum_power_law(a, exponents[e], 1e-3, 20e-6, 4e-6);
        struct relief_part *p = line(a, &s, "known");
        double *z = sampled(a, p, N, 5e-6), lines;
        for (int i = 0; i < N; i++)
            z[i] +=
                1e-3 +
                1e-6 * i; /* which levelling takes out; in the lowest nodes it would be seen through the Hann window */
        struct spectrum m = spectrum_measured(a, &(struct spectrum_rows){z, N, 1, 5e-6});
        int looked = 0;
        for (int i = 0; i < m.n && m.k[i] < 500;
             i++) /* flat, from 3 lines and 15 segments each: 4.5 deviations are 0.95 */
            ck_assert_msg(m.p[i] < 1.95 * spectrum_at(&s, 0), "%g cycles/m: %g times the density", m.k[i],
                          m.p[i] / spectrum_at(&s, 0));
        for (int i = 0; i < m.n; i++) {
            if (m.k[i] < 4e3 || m.k[i] > 4e4) continue;
            lines = m.k[i] * 0.23 * 12500 * 5e-6;
            double want = spectrum_power(&s, m.k[i] * 0.891, m.k[i] * 1.122) / (m.k[i] * 0.231);
            ck_assert_double_eq_tol(m.p[i] / want, 1, 4.5 * sqrt(2 / lines / 15) + 0.03);
            looked++;
        }
        ck_assert_int_ge(looked, 9);
        double density, fitted = spectrum_fit(&m, 4.5e4, &density);
        ck_assert_double_eq_tol(fitted, exponents[e], 0.2);
        ck_assert_double_eq_tol(density / spectrum_at(&s, 4.5e4), 1, 0.25);
        ck_assert_double_eq_tol(spectrum_knee(&m) / 5e4, 0.87, 0.13); /* the cut-off, by a third of an octave */
        ck_assert_double_eq_tol(spectrum_limit(&m) / 5e4, 1.1, 0.2);
        p->close(p);
        arena_close(a);
    }
}
END_TEST

START_TEST(moments_of_known_heights)
{
    struct arena *a = arena_open();
    enum { C = 60, R = 40 };
    double z[R * C];
    for (int j = 0; j < R; j++)
        for (int i = 0; i < C; i++) /* -1 or 1 in turn along both: kurtosis 1; with one in four at 3: skewed */
            z[j * C + i] = 2e-6 * ((i + j) % 4 == 0 ? 3 : -1) + 5e-3 + 1e-5 * i - 2e-5 * j;
    struct spectrum_moments m = spectrum_moments(&(struct spectrum_rows){z, C, R, 1e-6});
    ck_assert_double_eq_tol(m.rms / (2e-6 * sqrt(3)), 1, 1e-3);
    ck_assert_double_eq_tol(m.skewness, 2 / sqrt(3), 1e-2);
    ck_assert_double_eq_tol(m.kurtosis, 7.0 / 3, 1e-2);
    arena_close(a);
}
END_TEST

/* A field with known statistics written to a file, `like` it, and measured again: its rms within 1 %, thirds of an
   octave within 25 % (each has been estimated twice from half a metre), skewness and kurtosis as those of the file,
   within chance. */
START_TEST(like_a_file)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct spectrum s = spectrum_power_law(a, -2.4, 1e-3, 20e-6, 1);
    struct heights h;
    ck_assert(heights_make(-0.8, 4.2, &h, &e));
    struct relief_part *p = heights_part(a, line(a, &s, "file"), &h, 4e-6);
    struct heightfile f = {.columns = N, .rows = 1, .pitch_x = 5e-6, .pitch_y = 5e-6};
    struct heightfile_written written;
    f.z = sampled(a, p, N, 5e-6);
    ck_assert_msg(heightfile_write("like.gsf", &f, HEIGHTFILE_GSF, &written, &e), "%s", e.text);
    struct spectrum_rows g = {f.z, N, 1, 5e-6};
    struct spectrum_moments want = spectrum_moments(&g);
    struct spectrum before = spectrum_measured(a, &g);
    for (int along = ALONG_PATH; along <= ALONG_PLANE; along += ALONG_PLANE - ALONG_PATH) {
        struct roughness r = {.given = true, .like = "like.gsf", .like_pitch = NAN, .grain = 1};
        struct roughness_plan plan;
        ck_assert_msg(roughness_plan(a, NULL, &r, &plan, &e), "%s", e.text);
        ck_assert_double_eq_tol(spectrum_rms(&plan.spectrum) / want.rms, 1, 1e-6);
        struct relief_part *made = roughness_part(a, &plan, &r, along, noise_make(5, "like"), &e);
        ck_assert_msg(made != NULL, "%s", e.text);
        g.z = sampled(a, made, N, 5e-6);
        struct spectrum_moments got = spectrum_moments(&g);
        struct spectrum after = spectrum_measured(a, &g);
        ck_assert_double_eq_tol(got.rms / want.rms, 1, 0.06);
        ck_assert_double_eq_tol(got.skewness, want.skewness, 0.25);
        ck_assert_double_eq_tol(got.kurtosis, want.kurtosis, 0.6);
        for (int i = 0; i < before.n; i++)
            if (before.k[i] > 2e3 && before.k[i] < 4.2e4)
                ck_assert_msg(fabs(log2(after.p[i] / before.p[i])) < 0.5, "along %d, %g cycles/m: %g times", along,
                              before.k[i], after.p[i] / before.p[i]);
        if (made->close) made->close(made);
    }
    p->close(p);
    remove("like.gsf");
    arena_close(a);
}
END_TEST

/* A map that is oversampled eight times, as the measured ones are, continued: the sum of both has the power law through
   the map's band limit up to the new cut-off, 2 dB off at most about the takeover, 1 dB elsewhere (a fit through two
   octaves, carried on over two more). */
START_TEST(continuation_carries_on)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct spectrum s = spectrum_power_law(a, -2.4, 1e-3, 40e-6, 4e-6), c;
    struct relief_part *coarse = line(a, &s, "map");
    double *z = sampled(a, coarse, N, 2.5e-6), limit = 25e3;
    struct height_map map = {z, N, 1, {2.5e-6, 2.5e-6}};
    struct continuation want = {.given = true, .exponent = NAN, .from = NAN, .shortest = 5e-6};
    ck_assert_msg(continuation_spectrum(a, &want, &map, &c, &e), "%s", e.text);
    ck_assert_double_eq_tol(c.takeover / limit, 1, 0.15);
    ck_assert_double_eq_tol(log(c.p[1] / c.p[0]) / log(c.k[1] / c.k[0]), -2.4, 0.2);
    ck_assert_double_eq_tol(c.k[1], 2e5, 1e-6);
    struct relief_part *fine = line(a, &c, "finer");
    double *x = ARENA_TAKE(a, double, 4 * N), *sum = ARENA_TAKE(a, double, 4 * N);
    for (int i = 0; i < 4 * N; i++)
        x[i] = i * 0.625e-6;
    struct relief_points at = {4 * N, x, NULL};
    coarse->add(coarse, &at, &(struct relief_values){.z = sum});
    fine->add(fine, &at, &(struct relief_values){.z = sum});
    struct spectrum both = spectrum_measured(a, &(struct spectrum_rows){sum, 4 * N, 1, 0.625e-6}),
                    whole = spectrum_power_law(a, -2.4, 1e-3, 5e-6, 4e-6);
    double level = spectrum_at(&s, 5e3) / spectrum_at(&whole, 5e3);
    for (int i = 0; i < both.n; i++)
        if (both.k[i] > 3e3 && both.k[i] < 1.7e5) {
            double off = 10 * log10(both.p[i] / spectrum_at(&whole, both.k[i]) / level);
            ck_assert_msg(fabs(off) < (both.k[i] > 1.7e4 && both.k[i] < 4e4 ? 2.5 : 1.5), "%g cycles/m: %g dB",
                          both.k[i], off);
        }
    /* given figures are kept to */
    want.exponent = -3, want.from = 50e-6;
    ck_assert(continuation_spectrum(a, &want, &map, &c, &e));
    ck_assert_double_eq_tol(c.takeover, 20e3, 1e-6);
    ck_assert_double_eq_tol(log(c.p[1] / c.p[0]) / log(c.k[1] / c.k[0]), -3, 1e-12);
    /* and the level with them: just below k_c/sqrt 2 it is that of the law through the map there, half an octave being
     * left for X to rise in */
    want.exponent = NAN;
    ck_assert(continuation_spectrum(a, &want, &map, &c, &e));
    struct spectrum measured = spectrum_measured(a, &(struct spectrum_rows){z, N, 1, 2.5e-6});
    double density, fitted = spectrum_fit(&measured, 20e3 * sqrt(0.5), &density);
    ck_assert_double_eq_tol(c.p[0] / density, 1, 1e-9);
    ck_assert_double_eq_tol(log(c.p[1] / c.p[0]) / log(c.k[1] / c.k[0]), fitted, 1e-9);
    coarse->close(coarse);
    fine->close(fine);
    arena_close(a);
}
END_TEST

START_TEST(what_cannot_be_continued)
{
    struct arena *a = arena_open();
    struct spectrum s = spectrum_power_law(a, -2.4, 1e-3, 40e-6, 4e-6), c;
    struct relief_part *p = line(a, &s, "map");
    struct height_map map = {sampled(a, p, N, 2.5e-6), N, 1, {2.5e-6, 2.5e-6}};
    struct continuation asked[] = {
        {true, NAN, NAN, 60e-6}, {true, NAN, 1e-2, 5e-6}, {true, NAN, NAN, 5e-6}, {true, NAN, NAN, 5e-6}};
    static const char *const says[] = {"shortest", "two octaves", "flat", "too few"};
    for (int i = 0; i < 4; i++) {
        struct err e = {0};
        double flat[100] = {0};
        struct height_map other = i < 2 ? map : (struct height_map){flat, i == 2 ? 100 : 20, 1, {1e-6, 1e-6}};
        ck_assert(!continuation_spectrum(a, &asked[i], &other, &c, &e));
        ck_assert_int_eq(e.kind, ERR_SCENE);
        ck_assert_msg(strstr(e.text, says[i]) != NULL, "%s", e.text);
    }
    p->close(p);
    arena_close(a);
}
END_TEST

UNIT("spectrum_measured", spectrum_of_a_known_one, moments_of_known_heights, like_a_file, continuation_carries_on,
     what_cannot_be_continued)
