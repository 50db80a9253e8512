/* Offset: the mean of the longest quiet part, in whole tenths of a second, in which hum of 50 or 60 Hz and its
   harmonics has none. Where no tenth is quiet, that of the median and the mean of all which is nearer to 0, if both are
   of one sign: most of a recording of strikes is ringing then, which is as often above as below, but even harmonics of
   a hum move the median, and pulses the mean. It is taken off where it is more than a thousandth of the greatest sample
   and four standard errors: the thresholds of strikes_find and the energies of strikes_response are about 0.

   Clipping, in files that hold more than they were recorded with (floating point, or scaled afterwards): the greatest
   sample stands several times in a row, and the signal leaves it at once. A slow wave in few bits has such rows too,
   but leaves them by single steps, which are the least difference between neighbours that there is. */
#include "analysis/strikes_channel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "analysis/strikes_level.h"

enum { ROW = 3, STEPS = 4 }; /* samples in a row; steps by which it is left */

static const double considerable = 1e-3;
static const double tenth = 0.1; /* s */
static const double quiet = 0.5; /* of the loudest tenth's level */

static int rising(const void *a, const void *b)
{
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

static double median(const double *x, long n)
{
    struct arena *a = arena_open();
    double *sorted = ARENA_TAKE(a, double, n);
    memcpy(sorted, x, (size_t)n * sizeof *x);
    qsort(sorted, (size_t)n, sizeof *sorted, rising);
    double m = sorted[n / 2];
    arena_close(a);
    return m;
}

static double mean(const double *x, long from, long to)
{
    double sum = 0.0;
    for (long i = from; i < to; i++)
        sum += x[i];
    return sum / (double)(to - from);
}

/* Of the longest quiet part; *error: its standard error. NAN: nothing is quiet. */
static double quiet_mean(const double *x, long n, double rate, double *error)
{
    struct arena *a = arena_open();
    struct strikes_level l = strikes_level(x, n, rate, tenth, a);
    double loudest = 0.0, found = NAN;
    long from, to;
    for (long k = 0; k < l.n; k++)
        loudest = fmax(loudest, l.rms[k]);
    strikes_level_quiet(&l, 2.0 * l.floor, &from, &to);
    if (to > from && l.floor < quiet * loudest) {
        found = mean(x, from, to);
        *error = l.floor / sqrt((double)(to - from));
    }
    arena_close(a);
    return found;
}

static double offset_of(const double *x, long n, double rate, double *error)
{
    double found = quiet_mean(x, n, rate, error), middle, all;
    if (!isnan(found)) return found;
    middle = median(x, n);
    all = mean(x, 0, n);
    *error = 0.0;
    return middle * all <= 0.0 ? 0.0 : fabs(middle) < fabs(all) ? middle : all;
}

/* Does x[n] stand at its extreme of that sign in a row, and leave it at once on both sides? */
static bool stands(const double *x, long n, double extreme, double step)
{
    for (long i = 1, row = 0; i < n; i++) {
        row = x[i] == extreme ? row + 1 : 0;
        if (row >= ROW && i + 1 < n && x[i + 1] != extreme && i > row && fabs(x[i + 1] - extreme) > STEPS * step &&
            fabs(x[i - row] - extreme) > STEPS * step)
            return true;
    }
    return false;
}

void strikes_channel_clip(const double *x, long n, double clip[2])
{
    double least = 0.0, most = 0.0, step = INFINITY;
    for (long i = 0; i < n; i++) {
        least = fmin(least, x[i]);
        most = fmax(most, x[i]);
        if (i && x[i] != x[i - 1]) step = fmin(step, fabs(x[i] - x[i - 1]));
    }
    clip[0] = least < 0.0 && stands(x, n, least, step) ? least : 0.0;
    clip[1] = most > 0.0 && stands(x, n, most, step) ? most : 0.0;
}

/* The channel without its offset, if that is considerable. */
static const double *level_out(const double *x, const struct strikes_recording *r, double *offset, struct arena *a)
{
    long n = r->n;
    double most = 0.0, error = 0.0, middle = offset_of(x, n, r->rate, &error);
    for (long i = 0; i < n; i++)
        most = fmax(most, fabs(x[i] - middle));
    if (!(fabs(middle) > fmax(considerable * most, 4.0 * error)) || most == 0.0) return x;
    double *to = ARENA_TAKE(a, double, n);
    for (long i = 0; i < n; i++)
        to[i] = x[i] - middle;
    *offset = middle;
    return to;
}

const char *strikes_channel_prepare(struct strikes_recording *r, struct arena *a)
{
    const char *note = NULL;
    r->sound = level_out(r->sound, r, &r->offset, a);
    strikes_channel_clip(r->sound, r->n, r->clip);
    if (r->force) {
        r->force = level_out(r->force, r, &r->force_offset, a);
        strikes_channel_clip(r->force, r->n, r->force_clip);
    }
    if (r->offset != 0.0)
        note = arena_format(a, "the sound stands beside 0, by %.3g: that offset is taken off", r->offset);
    if (r->force_offset != 0.0)
        note = arena_format(a, "%s%sthe force stands beside 0, by %.3g: that offset is taken off", note ? note : "",
                            note ? "\n" : "", r->force_offset);
    return note;
}
