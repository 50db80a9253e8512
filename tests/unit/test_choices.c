/* choices: against NumPy, SciPy and statsmodels (judge_reference.py), to 1e-9; and simulated listeners of 003's study,
   whose answers give its tables back. */
#include "analysis/choices.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include "judge_drawn.h"

START_TEST(test_reference)
{
    double m[25], o[25], d[12], hold[2], p;
    const double *r = reference_wilson, *t = reference_tests;
    int df;
    bool all;
    drawn(21, 25, m);
    drawn(22, 25, o);
    for (int f = 0; f < 2; f++) {
        WITHIN(choices_similarity(m, o, 5, f), reference_norms[f]);
        ck_assert_double_eq(choices_similarity(m, m, 5, f), 1);
    }
    WITHIN(choices_deviations(0.95, 1), gsl_cdf_ugaussian_Pinv(0.975));
    for (size_t i = 0; i < sizeof reference_wilson / sizeof *r; i += 4) {
        choices_wilson(r[i], r[i + 1], choices_deviations(0.95, 1), hold);
        WITHIN(hold[0], r[i + 2]);
        WITHIN(hold[1], r[i + 3]);
    }
    WITHIN(choices_chi_squared((const double[]){36, 34, 0, 0, 1}, (const double[]){57, 47, 0, 0, 4}, 5, &df, &p),
           reference_chi[0]);
    ck_assert_int_eq(df, (int)reference_chi[1]);
    WITHIN(p, reference_chi[2]);
    choices_chi_squared((const double[]){3, 0}, (const double[]){7, 0}, 2, &df, &p);
    ck_assert(df == 0 && isnan(p));
    drawn(5, 12, d);
    for (int i = 0; i < 12; i++)
        d[i] = 20 * d[i] + 3;
    WITHIN(choices_permutation(d, 12, 4096, 1, &all), t[0]);
    ck_assert(all);
    /* drawn, 4 deviations of the share */
    ck_assert_double_eq_tol(choices_permutation(d, 12, 4095 * 10, 1, &all), t[0], 4 * sqrt(t[0] * (1 - t[0]) / 40950));
    struct choices_equivalence e = choices_equivalence(d, 12, 10);
    WITHIN(e.mean, t[1]);
    WITHIN(e.low, t[2]);
    WITHIN(e.high, t[3]);
    WITHIN(e.p, t[4]);
}
END_TEST

/* ------------------------------------------------------------------ 003 tables 1 and 2: scenes/answers/003_study.csv */

enum { TABLES = 2, CLASSES = 5, RUNS = 1000, SEEDS = 3 };
static const unsigned study[TABLES][CLASSES][CLASSES] = {
    {{36, 34, 0, 0, 1}, {6, 6, 1, 0, 3}, {0, 0, 41, 6, 15}, {0, 0, 1, 13, 72}, {2, 2, 2, 25, 85}},
    {{57, 47, 0, 0, 4}, {40, 49, 0, 2, 2}, {3, 3, 119, 26, 20}, {0, 1, 7, 28, 58}, {6, 6, 7, 74, 90}}};

struct covered {
    int cells, rows_right, whole; /* of RUNS: cells and rates of right answers in their intervals; tables as a whole */
};

/* Listeners' answers drawn from a table's shares, and where the intervals about them leave the table. */
static struct covered run(const unsigned table[CLASSES][CLASSES], gsl_rng *g)
{
    struct covered c = {0};
    double one = choices_deviations(0.95, 1), at_once = choices_deviations(0.95, CLASSES * CLASSES), hold[2];
    for (int r = 0; r < RUNS; r++) {
        bool whole = true;
        for (int i = 0; i < CLASSES; i++) {
            double share[CLASSES], n = 0;
            unsigned answers[CLASSES];
            for (int k = 0; k < CLASSES; k++)
                n += table[i][k];
            for (int k = 0; k < CLASSES; k++)
                share[k] = table[i][k] / n;
            gsl_ran_multinomial(g, CLASSES, (unsigned)n, share, answers);
            for (int k = 0; k < CLASSES; k++) {
                choices_wilson(answers[k], n, one, hold);
                bool in = hold[0] <= share[k] && share[k] <= hold[1];
                c.cells += in;
                c.rows_right += in && i == k;
                choices_wilson(answers[k], n, at_once, hold);
                whole = whole && hold[0] <= share[k] && share[k] <= hold[1];
            }
        }
        c.whole += whole;
    }
    return c;
}

/* What a cell's interval holds of the binomial distribution, summed exactly. */
static double expected(unsigned k, unsigned n)
{
    double sum = 0, hold[2], z = choices_deviations(0.95, 1);
    for (unsigned i = 0; i <= n; i++) {
        choices_wilson(i, n, z, hold);
        if (hold[0] <= (double)k / n && (double)k / n <= hold[1]) sum += gsl_ran_binomial_pdf(i, (double)k / n, n);
    }
    return sum;
}

/* Three deviations of 1000 runs about 95 % are 2.1 %. Wilson's interval of one cell holds 95 % on average over shares,
   not at each: what it holds of these is summed exactly, and the mean of the drawn cells lies within 1 % of that. */
START_TEST(test_study)
{
    for (int t = 0; t < TABLES; t++) {
        double exact = 0;
        for (int i = 0; i < CLASSES; i++) {
            unsigned n = 0;
            for (int k = 0; k < CLASSES; k++)
                n += study[t][i][k];
            for (int k = 0; k < CLASSES; k++)
                exact += expected(study[t][i][k], n) / (CLASSES * CLASSES);
        }
        for (int seed = 1; seed <= SEEDS; seed++) {
            gsl_rng *g = gsl_rng_alloc(gsl_rng_mt19937);
            gsl_rng_set(g, (unsigned long)seed);
            struct covered c = run(study[t], g);
            printf("table %d, seed %d: cells %.4f (exactly %.4f), right %.4f, whole tables %.3f\n", t + 1, seed,
                   c.cells / (RUNS * 25.0), exact, c.rows_right / (RUNS * 5.0), c.whole / (double)RUNS);
            ck_assert_double_eq_tol(c.cells / (RUNS * 25.0), exact, 0.01);
            ck_assert_double_ge(c.cells / (RUNS * 25.0), 0.95 - 0.01);
            ck_assert_double_ge(c.whole / (double)RUNS, 0.95 - 0.021);
            gsl_rng_free(g);
        }
    }
}
END_TEST

UNIT("choices", test_reference, test_study)
