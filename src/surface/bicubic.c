/* B-splines over a cell, of a point that has covered the share f of it, g = 1 - f:

     B    g^3/6,   2/3 - f^2 + f^3/2,  2/3 - g^2 + g^3/2,  f^3/6
     B'   -g^2/2,  -2 f + 3/2 f^2,     2 g - 3/2 g^2,      f^2/2      per pitch
     B''  g,       -2 + 3 f,           -2 + 3 g,           f          per pitch^2

   Measured: copying 16 coefficients point by point took three times as long as the sums. Points follow a path and lie
   in runs of one cell: a coefficient is now loaded once a run and stored to eight points at a time. Second derivatives
   alone, all that a scrape asks for, take two thirds of all six. */
#include "surface/bicubic.h"

#define INLINE static inline __attribute__((always_inline))

LANES_CLONES
void bicubic_cells(struct bicubic *b, int n, const double *p, const double *q)
{
    b->n = n;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        b->column[i] = lanes_floor(p[i]);
        b->row[i] = lanes_floor(q[i]);
        b->f[i] = p[i] - b->column[i];
        b->g[i] = q[i] - b->row[i];
    }
}

LANES_CLONES
void bicubic_put(struct bicubic *b, int i, int end, const double *from, long stride)
{
    for (int at = i; at < end; at += LANES)
        for (int j = 0; j < 4; j++) {
            const double *row = from + j * stride;
            double c0 = row[0], c1 = row[1], c2 = row[2], c3 = row[3], *to = b->c[4 * j] + at;
#pragma omp simd
            for (int l = 0; l < LANES; l++) {
                to[l] = c0;
                to[l + BICUBIC_ROOM] = c1;
                to[l + 2 * BICUBIC_ROOM] = c2;
                to[l + 3 * BICUBIC_ROOM] = c3;
            }
        }
}

LANES_CLONES
void bicubic_put_row(struct bicubic *b, int i, const double *from, long stride)
{
    for (int j = 0; j < 4; j++) {
        const double *row = from + j * stride;
        double *to = b->c[4 * j] + i;
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            to[l] = row[l];
            to[l + BICUBIC_ROOM] = row[l + 1];
            to[l + 2 * BICUBIC_ROOM] = row[l + 2];
            to[l + 3 * BICUBIC_ROOM] = row[l + 3];
        }
    }
}

/* Four numbers by name: in arrays, gcc would not vectorise the loops below. */
struct four {
    double a, b, c, d;
};

INLINE double dot(struct four u, struct four v) { return (u.a * v.a + u.b * v.b) + (u.c * v.c + u.d * v.d); }

INLINE struct four basis(double f, double g)
{
    return (struct four){g * g * g / 6, 2.0 / 3 - f * f + 0.5 * f * f * f, 2.0 / 3 - g * g + 0.5 * g * g * g,
                         f * f * f / 6};
}

INLINE struct four basis_slope(double f, double g)
{
    return (struct four){-0.5 * g * g, -2 * f + 1.5 * f * f, 2 * g - 1.5 * g * g, 0.5 * f * f};
}

INLINE struct four basis_bend(double f, double g) { return (struct four){g, -2 + 3 * f, -2 + 3 * g, f}; }

INLINE struct four columns(struct four by, const struct bicubic *b, int i)
{
    return (struct four){dot(by, (struct four){b->c[0][i], b->c[4][i], b->c[8][i], b->c[12][i]}),
                         dot(by, (struct four){b->c[1][i], b->c[5][i], b->c[9][i], b->c[13][i]}),
                         dot(by, (struct four){b->c[2][i], b->c[6][i], b->c[10][i], b->c[14][i]}),
                         dot(by, (struct four){b->c[3][i], b->c[7][i], b->c[11][i], b->c[15][i]})};
}

INLINE void sum_some(struct bicubic *b, double u, double v, bool heights, bool bends)
{
    double uu = u * u, uv = u * v, vv = v * v;
    int n = b->n;
#pragma omp simd
    for (int i = 0; i < n; i++) {
        double f = b->f[i], g = b->g[i];
        struct four at = basis(f, 1 - f), slope = basis_slope(f, 1 - f), bend = basis_bend(f, 1 - f);
        struct four flat = columns(basis(g, 1 - g), b, i), rise = columns(basis_slope(g, 1 - g), b, i);
        if (heights) {
            b->z[i] = dot(flat, at);
            b->x[i] = u * dot(flat, slope);
            b->y[i] = v * dot(rise, at);
        }
        if (bends) {
            b->xx[i] = uu * dot(flat, bend);
            b->xy[i] = uv * dot(rise, slope);
            b->yy[i] = vv * dot(columns(basis_bend(g, 1 - g), b, i), at);
        }
    }
}

LANES_CLONES
static void sum_all(struct bicubic *b, double u, double v) { sum_some(b, u, v, true, true); }

LANES_CLONES
static void sum_bends(struct bicubic *b, double u, double v) { sum_some(b, u, v, false, true); }

LANES_CLONES
static void sum_heights(struct bicubic *b, double u, double v) { sum_some(b, u, v, true, false); }

void bicubic_sum(struct bicubic *b, double u, double v, const struct relief_values *asked)
{
    bool heights = asked->z || asked->x || asked->y, bends = asked->xx || asked->xy || asked->yy;
    if (heights && bends)
        sum_all(b, u, v);
    else if (bends)
        sum_bends(b, u, v);
    else
        sum_heights(b, u, v);
}
