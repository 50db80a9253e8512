/* An impulse response from a WAV.

   At the file's own rate r the convolution is y[n] = sum_m k[n - m] f[m], k = {x[0]/2, x[1], x[2], ...}/r: half of the
   first sample is the trapezium rule at the jump from 0 to h(0+) (ir.h). At another rate R the same operator is wanted
   for every force below both Nyquist frequencies, and that is the band-limited signal through {x[0]/2, x[1], ...}, read
   at n/R and divided by R: the half is taken once, before resampling, and the first sample that comes out counts whole.
   A recorded response is band-limited already and begins with silence, so that little depends on it. What a jump at the
   very first sample makes ring before t = 0 is folded into the first samples (num/lead.h), since a response is causal:
   its integral, the answer to what is slow, stays what it is. Values per second stay: nothing is scaled by the ratio of
   rates. */
#include "response/ir.h"

#include <math.h>

#include "file/wav.h"
#include "num/resample.h"

static bool silent(const double *x, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (x[i] != 0.0) return false;
    return true;
}

static size_t cut(double rate, double t0, size_t n)
{
    size_t most = isnan(t0) ? n : ir_length(rate, t0);
    return most < n ? most : n;
}

/* h with the rate of the file, and with `rate`. */
/* NULL: an error. */
static double *convert(const struct ir_ask *ask, const struct wav *w, struct arena *a, struct ir *ir, struct err *e)
{
    double *h = w->x;
    ir->note = NULL;
    ir->length = w->frames;
    if (w->rate == ask->rate) return h;
    ir->note = arena_format(a, "%s: resampled from %g Hz to %g Hz", ask->path, w->rate, ask->rate);
    if (resample(a, w->x, w->frames, w->rate, ask->rate, &h, &ir->length, e)) return h;
    err_at(e, "%s", ask->path);
    return NULL;
}

static bool make(const char *path, const void *how, struct arena *a, void *thing, struct err *e)
{
    const struct ir_ask *ask = how;
    struct ir *ir = thing;
    struct wav w;
    if (!wav_read(path, a, &w, e)) return false;
    if (w.channels != 1)
        return err_set(e, ERR_SCENE, "%s: has %d channels; an impulse response is mono: extract one channel", path,
                       w.channels);
    size_t before = cut(w.rate, ask->t0, w.frames);
    if (silent(w.x, before))
        return err_set(e, ERR_SCENE,
                       "%s: the impulse response is silent%s; give one that rings, or leave the response out", path,
                       before < w.frames ? " before response_length" : "");
    w.x[0] *= 0.5;
    double *h = convert(ask, &w, a, ir, e);
    if (!h) return false;
    ir->length = cut(ask->rate, ask->t0, ir->length);
    for (size_t n = 0; n < ir->length; n++)
        h[n] /= ask->rate;
    ir->h = h;
    return true;
}

bool ir_read(const struct ir_ask *ask, struct arena *a, struct ir *ir, struct err *e)
{
    static const struct shelf_kind recorded = {"recorded response", sizeof(struct ir), make, false};
    const char *key = ask->shelf ? arena_format(a, "%a %a", ask->rate, ask->t0) : NULL;
    const struct ir *found = shelf_take(ask->shelf, &(struct shelf_ask){&recorded, ask->path, key, ask}, a, e);
    if (found) *ir = *found;
    return found;
}
