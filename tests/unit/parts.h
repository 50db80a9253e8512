/* What every part of a relief must keep to, whatever its heights. */
#ifndef PARTS_H
#define PARTS_H
#include "num/noise.h"
#include "surface/relief.h"
#include "unit.h"

struct parts_point {
    double v[6]; /* z, x, y, xx, xy, yy */
};

static inline struct parts_point parts_at(struct relief_part *p, double x, double y, bool plane)
{
    struct parts_point s = {{0}};
    struct relief_points at = {1, &x, plane ? &y : NULL};
    struct relief_values out = {
        &s.v[0], &s.v[1], plane ? &s.v[2] : NULL, &s.v[3], plane ? &s.v[4] : NULL, plane ? &s.v[5] : NULL};
    p->add(p, &at, &out);
    return s;
}

/* Derivatives against central differences of the value one order lower, at 500 places in a square of `size` m; the
   largest difference over the rms of that derivative. Second derivatives may have corners at knots, where a difference
   over 2e-3 of the finest scale is off by about as much. */
static inline void parts_derivatives(struct relief_part *p, double size, bool plane)
{
    static const int from[6][2] = {{0},    {0},    {0},
                                   {1, 1}, {1, 2}, {2, 2}}; /* which first derivative, and which output it is of */
    double h = 1e-3 * p->finest, worst[6] = {0}, square[6] = {0};
    struct noise dice = noise_make(1, "parts");
    for (uint64_t i = 0; i < 500; i++) {
        double x = size * (noise_uniform(dice, i, 0) - 0.5), y = plane ? size * (noise_uniform(dice, i, 1) - 0.5) : 0;
        struct parts_point m = parts_at(p, x, y, plane), e = parts_at(p, x + h, y, plane),
                           w = parts_at(p, x - h, y, plane), n = e, s = w;
        if (plane) n = parts_at(p, x, y + h, plane), s = parts_at(p, x, y - h, plane);
        for (int k = 1; k < 6; k++) {
            bool by_y = k == 2 || k == 4 || k == 5;
            int lower = k < 3 ? 0 : k == 4 ? 1 : from[k][0];
            if (!plane && by_y) continue;
            double slope = by_y ? (n.v[lower] - s.v[lower]) / (2 * h) : (e.v[lower] - w.v[lower]) / (2 * h);
            worst[k] = fmax(worst[k], fabs(slope - m.v[k]));
            square[k] += m.v[k] * m.v[k] / 500;
        }
        if (plane) /* the mixed one the other way round */
            worst[4] = fmax(worst[4], fabs((e.v[2] - w.v[2]) / (2 * h) - m.v[4]));
    }
    for (int k = 1; k < 6; k++)
        ck_assert_msg(worst[k] <= 5e-3 * sqrt(square[k]) + 1e-12 * sqrt(square[plane ? 5 : 3]),
                      "%s: derivative %d: off by %g of rms %g", p->name, k, worst[k], sqrt(square[k]));
}

/* Second derivatives without jumps: along a line of `n` points 1/50 of the finest scale apart, neighbours differ by
 * less than `most` of the rms. */
static inline void parts_continuous(struct relief_part *p, long n, double x0, double angle, double most)
{
    double step = p->finest / 50, square[6] = {0}, jump[6] = {0};
    struct parts_point last = {{0}};
    for (long i = 0; i < n; i++) {
        struct parts_point at =
            parts_at(p, x0 + (double)i * step * cos(angle), 0.3 * x0 + (double)i * step * sin(angle), true);
        for (int k = 3; k < 6; k++) {
            square[k] += at.v[k] * at.v[k] / (double)n;
            jump[k] = i ? fmax(jump[k], fabs(at.v[k] - last.v[k])) : 0;
        }
        last = at;
    }
    for (int k = 3; k < 6; k++)
        ck_assert_msg(jump[k] <= most * sqrt(square[k]), "%s: second derivative %d jumps by %g, rms %g", p->name, k,
                      jump[k], sqrt(square[k]));
}

/* The same bits in any order, batch length and mood: 4000 points of a wandering path read in one go and one by one,
 * backwards, by two parts alike. */
static inline void parts_any_order(struct relief_part *once, struct relief_part *often, double step)
{
    enum { N = 4000 };
    static double x[N], y[N], all[6][N];
    struct noise dice = noise_make(2, "parts");
    for (int i = 0; i < N; i++) {
        x[i] = 3e-3 * cos(1e-3 * i) + step * i + (i % 97 == 0 ? 0.1 : 0) - 2e-3;
        y[i] = 2e-3 * sin(2.3e-3 * i) - 0.3 * step * i;
    }
    memset(all, 0, sizeof all);
    struct relief_values out = {all[0], all[1], all[2], all[3], all[4], all[5]};
    once->add(once, &(struct relief_points){N, x, y}, &out);
    for (int k = 0; k < N; k++) {
        int i = k % 2 ? N - 1 - k : (int)(noise_uniform(dice, (uint64_t)k, 0) * N);
        struct parts_point one = parts_at(often, x[i], y[i], true);
        for (int d = 0; d < 6; d++)
            ck_assert_msg(memcmp(&one.v[d], &all[d][i], sizeof(double)) == 0, "%s: value %d of point %d differs",
                          once->name, d, i);
    }
}

/* Nothing asked, nothing written; one thing asked, that alone, added to what is there. */
static inline void parts_asked_alone(struct relief_part *p)
{
    double x = 1.1e-3, y = -0.7e-3;
    struct parts_point all = parts_at(p, x, y, true);
    for (int d = 0; d < 6; d++) {
        double here = 7, *out[6] = {0};
        out[d] = &here;
        p->add(p, &(struct relief_points){1, &x, &y},
               &(struct relief_values){out[0], out[1], out[2], out[3], out[4], out[5]});
        ck_assert_double_eq(here, 7 + all.v[d]);
    }
}

#endif
