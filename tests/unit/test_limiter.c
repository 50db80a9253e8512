/* limiter: papers/000 equations 6 and 7 in long double, and the cases in which they have no value. */
#include "surface/limiter.h"

#include "pipeline/stages.h"
#include "scene/params.h"

#include "unit.h"

static const struct limiter paper = {.curve = LIMITER_TANH,
                                     .alpha = 0.03,
                                     .alpha_min = 0.01,
                                     .alpha_max = 0.05,
                                     .zeta = 0.95,
                                     .force_range = {NAN, NAN}};

static double between(double lo, double hi) { return lo + (hi - lo) * drand48(); }

static double alpha_of(const struct limiter_law *l, double force)
{
    double alpha = NAN;
    limiter_alpha(l, 1, &force, &alpha);
    return alpha;
}

/* The power's relative error is (2 + |zeta log base| / 4) 2^-52 (num/vecmath.h), of a nu that takes alpha_max -
   alpha_min of alpha; the base has one rounding of N - N_min, the law a few: 8 + |zeta log base| units of 2^-53,
   relative to alpha_max. */
START_TEST(equations_6_and_7)
{
    srand48(1);
    for (int i = 0; i < 100000; i++) {
        struct limiter given = paper;
        given.alpha_max = pow(10, between(-4, 2)), given.alpha_min = given.alpha_max * pow(10, between(-4, 0));
        given.zeta = pow(10, between(-2, 2));
        double least = between(0, 5), most = least + pow(10, between(-6, 2)), force = between(least, most);
        struct limiter_law l = limiter_make(&given, least, most);
        long double base = ((long double)force - least) / ((long double)most - least), nu = powl(base, given.zeta);
        long double want = (1 - nu) * given.alpha_max + nu * given.alpha_min;
        double base_error = (double)(given.zeta * nu) * 4, power = (double)(given.zeta * fabsl(logl(base)));
        double bound = (8 + base_error + power * (double)nu) * 0x1p-53 * given.alpha_max;
        ck_assert_double_eq_tol(alpha_of(&l, force), (double)want, bound);
    }
}
END_TEST

START_TEST(ends_and_middle)
{
    struct limiter_law l = limiter_make(&paper, 0.25, 1.75);
    ck_assert(l.varies);
    ck_assert_double_eq(alpha_of(&l, 0.25), 0.05);
    ck_assert_double_eq(alpha_of(&l, 1.75), 0.01);
    ck_assert_double_eq_tol(alpha_of(&l, 1), 0.02929470152317245, 1e-16); /* 0.05 - 0.04 x 0.5^0.95 */
    double slow = 0.05;
    for (double n = 0.25; n < 1.75; n += 0.001) { /* more force, less alpha */
        ck_assert_double_le(alpha_of(&l, n), slow);
        slow = alpha_of(&l, n);
    }
}
END_TEST

START_TEST(outside_counts_as_the_ends)
{
    struct limiter_law l = limiter_make(&paper, 0.25, 1.75);
    double under[] = {nextafter(0.25, 0), 0.25 - 1e-18, 0, -1e-18, -0.0, -5, -HUGE_VAL},
           over[] = {nextafter(1.75, 2), 2, 1e9, HUGE_VAL};
    for (int i = 0; i < 7; i++)
        ck_assert_double_eq(alpha_of(&l, under[i]), 0.05);
    for (int i = 0; i < 4; i++)
        ck_assert_double_eq(alpha_of(&l, over[i]), 0.01);
    l = limiter_make(&paper, 0, 1); /* lift-off: the range begins at 0 and N is below it */
    ck_assert_double_eq(alpha_of(&l, -1e-17), 0.05);
    ck_assert_double_eq(alpha_of(&l, -0.3), 0.05);
}
END_TEST

/* 0/0 in the paper. */
START_TEST(equal_extremes)
{
    double ranges[][2] = {{1.5, 1.5}, {0, 0}, {1.5, nextafter(1.5, 2)}, {1.5, 1.5 * (1 + 1e-13)}};
    for (int i = 0; i < 4; i++) {
        struct limiter_law l = limiter_make(&paper, ranges[i][0], ranges[i][1]);
        ck_assert(!l.varies);
        ck_assert_double_eq(alpha_of(&l, ranges[i][0]), 0.03);
        ck_assert_double_eq(alpha_of(&l, 77), 0.03);
        ck_assert_double_eq(alpha_of(&l, -77), 0.03);
    }
    struct limiter_law l = limiter_make(&paper, 1.5, 1.5 * (1 + 1e-11)); /* small, but a range */
    ck_assert(l.varies);
    ck_assert_double_eq(alpha_of(&l, 1.5), 0.05);
}
END_TEST

/* An absolute range replaces the scene's own, so that 1 N and 10 N differ. */
START_TEST(range_given)
{
    struct limiter given = paper;
    given.force_range[0] = 0.2, given.force_range[1] = 5;
    struct limiter_law l = limiter_make(&given, 1, 1.1), same = limiter_make(&paper, 0.2, 5);
    for (double n = -1; n < 7; n += 0.1)
        ck_assert_double_eq(alpha_of(&l, n), alpha_of(&same, n));
    ck_assert_double_eq(alpha_of(&l, 0.2), 0.05);
    ck_assert_double_eq(alpha_of(&l, 5), 0.01);
    l = limiter_make(&given, 1, 1); /* a constant force still has its place in the range */
    ck_assert_double_eq(alpha_of(&l, 1), alpha_of(&same, 1));
}
END_TEST

START_TEST(constant_load)
{
    struct contact c = {.scraper = {.mass = 0.1}, .load = {.constant = NAN}, .contact = {.gravity = 9.80665}};
    struct arena *a = arena_open();
    struct limiter *given = params_edit(&c, limiter_stage.params, a);
    *given = paper;
    ck_assert_double_eq(limiter_constant(&c), 0.03);
    c.load.constant = 2;
    ck_assert_double_eq(limiter_constant(&c), 0.03);
    given->force_range[0] = 0, given->force_range[1] = 4;
    ck_assert_double_eq_tol(limiter_constant(&c), 0.02929470152317245, 1e-16);
    c.load.constant = NAN; /* the weight, m g */
    ck_assert_double_eq_tol(limiter_constant(&c), 0.05 - 0.04 * pow(0.980665 / 4, 0.95), 1e-16);
    c.load.constant = 10;
    ck_assert_double_eq(limiter_constant(&c), 0.01);
    arena_close(a);
}
END_TEST

START_TEST(many_as_one)
{
    enum { N = 1027 };
    static double force[N], alpha[N + 1];
    struct limiter_law l = limiter_make(&paper, 0.2, 1.4);
    srand48(2);
    for (int i = 0; i < N; i++)
        force[i] = between(0, 1.6);
    for (int n = 0; n <= N; n += 79) {
        alpha[n] = 77;
        limiter_alpha(&l, (size_t)n, force, alpha);
        ck_assert(alpha[n] == 77);
        for (int i = 0; i < n; i++)
            ck_assert_double_eq(alpha[i], alpha_of(&l, force[i]));
    }
}
END_TEST

UNIT("limiter", equations_6_and_7, ends_and_middle, outside_counts_as_the_ends, equal_extremes, range_given,
     constant_load, many_as_one)
