/* recorded: interpolation against GSL's natural splines; smoothing against a dense solution of its definition by GSL,
   and its gain on long sines against the half power that is promised; turning points; the way travelled against
   quadrature; bad files. cubic and scan, which it rests on, as well. */
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_spline.h>
#include <stddef.h>
#include <unistd.h>

#include "motions.h"
#include "trajectory/series.h"

static const char *file_of(const char *text)
{
    static char name[40];
    strcpy(name, "/tmp/rasp_recorded_XXXXXX");
    int fd = mkstemp(name);
    ck_assert(fd >= 0 && write(fd, text, strlen(text)) == (ssize_t)strlen(text) && close(fd) == 0);
    return name;
}

static const char *table_of(int n, const double *t, const double *x, const double *y)
{
    char *text = arena_take(motions_arena(), (size_t)n * 80 + 40, 1);
    int end = sprintf(text, "time_s,x_m,y_m\n");
    for (int i = 0; i < n; i++)
        end += sprintf(text + end, "%.17g,%.17g,%.17g\n", t[i], x[i], y[i]);
    return file_of(text);
}

static struct motion recorded(const char *file, double cutoff)
{
    return (struct motion){
        .path = PATH_RECORDED, .file = file, .cutoff = cutoff, .duration = NAN, .speed = NAN, .straight = 0.1};
}

enum { MOST = 300 };

/* ------------------------------------------------------------------ interpolation */

struct plane {
    gsl_spline *axis[2];
};

static double plane_speed(double t, void *self)
{
    struct plane *p = self;
    return hypot(gsl_spline_eval_deriv(p->axis[0], t, NULL), gsl_spline_eval_deriv(p->axis[1], t, NULL));
}

/* Cut-off 0: natural cubic splines through the rows, whose first time is the start. Relative to the largest figure of
 * each kind. */
START_TEST(interpolates)
{
    srand48(1);
    for (int k = 0; k < 40; k++) {
        double t[MOST], v[2][MOST], most = 0;
        int n = k == 0 ? 2 : k == 1 ? 3 : 4 + (int)between(0, 60);
        struct plane ref;
        for (int i = 0; i < n; i++) {
            t[i] = i ? t[i - 1] + between(0.002, 0.02) : k % 2 ? 100.25 : 0;
            v[0][i] = between(-0.1, 0.1), v[1][i] = between(-0.1, 0.1);
        }
        struct motion m = recorded(table_of(n, t, v[0], v[1]), 0);
        struct trajectory tr = made(&m);
        unlink(m.file);
        ck_assert_double_eq(tr.clock, t[0]);
        ck_assert_double_eq_tol(tr.duration, t[n - 1] - t[0], 1e-16);
        for (int i = 0; i < n; i++)
            t[i] -= tr.clock;
        for (int xy = 0; xy < 2; xy++) {
            ref.axis[xy] = gsl_spline_alloc(n < 3 ? gsl_interp_linear : gsl_interp_cspline, (size_t)n);
            gsl_spline_init(ref.axis[xy], t, v[xy], (size_t)n);
            for (int i = 0; i < n; i++)
                most = fmax(most, n < 3 ? 1 : fabs(gsl_spline_eval_deriv2(ref.axis[xy], t[i], NULL)));
        }
        double sum = 0;
        for (int i = 0; i + 1 < n; i++) {
            double x = between(t[i], t[i + 1]);
            struct state s = at(&tr, x);
            for (int xy = 0; xy < 2; xy++) {
                ck_assert_double_eq_tol(s.p[xy], gsl_spline_eval(ref.axis[xy], x, NULL), 1e-14);
                ck_assert_double_eq_tol(s.vel[xy], gsl_spline_eval_deriv(ref.axis[xy], x, NULL), 1e-14 * most);
                ck_assert_double_eq_tol(s.acc[xy], gsl_spline_eval_deriv2(ref.axis[xy], x, NULL), 1e-12 * most);
                ck_assert_double_eq_tol(at(&tr, t[i]).p[xy], v[xy][i], 0x1p-52);
            }
            ck_assert_double_eq_tol(s.u, sum + integral(plane_speed, &ref, t[i], x), 1e-12);
            sum += integral(plane_speed, &ref, t[i], t[i + 1]);
        }
        ck_assert_double_eq_tol(tr.length, sum, 2e-12);
        gsl_spline_free(ref.axis[0]);
        gsl_spline_free(ref.axis[1]);
    }
}
END_TEST

/* ------------------------------------------------------------------ smoothing */

/* min sum w (y - f)^2 + p integral f''^2: (W + p Q R^-1 Q') f = W y, solved as it stands. */
static void dense(int n, const double *t, const double *y, double p, double *f)
{
    gsl_matrix *q = gsl_matrix_calloc((size_t)n, (size_t)n - 2), *r = gsl_matrix_calloc((size_t)n - 2, (size_t)n - 2);
    gsl_matrix *k = gsl_matrix_calloc((size_t)n, (size_t)n);
    gsl_vector *b = gsl_vector_alloc((size_t)n), *x = gsl_vector_alloc((size_t)n), *z = gsl_vector_alloc((size_t)n - 2);
    gsl_permutation *perm = gsl_permutation_alloc((size_t)n - 2), *whole = gsl_permutation_alloc((size_t)n);
    int sign;
    for (int j = 0; j < n - 2; j++) {
        double h0 = t[j + 1] - t[j], h1 = t[j + 2] - t[j + 1];
        gsl_matrix_set(q, (size_t)j, (size_t)j, 1 / h0);
        gsl_matrix_set(q, (size_t)j + 1, (size_t)j, -1 / h0 - 1 / h1);
        gsl_matrix_set(q, (size_t)j + 2, (size_t)j, 1 / h1);
        gsl_matrix_set(r, (size_t)j, (size_t)j, (h0 + h1) / 3);
        if (j > 0) gsl_matrix_set(r, (size_t)j, (size_t)j - 1, h0 / 6);
        if (j < n - 3) gsl_matrix_set(r, (size_t)j, (size_t)j + 1, h1 / 6);
    }
    gsl_linalg_LU_decomp(r, perm, &sign);
    for (int c = 0; c < n; c++) {
        gsl_vector_view row = gsl_matrix_row(q, (size_t)c);
        gsl_linalg_LU_solve(r, perm, &row.vector, z);
        for (int i = 0; i < n; i++) {
            double sum = 0;
            for (int j = 0; j < n - 2; j++)
                sum += gsl_matrix_get(q, (size_t)i, (size_t)j) * gsl_vector_get(z, (size_t)j);
            gsl_matrix_set(k, (size_t)i, (size_t)c, p * sum);
        }
    }
    for (int i = 0; i < n; i++) {
        double w = ((i ? t[i] - t[i - 1] : 0) + (i + 1 < n ? t[i + 1] - t[i] : 0)) / 2;
        gsl_matrix_set(k, (size_t)i, (size_t)i, gsl_matrix_get(k, (size_t)i, (size_t)i) + w);
        gsl_vector_set(b, (size_t)i, w * y[i]);
    }
    gsl_linalg_LU_decomp(k, whole, &sign);
    gsl_linalg_LU_solve(k, whole, b, x);
    for (int i = 0; i < n; i++)
        f[i] = gsl_vector_get(x, (size_t)i);
    gsl_matrix_free(q), gsl_matrix_free(r), gsl_matrix_free(k);
    gsl_vector_free(b), gsl_vector_free(x), gsl_vector_free(z);
    gsl_permutation_free(perm), gsl_permutation_free(whole);
}

/* p from the condition that a sine on evenly spaced knots has gain 1/sqrt 2, h the mean distance, worked out in other
 * terms. */
START_TEST(smoothing_is_its_definition)
{
    srand48(2);
    for (int k = 0; k < 20; k++) {
        double t[MOST], y[MOST], got[MOST], want[MOST];
        int n = 3 + (k < 4 ? k : (int)between(0, 80));
        for (int i = 0; i < n; i++) {
            t[i] = i ? t[i - 1] + between(0.5, 1.5) / 240 : -3;
            y[i] = between(-0.1, 0.1);
        }
        double h = (t[n - 1] - t[0]) / (n - 1), cutoff = between(0.01, 0.45) / h, c = cos(2 * M_PI * cutoff * h);
        double p = (sqrt(2) - 1) * (h * (2 + c) / 3) * h * h * h / ((2 - 2 * c) * (2 - 2 * c));
        dense(n, t, y, p, want);
        series_cubic_smooth((size_t)n, t, y, cutoff, got, motions_arena());
        for (int i = 0; i < n; i++)
            ck_assert_double_eq_tol(got[i], want[i], 1e-11);
    }
}
END_TEST

/* Amplitude that is left of a sine in the middle of 40 s of evenly spaced rows. */
static double gain(double rate, double frequency, double cutoff)
{
    int n = (int)(40 * rate);
    double *t = malloc((size_t)n * 3 * sizeof *t), *y = t + n, *f = y + n, re = 0, im = 0, norm = 0;
    for (int i = 0; i < n; i++) {
        t[i] = i / rate;
        y[i] = sin(2 * M_PI * frequency * t[i] + 0.3);
    }
    series_cubic_smooth((size_t)n, t, y, cutoff, f, motions_arena());
    for (int i = n / 4; i < 3 * n / 4; i++) {
        double w = 0.5 - 0.5 * cos(2 * M_PI * (i - n / 4) / (n / 2.0));
        re += w * f[i] * cos(2 * M_PI * frequency * t[i] + 0.3);
        im += w * f[i] * sin(2 * M_PI * frequency * t[i] + 0.3);
        norm += w / 2;
    }
    free(t);
    return hypot(re, im) / norm;
}

/* Half the power at the cut-off, whatever the rate; 0.95 of it an octave below and 0.02 an octave above, as recorded.c
 * says. */
START_TEST(half_power_at_the_cutoff)
{
    static const double rates[] = {30, 60, 120, 240, 1000};
    for (int i = 0; i < 5; i++) {
        ck_assert_double_eq_tol(gain(rates[i], 12, 12), sqrt(0.5), 1e-6);
        ck_assert_double_eq_tol(gain(rates[i], 3, 3), sqrt(0.5), 1e-6);
        if (rates[i] < 100) continue;
        ck_assert_double_eq_tol(pow(gain(rates[i], 6, 12), 2), 0.95, 0.01);
        ck_assert_double_eq_tol(pow(gain(rates[i], 24, 12), 2), 0.02, 0.005);
        ck_assert_double_ge(gain(rates[i], 1, 12), 0.9999);
    }
}
END_TEST

/* A straight line is left as it is, also at uneven times; and the smoothed motion is C2. */
START_TEST(lines_stay_and_motions_are_smooth)
{
    double t[MOST], x[MOST], y[MOST];
    srand48(3);
    for (int i = 0; i < MOST; i++) {
        t[i] = i ? t[i - 1] + between(0.001, 0.006) : 7;
        x[i] = 0.02 + 0.3 * (t[i] - 7), y[i] = 0.03 * sin(9 * t[i]) + 1e-4 * between(-1, 1);
    }
    struct motion m = recorded(table_of(MOST, t, x, y), 12);
    struct trajectory tr = made(&m);
    unlink(m.file);
    for (int i = 0; i < 5000; i++) {
        double at0 = between(1e-4, tr.duration - 1e-4);
        struct state s = at(&tr, at0);
        ck_assert_double_eq_tol(s.p[0], 0.02 + 0.3 * at0, 1e-13);
        ck_assert_double_eq_tol(s.p[1], 0.03 * sin(9 * (at0 + 7)), 2e-4);
        ck_assert_double_eq_tol(slope_by(&tr, at0, 1e-5, offsetof(struct state, p) + 8), s.vel[1], 1e-9);
        ck_assert_double_eq_tol(slope_by(&tr, at0, 1e-5, offsetof(struct state, vel) + 8), s.acc[1],
                                3e-2); /* the third derivative jumps */
        ck_assert_double_eq_tol(slope_by(&tr, at0, 1e-5, offsetof(struct state, u)), s.v, 1e-9);
    }
    for (int i = 1; i + 1 < MOST; i++) { /* acceleration from both sides of a row */
        double row = t[i] - 7;
        ck_assert_double_eq_tol(at(&tr, row - 1e-12).acc[1], at(&tr, row + 1e-12).acc[1], 1e-6);
    }
}
END_TEST

/* ------------------------------------------------------------------ turning round */

/* On a line: it turns where the velocity is 0, at instants known in closed form, and u goes on growing by what is
 * travelled. */
START_TEST(turns_on_a_line)
{
    enum { N = 241 };
    static double t[N], x[N], y[N];
    for (int i = 0; i < N; i++) {
        t[i] = i / 120.0;
        x[i] = 0.05 * sin(2 * M_PI * 1.7 * t[i] + 0.4) * 0.6;
        y[i] = 0.05 * sin(2 * M_PI * 1.7 * t[i] + 0.4) * 0.8;
    }
    for (int k = 0; k < 2; k++) {
        if (k == 1) memset(y, 0, sizeof y);
        struct motion m = recorded(table_of(N, t, x, y), 0);
        struct trajectory tr = made(&m);
        unlink(m.file);
        int found = 0;
        double far = 0, step = 1.0 / 7000, last = at(&tr, 0).p[0];
        for (int i = 0; i < 14000; i++) {
            double turn = trajectory_turning(&tr, i * step, (i + 1) * step);
            far += isnan(turn)
                       ? fabs(at(&tr, (i + 1) * step).p[0] - last)
                       : fabs(at(&tr, turn).p[0] - last) + fabs(at(&tr, (i + 1) * step).p[0] - at(&tr, turn).p[0]);
            last = at(&tr, (i + 1) * step).p[0];
            if (isnan(turn)) continue;
            double phase = (1.7 * turn + 0.4 / (2 * M_PI)) * 2 - 0.5;
            ck_assert_double_eq_tol(phase, rint(phase), 1e-5); /* the spline's error: (2 pi 1.7 / 120)^4 / 384 */
            ck_assert_double_le(at(&tr, turn).v, 1e-13);
            ck_assert(at(&tr, turn - 1e-9).vel[0] * at(&tr, turn + 1e-9).vel[0] < 0);
            ck_assert(isnan(trajectory_turning(&tr, turn, turn + step)) &&
                      isnan(trajectory_turning(&tr, turn - step, turn)));
            found++;
        }
        ck_assert_int_eq(found, 7);
        ck_assert_double_eq_tol(tr.length, far / (k ? 1 : 0.6), 1e-11);
        ck_assert_double_eq(at(&tr, 2).u, tr.length);
    }
}
END_TEST

/* Round an ellipse the direction turns round too, and the speed is least on the way, but nothing stops. */
START_TEST(an_ellipse_is_no_turn)
{
    enum { N = 201 };
    static double t[N], x[N], y[N];
    for (int i = 0; i < N; i++) {
        t[i] = i / 100.0;
        x[i] = 0.05 * cos(2 * M_PI * t[i]), y[i] = 0.035 * sin(2 * M_PI * t[i]);
    }
    struct motion m = recorded(table_of(N, t, x, y), 0);
    struct trajectory tr = made(&m);
    unlink(m.file);
    for (int i = 20; i < 150; i++)
        ck_assert(isnan(trajectory_turning(&tr, t[i], t[i] + 0.33)));
}
END_TEST

/* ------------------------------------------------------------------ duration, law */

START_TEST(durations)
{
    double t[] = {5, 5.1, 5.2, 5.35, 5.5}, x[] = {0, 0.01, 0.03, 0.05, 0.05}, y[] = {0, 0.01, 0, -0.01, 0};
    struct motion m = recorded(table_of(5, t, x, y), 0);
    struct trajectory whole = made(&m), part;
    m.duration = 0.27;
    part = made(&m);
    ck_assert_double_eq(part.duration, 0.27);
    ck_assert_double_eq_tol(part.length, at(&whole, 0.27).u, 1e-13);
    for (int i = 0; i <= 27; i++)
        ck_assert(at(&part, i / 100.0).p[1] == at(&whole, i / 100.0).p[1]);
    m.duration = 0.6;
    refused(&m, ERR_SCENE, "motion.duration: 0.6 s is longer than the 0.5 s");
    m.law = SPEED_CONSTANT; /* the file gives the path only */
    part = made(&m);
    ck_assert_double_eq_tol(part.length, whole.length, 1e-13);
    for (int i = 0; i <= 50; i++)
        for (int xy = 0; xy < 2; xy++)
            ck_assert_double_eq_tol(at(&part, at(&whole, i / 100.0).u / whole.length * 0.6).p[xy],
                                    at(&whole, i / 100.0).p[xy], 1e-12);
    m.duration = NAN;
    refused(&m, ERR_SCENE, "motion.duration must be given");
    unlink(m.file);
    double still[] = {0, 0.01, 0.02, 0.01, 0}, zero[5] = {0};
    m = recorded(table_of(5, t, still, zero), 0);
    m.law = SPEED_CONSTANT, m.duration = 1;
    refused(&m, ERR_SCENE, "all but stops");
    unlink(m.file);
}
END_TEST

START_TEST(files_refused)
{
    static const struct {
        const char *text, *says;
        double cutoff;
    } bad[] = {
        {"time_s,x,y_m\n0,1,1\n1,1,2\n", "no column 'x_m'", 0},
        {"time_s;x_m;y_m\n0;1;1\n1;1;2\n",
         "no column 'time_s'; what is read here are time_s, x_m, y_m, separated by commas", 0},
        {"time_s,x_m,y_m\n", "0 rows; at least 2", 0},
        {"time_s,x_m,y_m\n0,0,0\n1,1,0\n", "2 rows cannot be smoothed", 0.1},
        {"time_s,x_m,y_m\n0,0,0\n1,nan,0\n", ":3: column 'x_m': 'nan' is not a", 0},
        {"time_s,x_m,y_m\n0,0,0\n1,0,5000\n", ":3: column 'y_m': 5000 m is farther than 100 m", 0},
        {"time_s,x_m,y_m\n0,0,0\n1,0,1\n0.5,1,1\n", ":4: column 'time_s': 0.5 s comes after 1 s; times must rise", 0},
        {"time_s,x_m,y_m\n0,0,0\n9e-126,0,0.002\n1,0,0\n",
         ":3: column 'time_s': 9e-126 s comes 9e-126 s after the row before; a smooth way", 0},
        {"time_s,x_m,y_m\n5,0,0\n5.1,0,0.002\n5.1000000009,1,0\n", ":4: column 'time_s': 5.1 s comes 9e-10 s after",
         10},
        {"time_s,x_m,y_m\n0,0,0\n1,0\n", ":3: 2 cells", 0},
        {"time_s,x_m,y_m\n0,1,1\n1,1,1\n2,1,1\n", "all positions are the same", 0},
        {"time_s,x_m,y_m\n0,1,1\n1,1,2\n2,1,1\n", "motion.cutoff: 0.5 Hz is not below half of the 1 rows per second",
         0.5},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct motion m = recorded(file_of(bad[i].text), bad[i].cutoff);
        refused(&m, ERR_SCENE, bad[i].says);
        unlink(m.file);
    }
    struct motion m = recorded("/tmp/rasp_there_is_no_such_file", 0);
    refused(&m, ERR_INPUT, "no_such_file");
    m.file = NULL;
    refused(&m, ERR_SCENE, "motion.file must be given");
}
END_TEST

/* ------------------------------------------------------------------ scan */

static void wave(const void *self, size_t n, const double *t, double *y)
{
    const double *p = self; /* frequency, jump: 1 saw teeth */
    for (size_t i = 0; i < n; i++)
        y[i] = p[1] != 0 ? t[i] * p[0] - floor(t[i] * p[0])
                         : sin(2 * M_PI * p[0] * t[i]) + 0.3 * sin(2 * M_PI * 2.2 * p[0] * t[i] + 1);
}

/* Against 2 million instants; a saw's teeth reach up to 1 but for rounding. */
START_TEST(scan_finds_extremes)
{
    srand48(4);
    for (int k = 0; k < 40; k++) {
        double p[2] = {between(0.1, 5), 0}, from = between(-1, 1), to = from + between(0.1, 3), range[2],
               least = HUGE_VAL, most = -HUGE_VAL;
        series_range(&(struct scan){wave, p}, from, to, 64 + (long)(40 * p[0] * (to - from)), range);
        for (int i = 0; i <= 2000000; i += k < 10 ? 1 : 20) {
            double t = from + (to - from) * (i / 2e6), y;
            wave(p, 1, &t, &y);
            least = fmin(least, y), most = fmax(most, y);
        }
        double step = 20 * (to - from) / 2e6 * 2 * M_PI * p[0] * 2.2;
        ck_assert_double_le(range[0], least + 1e-15);
        ck_assert_double_ge(range[1], most - 1e-15);
        ck_assert_double_ge(range[0], least - 1.3 * step * step);
        ck_assert_double_le(range[1], most + 1.3 * step * step);
    }
    for (int i = 1; i < 20; i++) { /* an extreme within the first or the last step */
        double one[2] = {1, 0}, mid[2], range[2], at0 = 0, top;
        series_range(&(struct scan){wave, one}, 0.1, 0.4, 300, mid);
        for (double t = 0.1; t < 0.4; t += 1e-5) {
            wave(one, 1, &t, &top);
            at0 = top > mid[1] - 1e-9 ? t : at0;
        }
        series_range(&(struct scan){wave, one}, at0 - 0.01 * i / 20, at0 + 0.3, 30, range);
        ck_assert_double_eq_tol(range[1], mid[1], 1e-15);
        series_range(&(struct scan){wave, one}, at0 - 0.3, at0 + 0.01 * i / 20, 30, range);
        ck_assert_double_eq_tol(range[1], mid[1], 1e-15);
    }
    for (int steps = 30; steps < 200; steps++) {
        double saw[2] = {3.7, 1}, range[2];
        series_range(&(struct scan){wave, saw}, 0.05, 2.1, steps, range);
        ck_assert_double_ge(range[1], 1 - 1e-9);
        ck_assert_double_le(range[0], 1e-9);
    }
}
END_TEST

UNIT("recorded", interpolates, smoothing_is_its_definition, half_power_at_the_cutoff, lines_stay_and_motions_are_smooth,
     turns_on_a_line, an_ellipse_is_no_turn, durations, files_refused, scan_finds_extremes)
