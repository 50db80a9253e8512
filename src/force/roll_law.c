/* f_roll = k rho^1.5 (1 + mu rho') for rho > 0, else 0, and never below 0: papers/000 equation 15 with lambda = mu k.

   rho is taken as a straight line over each sub-interval dt, so rho' is constant there, the mean of k rho^1.5 is closed form and that of the
   dissipative term is exactly (2/5) lambda (b^2.5 - a^2.5) / dt. The error is k (rho^1.5)'' dt^2 / 12 where rho > 0 and of the same order where it
   passes through 0, as rho^1.5 has a continuous first derivative there. The paper says nothing of rho < 0 (its power is then no number) and of rho'
   < -1/mu, where the force would pull: no force. */
#include "force/roll_law.h"

#include "num/real.h"

double roll_law_force(const struct roll_law *l, double a, double b, double dt)
{
    double damped = 1 + l->mu * (b - a) / dt;
    return damped > 0 ? l->stiffness * damped * roll_law_power(a, b).mean : 0;
}

double roll_law_contact(double a, double b)
{
    double most = a > b ? a : b, least = a > b ? b : a;
    return least > 0 ? 1 : most > 0 ? most / (most - least) : 0;
}

double roll_law_rest(double normal, double stiffness)
{
    return normal > 0 ? real_pow(normal / stiffness, 2.0 / 3) : 0;
}
