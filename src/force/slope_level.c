/* Least squares by the normal equations. */
#include "force/slope_level.h"

/* Of the normal equations' row k what rows before it have is taken out; without a division, and where no more than rounding is left of it, wholly. */
static bool level_row(double g[][SLOPE_LEVELS + 1], const bool *kept, int n, int k)
{
    double whole = g[k][k];
    for (int j = 0; j < k; j++) {
        double pivot = g[j][j], by = g[k][j];
        for (int i = j; i <= n && kept[j]; i++)
            g[k][i] = pivot * g[k][i] - by * g[j][i];
        whole *= kept[j] ? pivot : 1;
    }
    return g[k][k] > 1e-9 * whole;
}

void slope_level(const struct slope *s, double level[SLOPE_LEVELS])
{
    double g[SLOPE_LEVELS][SLOPE_LEVELS + 1];
    bool kept[SLOPE_LEVELS];
    int n = s->levels;
    for (int k = 0; k < n; k++) {
        for (int j = 0; j < n; j++)
            g[k][j] = s->gone[k > j ? k : j][k > j ? j : k];
        g[k][n] = s->bent[k];
    }
    for (int k = 0; k < n; k++)
        kept[k] = level_row(g, kept, n, k);
    for (int k = n - 1; k >= 0; k--) {
        level[k] = kept[k] ? g[k][n] : 0;
        for (int j = k + 1; j < n && kept[k]; j++)
            level[k] -= level[j] * g[k][j];
        level[k] = kept[k] ? level[k] / g[k][k] : 0;
    }
}
