/* ringing_blocks: a fit made in parts ends where the joint one does. */
#include "analysis/ringing_blocks.h"

#include "ringing_found.h"

enum { SHORT = 8000, MANY = 150 };

/* 150 modes 8 to 60 Hz apart with noise, in 0.18 s: neighbours overlap. */
static struct ringing_fit *fit_of(struct arena *a, unsigned long seed, double deviation)
{
    struct truth m[MANY];
    struct ringing *r = ARENA_TAKE(a, struct ringing, 1);
    struct ringing_fit *f = ARENA_TAKE(a, struct ringing_fit, 1);
    double *h = ARENA_TAKE(a, double, SHORT);
    const double **list = ARENA_TAKE(a, const double *, 1);
    gsl_rng *g = generator(seed);
    double frequency = 200;
    list[0] = h;
    for (int i = 0; i < MANY; i++, frequency += 8 + 52 * gsl_rng_uniform(g))
        m[i] = (struct truth){.frequency = frequency, .decay = 5 + 20 * gsl_rng_uniform(g), .gain = 0.2 + gsl_rng_uniform(g), .phase = 6 * gsl_rng_uniform(g)};
    series_sum(m, MANY, RATE, SHORT, h);
    series_noise(g, deviation, SHORT, h);
    *r = (struct ringing){.places = 1, .n = SHORT, .rate = RATE, .h = list};
    ringing_fit_open(f, r, 2 * MANY, a);
    for (int i = 0; i < MANY; i++)
        ringing_fit_add(f, m[i].decay, 2 * M_PI * m[i].frequency);
    gsl_rng_free(g);
    return f;
}

START_TEST(test_gains)
{
    struct arena *a = arena_open();
    struct ringing_fit *parts = fit_of(a, 1, 1e-6), *whole = fit_of(a, 1, 1e-6);
    ck_assert(ringing_blocks_many(parts));
    for (int i = 0; i < 3; i++)
        ringing_blocks_gains(parts);
    ringing_fit_gains(whole);
    ck_assert_double_eq_tol(parts->energy[0] / whole->energy[0], 1, 1e-3);
    for (int i = 1; i < whole->m; i++)
        ck_assert(cabs(parts->gain[i] - whole->gain[i]) < 1e-5 * cabs(whole->gain[i])); /* noise is 1e-6: a tenth of what it does to the worst */
    arena_close(a);
}
END_TEST

static bool polish(struct ringing_fit *part, void *context)
{
    (void)context;
    return ringing_fit_polish(part, 10) > 1e-3;
}

/* Poles in units of what noise does to them; the noise is 60 dB down. */
START_TEST(test_poles)
{
    struct arena *a = arena_open();
    struct ringing_fit *parts = fit_of(a, 2, 1e-3), *whole = fit_of(a, 2, 1e-3);
    struct ringing_fit_errors e;
    double *variance = ARENA_TAKE(a, double, whole->m), worst = 0;
    ringing_blocks_gains(parts);
    ringing_blocks_run(parts, 30, polish, NULL);
    ringing_fit_polish(whole, 30);
    for (int i = 0; i < whole->m; i++)
        variance[i] = whole->energy[0] / SHORT;
    ringing_fit_covariance(whole, variance, a, &e);
    for (int i = 1; i < whole->m; i++)
        worst = fmax(worst, fmax(fabs(parts->decay[i] - whole->decay[i]) / e.decay[i], fabs(parts->omega[i] - whole->omega[i]) / e.omega[i]));
    ck_assert_msg(worst < 0.05, "%g", worst);
    ck_assert_double_eq_tol(parts->energy[0] / whole->energy[0], 1, 1e-5);
    arena_close(a);
}
END_TEST

/* What a part drops, adds and ties is the whole's. */
static bool change(struct ringing_fit *part, void *context)
{
    const double *omega = context;
    bool *drop = calloc((size_t)part->m + 1, sizeof *drop), any = false;
    int of = 0;
    for (int i = 1; i < part->m; i++) {
        drop[i] = !part->guest[i] && part->omega[i] == omega[0];
        any = any || drop[i];
        if (!part->guest[i] && part->omega[i] == omega[1])
            of = i;
    }
    if (of > 0) {
        ringing_fit_add(part, 2 * part->decay[of], part->omega[of]);
        part->tie[part->m - 1] = of;
    }
    ringing_fit_drop(part, drop);
    ringing_fit_gains(part);
    free(drop);
    return any || of > 0;
}

START_TEST(test_changes)
{
    struct arena *a = arena_open();
    struct ringing_fit *f = fit_of(a, 3, 1e-3);
    double omega[] = {f->omega[20], f->omega[100]}, decay = f->decay[100], y[SHORT];
    int seen = 0;
    ringing_blocks_gains(f);
    ringing_blocks_renew(f);
    ringing_blocks_run(f, 1, change, omega);
    ck_assert_int_eq(f->m, MANY + 1); /* the constant, one less, one more */
    for (int i = 1; i < f->m; i++) {
        ck_assert(f->omega[i] != omega[0]);
        if (f->tie[i] < 0)
            continue;
        seen++;
        ck_assert(f->omega[i] == omega[1] && f->decay[i] == 2 * decay);
        ck_assert(f->omega[f->tie[i]] == omega[1] && f->decay[f->tie[i]] == decay);
    }
    ck_assert_int_eq(seen, 1);
    memcpy(y, f->residual, sizeof y);
    ringing_fit_sound(f);
    for (int i = 0; i < SHORT; i++)
        ck_assert_double_eq_tol(y[i], f->residual[i], 1e-11);
    arena_close(a);
}
END_TEST

/* All the way: 150 modes without noise. */
START_TEST(test_exact)
{
    struct arena *a = arena_open();
    struct truth m[MANY];
    struct ringing_modes found;
    static double h[2 * SHORT];
    gsl_rng *g = generator(4);
    for (int i = 0; i < MANY; i++)
        m[i] = (struct truth){.frequency = 300 + 60 * i + 20 * gsl_rng_uniform(g), .decay = 5 + 20 * gsl_rng_uniform(g), .gain = 0.2 + gsl_rng_uniform(g), .phase = 6 * gsl_rng_uniform(g)};
    series_sum(m, MANY, RATE, 2 * SHORT, h);
    find((const double *const[]){h}, 1, 2 * SHORT, a, &found);
    ck_assert_int_eq(found.n, MANY);
    for (int i = 0; i < MANY; i++)
        ck_assert_double_eq_tol(nearest(&found, m[i].frequency)->frequency, m[i].frequency, 1e-7);
    gsl_rng_free(g);
    arena_close(a);
}
END_TEST

UNIT("ringing_blocks", test_gains, test_poles, test_changes, test_exact)
