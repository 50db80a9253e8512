/* How many Chebyshev nodes keep an error.

   On x in [-1, 1] let a mode be e^(c x) e^(i a x tau) e^(-tau), tau its time in units of 1/sigma: a is half the range of its pole over its
   least decay sigma, c = `change`/2. It is heard for tau <= R = sigma seconds. Chebyshev's coefficients of e^(i a x tau) are 2 i^m J_m(a tau), and over what is heard of it

       b_m^2 = (2/(1 - e^(-2 R))) int_0^R (2 J_m(a tau))^2 e^(-2 tau) dtau,   b_0 = 1.

   The integrand is largest at tau = m/sqrt(1 + a^2). Where that is heard, the whole integral stands for what is heard of it,

       2 int_0^inf (2 J_m(a tau))^2 e^(-2 tau) dtau = (8/(pi a)) Q_(m-1/2)(1 + 2/a^2)
             ~ (8/(pi a)) sqrt(pi/(2 m sinh eta)) q^(2 m),   q = e^(-eta/2) = a/(1 + sqrt(1 + a^2))

   (DLMF 10.22.66 and 14.15.14, cosh eta = 1 + 2/a^2): convergence is geometric, 1/q the largest Bernstein ellipse without the pole of the mode's
   spectrum, x = i/a. Where it is not, the integrand grows until the end by at least e^(mu tau/R), mu = 2 (r - R), r = sqrt(m^2 - X^2), X = a R the
   phase by which the mode drifts until then, and

       b_m^2 < (8 R/(1 - e^(-2 R))) J_m(X)^2 e^(-2 R) (1 - e^(-mu))/mu,   J_m(X) < e^(r - m log((m + r)/X))/sqrt(2 pi r), 0.675 m^(-1/3)

   (Debye; DLMF 10.19.3 and 10.14.2): nothing is left soon after m = X, however little the mode decays. Coefficients of e^(c x) are g_0 = I_0(c), g_m =
   2 I_m(c). A decay that changes does so in the logarithm, sigma(x) = sqrt(low high) e^(rho x), and so has terms of its own where little is heard of it
   and X is small: to first order in time, e^(-sigma(x) t) has h_m = sqrt(low high) t 2 I_m(rho), t <= min(seconds, 1/low). Of the product

       f_m = b_m g_0 + g_m + h_m:

   the terms between, b_(m-j) g_j, turn with i^(m-j) and cancel (with all in line the number of nodes came out 20 % too high).

   Interpolation at K nodes leaves out those from K on and folds them back (T_K on T_(K-2) ...): each counts with mean square 1/2 + 1/2, and

       error^2 = sum_(m >= K) f_m^2 / mean e^(2 c x),   mean e^(2 c x) = sinh(2 c)/(2 c).

   The error that is to be expected lies mostly 5 to 15 dB below the one asked for, to the next whole node; farther below (36 to 56 dB: some nodes too many) where modes hardly decay, and most where
   decays change tenfold; tests/unit/test_nodes.c sums it up in time and place. What is launched later is heard for less than `seconds`, which makes the error
   less still. Where decay changes, a is real instead of imaginary and the pole a little nearer: for 30 % the margin covers it. Sums end at 4608 terms
   of b and 512 of g, beyond which errors and ranges are not those of sounds.

   Of fifty modes (100 Hz to 15 kHz, 0.9 s, frequencies up to 2 %, decays up to 30 %, gains up to 10 dB) the one that moves most needs 1.3 to 2
   times the nodes that the sum of all needs: 64 nodes 43 dB, 96 54, 128 68, 192 91, 256 117; up to 0.1 %: 16 nodes 128 dB; poles that
   do not move but for decay: 8 nodes 185 dB. */
#include "convolution/nodes.h"
#include "num/real.h"

/* 8.5 dB: places are even along x and not along the angle, which makes up to 1.3 dB; decays that move too, up to 1.4; and the force of one sound is one
   draw, which makes up to 7 dB more where few modes ring: of 1296 sounds summed up 7 erred by up to 6 dB more with 3.4 dB in hand, none with 8.5. */
#define MARGIN 7.0

#define LEAST 1e-6 /* R: a mode that decays by less does not */

enum { GAINS = 512, TERMS = NODES_MOST + GAINS };

struct series {
    double b[TERMS + 1], g[GAINS + 1], h[GAINS + 1]; /* g scaled by e^(-c) */
};

/* b_m^2 of a mode that drifts by X until the end R; heard = 1 - e^(-2 R). The second bound of J_m is the less where r^3 < 0.043 m^2. */
static double ended(int m, double X, double R, double heard)
{
    double r = sqrt((double)m * m - X * X), mu = 2.0 * (r - R), size = real_exp(r - m * real_log((m + r) / X)) / sqrt(2.0 * REAL_PI * r);
    if (r * r * r < 0.05 * m * m)
        size = fmin(size, 0.675 * real_pow(m, -1.0 / 3.0));
    return 8.0 * R / heard * size * size * real_exp(-2.0 * R) * (mu > 1e-6 ? (1.0 - real_exp(-mu)) / mu : 1.0);
}

/* Until nothing is left. */
static void decaying(struct series *s, double a, double R)
{
    double root = sqrt(1.0 + a * a), q = a / (1.0 + root), heard = 1.0 - real_exp(-2.0 * R), square = a > 0.0 ? 1.0 : 0.0;
    double all = a > 0.0 ? 8.0 / (REAL_PI * a) * sqrt(REAL_PI * a * a / (4.0 * root)) / heard : 0.0; /* times q^(2 m)/sqrt(m) */
    s->b[0] = 1.0;
    for (int m = 1; m <= TERMS; m++) {
        all *= q * q;
        square = square > 1e-40 ? all / sqrt(m) : 0.0;
        if (square > 0.0 && m > R * root)
            square = fmin(square, ended(m, a * R, R, heard));
        s->b[m] = sqrt(square);
    }
}

/* I_m/I_(m-1) from above, by I_(m-1) = I_(m+1) + (2 m/c) I_m; then I_0 + 2 sum I_m = e^c, by which they are scaled. */
static void gains(double *g, double c)
{
    double ratio[GAINS + 2] = {0}, sum = 1.0;
    for (int m = GAINS; m > 0 && c > 0.0; m--)
        ratio[m] = 1.0 / (2.0 * m / c + ratio[m + 1]);
    g[0] = 1.0;
    for (int m = 1; m <= GAINS; m++) {
        g[m] = (m == 1 ? 2.0 : 1.0) * g[m - 1] * ratio[m];
        sum += g[m];
    }
    for (int m = 0; m <= GAINS; m++)
        g[m] /= sum;
}

static void decays(struct series *s, const struct nodes_ask *ask)
{
    double low = fmax(ask->decay[0], LEAST / ask->seconds), high = fmax(ask->decay[1], low), t = fmin(ask->seconds, 1.0 / low);
    gains(s->h, 0.5 * real_log(high / low));
    for (int m = 0; m <= GAINS; m++)
        s->h[m] *= high * t;
}

int nodes_needed(const struct nodes_ask *ask, double error)
{
    struct series s;
    double low = ask->decay[0], R = fmax(low * ask->seconds, LEAST), c = 0.5 * fabs(ask->change), range = 0.5 * (ask->decay[1] - low);
    double a = sqrt(ask->turn * ask->turn + range * range) / fmax(low, LEAST / ask->seconds);
    if (!(a * fmin(R, 1.0) < 1e9) || !(2.0 * c < GAINS))
        return NODES_MOST;
    double mean = c > 1e-6 ? (1.0 - real_exp(-4.0 * c)) / (4.0 * c) : 1.0, left = error * error * mean / MARGIN;
    decaying(&s, a, R);
    gains(s.g, c);
    decays(&s, ask);
    int k = NODES_MOST;
    for (; k > 2; k--) {
        double f = s.b[k - 1] * s.g[0] + (k - 1 <= GAINS ? s.g[k - 1] + s.h[k - 1] * s.g[0] : 0.0);
        left -= f * f;
        if (left < 0.0)
            break;
    }
    return k;
}
