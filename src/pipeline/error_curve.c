/* Of pilot runs at values v_i = low 2^i (for a knob that counts down low 2^-i), the difference of neighbours is that of
   their errors. With e ~ v^-p

     e_i = d_i / (1 - 2^-p_i)        p_i = log2(d_i / d_(i+1)), of the last one that of the one before, from 1/2 to
                                     `order`

   Between values log e is a straight line over log v. Beyond the last one it falls with that one's p, so never faster
   than `order`: what has been seen to fall more slowly is not trusted to fall faster. A sound's rest of the filters'
   ripple and of rounding is no power: ERROR_BUDGET_FLOOR, -140 dB.

   The first differences may fall by another power than the later ones, or even grow: that a value will do is told from
   them by two doublings at most, that none will do from a settled curve only. */
#include "pipeline/error_curve.h"

#include <math.h>

#include "num/real.h"

#define LOG2 0.6931471805599453
#define SLOWEST 0.5
#define ALIKE 0.25 /* orders that agree */

double error_curve_value(const struct error_curve *c, int i)
{
    return c->down ? c->low / (double)(1L << i) : c->low * (double)(1L << i);
}

static double order_at(const struct error_curve *c, int i)
{
    int at = i < c->n - 1 ? i : i - 1;
    double p = at < 0                    ? c->order - 1
               : c->distance[at + 1] > 0 ? real_log(c->distance[at] / c->distance[at + 1]) / LOG2
                                         : c->order;
    return p < SLOWEST ? SLOWEST : p > c->order ? c->order : p;
}

static double log_error(const struct error_curve *c, int i)
{
    return real_log(fmax(c->distance[i], 1e-30)) - real_log(1 - real_exp(-LOG2 * order_at(c, i)));
}

double error_curve_error(const struct error_curve *c, double value)
{
    bool same = true;
    for (int i = 0; i < c->n; i++)
        same = same && c->distance[i] == 0;
    if (same) return 0;
    double x = real_log(c->down ? c->low / value : value / c->low) / LOG2, last = c->n - 1;
    int i = x < 0 ? 0 : x > last ? c->n - 1 : (int)x;
    double slope = i < c->n - 1 && x >= 0 ? log_error(c, i) - log_error(c, i + 1) : LOG2 * order_at(c, i);
    return fmax(real_exp(log_error(c, i) - slope * (x - i)), ERROR_BUDGET_FLOOR);
}

bool error_curve_converged(const struct error_curve *c)
{
    if (c->n < 1) return false;
    double next = error_curve_value(c, c->n + 1);
    if (c->n == ERROR_CURVE_MOST || c->distance[c->n - 1] == 0 || (c->down ? next < c->end : next > c->end))
        return true;
    if (c->n < ERROR_CURVE_FAR) return false;
    double last = order_at(c, c->n - 2), before = order_at(c, c->n - 3);
    return last > SLOWEST && before > SLOWEST && fabs(last - before) <= ALIKE;
}

bool error_curve_enough(const struct error_curve *c, double error)
{
    if (error_curve_converged(c)) return true;
    if (c->n < 1) return false;
    double next = error_curve_value(c, c->n), second = error_curve_value(c, c->n + 1);
    return real_exp(log_error(c, c->n - 1)) <= error ||
           (c->n > 1 && (error_curve_error(c, next) <= error || error_curve_error(c, second) <= error / 2));
}

double error_curve_best(const struct error_curve *c)
{
    double best = c->end;
    for (int i = c->n - 1; i >= 0; i--)
        if (error_curve_error(c, error_curve_value(c, i)) < error_curve_error(c, best)) best = error_curve_value(c, i);
    return best;
}

double error_curve_least(const struct error_curve *c, double error)
{
    double step = c->down ? -1 : 1;
    for (double v = c->low; c->down ? v >= c->end : v <= c->end; v += step)
        if (error_curve_error(c, v) <= error) return v;
    return NAN;
}
