/* Loops over pieces, which leave one multiplication and one addition a piece to the recursion in slope.c: on a line
   over roughness, half the time of slope and crossing piece by piece. */
#include "force/slope_terms.h"

#include <math.h>

#include "num/lanes.h"

enum { CROSSING_RUN = 16 };

#define INLINE static inline __attribute__((always_inline))

/* phi = (1 - e^-z) / z and chi = (1 - phi) / z for 0 <= z <= 1/16: the series' first term left out is z^8 / 9! < 1e-15.
 */
LANES_CLONES
static void terms_leak(struct slope_terms *t, const double *length, double leak, int n)
{
    double per_leak = 1 / leak;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double z = length[i] * per_leak, third = z * (1.0 / 3), fifth = z * (1.0 / 5), seventh = z * (1.0 / 7);
        double rest = 1 - third * (1 - z / 4 * (1 - fifth * (1 - 0.5 * third * (1 - seventh * (1 - z / 8)))));
        double phi = 1 - z / 2 * rest;
        t->z[i] = z;
        t->phi[i] = phi;
        t->chi[i] = 0.5 * rest;
        t->kept[i] = 1 - z * phi;
    }
}

/* at: NULL where the pieces are chained, whose points are then loaded one after another. */
INLINE void terms_each(struct slope_terms *t, const struct way_pieces *p, int channel, const int *at)
{
    const double *means = p->mean[channel], *moments = p->moment[channel], *limited = p->limited[channel],
                 *length = p->length;
    double *restrict bent = t->bent[channel];
    int n = p->n;
#pragma omp simd
    for (int i = 0; i < n; i++)
        bent[i] = t->phi[i] * length[i] * means[i] + t->z[i] * ((1 - t->z[i] / 2) * length[i] * moments[i]);
    n = channel == 0 ? n : 0;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        int a = at ? at[i] : i, b = a + 1;
        double h = length[i], z = t->z[i], bow = z * h * (means[i] - 0.5 * (limited[a] + limited[b])) * (1.0 / 60);
        t->risen[i] = t->chi[i] * h * means[i] - (1 - z / 2) * h * moments[i] + bow;
    }
}

LANES_CLONES
static void terms_channel(struct slope_terms *t, const struct way_pieces *p, int channel)
{
    terms_each(t, p, channel, p->at);
}

LANES_CLONES
static void terms_chained(struct slope_terms *t, const struct way_pieces *p, int channel)
{
    terms_each(t, p, channel, NULL);
}

void slope_terms(struct slope_terms *t, const struct way_pieces *p, int channels, double leak)
{
    terms_leak(t, p->length, leak, p->n);
    bool chained = limited_chained(p->n, p->points, p->at);
    for (int k = 0; k < channels; k++)
        if (chained)
            terms_chained(t, p, k);
        else
            terms_channel(t, p, k);
}

LANES_CLONES
void slope_terms_mean(struct slope_terms *t, int n)
{
#pragma omp simd
    for (int i = 0; i < n; i++)
        t->mean[i] = t->phi[i] * t->start[i] + t->risen[i];
}

/* As crossing_slope (force/crossing.c) of each, both outcomes of every question worked out. */
INLINE void crossing_some(struct slope_terms *t, int from, int to)
{
#pragma omp simd
    for (int i = from; i < to; i++) {
        double a = t->start[i], b = t->end[i], mean = t->mean[i];
        double bow = 6 * (mean - 0.5 * (a + b)), p = b - a + bow, square = p * p + 4 * bow * a;
        double root = sqrt(lanes_select(square > 0, square, 0)), s = lanes_select(p < 0, p - root, p + root);
        double q = lanes_select(s != 0, -2 * a / lanes_select(s != 0, s, 1), 0),
               late = 0.5 * mean + (b - a) * (1.0 / 12);
        int inside = (q >= 0) & (q <= 1);
        q = lanes_select(inside, q, s / lanes_select(inside | (bow == 0), 1, 2 * bow));
        double before = q * (a + q * (0.5 * p - q * bow * (1.0 / 3))),
               lately = q * q * (0.5 * a + q * (p * (1.0 / 3) - 0.25 * q * bow));
        int one_sign = a * b >= 0;
        t->whole[i] = lanes_select(one_sign, fabs(mean), fabs(before) + fabs(mean - before));
        t->late[i] = lanes_select(one_sign, lanes_select(mean < 0, -late, late), fabs(lately) + fabs(late - lately));
    }
}

/* The same where no piece has a zero; false, and worth nothing, where one has. */
INLINE bool crossing_none(struct slope_terms *t, int from, int to)
{
    int some = 0;
#pragma omp simd reduction(| : some)
    for (int i = from; i < to; i++) {
        double a = t->start[i], b = t->end[i], mean = t->mean[i], late = 0.5 * mean + (b - a) * (1.0 / 12);
        some |= a * b < 0;
        t->whole[i] = fabs(mean);
        t->late[i] = lanes_select(mean < 0, -late, late);
    }
    return !some;
}

/* Root and divisions are for the few runs of pieces in which the slope changes its sign. */
LANES_CLONES
void slope_terms_crossing(struct slope_terms *t, int n)
{
    for (int from = 0; from < n; from += CROSSING_RUN) {
        int to = from + CROSSING_RUN < n ? from + CROSSING_RUN : n;
        if (!crossing_none(t, from, to)) crossing_some(t, from, to);
    }
}
