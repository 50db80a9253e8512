/* height_map_spline: coefficients against the interpolation equations, all six values against a slow direct sum of B-spline
   polynomials and against finite differences, continuity across cells and seams, orientation, orders of convergence. */
#include "surface/height_map.h"

#include "samples.h"

enum { COLUMNS = 23, ROWS = 17 };

static const double pitch[2] = {3e-6, 5e-6}, origin[2] = {-2e-5, 1e-5};
static double z[ROWS][COLUMNS];

struct six {
    double v[6]; /* z, x, y, xx, xy, yy */
};

static const int orders[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};

static void random_heights(long seed)
{
    srand48(seed);
    for (int j = 0; j < ROWS; j++)
        for (int i = 0; i < COLUMNS; i++)
            z[j][i] = samples_random();
}

static struct relief_part *made(struct arena *a, int off_map)
{
    return height_map_part(
        a, height_map_spline(a, &(struct height_map){&z[0][0], COLUMNS, ROWS, {pitch[0], pitch[1]}}, off_map), origin,
        "map");
}

static struct six read_at(struct relief_part *part, double x, double y)
{
    struct six s = {{0}};
    part->add(part, &(struct relief_points){1, &x, &y},
              &(struct relief_values){&s.v[0], &s.v[1], &s.v[2], &s.v[3], &s.v[4], &s.v[5]});
    return s;
}

/* Size of a value: 1 um over the pitch to the power of its derivatives. */
static double size_of(int k) { return 1e-6 / (pow(pitch[0], orders[k][0]) * pow(pitch[1], orders[k][1])); }

/* ------------------------------------------------------------------ the judge: coefficients by relaxation, sums of
 * polynomials */

/* Solves (c[i-1] + 4 c[i] + c[i+1]) / 6 = right[i] along one row or column by Gauss-Seidel: each sweep at least halves
 * the error. */
static void relax(const double *right, double *c, long n, long stride, int off_map)
{
    for (int sweep = 0; sweep < 200; sweep++)
        for (long i = 0; i < n; i++)
            c[i * stride] = (6 * right[i * stride] - c[samples_walked(n, off_map, i - 1) * stride] -
                             c[samples_walked(n, off_map, i + 1) * stride]) /
                            4;
}

static void solve(int off_map, double c[ROWS][COLUMNS])
{
    static double half[ROWS][COLUMNS];
    memset(half, 0, sizeof half);
    memset(c, 0, sizeof half);
    for (long i = 0; i < COLUMNS; i++)
        relax(&z[0][i], &half[0][i], ROWS, COLUMNS, off_map);
    for (long j = 0; j < ROWS; j++)
        relax(half[j], c[j], COLUMNS, 1, off_map);
}

static double sum_at(double c[ROWS][COLUMNS], int off_map, double x, double y, int k)
{
    double qx = (x - origin[0]) / pitch[0], qy = (y - origin[1]) / pitch[1], sum = 0;
    for (long j = (long)floor(qy) - 3; j <= (long)floor(qy) + 4; j++)
        for (long i = (long)floor(qx) - 3; i <= (long)floor(qx) + 4; i++)
            sum += c[samples_walked(ROWS, off_map, j)][samples_walked(COLUMNS, off_map, i)] *
                   samples_b_spline(qx - (double)i, orders[k][0]) * samples_b_spline(qy - (double)j, orders[k][1]);
    return sum / (pow(pitch[0], orders[k][0]) * pow(pitch[1], orders[k][1]));
}

/* ------------------------------------------------------------------ */

/* All six, anywhere, up to ten periods outside; places are held to 1e-16 m, 1e-11 of a pitch. */
START_TEST(values_are_sums_of_splines)
{
    static double c[ROWS][COLUMNS];
    for (int off_map = OFF_MAP_MIRROR; off_map <= OFF_MAP_ERROR; off_map++) {
        struct arena *a = arena_open();
        random_heights(1 + off_map);
        solve(off_map, c);
        struct relief_part *part = made(a, off_map);
        for (int n = 0; n < 2000; n++) {
            double far = n % 4 == 0 ? 10 : 1;
            double x = origin[0] + far * (2 * drand48() - 0.7) * COLUMNS * pitch[0],
                   y = origin[1] + far * (2 * drand48() - 0.7) * ROWS * pitch[1];
            struct six got = read_at(part, x, y);
            for (int k = 0; k < 6; k++)
                ck_assert_double_eq_tol(got.v[k] / size_of(k), sum_at(c, off_map, x, y, k) / size_of(k), 1e-9);
        }
        ck_assert(part->pitch[0] == pitch[0] && part->pitch[1] == pitch[1] && part->origin[0] == origin[0] &&
                  part->origin[1] == origin[1]);
        ck_assert(part->finest == 3e-6 && !part->linear && part->from[0] == origin[0] && part->from[1] == origin[1]);
        ck_assert_double_eq_tol(part->to[0], origin[0] + 22 * pitch[0], 1e-18);
        ck_assert_double_eq_tol(part->to[1], origin[1] + 16 * pitch[1], 1e-18);
        arena_close(a);
    }
}
END_TEST

/* At the samples the height is the sample: row j at y = origin + j pitch, column i at x. */
START_TEST(samples_are_met)
{
    for (int off_map = OFF_MAP_MIRROR; off_map <= OFF_MAP_ERROR; off_map++) {
        struct arena *a = arena_open();
        random_heights(5);
        struct relief_part *part = made(a, off_map);
        for (long j = -2 * ROWS; j < 3 * ROWS; j++)
            for (long i = -2 * COLUMNS; i < 3 * COLUMNS; i++) {
                double got = read_at(part, origin[0] + (double)i * pitch[0], origin[1] + (double)j * pitch[1]).v[0];
                ck_assert_double_eq_tol(got, z[samples_walked(ROWS, off_map, j)][samples_walked(COLUMNS, off_map, i)],
                                        1e-13 * 1e-6);
            }
        arena_close(a);
    }
}
END_TEST

/* A map of one direction is a profile: along x where rows are equal, along y where columns are. (An exchange of axes
 * would show.) */
START_TEST(single_directions)
{
    for (int axis = 0; axis < 2; axis++) {
        struct arena *a = arena_open();
        for (int j = 0; j < ROWS; j++)
            for (int i = 0; i < COLUMNS; i++)
                z[j][i] = 1e-6 * ((axis ? j : i) == 9);
        struct relief_part *part = made(a, OFF_MAP_MIRROR);
        for (int n = 0; n < 200; n++) {
            double place[2] = {origin[0] + drand48() * 22 * pitch[0], origin[1] + drand48() * 16 * pitch[1]};
            struct six s = read_at(part, place[0], place[1]);
            double along = s.v[axis ? 5 : 3], across = s.v[axis ? 3 : 5];
            ck_assert_double_eq_tol(across / size_of(axis ? 3 : 5), 0, 1e-11);
            ck_assert_double_eq_tol(s.v[4] / size_of(4), 0, 1e-11);
            if (fabs(place[axis] - origin[axis] - 9 * pitch[axis]) < 0.1 * pitch[axis])
                ck_assert(s.v[0] > 0.9e-6 && along * pitch[axis] * pitch[axis] < -2e-6);
        }
        arena_close(a);
    }
}
END_TEST

/* First and second derivatives are those of the heights: central differences over 1e-3 pitch (1e-6 / 6 of the third
   derivative, at most 40 in units of size_of, and 1e-6 of rounding in the second). */
START_TEST(derivatives_are_differences)
{
    struct arena *a = arena_open();
    random_heights(6);
    struct relief_part *part = made(a, OFF_MAP_WRAP);
    for (int n = 0; n < 500; n++) {
        double d[2] = {1e-3 * pitch[0], 1e-3 * pitch[1]}, cell[2] = {floor(30 * drand48()), floor(30 * drand48())};
        double x = origin[0] + (cell[0] + 0.1 + 0.8 * drand48()) * pitch[0],
               y = origin[1] + (cell[1] + 0.1 + 0.8 * drand48()) * pitch[1];
        struct six s = read_at(part, x, y), e = read_at(part, x + d[0], y), w = read_at(part, x - d[0], y),
                   o = read_at(part, x, y + d[1]), u = read_at(part, x, y - d[1]);
        double want[6] = {s.v[0],
                          (e.v[0] - w.v[0]) / (2 * d[0]),
                          (o.v[0] - u.v[0]) / (2 * d[1]),
                          (e.v[1] - w.v[1]) / (2 * d[0]),
                          (o.v[1] - u.v[1]) / (2 * d[1]),
                          (o.v[2] - u.v[2]) / (2 * d[1])};
        for (int k = 1; k < 6; k++)
            ck_assert_double_eq_tol(s.v[k] / size_of(k), want[k] / size_of(k), 2e-5);
    }
    arena_close(a);
}
END_TEST

/* Up to second derivatives nothing jumps, anywhere a line of knots is crossed: inside, at the last sample and at the
 * seam behind it. */
START_TEST(continuous_to_the_second_derivative)
{
    for (int off_map = OFF_MAP_MIRROR; off_map <= OFF_MAP_ERROR; off_map++) {
        struct arena *a = arena_open();
        random_heights(7);
        struct relief_part *part = made(a, off_map);
        for (int axis = 0; axis < 2; axis++)
            for (long i = -30; i < 60; i++) {
                double low[2] = {origin[0] + 7.3 * pitch[0], origin[1] + 5.8 * pitch[1]}, high[2] = {low[0], low[1]};
                low[axis] = origin[axis] + ((double)i - 1e-8) * pitch[axis];
                high[axis] = origin[axis] + ((double)i + 1e-8) * pitch[axis];
                struct six s = read_at(part, low[0], low[1]), t = read_at(part, high[0], high[1]);
                for (int k = 0; k < 6; k++)
                    ck_assert_double_eq_tol(s.v[k] / size_of(k), t.v[k] / size_of(k), 1e-6);
            }
        arena_close(a);
    }
}
END_TEST

/* Mirror: even about the first and the last sample of each axis; wrap: periodic. */
START_TEST(symmetries_of_the_continuation)
{
    for (int off_map = OFF_MAP_MIRROR; off_map <= OFF_MAP_WRAP; off_map++) {
        struct arena *a = arena_open();
        random_heights(8);
        struct relief_part *part = made(a, off_map);
        double period[2] = {COLUMNS * pitch[0], ROWS * pitch[1]}, end[2] = {22 * pitch[0], 16 * pitch[1]};
        for (int n = 0; n < 400; n++) {
            int axis = n % 2;
            double here[2] = {origin[0] + end[0] * drand48(), origin[1] + end[1] * drand48()},
                   there[2] = {here[0], here[1]};
            there[axis] = off_map == OFF_MAP_WRAP ? here[axis] + period[axis] * (double)(n % 7 - 3)
                                                  : 2 * (origin[axis] + (n % 4 < 2 ? 0 : end[axis])) - here[axis];
            struct six s = read_at(part, here[0], here[1]), t = read_at(part, there[0], there[1]);
            for (int k = 0; k < 6; k++) {
                double sign = off_map == OFF_MAP_MIRROR && orders[k][axis] == 1 ? -1 : 1;
                ck_assert_double_eq_tol(t.v[k] / size_of(k), sign * s.v[k] / size_of(k), 1e-9);
            }
        }
        arena_close(a);
    }
}
END_TEST

/* Largest errors of cos(2 pi (x + y)), n x n samples a period, relative to each value's own largest. */
static struct six errors_of(int n)
{
    struct arena *a = arena_open();
    double *wave = ARENA_TAKE(a, double, n *n), k = 2 * M_PI;
    struct six worst = {{0}};
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            wave[j * n + i] = cos(k * (i + j) / n);
    struct relief_part *part = height_map_part(
        a, height_map_spline(a, &(struct height_map){wave, (size_t)n, (size_t)n, {1.0 / n, 1.0 / n}}, OFF_MAP_WRAP),
        (double[]){0, 0}, "wave");
    for (int i = 0; i < 3000; i++) {
        double x = drand48(), y = drand48(), c = cos(k * (x + y)), s = -k * sin(k * (x + y)), cc = -k * k * c,
               want[6] = {c, s, s, cc, cc, cc};
        struct six got = read_at(part, x, y);
        for (int v = 0; v < 6; v++)
            worst.v[v] = fmax(worst.v[v], fabs(got.v[v] - want[v]) / pow(k, orders[v][0] + orders[v][1]));
    }
    arena_close(a);
    return worst;
}

/* Order 4 for heights, 2 for z_xx and z_yy, whose leading error is w^2/12, w = 2 pi / n; 3 for slopes and z_xy. */
START_TEST(orders_of_convergence)
{
    static const double order[6] = {4, 3, 3, 2, 3, 2};
    srand48(9);
    for (int n = 16; n <= 64; n *= 2) {
        struct six coarse = errors_of(n), fine = errors_of(2 * n);
        double w = 2 * M_PI / n;
        for (int v = 0; v < 6; v++)
            ck_assert_double_eq_tol(log2(coarse.v[v] / fine.v[v]), order[v], 0.15);
        for (int v = 3; v < 6; v += 2)
            ck_assert_double_eq_tol(coarse.v[v] / (w * w / 12), 1, 0.1);
    }
    struct six fine = errors_of(200);
    printf("map: 200 samples a wave: z off by %.2g, z_xx by %.2g\n", fine.v[0], fine.v[3]);
    ck_assert_double_lt(fine.v[3], 1e-4);
}
END_TEST

UNIT("height_map_spline", values_are_sums_of_splines, samples_are_met, single_directions, derivatives_are_differences,
     continuous_to_the_second_derivative, symmetries_of_the_continuation, orders_of_convergence)
