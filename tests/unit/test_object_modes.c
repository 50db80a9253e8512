/* Objects as modes of velocity: gains, places, the choice of the strongest. */
#include "objects.h"

static const double nowhere[2] = {0.0, 0.0};

static double ask(const struct modes *m, double x, double y, double *re, double *im)
{
    struct modes_where w = {x, y, 0.0};
    struct modes_point p = {NULL, NULL, re, im};
    return m->at(m, &w, &p);
}

/* q'' + 2 d q' + w^2 q = phi(x) phi(l)/m delta: velocity jumps to that, and the acceleration just after is -2 d times
 * it. */
START_TEST(test_gains)
{
    struct arena *a = arena_open();
    struct object_given g = objects_given(OBJECT_PLATE, EDGES_FREE, 0.3);
    g.width = 0.6, g.loss = 0.05;
    struct object o = objects_make(&g, 40, 1e9, a);
    struct modes m;
    const double origin[2] = {-3.0, 2.0}, listen[2] = {0.9, 0.1};
    double phi[40], heard[40], re[40], im[40];
    object_modes(&o, origin, listen, 40, a, &m);
    ck_assert(m.n == 40 && m.shared && m.moves && !m.travels && m.quantity == MODES_VELOCITY && m.radius == o.radius);
    ck_assert_str_eq(m.name, "surface.object");
    ck_assert(ask(&m, origin[0] + 0.25, origin[1] + 0.5, re, im) == 0.0);
    m.object->shapes(m.object, 0.25, 0.5, phi);
    m.object->shapes(m.object, listen[0], listen[1], heard);
    for (int i = 0; i < 40; i++) {
        double d = m.decay[i], w = 2.0 * PI * m.frequency[i], start = phi[i] * heard[i] / m.object->mass[i];
        ck_assert(m.slowest[i] == d && m.object->frequency[i] == m.frequency[i]);
        OBJECTS_NEAR(im[i], start, 1e-14);                            /* Im A at t = 0 */
        OBJECTS_NEAR(re[i] * w - im[i] * d, -2.0 * d * start, 1e-12); /* Im(A s) */
    }
    OBJECTS_NEAR(ask(&m, origin[0] + 1.5, origin[1] + 0.5, re, im), 0.5, 1e-14);
    object_modes(&o, origin, NULL, 40, a, &m);
    ask(&m, origin[0] + 0.25, origin[1] + 0.5, re, im);
    m.object->shapes(m.object, 0.25, 0.5, phi);
    for (int i = 0; i < 40; i++)
        OBJECTS_NEAR(im[i], phi[i] * phi[i] / m.object->mass[i], 1e-14);
    arena_close(a);
}
END_TEST

/* Struck at x and heard at l is struck at l and heard at x. */
START_TEST(test_reciprocity)
{
    struct arena *a = arena_open();
    for (int shape = OBJECT_BAR; shape <= OBJECT_SHELL; shape++) {
        struct object_given g = objects_any(shape);
        struct object o = objects_make(&g, 30, 1e9, a);
        const double x[2] = {0.23, 0.11}, l[2] = {0.62, 0.37};
        double re[2][30], im[2][30], size = 0.0;
        struct modes m[2];
        object_modes(&o, nowhere, l, 30, a, &m[0]);
        object_modes(&o, nowhere, x, 30, a, &m[1]);
        ask(&m[0], x[0], x[1], re[0], im[0]);
        ask(&m[1], l[0], l[1], re[1], im[1]);
        for (int i = 0; i < 30; i++) {
            int k = 0; /* order is by strength, and that is by listener; pairs by their gain */
            for (int j = 0; j < 30; j++)
                if (m[1].frequency[j] == m[0].frequency[i] &&
                    fabs(im[1][j] - im[0][i]) <
                        fabs(im[1][k] - im[0][i]) + (m[1].frequency[k] != m[0].frequency[i]) * 1e9)
                    k = j;
            ck_assert(m[1].frequency[k] == m[0].frequency[i]);
            ck_assert_double_le(fabs(im[1][k] - im[0][i]), 1e-13 * fabs(im[0][i]) + 1e-18);
            size += fabs(im[0][i]);
        }
        ck_assert_double_gt(size, 0.0);
    }
    arena_close(a);
}
END_TEST

/* A supported bar: its second mode is silent when struck or heard in the middle; heard at a quarter the sign turns
 * across the middle. */
START_TEST(test_nodes)
{
    struct arena *a = arena_open();
    struct object o = objects_of(OBJECT_BAR, EDGES_SUPPORTED, 0.3, 2, a);
    const double quarter[2] = {0.25, 0.0};
    double re[2], im[2], across[2];
    struct modes m;
    object_modes(&o, nowhere, quarter, 2, a, &m);
    int second = m.frequency[1] > m.frequency[0];
    ask(&m, 0.5, 0.0, re, im);
    ck_assert(im[second] == 0.0 && re[second] == 0.0 && im[!second] > 0.0);
    ask(&m, 0.4, 0.0, re, im);
    ask(&m, 0.6, 0.0, re, across);
    ck_assert_double_gt(im[second], 0.0);
    OBJECTS_NEAR(across[second], -im[second], 1e-14);
    arena_close(a);
}
END_TEST

/* The strongest by the mean of gain^2/(4 d), of a supported bar (3/8)/(m^2 4 d) whose d rises with the order: the
   lowest; a list of all is a list of some with more behind it, and gains go with their modes. */
START_TEST(test_strongest)
{
    struct arena *a = arena_open();
    struct object_given g = objects_given(OBJECT_BAR, EDGES_SUPPORTED, 0.3);
    struct object o = objects_make(&g, 30, 1e9, a);
    struct modes few, all;
    object_modes(&o, nowhere, NULL, 7, a, &few);
    ck_assert_int_eq(few.n, 7);
    for (int i = 0; i < 7; i++)
        ck_assert(few.frequency[i] == o.frequency[i]);
    const double end[2] = {1.0 / 3.0, 0.0}; /* heard there every third is silent */
    object_modes(&o, nowhere, end, 20, a, &few);
    for (int i = 0; i < few.n; i++)
        ck_assert_msg(few.frequency[i] != o.frequency[2] && few.frequency[i] != o.frequency[5],
                      "a silent mode is among the strongest 20");
    g = objects_given(OBJECT_DISK, EDGES_FREE, 0.3);
    o = objects_make(&g, 60, 1e9, a);
    object_modes(&o, nowhere, NULL, 25, a, &few);
    object_modes(&o, nowhere, NULL, 60, a, &all);
    double re[60], im[60], some[60];
    ask(&all, 0.3, 0.4, re, im);
    ask(&few, 0.3, 0.4, re, some);
    for (int i = 0; i < 25; i++)
        ck_assert(few.frequency[i] == all.frequency[i] && fabs(some[i] - im[i]) < 1e-12 * fabs(im[i]) + 1e-14);
    for (int i = 0; i + 1 < 60; i++) /* pairs stay side by side */
        for (int k = i + 2; k < 60; k++)
            ck_assert(all.frequency[i] != all.frequency[k]);
    arena_close(a);
}
END_TEST

/* A sphere answers alike wherever it is touched; heard elsewhere only the angle between counts: 90 degrees, on two ways
 * round. */
START_TEST(test_shell)
{
    struct arena *a = arena_open();
    struct object o = objects_of(OBJECT_SHELL, EDGES_FREE, 0.3, 20, a);
    double here[20], there[20], re[20];
    struct modes m;
    object_modes(&o, nowhere, NULL, 20, a, &m);
    ck_assert(!m.moves);
    ask(&m, 0.3, -1.0, re, here);
    for (int i = 0; i < 20; i++)
        OBJECTS_NEAR(here[i], 1.0 / m.object->mass[i], 1e-15);
    const double listen[2] = {PI / 3.0, 0.0}, antipode[2] = {PI, 0.0};
    object_modes(&o, nowhere, listen, 20, a, &m);
    ask(&m, -PI / 6.0, 0.0, re, here);
    ask(&m, 0.0, PI / 2.0, re, there);
    for (int i = 0; i < 20; i++)
        ck_assert_double_lt(fabs(here[i] - there[i]), 1e-14);
    ask(&m, PI / 3.0, 0.0, re, there);
    for (int i = 0; i < 20; i++)
        OBJECTS_NEAR(there[i], 1.0 / m.object->mass[i], 1e-12);
    object_modes(&o, nowhere, antipode, 20, a, &m);
    ask(&m, 0.0, 0.0, re, there);
    int odd = 0;
    for (int i = 0; i < 20; i++) {
        OBJECTS_NEAR(fabs(there[i]), 1.0 / m.object->mass[i], 1e-12);
        odd += there[i] < 0.0;
    }
    ck_assert(odd > 5 && odd < 15);
    arena_close(a);
}
END_TEST

UNIT("object_modes", test_gains, test_reciprocity, test_nodes, test_strongest, test_shell)
