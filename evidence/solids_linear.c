/* Free solids by linear tetrahedra, which `rasp modes compute` does not offer: displacements of quadratic ones whose
   midsides move by the mean of their edge's ends, K_1 = T^T K T. Places are those of the corners, edges straight.

       solids_linear SHAPE MODES       freedoms, CPU seconds, then frequencies (Hz); steel of E 200 GPa, nu 0.3, 7850
   kg/m^3 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fem/shapes.h"
#include "fem/solid_eigen.h"
#include "fem/solid_matrices.h"
#include "fem/topology.h"
#include "num/real.h"

extern void openblas_set_num_threads(int n);

static const int ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

/* of[node][2]: the corners between which it lies, one of them twice for a corner; numbered anew. Returns corners. */
static int corners_of(struct mesh *m, int (*of)[2])
{
    int *number = calloc((size_t)m->nodes, sizeof *number), n = 0;
    for (int p = 0; p < m->elements; p++)
        for (int i = 0; i < 10; i++) {
            const int *e = m->element[p];
            int a = e[i < 4 ? i : ends[i - 4][0]], b = e[i < 4 ? i : ends[i - 4][1]];
            of[e[i]][0] = a;
            of[e[i]][1] = b;
            for (int k = 0; k < 3 && i >= 4; k++)
                m->at[e[i]][k] = 0.5 * (m->at[a][k] + m->at[b][k]);
            if (i < 4 && !number[a]) number[a] = ++n;
        }
    for (int i = 0; i < m->nodes; i++)
        for (int k = 0; k < 2; k++)
            of[i][k] = number[of[i][k]] - 1;
    free(number);
    return n;
}

static cholmod_sparse *raise(const struct mesh *m, int (*of)[2], int corners, cholmod_common *c)
{
    cholmod_triplet *t = cholmod_allocate_triplet((size_t)(3 * m->nodes), (size_t)(3 * corners), (size_t)(6 * m->nodes),
                                                  0, CHOLMOD_REAL, c);
    for (int i = 0; i < 6 * m->nodes; i++, t->nnz++) {
        int node = i / 6, k = i % 3;
        ((int *)t->i)[i] = 3 * node + k;
        ((int *)t->j)[i] = 3 * of[node][i / 3 % 2] + k;
        ((double *)t->x)[i] = 0.5;
    }
    cholmod_sparse *s = cholmod_triplet_to_sparse(t, 0, c);
    cholmod_free_triplet(&t, c);
    return s;
}

/* T^T A T, lower half. */
static cholmod_sparse *reduce(cholmod_sparse *a, cholmod_sparse *t, cholmod_common *c)
{
    cholmod_sparse *whole = cholmod_copy(a, 0, 1, c), *right = cholmod_ssmult(whole, t, 0, 1, 1, c),
                   *left = cholmod_transpose(t, 1, c), *both = cholmod_ssmult(left, right, 0, 1, 1, c);
    cholmod_sparse *lower = cholmod_copy(both, -1, 1, c);
    cholmod_sort(lower, c);
    cholmod_free_sparse(&whole, c);
    cholmod_free_sparse(&right, c);
    cholmod_free_sparse(&left, c);
    cholmod_free_sparse(&both, c);
    return lower;
}

int main(int argc, char **argv)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct mesh m;
    struct boundary b;
    struct elastic steel;
    struct solid_net net;
    struct solid_freedoms f;
    struct solid_matrices x;
    struct solid_pairs p;
    cholmod_factor *factor = NULL;
    int modes = argc == 3 ? atoi(argv[2]) : 0;
    openblas_set_num_threads(1);
    if (modes < 1 || !shapes_mesh(argv[1], a, &m, &e) || !solid_element_isotropic(200e9, 0.3, 7850, &steel, &e)) {
        fprintf(stderr, "solids_linear SHAPE MODES: %s\n", e.text);
        return 1;
    }
    int(*of)[2] = calloc((size_t)m.nodes, sizeof *of), corners = corners_of(&m, of);
    boundary_make(&m, a, &b);
    solid_matrices_net(&m, &b, 2, a, &net);
    struct solid_ask ask = {.material = &steel};
    if (!solid_matrices_freedoms(&net, &ask, a, &f, &e) || !solid_matrices_open(&net, &steel, &f, &x, &e)) {
        fprintf(stderr, "%s\n", e.text);
        return 1;
    }
    cholmod_sparse *t = raise(&m, of, corners, &x.common);
    cholmod_sparse *stiff = reduce(x.k, t, &x.common), *heavy = reduce(x.m, t, &x.common);
    /* K and M of one pattern, as they are asked for: zeros that sums left out are put back */
    double one[2] = {1, 0}, none[2] = {0, 0};
    cholmod_sparse *k = cholmod_add(stiff, heavy, one, none, 1, 1, &x.common),
                   *w = cholmod_add(stiff, heavy, none, one, 1, 1, &x.common);
    x.k = k;
    x.m = x.m_thin = w;
    clock_t start = clock();
    double omega = 2 * REAL_PI * 300;
    if (!solid_eigen(&x, &(struct solid_search){modes + 12, -omega * omega, 0}, &factor, &p, &e)) {
        fprintf(stderr, "%s\n", e.text);
        return 1;
    }
    printf("%d %.2f", 3 * corners, (double)(clock() - start) / CLOCKS_PER_SEC);
    for (int i = 6; i < modes + 6; i++)
        printf(" %.6f", sqrt(p.lambda[i]) / (2 * REAL_PI));
    putchar('\n');
    return 0;
}
