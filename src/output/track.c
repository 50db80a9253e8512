/* Ramps are raised cosines over both ends of the whole, sin^2(pi/2 (n + 1/2) / N), all channels alike.

   The envelope is that of a source that passes at constant speed: its pressure goes with 1 over its distance, which is
   least in the middle of the whole,

     gain = 1 / sqrt(1 + c^2 u^2),   u = (2 n + 1) / N - 1 from -1 to 1, N frames

   so that a c of sqrt(10^(depth/10) - 1) puts both ends `depth` dB below the middle. papers/002 III-B says that an
   amplitude envelope made its sounds approach and recede, and prints no law; this one is ours. No Doppler shift and no
   direction go with it. */
#include "output/track.h"

#include <errno.h>
#include <math.h>
#include <string.h>

#include "base/outfile.h"
#include "num/lanes.h"
#include "num/real.h"
#include "num/scaled.h"

bool track_open(struct track *t, const char *path, const struct track_format *f, double gain, struct arena *a,
                struct err *e)
{
    struct wav_format w = {.rate = f->rate, .channels = f->channels, .bits = f->bits, .title = f->title};
    *t = (struct track){.format = *f,
                        .gain = gain,
                        .peak = ARENA_TAKE(a, double, f->places),
                        .squares = ARENA_TAKE(a, double, f->places *LANES)};
    if (!(t->wav = wav_create(path, &w, e))) return false;
    t->wide = ARENA_TAKE(a, double, TRACK_CHUNK * f->channels);
    if (!f->waits || (t->spool = outfile_scratch_open())) return true;
    err_set(e, err_system(ERR_CREATE),
            "no temporary file can be made for the samples in %s: %s (set TMPDIR to a folder with space)",
            outfile_scratch_folder(), strerror(errno));
    track_drop(t);
    return false;
}

bool track_note(struct track *t, const char *text, struct err *e) { return wav_comment(t->wav, text, e); }

static void ramp(const struct track *t, double *x, long n)
{
    long last = t->format.frames - t->format.ramp;
    if (t->done >= t->format.ramp && t->done + n <= last) return;
    for (long i = 0; i < n; i++) {
        long at = t->done + i, rest = t->format.frames - 1 - at, edge = at < rest ? at : rest;
        if (edge >= t->format.ramp) continue;
        double s = real_sinpi(0.5 * ((double)edge + 0.5) / (double)t->format.ramp);
        for (int k = 0; k < t->format.places; k++)
            x[i * t->format.places + k] *= s * s;
    }
}

/* Of a frame, from the first of the block. */
static double receded(const struct track *t, long i)
{
    double u = t->format.recede * ((double)(2 * (t->done + i) + 1) / (double)t->format.frames - 1);
    return 1 / sqrt(1 + u * u);
}

/* Greatest magnitude of frames [from, to) of the whole, those of this block, with the envelope and without the ramps.
 */
static double greatest(const struct track *t, const double *x, long n, const long range[2])
{
    double most = 0;
    long from = range[0] - t->done, to = range[1] - t->done;
    for (long i = from > 0 ? from : 0; i < n && i < to; i++)
        for (int k = 0; k < t->format.places; k++)
            most = fmax(most, fabs(x[i * t->format.places + k]) * (t->format.recede > 0 ? receded(t, i) : 1));
    return most;
}

/* Of one channel, from a frame on whose number is a multiple of LANES: a quarter of the time of the plain loop below.
 */
LANES_CLONES
static void measure_mono(const double *x, long n, double *restrict peak, double *restrict squares)
{
    double most[LANES] = {0}, sum[LANES];
    memcpy(sum, squares, sizeof sum);
    for (long i = 0; i + LANES <= n; i += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double v = x[i + l], size = fabs(v);
            most[l] = lanes_select(size > most[l], size, most[l]);
            sum[l] += v * v;
        }
    memcpy(squares, sum, sizeof sum);
    for (int l = 0; l < LANES; l++)
        *peak = most[l] > *peak ? most[l] : *peak;
}

double track_squares(const struct track *t, int place)
{
    double sum = 0;
    for (int l = 0; l < LANES; l++)
        sum += t->squares[place * LANES + l];
    return sum;
}

static bool put(struct track *t, const double *x, long n, struct err *e)
{
    int places = t->format.places, channels = t->format.channels, copies = channels / places;
    for (long i = 0; i < n; i += TRACK_CHUNK) {
        long some = n - i < TRACK_CHUNK ? n - i : TRACK_CHUNK;
        if (copies == 1) scaled_copy(t->wide, t->gain, x + i * places, some * channels);
        for (long k = 0; copies > 1 && k < some * channels; k++)
            t->wide[k] = t->gain * x[i * places + k / copies];
        if (!wav_write(t->wav, t->wide, (size_t)some, e))
            return e->kind == ERR_SCENE ? err_at(e, "%s", t->format.key) : false;
    }
    return true;
}

bool track_add(struct track *t, double *x, long n, struct err *e)
{
    int places = t->format.places;
    size_t samples = (size_t)(n * places);
    long end = t->format.ramp > 1 ? t->format.ramp : 1, frames = t->format.frames; /* what the ramps take away */
    t->end = fmax(t->end, greatest(t, x, n, (const long[2]){frames - end, frames}));
    t->begin = fmax(t->begin, greatest(t, x, n, (const long[2]){0, end}));
    ramp(t, x, n);
    for (long i = 0; i < n && t->format.recede > 0; i++) {
        double gain = receded(t, i);
        for (int k = 0; k < places; k++)
            x[i * places + k] *= gain;
    }
    /* The square of frame n is added to sum n mod LANES: nothing depends on how the sound is cut into blocks. */
    long done = places == 1 && t->done % LANES == 0 ? n / LANES * LANES : 0;
    if (done) measure_mono(x, done, t->peak, t->squares);
    for (long i = done; i < n; i++)
        for (int k = 0; k < places; k++) {
            double v = x[i * places + k], size = fabs(v);
            t->peak[k] = size > t->peak[k] ? size : t->peak[k];
            t->squares[k * LANES + (t->done + i) % LANES] += v * v;
        }
    t->done += n;
    if (!t->spool) return put(t, x, n, e);
    if (fwrite(x, sizeof *x, samples, t->spool) != samples)
        return err_set(e, err_system(ERR_IO),
                       "samples cannot be kept in a temporary file in %s: %s (set TMPDIR to a folder with space)",
                       outfile_scratch_folder(), strerror(errno));
    return true;
}

void track_rewind(struct track *t) { rewind(t->spool); }

long track_read(struct track *t, double *x)
{
    size_t places = (size_t)t->format.places;
    return (long)(fread(x, sizeof *x, TRACK_CHUNK / places * places, t->spool) / places);
}

bool track_finish(struct track *t, double gain, struct err *e)
{
    double x[TRACK_CHUNK];
    long n;
    t->gain = gain;
    track_rewind(t);
    while ((n = track_read(t, x)) > 0)
        if (!put(t, x, n, e)) return false;
    return ferror(t->spool) ? err_set(e, ERR_IO, "samples cannot be read back from the temporary file") : true;
}

struct wav_written *track_written(const struct track *t, struct arena *a)
{
    struct wav_written *w = ARENA_TAKE(a, struct wav_written, 1);
    *w = wav_written(t->wav);
    bool *audible = ARENA_TAKE(a, bool, w->channels);
    memcpy(audible, w->audible, (size_t)w->channels * sizeof *audible);
    w->audible = audible;
    return w;
}

static void forget(struct track *t)
{
    if (t->spool) fclose(t->spool);
    t->spool = NULL;
}

bool track_finalise(struct track *t, struct err *e)
{
    forget(t);
    return wav_finish(t->wav, e);
}

bool track_commit(struct track *t, struct err *e)
{
    struct wav_out *w = t->wav;
    forget(t);
    t->wav = NULL;
    return wav_commit(w, e);
}

void track_drop(struct track *t)
{
    forget(t);
    wav_drop(t->wav);
    t->wav = NULL;
}
