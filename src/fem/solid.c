/* Free vibration of a solid, in order: its nodes, what is held, K and M (solid_matrices, solid_element), the lowest
   pairs (solid_eigen), which of them are rigid motions, whether one was missed (solid_eigen_count), a basis where
   frequencies are equal (solid_eigen_basis), shapes at the nodes.

   The shift. s = -(2 pi f)^2 with f near the lowest frequency: much lower and K - s M of a free solid is nearly
   singular, much higher and Lanczos converges slowly. Bending of a body of thickness h = 2 V/A and length L (the box's
   diagonal) has f = h c/L^2 to within some times, c^2 = (C_xx + C_yy + C_zz)/(3 density); a ball's is 5 times that.
   Taken is 3 h c/L^2; anything from 1 to 10 of it was as fast. */
#include "fem/solid.h"

#include <cblas.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "fem/solid_eigen.h"
#include "fem/solid_matrices.h"
#include "num/real.h"

/* Pairs more than wanted: clusters and the count want what follows. Six equal values of 0 come one after the other, by
 * rounding: few pairs are done before they have. */
enum { BEYOND = 6, LEAST = 30 };

struct work {
    const struct mesh *mesh;
    const struct boundary *boundary;
    const struct solid_ask *ask;
    struct solid_net net;
    struct solid_freedoms freedoms;
    struct solid_matrices matrices;
    struct solid_pairs pairs;
    cholmod_factor *factor;
    double top; /* rad^2/s^2 */
};

static double shift_of(const struct work *w)
{
    const struct boundary *b = w->boundary;
    const struct elastic *s = w->ask->material;
    double diagonal = 0.0, c = sqrt((s->c[0][0] + s->c[1][1] + s->c[2][2]) / (3.0 * s->density));
    for (int k = 0; k < 3; k++)
        diagonal += (b->high[k] - b->low[k]) * (b->high[k] - b->low[k]);
    double omega = 2.0 * REAL_PI * 3.0 * c * 2.0 * b->volume / (b->area * diagonal);
    return -omega * omega;
}

/* Pairs that cost no energy. */
static int rigid_found(const struct work *w)
{
    int still = 0;
    while (still < w->pairs.n && w->pairs.lambda[still] < 1e-6 * w->pairs.lambda[w->freedoms.rigid])
        still++;
    return still;
}

/* As many rigid motions as there must be, and a gap above them. */
static bool rigid_agree(const struct work *w, struct err *e)
{
    const double *lambda = w->pairs.lambda;
    int rigid = w->freedoms.rigid, still = rigid_found(w);
    if (still == rigid && lambda[rigid] > 0.0 &&
        (rigid + 1 >= w->pairs.n || lambda[rigid] > 1e-9 * lambda[w->pairs.n - 1]))
        return true;
    return err_set(e, ERR_NUMBERS,
                   "%s: %d motions of the solid as a whole should cost no energy, and %d were found (lowest modes %.3g "
                   "and %.3g Hz): either parts of it are joined by no more than an edge or a corner, or it is so "
                   "slender that rounding hides its lowest mode (are sizes in the units that are meant?)",
                   w->mesh->name, rigid, still, sqrt(fmax(lambda[0], 0.0)) / (2.0 * REAL_PI),
                   sqrt(fmax(lambda[rigid], 0.0)) / (2.0 * REAL_PI));
}

static int below_top(const struct work *w)
{
    int n = w->freedoms.rigid;
    while (n < w->pairs.n && w->pairs.lambda[n] < w->top)
        n++;
    return n;
}

/* The first gap after pair `from` that rounding cannot blur; where there is none, the widest. */
static int gap_after(const struct solid_pairs *p, int from)
{
    int widest = from;
    for (int i = from; i + 1 < p->n; i++) {
        double gap = p->lambda[i + 1] - p->lambda[i];
        if (gap > 1e-5 * p->lambda[i + 1]) return i;
        widest = gap > p->lambda[widest + 1] - p->lambda[widest] ? i : widest;
    }
    return widest;
}

/* Sylvester's count in a gap just above what is wanted. 0: it agrees; above 0: so many pairs are missing; -1: no
 * memory. */
static long missing(struct work *w)
{
    const struct solid_pairs *p = &w->pairs;
    int below = below_top(w), wanted = w->freedoms.rigid + w->ask->most, from = (below < wanted ? below : wanted) - 1;
    if (!w->factor || p->n < 2) return 0;
    from = from < 0 ? 0 : from;
    int gap = gap_after(p, from < p->n - 2 ? from : p->n - 2);
    int threads = openblas_get_num_threads();
    openblas_set_num_threads(1);
    long n = solid_eigen_count(&w->matrices, w->factor, 0.5 * (p->lambda[gap] + p->lambda[gap + 1]));
    openblas_set_num_threads(threads);
    return n < 0 ? -1 : n > gap + 1 ? n - (gap + 1) : 0;
}

/* Pairs that nothing is missing from: where the count says otherwise, once more with another start and more pairs. */
static bool pairs_find(struct work *w, struct err *e)
{
    long short_of = 0;
    int least = w->freedoms.rigid + w->ask->most + BEYOND;
    for (unsigned attempt = 0; attempt < 3; attempt++) {
        struct solid_search search = {(least > LEAST ? least : LEAST) + (int)short_of, shift_of(w), attempt};
        search.want = search.want < w->freedoms.n ? search.want : w->freedoms.n;
        solid_eigen_close(&w->pairs);
        if (!solid_eigen(&w->matrices, &search, &w->factor, &w->pairs, e)) return false;
        if (w->pairs.n <= w->freedoms.rigid)
            return err_set(e, ERR_SCENE, "%s: the mesh has %d freedoms, too few for a mode that bends: use a finer one",
                           w->mesh->name, w->freedoms.n);
        short_of = w->freedoms.rigid - rigid_found(w);
        if (short_of > 0 && attempt < 2) continue;
        if (!rigid_agree(w, e)) return false;
        if (below_top(w) <= w->freedoms.rigid)
            return err_set(e, ERR_SCENE, "%s: no mode below %g Hz: the lowest is at %.6g Hz", w->mesh->name,
                           w->ask->top, sqrt(w->pairs.lambda[w->freedoms.rigid]) / (2.0 * REAL_PI));
        short_of = missing(w);
        if (short_of == 0) return true;
        if (short_of < 0) return solid_matrices_no_memory((size_t)w->freedoms.n, e);
    }
    return err_set(e, ERR_NUMBERS,
                   "%s: %ld modes are missing from those that were found; a slightly other mesh may help",
                   w->mesh->name, short_of);
}

static void give(struct work *w, struct arena *a, struct solid_modes *s)
{
    int first = w->freedoms.rigid, below = below_top(w) - first;
    size_t wide = 3 * (size_t)w->net.nodes;
    *s = (struct solid_modes){.n = below < w->ask->most ? below : w->ask->most,
                              .rigid = first,
                              .nodes = w->net.nodes,
                              .lattice = w->net.lattice,
                              .face = w->net.face,
                              .mass = w->matrices.mass,
                              .freedoms = w->freedoms.n};
    s->all = below <= w->ask->most && (below + first < w->pairs.n || w->pairs.n == w->freedoms.n);
    s->residual = solid_eigen_residual(&w->matrices, &w->pairs, first, s->n);
    s->lambda = ARENA_TAKE(a, double, s->n);
    s->shape = ARENA_TAKE(a, double, (size_t)s->n *wide);
    memcpy(s->lambda, w->pairs.lambda + first, (size_t)s->n * sizeof *s->lambda);
    for (int i = 0; i < s->n; i++) {
        double *u = s->shape + (size_t)i * wide;
        solid_matrices_spread(&w->freedoms, w->pairs.vector + (size_t)(first + i) * w->pairs.freedoms, u);
        solid_eigen_sign(u, wide);
    }
}

static bool solve(struct work *w, struct arena *a, struct solid_modes *s, struct err *e)
{
    struct solid_place place = {&w->net, &w->freedoms};
    if (!solid_matrices_open(&w->net, w->ask->material, &w->freedoms, &w->matrices, e) || !pairs_find(w, e))
        return false;
    if (!solid_eigen_basis(&w->matrices, &place, w->freedoms.rigid, &w->pairs))
        return solid_matrices_no_memory((size_t)w->freedoms.n, e);
    give(w, a, s);
    if (!(s->residual < 1e-4))
        return err_set(e, ERR_NUMBERS,
                       "%s: the modes found do not solve the equations (|K u - lambda M u| is %.2g of |lambda M u|): "
                       "look for elements that are nearly flat",
                       w->mesh->name, s->residual);
    return true;
}

bool solid_modes(const struct mesh *m, const struct boundary *b, const struct solid_ask *ask, struct arena *a,
                 struct solid_modes *s, struct err *e)
{
    struct work w = {.mesh = m, .boundary = b, .ask = ask, .top = 4.0 * REAL_PI * REAL_PI * ask->top * ask->top};
    solid_matrices_net(m, b, ask->order > 2 ? ask->order : 2, a, &w.net);
    if (!solid_matrices_freedoms(&w.net, ask, a, &w.freedoms, e)) return false;
    bool ok = solve(&w, a, s, e);
    cholmod_free_factor(&w.factor, &w.matrices.common);
    solid_eigen_close(&w.pairs);
    solid_matrices_close(&w.matrices);
    return ok;
}

void solid_participation(const struct solid_modes *s, const struct boundary_point *p, double *phi)
{
    double w[SOLID_LATTICE_FACE];
    const int nodes = s->lattice.on_face, *face = s->face + (long)p->face * nodes;
    solid_element_lattice_face(&s->lattice, p->u, p->v, w);
    for (int i = 0; i < s->n; i++) {
        phi[i] = 0;
        for (int k = 0; k < nodes; k++) {
            const double *u = s->shape + 3 * (s->nodes * i + face[k]);
            phi[i] -= w[k] * (u[0] * p->normal[0] + u[1] * p->normal[1] + u[2] * p->normal[2]);
        }
    }
}

/* Richardson's extrapolation: where frequencies converge with the power q of the cells' length h, two meshes of lengths
   h and r h give

       f_coarse - f = (r^q - 1) (f - f_true)   and so   error = (f_coarse - f)/(r^q - 1).

   Smooth modes of order p on flat cells have q = 2 p; places are quadratic, which on curved surfaces leaves about 4 for
   any p; a held edge beside a free one is a singularity, and leaves 1 to 2. Taken is 4: on flat solids of order 3 and 4
   the estimate is too large, at singular edges too small. Cells that are as long in both meshes (one through a thin
   wall) tell nothing of their error.

   Pairs: a fine mode u is fitted by coarse ones near it in frequency, u ~ sum c_k v_k, at points spread over the
   surface (least squares, all three components). Paired is what is fitted to half of its square; f_coarse^2 is then the
   mean of the coarse modes' squares by c_k^2 (of those above a tenth of the greatest: what is smaller is the meshes'
   difference, not a part of the mode). Modes of equal frequency, of which a coarse mesh may hold any basis, are paired
   that way too. */

enum { POINTS = 150, ROWS = 3 * POINTS, NEAR = 16 };

static const double fitted = 0.5, part = 0.1;

static double longest_edges(const struct mesh *m)
{
    double sum = 0.0;
    for (int p = 0; p < m->elements; p++) {
        double most = 0.0;
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < i; j++) {
                double square = 0.0;
                for (int k = 0; k < 3; k++) {
                    double d = m->at[m->element[p][i]][k] - m->at[m->element[p][j]][k];
                    square += d * d;
                }
                most = fmax(most, square);
            }
        sum += sqrt(most);
    }
    return sum / m->elements;
}

/* Displacement of every mode at points of the surface, [modes][ROWS]. */
static void move(const struct solid_side *s, const struct boundary_point *at, int point, double *u)
{
    const struct solid_modes *m = s->modes;
    double w[SOLID_LATTICE_FACE];
    const int *face = m->face + (long)at->face * m->lattice.on_face;
    solid_element_lattice_face(&m->lattice, at->u, at->v, w);
    for (int i = 0; i < m->n; i++)
        for (int j = 0; j < m->lattice.on_face; j++)
            for (int k = 0; k < 3; k++)
                u[(long)i * ROWS + 3 * point + k] += w[j] * m->shape[3 * (m->nodes * i + face[j]) + k];
}

static void move_all(const struct solid_side *fine, const struct solid_side *coarse, double *u, double *v)
{
    const struct boundary *b = fine->boundary;
    for (int i = 0; i < POINTS; i++) {
        struct boundary_point here = {.face = (int)((long)b->n * i / POINTS), .u = 0.2, .v = 0.3}, there;
        double w[6], at[3] = {0};
        boundary_weights(here.u, here.v, w);
        for (int j = 0; j < 6; j++)
            for (int k = 0; k < 3; k++)
                at[k] += w[j] * fine->mesh->at[b->face[here.face][j]][k];
        boundary_nearest(coarse->mesh, coarse->boundary, at, &there);
        move(fine, &here, i, u);
        move(coarse, &there, i, v);
    }
}

/* The first of the coarse modes that may be a mode's pair. */
static int nearest(const struct solid_modes *coarse, double lambda, int near)
{
    int first = 0;
    while (first + near < coarse->n &&
           fabs(coarse->lambda[first + near] - lambda) < fabs(coarse->lambda[first] - lambda))
        first++;
    return first;
}

/* lambda of the coarse modes that u is made of; NAN: of none. */
static double pair(const struct solid_modes *coarse, const double *v, const double *u, double lambda)
{
    int near = coarse->n < NEAR ? coarse->n : NEAR, first = nearest(coarse, lambda, near);
    double a[NEAR * ROWS], b[ROWS], all = 0.0, rest = 0.0, most = 0.0, sum = 0.0, weight = 0.0;
    memcpy(a, v + (long)first * ROWS, (size_t)near * ROWS * sizeof *a);
    memcpy(b, u, sizeof b);
    if (LAPACKE_dgels(LAPACK_COL_MAJOR, 'N', ROWS, near, 1, a, ROWS, b, ROWS) != 0) return NAN;
    for (int i = 0; i < ROWS; i++) {
        all += u[i] * u[i];
        rest += i >= near ? b[i] * b[i] : 0.0;
    }
    for (int k = 0; k < near; k++)
        most = fmax(most, b[k] * b[k]);
    for (int k = 0; k < near; k++)
        if (b[k] * b[k] > part * most) {
            sum += b[k] * b[k] * coarse->lambda[first + k];
            weight += b[k] * b[k];
        }
    return rest < fitted * all ? sum / weight : NAN;
}

static void sum_up(int n, struct solid_estimate *s, struct arena *a)
{
    double *size = ARENA_TAKE(a, double, n);
    int paired = 0;
    s->median = s->most = NAN;
    for (int i = 0; i < n; i++) {
        if (isnan(s->error[i])) continue;
        size[paired++] = fabs(s->error[i]);
        if (!(fabs(s->error[i]) <= s->most)) {
            s->most = fabs(s->error[i]);
            s->worst = i;
        }
    }
    s->unpaired = n - paired;
    if (paired == 0) return;
    gsl_sort(size, 1, (size_t)paired);
    s->median = gsl_stats_median_from_sorted_data(size, 1, (size_t)paired);
}

void solid_estimate(const struct solid_side *fine, const struct solid_side *coarse, struct arena *a,
                    struct solid_estimate *s)
{
    int n = fine->modes->n;
    double *u = ARENA_TAKE(a, double, (long)n *ROWS), *v = ARENA_TAKE(a, double, (long)coarse->modes->n *ROWS);
    *s = (struct solid_estimate){.ratio = longest_edges(coarse->mesh) / longest_edges(fine->mesh),
                                 .error = ARENA_TAKE(a, double, n)};
    s->share = fine->mesh->at == coarse->mesh->at ? 1.0 : 1.0 / (s->ratio * s->ratio * s->ratio * s->ratio - 1.0);
    move_all(fine, coarse, u, v);
    for (int i = 0; i < n; i++) {
        double lambda = fine->modes->lambda[i];
        s->error[i] = s->share * (sqrt(pair(coarse->modes, v, u + (long)i * ROWS, lambda) / lambda) - 1.0);
    }
    sum_up(n, s, a);
}
