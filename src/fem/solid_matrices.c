/* Assembly: which nodes share an element gives the pattern, column by column with rising rows; each element's entries
   are then found by bisection. CHOLMOD's matrices (Chen, Davis, Hager and Rajamanickam 2008), lower halves. */
#include "fem/solid_matrices.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fem/solid_element.h"
#include "fem/topology.h"

/* A node is known by the corners that it lies between and its whole numbers there (solid_element.c): elements that
 * share a corner, an edge or a face share its nodes. */

struct key {
    int part[4]; /* rising: corner times 8, plus its whole number; 0: none */
    int place;   /* where in the list of elements; of a known node its number */
};

static int node_compare(const void *x, const void *y)
{
    const struct key *a = (const struct key *)x, *b = (const struct key *)y;
    for (int i = 0; i < 4; i++)
        if (a->part[i] != b->part[i]) return a->part[i] < b->part[i] ? -1 : 1;
    return 0;
}

static int compare_place(const void *x, const void *y)
{
    int order = node_compare(x, y);
    return order ? order : ((const struct key *)x)->place - ((const struct key *)y)->place;
}

static struct key key_of(const int *corner, const int *a, int corners)
{
    struct key k = {{0}, 0};
    for (int i = 0; i < corners; i++) {
        int part = a[i] ? corner[i] * 8 + a[i] : 0, j;
        if (!part) continue;
        for (j = 0; j < 3 && k.part[j + 1] < part; j++)
            k.part[j] = k.part[j + 1];
        k.part[j] = part;
    }
    return k;
}

/* Places [per element] -> numbers of nodes, in the order in which nodes are first met; known: one key for each, sorted.
 * Returns how many. */
static int number(struct key *all, size_t n, int *node, struct key **known, struct arena *a)
{
    int nodes = 0, unique = 0, *first = ARENA_TAKE(a, int, n);
    qsort(all, n, sizeof *all, compare_place);
    for (size_t i = 0, lead = 0; i < n; i++) {
        lead = i > 0 && !node_compare(&all[i], &all[i - 1]) ? lead : i;
        first[all[i].place] = all[lead].place;
    }
    for (size_t p = 0; p < n; p++)
        node[p] = first[p] == (int)p ? nodes++ : node[first[p]];
    *known = arena_take(a, (size_t)nodes, sizeof **known);
    for (size_t i = 0; i < n; i++)
        if (first[all[i].place] == all[i].place) {
            (*known)[unique] = all[i];
            (*known)[unique++].place = node[all[i].place];
        }
    return nodes;
}

static void place(const struct mesh *m, const int element[10], const int a[4], int order, double at[3])
{
    const double l[3] = {(double)a[1] / order, (double)a[2] / order, (double)a[3] / order};
    double value[10], slope[10][3];
    solid_element_shapes(l, value, slope);
    memset(at, 0, 3 * sizeof *at);
    for (int i = 0; i < 10; i++)
        for (int k = 0; k < 3; k++)
            at[k] += value[i] * m->at[element[i]][k];
}

static void lift(struct solid_net *net, struct arena *a)
{
    const struct mesh *m = net->mesh;
    const struct boundary *b = net->boundary;
    const struct solid_lattice *t = &net->lattice;
    size_t n = (size_t)m->elements * (size_t)t->n;
    struct key *all = arena_take(a, n, sizeof *all), *known;
    int *element = ARENA_TAKE(a, int, n), *face = ARENA_TAKE(a, int, (size_t)b->n *(size_t)t->on_face + 1);
    for (size_t i = 0; i < n; i++) {
        all[i] = key_of(m->element[i / (size_t)t->n], t->at[i % (size_t)t->n], 4);
        all[i].place = (int)i;
    }
    net->nodes = number(all, n, element, &known, a);
    net->at = arena_take(a, (size_t)net->nodes, sizeof *net->at);
    for (size_t i = 0; i < n; i++)
        place(m, m->element[i / (size_t)t->n], t->at[i % (size_t)t->n], t->order, net->at[element[i]]);
    for (int i = 0; i < b->n * t->on_face; i++) {
        struct key want = key_of(b->face[i / t->on_face], t->face[i % t->on_face], 3);
        face[i] = ((struct key *)bsearch(&want, known, (size_t)net->nodes, sizeof want, node_compare))->place;
    }
    net->element = element;
    net->face = face;
}

void solid_matrices_net(const struct mesh *m, const struct boundary *b, int order, struct arena *a,
                        struct solid_net *net)
{
    *net = (struct solid_net){.mesh = m, .boundary = b, .lattice = solid_element_lattice(order)};
    if (order > 2)
        lift(net, a);
    else {
        net->nodes = m->nodes;
        net->at = m->at;
        net->element = m->element[0];
        net->face = b->n ? b->face[0] : NULL;
    }
}

/* Faces that are held, as freedoms that are left out.

   Clamped: u = 0 at the face's nodes. Supported: u along the face = 0, u along its normal n is free; at a node of
   several faces n is the mean of their normals there (curved faces meet smoothly). Where one of them leans more than 20
   degrees from the mean, faces meet in an edge: what each holds together is everything. A normal that is an axis leaves
   that axis; any other gets a frame of its own, n and two directions across.

   Rigid motions left over: of the six u = t + w x r those that have nothing along any held direction d. The rows (d, r
   x d), r from the middle of the box in units of its half diagonal, have rank 6 - rigid; squared singular values below
   1e-12 of the largest are zero (files hold normals to about 9 digits). */

struct known_face {
    int corner[3], face; /* corners rising */
};

struct holding {
    const struct solid_net *net;
    struct known_face *known; /* [b->n] sorted */
    double (*normal)[3];      /* [nodes] of supported faces: sum, then mean, unit */
    bool *supported, *clamped;
};

static int face_compare(const void *x, const void *y)
{
    const struct known_face *a = (const struct known_face *)x, *b = (const struct known_face *)y;
    for (int i = 0; i < 3; i++)
        if (a->corner[i] != b->corner[i]) return a->corner[i] < b->corner[i] ? -1 : 1;
    return 0;
}

static void know(struct holding *h, struct arena *a)
{
    const struct boundary *b = h->net->boundary;
    h->known = ARENA_TAKE(a, struct known_face, b->n + 1);
    for (int i = 0; i < b->n; i++) {
        memcpy(h->known[i].corner, b->face[i], sizeof h->known[i].corner);
        topology_rise(h->known[i].corner);
        h->known[i].face = i;
    }
    qsort(h->known, (size_t)b->n, sizeof *h->known, face_compare);
}

static double unit(double v[3])
{
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3 && length > 0.0; k++)
        v[k] /= length;
    return length;
}

/* Unit normal of the curved face at its i-th node: along x_u cross x_v. */
static void normal_at(const struct solid_net *net, int which, int i, double n[3])
{
    const int *part = net->lattice.face[i];
    struct boundary_face_at x;
    boundary_face_at(net->mesh, net->boundary->face[which],
                     (double[2]){(double)part[1] / net->lattice.order, (double)part[2] / net->lattice.order}, &x);
    memcpy(n, x.across, sizeof x.across);
    unit(n);
}

enum step { SUM, LEAN };

/* SUM adds the normal to each node's, or clamps the node; LEAN clamps nodes from whose mean normal the face's leans
 * away. */
static void hold_face(struct holding *h, int which, int hold, enum step step)
{
    const int nodes = h->net->lattice.on_face, *face = h->net->face + (size_t)which * (size_t)nodes;
    const double most = 0.93969262078590838; /* cos 20 degrees */
    for (int i = 0; i < nodes; i++) {
        double n[3];
        if (hold == SOLID_CLAMPED) {
            h->clamped[face[i]] = true;
            continue;
        }
        normal_at(h->net, which, i, n);
        h->supported[face[i]] = true;
        if (step == LEAN && boundary_dot(n, h->normal[face[i]]) < most) h->clamped[face[i]] = true;
        for (int k = 0; k < 3 && step == SUM; k++)
            h->normal[face[i]][k] += n[k];
    }
}

static bool hold_all(struct holding *h, const struct solid_ask *ask, enum step step, struct err *e)
{
    for (int i = 0; i < ask->n_fixed; i++) {
        const struct solid_fixed *fixed = &ask->fixed[i];
        for (int k = 0; k < fixed->n && fixed->hold != SOLID_FREE; k++) {
            struct known_face want = {{0}, 0}, *found;
            memcpy(want.corner, fixed->corner[k], sizeof want.corner);
            topology_rise(want.corner);
            found =
                (struct known_face *)bsearch(&want, h->known, (size_t)h->net->boundary->n, sizeof want, face_compare);
            if (!found) {
                const double *at = h->net->mesh->at[want.corner[0]];
                return err_set(e, ERR_SCENE,
                               "%s: a face that is to be held, at %g %g %g m, is not on the surface of the solid",
                               h->net->mesh->name, at[0], at[1], at[2]);
            }
            hold_face(h, found->face, fixed->hold, step);
        }
    }
    return true;
}

/* n, and two directions across it. Exact axes for a normal that is one (to 1e-9). */
static void frame_of(const double n[3], double d[3][3])
{
    int least = 0;
    for (int k = 1; k < 3; k++)
        least = fabs(n[k]) < fabs(n[least]) ? k : least;
    double axis[3] = {0};
    axis[least] = 1.0;
    memcpy(d[0], n, sizeof d[0]);
    boundary_cross(n, axis, d[1]);
    unit(d[1]);
    boundary_cross(d[0], d[1], d[2]);
}

static int axis_of(const double n[3])
{
    for (int k = 0; k < 3; k++)
        if (fabs(n[k]) > 0.9 && fabs(n[(k + 1) % 3]) < 1e-9 && fabs(n[(k + 2) % 3]) < 1e-9) return k;
    return -1;
}

/* Which directions of a node's frame are free. */
static void free_of(const struct holding *h, int node, struct solid_freedoms *f, int *frames, bool moves[3])
{
    f->frame[node] = -1;
    moves[0] = moves[1] = moves[2] = !h->clamped[node] && !h->supported[node];
    if (h->clamped[node] || !h->supported[node]) return;
    int axis = axis_of(h->normal[node]);
    if (axis >= 0) {
        moves[axis] = true;
        return;
    }
    moves[0] = true;
    f->frame[node] = *frames;
    frame_of(h->normal[node], f->frames[(*frames)++]);
}

static void direction(const struct solid_freedoms *f, int node, int k, double d[3])
{
    memset(d, 0, 3 * sizeof *d);
    d[k] = 1.0;
    if (f->frame[node] >= 0) memcpy(d, f->frames[f->frame[node]][k], 3 * sizeof *d);
}

static int rigid_left(const struct solid_net *net, const struct solid_freedoms *f)
{
    const struct boundary *b = net->boundary;
    double c[6][6] = {{0}}, middle[3], size = 0.0, value[6];
    for (int k = 0; k < 3; k++) {
        middle[k] = 0.5 * (b->low[k] + b->high[k]);
        size += 0.25 * (b->high[k] - b->low[k]) * (b->high[k] - b->low[k]);
    }
    size = sqrt(size);
    for (int i = 0; i < net->nodes; i++)
        for (int k = 0; k < 3; k++) {
            if (f->of[i][k] >= 0) continue;
            double row[6], r[3];
            for (int j = 0; j < 3; j++)
                r[j] = (net->at[i][j] - middle[j]) / size;
            direction(f, i, k, row);
            boundary_cross(r, row, row + 3);
            for (int p = 0; p < 36; p++)
                c[p / 6][p % 6] += row[p / 6] * row[p % 6];
        }
    if (LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'N', 'L', 6, c[0], 6, value) != 0) return -1;
    int rigid = 0;
    for (int i = 0; i < 6; i++)
        rigid += value[i] <= 1e-12 * value[5];
    return rigid;
}

static bool hold(struct holding *h, const struct solid_ask *ask, struct arena *a, struct err *e)
{
    size_t n = (size_t)h->net->nodes;
    h->normal = (double(*)[3])arena_take(a, n, sizeof *h->normal);
    h->supported = ARENA_TAKE(a, bool, n);
    h->clamped = ARENA_TAKE(a, bool, n);
    know(h, a);
    if (!hold_all(h, ask, SUM, e)) return false;
    for (size_t i = 0; i < n; i++)
        if (h->supported[i] && unit(h->normal[i]) < 1e-6) h->clamped[i] = true;
    return hold_all(h, ask, LEAN, e);
}

bool solid_matrices_freedoms(const struct solid_net *net, const struct solid_ask *ask, struct arena *a,
                             struct solid_freedoms *f, struct err *e)
{
    struct holding h = {.net = net};
    int frames = 0;
    if (!hold(&h, ask, a, e)) return false;
    for (int i = 0; i < net->nodes; i++)
        frames += h.supported[i];
    *f = (struct solid_freedoms){.nodes = net->nodes,
                                 .of = (int(*)[3])arena_take(a, (size_t)net->nodes, sizeof *f->of),
                                 .frame = ARENA_TAKE(a, int, net->nodes)};
    f->frames = (double(*)[3][3])arena_take(a, (size_t)frames + 1, sizeof *f->frames);
    frames = 0;
    for (int i = 0; i < net->nodes; i++) {
        bool moves[3];
        free_of(&h, i, f, &frames, moves);
        for (int k = 0; k < 3; k++)
            f->of[i][k] = moves[k] ? f->n++ : -1;
    }
    if (f->n == 0)
        return err_set(e, ERR_SCENE, "%s: every node of the solid is held: leave some of it free, or use a finer mesh",
                       net->mesh->name);
    f->rigid = rigid_left(net, f);
    return true;
}

void solid_matrices_spread(const struct solid_freedoms *f, const double *q, double *u)
{
    memset(u, 0, 3 * (size_t)f->nodes * sizeof *u);
    for (int i = 0; i < f->nodes; i++)
        for (int k = 0; k < 3; k++) {
            double d[3];
            if (f->of[i][k] < 0) continue;
            direction(f, i, k, d);
            for (int j = 0; j < 3; j++)
                u[3 * i + j] += d[j] * q[f->of[i][k]];
        }
}

void solid_matrices_gather(const struct solid_freedoms *f, const double *u, double *q)
{
    for (int i = 0; i < f->nodes; i++)
        for (int k = 0; k < 3; k++) {
            double d[3];
            if (f->of[i][k] < 0) continue;
            direction(f, i, k, d);
            q[f->of[i][k]] = d[0] * u[3 * i] + d[1] * u[3 * i + 1] + d[2] * u[3 * i + 2];
        }
}

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
    int unique = 0;
    for (int i = 0, from = 0; i < m->nodes; i++) {
        int to = g->first[i + 1];
        qsort(g->node + from, (size_t)(to - from), sizeof *g->node, compare);
        g->first[i] = unique;
        for (int k = from; k < to; k++)
            if (k == from || g->node[k] != g->node[k - 1]) g->node[unique++] = g->node[k];
        from = to;
    }
    g->first[m->nodes] = unique;
    return true;
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

bool solid_matrices_open(const struct solid_net *net, const struct elastic *s, const struct solid_freedoms *f,
                         struct solid_matrices *x, struct err *e)
{
    struct graph g;
    memset(x, 0, sizeof *x);
    cholmod_start(&x->common);
    x->common.print = 0;
    x->common.error_handler = NULL;
    x->common.supernodal = CHOLMOD_SUPERNODAL;
    x->common.nmethods = 1;
    x->common.method[0].ordering = CHOLMOD_METIS;
    x->common.postorder = 1;
    if (graph_open(net, &g)) {
        x->k = pattern(&g, f, &x->common);
        x->m = x->k ? cholmod_copy_sparse(x->k, &x->common) : NULL;
    }
    free(g.first);
    free(g.node);
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

/* An array as CHOLMOD wants it. */
static cholmod_dense column_of(double *v, size_t n)
{
    return (cholmod_dense){
        .nrow = n, .ncol = 1, .nzmax = n, .d = n, .x = v, .xtype = CHOLMOD_REAL, .dtype = CHOLMOD_DOUBLE};
}

void solid_matrices_times(struct solid_matrices *x, cholmod_sparse *a, const double *v, double *y)
{
    double one[2] = {1.0, 0.0}, zero[2] = {0.0, 0.0};
    cholmod_dense in = column_of((double *)v, a->ncol), out = column_of(y, a->nrow);
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
