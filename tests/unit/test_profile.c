/* profile: coefficients against a dense solution of the interpolation equations (GSL, LU), values as a part of a relief
   against sums of B-splines written out as polynomials, the closed response of a spline to a sine, orders of
   convergence, and the continuation beyond the ends against a walk that steps one sample at a time. */
#include "surface/profile.h"

#include <gsl/gsl_linalg.h>

#include "samples.h"

/* (c[i-1] + 4 c[i] + c[i+1]) / 6 = z[i], c continued as z is. */
static void solve_densely(const double *z, long n, int off_map, double *c)
{
    gsl_matrix *m = gsl_matrix_calloc((size_t)n, (size_t)n);
    gsl_permutation *p = gsl_permutation_alloc((size_t)n);
    gsl_vector_const_view right = gsl_vector_const_view_array(z, (size_t)n);
    gsl_vector_view left = gsl_vector_view_array(c, (size_t)n);
    int sign;
    for (long i = 0; i < n; i++)
        for (long k = -1; k <= 1; k++)
            *gsl_matrix_ptr(m, (size_t)i, (size_t)samples_walked(n, off_map, i + k)) += k == 0 ? 4.0 / 6 : 1.0 / 6;
    gsl_linalg_LU_decomp(m, p, &sign);
    gsl_linalg_LU_solve(m, p, &right.vector, &left.vector);
    gsl_matrix_free(m);
    gsl_permutation_free(p);
}

/* |c| reaches 3 max|z| (the norm of the inverse), and each of the two recursions has roundings of 1/(1 - 0.27): 1e-15
 * of the largest. */
START_TEST(coefficients_solve_the_equations)
{
    static const long sizes[] = {4, 5, 6, 7, 17, 64, 65, 200};
    srand48(1);
    for (int k = 0; k < 8; k++)
        for (int off_map = OFF_MAP_MIRROR; off_map <= OFF_MAP_ERROR; off_map++) {
            struct arena *a = arena_open();
            double z[200], want[200], got[200], largest = 0;
            long n = sizes[k];
            for (long i = 0; i < n; i++)
                largest = fmax(largest, fabs(z[i] = samples_random()));
            struct profile *p = profile_from_samples(a, z, (size_t)n, 5e-6, off_map);
            solve_densely(z, n, off_map, want);
            p->read(p, 0, n, got);
            for (long i = 0; i < n; i++)
                ck_assert_double_eq_tol(got[i] / largest, want[i] / largest, 4e-15);
            ck_assert(p->pitch == 5e-6 && p->from == 0 && p->to == 5e-6 * (double)(n - 1));
            arena_close(a);
        }
}
END_TEST

/* The part at n places, all values. */
static void read_part(struct relief_part *part, size_t n, const double *x, double *z, double *slope, double *bend)
{
    struct relief r = {.along = ALONG_PATH};
    part->next = NULL;
    relief_add(&r, part);
    relief_at(&r, &(struct relief_points){n, x, NULL}, &(struct relief_values){.z = z, .x = slope, .xx = bend});
}

/* Heights come back as they were given: 1e-15 of the largest, wherever the knot lies. (Places of 600 + |i| pitches are
   two roundings off; heights change by less than 4 of the largest a pitch.) */
START_TEST(knots_are_the_samples)
{
    enum { N = 999 };
    double z[N], x[N], height[N], largest = 0;
    struct arena *a = arena_open();
    srand48(2);
    for (int i = 0; i < N; i++)
        largest = fmax(largest, fabs(z[i] = samples_random()));
    for (int off_map = OFF_MAP_MIRROR; off_map <= OFF_MAP_ERROR; off_map++) {
        struct relief_part *part = profile_part(a, profile_from_samples(a, z, N, 5e-6, off_map), "profile", 3e-3);
        for (long first = -4 * N; first < 4 * N; first += 313) {
            for (long i = 0; i < N; i++)
                x[i] = 3e-3 + 5e-6 * (double)(first + i);
            read_part(part, N, x, height, NULL, NULL);
            for (long i = 0; i < N; i += 7)
                ck_assert_double_eq_tol(height[i] / largest, z[samples_walked(N, off_map, first + i)] / largest,
                                        1e-15 + 8 * 0x1p-53 * (600 + fabs((double)(first + i))));
        }
    }
    arena_close(a);
}
END_TEST

/* z (or a derivative) at q, as the header defines it. */
static double spline_at(struct profile *p, double q, int derivative)
{
    double c[4], x = q / p->pitch, sum = 0;
    long first = (long)floor(x) - 1;
    p->read(p, first, 4, c);
    for (long i = 0; i < 4; i++)
        sum += c[i] * samples_b_spline(x - (double)(first + i), derivative);
    return sum / pow(p->pitch, derivative);
}

/* Anywhere, in any order, far enough apart that the window of coefficients is left on either side: the sum of B-splines
   there. Places are held to 2^-53 of 40 mm, 1e-12 of a pitch. */
START_TEST(values_are_those_of_the_spline)
{
    enum { N = 3000, POINTS = 4000 };
    static double z[N], x[POINTS], got[3][POINTS];
    double h = 5e-6;
    struct arena *a = arena_open();
    srand48(3);
    for (int i = 0; i < N; i++)
        z[i] = samples_random();
    struct profile *p = profile_from_samples(a, z, N, h, OFF_MAP_WRAP);
    for (int sorted = -1; sorted <= 1; sorted++) {
        struct relief_part *part = profile_part(a, p, "profile", -2e-3);
        for (int i = 0; i < POINTS; i++)
            x[i] = sorted ? sorted * i * 7.3e-6 : 0.04 * (2 * drand48() - 1);
        read_part(part, POINTS, x, got[0], got[1], got[2]);
        for (int i = 0; i < POINTS; i++)
            for (int k = 0; k < 3; k++)
                ck_assert_double_eq_tol(got[k][i], spline_at(p, x[i] + 2e-3, k), 1e-11 * 1e-6 / pow(h, k));
        ck_assert(part->linear && part->pitch[0] == h && part->origin[0] == -2e-3 && part->pitch[1] == 0 &&
                  part->finest == h);
        ck_assert(part->from[0] == -2e-3 && part->to[0] == h * (N - 1) - 2e-3 && part->from[1] == -HUGE_VAL &&
                  part->to[1] == HUGE_VAL);
    }
    arena_close(a);
}
END_TEST

/* z'' is continuous and a straight line between knots: C2. */
START_TEST(curvature_is_a_broken_line)
{
    enum { N = 40 };
    double z[N], h = 1e-6, x[3], bend[3];
    struct arena *a = arena_open();
    srand48(4);
    for (int i = 0; i < N; i++)
        z[i] = samples_random();
    struct relief_part *part = profile_part(a, profile_from_samples(a, z, N, h, OFF_MAP_MIRROR), "profile", 0);
    for (long i = -60; i < 60; i++) {
        double knot = (double)i * h, low = knot - 1e-9 * h, high = knot + 1e-9 * h;
        read_part(part, 3, (double[]){low, knot, high}, (double[3]){0}, (double[3]){0}, bend);
        ck_assert_double_eq_tol(bend[0], bend[1], 1e-7 * 1e-6 / (h * h));
        ck_assert_double_eq_tol(bend[2], bend[1], 1e-7 * 1e-6 / (h * h));
        for (int k = 0; k < 3; k++)
            x[k] = knot + (0.1 + 0.4 * k) * h;
        read_part(part, 3, x, NULL, NULL, bend);
        ck_assert_double_eq_tol(bend[1], 0.5 * (bend[0] + bend[2]), 1e-12 * 1e-6 / (h * h));
    }
    arena_close(a);
}
END_TEST

/* A whole number of periods under wrap: the spline's response to a sine of phase step w is closed, z'' = -(6/h^2)(1 -
   cos w)/(2 + cos w) z and z' = 3 sin w / (h (2 + cos w)) times the cosine. */
START_TEST(response_to_a_sine)
{
    enum { N = 240 };
    double z[N], x[N], slope[N], bend[N], h = 0x1p-19;
    struct arena *a = arena_open();
    for (int periods = 0; periods <= N / 2; periods++) {
        double w = 2 * M_PI * periods / N;
        for (int i = 0; i < N; i++) {
            z[i] = 3e-6 * cos(2 * M_PI * (periods * i % N) / N + 0.4);
            x[i] = i * h; /* exact */
        }
        read_part(profile_part(a, profile_from_samples(a, z, N, h, OFF_MAP_WRAP), "sine", 0), N, x, NULL, slope, bend);
        for (int i = 0; i < N; i++) {
            ck_assert_double_eq_tol(bend[i], -6 / (h * h) * (1 - cos(w)) / (2 + cos(w)) * z[i], 3e-14 * 3e-6 / (h * h));
            ck_assert_double_eq_tol(
                slope[i], -3 * sin(w) / (h * (2 + cos(w))) * 3e-6 * sin(2 * M_PI * (periods * i % N) / N + 0.4),
                2e-14 * 3e-6 / h);
        }
    }
    arena_close(a);
}
END_TEST

/* Largest error of a derivative of sin(2 pi q) sampled n times per period, over the period, as a part of the
 * derivative's size. */
static double error_of(int n, int derivative)
{
    struct arena *a = arena_open();
    double *z = ARENA_TAKE(a, double, n), worst = 0, k = 2 * M_PI;
    for (int i = 0; i < n; i++)
        z[i] = sin(k * i / n);
    struct profile *p = profile_from_samples(a, z, (size_t)n, 1.0 / n, OFF_MAP_WRAP);
    for (int i = 0; i < 4000; i++) {
        double q = i / 4000.0, want = derivative == 0 ? sin(k * q) : derivative == 1 ? cos(k * q) : -sin(k * q);
        worst = fmax(worst, fabs(spline_at(p, q, derivative) / pow(k, derivative) - want));
    }
    arena_close(a);
    return worst;
}

/* Orders 4, 3 and 2 for height, slope and curvature anywhere between the knots; the leading errors of spline theory are
   w^4/384, sqrt(3) w^3/216 and w^2/12 with w = 2 pi / n, and are met within a tenth. */
START_TEST(orders_of_convergence)
{
    static const double leading[] = {1.0 / 384, 0.0080188, 1.0 / 12};
    for (int derivative = 0; derivative <= 2; derivative++)
        for (int n = 16; n <= 256; n *= 2) {
            double coarse = error_of(n, derivative), fine = error_of(2 * n, derivative), w = 2 * M_PI / n;
            ck_assert_double_eq_tol(log2(coarse / fine), 4 - derivative, 0.1);
            ck_assert_double_eq_tol(coarse / (leading[derivative] * pow(w, 4 - derivative)), 1, 0.1);
        }
}
END_TEST

/* Far outside, on either side, any length of reading: what stepping sample by sample says, and symmetries at any
 * distance. */
START_TEST(continued_for_ever)
{
    static const long sizes[] = {4, 5, 33};
    double z[33], inside[33], c[64];
    struct arena *a = arena_open();
    srand48(4);
    for (int k = 0; k < 3; k++)
        for (int off_map = OFF_MAP_MIRROR; off_map <= OFF_MAP_ERROR; off_map++) {
            long n = sizes[k], period = off_map == OFF_MAP_WRAP ? n : 2 * n - 2;
            for (long i = 0; i < n; i++)
                z[i] = samples_random();
            struct profile *p = profile_from_samples(a, z, (size_t)n, 1e-6, off_map);
            p->read(p, 0, n, inside);
            for (long first = -300; first < 300; first += 17) {
                p->read(p, first, 64, c);
                for (long i = 0; i < 64; i++)
                    ck_assert(c[i] == inside[samples_walked(n, off_map, first + i)]);
            }
            for (long far = 1; far < 1000000000000000000 / period; far *= 1000)
                for (int side = -1; side <= 1; side += 2) {
                    p->read(p, side * far * period, n, c);
                    ck_assert_mem_eq(c, inside, (size_t)n * sizeof *c);
                }
        }
    arena_close(a);
}
END_TEST

/* No output asked for is written, none changes another, and a part adds to what is there. */
START_TEST(outputs_are_optional)
{
    enum { N = 12 };
    double z[N], x[N], all[3][N], one[N];
    struct arena *a = arena_open();
    srand48(5);
    for (int i = 0; i < N; i++) {
        z[i] = samples_random();
        x[i] = 1e-6 * (1.3 * i - 3);
    }
    struct relief_part *part = profile_part(a, profile_from_samples(a, z, N, 1e-6, OFF_MAP_MIRROR), "profile", 0);
    read_part(part, N, x, all[0], all[1], all[2]);
    for (int k = 0; k < 3; k++) {
        read_part(part, N, x, k == 0 ? one : NULL, k == 1 ? one : NULL, k == 2 ? one : NULL);
        ck_assert_mem_eq(one, all[k], sizeof one);
    }
    part->add(part, &(struct relief_points){N, x, NULL}, &(struct relief_values){.xx = one});
    for (int i = 0; i < N; i++)
        ck_assert_double_eq_tol(one[i], 2 * all[2][i], 1e-14 * fabs(all[2][i]));
    arena_close(a);
}
END_TEST

/* Mirrored ends are flat: z' = 0 there, and the profile is even about them. */
START_TEST(mirror_is_even)
{
    enum { N = 21 };
    double z[N], h = 1e-6;
    struct arena *a = arena_open();
    srand48(6);
    for (int i = 0; i < N; i++)
        z[i] = samples_random();
    struct profile *p = profile_from_samples(a, z, N, h, OFF_MAP_MIRROR);
    ck_assert_double_eq_tol(spline_at(p, 0, 1), 0, 1e-14);
    ck_assert_double_eq_tol(spline_at(p, (N - 1) * h, 1), 0, 1e-14);
    for (double d = 0; d < 50 * h; d += 0.37 * h)
        for (int k = 0; k < 3; k++) {
            double odd = k == 1 ? -1 : 1, size = 1e-13 * 1e-6 / pow(h, k);
            ck_assert_double_eq_tol(spline_at(p, d, k), odd * spline_at(p, -d, k), size);
            ck_assert_double_eq_tol(spline_at(p, (N - 1) * h + d, k), odd * spline_at(p, (N - 1) * h - d, k), size);
        }
    arena_close(a);
}
END_TEST

UNIT("profile", coefficients_solve_the_equations, knots_are_the_samples, values_are_those_of_the_spline,
     curvature_is_a_broken_line, response_to_a_sine, orders_of_convergence, continued_for_ever, outputs_are_optional,
     mirror_is_even)
