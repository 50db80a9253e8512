/* Hertz's k xi^1.5 while the penetration goes in a straight line from xi to xi+: with a^2, b^2 = xi, xi+, both above 0,
   its mean is

     (2/5) k (b^5 - a^5) / (b^2 - a^2) = (2/5) k (b^4 + b^3 a + b^2 a^2 + b a^3 + a^4) / (a + b),

   the discrete gradient of the potential (2/5) k xi^2.5 too. The right-hand form loses no digits where xi and xi+ are
   all but equal. */
#ifndef FORCE_HERTZ_MEAN_H
#define FORCE_HERTZ_MEAN_H

/* b^4 + b^3 a + b^2 a^2 + b a^3 + a^4; aa, bb: a^2, b^2. */
static inline double hertz_mean_quartic(double a, double b, double aa, double bb)
{
    double ab = a * b;
    return bb * bb + ab * (bb + ab + aa) + aa * aa;
}

#endif
