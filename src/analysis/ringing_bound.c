/* A bound on the components. In the response of a real strike what is left of a fit is no noise that more components would leave alone: strikes fall a little beside each other,
   the object is not quite linear, the microphone hears a room. A search until nothing stands out would not end before it has as many components as the response has freedom.
   So the fit never has more than some one and a half times the modes that are looked for; and of those that are more, the ones go without which the energy that
   is left rises least (backward elimination; the others' gains follow, a quarter of the surplus at once). The same makes, where modes overlap, a fit of no more than are asked for. */
#include "analysis/ringing_bound.h"

#include <math.h>
#include <stdlib.h>

#include "analysis/ringing_blocks.h"
#include "analysis/ringing_select.h"
#include "num/real.h"

struct loss {
    double rise;       /* of the residual's energy */
    int i;
};

static int rising(const void *x, const void *y)
{
    const struct loss *a = x, *b = y;
    return a->rise > b->rise ? 1 : a->rise < b->rise ? -1 : a->i - b->i;
}

/* What the residual's energy rises by when one goes, with what is tied to it, the poles of the others held; of `n` listed. */
static void losses_make(struct ringing_fit *f, const struct ringing_noise *noise, int n, struct loss *loss)
{
    struct arena *a = arena_open();
    struct ringing_fit_errors e;
    double *variance = ARENA_TAKE(a, double, f->m * f->r->places), *freedom = ARENA_TAKE(a, double, f->m), *rise = ARENA_TAKE(a, double, f->m);
    ringing_noise_levels(noise, f, variance, freedom);
    ringing_select_errors(f, noise, a, &e);
    for (int i = 1; i < f->m; i++)
        for (int p = 0; p < f->r->places; p++)
            rise[f->tie[i] >= 0 ? f->tie[i] : i] += e.energy[i] * variance[p * f->m + i] / f->r->places;
    for (int k = 0; k < n; k++)
        loss[k].rise = rise[loss[k].i];
    qsort(loss, (size_t)n, sizeof *loss, rising);
    arena_close(a);
}

static void drop_first(struct ringing_fit *f, const struct loss *loss, int n)
{
    struct arena *a = arena_open();
    bool *drop = ARENA_TAKE(a, bool, f->m);
    for (int k = 0; k < n; k++)
        drop[loss[k].i] = true;
    for (int i = 1; i < f->m; i++)
        drop[i] = drop[i] || (f->tie[i] >= 0 && drop[f->tie[i]]);
    ringing_fit_drop(f, drop);
    ringing_blocks_renew(f);
    ringing_blocks_gains(f);
    arena_close(a);
}

/* Of those between low and high, rad/s. */
static bool reduce(struct ringing_fit *f, const struct ringing_noise *noise, int most, const double band[2])
{
    for (bool any = false;; any = true) {
        struct arena *a = arena_open();
        struct loss *loss = ARENA_TAKE(a, struct loss, f->m);
        int n = 0;
        for (int i = 1; i < f->m; i++)
            if (f->tie[i] < 0 && !f->held[i] && f->omega[i] >= band[0] && f->omega[i] <= band[1])
                loss[n++].i = i;
        int surplus = n - most;
        if (surplus > 0) {
            losses_make(f, noise, n, loss);
            drop_first(f, loss, surplus / 4 + 1);
        }
        arena_close(a);
        if (surplus <= 0)
            return any;
    }
}

void ringing_bound(struct ringing_fit *f, const struct ringing_noise *noise, int most) { reduce(f, noise, most, (const double[]){0, HUGE_VAL}); }

bool ringing_bound_modes(struct ringing_fit *f, const struct ringing_noise *noise, const struct ringing_options *o)
{
    double low = fmax(o->low, f->r->low), high = f->r->high > 0 ? f->r->high : f->r->rate / 2;
    if (o->high > 0)
        high = fmin(high, o->high);
    return reduce(f, noise, o->most, (const double[]){2 * REAL_PI * low, 2 * REAL_PI * high});
}
