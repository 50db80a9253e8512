/* Modes found in known responses. */
#ifndef RINGING_FOUND_H
#define RINGING_FOUND_H
#include "analysis/ringing.h"

#include "ringing_series.h"
#include "unit.h"

extern void openblas_set_num_threads(int n);

enum { LONG = 44100 };

static const double RATE = 44100;

static inline gsl_rng *generator(unsigned long seed)
{
    gsl_rng *g = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(g, seed);
    return g;
}

static inline void find(const double *const *h, int places, long n, struct arena *a, struct ringing_modes *m)
{
    struct err e = {0};
    struct ringing_options o = ringing_options;
    o.most = 200;
    openblas_set_num_threads(1);
    ck_assert_msg(ringing_esprit(&(struct ringing){.places = places, .n = n, .rate = RATE, .h = h}, &o, a, m, &e), "%s", e.text);
}

static inline const struct ringing_mode *nearest(const struct ringing_modes *m, double frequency)
{
    const struct ringing_mode *best = NULL;
    for (int i = 0; i < m->n; i++)
        if (!best || fabs(m->mode[i].frequency - frequency) < fabs(best->frequency - frequency))
            best = &m->mode[i];
    ck_assert_ptr_nonnull(best);
    return best;
}

#endif
