/* The error of interpolating between responses whose poles move evenly, in closed form.

   A mode of an impulse response is h_u(tau) = A e^(s(u) tau), u the place in nodes (node k at u = k), s = -sigma + j
   omega. The polynomial through p nodes (p = 1, 2, 4) errs, to leading order, by

       l_p(u) d^p/du^p h_u(tau),   l_1 = u                          |u| <= 1/2
                                   l_2 = u (u - 1)/2                0 <= u <= 1
                                   l_4 = (u+1) u (u-1) (u-2)/24     0 <= u <= 1

   and d^p/du^p h = (s' tau)^p h, s' = ds/du (what a gain that moves adds, and s'' and beyond, have lower powers of tau
   and are left out). Its energy, int tau^(2p) e^(-2 sigma tau) dtau = (2p)!/(2 sigma)^(2p+1), against int e^(-2 sigma
   tau) dtau = 1/(2 sigma):

       eps_p = k_p rho^p,   rho = |s'|/sigma,   k_p = (mean of l_p^2)^(1/2) ((2p)!)^(1/2) / 2^p

       mean of l_p^2:  1/12, 1/120, 103/362880
       k_p^2:          1/24, 1/80, 103/2304            k_p = 0.2041, 0.1118, 0.2114

   rho is the pole's movement per hop in half bandwidths (sigma is half of the -3 dB bandwidth in rad/s). With noise as
   the force, the errors of different samples are independent, and eps is the sound's relative rms error too; of several
   modes, the root of the mean of eps^2 weighted by |A|^2/sigma. Within 2 dB up to rho = 0.35; beyond it order 4 does
   better than this (by 3.5 dB at 0.5). test_hop.c compares it with the integral, test_launch.c with brute force. */
#ifndef HOP_H
#define HOP_H
#include <math.h>

/* k_p^2 */
static inline double hop_constant(int order) { return order == 1 ? 1.0 / 24 : order == 2 ? 1.0 / 80 : 103.0 / 2304; }

/* Relative rms error (amplitude) of interpolation between responses whose pole moves by `rho` half bandwidths from one
 * to the next. */
static inline double hop_error(int order, double rho)
{
    double power = order == 1 ? rho : order == 2 ? rho * rho : (rho * rho) * (rho * rho);
    return sqrt(hop_constant(order)) * power;
}

/* The rho that makes that error. */
static inline double hop_rho(int order, double error)
{
    double power = error / sqrt(hop_constant(order));
    return order == 1 ? power : order == 2 ? sqrt(power) : sqrt(sqrt(power));
}

#endif
