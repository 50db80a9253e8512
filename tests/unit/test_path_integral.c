/* What cells do to a slope: loops over many against the closed forms of one. Lift-off: the share that presses, and a
   force's parts over it against sums over many small steps. */
#include "force/path_integral.h"

#include "unit.h"

enum { MANY = LIMITER_CELLS };

static struct path_terms terms;
static struct cells cells;

static double between(double lo, double hi) { return lo + (hi - lo) * drand48(); }

/* Of |S'| over a cell on which S' goes from a to b, with that mean: of the parabola a (1 - q) + b q + bow q (1 - q),
   which has one zero between ends of opposite signs. */
static struct magnitude crossing_slope(double a, double b, double mean)
{
    double bow = 6 * (mean - 0.5 * (a + b)), p = b - a + bow, root = sqrt(fmax(p * p + 4 * bow * a, 0));
    double s = p < 0 ? p - root : p + root, q = s != 0 ? -2 * a / s : 0, late = 0.5 * mean + (b - a) * (1.0 / 12);
    if (a * b >= 0) return (struct magnitude){fabs(mean), mean < 0 ? -late : late};
    if (!(q >= 0 && q <= 1)) q = s / (2 * bow);
    double before = q * (a + q * (0.5 * p - q * bow * (1.0 / 3))),
           lately = q * q * (0.5 * a + q * (p * (1.0 / 3) - 0.25 * q * bow));
    return (struct magnitude){fabs(before) + fabs(mean - before), fabs(lately) + fabs(late - lately)};
}

/* Parabolas with no zero, one, or two, and zeros at their ends: the bits of the plain form. */
START_TEST(crossings_as_plain)
{
    srand48(1);
    for (int i = 0; i < MANY; i++) {
        terms.start[i] = i % 7 ? between(-1, 1) : 0;
        terms.end[i] = i % 5 ? between(-1, 1) : i % 3 ? terms.start[i] : 0;
        terms.mean[i] = i % 4 ? between(-1, 1) : 0.5 * (terms.start[i] + terms.end[i]);
    }
    path_integral_magnitude(&terms, MANY);
    for (int i = 0; i < MANY; i++) {
        struct magnitude c = crossing_slope(terms.start[i], terms.end[i], terms.mean[i]);
        ck_assert_msg(terms.whole[i] == c.whole && terms.late[i] == c.late, "%d: %.17g %.17g, not %.17g %.17g", i,
                      terms.whole[i], terms.late[i], c.whole, c.late);
    }
}
END_TEST

/* Where T does not vary, slope and mean slope are those of dS'/ds + S'/l = T: to rounding. */
START_TEST(constant_curvature)
{
    double leak = 2e-3, slope = 0.3;
    srand48(2);
    cells.n = MANY;
    for (int i = 0; i < MANY; i++) {
        cells.at[i] = i;
        cells.length[i] = leak * pow(10, between(-9, log10(1.0 / 16)));
        cells.mean[0][i] = cells.limited[0][i] = cells.limited[0][i + 1] = 40;
        cells.moment[0][i] = 0;
    }
    path_integral_terms(&terms, &cells, 1, leak);
    for (int i = 0; i < MANY; i++)
        terms.start[i] = slope;
    path_integral_mean(&terms, MANY);
    for (int i = 0; i < MANY; i++) {
        double z = cells.length[i] / leak, gone = -expm1(-z), end = slope + gone * (40 * leak - slope);
        ck_assert_double_eq_tol(path_terms_end(&terms, 0, i, slope), end, 1e-16);
        ck_assert_double_eq_tol(terms.mean[i], 40 * leak + (slope - 40 * leak) * gone / z, 1e-15);
    }
}
END_TEST

/* ------------------------------------------------------------------ lift-off */

START_TEST(the_share_that_presses)
{
    ck_assert(path_integral_pressed(1, 3) == 1 && path_integral_pressed(0, 0) == 1 &&
              path_integral_pressed(-1, -3) == 0);
    ck_assert_double_eq_tol(path_integral_pressed(1, -3), 0.25, 1e-15);
    ck_assert_double_eq_tol(path_integral_pressed(-3, 1), 0.25, 1e-15);
}
END_TEST

/* A straight line is cut exactly: midpoint sums of 1e5 steps, of which one may lie across the cut, are off by 1e-5. */
START_TEST(parts_of_a_straight_line)
{
    static const double loads[][2] = {{1, -3}, {-3, 1}, {2, -1}, {-1, 1e-3}, {-1, -2}, {1, 2}};
    for (int k = 0; k < 6; k++) {
        double a = loads[k][0], b = loads[k][1], early = 0.5 * 3 - 7 / 6.0, late = 0.5 * 3 - 7 / 3.0, sums[2] = {0};
        for (int i = 0; i < 100000; i++) {
            double q = (i + 0.5) / 1e5, f = a + (b - a) * q > 0 ? 3 - 7 * q : 0;
            sums[0] += (1 - q) * f / 1e5;
            sums[1] += q * f / 1e5;
        }
        path_integral_cut(a, b, &early, &late);
        ck_assert_double_eq_tol(early, sums[0], 5e-5);
        ck_assert_double_eq_tol(late, sums[1], 5e-5);
    }
}
END_TEST

/* A force exp(sin t) under N = sin(t - 0.3), whose B-splines' parts are known: with half the step what is left of the
 * impulse about each zero falls by 2^2 at least, over 200 steps' places. */
START_TEST(of_second_order)
{
    double off[2] = {0};
    for (int k = 0; k < 2; k++)
        for (int place = 0; place < 200; place++) {
            double dt = 0.1 / (1 + k), from = 0.3 - dt * (place + 0.5) / 200, early = 0, late = 0, want = 0;
            for (int i = 0; i < 2000; i++) {
                double q = (i + 0.5) / 2000, t = from + q * dt, f = exp(sin(t));
                early += (1 - q) * f / 2000, late += q * f / 2000;
                want += t > 0.3 ? f / 2000 : 0;
            }
            path_integral_cut(sin(from - 0.3), sin(from + dt - 0.3), &early, &late);
            off[k] += fabs(early + late - want) * dt / 200;
        }
    printf("%g, %g\n", off[0], off[1]);
    ck_assert_double_gt(off[0] / off[1], 3);
}
END_TEST

UNIT("path_integral", crossings_as_plain, constant_curvature, the_share_that_presses, parts_of_a_straight_line,
     of_second_order)
