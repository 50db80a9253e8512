#include "force/crossing.h"

#include <math.h>

#include "num/vecmath.h"

/* Of |S'| over a piece on which S' goes from a to b, with that mean: of the parabola a (1 - q) + b q + bow q (1 - q),
   which has one zero between ends of opposite signs. */
struct crossing crossing_slope(double a, double b, double mean)
{
    double bow = 6 * (mean - 0.5 * (a + b)), p = b - a + bow, root = sqrt(fmax(p * p + 4 * bow * a, 0));
    double s = p < 0 ? p - root : p + root, q = s != 0 ? -2 * a / s : 0, late = 0.5 * mean + (b - a) * (1.0 / 12);
    if (a * b >= 0) return (struct crossing){fabs(mean), mean < 0 ? -late : late};
    if (!(q >= 0 && q <= 1)) q = s / (2 * bow);
    double before = q * (a + q * (0.5 * p - q * bow * (1.0 / 3))),
           lately = q * q * (0.5 * a + q * (p * (1.0 / 3) - 0.25 * q * bow));
    return (struct crossing){fabs(before) + fabs(mean - before), fabs(lately) + fabs(late - lately)};
}

/* The same of |S'|^power: Simpson's rule, or two powers of straight lines on each side of a zero. */
struct crossing crossing_power(const double s[3], double power)
{
    double p[3] = {fabs(s[0]), fabs(s[1]), fabs(s[2])}, q = p[0] / (s[0] * s[2] < 0 ? p[0] + p[2] : 1);
    if (power != 1) vecmath_pow(3, p, power, p);
    double before = p[0] * q / (1 + power), after = p[2] * (1 - q) / (1 + power);
    if (s[0] * s[2] < 0)
        return (struct crossing){before + after, before * q / (2 + power) + after * (1 - (1 - q) / (2 + power))};
    return (struct crossing){(p[0] + 4 * p[1] + p[2]) / 6, (2 * p[1] + p[2]) / 6};
}
