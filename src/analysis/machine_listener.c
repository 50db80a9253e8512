/* See machine_listener.h. The papers have no such listener: this one is ours. Frames do not overlap; a frame's level is
   that of its mean square, floor 40 dB below the loudest; its centroid that of its power spectrum under Hann's window,
   and below the floor, where it is inaudible, the mean. Both are smoothed over five frames, so that what noise does by
   itself counts less. Each track less its mean, over its deviation, is what is compared: a sound's level and colour as
   such do not count. To the deviation is added, in squares, 1 dB and a quarter of an octave: what hardly changes is not
   blown up to noise. Of sounds of different length the shorter goes on at the floor. That is for motions.

   The material of a struck object is in how fast it fades and how bright it is as such: the slope of the level (least
   squares, from the loudest frame to the last that is audible, at least 1 dB/s) and the mean of the centroid's
   logarithm, weighted by power. */
#include "analysis/machine_listener.h"

#include <math.h>
#include <stdlib.h>

#include "num/fft.h"
#include "num/real.h"

#define FRAME 0.025
#define LOWEST (-40.0)

static const double hardly[2] = {1, 0.25};
const char *const machine_listener_cues[] = {"motion", "material", NULL};

/* Mean square, and centroid in Hz, of count samples of every channel from `first` on. */
static double frame_of(const struct wav *w, size_t first, int count, struct fft *f, int padded, double *work,
                       double *centroid)
{
    double square = 0, power = 0, moment = 0, *re = work + padded, *im = re + padded / 2 + 1;
    for (int c = 0; c < w->channels; c++) {
        for (int i = 0; i < padded; i++) {
            double x = i < count ? w->x[(first + (size_t)i) * (size_t)w->channels + (size_t)c] : 0;
            double s = real_sinpi((i + 0.5) / count);
            square += x * x / count;
            work[i] = x * s * s;
        }
        fft_forward(f, work, re, im);
        for (int k = 1; k <= padded / 2; k++) {
            power += re[k] * re[k] + im[k] * im[k];
            moment += (re[k] * re[k] + im[k] * im[k]) * k;
        }
    }
    *centroid = power > 0 ? moment / power * w->rate / padded : 0;
    return square;
}

/* x[n], NAN where nothing is audible, smoothed by weights 1 2 3 2 1 into y; its mean and deviation. */
static void normalise(const double *x, int n, double least_change, double *y, double *mean, double *deviation)
{
    double sum = 0, square = 0;
    *mean = 0;
    int audible = 0;
    for (int i = 0; i < n; i++)
        if (!isnan(x[i])) {
            *mean += x[i];
            audible++;
        }
    *mean /= audible;
    for (int i = 0; i < n; i++) {
        double weights = 0;
        y[i] = 0;
        for (int k = -2; k <= 2; k++)
            if (i + k >= 0 && i + k < n) {
                weights += 3 - abs(k);
                y[i] += (3 - abs(k)) * (isnan(x[i + k]) ? *mean : x[i + k]);
            }
        y[i] /= weights;
        sum += y[i];
    }
    *mean = sum / n;
    for (int i = 0; i < n; i++)
        square += (y[i] - *mean) * (y[i] - *mean);
    *deviation = sqrt(square / n + least_change * least_change);
}

/* log2 of the slope of level[n] (dB, frames), falling, in dB/s. */
static double fade_of(const double *level, int n)
{
    double slope = 0, spread = 0;
    for (int i = 0; i < n; i++) {
        slope -= (i - (n - 1) / 2.0) * level[i];
        spread += (i - (n - 1) / 2.0) * (i - (n - 1) / 2.0);
    }
    slope = n > 1 ? slope / spread : -LOWEST;
    return real_log(fmax(1, slope / FRAME)) / real_log(2);
}

/* Mean of centroid[n] (log2, NAN where nothing is audible), weighted by the power of level[n] (dB). */
static double colour_of(const double *level, const double *centroid, int n)
{
    double sum = 0, power = 0;
    for (int i = 0; i < n; i++)
        if (!isnan(centroid[i])) {
            double p = real_exp(level[i] * real_log(10) / 10);
            sum += p * centroid[i];
            power += p;
        }
    return sum / power;
}

bool machine_listener_hear(const char *path, const struct wav *w, struct arena *a, struct machine_listener_sound *s,
                           struct err *e)
{
    int count = (int)rint(FRAME * w->rate), first = 0, last = -1, peak = 0,
        n = (int)(w->frames / (size_t)(count + !count));
    double *level = ARENA_TAKE(a, double, n + 1), *centroid = ARENA_TAKE(a, double, n + 1);
    if (count < 8) return err_set(e, ERR_SCENE, "%s: a rate of %g Hz is no sound's", path, w->rate);
    int padded = (int)fft_good_size((size_t)count);
    double *work = ARENA_TAKE(a, double, 2 * padded + 2);
    struct fft *f = fft_open((size_t)padded);
    for (int i = 0; i < n; i++) {
        level[i] = frame_of(w, (size_t)i * (size_t)count, count, f, padded, work, &centroid[i]);
        if (level[i] > level[peak]) peak = i;
    }
    fft_close(f);
    double loudest = level[peak];
    for (int i = n - 1; i >= 0; i--) {
        level[i] = level[i] > 0 ? fmax(LOWEST, 10 * real_log10(level[i] / loudest)) : LOWEST;
        bool audible = level[i] > LOWEST && centroid[i] > 0;
        centroid[i] = audible ? real_log(centroid[i]) / real_log(2) : (double)NAN;
        if (audible) first = i;
        if (audible && last < 0) last = i;
    }
    if (last < 0) return err_set(e, ERR_SCENE, "%s: is silent, or shorter than 25 ms: nothing of it is audible", path);
    *s = (struct machine_listener_sound){.n = last + 1 - first,
                                         .fade = fade_of(level + peak, last + 1 - peak),
                                         .colour = colour_of(level + first, centroid + first, last + 1 - first)};
    for (int t = 0; t < 2; t++) {
        double *y = ARENA_TAKE(a, double, s->n);
        normalise((t ? centroid : level) + first, s->n, hardly[t], y, &s->mean[t], &s->deviation[t]);
        s->track[t] = y;
    }
    return true;
}

static double feature(const struct machine_listener_sound *s, int t, int i)
{
    double x = i < s->n ? s->track[t][i] : t ? s->mean[t] : LOWEST;
    return (x - s->mean[t]) / s->deviation[t];
}

double machine_listener_distance(const struct machine_listener_sound *a, const struct machine_listener_sound *b)
{
    double fade = a->fade - b->fade, colour = a->colour - b->colour;
    if (a->cue == MACHINE_LISTENER_MATERIAL) return fade * fade + colour * colour;
    int n = a->n > b->n ? a->n : b->n;
    double sum = 0;
    for (int i = 0; i < n; i++)
        for (int t = 0; t < 2; t++) {
            double off = feature(a, t, i) - feature(b, t, i);
            sum += off * off / (2 * n);
        }
    return sum;
}

void machine_listener_choose(const struct machine_listener_sound *s, const struct machine_listener_sound *templates,
                             int n, int skip, int classes, double spread, double *share)
{
    double least = HUGE_VAL, sum = 0;
    for (int c = 0; c < classes; c++) {
        share[c] = HUGE_VAL;
        for (int i = 0; i < n; i++)
            if (i != skip && templates[i].class == c)
                share[c] = fmin(share[c], machine_listener_distance(s, &templates[i]));
        least = fmin(least, share[c]);
    }
    for (int c = 0; c < classes; c++)
        sum += share[c] = real_exp((least - share[c]) / (2 * spread));
    for (int c = 0; c < classes; c++)
        share[c] /= sum;
}

double machine_listener_spread(const struct machine_listener_sound *templates, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) {
        double least = HUGE_VAL;
        for (int j = 0; j < n; j++)
            if (j != i && templates[j].class == templates[i].class)
                least = fmin(least, machine_listener_distance(&templates[i], &templates[j]));
        sum += least / n;
    }
    return isfinite(sum) ? sum : (double)NAN;
}
