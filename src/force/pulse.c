/* Pulses of elastic impacts on a body that does not give way. With x the penetration, v the speed of arrival, m the
   mass, k the stiffness:

     half_sine   m x'' = -k x         f = v sqrt(k m) sin(t sqrt(k/m))       contact time t_c = pi sqrt(m/k)
     hertz       m x'' = -k x^1.5     x_m = (5 m v^2 / (4 k))^(2/5)          contact time t_c = 2.9432752 x_m / v
                                      largest force k x_m^1.5                2.9432752 = (4/5) B(2/5, 1/2), B Euler's
                                        beta function

   (H. Hertz 1882; K. Johnson, Contact Mechanics, 1985, section 11.4.) Either way the speed is reversed and the momentum
   handed over is 2 m v. What is wanted is exact means of the force over any interval: differences of the momentum
   handed over so far, m (v - x'). Its share of the whole is p = (1 - x'/v) / 2, a function of q = t / t_c alone:

     half_sine   p = sin^2(pi q / 2)
     hertz       y = x / x_m, s = t v / x_m:  y'' = -(5/4) y^1.5, y = s G(z), z = s^2.5, G analytic: the equation gives
                 G's series

       g_0 = 1,   g_{n+1} a (1 + a) = -(5/4) h_n,  a = 5 (n + 1) / 2,   sum h_n z^n = (sum g_n z^n)^1.5   (Miller's
         recurrence)
       p = -1/2 sum over n >= 1 of g_n (1 + 5 n / 2) z^n    for q <= 1/2;   p(q) = 1 - p(1 - q) beyond

   At q = 1/2, where it converges most slowly, terms fall by 11 and more; the first one left out is 2e-24. No power but
   s^2 sqrt(s) is taken. */
#include "force/pulse.h"

#include <math.h>

#include "num/real.h"
#include "num/vecmath.h"

static void hertz_series(double term[PULSE_TERMS])
{
    double g[PULSE_TERMS + 1] = {1}, h[PULSE_TERMS + 1] = {1};
    for (int n = 1; n <= PULSE_TERMS; n++) {
        double a = 2.5 * n, sum = 0;
        g[n] = -1.25 * h[n - 1] / (a * (1 + a));
        for (int k = 1; k <= n; k++)
            sum += (2.5 * k - n) * g[k] * h[n - k];
        h[n] = sum / n;
        term[n - 1] = -0.5 * g[n] * (1 + a);
    }
}

struct pulse_shape pulse_make(int kind)
{
    struct pulse_shape p = {.kind = kind, .scale = kind == PULSE_HERTZ ? 2.94327518432470455 : REAL_PI};
    if (kind == PULSE_HERTZ) hertz_series(p.term);
    return p;
}

double pulse_lasts(const struct pulse_shape *p, double mass, double stiffness, double speed)
{
    if (p->kind == PULSE_HALF_SINE) return p->scale * sqrt(mass / stiffness);
    return p->scale * real_pow(1.25 * mass * speed * speed / stiffness, 0.4) / speed;
}

/* q <= 1/2 */
static double share_early(const struct pulse_shape *p, double q)
{
    double s = p->scale * q, z = s * s * sqrt(s), sum = 0;
    if (p->kind == PULSE_HALF_SINE) {
        s = real_sinpi(0.5 * q);
        return s * s;
    }
    for (int n = PULSE_TERMS - 1; n >= 0; n--)
        sum = (sum + p->term[n]) * z;
    return sum;
}

double pulse_share(const struct pulse_shape *p, double q)
{
    if (q <= 0 || q >= 1) return q >= 1;
    return q <= 0.5 ? share_early(p, q) : 1 - share_early(p, 1 - q);
}

/* ------------------------------------------------------------------ raised cosines */

/* The covered area of a raised cosine, phi = (1 + cos(2 pi q)) / 2 on -1/2 < q < 1/2, over the whole, 1/2:

     share(q) = q + 1/2 + sin(2 pi q) / (2 pi). */

double pulse_cosine(double q)
{
    if (q <= -0.5 || q >= 0.5) return q >= 0.5;
    return 0.5 + (q + real_sinpi(2 * q) / (2 * REAL_PI));
}

void pulse_cosines(int n, double *q)
{
    double sine[PULSE_COSINES], unused[PULSE_COSINES];
    if (n < 1) return;
    for (int i = 0; i < n; i++) {
        q[i] = q[i] < -0.5 ? -0.5 : q[i] < 0.5 ? q[i] : 0.5; /* where the sine is 0 exactly */
        sine[i] = 2 * q[i];
    }
    vecmath_sincospi((size_t)n, sine, sine, unused);
    for (int i = 0; i < n; i++)
        q[i] = 0.5 + (q[i] + sine[i] / (2 * REAL_PI));
}
