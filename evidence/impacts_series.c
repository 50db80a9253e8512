/* For evidence/impacts.md, with rasp's own functions.

     impacts_series draw IMPACTS RHO DEPTH SEED   IMPACTS of prototype roll as binary doubles: amplitude, interval, 1 where the amplitude was raised to its floor plus 2 where the
                                                  interval was; m is DEPTH, at 3 Hz, size and velocity 0.5
     impacts_series walk FILE.csv                 the law along a walk over the disk of the prototypes as they are, 10 s: the largest step, in 0.1 ms, of zeta, theta, means, rms
                                                  amplitude and depth, each over its span along the walk; then the least and the greatest mean density, impacts a second */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "force/impact_series.h"

enum { FOLLOWED = 6 };

static const struct impact_draws as_prototype = {.mean = NAN, .deviation = NAN, .a1 = NAN, .b1 = NAN};

static struct contact contact_of(int prototype, double rho, double depth)
{
    const struct impact_grain rub = {.deviation = 0.15, .interval = 22.6757e-6, .duration = 22.6757e-6}, scratch = {.deviation = 0.15, .interval = 10e-3, .duration = 22.6757e-6};
    struct contact c = {.name = "contact", .gain = 1, .contact = {.model = CONTACT_IMPACTS}};
    c.contact.impacts = (struct impacts){.prototype = prototype, .size = 0.5, .velocity = 0.5, .roughness = rho, .unit_force = 1, .amplitude = as_prototype, .interval = as_prototype,
        .zeta = NAN, .theta = NAN, .depth = depth, .rate = NAN, .least_amplitude = NAN, .least_interval = 22.6757e-6, .rub = rub, .scratch = scratch, .radius = 1, .angle_to = NAN,
        .radius_to = NAN};
    return c;
}

static void law_of(const struct contact *c, struct arena *a, struct impact_law *l)
{
    struct err e = {.kind = ERR_NONE};
    if (impact_law_make(c, 10, a, l, &e))
        return;
    fprintf(stderr, "impacts_series: %s\n", e.text);
    exit(1);
}

static void draw(long n, double rho, double depth, unsigned long seed)
{
    struct contact c = contact_of(PROTOTYPE_ROLL, rho, depth);
    struct arena *a = arena_open();
    struct impact_law law;
    struct impact_series s;
    struct impact i;
    law_of(&c, a, &law);
    impact_series_open(&law, seed, c.name, a, &s);
    for (long k = 0; k < n; k++) {
        impact_series_next(&s, &i);
        fwrite((double[]){i.amplitude, i.interval, i.limited}, sizeof(double), 3, stdout);
    }
    arena_close(a);
}

static void walk(const char *file)
{
    struct contact c = contact_of(PROTOTYPE_SPACE, 0.5, NAN);
    struct arena *a = arena_open();
    struct impact_law law;
    double before[FOLLOWED] = {0}, step[FOLLOWED] = {0}, low[FOLLOWED], high[FOLLOWED], density[2] = {HUGE_VAL, 0};
    c.contact.impacts.walk = file;
    law_of(&c, a, &law);
    for (int k = 0; k <= 100000; k++) {
        struct impact_parameters p;
        double mean, variance, rate, spread;
        impact_law_at(&law, 1e-4 * k, &p);
        impact_law_stationary(&law, IMPACT_AMPLITUDE, &p, &mean, &variance);
        impact_law_stationary(&law, IMPACT_INTERVAL, &p, &rate, &spread);
        const double now[FOLLOWED] = {p.zeta, p.theta, p.mean[0], p.mean[1], sqrt(mean * mean + variance), p.depth};
        for (int i = 0; i < FOLLOWED; i++) {
            step[i] = k ? fmax(step[i], fabs(now[i] - before[i])) : 0;
            low[i] = k ? fmin(low[i], now[i]) : now[i];
            high[i] = k ? fmax(high[i], now[i]) : now[i];
            before[i] = now[i];
        }
        density[0] = fmin(density[0], 1 / rate);
        density[1] = fmax(density[1], 1 / rate);
    }
    for (int i = 0; i < FOLLOWED; i++)
        printf("%.1e ", step[i] / (high[i] - low[i]));
    printf("%.0f %.0f\n", density[0], density[1]);
    arena_close(a);
}

int main(int count, char **word)
{
    if (count == 6 && strcmp(word[1], "draw") == 0)
        draw(atol(word[2]), atof(word[3]), atof(word[4]), strtoul(word[5], NULL, 10));
    else if (count == 3 && strcmp(word[1], "walk") == 0)
        walk(word[2]);
    else
        return fputs("usage: impacts_series draw IMPACTS RHO DEPTH SEED | walk FILE.csv\n", stderr), 64;
    return 0;
}
