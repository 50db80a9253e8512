/* fractal: its periodogram, its largest height, what lies between heights, and what the stage tells. */
#include "surface/fractal.h"

#include "num/fft.h"
#include "parts.h"
#include "rig.h"

#define MAXIMUM 0.1e-6

static struct fractal recipe(int interpolation)
{
    return (struct fractal){.given = true,
                            .exponent = -1,
                            .spectrum = SPECTRUM_POWER,
                            .maximum = MAXIMUM,
                            .pitch = 1e-4,
                            .length = 0.2,
                            .interpolation = interpolation};
}

/* Least-squares slope of the logarithm of the periodogram's power over that of the line, and the largest departure from
 * that line, dB. */
static double slope_of(const double *z, long n, double *off)
{
    double re[1001], im[1001], power[1001], x = 0, y = 0, xx = 0, xy = 0, m = (double)n / 2 - 1;
    struct fft *f = fft_open((size_t)n);
    fft_forward(f, z, re, im);
    fft_close(f);
    for (long j = 1; j < n / 2; j++) {
        double u = log((double)j), v = power[j] = log(re[j] * re[j] + im[j] * im[j]);
        x += u / m, y += v / m, xx += u * u / m, xy += u * v / m;
    }
    double slope = (xy - x * y) / (xx - x * x);
    *off = 0;
    for (long j = 1; j < n / 2; j++)
        *off = fmax(*off, fabs(power[j] - y - slope * (log((double)j) - x)) * 10 / log(10));
    return slope;
}

/* Every line is where the power law has it: the phases alone are drawn. Of a steep one the last lines are lost in
 * rounding, 1e-16 of the first. */
START_TEST(the_periodogram_is_the_power_law)
{
    static const double exponents[] = {0, -0.5, -1, -1.2, -2, 1};
    for (int spectrum = SPECTRUM_POWER; spectrum <= SPECTRUM_AMPLITUDE; spectrum++)
        for (int k = 0; k < 6; k++) {
            struct fractal f = recipe(INTERPOLATION_SPLINE);
            f.exponent = exponents[k];
            f.spectrum = spectrum;
            double z[2000], off, want = (spectrum == SPECTRUM_POWER ? 1 : 2) * exponents[k], slope;
            ck_assert_double_eq(fractal_size(&f), 2000);
            fractal_heights(&f, noise_make(1, "fractal"), z);
            slope = slope_of(z, 2000, &off);
            ck_assert_msg(fabs(slope - want) < 1e-6 && off < 1e-5, "%g: %.9g, off by %g dB", want, slope, off);
        }
}
END_TEST

/* The largest is the maximum to the last bit, there is no mean, and seeds differ. */
START_TEST(the_largest_is_the_maximum)
{
    for (uint64_t seed = 1; seed < 20; seed++) {
        struct fractal f = recipe(INTERPOLATION_SPLINE);
        double z[2000], other[2000], most = 0, mean = 0;
        int same = 0;
        fractal_heights(&f, noise_make(seed, "fractal"), z);
        fractal_heights(&f, noise_make(seed + 1, "fractal"), other);
        for (int i = 0; i < 2000; i++) {
            most = fmax(most, fabs(z[i]));
            mean += z[i] / 2000;
            same += z[i] == other[i];
        }
        ck_assert(most == MAXIMUM && fabs(mean) < 1e-15 * MAXIMUM * 100 && same < 10);
    }
}
END_TEST

static struct relief_part *part_of(struct arena *a, const struct fractal *f)
{
    return fractal_part(a, f, noise_make(1, "fractal"));
}

/* At the knots the heights, whatever lies between; periodic; and the definition of each between. */
START_TEST(between_the_heights)
{
    double z[2000], pitch = 1e-4;
    for (int kind = INTERPOLATION_NEAREST; kind <= INTERPOLATION_SPLINE; kind++) {
        struct arena *a = arena_open();
        struct fractal f = recipe(kind);
        struct relief_part *p = part_of(a, &f);
        fractal_heights(&f, noise_make(1, "fractal"), z);
        ck_assert_double_eq(p->kinks, kind == INTERPOLATION_NEAREST  ? pitch / 2
                                      : kind == INTERPOLATION_LINEAR ? pitch
                                                                     : 0);
        for (int i = -4500; i < 4500; i += 7) {
            int k = ((i % 2000) + 2000) % 2000, next = (k + 1) % 2000;
            double share = 0.01 + 0.97 * drand48(), rise = z[next] - z[k];
            struct parts_point at = parts_at(p, i * pitch, 0, false), in = parts_at(p, (i + share) * pitch, 0, false);
            ck_assert_double_eq_tol(at.v[0], z[k], 1e-12 * MAXIMUM);
            if (kind == INTERPOLATION_NEAREST && fabs(share - 0.5) > 1e-6)
                ck_assert(in.v[0] == z[share < 0.5 ? k : next] && in.v[1] == 0 && in.v[3] == 0);
            if (kind == INTERPOLATION_LINEAR) {
                ck_assert_double_eq_tol(in.v[0], z[k] + share * rise, 1e-9 * MAXIMUM);
                ck_assert_double_eq_tol(in.v[1], rise / pitch, 1e-12 * MAXIMUM / pitch);
                ck_assert_double_eq(in.v[3], 0);
            }
            if (kind == INTERPOLATION_NEAREST) {
                struct parts_point edge = parts_at(p, (i + 0.5) * pitch, 0, false);
                ck_assert_double_eq(edge.v[0], fmax(z[k], z[next]));
            }
        }
        if (kind == INTERPOLATION_SPLINE) parts_derivatives(p, 0.5, false);
        arena_close(a);
    }
}
END_TEST

/* The spline is C2, its second derivative straight between knots: of five even places within a cell the third
 * differences are alike. */
START_TEST(the_spline_is_cubic)
{
    struct arena *a = arena_open();
    struct fractal f = recipe(INTERPOLATION_SPLINE);
    struct relief_part *p = part_of(a, &f);
    for (int i = 0; i < 4000; i += 3) {
        double c[5], knot = i * 1e-4, tiny = 1e-12;
        for (int k = 0; k < 5; k++)
            c[k] = parts_at(p, knot + (0.1 + 0.2 * k) * 1e-4, 0, false).v[3];
        ck_assert_double_eq_tol(c[0] - 2 * c[2] + c[4], 0, 1e-9 * MAXIMUM / 1e-8);
        ck_assert_double_eq_tol(parts_at(p, knot - tiny, 0, false).v[3], parts_at(p, knot + tiny, 0, false).v[3],
                                1e-6 * MAXIMUM / 1e-8);
    }
    arena_close(a);
}
END_TEST

/* The phases are those of the lines, whatever the length: the same draw at twice the pitch and length is the same
 * heights. */
START_TEST(the_draw_is_the_seeds)
{
    struct fractal f = recipe(INTERPOLATION_SPLINE), wide = f;
    double z[2000], again[2000];
    wide.pitch *= 2;
    wide.length *= 2;
    fractal_heights(&f, noise_make(7, "fractal/contact"), z);
    fractal_heights(&wide, noise_make(7, "fractal/contact"), again);
    ck_assert_mem_eq(z, again, sizeof z);
}
END_TEST

/* ------------------------------------------------------------------ the stage */

#define HEAD "rasp: 1\noutput: {diagnostics: {}}\nscraper: {mass: 1 g, radius: 1 cm}\n"
#define WAY "motion: {path: line, to: [%d cm, 0], speed: 20 cm/s}\n"

static void fails(struct scene *s, const char *says)
{
    struct arena *a = arena_open();
    struct plan p;
    struct run run;
    struct err e = {0};
    ck_assert(plan_make(stages_table, &s->contacts[0], s, a, &p, &e));
    ck_assert(!run_open(&run, &p, s, NULL, &e));
    ck_assert_msg(e.kind == ERR_SCENE && strstr(e.text, says) && strstr(e.text, "contact 'contact'"), "%s", e.text);
    run_close(&run);
    arena_close(a);
}

/* What a scene's reader tells with its place the stage keeps to as well. */
START_TEST(refused_once_more)
{
    struct scene s =
        rig_scene(rig_arena(), HEAD
                  "surface: {fractal: {interpolation: linear}}\nmotion: {path: line, to: [1 cm, 0], speed: 20 cm/s}\n");
    struct contact *c = (struct contact *)&s.contacts[0];
    c->surface.along = ALONG_PLANE;
    fails(&s, "set surface.along to path or x");
    c->surface.along = ALONG_PATH;
    struct fractal *f = params_edit(c, fractal_stage.params, rig_arena());
    *f = recipe(INTERPOLATION_LINEAR);
    c->scraper.radius = NAN;
    fails(&s, "give scraper.radius");
}
END_TEST

/* A motion of more than a period is told that the profile repeats itself; one of a period is not. */
START_TEST(repeating_is_told)
{
    for (int cm = 20; cm <= 21; cm++) {
        struct scene s =
            rig_scene(rig_arena(), arena_format(rig_arena(), HEAD "surface: {fractal: {length: 20 cm}}\n" WAY, cm));
        struct rig *g = rig_record(&s, ITEM_FORCE, 100, 100);
        ck_assert_int_eq(g->run.board.n_warnings, cm - 20);
        ck_assert(cm == 20 || strstr(g->run.board.warnings[0], "repeats itself every 0.2 m"));
        rig_close(g);
    }
}
END_TEST

UNIT("fractal", the_periodogram_is_the_power_law, the_largest_is_the_maximum, between_the_heights, the_spline_is_cubic,
     the_draw_is_the_seeds, refused_once_more, repeating_is_told)
