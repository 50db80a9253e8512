/* See loudness.h. A true peak costs libebur128 seven times as much as loudness. So only those pieces are measured that
   may hold one: between samples nothing is greater than BOUND times the greatest of those around it. */
#include "output/loudness.h"

#include <ebur128.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { PIECE = 64, BEFORE = 32 }; /* frames; of those before a piece its interpolator looks at 25 at most */
#define BOUND                                                                                                          \
    2.31 /* the greatest sum of its taps' magnitudes: 1.864 of four times as many samples, 2.307 of twice as many */

struct loudness {
    ebur128_state *meter;
    bool peaks;
    double most;    /* true peak so far */
    double *recent; /* [BEFORE + PIECE][channels] */
};

long loudness_least(double rate) { return 4 * (((long)rate + 5) / 10); }

static ebur128_state *meter_make(unsigned channels, unsigned long rate, int mode)
{
    errno = 0;
    ebur128_state *meter = ebur128_init(channels, rate, mode);
    if (!meter && errno == ENOMEM) memory_out("to measure loudness");
    return meter;
}

static void meter_add(ebur128_state *meter, const double *x, size_t frames)
{
    if (ebur128_add_frames_double(meter, x, frames) == EBUR128_ERROR_NOMEM) memory_out("to measure loudness");
}

struct loudness *loudness_open(int channels, double rate, bool peaks)
{
    int layout = channels == 1 ? EBUR128_DUAL_MONO : EBUR128_LEFT;
    bool ok = true;
    ebur128_state *meter = meter_make((unsigned)channels, (unsigned long)rate, EBUR128_MODE_I);
    for (int k = 0; meter && k < channels; k++)
        ok = ok && ebur128_set_channel(meter, (unsigned)k, layout) == EBUR128_SUCCESS;
    if (meter && !ok) ebur128_destroy(&meter);
    if (!meter) return NULL;
    struct loudness *l = memory_take(sizeof *l);
    size_t room = (size_t)((BEFORE + PIECE) * channels) * sizeof(double);
    *l = (struct loudness){.meter = meter, .peaks = peaks, .recent = memory_take(room)};
    memset(l->recent, 0, room);
    return l;
}

/* The true peak of n frames behind BEFORE others. */
static double peak_of(const struct loudness *l, size_t n)
{
    ebur128_state *meter = meter_make(l->meter->channels, l->meter->samplerate, EBUR128_MODE_TRUE_PEAK);
    double most = 0, one;
    if (!meter) return NAN;
    meter_add(meter, l->recent, BEFORE);
    meter_add(meter, l->recent + BEFORE * l->meter->channels, n);
    for (unsigned k = 0; k < meter->channels; k++)
        if (ebur128_prev_true_peak(meter, k, &one) == EBUR128_SUCCESS && one > most) most = one;
    ebur128_destroy(&meter);
    return most;
}

void loudness_add(struct loudness *l, double *x, size_t frames)
{
    size_t channels = l->meter->channels;
    meter_add(l->meter, x, frames);
    for (size_t from = 0, n; l->peaks && from < frames; from += n) {
        double most = 0;
        n = frames - from < PIECE ? frames - from : PIECE;
        memcpy(l->recent + BEFORE * channels, x + from * channels, n * channels * sizeof *x);
        for (size_t i = 0; i < (BEFORE + n) * channels; i++)
            most = fmax(most, fabs(l->recent[i]));
        if (BOUND * most > l->most) l->most = fmax(l->most, peak_of(l, n));
        memmove(l->recent, l->recent + n * channels, BEFORE * channels * sizeof *x);
    }
}

bool loudness_read(struct loudness *l, double *lufs)
{
    if (ebur128_loudness_global(l->meter, lufs) != EBUR128_SUCCESS || !isfinite(*lufs)) return false;
    *lufs = rint(*lufs * 1e6) / 1e6;
    return true;
}

double loudness_true_peak(const struct loudness *l) { return l->most; }

void loudness_close(struct loudness *l)
{
    if (!l) return;
    ebur128_destroy(&l->meter);
    free(l->recent);
    free(l);
}
