/* A plate's shapes, summed in y first and then in x, against the plain double sum of products in long double. */
#include "response/object_plate.c"

#include "objects.h"
#include "response/radiator.h"

enum { ROW = 37 };

/* How far off, relative to the sum of magnitudes. */
static double against_plain(int edges, int modes, struct arena *a)
{
    struct object_given g = objects_given(OBJECT_PLATE, edges, 0.3);
    g.width = 0.6;
    struct object o = objects_make(&g, modes, 1e9, a);
    const struct object_inside *in = object_inside(&o);
    const struct ritz *r = (const struct ritz *)in->list.work;
    double x[ROW], *phi = ARENA_TAKE(a, double, ROW *o.n), *alone = ARENA_TAKE(a, double, o.n), worst = 0.0;
    for (int p = 0; p < ROW; p++)
        x[p] = p == 0 ? 0.0 : p == 1 ? 1.0 : drand48();
    double y = 0.6 * drand48(), fx[JACOBI_MOST], fy[JACOBI_MOST];
    o.row(&o, ROW, x, y, phi);
    special_jacobi_values(&r->y.functions, r->y.n, 2.0 * y / 0.6 - 1.0, fy);
    for (int p = 0; p < ROW; p++) {
        special_jacobi_values(&r->x.functions, r->x.n, 2.0 * x[p] - 1.0, fx);
        ck_assert(o.shapes(&o, x[p], y, alone) == 0.0 &&
                  memcmp(alone, phi + p * o.n, (size_t)o.n * sizeof *alone) == 0);
        for (int i = 0; i < o.n; i++) {
            const struct class *c = &r->class[in->list.mode[i].a];
            long double sum = 0, size = 0;
            for (int t = 0; t < c->n; t++) {
                long double one =
                    2.0L * c->vector[in->list.mode[i].b * c->n + t] * fx[c->term[t][0]] * fy[c->term[t][1]];
                sum += one;
                size += fabsl(one);
            }
            worst = fmax(worst, (double)(fabsl(phi[p * o.n + i] - sum) / size));
        }
    }
    return worst;
}

START_TEST(test_plain)
{
    const int modes[] = {1, 5, 60, 300}; /* the last: more than a block in each class */
    for (int edges = EDGES_FREE; edges <= EDGES_CLAMPED; edges += EDGES_CLAMPED - EDGES_FREE)
        for (size_t k = 0; k < sizeof modes / sizeof *modes; k++) {
            struct arena *a = arena_open();
            double worst = against_plain(edges, modes[k], a);
            printf("edges %d, %d modes: off by %.2g\n", edges, modes[k], worst);
            ck_assert_double_lt(worst, 1e-15);
            arena_close(a);
        }
}
END_TEST

/* Heard in front of it, row after row or place after place: the same bits. */
START_TEST(test_heard)
{
    struct arena *a = arena_open();
    struct object o = objects_of(OBJECT_PLATE, EDGES_FREE, 0.3, 20, a);
    struct modes m;
    const double origin[2] = {0.0, 0.0};
    struct radiator_plate p = {.modes = &m, .place = {0.3, 0.2, 0.4}, .density = 1.2, .sound_speed = 343.0};
    double re[2][20], im[2][20];
    struct err e = {0};
    radiator_plate_reference(&o, a, p.reference);
    object_modes(&o, origin, p.reference, 20, a, &m);
    for (int k = 0; k < 2; k++) {
        struct object heard = *m.object;
        if (k) heard.row = NULL;
        p.object = &heard;
        ck_assert_msg(radiator_plate(&p, a, re[k], im[k], &e), "%s", e.text);
    }
    ck_assert_mem_eq(re[0], re[1], sizeof re[0]);
    ck_assert_mem_eq(im[0], im[1], sizeof im[0]);
    arena_close(a);
}
END_TEST

UNIT("plate_sum", test_plain, test_heard)
