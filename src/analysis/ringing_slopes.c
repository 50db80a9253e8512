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
#define UNLIKELY 6.63 /* chi squared of 1 degree that one frequency exceeds in 1 % of cases: frequencies' errors go together, so that two may fit clearly better though each is unsure */
#define SAME 1e-6     /* share by which a frequency may have moved since it was looked at */
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

static bool alike(const struct ringing_fit *f, int i, int k)
{
    return fabs(f->omega[i] - f->omega[k]) < ALIKE * fabs(f->decay[i] - f->decay[k]);
}

static bool one_frequency(const struct ringing_fit *f, const struct ringing_fit_errors *e, int i, int k)
{
    double apart = fabs(f->omega[i] - f->omega[k]), slopes = fabs(f->decay[i] - f->decay[k]);
    double chance = 3 * sqrt(e->omega[i] * e->omega[i] + e->omega[k] * e->omega[k]);
    double unsure = 3 * sqrt(e->decay[i] * e->decay[i] + e->decay[k] * e->decay[k]);
    bool unlike = f->decay[i] > UNLIKE * f->decay[k] || f->decay[k] > UNLIKE * f->decay[i];
    return (apart < chance || alike(f, i, k)) && slopes > unsure && unlike;
}

struct two {           /* pairs that stay two frequencies, by what these are: indices move when one goes */
    int n;
    double (*omega)[2];
};

static bool known(const struct two *t, double x, double y)
{
    bool is = false;
    for (int k = 0; k < t->n; k++)
        is = is || (fabs(t->omega[k][0] / x - 1) < SAME && fabs(t->omega[k][1] / y - 1) < SAME);
    return is;
}

/* The next pair that has no tie yet: the stronger first. */
static bool pair_find(const struct ringing_fit *f, const struct ringing_fit_errors *e, const struct two *two, int pair[2])
{
    for (int i = 1; i < f->m; i++)
        for (int k = i + 1; k < f->m; k++) {
            bool taken = f->tie[i] >= 0 || f->tie[k] >= 0 || known(two, f->omega[i], f->omega[k]);
            for (int x = 1; x < f->m; x++)
                taken = taken || f->tie[x] == i || f->tie[x] == k;
            if (taken || f->guest[f->omega[i] < f->omega[k] ? i : k] || !one_frequency(f, e, i, k))
                continue;
            pair[0] = ringing_apart_strength(f, i) >= ringing_apart_strength(f, k) ? i : k;
            pair[1] = pair[0] == i ? k : i;
            return true;
        }
    return false;
}

/* One frequency with two decays, or two? Without second slopes the pair is two or one. */
static bool pairs_tie(struct ringing_fit *f, void *context)
{
    const struct slopes *s = context;
    const struct ringing_noise *noise = s->noise;
    struct arena *kept = arena_open();
    struct two two = {.omega = arena_take(kept, (size_t)f->m, sizeof *two.omega)};
    int pair[2], tied = 0, before = f->m;
    for (int room = f->m; room > 0; room--) {
        struct arena *a = arena_open();
        struct ringing_fit_errors e;
        ringing_select_errors(f, noise, a, &e);
        bool found = pair_find(f, &e, &two, pair);
        arena_close(a);
        if (!found)
            break;
        double was[2] = {f->omega[pair[0] < pair[1] ? pair[0] : pair[1]], f->omega[pair[0] < pair[1] ? pair[1] : pair[0]]};
        if (s->level > 0 && ringing_apart_try(f, noise, pair[1], s->level))
            continue;
        if (!ringing_apart_tie(f, noise, pair, alike(f, pair[0], pair[1]) ? HUGE_VAL : UNLIKELY)) {
            two.omega[two.n][0] = was[0];
            two.omega[two.n++][1] = was[1];
        } else if (s->level > 0) {
            tied++;
        } else {
            ringing_apart_try(f, noise, pair[1], 0);
        }
    }
    arena_close(kept);
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
