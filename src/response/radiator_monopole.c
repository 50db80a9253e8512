/* Pulsating sphere (Morse and Ingard, Theoretical Acoustics, 7.1; Kinsler et al., Fundamentals of Acoustics, 7.1):
   surface velocity v on a sphere of radius a makes at the distance r > a of its middle the pressure

       p = rho c v (a / r) j k a / (1 + j k a) e^(-j k (r - a)) ,   k = w / c ,

   that is, without the delay (r - a)/c, p = H(s) v with

       H(s) = K s / (s + w) ,   K = rho c a / r (Pa per m/s) ,   w = c / a (1/s) .

   A velocity that is Im sum A_i e^(s_i t) from t = 0 on becomes, by partial fractions, exactly

       p(t) = Im sum A_i H(s_i) e^(s_i t)  +  e^(-w t) Im sum A_i K w / (s_i + w) :

   modes of other gains, and one component of the radiator's own, of 0 Hz. s_i + w = 0 cannot be, as the frequency of no
   mode is 0. No response at 0 Hz (H(0) = 0), so no direct term: modes_direct's sum over all components is 0 but for
   rounding.

   A sampled response stands for the continuous one while it does not decay within a sample. The own component is kept
   while w <= 2.4 rate (a = 3 mm at 48 kHz); of a smaller object it is left out, and modes_direct, whose sum is then Im
   sum A_i K / (s_i + w), puts its whole area at t = 0: K/w = rho a^2 / r is then all that counts, and the pressure is
   the acceleration of a volume. What is lost is the fraction j w_audio / w of that one component. (At 2.4 both ways are
   off alike; a small object's own pole, sampled, would be far too loud: by w / (2 rate).) */
#include "response/radiator_monopole.h"

#define FASTEST 2.4 /* own pole over sample rate */

struct radiator_monopole radiator_monopole(double radius, double distance, double density, double sound_speed)
{
    return (struct radiator_monopole){density * sound_speed * radius / distance, sound_speed / radius};
}

/* factor / (s + w) */
static void over(const struct radiator_monopole *m, const double s[2], const double factor[2], double q[2])
{
    double x = s[0] + m->pole, y = s[1], power = x * x + y * y;
    q[0] = (factor[0] * x + factor[1] * y) / power;
    q[1] = (factor[1] * x - factor[0] * y) / power;
}

void radiator_monopole_at(const struct radiator_monopole *m, const double s[2], double h[2])
{
    over(m, s, (const double[2]){m->gain * s[0], m->gain * s[1]}, h);
}

void radiator_monopole_own(const struct radiator_monopole *m, const double s[2], double share[2])
{
    over(m, s, (const double[2]){m->gain * m->pole, 0}, share);
}

bool radiator_monopole_sampled(const struct radiator_monopole *m, double rate) { return m->pole <= FASTEST * rate; }
