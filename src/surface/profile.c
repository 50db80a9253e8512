/* Cubic spline profiles (C2: second derivatives, which the force is made of, do not jump, as a Catmull-Rom interpolant's would).

   Interpolation: (c[i-1] + 4 c[i] + c[i+1]) / 6 = z[i]. Its solution on an endless grid is c = sqrt(3) sum_k p^|k| z[i-k] with
   p = sqrt(3) - 2 (Unser, Aldroubi, Eden 1993), computed by one causal and one anticausal recursion; the sums are begun 64 samples
   beyond the ends, where p^64 < 1e-36, with the samples that the continuation rule puts there:
     mirror  z[-i] = z[i], z[n-1+i] = z[n-1-i], period 2n - 2      wrap  z[n+i] = z[i], period n */
#include "surface/profile.h"

#include <math.h>

#include "scene/scene.h"

struct sampled {
    long n;
    int off_map;
    double *c;
};

static long folded(const struct sampled *s, long i)
{
    long period = s->off_map == OFF_MAP_WRAP ? s->n : 2 * s->n - 2;
    i %= period;
    if (i < 0)
        i += period;
    return i < s->n ? i : period - i;
}

static void sampled_read(struct profile *p, long first, long n, double *c)
{
    const struct sampled *s = p->state;
    for (long i = 0; i < n; i++)
        c[i] = s->c[first + i >= 0 && first + i < s->n ? first + i : folded(s, first + i)];
}

enum { SPLINE_REACH = 64 };

static void spline_coefficients(struct sampled *s, const double *z)
{
    double pole = sqrt(3) - 2, sum = 0;
    for (long i = -SPLINE_REACH; i < 0; i++)
        sum = z[folded(s, i)] + pole * sum;
    for (long i = 0; i < s->n; i++)
        s->c[i] = sum = z[i] + pole * sum;
    sum = 0;
    for (long i = s->n + SPLINE_REACH; i >= s->n; i--)
        sum = pole * (z[folded(s, i)] + sum);
    for (long i = s->n - 1; i >= 0; i--) {
        double before = s->c[i];
        s->c[i] = sqrt(3) * (before + sum);
        sum = pole * (z[i] + sum);
    }
}

struct profile *profile_from_samples(struct arena *a, const double *z, size_t n, double pitch, int off_map)
{
    struct profile *p = ARENA_TAKE(a, struct profile, 1);
    struct sampled *s = ARENA_TAKE(a, struct sampled, 1);
    *s = (struct sampled){.n = (long)n, .off_map = off_map, .c = ARENA_TAKE(a, double, n)};
    spline_coefficients(s, z);
    *p = (struct profile){.pitch = pitch, .from = 0, .to = pitch * (double)(n - 1), .read = sampled_read, .state = s};
    return p;
}

void profile_knots(struct profile *p, long first, long n, double *work, struct profile_knots out)
{
    const double *c = work + 1;
    double h = p->pitch;
    p->read(p, first - 1, n + 2, work);
    for (long i = 0; i < n; i++) {
        if (out.height)
            out.height[i] = (c[i - 1] + 4 * c[i] + c[i + 1]) / 6;
        if (out.slope)
            out.slope[i] = (c[i + 1] - c[i - 1]) / (2 * h);
        if (out.curvature)
            out.curvature[i] = ((c[i - 1] - c[i]) + (c[i + 1] - c[i])) / (h * h);
    }
}
