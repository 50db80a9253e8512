#include "fem/solid_family.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fem/solid_matrices.h"
#include "num/real.h"

enum { SAMPLES = 3, NODES = 39, BEYOND = 12 }; /* BEYOND: modes that others may come from or go to */

static const double samples[SAMPLES] = {0.05, 0.25, 0.44};
/* Error of orders 3 and 4 to what the order below is higher by, about: medians of the modes of a graded bracket, a
   plate, a ring and a bowl of coarse cells are 0.03 to 0.12 and 0.01 to 0.22. */
static const double order_gains[] = {0.08, 0.15};
static const double step = 0.0125; /* of nodes, from 0 on */
static const double modulus = 1e10, density = 1000.0;
static const double least = 1e-9; /* of the greatest eigenvalue of V^T M V: what is less is no direction of its own */

/* ------------------------------------------------------------------ the span */

struct span {
    int n, r;     /* vectors, independent directions */
    size_t wide;  /* freedoms */
    double *v;    /* [n][wide] */
    double *phi;  /* [points][n] */
    double *turn; /* [r][n]: rows are M-orthonormal combinations of v */
    double *k[2]; /* [r][r] of the first and the last sample */
};

static bool solve_samples(const struct solid_family_ask *ask, const struct solid_net *net,
                          const struct solid_freedoms *freedoms, int count, struct arena *a, struct solid_modes *modes,
                          struct span *s, struct err *e)
{
    for (int i = 0; i < count; i++) {
        struct elastic material;
        if (ask->material)
            material = *ask->material;
        else if (!solid_element_isotropic(modulus, samples[i], density, &material, e))
            return false;
        struct solid_ask one = {.material = &material,
                                .fixed = ask->fixed,
                                .n_fixed = ask->n_fixed,
                                .order = ask->order,
                                .most = ask->most + BEYOND,
                                .top = INFINITY};
        if (!solid_modes(ask->mesh, ask->boundary, &one, a, &modes[i], e)) return false;
        if (i == 0) {
            s->wide = (size_t)freedoms->n;
            s->v = ARENA_TAKE(a, double, (size_t)count *(size_t)one.most * s->wide);
            s->phi = ARENA_TAKE(a, double, (size_t)count *(size_t)one.most *(size_t)(ask->points + 1));
        }
        for (int j = 0; j < modes[i].n; j++)
            solid_matrices_gather(freedoms, modes[i].shape + 3 * (size_t)j * (size_t)net->nodes,
                                  s->v + (size_t)(s->n + j) * s->wide);
        s->n += modes[i].n;
    }
    return true;
}

/* g = V^T A V, [n][n]: its lower half by strips of columns, then the upper. */
static bool project(const struct span *s, struct solid_matrices *x, cholmod_sparse *matrix, double *g)
{
    enum { STRIP = 32 };
    const int n = s->n, wide = (int)s->wide;
    double *y = malloc(STRIP * s->wide * sizeof *y);
    if (!y) return false;
    for (int c = 0; c < n; c += STRIP) {
        int columns = n - c < STRIP ? n - c : STRIP;
        for (int i = 0; i < columns; i++)
            solid_matrices_times(x, matrix, s->v + (size_t)(c + i) * s->wide, y + (size_t)i * s->wide);
        cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, n - c, columns, wide, 1.0, s->v + (size_t)c * s->wide,
                    wide, y, wide, 0.0, g + (size_t)c * n + c, n);
    }
    for (int c = 0; c < n; c++)
        for (int r = 0; r < c; r++)
            g[(size_t)c * n + r] = g[(size_t)r * n + c];
    free(y);
    return true;
}

/* turn: V^T M V = Q D Q^T, rows q_i/sqrt(d_i). */
static bool orthonormal(struct span *s, double *g, struct arena *a)
{
    double *d = ARENA_TAKE(a, double, s->n);
    if (LAPACKE_dsyevd(LAPACK_COL_MAJOR, 'V', 'L', s->n, g, s->n, d) != 0) return false;
    s->turn = ARENA_TAKE(a, double, (size_t)s->n * s->n);
    for (int i = s->n - 1; i >= 0 && d[i] > least * d[s->n - 1]; i--, s->r++)
        for (int j = 0; j < s->n; j++)
            s->turn[(size_t)s->r * s->n + j] = g[(size_t)i * s->n + j] / sqrt(d[i]);
    return true;
}

/* turn g turn^T, [r][r]. */
static double *turned(const struct span *s, const double *g, struct arena *a)
{
    double *half = ARENA_TAKE(a, double, (size_t)s->n * s->r), *all = ARENA_TAKE(a, double, (size_t)s->r * s->r);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, s->n, s->r, s->n, 1.0, g, s->n, s->turn, s->n, 0.0, half,
                s->n);
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, s->r, s->r, s->n, 1.0, s->turn, s->n, half, s->n, 0.0, all,
                s->r);
    return all;
}

/* The equations on the span. K is linear in Lame's constants, so that those of two values of nu give that of any. */
static bool reduce(const struct solid_net *net, const struct solid_freedoms *freedoms, struct arena *a, struct span *s,
                   struct err *e)
{
    double *g = ARENA_TAKE(a, double, (size_t)s->n * s->n);
    for (int i = 0; i < 2; i++) {
        struct solid_matrices x;
        struct elastic material;
        bool ok = solid_element_isotropic(modulus, samples[i ? SAMPLES - 1 : 0], density, &material, e) &&
                  solid_matrices_open(net, &material, freedoms, &x, e);
        if (!ok) return false;
        bool memory = i > 0 || (project(s, &x, x.m_thin, g) && orthonormal(s, g, a));
        memory = memory && project(s, &x, x.k, g);
        if (memory) s->k[i] = turned(s, g, a);
        solid_matrices_close(&x);
        if (!memory) return solid_matrices_no_memory(s->wide, e);
    }
    return true;
}

/* ------------------------------------------------------------------ nodes */

/* Lame's constants of E = 1 and their derivatives to nu. */
static void lame(double nu, double value[2], double slope[2])
{
    double p = 1.0 + nu, q = 1.0 - 2.0 * nu;
    value[0] = nu / (p * q);
    value[1] = 0.5 / p;
    slope[0] = (1.0 + 2.0 * nu * nu) / (p * p * q * q);
    slope[1] = -0.5 / (p * p);
}

/* c, such that K(nu) = c_0 K_first + c_1 K_last where `want` are Lame's constants (or their derivatives) of nu. */
static void weights(const double want[2], double c[2])
{
    double first[2], last[2], unused[2];
    lame(samples[0], first, unused);
    lame(samples[SAMPLES - 1], last, unused);
    double det = first[0] * last[1] - last[0] * first[1];
    c[0] = (want[0] * last[1] - last[0] * want[1]) / det;
    c[1] = (first[0] * want[1] - want[0] * first[1]) / det;
}

struct node {
    double *lambda, *slope; /* [m] */
    double *c;              /* [m][r] */
};

/* The m lowest pairs at nu. */
static bool node_solve(const struct span *s, double nu, int m, struct arena *a, struct node *node)
{
    struct arena *room = arena_open();
    size_t r = (size_t)s->r;
    double value[2], change[2], k[2], dk[2], *g = ARENA_TAKE(room, double, r *r), *w = ARENA_TAKE(room, double, r),
                                             *t = ARENA_TAKE(room, double, r);
    lame(nu, value, change);
    weights(value, k);
    weights(change, dk);
    for (size_t i = 0; i < r * r; i++)
        g[i] = k[0] * s->k[0][i] + k[1] * s->k[1][i];
    bool ok = LAPACKE_dsyevd(LAPACK_COL_MAJOR, 'V', 'L', s->r, g, s->r, w) == 0;
    node->lambda = ARENA_TAKE(a, double, m);
    node->slope = ARENA_TAKE(a, double, m);
    node->c = ARENA_TAKE(a, double, (size_t)m *r);
    memcpy(node->c, g, (size_t)m * r * sizeof *g);
    for (int j = 0; ok && j < m; j++) {
        node->lambda[j] = w[j];
        for (int i = 0; i < 2; i++) {
            cblas_dsymv(CblasColMajor, CblasLower, s->r, dk[i], s->k[i], s->r, g + (size_t)j * r, 1, 0.0, t, 1);
            node->slope[j] += cblas_ddot(s->r, t, 1, g + (size_t)j * r, 1);
        }
    }
    arena_close(room);
    return ok;
}

/* which[j]: the mode of `to` that mode j of `from` becomes: pairs by falling overlap of shapes. */
static void follow(const struct span *s, const struct node *from, const struct node *to, int m, struct arena *a,
                   int *which, double *sign)
{
    double *o = ARENA_TAKE(a, double, (size_t)m *m);
    bool *taken = ARENA_TAKE(a, bool, m);
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, m, m, s->r, 1.0, to->c, s->r, from->c, s->r, 0.0, o, m);
    for (int j = 0; j < m; j++)
        which[j] = -1;
    for (int pass = 0; pass < m; pass++) {
        int best = 0, other = 0;
        double most = -1.0;
        for (int j = 0; j < m; j++)
            for (int k = 0; which[j] < 0 && k < m; k++)
                if (!taken[k] && fabs(o[(size_t)j * m + k]) > most) {
                    most = fabs(o[(size_t)j * m + k]);
                    best = j;
                    other = k;
                }
        which[best] = other;
        sign[best] = o[(size_t)best * m + other] < 0.0 ? -1.0 : 1.0;
        taken[other] = true;
    }
}

static void node_write(const struct span *s, const struct node *node, int points, const int *place, const double *sign,
                       int at, struct solid_family *f, struct arena *a)
{
    double *v = ARENA_TAKE(a, double, s->n);
    for (int j = 0; j < f->n; j++) {
        const double *c = node->c + (size_t)place[j] * (size_t)s->r;
        double lambda = node->lambda[place[j]];
        f->log_ratio[at * f->n + j] = real_log(lambda * density / modulus);
        f->slope[at * f->n + j] = node->slope[place[j]] / lambda;
        cblas_dgemv(CblasColMajor, CblasNoTrans, s->n, s->r, 1.0, s->turn, s->n, c, 1, 0.0, v, 1);
        for (int p = 0; p < points; p++)
            f->phi[((size_t)at * points + p) * f->n + j] =
                sign[j] * sqrt(density) * cblas_ddot(s->n, v, 1, s->phi + (size_t)p * s->n, 1);
    }
}

/* Nodes from the middle outwards, so that branch j is the j-th mode of the middle one. */
static bool nodes(const struct span *s, int points, struct solid_family *f)
{
    const int m = f->n + BEYOND < s->r ? f->n + BEYOND : s->r, middle = (int)rint(samples[1] / step);
    struct arena *room = arena_open();
    struct node node[NODES];
    int *place = ARENA_TAKE(room, int, m), *next = ARENA_TAKE(room, int, m);
    double *sign = ARENA_TAKE(room, double, m), *flip = ARENA_TAKE(room, double, m);
    bool ok = true;
    for (int i = 0; ok && i < NODES; i++) {
        f->nu[i] = step * i;
        ok = node_solve(s, f->nu[i], m, room, &node[i]);
    }
    for (int step_of = -1; ok && step_of <= 1; step_of += 2) {
        for (int j = 0; j < m; j++) {
            place[j] = j;
            sign[j] = 1.0;
        }
        for (int i = middle; i >= 0 && i < NODES; i += step_of) {
            node_write(s, &node[i], points, place, sign, i, f, room);
            if (i + step_of < 0 || i + step_of >= NODES) break;
            follow(s, &node[i], &node[i + step_of], m, room, next, flip);
            for (int j = 0; j < m; j++) {
                sign[j] *= flip[place[j]];
                place[j] = next[place[j]];
            }
        }
    }
    arena_close(room);
    return ok;
}

/* ------------------------------------------------------------------ the whole */

static bool mesh_error(const struct solid_family_ask *ask, const struct elastic *material,
                       const struct solid_modes *fine, struct arena *a, struct solid_family *f, struct err *e)
{
    struct solid_modes coarse;
    struct solid_estimate estimate;
    struct solid_ask one = {.material = material,
                            .fixed = ask->coarse_fixed,
                            .n_fixed = ask->n_fixed,
                            .order = ask->coarse_order,
                            .most = fine->n + BEYOND,
                            .top = INFINITY};
    if (!solid_modes(ask->coarse, ask->coarse_boundary, &one, a, &coarse, e)) return false;
    const struct solid_side here = {ask->mesh, ask->boundary, fine},
                            there = {ask->coarse, ask->coarse_boundary, &coarse};
    solid_estimate(&here, &there, a, &estimate);
    for (int j = 0; j < f->n; j++)
        f->error[j] = (isnan(estimate.error[j]) ? estimate.median : estimate.error[j]) *
                      (ask->coarse == ask->mesh ? order_gains[ask->order > 3] : 1.0);
    return true;
}

static void given(const struct solid_family_ask *ask, const struct solid_modes *modes, struct solid_family *f)
{
    double gamma = ask->youngs_modulus / ask->material->density;
    for (int j = 0; j < f->n; j++)
        f->log_ratio[j] = real_log(modes->lambda[j] / gamma);
}

bool solid_family_make(const struct solid_family_ask *ask, struct arena *a, struct solid_family *f, struct err *e)
{
    struct arena *room = arena_open();
    struct solid_net net;
    struct solid_freedoms freedoms;
    struct solid_modes modes[SAMPLES];
    struct elastic middle;
    struct span s = {0};
    int count = ask->material ? 1 : SAMPLES, centre = ask->material ? 0 : 1;
    struct solid_ask hold = {.fixed = ask->fixed, .n_fixed = ask->n_fixed, .order = ask->order};
    *f = (struct solid_family){.nodes = ask->material ? 1 : NODES, .volume = ask->boundary->volume};
    solid_matrices_net(ask->mesh, ask->boundary, ask->order > 2 ? ask->order : 2, room, &net);
    bool ok = solid_matrices_freedoms(&net, &hold, room, &freedoms, e) &&
              solve_samples(ask, &net, &freedoms, count, room, modes, &s, e) &&
              (ask->material || solid_element_isotropic(modulus, samples[1], density, &middle, e));
    if (ok) {
        f->n = ask->most;
        for (int i = 0; i < count; i++)
            f->n = modes[i].n < f->n ? modes[i].n : f->n;
        f->freedoms = modes[0].freedoms;
        f->nu = ARENA_TAKE(a, double, f->nodes);
        f->log_ratio = ARENA_TAKE(a, double, f->nodes * f->n);
        f->slope = ARENA_TAKE(a, double, f->nodes * f->n);
        f->error = ARENA_TAKE(a, double, f->n);
        f->phi = ARENA_TAKE(a, double, (size_t)f->nodes *(size_t)(ask->points + 1) * (size_t)f->n);
        double *phi = ARENA_TAKE(room, double, s.n);
        for (int p = 0; p < ask->points; p++)
            for (int i = 0, from = 0; i < count; from += modes[i++].n) {
                solid_participation(&modes[i], &ask->point[p], phi);
                memcpy(s.phi + (size_t)p * s.n + from, phi, (size_t)modes[i].n * sizeof *phi);
                for (int j = 0; ask->material && j < f->n; j++)
                    f->phi[(size_t)p * f->n + j] = sqrt(ask->material->density) * phi[j];
            }
        for (int j = 0; j < f->n; j++)
            f->error[j] = NAN;
        if (ask->material)
            given(ask, modes, f);
        else
            ok = reduce(&net, &freedoms, room, &s, e) &&
                 (nodes(&s, ask->points, f) || err_set(e, ERR_NUMBERS,
                                                       "%s: its modes between values of Poisson's ratio "
                                                       "were not found",
                                                       ask->mesh->name));
        ok = ok &&
             (!ask->coarse || mesh_error(ask, ask->material ? ask->material : &middle, &modes[centre], room, f, e));
    }
    arena_close(room);
    return ok;
}

void solid_family_at(const struct solid_family *f, double nu, double *log_ratio, double *slope)
{
    const size_t n = (size_t)f->n;
    if (f->nodes == 1) {
        memcpy(log_ratio, f->log_ratio, n * sizeof *log_ratio);
        memset(slope, 0, n * sizeof *slope);
        return;
    }
    int i = (int)(nu / step);
    i = i < 0 ? 0 : i > f->nodes - 2 ? f->nodes - 2 : i;
    double t = (nu - f->nu[i]) / step, u = 1.0 - t;
    const double *y0 = f->log_ratio + (size_t)i * n, *y1 = y0 + n, *s0 = f->slope + (size_t)i * n, *s1 = s0 + n;
    for (size_t j = 0; j < n; j++) {
        log_ratio[j] =
            u * u * ((1.0 + 2.0 * t) * y0[j] + t * step * s0[j]) + t * t * ((3.0 - 2.0 * t) * y1[j] - u * step * s1[j]);
        slope[j] = 6.0 * t * u * (y1[j] - y0[j]) / step + u * (1.0 - 3.0 * t) * s0[j] + t * (3.0 * t - 2.0) * s1[j];
    }
}
