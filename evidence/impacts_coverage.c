/* Do the 95 % intervals of rasp's statistics of impacts cover what the impacts were drawn from? For evidence/impacts.md.

     impacts_coverage FROM IMPACTS SEEDS RHO [DEPTH]

   FROM own: series of papers/002's table I (equation 13) from GSL's generator, by a plain recursion after 4000 impacts of warming up, no floor but on intervals; `floored`: the same, amplitudes of
   less than 0.01 of their mean and intervals below 22.7 us raised to that, before they are modulated; `rasp`: by force/impact_series.h, prototype roll. DEPTH: m, 0 unless given, at 3 Hz; what is
   found is divided out.

   Prints a row: share of seeds, in %, whose interval holds the truth, for mean, deviation, a1, b1 of amplitudes and of intervals; then in brackets the mean of (estimate -
   truth)/error, the bias; then the share of draws at a floor, in %, of seeds with a modulation found, and, where there is one, m and its bias over its error. */
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "analysis/impact_statistics.h"
#include "force/impact_series.h"

enum { WARM = 4000, PARAMETERS = 4 };
static const double least_interval = 22.6757e-6;

struct truth {
    double mean, deviation, a1, b1;
};

static struct truth truth_of(int which, double rho)
{
    static const struct truth smooth[2] = {{0.43, 0.04, -0.97, 0.07}, {3.1e-3, 0.19e-3, -0.97, -0.34}}, rough[2] = {{0.27, 0.04, -0.93, 0.32}, {6.4e-3, 0.85e-3, -0.93, 0.35}};
    const struct truth *s = &smooth[which], *r = &rough[which];
    return (struct truth){s->mean + rho * (r->mean - s->mean), s->deviation + rho * (r->deviation - s->deviation), s->a1 + rho * (r->a1 - s->a1), s->b1 + rho * (r->b1 - s->b1)};
}

struct run {
    int n;
    double rho, depth, rate;
    bool floors;
    struct impact_events events;
    long floored;               /* draws */
};

static void own(struct run *u, unsigned long seed, gsl_rng *g)
{
    struct truth t[2] = {truth_of(0, u->rho), truth_of(1, u->rho)};
    double x[2] = {0}, e[2] = {0}, value[2], time = 0;
    gsl_rng_set(g, seed);
    for (int i = -WARM; i < u->n; i++) {
        double w = gsl_ran_gaussian_ziggurat(g, 1);
        for (int k = 0; k < 2; k++) {
            double now = t[k].deviation * w, least = k ? least_interval : 0.01 * t[k].mean;
            x[k] = -t[k].a1 * x[k] + now + t[k].b1 * e[k];
            e[k] = now;
            value[k] = t[k].mean + x[k];
            u->floored += i >= 0 && value[k] < least;
            if ((u->floors || k) && value[k] < least)
                value[k] = least;
        }
        if (i < 0)
            continue;
        u->events.time[i] = time;
        u->events.amplitude[i] = value[0] * (1 + u->depth * sin(2 * M_PI * u->rate * time));
        time += value[1];
    }
}

static void drawn(struct run *u, unsigned long seed)
{
    const struct impact_draws draws = {.mean = NAN, .deviation = NAN, .a1 = NAN, .b1 = NAN};
    struct contact c = {.name = "ball", .gain = 1, .contact = {.model = CONTACT_IMPACTS}};
    struct arena *a = arena_open();
    struct impact_law law;
    struct impact_series s;
    struct impact i;
    struct err e = {.kind = ERR_NONE};
    c.contact.impacts = (struct impacts){.prototype = PROTOTYPE_ROLL, .size = 0.5, .velocity = 0.5, .roughness = u->rho, .unit_force = 1, .amplitude = draws, .interval = draws, .zeta = NAN,
        .theta = NAN, .depth = u->depth, .rate = u->rate, .least_amplitude = NAN, .least_interval = least_interval, .angle_to = NAN, .radius_to = NAN};
    if (!impact_law_make(&c, 1, a, &law, &e)) {
        fprintf(stderr, "impacts_coverage: %s\n", e.text);
        exit(1);
    }
    impact_series_open(&law, seed, "ball", a, &s);
    for (int k = 0; k < u->n; k++) {
        impact_series_next(&s, &i);
        u->events.time[k] = i.time;
        u->events.amplitude[k] = i.amplitude;
        u->events.duration[k] = i.duration;
        u->floored += (i.limited & IMPACT_LIMITED_AMPLITUDE ? 1 : 0) + (i.limited & IMPACT_LIMITED_INTERVAL ? 1 : 0);
    }
    arena_close(a);
}

struct tally {
    int covered[2][PARAMETERS], found;
    double bias[2][PARAMETERS], depth, depth_bias;
};

static void tally_add(struct tally *t, const struct impact_statistics *s, const struct run *u)
{
    for (int k = 0; k < 2; k++) {
        const struct series_statistics *v = &s->series[k];
        const struct estimate *e[PARAMETERS] = {&v->mean, &v->deviation, &v->a1, &v->b1};
        struct truth truth = truth_of(k, u->rho);
        const double is[PARAMETERS] = {truth.mean, truth.deviation, truth.a1, truth.b1};
        for (int p = 0; p < PARAMETERS; p++) {
            t->covered[k][p] += e[p]->low <= is[p] && is[p] <= e[p]->high;
            t->bias[k][p] += (e[p]->value - is[p]) / e[p]->error;
        }
    }
    t->found += s->modulation.found;
    if (s->modulation.found) {
        t->depth += s->modulation.depth;
        t->depth_bias += (s->modulation.depth - u->depth) / s->modulation.depth_error;
    }
}

static void row(const struct tally *t, const struct run *u, const char *from, int seeds)
{
    printf("| %s | %d | %g |", from, u->n, u->rho);
    for (int k = 0; k < 2; k++)
        for (int p = 0; p < PARAMETERS; p++)
            printf(" %.1f (%+.2f) |", 100.0 * t->covered[k][p] / seeds, t->bias[k][p] / seeds);
    printf(" %.2f | %.1f |", 100.0 * u->floored / (2.0 * seeds * u->n), 100.0 * t->found / seeds);
    if (u->depth > 0 && t->found)
        printf(" %.4f (%+.2f) |", t->depth / t->found, t->depth_bias / t->found);
    putchar('\n');
}

int main(int count, char **word)
{
    if (count < 5) {
        fputs("usage: impacts_coverage own|floored|rasp IMPACTS SEEDS RHO [DEPTH]\n", stderr);
        return 64;
    }
    struct run u = {.n = atoi(word[2]), .rho = atof(word[4]), .depth = (count > 5) ? atof(word[5]) : 0, .floors = strcmp(word[1], "own") != 0};
    int seeds = atoi(word[3]);
    struct tally t = {0};
    gsl_rng *g = gsl_rng_alloc(gsl_rng_mt19937);
    double *rows = malloc(3 * sizeof *rows * u.n);
    bool *alone = calloc(u.n, sizeof *alone);
    u.rate = (u.depth > 0) ? 3 : 1;
    u.events = (struct impact_events){.n = u.n, .time = rows, .amplitude = rows + u.n, .duration = rows + 2 * u.n, .alone = alone};
    for (int seed = 1; seed <= seeds; seed++) {
        struct arena *a = arena_open();
        struct impact_statistics s;
        struct err e = {.kind = ERR_NONE};
        for (int i = 0; i < u.n; i++)
            u.events.duration[i] = NAN;
        if (strcmp(word[1], "rasp") == 0)
            drawn(&u, seed);
        else
            own(&u, seed, g);
        if (!impact_statistics_make(&u.events, true, a, &s, &e)) {
            fprintf(stderr, "impacts_coverage: %s\n", e.text);
            return 1;
        }
        tally_add(&t, &s, &u);
        if (seed == 1 && getenv("WORDS"))
            for (int i = 0; s.warnings[i]; i++)
                fprintf(stderr, "%s\n", s.warnings[i]);
        arena_close(a);
    }
    row(&t, &u, word[1], seeds);
    free(rows);
    free(alone);
    gsl_rng_free(g);
    return 0;
}
