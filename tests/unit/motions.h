/* What the tests of motions share: motions made in a pool, their whole state at an instant, and slow references for
 * lengths. */
#ifndef TESTS_UNIT_MOTIONS_H
#define TESTS_UNIT_MOTIONS_H
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include "trajectory/trajectory.h"
#include "unit.h"

static inline double between(double lo, double hi) { return lo + (hi - lo) * drand48(); }

static struct arena *motions_pool;

static inline void motions_drain(void) { arena_close(motions_pool); }

/* Memory for a test's motions, given back when its process ends. */
static inline struct arena *motions_arena(void)
{
    if (!motions_pool) {
        motions_pool = arena_open();
        atexit(motions_drain);
    }
    return motions_pool;
}

static inline struct trajectory made(const struct motion *m)
{
    struct trajectory tr;
    struct err e = {0};
    ck_assert_msg(trajectory_make(m, 1, motions_arena(), &tr, &e), "%s", e.text);
    return tr;
}

/* The kind of error and, in its text, a word. */
static inline void refused(const struct motion *m, enum err_kind kind, const char *says)
{
    struct trajectory tr;
    struct err e = {0};
    ck_assert_msg(!trajectory_make(m, 1, motions_arena(), &tr, &e), "accepted: %s", says);
    ck_assert_int_eq(e.kind, kind);
    ck_assert_msg(strstr(e.text, says) != NULL, "%s", e.text);
}

struct state {
    double u, v, a; /* along the path */
    double p[2], vel[2], acc[2];
};

static inline struct state at(const struct trajectory *tr, double t)
{
    struct state s;
    trajectory_at(
        tr, 1, &t,
        (struct trajectory_out){&s.u, &s.v, &s.a, &s.p[0], &s.p[1], &s.vel[0], &s.vel[1], &s.acc[0], &s.acc[1]});
    return s;
}

/* (4 D(h/2) - D(h)) / 3 of central differences D of a member: the error is h^4 f^(5) / 480, and rounding 3e-16 f / h.
 */
static inline double slope_by(const struct trajectory *tr, double t, double h, size_t member)
{
    double d[2];
    for (int k = 0; k < 2; k++, h /= 2) {
        struct state hi = at(tr, t + h), lo = at(tr, t - h);
        d[k] = (*(double *)((char *)&hi + member) - *(double *)((char *)&lo + member)) / (2 * h);
    }
    return (4 * d[1] - d[0]) / 3;
}

/* Integral by adaptive Gauss-Kronrod, GSL's; a tolerance that cannot be met is no fault here. */
static inline double integral(double (*f)(double, void *), void *self, double a, double b)
{
    gsl_integration_workspace *w = gsl_integration_workspace_alloc(2000);
    gsl_function g = {f, self};
    double result = 0, error;
    gsl_set_error_handler_off();
    if (a != b) gsl_integration_qag(&g, a, b, 1e-15, 1e-14, 2000, GSL_INTEG_GAUSS61, w, &result, &error);
    gsl_integration_workspace_free(w);
    return result;
}

#endif
