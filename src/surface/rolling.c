/* See rolling.h. The envelope E at multiples of h = patch / 4 (surface/crests.h), and from it, block by block, when
   they are asked for:

     splines   coefficients c = G * B^-1 * E of a cubic spline, z = sum c_i B(x/h - i): the Gaussian G of standard
   deviation 4 h, sampled, and the inverse of reading a spline at its knots (surface/profile.h), in one symmetric kernel
   in each direction. It is cut at 28 points, 7 standard deviations: the Gaussian leaves nothing of the inverse's own
   slow decay there. Its sum is made 1.

   All sums are finite and in one order wherever a block begins, so that the result is a function of the place alone, to
   the last bit.

   Errors, beside those of E. A kink of the envelope by J in slope is J g(x) in curvature after the Gaussian g; on the
   lattice it is off by h^2/12 J g'', at most 1/192 of its peak, and the spline's curvature by (h k)^2/12 for a spatial
   frequency k (rad/m): 1/192 where k patch = 1. These two together stay within 1 % of the largest curvature. Measured
   in the plane for the pitch d of heights on roughness of k^-2.4, 5 um rms, down to 20 um, R = 1 mm, patch 20 um:
   curvature off by 3.0, 0.6, 0.06 % (rms) at d = 1, 1/2, 1/4 of the surface's finest scale. */
#include "surface/rolling.h"

#include <math.h>

#include "num/lanes.h"
#include "num/real.h"
#include "surface/crests.h"

enum { KERNEL = 28, INVERSE = 40, LINE = 1024, SQUARE = 16, EDGE = 3, WIDEST = LINE + EDGE + 2 * KERNEL };

struct rolling {
    bool plane;
    double h;
    double kernel[KERNEL + 1];
    struct grid crests, splines; /* a block of splines has EDGE more coefficients: those of its cells */
    double *crest, *half;        /* work: crests under a block of splines; the same, done along rows */
    long column, row;            /* of the block of splines at hand */
    const double *at_hand;       /* NULL: none */
};

/* ------------------------------------------------------------------ splines */

/* The inverse is sqrt(3) p^|k|, p = sqrt(3) - 2 (Unser, Aldroubi, Eden 1993). */
static void kernel_make(double kernel[KERNEL + 1])
{
    double gauss[2 * (KERNEL + INVERSE) + 1], sum = 0, whole = 0, pole[INVERSE + 1] = {sqrt(3)};
    for (int k = -KERNEL - INVERSE; k <= KERNEL + INVERSE; k++)
        sum += gauss[k + KERNEL + INVERSE] = real_exp(-0.5 * k * k / (ROLLING_PER_PATCH * ROLLING_PER_PATCH));
    for (int k = 1; k <= INVERSE; k++)
        pole[k] = pole[k - 1] * (sqrt(3) - 2);
    for (int i = 0; i <= KERNEL; i++) {
        double at = 0;
        for (int k = -INVERSE; k <= INVERSE; k++)
            at += pole[k < 0 ? -k : k] * gauss[i - k + KERNEL + INVERSE];
        kernel[i] = at / sum;
        whole += i == 0 ? kernel[i] : 2 * kernel[i];
    }
    for (int i = 0; i <= KERNEL; i++)
        kernel[i] /= whole;
}

/* out[i] = sum over k of kernel[|k|] in[(i + KERNEL + k) step]; n at most WIDEST. */
LANES_CLONES
static void kernel_run(const double *kernel, const double *in, long step, long n, double *out)
{
    const double *mid = in + KERNEL * step;
    for (long i = 0; i < n; i++)
        out[i] = kernel[0] * mid[i];
    for (long k = 1; k <= KERNEL; k++) {
        const double *a = mid - k * step, *b = mid + k * step;
        double factor = kernel[k];
#pragma omp simd
        for (long i = 0; i < n; i++)
            out[i] += factor * (a[i] + b[i]);
    }
}

static void splines_fill(void *self, long column, long row, double *out)
{
    struct rolling *w = self;
    long nx = w->splines.side[0] + EDGE, ny = w->plane ? w->splines.side[1] + EDGE : 1, below = w->plane ? KERNEL : 0;
    long size[2] = {nx + 2 * KERNEL, ny + 2 * below};
    long from[2] = {column * w->splines.side[0] - 1 - KERNEL, w->plane ? row * w->splines.side[1] - 1 - KERNEL : 0};
    grid_gather(&w->crests, from, size, w->crest, size[0]);
    for (long j = 0; j < size[1]; j++)
        kernel_run(w->kernel, w->crest + j * size[0], 1, nx, w->plane ? w->half + j * nx : out);
    for (long j = 0; j < ny && w->plane; j++)
        kernel_run(w->kernel, w->half + j * nx, nx, nx, out + j * nx);
}

/* ------------------------------------------------------------------ reading */

/* Coefficients from (i - 1, j - 1) on; rows are side[0] + EDGE apart. */
static const double *rolling_cell(struct rolling *w, long i, long j)
{
    const long *side = w->splines.side;
    long column = grid_block(i, side[0]), row = w->plane ? grid_block(j, side[1]) : 0;
    if (!w->at_hand || column != w->column || row != w->row) {
        w->at_hand = kept_at(w->splines.blocks, column, row);
        w->column = column;
        w->row = row;
    }
    return w->at_hand + (w->plane ? (j - row * side[1]) * (side[0] + EDGE) : 0) + (i - column * side[0]);
}

struct cubic {
    double z, d, dd; /* value and derivatives in units of the pitch */
};

/* Written in differences: of equal coefficients the derivatives are 0, not nearly so. */
static struct cubic cubic_at(const double c[4], double f)
{
    double b0 = (c[0] - c[1]) + (c[2] - c[1]), rise = (c[1] - c[2]) + (c[3] - c[2]) - b0, s0 = 0.5 * (c[2] - c[0]);
    return (struct cubic){c[1] + b0 / 6 + f * (s0 + f * (0.5 * b0 + f / 6 * rise)), s0 + f * (b0 + 0.5 * f * rise),
                          b0 + f * rise};
}

static void line_add(struct rolling *w, const struct relief_points *p, const struct relief_values *v)
{
    for (size_t n = 0; n < p->n; n++) {
        double q = p->x[n] / w->h, i = floor(q);
        struct cubic c = cubic_at(rolling_cell(w, (long)i, 0), q - i);
        if (v->z) v->z[n] += c.z;
        if (v->x) v->x[n] += c.d / w->h;
        if (v->xx) v->xx[n] += c.dd / (w->h * w->h);
    }
}

static void plane_put(const struct relief_values *v, size_t n, double h, const struct cubic c[3])
{
    if (v->z) v->z[n] += c[0].z;
    if (v->x) v->x[n] += c[1].z / h;
    if (v->y) v->y[n] += c[0].d / h;
    if (v->xx) v->xx[n] += c[2].z / (h * h);
    if (v->xy) v->xy[n] += c[1].d / (h * h);
    if (v->yy) v->yy[n] += c[0].dd / (h * h);
}

static void plane_add(struct rolling *w, const struct relief_points *p, const struct relief_values *v)
{
    for (size_t n = 0; n < p->n; n++) {
        double qx = p->x[n] / w->h, qy = p->y[n] / w->h, i = floor(qx), j = floor(qy), z[4], d[4], dd[4];
        const double *c = rolling_cell(w, (long)i, (long)j);
        for (int k = 0; k < 4; k++, c += SQUARE + EDGE) {
            struct cubic r = cubic_at(c, qx - i);
            z[k] = r.z;
            d[k] = r.d;
            dd[k] = r.dd;
        }
        plane_put(v, n, w->h, (struct cubic[3]){cubic_at(z, qy - j), cubic_at(d, qy - j), cubic_at(dd, qy - j)});
    }
}

static void rolling_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    struct rolling *w = part->state;
    if (w->plane)
        plane_add(w, p, v);
    else
        line_add(w, p, v);
}

/* ------------------------------------------------------------------ making */

/* Blocks held: what a path of some decimetres needs, so that going back over it costs nothing. */
struct relief_part *rolling_part(struct arena *a, const struct relief *under, const struct rolling_plan *p)
{
    struct relief_part *part = ARENA_TAKE(a, struct relief_part, 1);
    struct rolling *w = ARENA_TAKE(a, struct rolling, 1);
    double h = p->patch / ROLLING_PER_PATCH;
    long wide = SQUARE + EDGE + 2 * KERNEL;
    *w = (struct rolling){.plane = under->along == ALONG_PLANE, .h = h, .crests = crests_make(a, under, p)};
    w->crest = ARENA_TAKE(a, double, w->plane ? wide *wide : WIDEST);
    w->half = ARENA_TAKE(a, double, w->plane ? wide *(SQUARE + EDGE) : 1);
    kernel_make(w->kernel);
    w->splines = w->plane ? (struct grid){kept_make(a, (SQUARE + EDGE) * (SQUARE + EDGE), 8192, splines_fill, w),
                                          {SQUARE, SQUARE}}
                          : (struct grid){kept_make(a, LINE + EDGE, 512, splines_fill, w), {LINE, 1}};
    *part = (struct relief_part){.name = "tip",
                                 .pitch = {h, w->plane ? h : 0},
                                 .linear = !w->plane,
                                 .finest = h,
                                 .from = {-HUGE_VAL, -HUGE_VAL},
                                 .to = {HUGE_VAL, HUGE_VAL},
                                 .add = rolling_add,
                                 .state = w};
    return part;
}
