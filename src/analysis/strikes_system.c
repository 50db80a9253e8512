/* What the least squares of strikes_response.c are made of: the force of the strikes that there are, what each sample of the sound weighs, and the force's power.

   The power, sum |F|^2 over the used strikes, is the transform of the sum of their correlations, so that it needs no window. A sample weighs 1/level^2 times the square of
   its strike's peak: a strike is off from what all have in common by a share of its own sound, so that what is loud says little of what rings on beneath it. */
#include <math.h>

#include "analysis/strikes_level.h"
#include "analysis/strikes_response.h"
#include "num/fft.h"

static const double faint = 1e-4; /* of the loudest power: what is fainter weighs no more */

/* Without force, impulses. */
static void pulses(struct strikes_job *j)
{
    double *force = ARENA_TAKE(j->a, double, j->r->n);
    for (int k = 0; k < j->s->n; k++) {
        const struct strikes_one *v = &j->s->strike[k];
        for (long i = v->onset; j->r->force && i < v->over; i++)
            force[i] = j->s->sign * j->r->force[i] - v->base;
        if (!j->r->force)
            force[v->onset] = v->peak * j->r->rate;
    }
    j->system.force = force;
}

static void weights(struct strikes_job *j)
{
    struct strikes_level level = strikes_level(j->r->sound, j->r->n, j->r->rate, 0.01, j->a);
    double *weight = ARENA_TAKE(j->a, double, j->r->n), *lag = ARENA_TAKE(j->a, double, j->system.length), most = 0.0, all = 0.0, hardest = 0.0;
    for (long k = 0; k < level.n; k++)
        most = fmax(most, level.rms[k]);
    for (long i = 0; i < j->r->n; i++) {
        long k = i / level.frame < level.n ? i / level.frame : level.n - 1;
        double loud = fmax(level.rms[k], fmax(level.rms[k ? k - 1 : 0], level.rms[k + 1 < level.n ? k + 1 : k])) / most;
        weight[i] = (1.0 + faint) / (loud * loud + faint);
    }
    for (int k = 0; k < j->s->n; k++)
        hardest = fmax(hardest, j->used[k] ? j->s->strike[k].peak : 0.0);
    for (int k = 0; k < j->s->n; k++) {
        const struct strikes_one *v = &j->s->strike[k];
        double strong = j->used[k] ? v->peak * v->peak / (hardest * hardest) : 0.0;
        for (long i = v->onset; i < v->end; i++)
            weight[i] *= strong;
        all += j->used[k] ? v->peak * v->peak : 0.0;
    }
    for (int k = 0; k < j->s->n; k++)
        for (long i = j->s->strike[k].onset, m = 0; j->used[k] && i < j->r->n && m < j->system.length; i++, m++)
            lag[m] += j->s->strike[k].peak * j->s->strike[k].peak / all * weight[i];
    for (long m = 0; m < j->system.length; m++)
        lag[m] = fmax(lag[m], 1e-3);
    j->system.weight = weight;
    j->system.lag = lag;
}

/* At the transform's frequencies. */
static void power(struct strikes_job *j)
{
    const double *f = j->system.force;
    double *sum = ARENA_TAKE(j->a, double, j->size), *im = ARENA_TAKE(j->a, double, j->size / 2 + 1);
    long samples = 0;
    for (int k = 0; k < j->s->n; k++) {
        const struct strikes_one *v = &j->s->strike[k];
        long n = v->over > v->onset ? v->over - v->onset : 1;
        samples += j->used[k] ? n : 0;
        for (long lag = 0; j->used[k] && lag < n; lag++) {
            double product = 0.0;
            for (long i = v->onset; i < v->onset + n - lag; i++)
                product += f[i] * f[i + lag];
            sum[lag] += product;
            sum[(j->size - lag) % j->size] += lag ? product : 0.0;
        }
    }
    j->system.power = ARENA_TAKE(j->a, double, j->size / 2 + 1);
    struct fft *fft = fft_open((size_t)j->size);
    fft_forward(fft, sum, j->system.power, im);
    fft_close(fft);
    for (long i = 0; i <= j->size / 2; i++) {
        j->system.power[i] = fmax(j->system.power[i], 0.0);
        j->most = fmax(j->most, j->system.power[i]);
    }
    j->floor = j->r->force ? j->s->force_noise * j->s->force_noise * (double)samples : 0.0;
}

void strikes_system(struct strikes_job *j)
{
    j->most = 0.0;
    pulses(j);
    power(j);
    weights(j);
}
