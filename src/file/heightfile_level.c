/* See heightfile_level.h. With places u, v counted from the middle of the map in samples, the plane m + p u + q v
   solves the normal equations of least squares; missing points make them a full 3 x 3 system, solved by Cholesky's
   decomposition. */
#include "file/heightfile_level.h"

#include <math.h>

struct sums {
    double n, u, v, uu, uv, vv, z, zu, zv;
};

/* Row by row, so that rounding errors stay those of short sums. */
static struct sums level_sums(const struct heightfile *h)
{
    struct sums s = {0};
    double cu = 0.5 * (double)(h->columns - 1), cv = 0.5 * (double)(h->rows - 1);
    for (size_t j = 0; j < h->rows; j++) {
        double n = 0, u = 0, uu = 0, z = 0, zu = 0, v = (double)j - cv;
        for (size_t i = 0; i < h->columns; i++) {
            double x = (double)i - cu, height = h->z[j * h->columns + i];
            if (isnan(height)) continue;
            n += 1;
            u += x;
            uu += x * x;
            z += height;
            zu += height * x;
        }
        s.n += n, s.u += u, s.v += n * v, s.uu += uu, s.uv += u * v, s.vv += n * v * v, s.z += z, s.zu += zu,
            s.zv += z * v;
    }
    return s;
}

/* Solves [n u v; u uu uv; v uv vv] x = [z zu zv]; a pivot that is nothing beside its diagonal is a direction without
 * extent. */
static void level_solve(const struct sums *s, double x[3])
{
    double l10 = s->u / s->n, l20 = s->v / s->n, d1 = s->uu - l10 * s->u, b1 = s->zu - l10 * s->z;
    bool wide = d1 > 1e-9 * (s->uu + 1);
    double c21 = s->uv - l10 * s->v, l21 = wide ? c21 / d1 : 0;
    double d2 = s->vv - l20 * s->v - l21 * c21, b2 = s->zv - l20 * s->z - l21 * b1;
    x[2] = d2 > 1e-9 * (s->vv + 1) ? b2 / d2 : 0;
    x[1] = wide ? b1 / d1 - l21 * x[2] : 0;
    x[0] = s->z / s->n - l10 * x[1] - l20 * x[2];
}

static double level_per(double slope, double pitch) { return isnan(pitch) ? slope : slope / pitch; }

struct heightfile_plane heightfile_level_fit(const struct heightfile *h)
{
    struct sums s = level_sums(h);
    double x[3] = {0};
    if (s.n > 0) level_solve(&s, x);
    return (struct heightfile_plane){x[0], level_per(x[1], h->pitch_x), level_per(x[2], h->pitch_y)};
}

struct heightfile_plane heightfile_level(struct heightfile *h, enum heightfile_levelling levelling)
{
    struct heightfile_plane p = {0};
    if (levelling == HEIGHTFILE_LEVEL_NONE) return p;
    p = heightfile_level_fit(h);
    if (levelling == HEIGHTFILE_LEVEL_MEAN) {
        struct sums s = level_sums(h);
        p = (struct heightfile_plane){s.n > 0 ? s.z / s.n : 0, 0, 0};
    }
    double sx = isnan(h->pitch_x) ? p.slope_x : p.slope_x * h->pitch_x,
           sy = isnan(h->pitch_y) ? p.slope_y : p.slope_y * h->pitch_y;
    double cu = 0.5 * (double)(h->columns - 1), cv = 0.5 * (double)(h->rows - 1);
    for (size_t j = 0; j < h->rows; j++)
        for (size_t i = 0; i < h->columns; i++)
            h->z[j * h->columns + i] -= p.mean + sx * ((double)i - cu) + sy * ((double)j - cv);
    return p;
}
