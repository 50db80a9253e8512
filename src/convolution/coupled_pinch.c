/* Four cases of coupled_pinch.h:

     xi <= 0, A <= 0          free flight, f = 0;
     xi > 0, xi+ <= 0         lift-off: with y = xi - xi+ a quadratic, y^2 - (xi - A - B V mu / h) y = B V;
     xi > 0, xi+ > 0          with a = sqrt(xi), b = sqrt(xi+): DV is a polynomial over a + b (force/hertz.h);
                              times a + b a
                              polynomial in b, by Halley's method from the force's continuation by a parabola: one
                                division a pass, no root;
     else (landings; what that does not settle) Newton's method in xi+, kept between 0 and A by halving. */
#include "convolution/coupled_pinch.h"

#include <float.h>
#include <math.h>

#include "force/hertz.h"

enum { HALLEY = 8, PASSES = 60 }; /* most passes of Halley's method; of Newton's and halving */

/* Force at xi+ and, in *slope, its derivative. Not both penetrations <= 0. */
static double force_at(struct coupled_pinch *k, double to, double *slope)
{
    double steep, b = to > 0 ? sqrt(to) : 0, a = k->root;
    if (k->from > 0 && to > 0) {
        double s = a + b;
        k->gradient = k->stiffness * hertz_mean_quartic(a, b, k->from, to) / s;
        steep = k->stiffness / 2 * (b * (b * (3 * b + 6 * a) + 4 * a * a) + 2 * a * a * a) / (s * s);
    } else if (to > 0) {
        k->gradient = k->stiffness * to * to * b / (to - k->from);
        steep = (2.5 * k->stiffness * to * b - k->gradient) / (to - k->from);
    } else {
        k->gradient = k->stiffness * k->from * k->from * a / (k->from - to);
        steep = k->gradient / (k->from - to);
    }
    double factor = 1 + k->rate * (to - k->from);
    k->to = to;
    k->to_root = b;
    if (!(factor > 0)) {
        *slope = 0;
        return k->force = 0;
    }
    *slope = steep * factor + k->gradient * k->rate;
    return k->force = k->gradient * factor;
}

/* The root between 0 and A, to the rounding of either side. The equation's left side is convex, so Newton's method
   comes down to it from A; should rounding turn it round, halving goes on: a step is taken as long as it stays between
   and at least halves the last one. */
static bool search(struct coupled_pinch *k, double a, double b)
{
    double low = 0, high = a, at = a, last = 2 * a, slope;
    double enough = 2 * DBL_EPSILON * (fabs(a) + fabs(k->from));
    for (int pass = 0; pass < PASSES; pass++) {
        k->passes++;
        double off = at - a + b * force_at(k, at, &slope);
        if (fabs(off) <= enough) return true;
        *(off > 0 ? &high : &low) = at;
        double step = off / (1 + b * slope), next = at - step;
        if (fabs(step) <= 8 * DBL_EPSILON * (at + fmax(k->from, 0))) return true;
        if (!(next > low && next < high && fabs(step) <= 0.5 * last)) next = low + 0.5 * (high - low);
        if (next == low || next == high) return true;
        last = fabs(next - at);
        at = next;
    }
    return false;
}

/* xi+ <= 0 < xi; f (xi - xi+) = V(xi) max(0, 1 - mu (xi - xi+) / h). */
static void part(struct coupled_pinch *k, double a, double b)
{
    double v = k->stiffness * k->from * k->from * k->root, half = (k->from - a - b * v * k->rate) / 2;
    double wide = sqrt(half * half + b * v), y = half > 0 ? half + wide : b * v / (wide - half), slope;
    if (1 - k->rate * y <= 0) y = k->from - a;
    force_at(k, fmin(k->from - y, 0), &slope);
    k->passes++;
}

bool coupled_pinch_on(struct coupled_pinch *k, double a, double b, double x)
{
    while (x > 0 && k->passes < HALLEY) {
        double change = coupled_pinch_pass(k, a, b, x);
        x -= change;
        k->passes++;
        if (coupled_pinch_close(k, x, change)) return true;
    }
    return search(k, a, b);
}

bool coupled_pinch(struct coupled_pinch *k, double a, double b, double guess)
{
    k->passes = 0;
    if (coupled_pinch_stays(k, a, b)) return coupled_pinch_on(k, a, b, coupled_pinch_first(k, guess));
    if (k->from > 0) {
        part(k, a, b);
        return true;
    }
    if (a > 0) return search(k, a, b);
    k->to = a;
    k->to_root = k->gradient = k->force = 0;
    return true;
}
