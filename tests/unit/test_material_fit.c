/* Materials from modes that are drawn: plates whose true gamma, nu and damping are known, with modes missing and modes
   that are none, at several seeds. The bar is the prototype's table in the design of this fit: with frequencies off by
   3e-4 and decays by 30 %, half of the modes missing and half as many false, gamma within 0.05 %, nu 0.0012, alpha 30 %
   and beta 25 %, twice that here for other draws. */
#include "analysis/material_fit.h"

#include <math.h>
#include <stdlib.h>

#include "num/noise.h"
#include "unit.h"

enum { MODES = 70, NODES = 39, TABLE = 40 };

static const double pi = 3.14159265358979323846;

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* log(lambda/gamma) of a free plate's mode, about: bending with 1/(1 - nu^2), twisting with 1/(1 + nu). */
static double log_ratio(int m, int n, double nu)
{
    double a = 0.31, b = 0.2, h = 0.004, kx = (m + 0.5) * pi / a, ky = (n + 0.5) * pi / b, bend = kx * kx + ky * ky,
           twist = n > 0 && m > 0 ? 1.0 / (1.0 + 0.3 * (m + n)) : 0.0;
    return log(h * h / 12.0 * bend * bend * ((1.0 - twist) / (1.0 - nu * nu) + twist / (1.0 + nu)));
}

static struct solid_family family(struct arena *a)
{
    struct solid_family f = {.n = MODES,
                             .nodes = NODES,
                             .nu = ARENA_TAKE(a, double, NODES),
                             .log_ratio = ARENA_TAKE(a, double, NODES *MODES),
                             .slope = ARENA_TAKE(a, double, NODES *MODES),
                             .error = ARENA_TAKE(a, double, MODES)};
    struct {
        double at;
        int m, n;
    } all[400];
    int count = 0;
    for (int m = 0; m < 20; m++)
        for (int n = 0; n < 20; n++) {
            all[count].at = log_ratio(m, n, 0.25);
            all[count].m = m;
            all[count++].n = n;
        }
    qsort(all, (size_t)count, sizeof *all, by_value);
    for (int i = 0; i < NODES; i++) {
        f.nu[i] = 0.0125 * i;
        for (int j = 0; j < MODES; j++) {
            f.log_ratio[i * MODES + j] = log_ratio(all[j].m, all[j].n, f.nu[i]);
            f.slope[i * MODES + j] =
                (log_ratio(all[j].m, all[j].n, f.nu[i] + 1e-6) - log_ratio(all[j].m, all[j].n, f.nu[i] - 1e-6)) / 2e-6;
        }
    }
    for (int j = 0; j < MODES; j++)
        f.error[j] = NAN;
    return f;
}

struct truth {
    double gamma, nu, alpha, beta, loss;
    double missing, extra; /* shares */
    double frequency_error, decay_error;
    int most;
};

static int by_lambda(const void *a, const void *b) { return by_value(a, b); }

/* A table of the lowest TABLE modes that are not missing, with false ones among them. */
static struct material_set draw(const struct solid_family *f, const struct truth *t, uint64_t seed, struct arena *a)
{
    struct noise s = noise_make(seed, "material");
    double at[MODES], slope[MODES], *gauss = ARENA_TAKE(a, double, 4 * MODES);
    struct {
        double lambda, decay;
    } all[2 * MODES];
    int n = 0;
    noise_normal(s, 1, 4 * MODES, gauss);
    solid_family_at(f, t->nu, at, slope);
    double top = 0.0;
    for (int j = 0; j < TABLE; j++) {
        double lambda = t->gamma * exp(at[j]), w = sqrt(lambda);
        top = fmax(top, w);
        if (noise_uniform(s, 2, (uint64_t)j) < t->missing) continue;
        all[n].decay = 0.5 * (t->alpha + t->beta * lambda + t->loss * w) * exp(t->decay_error * gauss[2 * j]);
        all[n++].lambda = lambda * exp(2.0 * t->frequency_error * gauss[2 * j + 1]);
    }
    for (int j = 0; j < (int)(t->extra * TABLE); j++) {
        double w = top * noise_uniform(s, 3, (uint64_t)j);
        all[n].decay = 0.5 * (t->alpha + t->beta * w * w) * exp(2.0 * noise_uniform(s, 4, (uint64_t)j) - 1.0);
        all[n++].lambda = w * w;
    }
    qsort(all, (size_t)n, sizeof *all, by_lambda);
    if (t->most && n > t->most) n = t->most;
    struct material_set set = {.n = n,
                               .log_lambda = ARENA_TAKE(a, double, n),
                               .frequency = ARENA_TAKE(a, double, n),
                               .error = ARENA_TAKE(a, double, n),
                               .decay = ARENA_TAKE(a, double, n),
                               .decay_error = ARENA_TAKE(a, double, n),
                               .match = ARENA_TAKE(a, int, n)};
    for (int i = 0; i < n; i++) {
        set.log_lambda[i] = log(all[i].lambda);
        set.frequency[i] = sqrt(fmax(all[i].lambda - all[i].decay * all[i].decay, 0.0)) / (2.0 * pi);
        set.decay[i] = all[i].decay;
        set.error[i] = t->frequency_error;
        set.decay_error[i] = t->decay_error;
    }
    return set;
}

static struct material_fit fit(const struct solid_family *f, struct material_set *set, double poisson, struct arena *a)
{
    struct material_problem p = {
        .object = f, .sets = 1, .set = set, .gamma = {1e5, 5e8}, .poisson = poisson, .model_error = 1e-4};
    struct material_fit found;
    struct err e = {0};
    ck_assert_msg(material_fit(&p, a, &found, &e), "%s", e.text);
    return found;
}

START_TEST(test_found)
{
    static const struct {
        double missing, extra, f, d, gamma, nu, alpha, beta;
    } rows[] = {{0.0, 0.0, 1e-5, 0.01, 1e-4, 3e-4, 0.03, 0.02},
                {0.3, 0.3, 1e-4, 0.10, 3e-4, 1e-3, 0.25, 0.25},
                {0.5, 0.5, 3e-4, 0.30, 1e-3, 3e-3, 0.8, 0.6}};
    struct arena *a = arena_open();
    struct solid_family f = family(a);
    int inside[4] = {0}, given = 0;
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++)
        for (uint64_t seed = 0; seed < 12; seed++) {
            struct noise s = noise_make(seed, "truth");
            struct truth t = {.gamma = 1e6 * exp(4.0 * noise_uniform(s, 0, r)),
                              .nu = 0.05 + 0.35 * noise_uniform(s, 1, r),
                              .alpha = 6.0,
                              .missing = rows[r].missing,
                              .extra = rows[r].extra,
                              .frequency_error = rows[r].f,
                              .decay_error = rows[r].d};
            double at[MODES], slope[MODES];
            solid_family_at(&f, t.nu, at, slope);
            t.beta = 6.0 / (t.gamma * exp(at[TABLE / 2])); /* both matter alike in the middle */
            struct material_set set = draw(&f, &t, seed, a);
            struct material_fit m = fit(&f, &set, NAN, a);
            const struct material_damping *d = &m.damping[MATERIAL_RAYLEIGH];
            double off[4] = {m.gamma.value / t.gamma - 1.0, m.nu.value - t.nu, d->figure[0].value / t.alpha - 1.0,
                             d->figure[1].value / t.beta - 1.0};
            ck_assert_msg(fabs(off[0]) < rows[r].gamma && fabs(off[1]) < rows[r].nu && fabs(off[2]) < rows[r].alpha &&
                              fabs(off[3]) < rows[r].beta,
                          "row %zu seed %d: gamma %g, nu %g, alpha %g, beta %g", r, (int)seed, off[0], off[1], off[2],
                          off[3]);
            ck_assert(m.best == MATERIAL_RAYLEIGH || m.best == MATERIAL_ALL || r == 2);
            if (!m.sure) continue;
            given++;
            inside[0] += m.gamma.low < t.gamma && t.gamma < m.gamma.high;
            inside[1] += m.nu.low < t.nu && t.nu < m.nu.high;
            inside[2] += d->figure[0].low < t.alpha && t.alpha < d->figure[0].high;
            inside[3] += d->figure[1].low < t.beta && t.beta < d->figure[1].high;
        }
    /* of 36 intervals that hold 95 % each, less than 30 hold in one draw of 300 */
    ck_assert_int_ge(given, 30);
    for (int k = 0; k < 4; k++)
        ck_assert_msg(inside[k] >= given - 6, "figure %d: %d of %d intervals hold", k, inside[k], given);
    arena_close(a);
}
END_TEST

/* Laws of damping are told apart, and a law that nobody lists first is fitted too. */
START_TEST(test_laws)
{
    struct arena *a = arena_open();
    struct solid_family f = family(a);
    struct truth t = {.gamma = 2.6e7, .nu = 0.3, .loss = 0.003, .frequency_error = 1e-4, .decay_error = 0.05};
    struct material_set set = draw(&f, &t, 5, a);
    struct material_fit m = fit(&f, &set, NAN, a);
    double damping[3];
    ck_assert_int_eq(m.best, MATERIAL_LOSS);
    material_damping_terms(m.damping, m.best, damping);
    ck_assert_double_eq_tol(damping[2], 0.003, 1e-4);
    ck_assert(damping[0] == 0.0 && damping[1] == 0.0);
    for (int i = 0; i < set.n; i++) { /* a standard linear solid in place of these */
        double w2 = exp(set.log_lambda[i]), tau = 5e-5;
        set.decay[i] = 0.5 * 0.004 / tau * w2 * tau * tau / (1.0 + w2 * tau * tau);
    }
    m = fit(&f, &set, NAN, a);
    const struct material_damping *z = &m.damping[MATERIAL_ZENER];
    ck_assert_double_eq_tol(z->figure[1].value, 5e-5, 1e-8);
    ck_assert_double_eq_tol(
        material_damping_decay(MATERIAL_ZENER, (double[]){z->figure[0].value, z->figure[1].value}, 1e9),
        0.5 * 0.004 / 5e-5 * 1e9 * 25e-10 / (1.0 + 1e9 * 25e-10), 1e-4);
    ck_assert(z->bic < m.damping[MATERIAL_RAYLEIGH].bic);
    arena_close(a);
}
END_TEST

/* Nu that is given stays; two tables of one object count together. */
START_TEST(test_given)
{
    struct arena *a = arena_open();
    struct solid_family f = family(a);
    struct truth t = {.gamma = 5e6, .nu = 0.38, .alpha = 20, .beta = 1e-7, .frequency_error = 2e-4, .decay_error = 0.1};
    struct material_set set[2] = {draw(&f, &t, 1, a), draw(&f, &t, 2, a)};
    struct material_problem p = {
        .object = &f, .sets = 2, .set = set, .gamma = {1e5, 5e8}, .poisson = 0.38, .model_error = 1e-4};
    struct material_fit m;
    struct err e = {0};
    ck_assert(material_fit(&p, a, &m, &e));
    ck_assert_double_eq(m.nu.value, 0.38);
    ck_assert_double_eq_tol(m.gamma.value / 5e6, 1.0, 3e-4);
    ck_assert_int_eq(m.matched, set[0].n + set[1].n);
    double narrow = m.gamma.high - m.gamma.low;
    p.size_error = 0.01;
    ck_assert(material_fit(&p, a, &m, &e));
    ck_assert_double_eq_tol((m.gamma.high - m.gamma.low) / m.gamma.value, 4.0 * 1.96 * 0.01, 0.003);
    ck_assert(narrow < 0.01 * 5e6);
    arena_close(a);
}
END_TEST

/* By what a computed mode, or a law, is off is the same in all strikes on an object: of three the intervals hold as of
   one (if each counted by itself, some 75 % would hold). */
START_TEST(test_errors_alike)
{
    enum { DRAWS = 40, SETS = 3 };
    struct arena *a = arena_open();
    struct solid_family f = family(a);
    int inside[4] = {0};
    for (uint64_t seed = 0; seed < DRAWS; seed++) {
        struct truth t = {.gamma = 2e7,
                          .nu = 0.3,
                          .alpha = 10,
                          .beta = 2e-7,
                          .frequency_error = 1e-5,
                          .decay_error = 0.01,
                          .most = 20};
        struct material_set set[SETS];
        double off[2 * TABLE];
        noise_normal(noise_make(seed, "alike"), 0, 2 * TABLE, off);
        for (int k = 0; k < SETS; k++) {
            set[k] = draw(&f, &t, SETS * seed + (uint64_t)k, a);
            for (int i = 0; i < set[k].n; i++) {
                set[k].log_lambda[i] += 2e-3 * off[i];
                set[k].decay[i] *= exp(0.3 * off[TABLE + i]);
            }
        }
        struct material_problem p = {
            .object = &f, .sets = SETS, .set = set, .gamma = {1e5, 5e8}, .poisson = NAN, .model_error = 1e-3};
        struct material_fit m;
        struct err e = {0};
        ck_assert(material_fit(&p, a, &m, &e));
        const struct material_figure *d = m.damping[MATERIAL_RAYLEIGH].figure;
        inside[0] += m.gamma.low < t.gamma && t.gamma < m.gamma.high;
        inside[1] += m.nu.low < t.nu && t.nu < m.nu.high;
        inside[2] += d[0].low < t.alpha && t.alpha < d[0].high;
        inside[3] += d[1].low < t.beta && t.beta < d[1].high;
    }
    for (int k = 0; k < 4; k++) /* less than 33 of 40 at 95 %: one draw of 3 000 */
        ck_assert_msg(inside[k] >= 33, "figure %d: %d of %d intervals hold", k, inside[k], DRAWS);
    arena_close(a);
}
END_TEST

/* What cannot be known has no interval, and a warning: few modes, noise, a range that does not hold it. */
START_TEST(test_doubt)
{
    struct arena *a = arena_open();
    struct solid_family f = family(a);
    struct truth t = {
        .gamma = 2e7, .nu = 0.2, .alpha = 6, .beta = 1e-8, .frequency_error = 1e-4, .decay_error = 0.1, .most = 4};
    int refused = 0;
    for (uint64_t seed = 0; seed < 6; seed++) {
        struct material_set set = draw(&f, &t, seed, a);
        struct material_fit m = fit(&f, &set, NAN, a);
        ck_assert(!m.sure && m.warning && isnan(m.gamma.low) && isnan(m.damping[0].figure[0].low));
    }
    t.most = 30;
    for (int hum = 0; hum < 2; hum++) {
        struct material_set set = draw(&f, &t, 1, a);
        set.hum = hum;
        struct material_fit m = fit(&f, &set, NAN, a);
        ck_assert(m.sure == !hum && isnan(m.gamma.low) == hum && isnan(m.damping[0].figure[0].low) == hum);
    }
    t.most = 0;
    for (uint64_t seed = 0; seed < 6; seed++) {
        struct material_set set = draw(&f, &t, seed, a);
        struct noise s = noise_make(seed, "noise");
        for (int i = 0; i < set.n; i++) /* frequencies that belong to nothing */
            set.log_lambda[i] = 14.0 + 6.0 * noise_uniform(s, 0, (uint64_t)i);
        qsort(set.log_lambda, (size_t)set.n, sizeof *set.log_lambda, by_value);
        struct material_problem p = {
            .object = &f, .sets = 1, .set = &set, .gamma = {1e5, 5e8}, .poisson = NAN, .model_error = 1e-4};
        struct material_fit m;
        struct err e = {0};
        if (material_fit(&p, a, &m, &e))
            ck_assert(!m.sure && m.warning);
        else
            refused++;
    }
    ck_assert_int_lt(refused, 7);
    arena_close(a);
}
END_TEST

/* The scatter about the laws is found beside the decays' own errors, and where there is none, errors alone weigh: alpha,
   of which the lowest mode has 8 % of its decay, comes out by the modes that are exact, whatever the others say. */
START_TEST(test_scatter)
{
    enum { MANY = 200, FEW = 12 };
    struct material_decay d[MANY];
    double off[2 * MANY];
    noise_normal(noise_make(3, "scatter"), 0, 2 * MANY, off);
    for (int k = 0; k < 2; k++) {
        double scatter = k ? 0.2 : 0.0;
        for (int i = 0; i < MANY; i++) {
            d[i].lambda = 1e7 * pow(1.03, i);
            d[i].sigma = i % 2 ? 0.1 : 0.01;
            d[i].log_decay = log(0.5 * (10 + 1e-6 * d[i].lambda)) + d[i].sigma * off[i] + scatter * off[MANY + i];
        }
        double found = material_damping_scatter(d, MANY); /* four standard errors of 200 draws, 5 % each */
        ck_assert_double_ge(found, k ? 0.16 : 0.0);
        ck_assert_double_le(found, k ? 0.24 : 0.005);
    }
    struct material_damping g;
    for (int i = 0; i < FEW; i++) {
        d[i].lambda = 1e8 * pow(1.4, i);
        d[i].sigma = i % 3 ? 1e-3 : 0.1;
        d[i].log_decay = log(0.5 * (1 + 1.2e-7 * d[i].lambda)) + d[i].sigma * off[i];
    }
    double scatter = material_damping_scatter(d, FEW);
    for (int i = 0; i < FEW; i++)
        d[i].sigma = sqrt(d[i].sigma * d[i].sigma + scatter * scatter);
    material_damping_fit(MATERIAL_RAYLEIGH, d, FEW, &g);
    ck_assert_double_eq_tol(g.figure[0].value, 1.0, 0.05); /* Cramer and Rao: 0.015; of equal weights some 0.7 */
    ck_assert_double_eq_tol(g.figure[1].value, 1.2e-7, 2e-10);
}
END_TEST

UNIT("material_fit", test_scatter, UNIT_PLAIN(test_found), test_laws, test_given, UNIT_PLAIN(test_errors_alike),
     test_doubt)
