/* f_roll = k rho^1.5 (1 + mu rho') for rho > 0, else 0, and never below 0: papers/000 equation 15 with lambda = mu k.

   Over a sub-interval dt from a to b, with rho' known at both ends, and rho in the mean (of what is smooth (a + b)/2 +
   dt (rho'_a - rho'_b)/12, Euler and Maclaurin):

     mean rho^1.5       of the straight line from a to b, raised by what the mean of rho lies above it
     its late part      half of it and (b^1.5 - a^1.5) / 12
     lambda rho^1.5 rho' is dQ/dt, Q = (2/5) lambda rho^2.5, mean Q = (Q_a + Q_b) / 2 + dt (Q'_a - Q'_b) / 12; early and
   late parts as in force/scrape.c

   The error is of order dt^4 where rho is smooth, of order dt^3 where rho'' jumps, as it does where the limiter
   saturates, and dt^2.5 where rho passes through 0, as rho^1.5 has a continuous first derivative there. The paper says
   nothing of rho < 0 (its power is then no number) and of rho' < -1/mu, where the force would pull: no force. */
#include "force/roll_law.h"

/* max(0, rho)^1.5 */
static double roll_power_at(double rho) { return rho > 0 ? rho * sqrt(rho) : 0; }

struct roll_parts roll_law_force(const struct roll_law *l, const struct roll_end *a, const struct roll_end *b,
                                 double mean, double dt)
{
    double k = l->stiffness, lambda = k * l->mu, pa = roll_power_at(a->rho), pb = roll_power_at(b->rho),
           bow = mean - 0.5 * (a->rho + b->rho);
    double spring = 0.5 * k * roll_law_power(a->rho + bow, b->rho + bow), tilt = k * (pb - pa) / 12;
    double qa = 0.4 * lambda * pa * a->rho, qb = 0.4 * lambda * pb * b->rho, half = 0.5 * (qb - qa) / dt,
           bulge = lambda * (pa * a->rate - pb * b->rate) / 12;
    if (dt + l->mu * (b->rho - a->rho) <= 0) return (struct roll_parts){0};
    return (struct roll_parts){spring - tilt + half + bulge, spring + tilt + half - bulge};
}

double roll_law_contact(double a, double b)
{
    double most = a > b ? a : b, least = a > b ? b : a;
    return least > 0 ? 1 : most > 0 ? most / (most - least) : 0;
}
