/* The envelope E at multiples of h = patch / 4, and from it, block by block, when they are asked for:

     splines   coefficients c = G * B^-1 * E of a cubic spline, z = sum c_i B(x/h - i)

   G is the Gaussian of standard deviation 4 h, sampled, B^-1 the inverse of reading a spline at its knots
   (surface/profile.h), both in one symmetric kernel in each direction. It is cut at 28 points, 7 standard deviations:
   the Gaussian leaves nothing of the inverse's own slow decay there. Its sum is made 1.

   All sums are finite and in one order wherever a block begins, so that the result is a function of the place alone, to
   the last bit.

   Errors, beside those of E. A kink of the envelope by J in slope is J g(x) in curvature after the Gaussian g; on the
   lattice it is off by h^2/12 J g'', at most 1/192 of its peak, and the spline's curvature by (h k)^2/12 for a spatial
   frequency k (rad/m): 1/192 where k patch = 1. These two together stay within 1 % of the largest curvature. By heights
   alone, in the plane, for their pitch d on roughness of k^-2.4, 5 um rms, down to 20 um, R = 1 mm, patch 20 um:
   curvature off by 3.0, 0.6, 0.06 % (rms) at d = 1, 1/2, 1/4 of the surface's finest scale. */
#include "surface/contact_patch.h"

#include <math.h>

#include "base/stopwatch.h"
#include "num/lanes.h"
#include "num/real.h"
#include "surface/block_cache.h"
#include "surface/envelope.h"

/* SQUARE: with EDGE two registers of lanes. */
enum { KERNEL = 28, INVERSE = 40, LINE = 1024, SQUARE = 13, EDGE = 3, WIDEST = LINE + EDGE + 2 * KERNEL };

/* ------------------------------------------------------------------ the envelope on the lattice */

/* Two memories of blocks on lattices through 0, each made from the one before when it is asked for:

     heights    z of the surface at multiples of d = h / finer, read every 2 d, and between by Taylor's formula;
                envelope.c keeps them, in one coordinate rolling_envelope.c at a pitch of their own
     envelope   E at multiples of h = patch / 4

   Errors. In one coordinate those of rolling_envelope.c. In the plane the heights only tell on which asperity the ball
   rests; the surface itself, read where it touches, bears it (`bears`). Left is what two steps of Newton's method
   leave; and where two asperities bear it alike to d^2/8 (1/R + |z''|) the lower one may be taken. The force of
   scenes/round_tip is off by -75, -86, -103 dB where accuracy.tip_heights is 1, 2, 3 (by heights alone -49, -58, -67).
 */
enum { READ = 64, EIGHT = 8 };

struct on_lattice {
    const struct relief *under;
    struct rolling_plan plan;
    double h, d;               /* m; d: of the plane */
    struct envelope *envelope; /* of the plane */
    struct relief line;        /* the envelope in one coordinate */
};

/* ------------------------------------------------------------------ heights */

struct reading {
    double z[READ], x[READ], y[READ], xx[READ], xy[READ], yy[READ];
};

/* Heights, `stride` to a row, of the 2 x 2 places about each of EIGHT x EIGHT points, s away from it in both
 * directions. */
LANES_CLONES
static void squares_put(const struct reading *r, double s, double *out, long stride)
{
    for (long j = 0; j < EIGHT; j++) {
        double *low = out + 2 * j * stride, *high = low + stride;
#pragma omp simd
        for (long i = 0; i < EIGHT; i++) {
            long k = j * EIGHT + i;
            double even = r->z[k] + 0.5 * s * s * (r->xx[k] + r->yy[k]), cross = s * s * r->xy[k], a = s * r->x[k],
                   b = s * r->y[k];
            low[2 * i] = even + cross - (a + b);
            low[2 * i + 1] = even - cross + (a - b);
            high[2 * i] = even - cross - (a - b);
            high[2 * i + 1] = even + cross + (a + b);
        }
    }
}

/* Parts work out all derivatives anyway: one point is read for each square of 2 x 2 heights, in its middle, and they
   are its Taylor polynomial of second degree. 64 points are read at a time, in a square of the lattice, as parts that
   keep patches of coefficients like it. */
static void heights_put(void *self, long column, long row, double *out)
{
    struct on_lattice *w = self;
    struct reading r;
    double x[READ], y[READ];
    for (long below = 0; below < ENVELOPE_HEIGHTS; below += 2 * EIGHT)
        for (long left = 0; left < ENVELOPE_HEIGHTS; left += 2 * EIGHT) {
            for (long k = 0; k < READ; k++) {
                x[k] = ((double)(column * ENVELOPE_HEIGHTS + left + 2 * (k % EIGHT)) + 0.5) * w->d;
                y[k] = ((double)(row * ENVELOPE_HEIGHTS + below + 2 * (k / EIGHT)) + 0.5) * w->d;
            }
            relief_at(w->under, &(struct relief_points){READ, x, y},
                      &(struct relief_values){r.z, r.x, r.y, r.xx, r.xy, r.yy});
            squares_put(&r, w->d / 2, out + below * ENVELOPE_HEIGHTS + left, ENVELOPE_HEIGHTS);
        }
    rolling_envelope_watch(&w->plan, out, ENVELOPE_HEIGHTS * ENVELOPE_HEIGHTS);
}

static long plane_reach(const struct rolling_plan *p)
{
    return (long)ceil(p->reach / (p->patch / PATCH_POINTS / p->finer));
}

long contact_patch_side(const struct rolling_plan *p) { return envelope_side(plane_reach(p), p->finer); }

/* What bears the ball at a place of the surface, its centre at -d from it, and a step of Newton's method towards the
   top of that, `most` long at most:

     f = z + s - R,   f' = z' - d/s,   f'' = z'' - (1 + d d^T/s^2)/s,   s = sqrt(R^2 - |d|^2)

   The step is 0 where f has no top near, as at a kink or at the ball's rim. */
static double bears(const struct reading *r, long k, const double d[2], double radius, double most, double step[2])
{
    double square = d[0] * d[0] + d[1] * d[1], left = radius * radius - square, s = sqrt(fmax(left, 0)),
           f = r->z[k] - square / (radius + s);
    step[0] = step[1] = 0;
    if (left < 1e-6 * radius * radius) return f;
    double gx = r->x[k] - d[0] / s, gy = r->y[k] - d[1] / s, xy = r->xy[k] - d[0] * d[1] / (s * s * s);
    double xx = r->xx[k] - (1 + d[0] * d[0] / (s * s)) / s, yy = r->yy[k] - (1 + d[1] * d[1] / (s * s)) / s,
           all = xx * yy - xy * xy;
    if (!(xx < 0 && all > 0)) return f;
    double u = (xy * gy - yy * gx) / all, v = (xy * gx - xx * gy) / all, x = d[0] + u, y = d[1] + v;
    if (u * u + v * v > most * most || x * x + y * y > radius * radius) return f;
    step[0] = u;
    step[1] = v;
    return f + 0.5 * (gx * u + gy * v);
}

/* The lattice of heights tells on which asperity the ball rests, and the surface itself how high that bears it: it is
   read at the lattice's place, and where a step of Newton's method leads from there. */
static void lattice_square(void *self, long column, long row, double *out)
{
    enum { POINTS = ENVELOPE_POINTS };
    struct on_lattice *w = self;
    long finer = w->plan.finer, places[POINTS * POINTS][2];
    double x[READ], y[READ], d[READ][2], step[READ][2];
    struct reading r;
    envelope_square(w->envelope, column, row, out, places);
    stopwatch_spend((double)(POINTS * POINTS) * 2000);
    for (long at = 0; at < POINTS * POINTS; at += READ) {
        for (long k = 0; k < READ; k++) {
            long *place = places[at + k], i = (column * POINTS + (at + k) % POINTS) * finer,
                 j = (row * POINTS + (at + k) / POINTS) * finer;
            x[k] = (double)place[0] * w->d;
            y[k] = (double)place[1] * w->d;
            d[k][0] = (double)(place[0] - i) * w->d;
            d[k][1] = (double)(place[1] - j) * w->d;
        }
        for (int pass = 0; pass < 2; pass++) {
            relief_at(w->under, &(struct relief_points){READ, x, y},
                      &(struct relief_values){r.z, r.x, r.y, r.xx, r.xy, r.yy});
            for (long k = 0; k < READ; k++) {
                out[at + k] = bears(&r, k, d[k], w->plan.radius, 2 * w->d, step[k]);
                x[k] += step[k][0], d[k][0] += step[k][0];
                y[k] += step[k][1], d[k][1] += step[k][1];
            }
        }
    }
}

static void lattice_row(void *self, long column, long row, double *out)
{
    struct on_lattice *w = self;
    double x[LINE];
    (void)row;
    for (long i = 0; i < LINE; i++)
        x[i] = (double)(column * LINE + i) * w->h;
    relief_at(&w->line, &(struct relief_points){LINE, x, NULL}, &(struct relief_values){.z = out});
}

/* Blocks held: what one of splines needs, many times. */
static struct lattice lattice_plane(struct on_lattice *w, struct arena *a)
{
    w->envelope = envelope_make(a, w->plan.radius, w->d, plane_reach(&w->plan), w->plan.finer, heights_put, w);
    return (struct lattice){block_cache_make(a, ENVELOPE_POINTS * ENVELOPE_POINTS, 4096, lattice_square, w),
                            {ENVELOPE_POINTS, ENVELOPE_POINTS}};
}

static struct lattice lattice_make(struct arena *a, const struct relief *under, const struct rolling_plan *p)
{
    struct on_lattice *w = ARENA_TAKE(a, struct on_lattice, 1);
    double h = p->patch / PATCH_POINTS;
    *w = (struct on_lattice){.under = under, .plan = *p, .h = h, .d = h / p->finer};
    if (under->along == ALONG_PLANE) return lattice_plane(w, a);
    w->line.along = ALONG_PATH;
    relief_add(&w->line, rolling_envelope_part(a, under, p));
    return (struct lattice){block_cache_make(a, LINE, 64, lattice_row, w), {LINE, 1}};
}

/* ------------------------------------------------------------------ smoothed */

struct rolling {
    bool plane;
    double h;
    double kernel[KERNEL + 1];
    struct lattice envelope, splines; /* a block of splines has EDGE more coefficients: those of its cells */
    double *window, *half;            /* work: envelope under a block of splines; the same, done along rows */
};

/* ------------------------------------------------------------------ splines */

/* The inverse is sqrt(3) p^|k|, p = sqrt(3) - 2 (Unser, Aldroubi, Eden 1993). */
static void kernel_make(double kernel[KERNEL + 1])
{
    double gauss[2 * (KERNEL + INVERSE) + 1], sum = 0, whole = 0, pole[INVERSE + 1] = {sqrt(3)};
    for (int k = -KERNEL - INVERSE; k <= KERNEL + INVERSE; k++)
        sum += gauss[k + KERNEL + INVERSE] = real_exp(-0.5 * k * k / (PATCH_POINTS * PATCH_POINTS));
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
    block_cache_gather(&w->envelope, from, size, w->window, size[0]);
    stopwatch_spend(0.5 * KERNEL * (double)(nx * (w->plane ? size[1] + ny : 1)));
    for (long j = 0; j < size[1]; j++)
        kernel_run(w->kernel, w->window + j * size[0], 1, nx, w->plane ? w->half + j * nx : out);
    for (long j = 0; j < ny && w->plane; j++)
        kernel_run(w->kernel, w->half + j * nx, nx, nx, out + j * nx);
}

/* ------------------------------------------------------------------ reading */

/* Coefficients from (i - 1, j - 1) on; rows are side[0] + EDGE apart. */
static const double *rolling_cell(struct rolling *w, long i, long j)
{
    const long *side = w->splines.side;
    long column = block_cache_index(i, side[0]), row = w->plane ? block_cache_index(j, side[1]) : 0;
    return block_cache_at(w->splines.blocks, column, row) + (w->plane ? (j - row * side[1]) * (side[0] + EDGE) : 0) +
           (i - column * side[0]);
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
        struct cubic at = cubic_at(z, qy - j), along = cubic_at(d, qy - j), bent = cubic_at(dd, qy - j);
        double h = w->h;
        if (v->z) v->z[n] += at.z;
        if (v->x) v->x[n] += along.z / h;
        if (v->y) v->y[n] += at.d / h;
        if (v->xx) v->xx[n] += bent.z / (h * h);
        if (v->xy) v->xy[n] += along.d / (h * h);
        if (v->yy) v->yy[n] += at.dd / (h * h);
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
struct relief_part *contact_patch_part(struct arena *a, const struct relief *under, const struct rolling_plan *p)
{
    struct rolling *w = ARENA_TAKE(a, struct rolling, 1);
    double h = p->patch / PATCH_POINTS;
    long wide = SQUARE + EDGE + 2 * KERNEL;
    *w = (struct rolling){.plane = under->along == ALONG_PLANE, .h = h, .envelope = lattice_make(a, under, p)};
    w->window = ARENA_TAKE(a, double, w->plane ? wide *wide : WIDEST);
    w->half = ARENA_TAKE(a, double, w->plane ? wide *(SQUARE + EDGE) : 1);
    kernel_make(w->kernel);
    w->splines = w->plane
                     ? (struct lattice){block_cache_make(a, (SQUARE + EDGE) * (SQUARE + EDGE), 8192, splines_fill, w),
                                        {SQUARE, SQUARE}}
                     : (struct lattice){block_cache_make(a, LINE + EDGE, 512, splines_fill, w), {LINE, 1}};
    struct relief_part *part = relief_endless(a, "tip", h, rolling_add, w);
    part->reading = 40;
    part->pitch[0] = h;
    part->pitch[1] = w->plane ? h : 0;
    part->linear = !w->plane;
    return part;
}
