/* See radiator_panels.h. e^(j k x) over a panel of width W needs about W k / 2 points of Gauss-Legendre's rule, and
   then each one more takes the error down by orders of magnitude: 12 points over 4 pi of phase leave 4e-12. A
   singularity j d above or below the panel's middle leaves about (u + sqrt(u^2 + 1))^(-24), u = 2 d / W: 7e-10 at d =
   W/2. */
#include "response/radiator_panels.h"

#include <math.h>

#include "num/real.h"

/* Nodes and weights on [-1, 1] by Newton's method on Legendre's polynomial; its start is within the reach of the root
 * next to it. */
static void rule(int n, double *x, double *w)
{
    for (int k = 0; k < n; k++) {
        double at = real_cospi((k + 0.75) / (n + 0.5)), slope = 1;
        for (int step = 0; step < 8; step++) {
            double p = at, before = 1;
            for (int j = 2; j <= n; j++) {
                double next = ((2 * j - 1) * at * p - (j - 1) * before) / j;
                before = p;
                p = next;
            }
            slope = n * (at * p - before) / (at * at - 1);
            at -= p / slope;
        }
        x[k] = at;
        w[k] = 2 / ((1 - at * at) * slope * slope);
    }
}

static double far_of(const struct radiator_panels *x, double low, double high)
{
    double beside = x->foot < low ? low - x->foot : x->foot > high ? x->foot - high : 0;
    return sqrt(beside * beside + x->height * x->height);
}

bool radiator_panels_split(struct radiator_panels *x, double low, double high)
{
    if (x->n == RADIATOR_PANELS_MOST) return false;
    double middle = 0.5 * (low + high), width = high - low;
    if (width * x->wave > 4 * REAL_PI || width > 2 * far_of(x, low, high))
        return middle > low && middle < high && radiator_panels_split(x, low, middle) &&
               radiator_panels_split(x, middle, high);
    x->ends[x->n++] = low;
    x->ends[x->n] = high;
    return true;
}

int radiator_panels_points(const struct radiator_panels *x, int points, double *at, double *weight)
{
    double node[RADIATOR_PANELS_POINTS], share[RADIATOR_PANELS_POINTS];
    rule(points, node, share);
    for (int k = 0; k < x->n; k++)
        for (int i = 0; i < points; i++) {
            double half = 0.5 * (x->ends[k + 1] - x->ends[k]);
            at[k * points + i] = x->ends[k] + half * (1 + node[i]);
            weight[k * points + i] = half * share[i];
        }
    return x->n * points;
}
