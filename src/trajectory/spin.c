/* A ball that rolls without slipping, its centre of mass r off its geometric centre:

     x = R theta - r sin(theta)            papers/000 equation 18, x = u + x(start) the way of the centre of mass
     rise = -r cos(theta)                  height of the centre of mass over the geometric centre, which stays R above a
                                           level surface
     rim = lobe_height cos(lobes theta)  how much further out than R the rim lies where it touches

     theta  rad, 0: the centre of mass is lowest     R, r  m     primes: by time, each the derivative of the formula
                                                                 above it:
     theta' = u' / (R - r cos theta)       theta'' = (u'' - r sin(theta) theta'^2) / (R - r cos theta)

   Equations 16 and 17 put theta = x / R into the cosine, which is right for r = 0 only; here theta solves 18, and
   `printed` is -r cos(x/R) for who wants it as it stands. The point that touches is r sin(theta) away from x along the
   way; like the paper, what reads the surface reads it at x.

   Equation 18 is Kepler's: phi - q sin(phi) = y, q = r / R < 1, y = x / R less whole turns, |y| <= pi. On [0, pi] the
   left side is rising and convex, so Newton's method from above, from min(y + q, pi), falls to the root and nowhere
   overshoots but by rounding: a value that does not fall any more is the root. (Each is iterated until it stands,
   whatever its neighbours do: values do not depend on how instants are grouped.) Whole turns are taken off y with 2 pi
   in three parts, the first two of 20 bits, so that phi keeps its digits however far the ball has rolled: what remains
   is the rounding of u itself. */
#include "trajectory/spin.h"

#include <assert.h>
#include <math.h>

#include "num/real.h"
#include "num/vecmath.h"

enum { SPIN_CHUNK = 256, SPIN_MOST = 200 };

/* 2 pi = the sum of these, to 5e-29; k times the first two is exact for |k| < 2^33. */
static const double TURN[3] = {6.283180236816406, 5.070360202807933e-06, 2.9774189921946493e-12};

struct spin spin_make(const struct contact *c)
{
    const struct ball *b = &c->ball;
    return (struct spin){.radius = b->radius,
                         .offset = b->offset,
                         .start = b->start_angle,
                         .lobe_height = b->lobe_height,
                         .lobes = b->lobes};
}

struct chunk {
    double turns[SPIN_CHUNK], phi[SPIN_CHUNK]; /* theta = 2 pi turns + phi */
    double y[SPIN_CHUNK];                      /* |x / R - 2 pi turns|     */
    double s[SPIN_CHUNK], c[SPIN_CHUNK];       /* sin, cos of phi          */
};

/* sin and cos of k angles in rad, of a few turns at most. */
static void spin_sincos(size_t n, const double *angle, double k, double *s, double *c)
{
    double x[SPIN_CHUNK];
    for (size_t i = 0; i < n; i++)
        x[i] = k * angle[i] / REAL_PI;
    vecmath_sincospi(n, x, s, c);
}

/* One step of Newton's method for each; is any not yet at rest? */
static bool spin_step(size_t n, double q, const double *y, struct chunk *o)
{
    double moved = 0;
    spin_sincos(n, o->phi, 1, o->s, o->c);
    for (size_t i = 0; i < n; i++) {
        double next = o->phi[i] - ((o->phi[i] - y[i]) - q * o->s[i]) / (1 - q * o->c[i]);
        moved += next < o->phi[i];
        o->phi[i] = next < o->phi[i] ? next : o->phi[i];
    }
    return moved > 0;
}

static void spin_solve(const struct spin *s, size_t n, const double *u, struct chunk *o)
{
    double q = s->offset / s->radius, *y = o->y, sign[SPIN_CHUNK];
    double start = s->radius * s->start - s->offset * real_sin(s->start);
    for (size_t i = 0; i < n; i++) {
        double x = (u[i] + start) / s->radius, k = rint(x / (2 * REAL_PI));
        x = ((x - k * TURN[0]) - k * TURN[1]) - k * TURN[2];
        o->turns[i] = k;
        sign[i] = x < 0 ? -1 : 1;
        y[i] = fabs(x);
        o->phi[i] = y[i] + q < REAL_PI ? y[i] + q : fmax(y[i], REAL_PI);
    }
    for (int step = 0; q > 0 && step < SPIN_MOST && spin_step(n, q, y, o); step++)
        ;
    for (size_t i = 0; i < n; i++)
        o->phi[i] *= sign[i];
    spin_sincos(n, o->phi, 1, o->s, o->c);
}

struct rates {
    const double *du, *ddu; /* NULL: not needed */
};

/* Turning, and what follows from it, at n <= SPIN_CHUNK instants. */
static void spin_motion(const struct spin *p, size_t n, const struct chunk *o, const struct rates *m,
                        const struct spin_out *out)
{
    double r = p->offset;
    for (size_t i = 0; i < n; i++) {
        double s = o->s[i], c = o->c[i], lever = p->radius - r * c;
        double w = m->du ? m->du[i] / lever : 0;
        if (out->theta)
            out->theta[i] = o->turns[i] * TURN[0] + (o->turns[i] * TURN[1] + (o->turns[i] * TURN[2] + o->phi[i]));
        if (out->turning) out->turning[i] = w;
        if (out->rise) out->rise[i] = -r * c;
        if (out->climb) out->climb[i] = r * s * w;
        if (out->lift) out->lift[i] = r * (c * w * w + s * ((m->ddu[i] - r * s * w * w) / lever));
    }
}

static void spin_rim(const struct spin *p, size_t n, const struct chunk *o, const struct rates *m,
                     const struct spin_out *out)
{
    double s[SPIN_CHUNK], c[SPIN_CHUNK], h = p->lobe_height, k = p->lobes;
    if (!out->rim && !out->swell && !out->heave) return;
    spin_sincos(n, o->phi, p->lobes, s, c);
    for (size_t i = 0; i < n; i++) {
        double lever = p->radius - p->offset * o->c[i], w = m->du ? m->du[i] / lever : 0;
        if (out->rim) out->rim[i] = h * c[i];
        if (out->swell) out->swell[i] = -h * k * s[i] * w;
        if (out->heave)
            out->heave[i] = -h * k * (k * c[i] * w * w + s[i] * ((m->ddu[i] - p->offset * o->s[i] * w * w) / lever));
    }
}

static double *later(double *x, size_t first) { return x ? x + first : NULL; }

void spin_at(const struct spin *s, size_t n, const double *u, const double *du, const double *ddu,
             const struct spin_out *out)
{
    struct chunk o;
    assert(s->offset >= 0 && s->offset < s->radius && (ddu || (!out->lift && !out->heave)) &&
           (du || (!out->turning && !out->climb && !out->lift && !out->swell && !out->heave)));
    for (size_t first = 0; first < n; first += SPIN_CHUNK) {
        size_t some = n - first < SPIN_CHUNK ? n - first : SPIN_CHUNK;
        struct spin_out at = {later(out->theta, first), later(out->turning, first), later(out->rise, first),
                              later(out->climb, first), later(out->lift, first),    later(out->rim, first),
                              later(out->swell, first), later(out->heave, first),   later(out->printed, first)};
        struct rates m = {du ? du + first : NULL, ddu ? ddu + first : NULL};
        spin_solve(s, some, u + first, &o);
        spin_motion(s, some, &o, &m, &at);
        spin_rim(s, some, &o, &m, &at);
        double sine[SPIN_CHUNK], cosine[SPIN_CHUNK];
        if (at.printed) spin_sincos(some, o.y, 1, sine, cosine);
        for (size_t i = 0; at.printed && i < some; i++)
            at.printed[i] = -s->offset * cosine[i];
    }
}
