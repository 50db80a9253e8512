/* A component whose gain is uncertain while all poles are free (though significant with the others' poles held) may be the half of one that was split: then the fit is made without the weaker
   of it and its nearest neighbour, polished, and the rise of the residual is held against the noise there: F(2 places + 2, freedom), as there go two gains per place and a
   pole. */
#include "analysis/ringing_apart.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <string.h>

#include "analysis/ringing_select.h"
#include "num/real.h"

enum { ROW = 5 };  /* trials in a row that change nothing: the others are surer still */

struct kept {
    int m;
    double *decay, *omega;
    bool *held, *fresh, *guest;
    int *tie, *origin;
    double complex *gain;
    double *energy;      /* [places] of the residual */
};

static void keep(const struct ringing_fit *f, struct arena *a, struct kept *k)
{
    *k = (struct kept){.m = f->m, .decay = ARENA_TAKE(a, double, f->m), .omega = ARENA_TAKE(a, double, f->m), .held = ARENA_TAKE(a, bool, f->m),
                       .fresh = ARENA_TAKE(a, bool, f->m), .guest = ARENA_TAKE(a, bool, f->m), .tie = ARENA_TAKE(a, int, f->m), .origin = ARENA_TAKE(a, int, f->m),
                       .gain = ARENA_TAKE(a, double complex, f->m * f->r->places), .energy = ARENA_TAKE(a, double, f->r->places)};
    memcpy(k->decay, f->decay, sizeof(double) * (size_t)k->m);
    memcpy(k->omega, f->omega, sizeof(double) * (size_t)k->m);
    memcpy(k->held, f->held, sizeof(bool) * (size_t)k->m);
    memcpy(k->fresh, f->fresh, sizeof(bool) * (size_t)k->m);
    memcpy(k->guest, f->guest, sizeof(bool) * (size_t)k->m);
    memcpy(k->tie, f->tie, sizeof(int) * (size_t)k->m);
    memcpy(k->origin, f->origin, sizeof(int) * (size_t)k->m);
    for (int p = 0; p < f->r->places; p++) {
        memcpy(k->gain + p * k->m, f->gain + (long)p * f->most, sizeof(double complex) * (size_t)k->m);
        k->energy[p] = f->energy[p];
    }
}

static void keep_back(struct ringing_fit *f, const struct kept *k)
{
    f->m = k->m;
    memcpy(f->decay, k->decay, sizeof(double) * (size_t)k->m);
    memcpy(f->omega, k->omega, sizeof(double) * (size_t)k->m);
    memcpy(f->held, k->held, sizeof(bool) * (size_t)k->m);
    memcpy(f->fresh, k->fresh, sizeof(bool) * (size_t)k->m);
    memcpy(f->guest, k->guest, sizeof(bool) * (size_t)k->m);
    memcpy(f->tie, k->tie, sizeof(int) * (size_t)k->m);
    memcpy(f->origin, k->origin, sizeof(int) * (size_t)k->m);
    for (int p = 0; p < f->r->places; p++)
        memcpy(f->gain + (long)p * f->most, k->gain + p * k->m, sizeof(double complex) * (size_t)k->m);
    ringing_fit_gains(f);
}

bool ringing_apart_try(struct ringing_fit *f, const struct ringing_noise *noise, int i, double level)
{
    struct arena *a = arena_open();
    struct kept k;
    int places = f->r->places;
    double *variance = ARENA_TAKE(a, double, f->m * places), *freedom = ARENA_TAKE(a, double, f->m), rise = 0;
    bool *drop = ARENA_TAKE(a, bool, f->m);
    keep(f, a, &k);
    ringing_noise_levels(noise, f, variance, freedom);
    drop[i] = true;
    ringing_fit_drop(f, drop);
    ringing_fit_polish(f, 8);
    for (int p = 0; p < places; p++)
        rise += (f->energy[p] - k.energy[p]) / variance[p * k.m + i];
    bool gone = gsl_cdf_fdist_Q(fmax(rise, 0) / (2 * places + 2), 2 * places + 2, fmax(freedom[i], 2)) >= level;
    if (!gone)
        keep_back(f, &k);
    arena_close(a);
    return gone;
}

static int nearest(const struct ringing_fit *f, int i)
{
    double least = HUGE_VAL;
    int at = 0;
    for (int k = 1; k < f->m; k++) {
        double x = f->decay[k] - f->decay[i], y = f->omega[k] - f->omega[i];
        if (k != i && x * x + y * y < least) {
            least = x * x + y * y;
            at = k;
        }
    }
    return at;
}

static double strength(const struct ringing_fit *f, int i)
{
    double sum = 0;
    for (int p = 0; p < f->r->places; p++) {
        double complex b = f->gain[(long)p * f->most + i];
        sum += creal(b) * creal(b) + cimag(b) * cimag(b);
    }
    return sum / (f->decay[i] + f->r->rate / (double)f->r->n);
}

/* The least sure component that was not yet tried; 0: none. */
static int least_sure(struct ringing_fit *f, const struct ringing_noise *noise, double level, const double *tried)
{
    struct arena *a = arena_open();
    struct ringing_fit_errors e;
    int places = f->r->places, worst = 0;
    double greatest = level, *variance = ARENA_TAKE(a, double, f->m * places), *freedom = ARENA_TAKE(a, double, f->m);
    ringing_noise_levels(noise, f, variance, freedom);
    ringing_fit_covariance(f, variance, a, &e);
    for (int i = 1; i < f->m; i++) {
        double chance = gsl_cdf_fdist_Q(e.apart[i] / (2 * places), 2 * places, fmax(freedom[i], 2));
        bool done = f->held[i] || f->guest[i];
        for (const double *t = tried; *t > 0; t++)
            done = done || fabs(*t - f->omega[i]) < 1e-6 * *t;
        if (!done && chance > greatest) {
            greatest = chance;
            worst = i;
        }
    }
    arena_close(a);
    return worst;
}

int ringing_apart(struct ringing_fit *f, const struct ringing_noise *noise, double level)
{
    struct arena *a = arena_open();
    double *tried = ARENA_TAKE(a, double, f->m + 2); /* rad/s of what was tried and stays */
    int gone = 0, stays = 0;
    for (int i, room = f->m, row = 0; room > 0 && row < ROW && (i = least_sure(f, noise, level, tried)) > 0; room--) {
        int other = nearest(f, i), weaker = other > 0 && strength(f, other) < strength(f, i) ? other : i;
        double omega = f->omega[i];
        bool went = ringing_apart_try(f, noise, weaker, level);
        row = went ? 0 : row + 1;
        if (went)
            gone++;
        else
            tried[stays++] = omega;
    }
    arena_close(a);
    return gone;
}
