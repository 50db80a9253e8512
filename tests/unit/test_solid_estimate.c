/* Errors that are estimated against those that closed forms tell, and modes that have no pair. */
#include "fem/solid.h"

#include "solids.h"

static struct solid_side side(const struct solids *s, const struct solid_modes *m)
{
    return (struct solid_side){&s->mesh, &s->boundary, m};
}

/* Free ball of order 2, cells two thirds as long: Lamb's 27 lowest (test_solid.c), in five groups of 5, 5, 3, 7, 7 that
   each mesh splits and turns in its own way. The estimate is within a factor of two of the error of a group's middle
   (places are quadratic: power 4), and never of the other sign. */
START_TEST(test_ball)
{
    const struct {
        double value;
        int times;
    } want[] = {{2.50113, 5}, {2.646217, 5}, {3.529987, 3}, {3.86470, 7}, {3.937401, 7}};
    struct arena *a = arena_open();
    struct elastic steel = solids_steel();
    struct solid_ask ask = {.material = &steel, .most = 40, .top = 1e6};
    struct solids s[2] = {solids_ball(6, 0.05, a), solids_ball(4, 0.05, a)};
    struct solid_modes m[2];
    for (int i = 0; i < 2; i++, ask.most = 60)
        m[i] = solids_modes(&s[i], &ask, a);
    struct solid_side fine = side(&s[0], &m[0]), coarse = side(&s[1], &m[1]);
    struct solid_estimate x;
    solid_estimate(&fine, &coarse, a, &x);
    double unit = sqrt(200e9 / 2.6 / 7850.0) / 0.05 / (2.0 * SOLIDS_PI);
    SOLIDS_NEAR(x.ratio, 1.5, 0.05);
    for (int i = 0, k = 0; i < 5; k += want[i++].times) {
        double error = 0.0, estimate = 0.0;
        for (int j = k; j < k + want[i].times; j++) {
            ck_assert_msg(x.error[j] > 0.0, "mode %d: %g", j, x.error[j]);
            error += (solids_hz(&m[0], j) / unit / want[i].value - 1.0) / want[i].times;
            estimate += x.error[j] / want[i].times;
        }
        ck_assert_msg(estimate > 0.5 * error && estimate < 2.0 * error, "group %d: %g, not %g", i, estimate, error);
    }
    arena_close(a);
}
END_TEST

static struct solids plate(int n, struct solid_fixed fixed[4], struct arena *a)
{
    struct solids s = solids_box((const int[]){n, n, 1}, (const double[]){0.5, 0.4, 0.02}, a);
    for (int i = 0; i < 4; i++)
        fixed[i] = solids_hold(&s, SOLID_SUPPORTED, i / 2, i % 2 ? i / 2 ? 0.4 : 0.5 : 0.0, a);
    return s;
}

/* Supported plate of order 2 against Mindlin's closed form (test_solid.c: to first order in thickness), 5 modes that
   are 0.5 to 2 % stiff: between 0.4 times and twice. It is too small, as the one cell through the plate, which both
   meshes have, is part of the error. */
START_TEST(test_plate)
{
    const int order[5][2] = {{1, 1}, {2, 1}, {1, 2}, {2, 2}, {3, 1}};
    struct arena *a = arena_open();
    struct elastic steel = solids_steel();
    struct solid_fixed fixed[4];
    struct solid_ask ask = {.material = &steel, .fixed = fixed, .n_fixed = 4, .most = 6, .top = 20000.0};
    struct solids s[2];
    struct solid_modes m[2];
    struct solid_estimate x;
    for (int i = 0; i < 2; i++, ask.most = 12) {
        s[i] = plate(i ? 8 : 12, fixed, a);
        m[i] = solids_modes(&s[i], &ask, a);
    }
    struct solid_side fine = side(&s[0], &m[0]), coarse = side(&s[1], &m[1]);
    solid_estimate(&fine, &coarse, a, &x);
    double h = 0.02, d = 200e9 * h * h * h / (12.0 * 0.91), g = 200e9 / 2.6;
    ck_assert_int_eq(x.unpaired, 0);
    ck_assert(x.median > 0.0 && x.median <= x.most && fabs(x.error[x.worst]) == x.most);
    for (int i = 0; i < 5; i++) {
        double p = order[i][0] * SOLIDS_PI / 0.5, q = order[i][1] * SOLIDS_PI / 0.4, q2 = p * p + q * q;
        double w2 = d / (7850.0 * h) * q2 * q2 / (1.0 + q2 * (h * h / 12.0 + d / (5.0 / 6.0 * g * h))),
               error = solids_hz(&m[0], i) * 2.0 * SOLIDS_PI / sqrt(w2) - 1.0;
        ck_assert_msg(x.error[i] > 0.4 * error && x.error[i] < 2.0 * error, "mode %d: %g, not %g", i, x.error[i],
                      error);
    }
    arena_close(a);
}
END_TEST

/* The same mesh twice: nothing differs, and nothing is extrapolated. Only the two lowest modes for pairs: the others
 * have none, as they are orthogonal. */
START_TEST(test_pairs)
{
    struct arena *a = arena_open();
    struct elastic steel = solids_steel();
    struct solid_fixed fixed[4];
    struct solids s = plate(6, fixed, a);
    struct solid_ask ask = {.material = &steel, .fixed = fixed, .n_fixed = 4, .most = 6, .top = 20000.0};
    struct solid_modes m = solids_modes(&s, &ask, a), few = m;
    struct solid_side fine = side(&s, &m), coarse = side(&s, &few);
    struct solid_estimate x;
    solid_estimate(&fine, &coarse, a, &x);
    ck_assert(x.unpaired == 0 && x.share == 1.0 && x.ratio == 1.0 && x.most < 1e-12);
    few.n = 2;
    solid_estimate(&fine, &coarse, a, &x);
    ck_assert_int_eq(x.unpaired, 4);
    for (int i = 0; i < 6; i++)
        ck_assert(isnan(x.error[i]) == (i >= 2));
    few.lambda = ARENA_TAKE(a, double, 2);
    few.shape = m.shape + 2 * 3 * m.nodes;
    fine.modes = &few, coarse.modes = &m; /* the third and the fourth, at no frequency at all */
    few.lambda[0] = few.lambda[1] = m.lambda[0];
    solid_estimate(&fine, &coarse, a, &x);
    SOLIDS_NEAR(x.error[0], sqrt(m.lambda[2] / m.lambda[0]) - 1.0, 1e-6);
    arena_close(a);
}
END_TEST

UNIT("solid_estimate", UNIT_LONG(test_ball), test_plate, test_pairs)
