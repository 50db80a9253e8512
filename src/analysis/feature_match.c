/* Modes matched as points. The pairs that are near enough, by falling closeness, are served one after the other. */
#include "analysis/feature_match.h"

#include <math.h>
#include <stdlib.h>

#include "num/real.h"

double feature_match_bark(double frequency) { return 26.81 * frequency / (1960.0 + frequency) - 0.53; }

struct point {
    double x, y, energy;
};

struct pair {
    int i, j;
    double k, energy; /* of both */
};

static int closer_first(const void *one, const void *other)
{
    const struct pair *p = one, *q = other;
    if (p->k != q->k) return p->k > q->k ? -1 : 1;
    if (p->energy != q->energy) return p->energy > q->energy ? -1 : 1;
    return p->i != q->i ? p->i - q->i : p->j - q->j;
}

/* unit: of the duration, s; NAN: y is by the logarithm. */
static struct point *place(const struct feature *f, int n, const double scale[2], double unit, struct arena *a)
{
    struct point *p = ARENA_TAKE(a, struct point, n);
    for (int i = 0; i < n; i++)
        p[i] = (struct point){.x = feature_match_bark(f[i].frequency) / scale[0],
                              .y = (isnan(unit) ? -real_log(f[i].decay) : 1.0 / f[i].decay / unit) / scale[1],
                              .energy = f[i].energy};
    return p;
}

/* R of one set; each of the other has one of itself to give. */
static double *serve(const struct pair *pair, int pairs, int n, int m, bool exchanged, struct arena *a)
{
    double *r = ARENA_TAKE(a, double, n), *left = ARENA_TAKE(a, double, m);
    for (int j = 0; j < m; j++)
        left[j] = 1.0;
    for (int k = 0; k < pairs; k++) {
        const struct pair *p = &pair[k];
        int i = exchanged ? p->j : p->i, j = exchanged ? p->i : p->j;
        double u = fmin(left[j], (1.0 - r[i]) / p->k);
        left[j] -= u;
        r[i] = fmin(1.0, r[i] + u * p->k);
    }
    return r;
}

static double mean(const struct feature *f, const double *r, int n)
{
    double sum = 0.0, energy = 0.0, plain = 0.0;
    for (int i = 0; i < n; i++) {
        sum += f[i].energy * r[i];
        energy += f[i].energy;
        plain += r[i];
    }
    if (energy > 0.0) return sum / energy;
    return n ? plain / n : 0.0;
}

void feature_match(const struct feature *reference, int n, const struct feature *estimated, int m,
                   const struct feature_match_scale *scale, struct arena *a, struct feature_match *match)
{
    double per[2] = {scale && scale->bark > 0.0 ? scale->bark : 0.1, scale && scale->decay > 0.0 ? scale->decay : 0.25};
    double *duration = ARENA_TAKE(a, double, n), unit = NAN;
    for (int i = 0; i < n; i++)
        duration[i] = 1.0 / reference[i].decay;
    if (scale && scale->durations && n) unit = mean(reference, duration, n);
    struct point *p = place(reference, n, per, unit, a), *q = place(estimated, m, per, unit, a);
    struct pair *pair = NULL;
    int pairs = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < m; j++) {
            double dx = p[i].x - q[j].x, dy = p[i].y - q[j].y, k = 1.0 - sqrt(dx * dx + dy * dy);
            if (!(k > 0.0)) continue;
            pair = arena_more(a, pair, pairs, sizeof *pair);
            pair[pairs++] = (struct pair){i, j, k, p[i].energy + q[j].energy};
        }
    if (pairs) qsort(pair, (size_t)pairs, sizeof *pair, closer_first);
    match->reference = serve(pair, pairs, n, m, false, a);
    match->estimated = serve(pair, pairs, m, n, true, a);
    match->represented = mean(reference, match->reference, n);
    match->found = mean(estimated, match->estimated, m);
    match->score = 0.5 * (match->represented + match->found);
}
