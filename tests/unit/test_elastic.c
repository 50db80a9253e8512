/* Hooke's law: pulling along an axis gives Young's modulus and Poisson's contractions back; what is no material is
 * refused. */
#include "fem/solid_element.h"

#include "unit.h"

/* stress = C strain */
static void stress_of(const struct elastic *s, const double strain[6], double stress[6])
{
    for (int i = 0; i < 6; i++) {
        stress[i] = 0.0;
        for (int j = 0; j < 6; j++)
            stress[i] += s->c[i][j] * strain[j];
    }
}

/* Rounding of sums of terms of 1e11 Pa times 1e-11. */
static void expect(const double *is, const double *want)
{
    for (int i = 0; i < 6; i++)
        ck_assert_msg(fabs(is[i] - want[i]) < 1e-12, "stress %d is %g, not %g", i, is[i], want[i]);
}

START_TEST(test_isotropic)
{
    struct elastic s;
    struct err e = {0};
    double stress[6];
    ck_assert(solid_element_isotropic(200e9, 0.3, 7850.0, &s, &e));
    stress_of(&s, (const double[]){1 / 200e9, -0.3 / 200e9, -0.3 / 200e9, 0, 0, 0}, stress);
    expect(stress, (const double[]){1, 0, 0, 0, 0, 0});
    stress_of(&s, (const double[]){0, 0, 0, 0, 2.6 / 200e9, 0}, stress);
    expect(stress, (const double[]){0, 0, 0, 0, 1, 0});
    ck_assert(s.density == 7850.0);
}
END_TEST

static const struct elastic_wood spruce = {{11e9, 0.5e9, 0.9e9}, {0.04e9, 0.75e9, 0.72e9}, {0.25, 0.37, 0.47}, 420.0};

/* One pull along each axis and one shear in each plane. */
START_TEST(test_orthotropic)
{
    struct elastic s;
    struct err e = {0};
    double stress[6];
    ck_assert(solid_element_orthotropic(&spruce, &s, &e));
    const double *m = spruce.e, yz = spruce.nu[0], xz = spruce.nu[1], xy = spruce.nu[2];
    stress_of(&s, (const double[]){1 / m[0], -xy / m[0], -xz / m[0], 0, 0, 0}, stress);
    expect(stress, (const double[]){1, 0, 0, 0, 0, 0});
    stress_of(&s, (const double[]){-xy / m[0], 1 / m[1], -yz / m[1], 0, 0, 0}, stress);
    expect(stress, (const double[]){0, 1, 0, 0, 0, 0});
    stress_of(&s, (const double[]){-xz / m[0], -yz / m[1], 1 / m[2], 0, 0, 0}, stress);
    expect(stress, (const double[]){0, 0, 1, 0, 0, 0});
    stress_of(&s, (const double[]){0, 0, 0, 1 / spruce.g[0], 0, 0}, stress);
    expect(stress, (const double[]){0, 0, 0, 1, 0, 0});
    stress_of(&s, (const double[]){0, 0, 0, 0, 1 / spruce.g[1], 1 / spruce.g[2]}, stress);
    expect(stress, (const double[]){0, 0, 0, 0, 1, 1});
}
END_TEST

START_TEST(test_same)
{
    struct elastic s, t;
    struct err e = {0};
    const double shear = 70e9 / 2.44;
    ck_assert(solid_element_isotropic(70e9, 0.22, 2500.0, &s, &e));
    ck_assert(solid_element_orthotropic(
        &(struct elastic_wood){{70e9, 70e9, 70e9}, {shear, shear, shear}, {0.22, 0.22, 0.22}, 2500.0}, &t, &e));
    for (int i = 0; i < 36; i++)
        ck_assert(fabs(s.c[i / 6][i % 6] - t.c[i / 6][i % 6]) < 1e-12 * 70e9);
}
END_TEST

static void refuse_isotropic(double young, double poisson, double density, const char *says)
{
    struct elastic s;
    struct err e = {0};
    ck_assert(!solid_element_isotropic(young, poisson, density, &s, &e));
    ck_assert_int_eq(e.kind, ERR_USAGE);
    ck_assert_msg(strstr(e.text, says) != NULL, "%s", e.text);
}

static void refuse_wood(struct elastic_wood w, const char *says)
{
    struct elastic s;
    struct err e = {0};
    ck_assert(!solid_element_orthotropic(&w, &s, &e));
    ck_assert_int_eq(e.kind, ERR_USAGE);
    ck_assert_msg(strstr(e.text, says) != NULL, "%s", e.text);
}

START_TEST(test_refused)
{
    struct elastic_wood w = spruce;
    refuse_isotropic(0.0, 0.3, 1.0, "above 0");
    refuse_isotropic(1e9, 0.3, NAN, "above 0");
    refuse_isotropic(INFINITY, 0.3, 1.0, "above 0");
    refuse_isotropic(1e9, 0.5, 1.0, "below 0.5");
    refuse_isotropic(1e9, -1.0, 1.0, "above -1");
    w.g[1] = 0.0;
    refuse_wood(w, "above 0");
    w = spruce, w.nu[2] = 4.8; /* 4.8^2 > 11/0.5 */
    refuse_wood(w, "no material");
    w = spruce, w.nu[1] = 3.6; /* 3.6^2 > 11/0.9 */
    refuse_wood(w, "no material");
    w = (struct elastic_wood){
        {1e9, 1e9, 1e9}, {1e9, 1e9, 1e9}, {0.6, 0.6, 0.6}, 1.0}; /* each pair is possible, all three are not */
    refuse_wood(w, "no material");
}
END_TEST

UNIT("elastic", test_isotropic, test_orthotropic, test_same, test_refused)
