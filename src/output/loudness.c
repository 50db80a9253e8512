/* See loudness.h. */
#include "output/loudness.h"

#include <ebur128.h>
#include <errno.h>
#include <math.h>

#include "base/memory.h"

long loudness_least(double rate) { return 4 * (((long)rate + 5) / 10); }

struct loudness *loudness_open(int channels, double rate, bool peaks)
{
    int layout = channels == 1 ? EBUR128_DUAL_MONO : EBUR128_LEFT;
    bool ok = true;
    errno = 0;
    ebur128_state *meter =
        ebur128_init((unsigned)channels, (unsigned long)rate, EBUR128_MODE_I | (peaks ? EBUR128_MODE_TRUE_PEAK : 0));
    for (int k = 0; meter && k < channels; k++)
        ok = ok && ebur128_set_channel(meter, (unsigned)k, layout) == EBUR128_SUCCESS;
    if (!meter && errno == ENOMEM) memory_out("to measure loudness");
    if (meter && !ok) ebur128_destroy(&meter);
    return (struct loudness *)meter;
}

void loudness_add(struct loudness *l, double *x, size_t frames)
{
    if (ebur128_add_frames_double((ebur128_state *)l, x, frames) == EBUR128_ERROR_NOMEM)
        memory_out("to measure loudness");
}

bool loudness_read(struct loudness *l, double *lufs)
{
    if (ebur128_loudness_global((ebur128_state *)l, lufs) != EBUR128_SUCCESS || !isfinite(*lufs)) return false;
    *lufs = rint(*lufs * 1e6) / 1e6;
    return true;
}

double loudness_true_peak(struct loudness *l)
{
    const ebur128_state *meter = (const ebur128_state *)l;
    double most = 0, one;
    for (unsigned k = 0; k < meter->channels; k++)
        if (ebur128_true_peak((ebur128_state *)l, k, &one) == EBUR128_SUCCESS && one > most) most = one;
    return most;
}

void loudness_close(struct loudness *l)
{
    ebur128_state *meter = (ebur128_state *)l;
    if (meter) ebur128_destroy(&meter);
}
