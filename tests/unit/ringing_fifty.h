/* 50 modes with five close pairs, found and held against the Cramer-Rao bound. */
#ifndef RINGING_FIFTY_H
#define RINGING_FIFTY_H
#include "ringing_found.h"

/* The 50 modes with close pairs at one signal-to-noise ratio; returns how many were found. */
static inline int fifty(double decibel, unsigned long seed, double ratio[2], int *tell, int *told)
{
    static double h[LONG];
    struct arena *a = arena_open();
    struct truth m[SERIES_MODES];
    struct ringing_modes found;
    gsl_rng *g = generator(seed);
    double frequency[4 * SERIES_MODES];
    int of[SERIES_MODES], ratios = 0;
    series_fifty(g, m);
    series_sum(m, SERIES_MODES, RATE, LONG, h);
    double deviation = series_deviation(h, RATE, decibel);
    series_bound(m, SERIES_MODES, RATE, LONG, deviation);
    series_noise(g, deviation, LONG, h);
    find((const double *const[]){h}, 1, LONG, a, &found);
    ck_assert_int_le(found.n, SERIES_MODES);
    for (int i = 0; i < found.n; i++)
        frequency[i] = found.mode[i].frequency;
    int all = series_match(m, SERIES_MODES, frequency, found.n, 3, of);
    ratio[0] = ratio[1] = *tell = *told = 0;
    for (int i = 0; i < SERIES_MODES; i++) {
        bool tells = m[i].gain > 6 * m[i].bound_gain; /* the neighbour's pole free: told from it and from noise */
        *tell += tells;
        *told += tells && of[i] >= 0;
        if (!tells || of[i] < 0)
            continue;
        const struct ringing_mode *k = &found.mode[of[i]];
        ratio[0] += pow((k->frequency - m[i].frequency) / m[i].bound_frequency, 2);
        ratio[1] += pow((k->decay - m[i].decay) / m[i].bound_decay, 2);
        ratios++;
    }
    ratio[0] = sqrt(ratio[0] / ratios);
    ratio[1] = sqrt(ratio[1] / ratios);
    gsl_rng_free(g);
    arena_close(a);
    return all;
}

#endif
