/* What pieces do to a slope: loops over many against the closed forms of one. */
#include "force/slope_terms.h"

#include "force/crossing.h"
#include "unit.h"

enum { MANY = LIMITED_PIECES };

static struct slope_terms terms;
static struct way_pieces pieces;

static double between(double lo, double hi) { return lo + (hi - lo) * drand48(); }

/* Parabolas with no zero, one, or two, and zeros at their ends: the bits of the plain form. */
START_TEST(crossings_as_plain)
{
    srand48(1);
    for (int i = 0; i < MANY; i++) {
        terms.start[i] = i % 7 ? between(-1, 1) : 0;
        terms.end[i] = i % 5 ? between(-1, 1) : i % 3 ? terms.start[i] : 0;
        terms.mean[i] = i % 4 ? between(-1, 1) : 0.5 * (terms.start[i] + terms.end[i]);
    }
    slope_terms_crossing(&terms, MANY);
    for (int i = 0; i < MANY; i++) {
        struct crossing c = crossing_slope(terms.start[i], terms.end[i], terms.mean[i]);
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
    pieces.n = MANY;
    for (int i = 0; i < MANY; i++) {
        pieces.at[i] = i;
        pieces.length[i] = leak * pow(10, between(-9, log10(1.0 / 16)));
        pieces.mean[0][i] = pieces.limited[0][i] = pieces.limited[0][i + 1] = 40;
        pieces.moment[0][i] = 0;
    }
    slope_terms(&terms, &pieces, 1, leak);
    for (int i = 0; i < MANY; i++)
        terms.start[i] = slope;
    slope_terms_mean(&terms, MANY);
    for (int i = 0; i < MANY; i++) {
        double z = pieces.length[i] / leak, gone = -expm1(-z), end = slope + gone * (40 * leak - slope);
        ck_assert_double_eq_tol(slope_terms_end(&terms, 0, i, slope), end, 1e-16);
        ck_assert_double_eq_tol(terms.mean[i], 40 * leak + (slope - 40 * leak) * gone / z, 1e-15);
    }
}
END_TEST

UNIT("slope_terms", crossings_as_plain, constant_curvature)
