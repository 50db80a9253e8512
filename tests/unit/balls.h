/* One ball for the tests of the coupled contact's integrators: made, dropped, and the closed form of its impact. */
#ifndef BALLS_H
#define BALLS_H
#include <math.h>

#include "convolution/coupled.h"
#include "scene/scene.h"

#define BALL_MASS 0.0105 /* kg: 1 cm of glass */
#define BALL_GRAVITY 9.80665
#define BALL_RATE 44100.0

struct ball_case {
    int integrator;
    double kappa, mu, gravity, rate; /* N/m^1.5/kg, s/m, m/s^2, 1/s */
};

static inline struct coupled *ball_make(struct arena *a, struct ball_case b)
{
    struct err e = {0};
    struct coupled *c = NULL;
    struct coupled_ask ask = {.integrator = b.integrator,
                              .step = 1 / b.rate,
                              .mass = BALL_MASS,
                              .weight = BALL_MASS * b.gravity,
                              .stiffness = b.kappa * BALL_MASS,
                              .mu = b.mu};
    ck_assert_msg(coupled_make(a, &ask, &c, &e), "%s", e.text);
    return c;
}

/* Speed of leaving, m/s, of an impact at v: (mu v - ln(1 + mu v)) is the same before and after (Papetti et al. 2011).
 */
static inline double ball_leaves(double mu, double v)
{
    long double from = (long double)mu * v, kept = from - log1pl(from), low = -1, high = 0;
    for (int i = 0; i < 200; i++) {
        long double middle = (low + high) / 2;
        *(middle - log1pl(middle) > kept ? &low : &high) = middle;
    }
    return mu > 0 ? (double)(-low / mu) : v;
}

struct ball_impact {
    double leaves, momentum; /* m/s; N s handed over               */
    double least;            /* N: the smallest force              */
    double loss;             /* J                                  */
    bool made;
};

/* One impact at speed v, begun `phase` of a step above flat ground. */
static inline struct ball_impact ball_impact(struct coupled *c, double rate, double v, double phase, struct err *e)
{
    enum { AT_ONCE = 16 };
    struct ball_impact r = {.least = INFINITY, .made = false};
    double surface[AT_ONCE] = {0}, force[AT_ONCE];
    coupled_start(c, v * phase / rate, -v, 0, NULL, false);
    while (coupled_state(c)->lift_offs == 0) {
        if (!coupled_run(c, AT_ONCE, surface, NULL, force, e)) return r;
        for (int i = 0; i < AT_ONCE; i++) {
            r.momentum += force[i] / rate;
            r.least = fmin(r.least, force[i]);
        }
        if (coupled_state(c)->steps > 100000000) return r;
    }
    r.leaves = coupled_state(c)->speed;
    r.loss = coupled_state(c)->contact_loss;
    r.made = true;
    return r;
}

/* A smooth ground, m: three hills of about 1.2 cm, 4 mm and 2.5 mm at 0.2 m/s. */
static inline double ball_hills(double t)
{
    return 1e-6 * (cos(105 * t) + 0.3 * sin(310 * t + 1) + 0.1 * cos(503 * t + 2)) -
           1e-6 * (1 + 0.3 * sin(1.0) + 0.1 * cos(2.0));
}

/* Heights every 1/BALL_RATE s of a run over `height` times the hills, dropped from `drop` above rest: [n]. */
static inline void ball_roll(struct ball_case b, int over, double height, double drop, int n, double *w)
{
    struct arena *a = arena_open();
    struct err e = {0};
    b.rate = BALL_RATE * over;
    struct coupled *c = ball_make(a, b);
    double *surface = ARENA_TAKE(a, double, over), *force = ARENA_TAKE(a, double, over);
    coupled_start(c, coupled_rest(c, 0, NULL) + drop, 0, 0, NULL, false);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < over; j++)
            surface[j] = height * ball_hills((i + (j + 1.0) / over) / BALL_RATE);
        ck_assert_msg(coupled_run(c, over, surface, NULL, force, &e), "%s", e.text);
        w[i] = coupled_state(c)->height;
    }
    arena_close(a);
}

static inline double ball_distance(int n, const double *x, const double *y)
{
    double most = 0;
    for (int i = 0; i < n; i++)
        most = fmax(most, fabs(x[i] - y[i]));
    return most;
}

#endif
