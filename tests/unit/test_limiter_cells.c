/* limited: means and moments of T over a piece against GSL's adaptive quadrature: where the curvature runs along a
   straight line, and where it bulges. */
#include "surface/limiter.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include "unit.h"

/* ------------------------------------------------------------------ pieces, each with two points of its own */

static struct {
    int n, at[LIMITER_CELLS];
    double alpha[LIMITER_POINTS], curvature[LIMITER_POINTS], sagitta[LIMITER_CELLS], limited[LIMITER_POINTS],
        mean[LIMITER_CELLS], moment[LIMITER_CELLS];
} pieces;

static void add_piece(double alpha, double c0, double c1, double sagitta)
{
    int i = pieces.n++;
    pieces.at[i] = 2 * i;
    pieces.alpha[2 * i] = pieces.alpha[2 * i + 1] = alpha;
    pieces.curvature[2 * i] = c0;
    pieces.curvature[2 * i + 1] = c1;
    pieces.sagitta[i] = sagitta;
}

static void run(bool bulges, bool limiter)
{
    limiter_cells(&(struct limiter_cells){pieces.n, 2 * pieces.n, pieces.at, pieces.alpha, pieces.curvature,
                                          bulges ? pieces.sagitta : NULL, pieces.limited, pieces.mean, pieces.moment},
                  limiter);
}

static double between(double lo, double hi) { return lo + (hi - lo) * drand48(); }

static double signed_power(double lo, double hi) { return (drand48() < 0.5 ? -1 : 1) * pow(10, between(lo, hi)); }

/* ------------------------------------------------------------------ the judge */

struct line {
    double x0, x1, b;
    int power;
};

/* (share - 1/2)^power tanh(x) at a share of the way from x0 to x1, b above the straight line in the middle. */
static double integrand(double share, void *data)
{
    const struct line *l = data;
    return (l->power ? share - 0.5 : 1) * tanh(l->x0 + share * (l->x1 - l->x0) + 4 * l->b * share * (1 - share));
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Adds the shares between 0 and 1 at which the parabola passes the level. */
static int passes(const struct line *l, double level, double *share, int n)
{
    double p = l->x1 - l->x0 + 4 * l->b, c = l->x0 - level, root = p * p + 16 * l->b * c, at[2] = {NAN, NAN};
    if (l->b == 0 && p != 0)
        at[0] = -c / p;
    else if (l->b != 0 && root >= 0) {
        double s = p + (p < 0 ? -1 : 1) * sqrt(root);
        at[0] = s / (8 * l->b);
        at[1] = s != 0 ? -2 * c / s : NAN;
    }
    for (int k = 0; k < 2; k++)
        if (at[k] > 0 && at[k] < 1) share[n++] = at[k];
    return n;
}

/* alpha times the mean (power 0) or moment (power 1) of T. The steps of tanh are given to the quadrature as break
 * points. */
static double quadrature(double x0, double x1, double b, int power)
{
    static const double steps[] = {-20, -3, -1, 0, 1, 3, 20};
    gsl_integration_workspace *space = gsl_integration_workspace_alloc(1000);
    struct line line = {x0, x1, b, power};
    gsl_function f = {integrand, &line};
    double share[20] = {0}, sum = 0;
    int n = 1;
    for (int k = 0; k < 7; k++)
        n = passes(&line, steps[k], share, n);
    share[n++] = 1;
    qsort(share, (size_t)n, sizeof *share, ascending);
    for (int k = 0; k + 1 < n; k++) {
        double part, error;
        int code = share[k] < share[k + 1]
                       ? gsl_integration_qags(&f, share[k], share[k + 1], 1e-15, 1e-12, 1000, space, &part, &error)
                       : -1;
        ck_assert_msg(code <= 0 || (code == GSL_EROUND && error < 1e-13), "%s", gsl_strerror(code));
        sum += code == -1 ? 0 : part;
    }
    gsl_integration_workspace_free(space);
    return sum;
}

/* ------------------------------------------------------------------ straight lines */

/* x0 = alpha c0 and the way x1 - x0 over all decades that the two formulas and their border see, both signs; c itself
 * between 1e-9 and 1e9. */
START_TEST(means_and_moments_are_integrals)
{
    double worst[2] = {0, 0};
    gsl_set_error_handler_off();
    srand48(2);
    for (int round = 0; round < 40; round++) {
        double x[LIMITER_CELLS][2];
        pieces.n = 0;
        for (int i = 0; i < LIMITER_CELLS; i++) {
            double alpha = pow(10, between(-6, 3));
            double x0 = signed_power(-9, i % 2 ? 6 : 1.3),
                   way = i % 16 == 0 ? 0 : signed_power(i % 3 ? -3.5 : -9, i % 4 ? 2 : 5);
            double x1 = i % 16 == 1 ? -x0 : i % 16 == 2 ? 0 : x0 + way;
            add_piece(alpha, x0 / alpha, x1 / alpha, 0);
            x[i][0] = alpha * (x0 / alpha);
            x[i][1] = alpha * (x1 / alpha);
        }
        run(round % 2, true); /* a rim of 0 is none */
        for (int i = 0; i < LIMITER_CELLS; i++) {
            double mean = fabs(pieces.alpha[2 * i] * pieces.mean[i] - quadrature(x[i][0], x[i][1], 0, 0));
            double moment = fabs(pieces.alpha[2 * i] * pieces.moment[i] - quadrature(x[i][0], x[i][1], 0, 1));
            worst[0] = fmax(worst[0], mean);
            worst[1] = fmax(worst[1], moment);
            ck_assert_msg(mean < 2e-12, "mean from %.17g to %.17g: off by %g", x[i][0], x[i][1], mean);
            ck_assert_msg(moment < 4e-7, "moment from %.17g to %.17g: off by %g", x[i][0], x[i][1], moment);
        }
    }
    printf("limited: largest error of alpha mean T %.2g, of alpha moment %.2g\n", worst[0], worst[1]);
}
END_TEST

/* Beyond the border at 0.05 the moment is closed form too: x^2 2^-52 of cancellation over dx^2 is left, 1e-11 for x up
 * to 20. */
START_TEST(moments_beyond_the_border)
{
    gsl_set_error_handler_off();
    srand48(3);
    for (int round = 0; round < 10; round++) {
        pieces.n = 0;
        for (int i = 0; i < LIMITER_CELLS; i++) {
            double x0 = between(-20, 20);
            add_piece(1, x0, x0 + signed_power(-1.3, 4), 0);
        }
        run(false, true);
        for (int i = 0; i < LIMITER_CELLS; i++)
            if (fabs(pieces.curvature[2 * i + 1] - pieces.curvature[2 * i]) > 0.05)
                ck_assert_double_eq_tol(pieces.moment[i],
                                        quadrature(pieces.curvature[2 * i], pieces.curvature[2 * i + 1], 0, 1), 1e-11);
    }
}
END_TEST

/* |T| and its mean stay within 1/alpha, however the curvature bulges (its first-order formula may step 2e-8 over them,
   and a rim brings 4 alpha b roundings); the moment of a T between -1/alpha and 1/alpha within 1/(4 alpha). */
START_TEST(bounded_by_one_over_alpha)
{
    srand48(4);
    for (int round = 0; round < 400; round++) {
        pieces.n = 0;
        for (int i = 0; i < LIMITER_CELLS; i++) {
            double c0 = signed_power(-2, 12), alpha = pow(10, between(-6, 3));
            double c1 = i % 4 == 0 ? c0 + signed_power(-3, 1) / alpha
                        : i % 2    ? signed_power(-2, 12)
                                   : c0 * (1 + signed_power(-16, 0));
            add_piece(alpha, c0, c1, i % 8 == 4 ? signed_power(-1, 6) / alpha : signed_power(-2, 12));
        }
        run(round % 2, true);
        for (int i = 0; i < LIMITER_CELLS; i++) {
            double alpha = pieces.alpha[2 * i], limit = (1 + 0x1p-51) / alpha;
            double wider = round % 2 ? 1 + 2e-8 + 0x1p-50 * alpha * fabs(pieces.sagitta[i]) : 1 + 0x1p-51;
            ck_assert_double_le(fabs(pieces.limited[2 * i]), limit);
            ck_assert_double_le(fabs(pieces.limited[2 * i + 1]), limit);
            ck_assert_double_le(fabs(pieces.mean[i]), wider / alpha);
            ck_assert_double_le(fabs(pieces.moment[i]), wider / alpha / 4 * (1 + 1e-6));
        }
    }
}
END_TEST

/* With alpha c below 1e-9 the limiter's relative effect, (alpha c)^2 / 3, is below a rounding: T, mean and moment are
 * the unlimited ones. */
START_TEST(small_alpha_limits_nothing)
{
    static double mean[LIMITER_CELLS], moment[LIMITER_CELLS], limited[LIMITER_POINTS];
    srand48(5);
    for (int bulges = 0; bulges < 2; bulges++) {
        pieces.n = 0;
        for (int i = 0; i < LIMITER_CELLS; i++)
            add_piece(1e-12, between(-1000, 1000), between(-1000, 1000), between(-1000, 1000));
        run(bulges, true);
        memcpy(mean, pieces.mean, sizeof mean);
        memcpy(moment, pieces.moment, sizeof moment);
        memcpy(limited, pieces.limited, sizeof limited);
        run(bulges, false);
        for (int i = 0; i < LIMITER_CELLS; i++) {
            double c0 = pieces.curvature[2 * i], c1 = pieces.curvature[2 * i + 1],
                   b = bulges ? 2.0 / 3 * pieces.sagitta[i] : 0;
            ck_assert_double_eq_tol(limited[2 * i], c0, 1e-12);
            ck_assert_double_eq_tol(mean[i], (c0 + c1) / 2 + b, 1e-12);
            ck_assert_double_eq_tol(moment[i], (c1 - c0) / 12, 1e-12);
            ck_assert_double_eq_tol(pieces.limited[2 * i + 1], c1, 1e-12);
            ck_assert_double_eq_tol(pieces.mean[i], (c0 + c1) / 2 + b, 1e-12);
            ck_assert_double_eq_tol(pieces.moment[i], (c1 - c0) / 12, 1e-12);
        }
    }
}
END_TEST

/* Swapped ends have the same mean and the opposite moment; all signs turned turn the mean. */
START_TEST(symmetries)
{
    static double mean[LIMITER_CELLS], moment[LIMITER_CELLS];
    srand48(6);
    for (int turned = 0; turned < 2; turned++) {
        pieces.n = 0;
        for (int i = 0; i < LIMITER_CELLS; i++)
            add_piece(0.03, signed_power(-3, 5), signed_power(-3, 5), signed_power(-3, 1));
        run(true, true);
        memcpy(mean, pieces.mean, sizeof mean);
        memcpy(moment, pieces.moment, sizeof moment);
        for (int i = 0; i < LIMITER_CELLS; i++) {
            double c = pieces.curvature[2 * i], sign = turned ? -1 : 1;
            pieces.curvature[2 * i] = sign * pieces.curvature[2 * i + 1];
            pieces.curvature[2 * i + 1] = sign * c;
            pieces.sagitta[i] *= sign;
        }
        run(true, true);
        for (int i = 0; i < LIMITER_CELLS; i++) {
            ck_assert_double_eq_tol(0.03 * pieces.mean[i], (turned ? -0.03 : 0.03) * mean[i], 1e-11);
            ck_assert_double_eq_tol(0.03 * pieces.moment[i], (turned ? 0.03 : -0.03) * moment[i], 1e-11);
        }
    }
}
END_TEST

/* ------------------------------------------------------------------ bulges */

/* 512 pieces of that alpha |b|, from beyond -5 to beyond 5 in x, of any chord. */
static void add_bulges(double b)
{
    pieces.n = 0;
    for (int i = 0; i < LIMITER_CELLS; i++) {
        double x0 = between(-5 - 1.2 * b, 5 + 1.2 * b), alpha = pow(10, between(-6, 3));
        add_piece(alpha, x0 / alpha, (x0 + signed_power(-4, i % 3 ? 0.5 : 2)) / alpha, (i % 2 ? b : -b) / alpha);
    }
}

/* The law of the header: second order in alpha b up to 1/64, no larger from there on, to any rim. */
START_TEST(error_of_a_bulge)
{
    gsl_set_error_handler_off();
    srand48(7);
    for (double b = 1e-6; b < 1e5; b *= sqrt(10)) {
        double worst[2] = {0, 0};
        for (int round = 0; round < 10; round++) {
            add_bulges(b);
            run(true, true);
            for (int i = 0; i < LIMITER_CELLS; i++) {
                double alpha = pieces.alpha[2 * i], x0 = alpha * pieces.curvature[2 * i],
                       x1 = alpha * pieces.curvature[2 * i + 1];
                worst[0] =
                    fmax(worst[0], fabs(alpha * pieces.mean[i] - quadrature(x0, x1, alpha * pieces.sagitta[i], 0)));
                worst[1] =
                    fmax(worst[1], fabs(alpha * pieces.moment[i] - quadrature(x0, x1, alpha * pieces.sagitta[i], 1)));
            }
        }
        double border = fmin(b, 1.0 / 64);
        printf("limited: alpha b = %.2g: alpha mean off by %.2g, alpha moment by %.2g\n", b, worst[0], worst[1]);
        ck_assert_double_lt(worst[0], 0.21 * border * border + 2e-12);
        ck_assert_double_lt(worst[1], 0.05 * border + 4e-7);
    }
}
END_TEST

/* Root mean square error of alpha mean over a stretch of 0.4 in x with a rim of 1/64, cut into equal pieces, for 512
 * places of the stretch. */
static double error_of_cut(int cuts)
{
    double square = 0;
    for (int k = 0; k < 512; k++) {
        double x0 = -2.2 + k * (4.0 / 511), x1 = x0 + 0.4, b = 1.0 / 64, mean = 0;
        pieces.n = 0;
        for (int i = 0; i < cuts; i++) {
            double q[2] = {(double)i / cuts, (double)(i + 1) / cuts}, x[2];
            for (int end = 0; end < 2; end++)
                x[end] = x0 + q[end] * (x1 - x0) + 4 * b * q[end] * (1 - q[end]);
            add_piece(1, x[0], x[1], b / (cuts * cuts));
        }
        run(true, true);
        for (int i = 0; i < cuts; i++)
            mean += pieces.mean[i] / cuts;
        square += pow(mean - quadrature(x0, x1, b, 0), 2) / 512;
    }
    return sqrt(square);
}

START_TEST(halved_pieces_are_16_times_better)
{
    gsl_set_error_handler_off();
    double one = error_of_cut(1), two = error_of_cut(2), four = error_of_cut(4);
    printf("limited: rms error of alpha mean in one piece %.3g, in two %.3g, in four %.3g\n", one, two, four);
    ck_assert_double_gt(one, 1e-5);
    ck_assert_double_eq_tol(log2(one / two), 4, 0.1);
    ck_assert_double_eq_tol(log2(two / four), 4, 0.1);
}
END_TEST

/* Whatever surrounds a piece, its bits are the same: pieces that are halved share their work with others. */
START_TEST(neighbours_do_not_matter)
{
    static double mean[LIMITER_CELLS], moment[LIMITER_CELLS];
    srand48(8);
    add_bulges(3);
    run(true, true);
    memcpy(mean, pieces.mean, sizeof mean);
    memcpy(moment, pieces.moment, sizeof moment);
    for (int i = 0; i < LIMITER_CELLS; i++) {
        double c0 = pieces.curvature[2 * i], c1 = pieces.curvature[2 * i + 1], alpha = pieces.alpha[2 * i],
               rim = pieces.sagitta[i];
        int n = pieces.n;
        pieces.n = 0;
        double first[2] = {pieces.curvature[0], pieces.curvature[1]}, first_alpha = pieces.alpha[0],
               first_bulge = pieces.sagitta[0];
        add_piece(alpha, c0, c1, rim);
        run(true, true);
        ck_assert(pieces.mean[0] == mean[i] && pieces.moment[0] == moment[i]);
        pieces.n = 0;
        add_piece(first_alpha, first[0], first[1], first_bulge);
        pieces.n = n;
    }
}
END_TEST

/* What is not finite comes back, and soon. */
START_TEST(not_finite_is_not_endless)
{
    static const double odd[] = {NAN, INFINITY, -INFINITY, 1e300};
    for (int k = 0; k < 4; k++)
        for (int l = 0; l < 3; l++) {
            pieces.n = 0;
            add_piece(1000, l == 0 ? odd[k] : 1, l == 1 ? odd[k] : -1, l == 2 ? odd[k] : 1);
            run(true, true);
        }
}
END_TEST

UNIT("limiter_cells", means_and_moments_are_integrals, moments_beyond_the_border, bounded_by_one_over_alpha,
     small_alpha_limits_nothing, symmetries, error_of_a_bulge, halved_pieces_are_16_times_better,
     neighbours_do_not_matter, not_finite_is_not_endless)
