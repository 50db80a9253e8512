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
#include "fem/solid_estimate.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

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
    solid_lattice_face(&m->lattice, at->u, at->v, w);
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

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
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
    qsort(size, (size_t)paired, sizeof *size, compare);
    if (paired) s->median = 0.5 * (size[(paired - 1) / 2] + size[paired / 2]);
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
