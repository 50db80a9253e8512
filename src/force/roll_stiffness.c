/* The contact of a rolling ball at rest, on smooth ground and on rough.

     N     = m g cos(incline), or load.constant     static normal force
     delta = delta_H + 1.5 Rq, at least 1 nm        penetration at rest; or contact.roll.static_penetration
     k     = N / delta^1.5                          or contact.roll.stiffness, kappa: then delta = (N/k)^(2/3)
     w0^2  = 1.5 N / (delta m)                      the ball's mass on the spring d(k rho^1.5)/d(rho) at rest

     delta_H = (N/k_H)^(2/3)                        Hertz's law, force/hertz.c; 0 where a modulus is not known
     Rq^2    = <(z(p + h) - 2 z(p) + z(p - h))^2> / 6

   Two springs in series: Hertz's, 1.5 N / delta_H, and that of the asperities, N / Rq. A rough contact's stiffness is
   in proportion to its load over the height of its roughness (Greenwood and Williamson, Proc. R. Soc. A 295, 1966;
   Persson, Phys. Rev. Lett. 99, 2007, has N / (gamma h_rms) with gamma near 0.5). Departure: papers/000 sets k by
   ear.

   Rq is a mean over 1024 places p, in one coordinate over the first 20 cm or the profile's extent, in the plane over
   the map or the first 20 cm square, and as many vectors h, Gaussian, of s = 0.5 mm in each coordinate. A wave of
   wave number q passes with 1 - (4/3) exp(-q^2 s^2/2) + (1/3) exp(-2 q^2 s^2) of its square: 50 % at 2.3 mm, near the
   cut-off of 2.5 mm of ISO 21920; a tilt does not pass. Places are random, one in each of 1024 parts along x, vectors
   quasi-random (an additive recurrence, Roberts 2018) in random order, and both always the same: Rq is the ground's,
   whatever rolls there, to about 2 %. */
#include "force/roll_stiffness.h"

#include <math.h>

#include "force/hertz.h"
#include "num/noise.h"
#include "num/real.h"
#include "scene/ball.h"
#include "scene/rules.h"
#include "surface/relief.h"

enum { PLACES = 1024, BATCH = 128 };

#define ROUGH_SHARE 1.5 /* of Rq, in delta */
#define REST_LEAST 1e-9 /* m */
#define STRETCH 0.2     /* m of ground, where it has no end */
#define STEP 0.5e-3     /* m, s */

/* In [0, 1): number i of the recurrence by `step`. */
static double spread(long i, double step)
{
    double x = 0.5 + (double)i * step;
    return x - floor(x);
}

static void ground_extent(const struct relief *ground, int axis, double extent[2])
{
    extent[0] = -HUGE_VAL;
    extent[1] = HUGE_VAL;
    for (const struct relief_part *p = ground->first; p; p = p->next) {
        extent[0] = fmax(extent[0], p->from[axis]);
        extent[1] = fmin(extent[1], p->to[axis]);
    }
    if (!isfinite(extent[0]) || !isfinite(extent[1])) {
        extent[0] = 0;
        extent[1] = STRETCH;
    }
}

/* Numbers of random streams, one row each. */
enum { ALONG, ACROSS, ORDER };

/* Which vector belongs to which place: at random, as two sequences in step would meet some waves at the same phase
   again and again. */
static void shuffle(struct noise places, int order[PLACES])
{
    for (int i = 0; i < PLACES; i++) {
        int k = (int)(noise_uniform(places, ORDER, (uint64_t)i) * (i + 1));
        order[i] = order[k];
        order[k] = i;
    }
}

/* The second differences of BATCH places from number `first` on, m. */
static void second_differences(const struct relief *ground, double extent[2][2], struct noise places,
                               const int order[PLACES], long first, double to[BATCH])
{
    double x[3 * BATCH], y[3 * BATCH], z[3 * BATCH];
    for (int i = 0; i < BATCH; i++) {
        double length = STEP * sqrt(-2 * real_log(1 - spread(order[first + i], 0.75487766624669276)));
        double turn = 2 * spread(order[first + i], 0.56984029099805327);
        double along =
            (double)(first + i) + noise_uniform(places, ALONG, (uint64_t)(first + i)); /* rising: cheaply read */
        along /= PLACES;
        double across = noise_uniform(places, ACROSS, (uint64_t)(first + i));
        for (int k = 0; k < 3; k++) {
            x[3 * i + k] = extent[0][0] + along * (extent[0][1] - extent[0][0]) + (k - 1) * length * real_cospi(turn);
            y[3 * i + k] = extent[1][0] + across * (extent[1][1] - extent[1][0]) + (k - 1) * length * real_sinpi(turn);
        }
    }
    const double *beside = ground->along == ALONG_PLANE ? y : NULL;
    relief_at(ground, &(struct relief_points){3 * BATCH, x, beside}, &(struct relief_values){.z = z});
    for (int i = 0; i < BATCH; i++)
        to[i] = (z[3 * i] - z[3 * i + 1]) + (z[3 * i + 2] - z[3 * i + 1]);
}

double roll_stiffness_roughness(const struct relief *ground)
{
    struct noise places = noise_make(0, "roll_stiffness");
    double extent[2][2], difference[BATCH], sum = 0;
    int order[PLACES];
    shuffle(places, order);
    for (int axis = 0; axis < 2; axis++)
        ground_extent(ground, axis, extent[axis]);
    for (long first = 0; first < PLACES; first += BATCH) {
        second_differences(ground, extent, places, order, first, difference);
        for (int i = 0; i < BATCH; i++)
            sum += difference[i] * difference[i];
    }
    return sqrt(sum / (6.0 * PLACES));
}

static double rest_of(double normal, double stiffness) { return real_pow(normal / stiffness, 2.0 / 3); }

static double hertz_rest(const struct contact *c, double normal)
{
    struct err unknown = {0};
    double stiffness;
    return hertz_stiffness(c, &stiffness, &unknown) ? rest_of(normal, stiffness) : 0;
}

struct roll_stiffness roll_stiffness_make(const struct stage_run *r)
{
    const struct contact *c = r->contact;
    double given = ball_stiffness(c), depth = c->contact.roll.static_penetration;
    struct roll_stiffness s = {.normal = rules_load(c), .stiffness = given, .roughness = NAN, .hertz = NAN};
    if (!(s.normal > 0)) return s;
    if (isnan(given) && isnan(depth)) {
        s.roughness = roll_stiffness_roughness(r->board->relief->under);
        s.hertz = hertz_rest(c, s.normal);
        depth = fmax(s.hertz + ROUGH_SHARE * s.roughness, REST_LEAST);
    }
    s.rest = isnan(given) ? depth : rest_of(s.normal, given);
    s.stiffness = isnan(given) ? s.normal / (s.rest * sqrt(s.rest)) : given;
    s.resonance = sqrt(1.5 * s.normal / (s.rest * c->scraper.mass));
    return s;
}
