/* See measure.h. */
#include "batch/measure.h"

#include <limits.h>
#include <math.h>

#include "analysis/distance.h"
#include "file/wav_stream.h"
#include "num/real.h"
#include "output/loudness.h"

enum { PIECE = 4096 }; /* samples */

struct sums {
    double peak, squares;
    struct hash hash;
};

static void add(struct sums *s, const double *x, long n)
{
    for (long i = 0; i < n; i++) {
        double size = fabs(x[i]);
        s->peak = size > s->peak ? size : s->peak;
        s->squares += x[i] * x[i];
    }
    distance_hash_add(&s->hash, x, (size_t)n);
}

static bool pass(struct wav_stream *w, struct sums *s, struct err *e)
{
    double x[PIECE];
    long n, most = PIECE / w->channels;
    do {
        if (!wav_stream_read(w, x, most, &n, e))
            return false;
        add(s, x, n * w->channels);
    } while (n > 0);
    return true;
}

/* BS.1770's gate is absolute: the sound is brought to peak 1 first. */
static bool loud_pass(struct wav_stream *w, double peak, struct loudness *l, struct err *e)
{
    double x[PIECE];
    long n, most = PIECE / w->channels;
    do {
        if (!wav_stream_read(w, x, most, &n, e))
            return false;
        for (long i = 0; i < n * w->channels; i++)
            x[i] /= peak;
        loudness_add(l, x, (size_t)n);
    } while (n > 0);
    return true;
}

static bool find_loudness(const char *path, struct measure *m, struct err *e)
{
    struct wav_stream w;
    double lufs;
    struct loudness *l = loudness_open(m->channels, m->rate);
    if (!l)
        return err_set(e, ERR_MEMORY, "the loudness meter cannot be set up at %g Hz", m->rate);
    bool ok = wav_stream_open(&w, path, e);
    w.frames = w.frames < m->frames ? w.frames : m->frames;
    ok = ok && loud_pass(&w, m->peak, l, e);
    if (ok && loudness_read(l, &lufs))
        m->lufs = lufs + 20 * real_log10(m->peak);
    wav_stream_close(&w);
    loudness_close(l);
    return ok;
}

bool measure_part(const char *path, long frames, bool loud, struct measure *m, struct err *e)
{
    struct wav_stream w;
    if (!wav_stream_open(&w, path, e))
        return false;
    if (w.channels > PIECE) {
        wav_stream_close(&w);
        return err_set(e, ERR_SCENE, "%s: has %d channels", path, w.channels);
    }
    w.frames = w.frames < frames ? w.frames : frames;
    struct sums s = {.hash = hash_start()};
    *m = (struct measure){.rate = w.rate, .channels = w.channels, .frames = w.frames, .lufs = NAN};
    distance_hash_add(&s.hash, (const double[2]){w.rate, w.channels}, 2);
    bool ok = pass(&w, &s, e);
    wav_stream_close(&w);
    hash_end(&s.hash, m->audio);
    m->peak = s.peak;
    m->rms = sqrt(s.squares / fmax(1, (double)m->frames * m->channels));
    return ok && (!loud || m->peak == 0 || find_loudness(path, m, e));
}

bool measure_file(const char *path, bool loud, struct measure *m, struct err *e)
{
    return measure_part(path, LONG_MAX, loud, m, e);
}
