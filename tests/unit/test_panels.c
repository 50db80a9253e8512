/* panels: integrals and inverses known in closed form, over long ways, through kinks, past jumps of the slope's
   derivative.

   Tolerance: 5e-14 and two roundings of x are what each piece is made for, at two places of it; half-way it may be
   twice as much. Rounding of the value is far less. */
#include "trajectory/panels.h"

#include "unit.h"

static void swelling(const void *self, size_t n, const double *x, double *g, double *dg)
{
    (void)self;
    for (size_t i = 0; i < n; i++)
        g[i] = 1 + 0.5 * sin(x[i]), dg[i] = 0.5 * cos(x[i]);
}

static void kinked(const void *self, size_t n, const double *x, double *g, double *dg)
{
    (void)self;
    for (size_t i = 0; i < n; i++)
        g[i] = fabs(sin(x[i])), dg[i] = sin(x[i]) > 0 ? cos(x[i]) : -cos(x[i]);
}

static void stepped(const void *self, size_t n, const double *x, double *g, double *dg)
{
    (void)self;
    for (size_t i = 0; i < n; i++)
        g[i] = x[i] < 1 ? 1 : x[i] * x[i], dg[i] = x[i] < 1 ? 0 : 2 * x[i];
}

static double value(const struct panels *p, double x, double *df, double *ddf)
{
    double f;
    panels_at(p, 1, &x, &f, df, ddf);
    return f;
}

/* x - (cos x - 1) / 2. Many pieces, whose sum does not drift; derivatives of the very function. */
START_TEST(integral_over_a_long_way)
{
    enum { N = 5000 };
    static double breaks[N + 1];
    struct arena *a = arena_open();
    struct panels p;
    for (int i = 0; i <= N; i++)
        breaks[i] = i;
    panels_integral(&(struct panels_slope){swelling, NULL}, breaks, N + 1, a, &p);
    ck_assert_uint_gt(p.n, N);
    srand48(1);
    for (int i = 0; i < 50000; i++) {
        double x = i == 0 ? N : N * drand48(), df, ddf;
        long double want = (long double)x + (1 - cosl(x)) / 2;
        ck_assert_double_eq_tol(value(&p, x, &df, &ddf), (double)want, 1e-13 + 0x1p-50 * x);
        ck_assert_double_eq_tol(df, 1 + 0.5 * sin(x), 1e-10);
        ck_assert_double_eq_tol(ddf, 0.5 * cos(x), 1e-7);
    }
    /* the sum does not drift with the number of pieces */
    ck_assert_double_eq_tol(panels_last(&p), (double)(N + (1 - cosl(N)) / 2), 1e-12);
    ck_assert(value(&p, -3, NULL, NULL) == 0 && value(&p, 1e9, NULL, NULL) == panels_last(&p)); /* held in the range */
    arena_close(a);
}
END_TEST

START_TEST(inverse_over_a_long_way)
{
    enum { N = 1000 };
    static double breaks[N + 1];
    struct arena *a = arena_open();
    struct panels p;
    double where;
    for (int i = 0; i <= N; i++)
        breaks[i] = i;
    ck_assert(panels_inverse(&(struct panels_slope){swelling, NULL}, breaks, N + 1, 0, a, &p, &where));
    srand48(2);
    for (int i = 0; i < 50000; i++) {
        double x = N * drand48(), way = (double)((long double)x + (1 - cosl(x)) / 2), df;
        ck_assert_double_eq_tol(value(&p, way, &df, NULL), x, 1e-13 + 0x1p-50 * x);
        ck_assert_double_eq_tol(df, 1 / (1 + 0.5 * sin(x)), 1e-9);
    }
    arena_close(a);
}
END_TEST

/* |sin x| over ten half waves: 2 each; no break where it has its kinks. */
START_TEST(kinks_are_found)
{
    double breaks[] = {0, 7, 12, 10 * 3.14159265358979323846}, where;
    struct arena *a = arena_open();
    struct panels p;
    panels_integral(&(struct panels_slope){kinked, NULL}, breaks, 4, a, &p);
    for (int i = 0; i <= 10000; i++) {
        double x = 10 * M_PI * i / 10000, k = floor(x / M_PI);
        ck_assert_double_eq_tol(value(&p, x, NULL, NULL), 2 * k + 1 - cos(x - k * M_PI), 1e-12);
    }
    ck_assert(!panels_inverse(&(struct panels_slope){kinked, NULL}, breaks, 4, 1e-3, a, &p,
                              &where)); /* it stands still there */
    ck_assert_double_le(fabs(sin(where)), 1e-3);
    arena_close(a);
}
END_TEST

/* Slopes and their derivatives just inside a break: 1, then x^2. */
START_TEST(breaks_separate)
{
    double breaks[] = {0, 1, 2}, df, ddf;
    struct arena *a = arena_open();
    struct panels p;
    panels_integral(&(struct panels_slope){stepped, NULL}, breaks, 3, a, &p);
    for (int i = 0; i <= 200; i++) {
        double x = i / 100.0, want = x < 1 ? x : 1 + (x * x * x - 1) / 3;
        ck_assert_double_eq_tol(value(&p, x, &df, &ddf), want, 1e-13);
        if (i != 100) ck_assert_double_eq_tol(ddf, x < 1 ? 0 : 2 * x, 1e-7);
    }
    ck_assert_uint_le(p.n, 4); /* a cubic is one piece */
    arena_close(a);
}
END_TEST

/* In batches, in any order, as one by one. */
START_TEST(batches)
{
    double breaks[] = {0, 50}, x[999], f[999];
    struct arena *a = arena_open();
    struct panels p;
    panels_integral(&(struct panels_slope){swelling, NULL}, breaks, 2, a, &p);
    srand48(3);
    for (int order = 0; order < 3; order++) {
        for (int i = 0; i < 999; i++)
            x[i] = order == 0 ? i * 0.051 : order == 1 ? 50.5 - i * 0.052 : 50 * drand48();
        panels_at(&p, 999, x, f, NULL, NULL);
        for (int i = 0; i < 999; i++)
            ck_assert_double_eq(f[i], value(&p, x[i], NULL, NULL));
    }
    arena_close(a);
}
END_TEST

UNIT("panels", integral_over_a_long_way, inverse_over_a_long_way, kinks_are_found, breaks_separate, batches)
