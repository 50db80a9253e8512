/* The quadratic tetrahedron: its mass in closed form, curved ones against a rule of 9^3 points, rigid motions, constant
 * strain, rotation. */
#include "fem/solid_element.h"

#include "num/noise.h"
#include "num/special.h"
#include "solids.h"

static const int ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

/* A tetrahedron of no symmetry; bend: how far midsides are from the middle, m. */
static void make(double bend, double at[10][3])
{
    const double corner[4][3] = {{0.1, 0.2, -0.1}, {1.2, 0.1, 0.3}, {0.3, 0.9, 0.1}, {0.2, 0.4, 1.1}};
    struct noise s = noise_make(1, "element");
    memcpy(at, corner, sizeof corner);
    for (int i = 0; i < 18; i++)
        at[4 + i / 3][i % 3] = 0.5 * (corner[ends[i / 3][0]][i % 3] + corner[ends[i / 3][1]][i % 3]) +
                               bend * (2.0 * noise_uniform(s, 0, (uint64_t)i) - 1.0);
}

static const struct solid_lattice *quadratic_lattice(void)
{
    static struct solid_lattice t;
    t = solid_element_lattice(2);
    return &t;
}

static struct solid_element element(double at[10][3], const struct elastic *s)
{
    struct solid_element x;
    ck_assert(solid_element_make((const double(*)[3])at, quadratic_lattice(), s, &x));
    return x;
}

/* Spruce, its axes turned out of all planes by turning the element instead. */
static struct elastic spruce(void)
{
    struct elastic s;
    struct err e = {0};
    ck_assert(solid_element_orthotropic(
        &(struct elastic_wood){{11e9, 0.5e9, 0.9e9}, {0.04e9, 0.75e9, 0.72e9}, {0.25, 0.37, 0.47}, 420.0}, &s, &e));
    return s;
}

static double six_volumes(double at[10][3])
{
    double d[3][3];
    for (int i = 0; i < 9; i++)
        d[i / 3][i % 3] = at[1 + i / 3][i % 3] - at[0][i % 3];
    return d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) - d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
           d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
}

/* Entries over density V/420, from integral L0^a L1^b L2^c L3^d = 6 V a! b! c! d!/(a + b + c + d + 3)!: corners 6 and
   1; corner and midside -4 if on its edge, else -6; midsides 32, 16 if their edges meet, else 8. */
START_TEST(test_mass)
{
    double at[10][3];
    make(0.0, at);
    struct elastic steel = solids_steel();
    struct solid_element x = element(at, &steel);
    double unit = 7850.0 * six_volumes(at) / 6.0 / 420.0;
    SOLIDS_NEAR(x.volume, six_volumes(at) / 6.0, 1e-14);
    for (int i = 0; i < 10; i++)
        for (int j = 0; j <= i; j++) {
            const int *p = i > 3 ? ends[i - 4] : NULL, *q = j > 3 ? ends[j - 4] : NULL;
            int shared = p && q ? (p[0] == q[0]) + (p[0] == q[1]) + (p[1] == q[0]) + (p[1] == q[1])
                         : p    ? p[0] == j || p[1] == j
                                : 0;
            double want = p && q ? (shared == 2 ? 32 : shared == 1 ? 16 : 8) : p ? (shared ? -4 : -6) : i == j ? 6 : 1;
            SOLIDS_NEAR(x.m[i][j], want * unit, 1e-12);
            ck_assert(x.m[i][j] == x.m[j][i]);
        }
}
END_TEST

/* Mass and volume of a curved one: determinant by differences of places, which are exact (to rounding) for quadratics.
 */
static double determinant(double at[10][3], const double l[3])
{
    double j[10][3] = {{0}};
    for (int k = 0; k < 3; k++)
        for (int side = -1; side < 2; side += 2) {
            double near[3] = {l[0], l[1], l[2]}, value[10], slope[10][3];
            near[k] += 0.25 * side;
            solid_element_shapes(near, value, slope);
            for (int a = 0; a < 10; a++)
                for (int c = 0; c < 3; c++)
                    j[1 + k][c] += 2.0 * side * value[a] * at[a][c];
        }
    return six_volumes(j);
}

START_TEST(test_curved_mass)
{
    double at[10][3], g[9], w[9], volume = 0.0, mass[10][10] = {{0}};
    make(0.05, at);
    struct elastic steel = solids_steel();
    struct solid_element x = element(at, &steel);
    special_gauss_legendre(9, g, w);
    for (int p = 0; p < 729; p++) {
        double r = 0.5 + 0.5 * g[p % 9], s = 0.5 + 0.5 * g[p / 9 % 9], t = 0.5 + 0.5 * g[p / 81], value[10],
               slope[10][3];
        const double l[3] = {r, s * (1 - r), t * (1 - r) * (1 - s)};
        double weight = w[p % 9] * w[p / 9 % 9] * w[p / 81] / 8 * (1 - r) * (1 - r) * (1 - s) * determinant(at, l);
        solid_element_shapes(l, value, slope);
        volume += weight;
        for (int i = 0; i < 100; i++)
            mass[i / 10][i % 10] += 7850.0 * weight * value[i / 10] * value[i % 10];
    }
    SOLIDS_NEAR(x.volume, volume, 1e-13);
    for (int i = 0; i < 100; i++) /* entries are sums of terms up to 30 times as large */
        ck_assert(fabs(x.m[i / 10][i % 10] - mass[i / 10][i % 10]) < 1e-13 * mass[9][9]);
}
END_TEST

/* Energy u^T K u of the displacement u = a x (a matrix) is volume times strain . C strain: the constant strain a, with
 * none for a rotation. */
static void expect_energy(double bend, const struct elastic *s, const double a[3][3])
{
    double at[10][3], u[30], want = 0.0, is = 0.0, size = 0.0;
    make(bend, at);
    struct solid_element x = element(at, s);
    const double strain[6] = {a[0][0], a[1][1], a[2][2], a[1][2] + a[2][1], a[2][0] + a[0][2], a[0][1] + a[1][0]};
    for (int i = 0; i < 30; i++)
        u[i] = 0.3 + a[i % 3][0] * at[i / 3][0] + a[i % 3][1] * at[i / 3][1] + a[i % 3][2] * at[i / 3][2];
    for (int i = 0; i < 36; i++)
        want += x.volume * strain[i / 6] * s->c[i / 6][i % 6] * strain[i % 6];
    for (int i = 0; i < 900; i++) {
        is += u[i / 30] * x.k[i / 30][i % 30] * u[i % 30];
        size += fabs(u[i / 30] * x.k[i / 30][i % 30] * u[i % 30]);
    }
    ck_assert_msg(fabs(is - want) < 1e-14 * size, "energy %.15g, not %.15g", is, want);
}

START_TEST(test_constant_strain)
{
    const struct elastic material[2] = {solids_steel(), spruce()};
    const double strain[3][3] = {{0.3, -0.7, 0.2}, {0.4, -0.5, 0.9}, {-0.1, 0.6, 0.8}},
                 rotation[3][3] = {{0, -1, 2}, {1, 0, -3}, {-2, 3, 0}};
    for (int i = 0; i < 2; i++)
        for (int curved = 0; curved < 2; curved++) {
            expect_energy(0.05 * curved, &material[i], strain);
            expect_energy(0.05 * curved, &material[i], rotation);
        }
}
END_TEST

/* Forces of rigid motions are rounding. */
START_TEST(test_rigid)
{
    double at[10][3];
    make(0.05, at);
    struct elastic s = spruce();
    struct solid_element x = element(at, &s);
    for (int motion = 0; motion < 6; motion++)
        for (int row = 0; row < 30; row++) {
            double force = 0.0, size = 0.0;
            for (int i = 0; i < 30; i++) {
                int k = motion % 3, c = i % 3;
                double u = motion < 3         ? c == k
                           : c == (k + 1) % 3 ? at[i / 3][(k + 2) % 3]
                           : c == (k + 2) % 3 ? -at[i / 3][(k + 1) % 3]
                                              : 0.0;
                force += x.k[row][i] * u;
                size += fabs(x.k[row][i]) * 1.5;
            }
            ck_assert_msg(fabs(force) < 1e-14 * size, "motion %d, row %d: %g of %g", motion, row, force, size);
        }
}
END_TEST

/* An isotropic solid does not know how it is turned: K(R x) = R K(x) R^T; spruce does. */
START_TEST(test_rotation)
{
    const double r[3][3] = {{0.36, 0.48, -0.8}, {-0.8, 0.6, 0.0}, {0.48, 0.64, 0.6}};
    const struct elastic material[2] = {solids_steel(), spruce()};
    double at[10][3], turned[10][3];
    make(0.05, at);
    for (int i = 0; i < 30; i++)
        turned[i / 3][i % 3] = r[i % 3][0] * at[i / 3][0] + r[i % 3][1] * at[i / 3][1] + r[i % 3][2] * at[i / 3][2];
    for (int k = 0; k < 2; k++) {
        struct solid_element x = element(at, &material[k]), y = element(turned, &material[k]);
        double worst = 0.0;
        for (int i = 0; i < 900; i++) {
            int p = i / 30, q = i % 30;
            double want = 0.0;
            for (int j = 0; j < 9; j++)
                want += r[p % 3][j / 3] * x.k[p / 3 * 3 + j / 3][q / 3 * 3 + j % 3] * r[q % 3][j % 3];
            worst = fmax(worst, fabs(y.k[p][q] - want) / x.k[29][29]);
        }
        ck_assert_msg(k == 0 ? worst < 1e-13 : worst > 0.01, "material %d: %g", k, worst);
    }
}
END_TEST

START_TEST(test_refused)
{
    double at[10][3], swap[3];
    struct elastic steel = solids_steel();
    struct solid_element x;
    make(0.0, at);
    memcpy(swap, at[0], sizeof swap);
    memcpy(at[0], at[1], sizeof swap);
    memcpy(at[1], swap, sizeof swap);
    ck_assert(!solid_element_make((const double(*)[3])at, quadratic_lattice(), &steel, &x));
    make(0.0, at);
    memcpy(at[7], at[9], sizeof at[7]); /* one midside in the place of another: folded over */
    ck_assert(!solid_element_make((const double(*)[3])at, quadratic_lattice(), &steel, &x));
}
END_TEST

UNIT("solid_element", test_mass, test_curved_mass, test_constant_strain, test_rigid, test_rotation, test_refused)
