/* How long a response is: until what rings has sunk into the noise, as far as levels of all frequencies together tell.

   Of the recording both the sound and its first difference are asked, and the later answer counts: where rumble covers the sound, its high frequencies are heard longer in the
   difference; where the noise is white, its low ones in the sound.

   A mode stands out of the noise of its own narrow band for longer than all do out of all noise, so that no response is cut below `least`: beneath it wide-band noise 20 dB
   below a strike's peak leaves 20 ms, in which no low mode can be told. */
#include <math.h>

#include "analysis/strikes_level.h"
#include "analysis/strikes_response.h"
#include "num/fft.h"

static const double frame = 0.01; /* s */
static const double least = 0.25; /* s */

static double rms(const double *x, long from, long to)
{
    double sum = 0.0;
    for (long i = from; i < to; i++)
        sum += x[i] * x[i];
    return to > from ? sqrt(sum / (double)(to - from)) : 0.0;
}

/* ------------------------------------------------------------------ of the sound */

struct ringing_end {
    long longest;       /* samples */
    bool any;           /* some strike sinks into the noise before it ends */
};

/* Samples from the strike until the level has sunk to `noise`; *sank: it does before the strike ends. */
static long rings(const struct strikes_level *level, double noise, const struct strikes_one *v, bool *sank)
{
    long first = v->onset / level->frame, end = v->end / level->frame, last = end - 1;
    while (last > first && level->rms[last] <= noise)
        last--;
    *sank = (double)(end - last) > 2.0 + 0.05 * (double)(end - first);
    return *sank ? (last + 1) * level->frame - v->onset : v->end - v->onset;
}

static struct ringing_end longest(const struct strikes_job *j, const double *x)
{
    struct arena *a = arena_open();
    struct strikes_level level = strikes_level(x, j->r->n, j->r->rate, frame, a);
    struct ringing_end to = {0};
    for (int k = 0; k < j->s->n; k++) {
        bool sank = false;
        long n = j->used[k] ? rings(&level, 2.0 * level.floor, &j->s->strike[k], &sank) : 0;
        to.any = to.any || sank;
        to.longest = n > to.longest ? n : to.longest;
    }
    arena_close(a);
    return to;
}

long strikes_end_length(const struct strikes_job *j)
{
    const struct strikes_recording *r = j->r;
    struct arena *a = arena_open();
    double *steps = ARENA_TAKE(a, double, r->n);
    long most = 0;
    for (long i = 1; i < r->n; i++)
        steps[i] = r->sound[i] - r->sound[i - 1];
    struct ringing_end high = longest(j, steps), all = longest(j, r->sound);
    arena_close(a);
    for (int k = 0; k < j->s->n; k++)
        most = j->used[k] && j->s->strike[k].end - j->s->strike[k].onset > most ? j->s->strike[k].end - j->s->strike[k].onset : most;
    if (!high.any || (all.any && all.longest > high.longest))
        high = all;
    high.longest = (long)fmax((double)(high.longest + high.longest / 10), least * j->r->rate);
    return high.any && high.longest < most ? high.longest : most;
}

/* ------------------------------------------------------------------ of the response */

void strikes_end(const struct strikes_job *j)
{
    struct strikes_response *h = j->h;
    struct arena *a = arena_open();
    struct strikes_level level = strikes_level(h->h, h->length, j->r->rate, frame, a);
    double noise = 1.4 * rms(h->noise, 0, h->noise_n);
    long last = level.n - 1;
    while (h->noise && last > 4 && level.rms[last] <= noise)
        last--;
    arena_close(a);
    h->n = last + 2 < level.n ? (last + 2) * level.frame : h->length;
    h->n = (double)h->n > least * j->r->rate ? h->n : (long)fmin((double)h->length, least * j->r->rate);
    h->n -= h->n % 2;
    while (h->n > 2 && (long)fft_good_size((size_t)h->n) != h->n)
        h->n -= 2;
}
