/* Second slopes. Two decays at one frequency are one pole too few for a fit, whose residual has its energy where the mode is: so companions of the same frequency are
   offered, of SPREAD times and of a SPREADth of its decay, their gains fitted with all others', and those kept that are more than noise; the polish finds where they belong. */
#include "analysis/ringing_slopes.h"

#include <math.h>
#include <stdlib.h>

#include "analysis/ringing_apart.h"
#include "analysis/ringing_blocks.h"
#include "analysis/ringing_select.h"

enum { OFFERED = 100 };

#define SPREAD 4.0
#define STANDS 500.0  /* chi squared of a mode, at least, for a second slope to be sought: a slope 20 dB weaker would not be seen in less */
#define UNLIKE 1.3    /* ratio of two slopes' decays, at least */
#define ALIKE 0.02    /* frequencies that differ by less than this share of the decays' difference are one */

struct slopes {
    const struct ringing_noise *noise;
    double level, stands;
};

static int falling(const void *x, const void *y)
{
    double a = *(const double *)x, b = *(const double *)y;
    return (a < b) - (a > b);
}

/* Companions are offered to the OFFERED that stand out most: those of a thousand would take long, and few have any. */
static double stands(struct ringing_fit *f, const struct ringing_noise *noise)
{
    struct arena *a = arena_open();
    struct ringing_fit_errors e;
    ringing_select_errors(f, noise, a, &e);
    qsort(e.energy, (size_t)f->m, sizeof *e.energy, falling);
    double least = f->m > OFFERED ? fmax(e.energy[OFFERED], STANDS) : STANDS;
    arena_close(a);
    return least;
}

static bool companions_try(struct ringing_fit *f, void *context)
{
    const struct slopes *s = context;
    const struct ringing_noise *noise = s->noise;
    struct arena *a = arena_open();
    struct ringing_fit_errors e;
    int before = f->m;
    ringing_select_errors(f, noise, a, &e);
    for (int i = 1, m = f->m; i < m; i++) {
        if (e.energy[i] < s->stands || f->guest[i] || f->held[i] || !(f->decay[i] > 3 * e.decay[i]))
            continue;
        ringing_fit_add(f, f->decay[i] * SPREAD, f->omega[i]);
        ringing_fit_add(f, f->decay[i] / SPREAD, f->omega[i]);
    }
    bool offered = f->m > before;
    if (offered || !f->part) {
        ringing_fit_gains(f);
        ringing_select_drop(f, noise, &(struct ringing_select){s->level, 1});
        ringing_fit_polish(f, 10);
    }
    arena_close(a);
    return offered;
}

void ringing_slopes_find(struct ringing_fit *f, const struct ringing_noise *noise, double level)
{
    struct slopes s = {noise, level, stands(f, noise)};
    ringing_blocks_renew(f);
    ringing_blocks_run(f, 1, companions_try, &s);
}

static bool one_frequency(const struct ringing_fit *f, const struct ringing_fit_errors *e, int i, int k)
{
    double apart = fabs(f->omega[i] - f->omega[k]), slopes = fabs(f->decay[i] - f->decay[k]);
    double chance = 3 * sqrt(e->omega[i] * e->omega[i] + e->omega[k] * e->omega[k]);
    double unsure = 3 * sqrt(e->decay[i] * e->decay[i] + e->decay[k] * e->decay[k]);
    bool unlike = f->decay[i] > UNLIKE * f->decay[k] || f->decay[k] > UNLIKE * f->decay[i];
    return apart < fmax(chance, ALIKE * slopes) && slopes > unsure && unlike;
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

/* The next pair that has no tie yet: the stronger first. */
static bool pair_find(const struct ringing_fit *f, const struct ringing_fit_errors *e, int *first, int *second)
{
    for (int i = 1; i < f->m; i++)
        for (int k = i + 1; k < f->m; k++) {
            bool taken = f->tie[i] >= 0 || f->tie[k] >= 0;
            for (int x = 1; x < f->m; x++)
                taken = taken || f->tie[x] == i || f->tie[x] == k;
            if (taken || f->guest[f->omega[i] < f->omega[k] ? i : k] || !one_frequency(f, e, i, k))
                continue;
            *first = strength(f, i) >= strength(f, k) ? i : k;
            *second = *first == i ? k : i;
            return true;
        }
    return false;
}

static bool pairs_tie(struct ringing_fit *f, void *context)
{
    const struct slopes *s = context;
    const struct ringing_noise *noise = s->noise;
    int first, second, tied = 0, before = f->m;
    for (int room = f->m; room > 0; room--) {
        struct arena *a = arena_open();
        struct ringing_fit_errors e;
        ringing_select_errors(f, noise, a, &e);
        bool found = pair_find(f, &e, &first, &second);
        arena_close(a);
        if (!found)
            break;
        if (ringing_apart_try(f, noise, second, s->level))
            continue;
        double heavy = strength(f, first), light = strength(f, second);
        f->omega[first] = (heavy * f->omega[first] + light * f->omega[second]) / (heavy + light);
        f->omega[second] = f->omega[first];
        f->tie[second] = first;
        tied++;
    }
    if (tied > 0)
        ringing_fit_polish(f, 30);
    return tied > 0 || f->m < before;
}

void ringing_slopes_tie(struct ringing_fit *f, const struct ringing_noise *noise, double level)
{
    struct slopes s = {.noise = noise, .level = level};
    ringing_blocks_renew(f);
    ringing_blocks_run(f, 1, pairs_tie, &s);
}
