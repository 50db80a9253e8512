/* anova: all effects, means and Tukey's p against statsmodels and SciPy on drawn data (judge_reference.py), to 1e-9; the
   studentized range of two means against the t distribution; degrees of freedom as the papers print them. */
#include "analysis/anova.h"

#include <gsl/gsl_cdf.h>

#include "judge_drawn.h"

enum { MOST = 17 * 36 };

/* As table() of judge_reference.py. */
static struct anova_design table(int people, int factors, const int *levels, long seed, double *y)
{
    struct anova_design d = {.people = people, .factors = factors, .cells = 1, .y = y};
    for (int k = 0; k < factors; k++)
        d.cells *= d.levels[k] = levels[k];
    drawn(seed, people * d.cells, y);
    for (int i = 0; i < people * d.cells; i++) {
        int last = levels[factors - 1], at = i % last, before = i / last % levels[factors - 2],
            first = i / (d.cells / levels[0]) % levels[0];
        y[i] = 10 * y[i] + 2.0 * first + at * before + i / d.cells * (1 + 0.25 * at);
    }
    return d;
}

static void against(const struct anova_design *d, const double *want, const double *means)
{
    struct anova_effect effect[16];
    double mean[MOST], sem[MOST];
    int last = d->levels[d->factors - 1];
    anova_within(d, effect);
    for (unsigned m = 0; m + 1 < 1u << d->factors; m++, want += 6) {
        const double got[] = {effect[m].df, effect[m].df_error, effect[m].f,
                              effect[m].p,  effect[m].epsilon,  effect[m].p_gg};
        for (int k = 0; k < 6; k++)
            WITHIN(got[k], want[k]);
    }
    struct arena *a = arena_open();
    anova_means(d, 1u << (d->factors - 1), a, mean, sem);
    for (int k = 0; k < last; k++) {
        WITHIN(mean[k], means[k]);
        WITHIN(sem[k], means[last + k]);
    }
    arena_close(a);
}

START_TEST(test_statsmodels)
{
    double y[MOST];
    struct anova_design d = table(17, 4, (const int[]){2, 2, 3, 3}, 7, y);
    against(&d, reference_anova_four, reference_means_four);
    d = table(14, 2, (const int[]){5, 2}, 11, y);
    against(&d, reference_anova_two, reference_means_two);
}
END_TEST

/* 002 III-D: F(1, 16), F(4, 64) of 17 listeners; VI-D: F(4, 52) of 14. */
START_TEST(test_papers)
{
    double y[MOST];
    struct anova_effect e[16];
    struct anova_design d = table(17, 4, (const int[]){2, 2, 3, 3}, 1, y);
    anova_within(&d, e);
    ck_assert(e[0].df == 1 && e[0].df_error == 16 && e[11].df == 4 && e[11].df_error == 64);
    d = table(14, 2, (const int[]){5, 2}, 1, y);
    anova_within(&d, e);
    ck_assert(e[0].df == 4 && e[0].df_error == 52);
}
END_TEST

START_TEST(test_range)
{
    const double *r = reference_range;
    for (size_t i = 0; i < sizeof reference_range / sizeof *r; i += 4) {
        double df = r[i + 2] > 0 ? r[i + 2] : HUGE_VAL;
        WITHIN(anova_studentized_range(r[i], (int)r[i + 1], df), r[i + 3]);
    }
    for (double df = 1; df < 3000; df *= 3) /* q of two means is t sqrt(2) */
        for (double t = 0.01; t < 300; t *= 2.7)
            ck_assert_double_eq_tol(anova_studentized_range(t * sqrt(2), 2, df), 2 * gsl_cdf_tdist_Q(t, df), 1e-11);
    ck_assert_double_eq(anova_studentized_range(0, 5, 10), 1);
    ck_assert(isnan(anova_studentized_range(NAN, 5, 10)));
}
END_TEST

/* Of two levels Tukey's p is that of F; nothing but effect, nothing but listeners, nothing at all. */
START_TEST(test_limits)
{
    double y[MOST], flat[4 * 2] = {1, 2, 1, 2, 1, 2, 1, 2};
    struct anova_effect e[16];
    struct anova_design d = table(17, 4, (const int[]){2, 2, 3, 3}, 7, y);
    double mean[36], sem[36];
    struct arena *a = arena_open();
    anova_within(&d, e);
    anova_means(&d, 1, a, mean, sem);
    WITHIN(anova_tukey(&d, &e[0], mean[0] - mean[18]), e[0].p);
    arena_close(a);
    struct anova_design sure = {4, 1, {2}, 2, flat};
    anova_within(&sure, e);
    ck_assert(isinf(e[0].f) && e[0].p == 0 && anova_tukey(&sure, &e[0], 1) == 0);
    for (int i = 0; i < 8; i++)
        flat[i] = 0.1 * (i / 2);
    anova_within(&sure, e);
    ck_assert(isnan(e[0].f) && isnan(e[0].p));
}
END_TEST

UNIT("anova", test_statsmodels, test_papers, test_range, test_limits)
