/* See resonator_group.h. */
#include "convolution/resonator_group.h"

#define INLINE static inline __attribute__((always_inline))

enum { SPAN = 4 }; /* samples per visit to a group */

/* What changes of one mode in a sample, and how. */
struct lane {
    double zr, zi, gr, gi, pr, pi, sr, si, psr, psi;
};

INLINE double lane_step(struct lane *v, double f, enum resonator_change change)
{
    if (change != RESONATOR_STEADY) {
        v->gr += v->sr;
        v->gi += v->si;
    }
    if (change == RESONATOR_GLIDES) {
        v->pr += v->psr;
        v->pi += v->psi;
    }
    double zr = v->pr * v->zr - (v->pi * v->zi - v->gr * f);
    v->zi = v->pr * v->zi + (v->pi * v->zr + v->gi * f);
    v->zr = zr;
    return v->zi;
}

INLINE struct lane lane_take(const struct resonator_group *g, int l, enum resonator_change change)
{
    struct lane v = {g->zr[l], g->zi[l], g->gr[l], g->gi[l], g->pr[l], g->pi[l], g->sr[l], g->si[l], 0, 0};
    if (change == RESONATOR_GLIDES) {
        v.psr = g->psr[l];
        v.psi = g->psi[l];
    }
    return v;
}

INLINE void lane_keep(struct resonator_group *g, int l, const struct lane *v, enum resonator_change change)
{
    g->zr[l] = v->zr;
    g->zi[l] = v->zi;
    if (change != RESONATOR_STEADY) {
        g->gr[l] = v->gr;
        g->gi[l] = v->gi;
    }
    if (change == RESONATOR_GLIDES) {
        g->pr[l] = v->pr;
        g->pi[l] = v->pi;
    }
}

/* Adds the lanes' Im z of `n` samples to sums[n][LANES]. */
INLINE void ring_all(struct resonator_group *const *active, int n_active, const double *restrict f,
                     double (*restrict sums)[LANES], int n, enum resonator_change change)
{
    int i = 0;
    for (; i + SPAN <= n; i += SPAN) {
        for (int k = 0; k < n_active; k++) {
            struct resonator_group *restrict g = active[k];
#pragma omp simd
            for (int l = 0; l < LANES; l++) {
                struct lane v = lane_take(g, l, change);
                sums[i][l] += lane_step(&v, f[i], change);
                sums[i + 1][l] += lane_step(&v, f[i + 1], change);
                sums[i + 2][l] += lane_step(&v, f[i + 2], change);
                sums[i + 3][l] += lane_step(&v, f[i + 3], change);
                lane_keep(g, l, &v, change);
            }
        }
    }
    for (; i < n; i++) {
        for (int k = 0; k < n_active; k++) {
            struct resonator_group *restrict g = active[k];
#pragma omp simd
            for (int l = 0; l < LANES; l++) {
                struct lane v = lane_take(g, l, change);
                sums[i][l] += lane_step(&v, f[i], change);
                lane_keep(g, l, &v, change);
            }
        }
    }
}

LANES_CLONES
static void ring_steady(struct resonator_group *const *active, int n_active, const double *restrict f,
                        double (*restrict sums)[LANES], int n)
{
    ring_all(active, n_active, f, sums, n, RESONATOR_STEADY);
}

LANES_CLONES
static void ring(struct resonator_group *const *active, int n_active, const double *restrict f,
                 double (*restrict sums)[LANES], int n)
{
    ring_all(active, n_active, f, sums, n, RESONATOR_RAMPS);
}

LANES_CLONES
static void ring_gliding(struct resonator_group *const *active, int n_active, const double *restrict f,
                         double (*restrict sums)[LANES], int n)
{
    ring_all(active, n_active, f, sums, n, RESONATOR_GLIDES);
}

void resonator_group_ring(struct resonator_group *const *active, int n_active, const double *f, double (*sums)[LANES],
                          int n, enum resonator_change change)
{
    (change == RESONATOR_GLIDES   ? ring_gliding
     : change == RESONATOR_STEADY ? ring_steady
                                  : ring)(active, n_active, f, sums, n);
}
