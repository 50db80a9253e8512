/* Cubic spline profiles (C2: second derivatives, which the force is made of, do not jump, as a Catmull-Rom
   interpolant's would).

   Interpolation: (c[i-1] + 4 c[i] + c[i+1]) / 6 = z[i]. Its solution on an endless grid is c = sqrt(3) sum_k p^|k|
   z[i-k] with p = sqrt(3) - 2 (Unser, Aldroubi, Eden 1993), computed by one causal and one anticausal recursion; the
   sums are begun 64 samples beyond the ends, where p^64 < 1e-36, with the samples that the continuation rule puts
   there:
     mirror  z[-i] = z[i], z[n-1+i] = z[n-1-i], period 2n - 2      wrap  z[n+i] = z[i], period n
   Heights are taken from the first sample, so that a flat profile is flat to the bit, wherever it lies. */
#include "surface/profile.h"

#include <limits.h>
#include <math.h>
#include <string.h>

#include "base/stopwatch.h"
#include "num/lanes.h"
#include "scene/scene.h"

struct sampled {
    long n;
    int off_map;
    const double *c;
};

long profile_folded(long i, long n, int off_map)
{
    long period = off_map == OFF_MAP_WRAP ? n : 2 * n - 2;
    i %= period;
    if (i < 0) i += period;
    return i < n ? i : period - i;
}

static void sampled_read(struct profile *p, long first, long n, double *c)
{
    const struct sampled *s = p->state;
    if (first >= 0 && first + n <= s->n) {
        memcpy(c, s->c + first, (size_t)n * sizeof *c);
        return;
    }
    long period = s->off_map == OFF_MAP_WRAP ? s->n : 2 * s->n - 2, at = first % period - 1;
    at = at < -1 ? at + period : at;
    for (long i = 0; i < n; i++) { /* as profile_folded(first + i), without a division each */
        at = at + 1 < period ? at + 1 : 0;
        c[i] = s->c[at < s->n ? at : period - at];
    }
}

enum { SPLINE_REACH = 64 };

void profile_coefficients(const double *z, double *c, size_t size, int off_map)
{
    double pole = sqrt(3) - 2, sum = 0, first = z[0];
    long n = (long)size;
    for (long i = -SPLINE_REACH; i < 0; i++)
        sum = (z[profile_folded(i, n, off_map)] - first) + pole * sum;
    for (long i = 0; i < n; i++)
        c[i] = sum = (z[i] - first) + pole * sum;
    sum = 0;
    for (long i = n + SPLINE_REACH; i >= n; i--)
        sum = pole * ((z[profile_folded(i, n, off_map)] - first) + sum);
    for (long i = n - 1; i >= 0; i--) {
        double before = c[i];
        c[i] = first + sqrt(3) * (before + sum);
        sum = pole * ((z[i] - first) + sum);
    }
}

struct profile *profile_from_samples(struct arena *a, const double *z, size_t n, double pitch, int off_map)
{
    double *c = ARENA_TAKE(a, double, n);
    profile_coefficients(z, c, n, off_map);
    stopwatch_spend(25 * (double)n);
    return profile_from_coefficients(a, c, n, pitch, off_map);
}

struct profile *profile_from_coefficients(struct arena *a, const double *c, size_t n, double pitch, int off_map)
{
    struct profile *p = ARENA_TAKE(a, struct profile, 1);
    struct sampled *s = ARENA_TAKE(a, struct sampled, 1);
    *s = (struct sampled){.n = (long)n, .off_map = off_map, .c = c};
    *p = (struct profile){.pitch = pitch, .from = 0, .to = pitch * (double)(n - 1), .read = sampled_read, .state = s};
    return p;
}

#define INLINE static inline __attribute__((always_inline))

/* ------------------------------------------------------------------ as a part of a relief */

enum { WINDOW = 1024 };

struct window {
    struct profile *profile;
    double origin;
    long first; /* coefficients held: first .. first + WINDOW - 1; LONG_MIN: none */
    double c[WINDOW];
};

/* Coefficients cell - 1 .. cell + 2; more of them are fetched ahead of the motion than behind it. */
static const double *window_at(struct window *w, long cell)
{
    if (w->first == LONG_MIN || cell - 1 < w->first || cell + 2 >= w->first + WINDOW) {
        w->first = w->first == LONG_MIN || cell > w->first ? cell - 9 : cell + 10 - WINDOW;
        w->profile->read(w->profile, w->first, WINDOW, w->c);
    }
    return w->c + (cell - 1 - w->first);
}

/* z, z' and z'' in a cell about which these are the coefficients, f of the way into it; per: 1 over its length, 1/m. */
INLINE double window_value(double a, double b, double c, double d, double f, double per, int order)
{
    double b0 = (a - b) + (c - b), b1 = (b - c) + (d - c), rise = b1 - b0, s0 = 0.5 * (c - a);
    if (order == 0) return (a + 4 * b + c) / 6 + f * (s0 + f * (0.5 * b0 + f / 6 * rise));
    return order == 1 ? (s0 + f * (b0 + 0.5 * f * rise)) * per : (b0 + f * rise) * (per * per);
}

/* All points at once, where all lie in what is held: else false. */
LANES_CLONES
static int window_all(const struct window *w, size_t n, const double *x, double *restrict to, int order)
{
    const double *c = w->c;
    double h = w->profile->pitch, per = 1 / h, origin = w->origin, first = (double)w->first + 1;
    int all = w->first != LONG_MIN;
#pragma omp simd reduction(& : all)
    for (size_t i = 0; i < n; i++) {
        double cell = lanes_floor((x[i] - origin) / h) - first;
        all &= (cell >= 0) & (cell < WINDOW - 3);
    }
    n = all ? n : 0;
#define VALUES(order)                                                                                                  \
    for (size_t i = 0; i < n; i++) {                                                                                   \
        double q = (x[i] - origin) / h, cell = lanes_floor(q);                                                         \
        int k = (int)(cell - first);                                                                                   \
        to[i] += window_value(c[k], c[k + 1], c[k + 2], c[k + 3], q - cell, per, order);                               \
    }
    if (order == 0)
#pragma omp simd
        VALUES(0)
    else if (order == 1)
#pragma omp simd
        VALUES(1)
    else
#pragma omp simd
        VALUES(2)
    return all;
}

static void window_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    struct window *w = part->state;
    double h = w->profile->pitch, per = 1 / h, *const to[3] = {v->z, v->x, v->xx};
    for (int order = 0; order < 3; order++) {
        if (!to[order] || window_all(w, p->n, p->x, to[order], order)) continue;
        for (size_t i = 0; i < p->n; i++) {
            double q = (p->x[i] - w->origin) / h, cell = lanes_floor(q);
            const double *c = window_at(w, (long)cell);
            to[order][i] += window_value(c[0], c[1], c[2], c[3], q - cell, per, order);
        }
    }
}

static void window_close(struct relief_part *part)
{
    struct window *w = part->state;
    if (w->profile->close) w->profile->close(w->profile);
}

struct relief_part *profile_part(struct arena *a, struct profile *p, const char *name, double origin)
{
    struct relief_part *part = ARENA_TAKE(a, struct relief_part, 1);
    struct window *w = ARENA_TAKE(a, struct window, 1);
    w->profile = p;
    w->origin = origin;
    w->first = LONG_MIN;
    *part = (struct relief_part){.name = name,
                                 .pitch = {p->pitch, 0},
                                 .origin = {origin, 0},
                                 .linear = true,
                                 .finest = p->pitch,
                                 .from = {p->from + origin, -HUGE_VAL},
                                 .to = {p->to + origin, HUGE_VAL},
                                 .add = window_add,
                                 .reading = 20,
                                 .close = window_close,
                                 .state = w};
    return part;
}
