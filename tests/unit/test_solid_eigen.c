/* The sparse solver and the count of eigenvalues against LAPACK's dense solver; assembled matrices: constant strain,
 * mass, rigid motions. */
#include "fem/solid_eigen.h"

#include <lapacke.h>

#include "num/noise.h"
#include "solids.h"

struct rig {
    struct arena *a;
    struct solids s;
    struct solid_net net;
    struct solid_freedoms f;
    struct solid_matrices x;
};

/* Nodes inside are moved by up to `bend`, m: elements of no symmetry, with curved faces. */
static void bend_inside(struct solids *s, double bend)
{
    struct noise noise = noise_make(2, "inside");
    for (int i = 0; i < s->mesh.nodes; i++) {
        bool inside = true;
        for (int k = 0; k < 3; k++)
            inside = inside && s->mesh.at[i][k] > 1e-9 && s->mesh.at[i][k] < s->boundary.high[k] - 1e-9;
        for (int k = 0; k < 3 && inside; k++)
            s->mesh.at[i][k] += bend * (2.0 * noise_uniform(noise, (uint64_t)i, (uint64_t)k) - 1.0);
    }
}

static void open_order(struct rig *r, int order, const int n[3], const double size[3], bool fixed)
{
    struct elastic steel = solids_steel();
    struct err e = {0};
    r->a = arena_open();
    r->s = solids_box(n, size, r->a);
    bend_inside(&r->s, 0.005);
    struct solid_fixed face = solids_hold(&r->s, SOLID_CLAMPED, 0, 0.0, r->a);
    struct solid_ask ask = {.material = &steel, .fixed = &face, .n_fixed = fixed};
    solid_matrices_net(&r->s.mesh, &r->s.boundary, order, r->a, &r->net);
    ck_assert(solid_matrices_freedoms(&r->net, &ask, r->a, &r->f, &e));
    ck_assert(solid_matrices_open(&r->net, &steel, &r->f, &r->x, &e));
}

static void open_rig(struct rig *r, const int n[3], const double size[3], bool fixed)
{
    open_order(r, 2, n, size, fixed);
}

static void close_rig(struct rig *r)
{
    solid_matrices_close(&r->x);
    arena_close(r->a);
}

/* u = A x: K u is 0 at every node inside (elements there are bent, of no symmetry), and u^T K u the volume times strain
 * . C strain; rigid motions: K u = 0 at all. Mass: density times volume. */
static void expect_patch(int order)
{
    const double a[2][3][3] = {{{0.3, -0.7, 0.2}, {0.4, -0.5, 0.9}, {-0.1, 0.6, 0.8}},
                               {{0, -1, 2}, {1, 0, -3}, {-2, 3, 0}}};
    const double size[3] = {0.3, 0.2, 0.25};
    struct elastic c = solids_steel();
    struct rig r;
    open_order(&r, order, (const int[]){2, 3, 2}, size, false);
    for (int rigid = 0; rigid < 2; rigid++) {
        double *u = ARENA_TAKE(r.a, double, r.f.n), *force = ARENA_TAKE(r.a, double, r.f.n), energy = 0.0, want = 0.0,
               most = 0.0;
        for (int i = 0; i < r.f.n; i++)
            for (int k = 0; k < 3; k++)
                u[i] += a[rigid][i % 3][k] * r.net.at[i / 3][k];
        solid_matrices_times(&r.x, r.x.k, u, force);
        for (int i = 0; i < r.f.n; i++) {
            const double *p = r.net.at[i / 3];
            bool inside = true;
            for (int k = 0; k < 3; k++)
                inside = inside && p[k] > 1e-9 && p[k] < size[k] - 1e-9;
            energy += u[i] * force[i];
            if (inside || rigid) most = fmax(most, fabs(force[i]));
        }
        ck_assert_msg(most < 1e-12 * 200e9 * 0.3, "force %g N", most);
        const double strain[6] = {0.3, -0.5, 0.8, 1.5, 0.1, -0.3};
        for (int i = 0; i < 36; i++)
            want += 0.015 * strain[i / 6] * c.c[i / 6][i % 6] * strain[i % 6];
        ck_assert_msg(fabs(energy - (rigid ? 0.0 : want)) < 1e-12 * want, "energy %.15g, not %.15g", energy, want);
    }
    SOLIDS_NEAR(r.x.mass, 7850.0 * 0.015, 1e-13);
    close_rig(&r);
}

START_TEST(test_patch)
{
    for (int order = 2; order <= 4; order++)
        expect_patch(order);
}
END_TEST

static double *dense_matrix(const cholmod_sparse *a, struct arena *arena)
{
    double *d = ARENA_TAKE(arena, double, a->ncol * a->ncol);
    for (size_t c = 0; c < a->ncol; c++)
        for (int k = ((const int *)a->p)[c]; k < ((const int *)a->p)[c + 1]; k++)
            d[c * a->ncol + (size_t)((const int *)a->i)[k]] = ((const double *)a->x)[k];
    return d;
}

/* 60 of 1215 pairs, free and held: lambda to 1e-9 (rigid ones: of the highest), residuals, and the count between each
 * two. */
static void against_dense(bool fixed, struct rig *r)
{
    struct err e = {0};
    struct solid_pairs p;
    cholmod_factor *factor = NULL;
    int n = r->f.n;
    ck_assert_int_gt(n, 400);
    double *k = dense_matrix(r->x.k, r->a), *m = dense_matrix(r->x.m, r->a), *want = ARENA_TAKE(r->a, double, n);
    ck_assert_int_eq(LAPACKE_dsygv(LAPACK_COL_MAJOR, 1, 'N', 'L', n, k, n, m, n, want), 0);
    ck_assert_msg(solid_eigen(&r->x, &(struct solid_search){60, -1e8, 0}, &factor, &p, &e), "%s", e.text);
    ck_assert_int_eq(p.n, 60);
    for (int i = 0; i < 60; i++)
        ck_assert_msg(fabs(p.lambda[i] - want[i]) < 1e-9 * fabs(want[i]) + 1e-11 * want[59], "%d: %.12g, not %.12g", i,
                      p.lambda[i], want[i]);
    ck_assert(solid_eigen_residual(&r->x, &p, fixed ? 0 : 6, fixed ? 60 : 54) < 1e-8);
    for (int i = fixed ? 0 : 5; i < 200; i += 13)
        if (want[i + 1] - want[i] > 1e-9 * want[i + 1])
            ck_assert_int_eq(solid_eigen_count(&r->x, factor, 0.5 * (want[i] + want[i + 1])), i + 1);
    ck_assert_int_eq(solid_eigen_count(&r->x, factor, -1e8), 0);
    ck_assert_int_eq(solid_eigen_count(&r->x, factor, 2.0 * want[n - 1]), n);
    cholmod_free_factor(&factor, &r->x.common);
    solid_eigen_close(&p);
}

START_TEST(test_dense)
{
    for (int fixed = 0; fixed < 2; fixed++) {
        struct rig r;
        open_rig(&r, (const int[]){4, 3, 1}, (const double[]){0.3, 0.2, 0.05}, fixed);
        against_dense(fixed, &r);
        close_rig(&r);
    }
}
END_TEST

/* Modes do not depend on the start vector, and those of one start are the same bits twice. */
START_TEST(test_start)
{
    struct rig r;
    struct err e = {0};
    struct solid_pairs p[3];
    open_rig(&r, (const int[]){4, 3, 1}, (const double[]){0.3, 0.2, 0.05}, true);
    for (int i = 0; i < 3; i++) {
        cholmod_factor *factor = NULL;
        ck_assert(solid_eigen(&r.x, &(struct solid_search){20, -1e8, i / 2}, &factor, &p[i], &e));
        cholmod_free_factor(&factor, &r.x.common);
    }
    for (int i = 0; i < 20; i++) {
        ck_assert(p[0].lambda[i] == p[1].lambda[i]);
        SOLIDS_NEAR(p[2].lambda[i], p[0].lambda[i], 1e-11);
    }
    ck_assert(!memcmp(p[0].vector, p[1].vector, 20 * p[0].freedoms * sizeof(double)));
    ck_assert(memcmp(p[0].vector, p[2].vector, 20 * p[0].freedoms * sizeof(double)));
    for (int i = 0; i < 3; i++)
        solid_eigen_close(&p[i]);
    close_rig(&r);
}
END_TEST

/* Only three different eigenvalues, 20, 40 and 540 times: blocks of eight span all that one start leads to within three
 * steps, and fresh ones have to find the rest. */
START_TEST(test_exhausted)
{
    enum { N = 600 };
    struct solid_matrices x = {0};
    struct solid_pairs p;
    struct err e = {0};
    cholmod_factor *factor = NULL;
    cholmod_start(&x.common);
    x.common.supernodal = CHOLMOD_SUPERNODAL;
    cholmod_sparse *unit = cholmod_speye(N, N, CHOLMOD_REAL, &x.common);
    x.k = cholmod_copy(unit, -1, 1, &x.common);
    x.m = cholmod_copy(unit, -1, 1, &x.common);
    x.m_thin = cholmod_copy(unit, -1, 1, &x.common);
    cholmod_free_sparse(&unit, &x.common);
    for (int i = 0; i < N; i++)
        ((double *)x.k->x)[i] = i % 30 == 0 ? 1.0 : i % 15 == 0 || i % 30 == 1 ? 2.0 : 5.0;
    ck_assert_msg(solid_eigen(&x, &(struct solid_search){70, -0.5, 0}, &factor, &p, &e), "%s", e.text);
    for (int i = 0; i < 70; i++)
        ck_assert_msg(fabs(p.lambda[i] - (i < 20 ? 1.0 : i < 60 ? 2.0 : 5.0)) < 1e-10, "%d: %.12g", i, p.lambda[i]);
    for (int i = 0; i < 70; i++)
        for (int k = 0; k <= i; k++) {
            double dot = 0.0;
            for (int j = 0; j < N; j++)
                dot += p.vector[i * N + j] * p.vector[k * N + j];
            ck_assert_msg(fabs(dot - (i == k)) < 1e-10, "%d %d: %g", i, k, dot);
        }
    cholmod_free_factor(&factor, &x.common);
    solid_eigen_close(&p);
    solid_matrices_close(&x);
}
END_TEST

UNIT("solid_eigen", test_patch, test_dense, test_start, test_exhausted)
