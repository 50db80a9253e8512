/* The first two levels by least squares of T, as a straight way has them; the others, of headings that change, by least squares of S, in what of them the
   two do not make up, with a penalty:

     min over v of   integral of (D - sum of v_k L_k)^2 ds + PENALTY l^4 W sum of v_k^2

     D      S less the two and their levels         L_k   lift of shape k less as much of the two as goes with shape k by least squares of the shapes
     W      all the way, m                          l^2   what a shape of size 1 lifts in the end

   It is S whose level is looked for, which shows the slow part of T only: by least squares of T, most of which is fast, k was 4 times too small over ridges that
   nothing told from a grain, and with more shapes up to 11 times on half a circle and on short legs, which cannot tell these shapes apart. What they
   cannot tell apart does not matter so, as it makes no difference to S; the penalty decides that, and on a way of one direction, where L is nothing
   but rounding, leaves the level of a line. From 1e-11 to 1e-5 it changes S over arcs by 8 % at most. */
#include "force/slope_level.h"

#define PENALTY 1e-9

enum { OTHERS = SLOPE_LEVELS - SLOPE_PAIR };

struct level_fit {
    const struct slope *s;
    int n;                              /* others                                    */
    double by[OTHERS][SLOPE_PAIR];      /* how much of the two goes with each        */
    double g[OTHERS][OTHERS + 1];       /* normal equations, right side last         */
};

static double level_at(const double (*m)[SLOPE_LEVELS], int k, int j)
{
    return k > j ? m[k][j] : m[j][k];
}

/* The two's normal equations with b[] on their right side; all to the first where no more than rounding is left of the second. */
static void level_pair(const struct slope *s, double b0, double b1, double to[SLOPE_PAIR])
{
    const double (*g)[SLOPE_LEVELS] = s->gone;
    double left = g[0][0] * g[1][1] - g[1][0] * g[1][0];
    to[1] = left > 1e-9 * g[0][0] * g[1][1] ? (g[0][0] * b1 - g[1][0] * b0) / left : 0;
    to[0] = g[0][0] > 0 ? (b0 - g[1][0] * to[1]) / g[0][0] : 0;
}

/* Integral of the lift of level j times L_k. */
static double level_with(const struct level_fit *f, int k, int j)
{
    const double (*risen)[SLOPE_LEVELS] = f->s->risen;
    return level_at(risen, SLOPE_PAIR + k, j) - f->by[k][0] * level_at(risen, 0, j) - f->by[k][1] * level_at(risen, 1, j);
}

static void level_row(struct level_fit *f, int k, const double level[SLOPE_PAIR])
{
    const struct slope *s = f->s;
    double two[SLOPE_PAIR] = {level_with(f, k, 0), level_with(f, k, 1)}, unit = s->leak * s->leak;
    for (int j = 0; j < f->n; j++)
        f->g[k][j] = level_with(f, k, SLOPE_PAIR + j) - two[0] * f->by[j][0] - two[1] * f->by[j][1];
    f->g[k][k] += PENALTY * unit * unit * s->far;
    f->g[k][f->n] = s->rose[SLOPE_PAIR + k] - f->by[k][0] * s->rose[0] - f->by[k][1] * s->rose[1] - two[0] * level[0] - two[1] * level[1];
}

/* By elimination: g is positive definite. */
static void level_solve(struct level_fit *f, double *to)
{
    int n = f->n;
    for (int k = 0; k < n; k++)
        for (int i = k + 1; i < n; i++) {
            double part = f->g[i][k] / f->g[k][k];
            for (int j = k; j <= n; j++)
                f->g[i][j] -= part * f->g[k][j];
        }
    for (int k = n - 1; k >= 0; k--) {
        to[k] = f->g[k][n];
        for (int j = k + 1; j < n; j++)
            to[k] -= f->g[k][j] * to[j];
        to[k] /= f->g[k][k];
    }
}

void slope_level(const struct slope *s, bool all, double level[SLOPE_LEVELS])
{
    struct level_fit f = {.s = s, .n = all && s->far > 0 ? s->levels - SLOPE_PAIR : 0};
    double *others = level + SLOPE_PAIR;
    for (int k = 0; k < s->levels; k++)
        level[k] = 0;
    level_pair(s, s->bent[0], s->bent[1], level);
    for (int k = 0; k < f.n; k++)
        level_pair(s, level_at(s->gone, SLOPE_PAIR + k, 0), level_at(s->gone, SLOPE_PAIR + k, 1), f.by[k]);
    for (int k = 0; k < f.n; k++)
        level_row(&f, k, level);
    level_solve(&f, others);
    for (int k = 0; k < f.n; k++)
        for (int j = 0; j < SLOPE_PAIR; j++)
            level[j] -= others[k] * f.by[k][j];
}
