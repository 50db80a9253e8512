/* See scan.h. Golden section: W. Press et al., Numerical Recipes, section 10.2; a triple of instants whose middle one
   is the least is narrowed to 1e-9 of a step, where y differs from its extreme by 1e-18 of what it varies by in a step.
   Two sides of a jump are two extremes: the triple closes in on its lower side. */
#include "trajectory/scan.h"

#include <math.h>

enum { SCAN_CHUNK = 256 };

static double scan_at(const struct scan *s, double sign, double t)
{
    double y;
    s->at(s->self, 1, &t, &y);
    return sign * y;
}

/* Least of sign y between t[0] and t[2], y(t[1]) being the least so far. */
static double golden(const struct scan *s, double sign, const double t[3], double least)
{
    static const double SHARE = 0.38196601125010515;
    double low = t[0], middle = t[1], high = t[2], width = 1e-9 * (high - low);
    while (high - low > width && low < middle && middle < high) {
        double try = high - middle > middle - low ? middle + SHARE * (high - middle) : middle - SHARE * (middle - low),
               y = scan_at(s, sign, try);
        if (y < least) {
            if (try > middle)
                low = middle;
            else
                high = middle;
            middle = try;
            least = y;
        } else if (try > middle)
            high = try;
        else
            low = try;
    }
    return least;
}

/* One side: sign +1 for the least value, -1 for the greatest. y[3]: values at instants t[3]. */
static void scan_triple(const struct scan *s, double sign, const double t[3], const double y[3], double *best)
{
    double a = sign * y[0], b = sign * y[1], c = sign * y[2];
    if (b > a || b > c || b - (fmax(a, c) - b) >= *best) return;
    *best = fmin(*best, golden(s, sign, t, b));
}

struct window {
    double t[3], y[3];
    long n;
};

static void window_add(struct window *w, double t, double y)
{
    for (int k = 0; k < 2; k++) {
        w->t[k] = w->t[k + 1];
        w->y[k] = w->y[k + 1];
    }
    w->t[2] = t;
    w->y[2] = y;
    w->n++;
}

/* An extreme between an end and the instant beside it: y then falls away from the end. */
static void scan_end(const struct scan *s, double end, double beside, double best[2])
{
    const double t[3] = {end < beside ? end : beside, end + 1e-6 * (beside - end), end < beside ? beside : end};
    double y[3];
    s->at(s->self, 3, t, y);
    for (int k = 0; k < 2; k++)
        scan_triple(s, k ? -1 : 1, t, y, &best[k]);
}

void scan_range(const struct scan *s, double from, double to, long steps, double range[2])
{
    double t[SCAN_CHUNK], y[SCAN_CHUNK], best[2] = {HUGE_VAL, HUGE_VAL};
    struct window w = {.n = 0};
    for (long first = 0; first <= steps; first += SCAN_CHUNK) {
        size_t some = (size_t)(steps + 1 - first < SCAN_CHUNK ? steps + 1 - first : SCAN_CHUNK);
        for (size_t i = 0; i < some; i++)
            t[i] = from + (to - from) * ((double)(first + (long)i) / (double)steps);
        s->at(s->self, some, t, y);
        for (size_t i = 0; i < some; i++) {
            window_add(&w, t[i], y[i]);
            for (int k = 0; k < 2; k++) {
                double sign = k ? -1 : 1;
                best[k] = fmin(best[k], sign * y[i]);
                if (w.n >= 3) scan_triple(s, sign, w.t, w.y, &best[k]);
            }
        }
    }
    scan_end(s, from, from + (to - from) / (double)steps, best);
    scan_end(s, to, to - (to - from) / (double)steps, best);
    range[0] = best[0];
    range[1] = -best[1];
}
