/* A slow judge of the directional force: its definition as differential equations in time for the slope of S as a
   vector g in fixed axes

     dg/dt = |v| (T(c) e + T(d) n - g / l),   S' = g e         c = e' H e, d = e' H n (0 on a straight path), T with
   libm's tanh

   by GSL's adaptive Runge-Kutta method of order 8. Places, velocities and heights are the program's own (tested
   elsewhere). */
#ifndef JUDGE_H
#define JUDGE_H
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "force/scrape.h"
#include "rig.h"
#include "surface/limiter.h"
#include "surface/relief.h"
#include "trajectory/load.h"
#include "trajectory/trajectory.h"

struct judge {
    const struct contact *c;
    const struct board *b;
    const struct scrape_law *law;
    double alpha, since;
    bool limits, path, curved; /* the surface follows the path; the path bends over the surface */
};

struct judge_place {
    double x, y, v, e[2]; /* v = du/dt; e: direction of increasing u */
};

static inline struct judge judge_of(const struct rig *g)
{
    const struct board *b = &g->run.board;
    const struct contact *c = &g->scene.contacts[0];
    bool path = b->relief->along == ALONG_PATH;
    return (struct judge){.c = c,
                          .b = b,
                          .law = scrape_law(c),
                          .limits = limiter_of(c)->curve == LIMITER_TANH,
                          .alpha = limiter_constant(c),
                          .path = path,
                          .curved = !path && !b->trajectory->straight};
}

static inline struct judge_place judge_at(const struct judge *j, double t)
{
    struct judge_place p;
    double u, vx, vy, speed;
    trajectory_at(j->b->trajectory, 1, &t,
                  (struct trajectory_out){.u = &u, .du = &p.v, .x = &p.x, .y = &p.y, .vx = &vx, .vy = &vy});
    if (j->path) return (struct judge_place){u, 0, p.v, {1, 0}};
    speed = sqrt(vx * vx + vy * vy) * (p.v < 0 ? -1 : 1);
    p.e[0] = j->curved ? (speed > 0 ? vx / speed : 0) : j->b->trajectory->e[0];
    p.e[1] = j->curved ? (speed > 0 ? vy / speed : 0) : j->b->trajectory->e[1];
    return p;
}

static inline double judge_alpha(const struct judge *j, double t)
{
    double ax, ay, force, alpha;
    if (!j->b->limiter) return j->alpha;
    trajectory_at(j->b->trajectory, 1, &t, (struct trajectory_out){.ax = &ax, .ay = &ay});
    load_at(j->b->load, 1, &t, &ax, &ay, &force);
    limiter_alpha(j->b->limiter, 1, &force, &alpha);
    return alpha;
}

static inline double judge_limited(const struct judge *j, double alpha, double c)
{
    return j->limits ? tanh(alpha * c) / alpha : c;
}

/* Second derivatives of the surface: xx, xy, yy. */
static inline void judge_bend(const struct judge *j, const struct judge_place *p, double h[3])
{
    bool plane = j->b->relief->along == ALONG_PLANE;
    h[1] = h[2] = 0;
    relief_at(j->b->relief, &(struct relief_points){1, &p->x, plane ? &p->y : NULL},
              &(struct relief_values){.xx = &h[0], .xy = plane ? &h[1] : NULL, .yy = plane ? &h[2] : NULL});
}

/* y: g; the integrals of |v S'|^beta2, of that times the time since judge->since, of v S'. */
static inline int judge_rate(double t, const double y[], double dydt[], void *self)
{
    const struct judge *j = self;
    struct judge_place p = judge_at(j, t);
    double h[3], alpha = judge_alpha(j, t), speed = fabs(p.v), side = p.v < 0 ? -1 : 1;
    judge_bend(j, &p, h);
    double e[2] = {p.e[0], p.e[1]}, n[2] = {-e[1], e[0]};
    double c = judge_limited(j, alpha, e[0] * e[0] * h[0] + 2 * e[0] * e[1] * h[1] + e[1] * e[1] * h[2]);
    double d = j->curved
                   ? judge_limited(j, alpha, e[0] * (n[0] * h[0] + n[1] * h[1]) + e[1] * (n[0] * h[1] + n[1] * h[2]))
                   : 0;
    for (int k = 0; k < 2; k++)
        dydt[k] = speed * (side * c * e[k] + d * n[k] - y[k] / j->law->leak);
    dydt[4] = p.v * (y[0] * e[0] + y[1] * e[1]);
    dydt[2] = pow(fabs(dydt[4]), j->law->beta2);
    dydt[3] = dydt[2] * (t - j->since);
    return GSL_SUCCESS;
}

/* Means of the force by hats (force/path_integral.h) about n sub-intervals' starts, dt apart from 0 on; where it is
   asked for, the means of m v S' over them. Steps are kept short: where T is all but constant long ones would miss what
   lies between their points. */
static inline void judge_run(struct judge *j, long n, double dt, double *force, double *momenta)
{
    gsl_odeiv2_system equations = {judge_rate, NULL, 5, j};
    double y[5] = {0}, carried = 0, mass = j->c->scraper.mass, beta1 = j->law->beta1, momentum = 0,
           scale[5] = {1, 1, 1e-3, 1e-3 * dt, 1e-3};
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_scaled_new(&equations, gsl_odeiv2_step_rk8pd, dt / 1000, 1e-13, 1e-11, 1, 0, scale);
    gsl_odeiv2_driver_set_hmax(driver, relief_finest(j->b->relief) / (8 * j->b->trajectory->top_speed));
    for (long i = 0; i < n; i++) {
        double t = (double)i * dt, end = (double)(i + 1) * dt;
        y[2] = y[3] = y[4] = 0;
        j->since = t;
        gsl_odeiv2_driver_reset(driver);
        ck_assert_int_eq(gsl_odeiv2_driver_apply(driver, &t, end, y), GSL_SUCCESS);
        struct judge_place p = judge_at(j, end);
        double now = mass * p.v * (y[0] * p.e[0] + y[1] * p.e[1]);
        double mean = mass * y[4] / dt, late = y[3] / dt;
        force[i] = carried + (mean - momentum) / dt + beta1 * (y[2] - late) / dt;
        carried = (now - mean) / dt + beta1 * late / dt;
        momentum = now;
        if (momenta) momenta[i] = mean;
    }
    gsl_odeiv2_driver_free(driver);
}

/* Relative rms difference between the stage's sub-forces and the judge's over the scene's first frames. */
static inline double judge_difference(struct scene *s, long frames)
{
    struct rig *g = rig_record(s, ITEM_SUBFORCE, frames, 1024);
    struct judge j = judge_of(g);
    long n = frames * g->per_frame;
    double *want = calloc((size_t)n, sizeof *want), off = 0, all = 0;
    judge_run(&j, n, 1 / (s->output.sample_rate * g->per_frame), want, NULL);
    for (long i = 0; i < n; i++) {
        off += (g->x[i] - want[i]) * (g->x[i] - want[i]);
        all += want[i] * want[i];
    }
    free(want);
    rig_close(g);
    printf("relative rms difference %.3g (rms force %.3g N)\n", sqrt(off / all), sqrt(all / (double)n));
    ck_assert_double_gt(all, 0);
    return sqrt(off / all);
}

#endif
