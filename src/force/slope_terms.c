/* Loops over pieces, which leave two multiplications and additions a piece to the recursion in slope.c: on a line over roughness, half the time of
   slope and crossing piece by piece. */
#include "force/slope_terms.h"

#include <math.h>

#include "num/lanes.h"

/* phi = (1 - e^-z) / z and chi = (1 - phi) / z for 0 <= z <= 1/16: the series' first term left out is z^8 / 9! < 1e-15. */
LANES_CLONES
static void terms_leak(struct slope_terms *t, const double *length, double leak, int n)
{
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double z = length[i] / leak, third = z / 3, fifth = z / 5, seventh = z / 7;
        double rest = 1 - third * (1 - z / 4 * (1 - fifth * (1 - 0.5 * third * (1 - seventh * (1 - z / 8)))));
        double phi = 1 - z / 2 * rest;
        t->z[i] = z;
        t->phi[i] = phi;
        t->chi[i] = 0.5 * rest;
        t->kept[i] = 1 - z * phi;
    }
}

LANES_CLONES
static void terms_channel(struct slope_terms *t, const struct way_pieces *p, int channel)
{
    const double *means = p->mean[channel], *moments = p->moment[channel], *limited = p->limited[channel], *length = p->length;
    const int *at = p->at;
    double *bent = t->bent[channel], *leaned = t->leaned[channel], *risen = t->risen[channel], *tilted = t->tilted[channel], *bowed = t->bowed[channel];
    int n = p->n;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        int a = at[i], b = a + 1;
        double h = length[i], z = t->z[i], moment = (1 - z / 2) * h * moments[i];
        bent[i] = t->phi[i] * h * means[i];
        leaned[i] = z * moment;
        risen[i] = t->chi[i] * h * means[i];
        tilted[i] = moment;
        bowed[i] = z * h * (means[i] - 0.5 * (limited[a] + limited[b])) / 60;
    }
}

void slope_terms(struct slope_terms *t, const struct way_pieces *p, int channels, double leak)
{
    terms_leak(t, p->length, leak, p->n);
    for (int k = 0; k < channels; k++)
        terms_channel(t, p, k);
}

LANES_CLONES
void slope_terms_mean(struct slope_terms *t, int n)
{
#pragma omp simd
    for (int i = 0; i < n; i++)
        t->mean[i] = t->phi[i] * t->start[i] + t->risen[0][i] - t->tilted[0][i] + t->bowed[0][i];
}

/* As crossing_slope (force/crossing.c) of each, both outcomes of every question worked out. */
LANES_CLONES
void slope_terms_crossing(struct slope_terms *t, int n)
{
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double a = t->start[i], b = t->end[i], mean = t->mean[i];
        double bow = 6 * (mean - 0.5 * (a + b)), p = b - a + bow, square = p * p + 4 * bow * a;
        double root = sqrt(lanes_select(square > 0, square, 0)), s = lanes_select(p < 0, p - root, p + root);
        double q = lanes_select(s != 0, -2 * a / lanes_select(s != 0, s, 1), 0), late = 0.5 * mean + (b - a) / 12;
        int inside = (q >= 0) & (q <= 1);
        q = lanes_select(inside, q, s / lanes_select(inside | (bow == 0), 1, 2 * bow));
        double before = q * (a + q * (0.5 * p - q * bow / 3)), lately = q * q * (0.5 * a + q * (p / 3 - 0.25 * q * bow));
        int one_sign = a * b >= 0;
        t->whole[i] = lanes_select(one_sign, fabs(mean), fabs(before) + fabs(mean - before));
        t->late[i] = lanes_select(one_sign, lanes_select(mean < 0, -late, late), fabs(lately) + fabs(late - lately));
    }
}
