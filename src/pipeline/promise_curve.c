/* Of rehearsals at values v_i = low 2^i (for a knob that counts down low 2^-i), the difference of neighbours is that of
   their errors. With e ~ v^-p

     e_i = d_i / (1 - 2^-p_i)        p_i = log2(d_i / d_(i+1)), of the last one that of the one before, from 1/2 to
                                     `order`

   Between values log e is a straight line over log v. Beyond the last one it falls with that one's p, so never faster
   than `order`: what has been seen to fall more slowly is not trusted to fall faster. A sound's rest of the filters'
   ripple and of rounding is no power: PROMISE_FLOOR, -140 dB.

   The first differences may fall by another power than the later ones, or even grow: that a value will do is told from
   them by two doublings at most, that none will do from a settled curve only. */
#include "pipeline/promise_curve.h"

#include <math.h>

#include "num/real.h"

#define LOG2 0.6931471805599453
#define SLOWEST 0.5
#define ALIKE 0.25 /* orders that agree */

double promise_curve_value(const struct promise_curve *c, int i)
{
    return c->down ? c->low / (double)(1L << i) : c->low * (double)(1L << i);
}

static double order_at(const struct promise_curve *c, int i)
{
    int at = i < c->n - 1 ? i : i - 1;
    double p = at < 0                 ? c->order - 1
               : c->apart[at + 1] > 0 ? real_log(c->apart[at] / c->apart[at + 1]) / LOG2
                                      : c->order;
    return p < SLOWEST ? SLOWEST : p > c->order ? c->order : p;
}

/* Octaves from the first rehearsal. */
static double octaves(const struct promise_curve *c, double value)
{
    return real_log(c->down ? c->low / value : value / c->low) / LOG2;
}

static double log_error(const struct promise_curve *c, int i)
{
    return real_log(fmax(c->apart[i], 1e-30)) - real_log(1 - real_exp(-LOG2 * order_at(c, i)));
}

double promise_curve_error(const struct promise_curve *c, double value)
{
    bool same = true;
    for (int i = 0; i < c->n; i++)
        same = same && c->apart[i] == 0;
    if (same) return 0;
    double x = octaves(c, value), last = c->n - 1;
    int i = x < 0 ? 0 : x > last ? c->n - 1 : (int)x;
    double slope = i < c->n - 1 && x >= 0 ? log_error(c, i) - log_error(c, i + 1) : LOG2 * order_at(c, i);
    return fmax(real_exp(log_error(c, i) - slope * (x - i)), PROMISE_FLOOR);
}

static bool ended(const struct promise_curve *c)
{
    double next = promise_curve_value(c, c->n + 1);
    return c->n == PROMISE_CURVE_MOST || c->apart[c->n - 1] == 0 || (c->down ? next < c->end : next > c->end);
}

bool promise_curve_settled(const struct promise_curve *c)
{
    if (c->n < 1) return false;
    if (ended(c)) return true;
    if (c->n < PROMISE_CURVE_FAR) return false;
    double last = order_at(c, c->n - 2), before = order_at(c, c->n - 3);
    return last > SLOWEST && before > SLOWEST && fabs(last - before) <= ALIKE;
}

bool promise_curve_enough(const struct promise_curve *c, double error)
{
    if (promise_curve_settled(c)) return true;
    if (c->n < 1) return false;
    double next = promise_curve_value(c, c->n), second = promise_curve_value(c, c->n + 1);
    return real_exp(log_error(c, c->n - 1)) <= error ||
           (c->n > 1 && (promise_curve_error(c, next) <= error || promise_curve_error(c, second) <= error / 2));
}

double promise_curve_best(const struct promise_curve *c)
{
    double best = c->end;
    for (int i = c->n - 1; i >= 0; i--)
        if (promise_curve_error(c, promise_curve_value(c, i)) < promise_curve_error(c, best))
            best = promise_curve_value(c, i);
    return best;
}

double promise_curve_least(const struct promise_curve *c, double error)
{
    double step = c->down ? -1 : 1;
    for (double v = c->low; c->down ? v >= c->end : v <= c->end; v += step)
        if (promise_curve_error(c, v) <= error) return v;
    return NAN;
}
