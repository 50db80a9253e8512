/* A component that decays by no more than twice its standard error is a hum (the mains, a fan) only if it can be one. What is greater than the response itself is the half of a pair that
   cancels: taken away alone, the other half would be left and be far more than there is; so it goes out of the fit, and the others are fitted anew. And where the noise before the
   strikes is known, a hum stands in it: what does not is a mode whose decay the response is too short, or its strikes too unlike, to tell.

   A sine of amplitude A makes A^2 S/6 of its bin of a periodogram of S samples under Hann's window, and a quarter of it in both that are next: the mean of the three, which
   ringing_noise_given tells, is A^2 S/12. */
#include "analysis/ringing_hums.h"

#include <math.h>

#include "analysis/ringing_blocks.h"
#include "analysis/ringing_select.h"
#include "num/real.h"

enum { MOST = 24 };                      /* go one by one; a fit that needs more is judged by what it explains */

static const double slack = 1.05;        /* of the response's energy */
static const double heard = 0.01;        /* power of a hum in the noise, of its power in the response: 20 dB, as strikes that are divided out weigh it otherwise */
static const double still = 1e-3;        /* squared deviations, as of the last polish of a search */

static double power(const struct ringing_fit *f, int i, int place)
{
    double complex b = f->gain[(long)place * f->most + i];
    return creal(b) * creal(b) + cimag(b) * cimag(b);
}

/* The greatest share of a place's energy. */
static double share(const struct ringing_fit *f, int i)
{
    double most = 0, n = (double)f->r->n, x = 2 * f->decay[i] * n / f->r->rate, lasts = x > 1e-6 ? (1 - real_exp(-x)) / x : 1;
    for (int p = 0; p < f->r->places; p++) {
        double all = 0;
        for (long k = 0; k < f->r->n; k++)
            all += f->r->h[p][k] * f->r->h[p][k];
        if (all > 0)
            most = fmax(most, 0.5 * power(f, i, p) * n * lasts / all);
    }
    return most;
}

static bool in_noise(const struct ringing_fit *f, const struct ringing_noise *noise, int i)
{
    double there = 0, here = 0;
    if (!noise->given)
        return true;
    for (int p = 0; p < f->r->places; p++) {
        there += 12 * ringing_noise_given(noise, p, f->omega[i] / (2 * REAL_PI)) / (double)(2 * noise->given_bins);
        here += power(f, i, p);
    }
    return there >= heard * here;
}

void ringing_hums_kinds(const struct ringing_fit *f, const struct ringing_noise *noise, const struct ringing_fit_errors *e, enum ringing_hums_kind *kind)
{
    for (int i = 1; i < f->m; i++) {
        kind[i] = RINGING_HUMS_NONE;
        if (f->held[i] || f->decay[i] > 2 * e->decay[i])
            continue;
        kind[i] = f->tie[i] >= 0 || share(f, i) > slack ? RINGING_HUMS_SURPLUS : in_noise(f, noise, i) ? RINGING_HUMS_HUM : RINGING_HUMS_MODE;
    }
}

static bool polish(struct ringing_fit *part, void *context)
{
    (void)context;
    return ringing_fit_polish(part, 5) > still;
}

/* The one to go; 0: none. */
static int greatest(struct ringing_fit *f, const struct ringing_noise *noise, bool all)
{
    struct arena *a = arena_open();
    struct ringing_fit_errors e;
    enum ringing_hums_kind *kind = ARENA_TAKE(a, enum ringing_hums_kind, f->m);
    double most = -1;
    int at = 0;
    ringing_select_errors(f, noise, a, &e);
    ringing_hums_kinds(f, noise, &e, kind);
    for (int i = 1; i < f->m; i++)
        if ((kind[i] == RINGING_HUMS_SURPLUS || (all && kind[i] == RINGING_HUMS_HUM)) && share(f, i) > most) {
            most = share(f, i);
            at = i;
        }
    arena_close(a);
    return at;
}

int ringing_hums_drop(struct ringing_fit *f, const struct ringing_noise *noise, bool all)
{
    int gone = 0;
    for (int i; gone < MOST && (i = greatest(f, noise, all)) > 0; gone++) {
        struct arena *a = arena_open();
        bool *drop = ARENA_TAKE(a, bool, f->m);
        drop[i] = true;
        ringing_fit_drop(f, drop);
        ringing_blocks_renew(f);
        ringing_blocks_gains(f);
        ringing_blocks_settle(f, 2, polish, NULL);
        arena_close(a);
    }
    return gone;
}
