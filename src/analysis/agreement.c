/* Two renders of a chaotic system are alike until the difference has grown to the size of the sound itself; from then
   on they are two sounds of the same kind. The instant t* is where the short-time error

     e_w^2 = (sum of (b - a)^2) / (sum of a^2)      over windows w of 10 ms, all channels together

   first reaches 1/4 (6 dB below the sound; two sounds of equal power that have nothing to do with each other differ by
   2), while the same ratio over all from that window to the end reaches 1/4 too: a gap in the sound, where its error
   may be the larger, or one wrong moment is no divergence. Errors of a chaotic system grow exponentially, so t* depends
   on the 1/4 by a few windows at most. */
#include "analysis/agreement.h"

#include <math.h>

#define SHARE 0.25

static void energies(const struct wav *a, const struct wav *b, size_t from, size_t to, double sum[2])
{
    for (size_t i = from * (size_t)a->channels; i < to * (size_t)a->channels; i++) {
        double d = b->x[i] - a->x[i];
        sum[0] += a->x[i] * a->x[i];
        sum[1] += d * d;
    }
}

size_t agreement(const struct wav *a, const struct wav *b)
{
    size_t frames = a->frames < b->frames ? a->frames : b->frames,
           window = (size_t)fmax(AGREEMENT_WINDOW * a->rate, 1.0), until = frames;
    double rest[2] = {0};
    for (size_t w = (frames + window - 1) / window; w-- > 0;) {
        double here[2] = {0};
        energies(a, b, w * window, (w + 1) * window < frames ? (w + 1) * window : frames, here);
        rest[0] += here[0];
        rest[1] += here[1];
        if (here[1] > 0.0 && here[1] >= SHARE * here[0] && rest[1] >= SHARE * rest[0]) until = w * window;
    }
    return until;
}
