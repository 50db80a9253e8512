/* Gammatones, by which Hermes (1998, in papers/002 section II-B) models the impacts of what rolls: "the sharp onset of a conventional impact model ... is
   replaced by a more gradual onset", s(t) = sum a_i t^(gamma-1) e^(-t/tau_i) sin(2 pi f_i t), gamma = 2. Here gamma is a key of a response, and a mode that
   rings as Im(A e^(s t)), s = -1/tau + j 2 pi f, rings as

     h(t) = (t/t_p)^(gamma-1) e^((gamma-1) - t/tau) |A| sin(2 pi f t + arg A),   t_p = (gamma-1) tau
          = Im(A c t^(gamma-1) e^(s t)),                                         c = (e / ((gamma-1) tau))^(gamma-1)

   so that the envelope's greatest value, at t_p, is |A|: what gamma = 1 begins with. The paper's a_i is |A| c.

   It is a response, not a force, and it is the sound's: where output.quantity or a radiator turns what the modes hold into something else, A is
   what it is turned into, and then gets its envelope (the derivative of a gammatone, or what its radiator makes of it, would differ by a share of
   (gamma-1)/(2 pi f t)). It begins from nothing: there is no jump at t = 0, hence no direct term of an acceleration and no component of a monopole's own,
   which are there to make up for one. A mode of several slopes is one gammatone for each. An undamped mode has no t_p and is refused.

   How it is computed: gammatones.c where poles stay; where they move, t^(gamma-1) is common to all modes, and multiplies the computed responses. What
   rings later has turned further when poles are wrong: against an error that grows as t^order, white force, the gammatone's is larger by
   sqrt(G(2 gamma - 1 + 2 order) / (G(2 gamma - 1) G(1 + 2 order))), G(n) = (n-1)!. */
#include "convolution/gammatone.h"

#include <math.h>

#include "num/real.h"

#define EULER 2.71828182845904523536
#define NEPER 8.685889638065036554 /* dB */

void gammatone_gains(int gamma, int n, const double *decay, const struct modes_point *p)
{
    if (gamma <= 1)
        return;
    for (int i = 0; i < n; i++) {
        double c = EULER * decay[i] / (gamma - 1), all = c;
        for (int k = 2; k < gamma; k++)
            all *= c;
        p->re[i] *= all;
        p->im[i] *= all;
    }
}

void gammatone_sample(int gamma, double rate, struct ir_sampler *s, int quantity, const struct modes_point *p, double *h, size_t length)
{
    ir_sample(s, quantity, p, h, length); /* h[0], where jump and direct term are, is multiplied by 0 */
    for (size_t i = 0; gamma > 1 && i < length; i++) {
        double t = (double)i / rate;
        for (int k = 1; k < gamma; k++)
            h[i] *= t;
    }
}

/* Of x = t/tau. */
static double fallen(int gamma, double x)
{
    double m = gamma - 1;
    return NEPER * (x - m - m * real_log(x / m));
}

double gammatone_fallen(int gamma, double decibel)
{
    return gamma > 1 ? fallen(gamma, decibel / NEPER) : decibel;
}

double gammatone_decibel(int gamma, double decibel)
{
    double m = gamma - 1, x = decibel / NEPER + m;
    if (gamma <= 1)
        return decibel;
    for (int i = 0; i < 100; i++) /* x = d + m + m log(x/m): a contraction above m, from below */
        x = decibel / NEPER + m + m * real_log(x / m);
    return NEPER * x;
}

static double factorial(int n)
{
    double all = 1;
    for (int k = 2; k <= n; k++)
        all *= k;
    return all;
}

double gammatone_harder(int gamma, int order)
{
    return gamma <= 1 ? 1 : sqrt(factorial(2 * gamma - 2 + 2 * order) / (factorial(2 * gamma - 2) * factorial(2 * order)));
}

double gammatone_cost(int gamma)
{
    static const double cost[GAMMATONE_MOST] = {1, 1.8, 2.5, 3.5}; /* tests/bench/gammatones.c */
    return cost[gamma <= 1 ? 0 : gamma - 1];
}
