/* How many Chebyshev nodes keep an error.

   On x in [-1, 1] let a mode be e^(c x) e^(i a x tau) e^(-tau), tau its time in units of 1/sigma: a = `phase`, c = `change`/2. Chebyshev's
   coefficients of e^(i a x tau) are 2 i^m J_m(a tau), and over its decay

       b_m^2 = 2 int_0^inf (2 J_m(a tau))^2 e^(-2 tau) dtau = (8/(pi a)) Q_(m-1/2)(1 + 2/a^2)
             ~ (8/(pi a)) sqrt(pi/(2 m sinh eta)) q^(2 m),   q = e^(-eta/2) = a/(1 + sqrt(1 + a^2))

   (DLMF 10.22.66 and 14.15.14, cosh eta = 1 + 2/a^2, b_0 = 1). So convergence is geometric: 1/q is the largest Bernstein ellipse without
   the pole of the mode's spectrum, x = i/a. Those of e^(c x) are g_0 = I_0(c), g_m = 2 I_m(c). Of the product

       f_m = b_m g_0 + g_m:

   the terms between, b_(m-j) g_j, turn with i^(m-j) and cancel (with all in line the number of nodes came out 20 % too high).

   Interpolation at K nodes leaves out those from K on and folds them back (T_K on T_(K-2) ...): each counts with mean square 1/2 + 1/2, and

       error^2 = sum_(m >= K) f_m^2 / mean e^(2 c x),   mean e^(2 c x) = sinh(2 c)/(2 c).

   The error that is made lies 0 to 10 dB below the one asked for, to the next whole node, up to 20 dB below where gains change by more than a factor
   of 400; tests/unit/test_nodes.c sums it up in time and place. Where decay changes, a is real instead of imaginary and the pole a little
   nearer: for 30 % the margin covers it. Sums end at 4608 terms of b and 512 of g, beyond which errors and ranges are not those of sounds.

   Of fifty modes (100 Hz to 15 kHz, 0.9 s, frequencies up to 2 %, decays up to 30 %, gains up to 10 dB) the one that moves most needs 1.3 to 2
   times the nodes that the sum of all needs: 64 nodes 43 dB, 96 54, 128 68, 192 91, 256 117; up to 0.1 %: 16 nodes 128 dB; poles that
   do not move but for decay: 8 nodes 185 dB. */
#include "convolution/nodes.h"
#include "num/real.h"

#define MARGIN 2.2 /* 3.4 dB: places are even along x and not along the angle, which makes up to 1.3 dB; decays that move too, up to 1.4 */

enum { GAINS = 512, TERMS = NODES_MOST + GAINS };

struct series {
    double b[TERMS + 1], g[GAINS + 1]; /* g scaled by e^(-c) */
};

static void decaying(struct series *s, double a)
{
    double root = sqrt(1.0 + a * a), q2 = a * a / ((1.0 + root) * (1.0 + root)), sinh_eta = 2.0 * root / (a * a);
    s->b[0] = 1.0;
    for (int m = 1; m <= TERMS; m++)
        s->b[m] = a > 0.0 ? sqrt(8.0 / (REAL_PI * a) * sqrt(REAL_PI / (2.0 * m * sinh_eta)) * real_pow(q2, m)) : 0.0;
}

/* I_m/I_(m-1) from above, by I_(m-1) = I_(m+1) + (2 m/c) I_m; then I_0 + 2 sum I_m = e^c. */
static void gains(struct series *s, double c)
{
    double ratio[GAINS + 2] = {0}, sum = 1.0;
    for (int m = GAINS; m > 0 && c > 0.0; m--)
        ratio[m] = 1.0 / (2.0 * m / c + ratio[m + 1]);
    s->g[0] = 1.0;
    for (int m = 1; m <= GAINS; m++) {
        s->g[m] = (m == 1 ? 2.0 : 1.0) * s->g[m - 1] * ratio[m];
        sum += s->g[m];
    }
    for (int m = 0; m <= GAINS; m++)
        s->g[m] /= sum;
}

int nodes_needed(double phase, double change, double error)
{
    struct series s;
    if (!(fabs(phase) < 1e9) || !(fabs(change) < GAINS))
        return NODES_MOST;
    double c = 0.5 * fabs(change), mean = c > 1e-6 ? (1.0 - real_exp(-4.0 * c)) / (4.0 * c) : 1.0, left = error * error * mean / MARGIN;
    decaying(&s, fabs(phase));
    gains(&s, c);
    int k = NODES_MOST;
    for (; k > 2; k--) {
        double f = s.b[k - 1] * s.g[0] + (k - 1 <= GAINS ? s.g[k - 1] : 0.0);
        left -= f * f;
        if (left < 0.0)
            break;
    }
    return k;
}
