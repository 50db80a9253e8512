/* F tests of every component against the noise around it. The energy that a component explains (sum over places, each over its noise) is chi squared of
   2 places degrees of freedom if there is nothing; the noise is estimated with `freedom` of them, so that energy/(2 places) is compared with
   F(2 places, freedom). */
#include "analysis/ringing_select.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

#include "analysis/ringing_blocks.h"
#include "num/real.h"

static void levels_make(struct ringing_fit *f, const struct ringing_noise *noise, double *freedom, struct arena *a, struct ringing_fit_errors *e)
{
    double *variance = ARENA_TAKE(a, double, f->m * f->r->places);
    ringing_noise_levels(noise, f, variance, freedom);
    ringing_fit_covariance(f, variance, a, e);
}

struct errors {
    const struct ringing_noise *noise;
    int m;
    struct ringing_fit_errors *e;
};

static bool errors_of_part(struct ringing_fit *part, void *context)
{
    struct errors *all = context;
    struct arena *a = arena_open();
    struct ringing_fit_errors e;
    levels_make(part, all->noise, ARENA_TAKE(a, double, part->m), a, &e);
    for (int k = 0; k < part->m; k++) {
        int i = part->part ? part->origin[k] : k;
        if (part->guest[k] && part->part)
            continue;
        all->e->decay[i] = e.decay[k];
        all->e->omega[i] = e.omega[k];
        all->e->energy[i] = e.energy[k];
        all->e->apart[i] = e.apart[k];
        for (int p = 0; p < part->r->places; p++)
            all->e->gain[p * all->m + i] = e.gain[p * part->m + k];
    }
    arena_close(a);
    return false;
}

void ringing_select_errors(struct ringing_fit *f, const struct ringing_noise *noise, struct arena *a, struct ringing_fit_errors *e)
{
    if (f->part) {
        levels_make(f, noise, ARENA_TAKE(a, double, f->m), a, e);
        return;
    }
    *e = (struct ringing_fit_errors){.decay = ARENA_TAKE(a, double, f->m), .omega = ARENA_TAKE(a, double, f->m), .energy = ARENA_TAKE(a, double, f->m),
                                     .apart = ARENA_TAKE(a, double, f->m), .gain = ARENA_TAKE(a, double, f->m * f->r->places)};
    ringing_blocks_renew(f);
    ringing_blocks_run(f, 1, errors_of_part, &(struct errors){noise, f->m, e});
}

/* How far above the level noise would come: log of the probability over the level; above 0 fails. */
static double excess(double energy, int places, double freedom, double level)
{
    double chance = gsl_cdf_fdist_Q(energy / (2 * places), 2 * places, fmax(freedom, 2));
    return real_log(fmax(chance, 1e-300) / level) - (chance < 1e-300 ? energy * 1e-30 : 0);
}

static bool near(const struct ringing_fit *f, int i, int k)
{
    double width = f->decay[i] + f->decay[k] + 2 * REAL_PI * f->r->rate / (double)f->r->n;
    return fabs(f->omega[i] - f->omega[k]) < 3 * width;
}

/* Marks what fails, worst first, leaving what is near to a worse one to the next look. */
static int fails_mark(const struct ringing_fit *f, double *fail, bool *drop)
{
    int dropped = 0;
    for (;;) {
        int worst = 0;
        for (int i = 1; i < f->m; i++)
            if (fail[i] > 0 && (worst == 0 || fail[i] > fail[worst]))
                worst = i;
        if (worst == 0)
            return dropped;
        drop[worst] = true;
        dropped++;
        for (int i = 1; i < f->m; i++)
            if (near(f, worst, i))
                fail[i] = 0;
    }
}

int ringing_select_drop(struct ringing_fit *f, const struct ringing_noise *noise, const struct ringing_select *s)
{
    for (int all = 0;;) {
        struct arena *a = arena_open();
        struct ringing_fit_errors e;
        double *freedom = ARENA_TAKE(a, double, f->m), *fail = ARENA_TAKE(a, double, f->m);
        bool *drop = ARENA_TAKE(a, bool, f->m);
        levels_make(f, noise, freedom, a, &e);
        for (int i = 1; i < f->m; i++) {
            if (f->guest[i])
                continue;
            fail[i] = excess(e.energy[i], f->r->places, freedom[i], s->level);
            if (f->decay[i] > RINGING_FIT_FASTEST * f->r->rate)
                fail[i] = HUGE_VAL;
            if (s->apart < 1)
                fail[i] = fmax(fail[i], excess(e.apart[i], f->r->places, freedom[i], s->apart));
        }
        int dropped = fails_mark(f, fail, drop);
        if (dropped > 0) {
            ringing_fit_drop(f, drop);
            ringing_fit_gains(f);
        }
        arena_close(a);
        all += dropped;
        if (dropped == 0)
            return all;
    }
}
