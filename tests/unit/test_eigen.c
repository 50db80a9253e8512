/* num/eigen.h against GSL's solver, on random matrices and on a plate's, and by what eigenvectors are. */
#include "num/eigen.h"

#include <gsl/gsl_eigen.h>

#include "num/special.h"
#include "unit.h"

static double *copy(struct arena *a, int n, const double *k)
{
    double *to = ARENA_TAKE(a, double, n *n);
    memcpy(to, k, (size_t)(n * n) * sizeof *to);
    return to;
}

/* The upper halves are full of what nobody may read. */
static double *lower(struct arena *a, int n, const double *k)
{
    double *to = copy(a, n, k);
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++)
            to[i * n + j] = NAN;
    return to;
}

/* GSL's eigenvalues, falling. */
static double *reference(struct arena *a, int n, const double *k)
{
    double *value = ARENA_TAKE(a, double, n);
    gsl_matrix_view m = gsl_matrix_view_array(copy(a, n, k), n, n);
    gsl_vector_view v = gsl_vector_view_array(value, n);
    gsl_eigen_symm_workspace *w = gsl_eigen_symm_alloc(n);
    ck_assert_int_eq(gsl_eigen_symm(&m.matrix, &v.vector, w), 0);
    gsl_eigen_symm_free(w);
    for (int i = 1; i < n; i++)
        for (int j = i; j > 0 && value[j] > value[j - 1]; j--) {
            double t = value[j];
            value[j] = value[j - 1];
            value[j - 1] = t;
        }
    return value;
}

/* All above `least`: as GSL says, and K v = mu v, v_i v_j = d_ij, each within 2e-16 (n + 10). */
static int check(struct arena *a, int n, const double *k, double least)
{
    double *value = ARENA_TAKE(a, double, n), *vector, *want = reference(a, n, k), size = 0;
    for (int i = 0; i < n; i++)
        size = fmax(size, fabs(want[i]));
    int found = eigen_above(n, lower(a, n, k), least, a, value, &vector);
    for (int i = 0; i < n; i++)
        if (fabs(want[i] - least) > 1e-12 * size) ck_assert_int_eq(want[i] > least, i < found);
    for (int i = 0; i < found; i++) {
        const double *v = vector + i * n;
        ck_assert_double_le(fabs(value[i] - want[i]), 2e-16 * (n + 10) * size);
        ck_assert(i == 0 || value[i] <= value[i - 1]);
        for (int r = 0; r < n; r++) {
            double left = -value[i] * v[r];
            for (int c = 0; c < n; c++)
                left += k[r * n + c] * v[c];
            ck_assert_double_le(fabs(left), 2e-16 * (n + 10) * size);
        }
        for (int j = 0; j <= i; j++) {
            double dot = -(i == j);
            for (int c = 0; c < n; c++)
                dot += v[c] * vector[j * n + c];
            ck_assert_double_le(fabs(dot), 2e-16 * (n + 10));
        }
    }
    return found;
}

START_TEST(test_random)
{
    const int sizes[] = {1, 2, 3, 7, 8, 9, 31, 64, 65, 150};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++)
        for (int grade = 0; grade < 4; grade++) { /* none; large ones last; first; 12 orders of magnitude */
            struct arena *a = arena_open();
            int n = sizes[s];
            double *k = ARENA_TAKE(a, double, n *n), spread = grade == 3 ? 12 : grade ? 4 : 0;
            for (int i = 0; i < n; i++)
                for (int j = 0; j <= i; j++) {
                    double place = 0.5 * (i + j) / n - (grade == 1);
                    k[i * n + j] = k[j * n + i] = (drand48() - 0.5) * pow(10, -spread * fabs(place));
                }
            ck_assert_int_eq(check(a, n, k, -HUGE_VAL), n);
            ck_assert_int_eq(check(a, n, k, HUGE_VAL), 0);
            for (int t = 0; t < 3; t++)
                check(a, n, k, (t - 1) * 0.3 * reference(a, n, k)[0]);
            arena_close(a);
        }
}
END_TEST

/* Equal eigenvalues, none beside the diagonal, zeros alone. */
START_TEST(test_multiple)
{
    enum { N = 40 };
    struct arena *a = arena_open();
    double *k = ARENA_TAKE(a, double, N *N), x[N], square = 0;
    ck_assert_int_eq(check(a, N, k, -1), N);
    ck_assert_int_eq(check(a, N, k, 0), 0);
    for (int i = 0; i < N; i++)
        k[i * N + i] = i % 3;
    ck_assert_int_eq(check(a, N, k, 0.5), 26);
    for (int i = 0; i < N; i++) {
        x[i] = drand48() - 0.5;
        square += x[i] * x[i];
    }
    for (int i = 0; i < N; i++) /* 1 but along x, there -1 */
        for (int j = 0; j < N; j++)
            k[i * N + j] = (i == j) - 2 * x[i] * x[j] / square;
    ck_assert_int_eq(check(a, N, k, 0), N - 1);
    ck_assert_int_eq(check(a, N, k, -2), N);
    arena_close(a);
}
END_TEST

/* D S D, D from 1 to 1e-6, S well conditioned: each element relative to its own size. */
START_TEST(test_inverse)
{
    enum { N = 60 };
    struct arena *a = arena_open();
    double *s = ARENA_TAKE(a, double, N *N), d[N];
    for (int i = 0; i < N; i++) {
        d[i] = pow(10, -6.0 * i / N);
        for (int j = 0; j <= i; j++)
            s[i * N + j] = s[j * N + i] = (i == j) * 2 + (drand48() - 0.5) / 8;
    }
    double *k = ARENA_TAKE(a, double, N *N);
    for (int i = 0; i < N * N; i++)
        k[i] = d[i / N] * s[i] * d[i % N];
    double *inverse = lower(a, N, k);
    ck_assert(eigen_inverse(N, inverse));
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            double sum = -(i == j);
            for (int c = 0; c < N; c++)
                sum += s[i * N + c] * d[c] * (c >= j ? inverse[c * N + j] : inverse[j * N + c]) * d[j];
            ck_assert_double_lt(fabs(sum), 1e-14);
        }
    k[17 * N + 17] = -1e-9;
    ck_assert(!eigen_inverse(N, lower(a, N, k)));
    k[17 * N + 17] = NAN;
    ck_assert(!eigen_inverse(N, lower(a, N, k)));
    arena_close(a);
}
END_TEST

/* A clamped square plate, int (lap w)^2, in Jacobi's functions, by falling degree: the lowest frequency (Leissa), and
   those up to a hundred times that beside GSL's of c = mu K c, all mu within 1e-15 n of the largest. */
START_TEST(test_plate)
{
    enum { M = 18, N = M * M, POINTS = 30 };
    struct arena *a = arena_open();
    struct jacobi f = special_jacobi_make(2, 2);
    double node[POINTS], weight[POINTS], value[3][M], bent[M][M] = {{0}}, cross[M][M] = {{0}};
    special_gauss_legendre(POINTS, node, weight);
    for (int q = 0; q < POINTS; q++) {
        special_jacobi_slopes(&f, M, node[q], value[0], value[1], value[2]);
        for (int i = 0; i < M; i++)
            for (int j = 0; j < M; j++) {
                bent[i][j] += 16 * weight[q] * value[2][i] * value[2][j];
                cross[i][j] += 4 * weight[q] * value[1][i] * value[1][j];
            }
    }
    gsl_matrix *k = gsl_matrix_alloc(N, N), *one = gsl_matrix_alloc(N, N), *v = gsl_matrix_alloc(N, N);
    gsl_vector *mu = gsl_vector_alloc(N);
    gsl_eigen_gensymmv_workspace *w = gsl_eigen_gensymmv_alloc(N);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            int p = M - 1 - i / M, q = M - 1 - i % M, r = M - 1 - j / M, s = M - 1 - j % M;
            gsl_matrix_set(k, i, j,
                           (q == s ? bent[p][r] : 0) + (p == r ? bent[q][s] : 0) + 2 * cross[p][r] * cross[q][s]);
        }
    double *own = lower(a, N, k->data), *found = ARENA_TAKE(a, double, N), *vector;
    gsl_matrix_set_identity(one);
    ck_assert_int_eq(gsl_eigen_gensymmv(one, k, mu, v, w), 0);
    gsl_eigen_gensymmv_sort(mu, v, GSL_EIGEN_SORT_VAL_DESC);
    ck_assert(eigen_inverse(N, own));
    int most = eigen_above(N, own, 1e-4 * gsl_vector_get(mu, 0), a, found, &vector);
    ck_assert(gsl_vector_get(mu, most - 1) > 1e-4 * found[0] && gsl_vector_get(mu, most) < 1e-4 * found[0]);
    ck_assert_double_lt(fabs(1 / sqrt(found[0]) - 35.985), 5e-4 * 35.985);
    for (int i = 0; i < most; i++)
        ck_assert_double_lt(fabs(found[i] - gsl_vector_get(mu, i)), 1e-15 * N * found[0]);
    gsl_eigen_gensymmv_free(w);
    gsl_vector_free(mu);
    gsl_matrix_free(v);
    gsl_matrix_free(one);
    gsl_matrix_free(k);
    arena_close(a);
}
END_TEST

UNIT("eigen", test_random, test_multiple, test_inverse, test_plate)
