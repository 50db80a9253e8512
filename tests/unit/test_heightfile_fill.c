/* heightfile_fill: against harmonic polynomials, which the five-point equation solves exactly (its error is a fourth
   derivative, and they have none that do not cancel), and against the equation itself where there is no closed form. */
#include "file/heightfile.h"

#include "heights.h"

enum { W = 61, H = 43 };

static double z[W * H], want[W * H];

static struct heightfile map(double pitch_x, double pitch_y)
{
    return (struct heightfile){.columns = W, .rows = H, .pitch_x = pitch_x, .pitch_y = pitch_y, .z = z};
}

static void count(struct heightfile *m)
{
    m->holes = 0;
    for (size_t i = 0; i < m->columns * m->rows; i++)
        m->holes += isnan(m->z[i]);
}

static double harmonic(int kind, double x, double y)
{
    switch (kind) {
    case 0:
        return 3e-6 + 0.01 * x - 0.02 * y;
    case 1:
        return 5 * x * y;
    case 2:
        return 40 * (x * x - y * y);
    default:
        return 3e4 * (x * x * x - 3 * x * y * y);
    }
}

/* A disc, a comb and single points, none at the edge. */
static bool hole(int i, int j)
{
    return (i - 30) * (i - 30) + (j - 20) * (j - 20) < 150 || (j > 5 && j < 38 && (i == 5 || i == 6)) ||
           (i * 7 + j * 13) % 11 == 0;
}

/* Solved to 1e-12 of the range in residual; a residual r raises the solution by at most r n^2/8 across a hole of n
 * samples. */
START_TEST(harmonic_polynomials)
{
    static const double pitch[][2] = {{1e-5, 1e-5}, {1e-5, 3e-5}, {4e-5, 1e-5}};
    for (int kind = 0; kind < 4; kind++)
        for (int p = 0; p < 3; p++) {
            struct heightfile m = map(pitch[p][0], pitch[p][1]);
            double low = HUGE_VAL, high = -HUGE_VAL;
            for (int k = 0; k < W * H; k++) {
                int i = k % W, j = k / W;
                want[k] = harmonic(kind, (i - 20) * pitch[p][0], (j - 20) * pitch[p][1]);
                z[k] = i > 0 && j > 0 && i < W - 1 && j < H - 1 && hole(i, j) ? NAN : want[k];
                low = fmin(low, want[k]);
                high = fmax(high, want[k]);
            }
            count(&m);
            size_t holes = m.holes;
            e = (struct err){0};
            ck_assert_msg(heightfile_fill("m", &m, &e), "%s", e.text);
            ck_assert(holes > 500 && m.holes == 0 && m.filled == holes);
            for (int k = 0; k < W * H; k++)
                ck_assert_msg(fabs(z[k] - want[k]) <= 1e-10 * (high - low), "kind %d, %d: %g, not %g", kind, k, z[k],
                              want[k]);
        }
}
END_TEST

/* Holes that reach the edge, on rough ground: the mean of the neighbours that are there. */
START_TEST(the_equation_at_the_edge)
{
    struct heightfile m = map(1e-5, 1e-5);
    uint32_t state = 1;
    bool missing[W * H];
    for (int k = 0; k < W * H; k++) {
        state = state * 1664525 + 1013904223;
        missing[k] = k % W < 9 || k / W > 40 || hole(k % W, k / W);
        z[k] = missing[k] ? NAN : 1e-6 * (double)(state >> 8) / 16777216;
    }
    count(&m);
    e = (struct err){0};
    ck_assert_msg(heightfile_fill("m", &m, &e), "%s", e.text);
    for (int k = 0; k < W * H; k++) {
        int i = k % W, j = k / W, n = 0;
        double sum = 0;
        if (i > 0) sum += z[k - 1], n++;
        if (i < W - 1) sum += z[k + 1], n++;
        if (j > 0) sum += z[k - W], n++;
        if (j < H - 1) sum += z[k + W], n++;
        ck_assert(!missing[k] || fabs(z[k] - sum / n) <= 2e-18); /* 1e-12 of a range of 1 um, twice for rounding */
    }
}
END_TEST

START_TEST(profiles)
{
    double p[] = {NAN, NAN, 2, 3, NAN, NAN, NAN, 7, 6, NAN};
    const double filled[] = {2, 2, 2, 3, 4, 5, 6, 7, 6, 6};
    struct heightfile m = {.columns = 10, .rows = 1, .pitch_x = 1, .pitch_y = NAN, .z = p};
    for (int k = 0; k < 2; k++) {
        count(&m);
        if (k == 0) { /* 6 of 10 */
            e = (struct err){0};
            ck_assert(!heightfile_fill("m", &m, &e) && e.kind == ERR_SCENE &&
                      strstr(e.text, "6 of 10 points are missing"));
            p[0] = 2;
        }
    }
    count(&m);
    e = (struct err){0};
    ck_assert(heightfile_fill("m", &m, &e));
    for (int i = 0; i < 10; i++)
        ck_assert_double_eq_tol(p[i], filled[i], 1e-15);
    ck_assert(heightfile_fill("m", &m, &e) && m.filled == 5); /* none left: nothing happens */
}
END_TEST

/* The same bits twice, and a constant map stays one. */
START_TEST(repeats)
{
    static double first[W * H];
    for (int run = 0; run < 2; run++) {
        struct heightfile m = map(1e-5, 2e-5);
        for (int k = 0; k < W * H; k++)
            z[k] = hole(k % W, k / W) ? NAN : 1e-6 * ((k * 7919) % 1000);
        count(&m);
        e = (struct err){0};
        ck_assert(heightfile_fill("m", &m, &e));
        if (run == 0)
            memcpy(first, z, sizeof z);
        else
            ck_assert_mem_eq(first, z, sizeof z);
    }
    struct heightfile m = map(1e-5, 1e-5);
    for (int k = 0; k < W * H; k++)
        z[k] = hole(k % W, k / W) ? NAN : 7e-6;
    count(&m);
    ck_assert(heightfile_fill("m", &m, &e));
    for (int k = 0; k < W * H; k++)
        ck_assert_double_eq_tol(z[k], 7e-6, 1e-20);
}
END_TEST

UNIT("heightfile_fill", harmonic_polynomials, the_equation_at_the_edge, profiles, repeats)
