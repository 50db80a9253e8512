/* One impact of a ball on ground that does not give way, without a line of rasp's: closed forms and quadrature of papers/002, section IV-D, and, with gravity in the
   contact, an adaptive Runge-Kutta method of order 8 (GSL).

     xi'' = g - kappa xi^1.5 max(0, 1 + mu xi'),   xi(0) = 0, xi'(0) = v                                        equations 2 and 3, n = 0

   g = 0: xi' at the end solves mu (v - v_out) + ln((1 + mu v_out)/(1 + mu v)) = 0, and equation 10 gives how long it lasts. */
#ifndef ROLLING_CLOSED_H
#define ROLLING_CLOSED_H
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_roots.h>

/* u = mu xi' in and out: r(u) = u_in - u + ln((1 + u)/(1 + u_in)), 0 at both. */
static double closed_rest(double u, void *data)
{
    double in = *(double *)data;
    return in - u + log1p(u) - log1p(in);
}

/* Speed at which the ball leaves (a positive number), m/s. */
static inline double closed_out(double mu, double v)
{
    double in = mu * v, low = -1 + 1e-15, high = -1e-3 * fmin(in, 1);
    if (mu <= 0)
        return v;
    gsl_function f = {closed_rest, &in};
    gsl_root_fsolver *s = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    gsl_root_fsolver_set(s, &f, low, high);
    for (int i = 0; i < 200 && gsl_root_test_interval(gsl_root_fsolver_x_lower(s), gsl_root_fsolver_x_upper(s), 0, 1e-15) == GSL_CONTINUE; i++)
        gsl_root_fsolver_iterate(s);
    double out = -gsl_root_fsolver_root(s) / mu;
    gsl_root_fsolver_free(s);
    return out;
}

/* The integral of equation 10, du / ((1 + u) r(u)^0.6) from u_out to u_in, in two halves, each from one end to 0 with u = end -+ y^5, which makes its power
   -3/5 at the end smooth. */
struct closed_path {
    double in, out; /* u */
};

struct closed_half {
    struct closed_path path;
    double side; /* +1: from u_out upwards, to 0; -1: from u_in downwards, to 0 */
};

/* Near an end r without cancellation: r(end + d) = -d + ln(1 + d/(1 + end)). */
static double closed_integrand(double y, void *data)
{
    const struct closed_half *h = data;
    double d = h->side * y * y * y * y * y, end = h->side > 0 ? h->path.out : h->path.in;
    return y > 0 ? 5 * y * y * y * y / ((1 + end + d) * pow(-d + log1p(d / (1 + end)), 0.6)) : 0;
}

/* How long the contact lasts, s: equation 10. */
static inline double closed_time(double kappa, double mu, double v)
{
    if (mu <= 0)
        return 2.94327518432470482 * pow(1.25 / kappa, 0.4) * pow(v, -0.2);
    struct closed_path path = {mu * v, -mu * closed_out(mu, v)};
    gsl_integration_cquad_workspace *w = gsl_integration_cquad_workspace_alloc(200);
    double sum = 0, part;
    for (int side = -1; side <= 1; side += 2) {
        struct closed_half h = {path, side};
        gsl_function f = {closed_integrand, &h};
        gsl_integration_cquad(&f, 0, pow(side > 0 ? -path.out : path.in, 0.2), 0, 1e-12, w, &part, NULL, NULL);
        sum += part;
    }
    gsl_integration_cquad_workspace_free(w);
    return pow(kappa, -0.4) * pow(mu * mu / 2.5, 0.6) * sum / mu;
}

/* ------------------------------------------------------------------ with gravity */

struct closed_impact {
    double duration, peak, out; /* s; greatest force over mass, m/s^2; m/s, speed at the end, upwards */
    double *t, *f;              /* [n] force over mass at even times, if asked                       */
    int n;
};

struct closed_scaled {
    double g, mu; /* in units of x0 = (v^2/kappa)^0.4 and x0/v */
};

static inline double closed_force(const struct closed_scaled *s, const double y[])
{
    return y[0] > 0 ? y[0] * sqrt(y[0]) * fmax(0, 1 + s->mu * y[1]) : 0;
}

static int closed_rate(double t, const double y[], double dydt[], void *data)
{
    (void)t;
    dydt[0] = y[1];
    dydt[1] = ((const struct closed_scaled *)data)->g - closed_force(data, y);
    return GSL_SUCCESS;
}

/* n > 0: force at n even times over the contact, for which it is run twice. Given up after some 1000 times the duration without gravity: of a ball that stays down
   duration is 0 and t is NULL. */
static inline struct closed_impact closed_impact(double kappa, double mu, double g, double v, int n)
{
    double length = pow(v * v / kappa, 0.4), time = length / v, force = v / time;
    struct closed_scaled s = {g / force, mu * v};
    struct closed_impact o = {.n = n};
    for (int pass = 0; pass < (n > 0 ? 2 : 1); pass++) {
        gsl_odeiv2_system sys = {closed_rate, NULL, 2, &s};
        gsl_odeiv2_driver *d = gsl_odeiv2_driver_alloc_y_new(&sys, gsl_odeiv2_step_rk8pd, 1e-3, 1e-11, 1e-11);
        double y[2] = {0, 1}, t = 0, step = 0.02, before = 0, last[2] = {0, 1};
        if (pass == 1) {
            o.t = calloc((size_t)n, sizeof *o.t);
            o.f = calloc((size_t)n, sizeof *o.f);
            for (int i = 0; i < n; i++) {
                double to = o.duration / time * i / (n - 1);
                if (to > t)
                    gsl_odeiv2_driver_apply(d, &t, to, y);
                o.t[i] = to * time;
                o.f[i] = closed_force(&s, y) * force;
            }
            gsl_odeiv2_driver_free(d);
            break;
        }
        while (t < 3000 && (y[0] > 0 || t == 0)) {
            before = t;
            last[0] = y[0];
            last[1] = y[1];
            gsl_odeiv2_driver_apply(d, &t, t + step, y);
            o.peak = fmax(o.peak, closed_force(&s, y) * force);
        }
        for (double low = before, high = t; y[0] <= 0 && high - low > 1e-13 * high;) {
            double middle = (low + high) / 2, z[2] = {last[0], last[1]};
            t = before;
            gsl_odeiv2_driver_reset(d);
            gsl_odeiv2_driver_apply(d, &t, middle, z);
            *(z[0] > 0 ? &low : &high) = middle;
            o.duration = middle * time;
            o.out = -z[1] * v;
            if (low == middle && high - middle <= 0)
                break;
        }
        gsl_odeiv2_driver_free(d);
        if (o.duration == 0)
            break;
    }
    return o;
}
#endif
