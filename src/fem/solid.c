/* Free vibration of a solid, in order: its nodes (solid_net), what is held (solid_freedoms), K and M (solid_matrices,
   solid_element), the lowest pairs (solid_eigen), which of them are rigid motions, whether one was missed
   (solid_count), a basis where frequencies are equal (solid_basis), shapes at the nodes.

   The shift. s = -(2 pi f)^2 with f near the lowest frequency: much lower and K - s M of a free solid is nearly
   singular, much higher and Lanczos converges slowly. Bending of a body of thickness h = 2 V/A and length L (the box's
   diagonal) has f = h c/L^2 to within some times, c^2 = (C_xx + C_yy + C_zz)/(3 density); a ball's is 5 times that.
   Taken is 3 h c/L^2; anything from 1 to 10 of it was as fast. */
#include "fem/solid.h"

#include <cblas.h>
#include <math.h>
#include <string.h>

#include "fem/solid_basis.h"
#include "fem/solid_count.h"
#include "fem/solid_eigen.h"
#include "fem/solid_freedoms.h"
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
    return err_set(
        e, ERR_NUMBERS,
        "%s: %d motions of the solid as a whole should cost no energy, and %d were found (lowest modes %.3g and %.3g "
        "Hz): either parts of it are "
        "joined by no more than an edge or a corner, or it is so slender that rounding hides its lowest mode",
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
    long n = solid_count(&w->matrices, w->factor, 0.5 * (p->lambda[gap] + p->lambda[gap + 1]));
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
        solid_freedoms_spread(&w->freedoms, w->pairs.vector + (size_t)(first + i) * w->pairs.freedoms, u);
        solid_basis_sign(u, wide);
    }
}

static bool solve(struct work *w, struct arena *a, struct solid_modes *s, struct err *e)
{
    struct solid_place place = {&w->net, &w->freedoms};
    if (!solid_matrices_open(&w->net, w->ask->material, &w->freedoms, &w->matrices, e) || !pairs_find(w, e))
        return false;
    if (!solid_basis(&w->matrices, &place, w->freedoms.rigid, &w->pairs))
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
    solid_net_make(m, b, ask->order > 2 ? ask->order : 2, a, &w.net);
    if (!solid_freedoms_make(&w.net, ask, a, &w.freedoms, e)) return false;
    bool ok = solve(&w, a, s, e);
    cholmod_free_factor(&w.factor, &w.matrices.common);
    solid_eigen_close(&w.pairs);
    solid_matrices_close(&w.matrices);
    return ok;
}
