/* Assembly: which nodes share an element gives the pattern, column by column with rising rows; each element's entries
   are then found by bisection. CHOLMOD's matrices (Chen, Davis, Hager and Rajamanickam 2008), lower halves. */
#include "fem/solid_matrices.h"

#include <stdlib.h>
#include <string.h>

#include "fem/solid_element.h"

struct graph {
    int *first, *node; /* [nodes + 1]; neighbours of node i, itself included, not below i: node[first[i]] ..
                          node[first[i + 1] - 1], rising */
};

static int compare(const void *a, const void *b)
{
    int x = *(const int *)a, y = *(const int *)b;
    return (x > y) - (x < y);
}

/* Pairs of nodes of elements, sorted into rows; then each row without doubles. */
static bool graph_open(const struct solid_net *m, struct graph *g)
{
    int n = m->lattice.n;
    g->first = (int *)calloc((size_t)m->nodes + 2, sizeof *g->first);
    g->node = (int *)malloc((size_t)(n * (n + 1) / 2) * (size_t)m->mesh->elements * sizeof *g->node);
    if (!g->first || !g->node) return false;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < m->nodes && pass; i++)
            g->first[i + 2] += g->first[i + 1];
        for (int p = 0; p < m->mesh->elements; p++)
            for (int q = 0; q < n * n; q++) {
                int i = m->element[p * n + q / n], j = m->element[p * n + q % n];
                if (j < i) continue;
                if (pass)
                    g->node[g->first[i + 1]++] = j;
                else
                    g->first[i + 2]++;
            }
    }
    int kept = 0;
    for (int i = 0, from = 0; i < m->nodes; i++) {
        int to = g->first[i + 1];
        qsort(g->node + from, (size_t)(to - from), sizeof *g->node, compare);
        g->first[i] = kept;
        for (int k = from; k < to; k++)
            if (k == from || g->node[k] != g->node[k - 1]) g->node[kept++] = g->node[k];
        from = to;
    }
    g->first[m->nodes] = kept;
    return true;
}

static void graph_close(struct graph *g)
{
    free(g->first);
    free(g->node);
}

/* Rows of the columns of node i; counts only where there is no matrix yet. */
static size_t fill(const struct graph *g, const struct solid_freedoms *f, cholmod_sparse *a)
{
    size_t n = 0;
    for (int i = 0; i < f->nodes; i++)
        for (int c = 0; c < 3; c++) {
            int column = f->of[i][c];
            if (column < 0) continue;
            if (a) ((int *)a->p)[column] = (int)n;
            for (int k = g->first[i]; k < g->first[i + 1]; k++)
                for (int r = 0; r < 3; r++) {
                    int row = f->of[g->node[k]][r];
                    if (row < column) continue;
                    if (a) ((int *)a->i)[n] = row;
                    n++;
                }
        }
    if (a) ((int *)a->p)[f->n] = (int)n;
    return n;
}

static cholmod_sparse *pattern(const struct graph *g, const struct solid_freedoms *f, cholmod_common *c)
{
    size_t n = fill(g, f, NULL);
    if (n > 0x7fffffff) return NULL;
    cholmod_sparse *a = cholmod_allocate_sparse((size_t)f->n, (size_t)f->n, n, 1, 1, -1, CHOLMOD_REAL, c);
    if (a) {
        fill(g, f, a);
        memset(a->x, 0, n * sizeof(double));
    }
    return a;
}

static double *entry(cholmod_sparse *a, int row, int column)
{
    const int *rows = (const int *)a->i;
    int low = ((int *)a->p)[column], high = ((int *)a->p)[column + 1] - 1;
    while (low < high) {
        int middle = low + (high - low) / 2;
        if (rows[middle] < row)
            low = middle + 1;
        else
            high = middle;
    }
    return (double *)a->x + low;
}

/* Where nodes have frames of their own: block <- R_p block R_q^T. */
static void turn_block(const double (*left)[3], const double (*right)[3], double block[3][3])
{
    double t[3][3];
    for (int i = 0; i < 9 && left; i++)
        t[i / 3][i % 3] =
            left[i / 3][0] * block[0][i % 3] + left[i / 3][1] * block[1][i % 3] + left[i / 3][2] * block[2][i % 3];
    if (left) memcpy(block, t, sizeof t);
    for (int i = 0; i < 9 && right; i++)
        t[i / 3][i % 3] =
            right[i % 3][0] * block[i / 3][0] + right[i % 3][1] * block[i / 3][1] + right[i % 3][2] * block[i / 3][2];
    if (right) memcpy(block, t, sizeof t);
}

static const double (*frame(const struct solid_freedoms *f, int node))[3]
{
    return f->frame[node] < 0 ? NULL : (const double(*)[3])f->frames[f->frame[node]];
}

/* The 3 x 3 block of two nodes into the lower half. */
static void add_block(const struct solid_freedoms *f, const int node[2], double block[3][3], cholmod_sparse *a)
{
    turn_block(frame(f, node[0]), frame(f, node[1]), block);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int row = f->of[node[0]][i], column = f->of[node[1]][j];
            if (column >= 0 && row >= column) *entry(a, row, column) += block[i][j];
        }
}

struct part {
    int n;
    const int *node;
    struct solid_element element;
};

static void add_element(const struct part *e, const struct solid_freedoms *f, struct solid_matrices *all)
{
    const struct solid_element *x = &e->element;
    for (int p = 0; p < e->n * e->n; p++) {
        int a = p / e->n, b = p % e->n;
        const int pair[2] = {e->node[a], e->node[b]};
        double k[3][3], m[3][3] = {{0}};
        if (pair[0] < pair[1]) continue;
        for (int i = 0; i < 3; i++) {
            memcpy(k[i], &x->k[3 * a + i][3 * b], sizeof k[i]);
            m[i][i] = x->m[a][b];
        }
        add_block(f, pair, k, all->k);
        add_block(f, pair, m, all->m);
        all->mass += (pair[0] == pair[1] ? 1.0 : 2.0) * x->m[a][b];
    }
}

static bool add_all(const struct solid_net *net, const struct elastic *s, const struct solid_freedoms *f,
                    struct solid_matrices *x, struct err *e)
{
    const struct mesh *m = net->mesh;
    struct part part = {.n = net->lattice.n};
    for (int p = 0; p < m->elements; p++) {
        double at[10][3];
        part.node = net->element + (size_t)p * (size_t)part.n;
        for (int a = 0; a < 10; a++)
            memcpy(at[a], m->at[m->element[p][a]], sizeof at[a]);
        if (!solid_element_make((const double(*)[3])at, &net->lattice, s, &part.element))
            return err_set(e, ERR_SCENE, "%s: element %d, at %g %g %g m, is turned inside out or has no volume",
                           m->name, p + 1, at[0][0], at[0][1], at[0][2]);
        add_element(&part, f, x);
    }
    return true;
}

static void start(cholmod_common *c)
{
    cholmod_start(c);
    c->print = 0;
    c->error_handler = NULL;
    c->supernodal = CHOLMOD_SUPERNODAL;
    c->nmethods = 1;
    c->method[0].ordering = CHOLMOD_METIS;
    c->postorder = 1;
}

bool solid_matrices_open(const struct solid_net *net, const struct elastic *s, const struct solid_freedoms *f,
                         struct solid_matrices *x, struct err *e)
{
    struct graph g;
    memset(x, 0, sizeof *x);
    start(&x->common);
    if (graph_open(net, &g)) {
        x->k = pattern(&g, f, &x->common);
        x->m = x->k ? cholmod_copy_sparse(x->k, &x->common) : NULL;
    }
    graph_close(&g);
    if (!x->m) return solid_matrices_no_memory((size_t)f->n, e);
    if (!add_all(net, s, f, x, e)) return false;
    x->m_thin = cholmod_copy_sparse(x->m, &x->common);
    if (!x->m_thin || !cholmod_drop(0.0, x->m_thin, &x->common)) return solid_matrices_no_memory((size_t)f->n, e);
    return true;
}

void solid_matrices_close(struct solid_matrices *x)
{
    cholmod_free_sparse(&x->k, &x->common);
    cholmod_free_sparse(&x->m, &x->common);
    cholmod_free_sparse(&x->m_thin, &x->common);
    cholmod_finish(&x->common);
}

cholmod_sparse *solid_matrices_shifted(struct solid_matrices *x, double shift)
{
    cholmod_sparse *a = cholmod_copy_sparse(x->k, &x->common);
    size_t n = (size_t)((int *)x->k->p)[x->k->ncol];
    for (size_t i = 0; a && i < n; i++)
        ((double *)a->x)[i] -= shift * ((const double *)x->m->x)[i];
    return a;
}

cholmod_dense solid_matrices_column(double *v, size_t n)
{
    return (cholmod_dense){
        .nrow = n, .ncol = 1, .nzmax = n, .d = n, .x = v, .xtype = CHOLMOD_REAL, .dtype = CHOLMOD_DOUBLE};
}

void solid_matrices_times(struct solid_matrices *x, cholmod_sparse *a, const double *v, double *y)
{
    double one[2] = {1.0, 0.0}, zero[2] = {0.0, 0.0};
    cholmod_dense in = solid_matrices_column((double *)v, a->ncol), out = solid_matrices_column(y, a->nrow);
    cholmod_sdmult(a, 0, one, zero, &in, &out, &x->common);
}

void solid_matrices_times_block(const cholmod_sparse *a, const double *v, double *y, double *room)
{
    enum { WIDE = SOLID_MATRICES_WIDE };
    const int *p = (const int *)a->p, *row = (const int *)a->i;
    size_t n = a->ncol;
    double *in = room, *out = room + n * WIDE; /* [n][WIDE] */
    for (size_t i = 0; i < n * WIDE; i++)
        in[i] = v[i % WIDE * n + i / WIDE];
    memset(out, 0, n * WIDE * sizeof *out);
    for (size_t c = 0; c < n; c++) {
        double sum[WIDE] = {0}, *at = in + c * WIDE;
        for (int i = p[c]; i < p[c + 1]; i++) {
            double *from = in + (size_t)row[i] * WIDE, *to = out + (size_t)row[i] * WIDE, x = ((const double *)a->x)[i],
                   mirrored = (size_t)row[i] == c ? 0.0 : x;
            for (int j = 0; j < WIDE; j++) {
                sum[j] += x * from[j];
                to[j] += mirrored * at[j];
            }
        }
        for (int j = 0; j < WIDE; j++)
            out[c * WIDE + j] += sum[j];
    }
    for (size_t i = 0; i < n * WIDE; i++)
        y[i % WIDE * n + i / WIDE] = out[i];
}

bool solid_matrices_no_memory(size_t freedoms, struct err *e)
{
    return err_set(e, ERR_SCENE,
                   "a solid of %zu freedoms is too large for the memory: use a coarser mesh, or ask for fewer modes",
                   freedoms);
}
