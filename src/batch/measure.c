/* See measure.h. */
#include "batch/measure.h"

#include <math.h>
#include <string.h>

#include "analysis/distance.h"
#include "num/real.h"
#include "output/loudness.h"

enum { PIECE = MEASURE_CHANNELS /* samples */, BEHIND = 32 /* frames: the meter of true peaks is 6 to 12 late */ };

/* ------------------------------------------------------------------ reading */

bool measure_open(struct measure_source *c, const char *path, const struct measure_form *form, struct err *e)
{
    *c = (struct measure_source){.frames = 0};
    if (!wav_stream_open(&c->in, path, e)) return false;
    c->own = c->frames = c->in.frames;
    if (!form || isnan(form->seconds)) return true;
    c->frames = (long)rint(form->seconds * c->in.rate);
    c->ramp = c->frames < c->own ? (long)rint(form->ramp * c->in.rate) : 0;
    c->ramp = c->ramp < c->frames / 2 ? c->ramp : c->frames / 2;
    return true;
}

static void shape(struct measure_source *c, double *x, long n)
{
    long last = c->ramp > 1 ? c->ramp : 1;
    for (long i = 0; i < n; i++) {
        long rest = c->frames - 1 - (c->done + i);
        double *frame = x + i * c->in.channels, size = 0;
        for (int k = 0; k < c->in.channels; k++)
            size = fmax(size, fabs(frame[k]));
        c->before = fmax(c->before, size);
        c->end = rest < last ? fmax(c->end, size) : c->end;
        double s = rest < c->ramp ? real_sinpi(0.5 * ((double)rest + 0.5) / (double)c->ramp) : 1;
        for (int k = 0; k < c->in.channels && rest < c->ramp; k++)
            frame[k] *= s * s;
    }
}

bool measure_read(struct measure_source *c, double *x, long most, long *n, struct err *e)
{
    long some = c->frames - c->done < most ? c->frames - c->done : most, got;
    *n = some;
    memset(x, 0, sizeof *x * (size_t)some * (size_t)c->in.channels);
    if (!wav_stream_read(&c->in, x, some, &got, e)) return false;
    shape(c, x, some);
    c->done += some;
    return true;
}

bool measure_copy(struct measure_source *c, struct wav_out *out, double gain, struct err *e)
{
    double x[PIECE];
    long n, most = PIECE / c->in.channels;
    do {
        if (!measure_read(c, x, most, &n, e)) return false;
        for (long i = 0; i < n * c->in.channels; i++)
            x[i] *= gain;
        if (n > 0 && !wav_write(out, x, (size_t)n, e)) return false;
    } while (n > 0);
    return true;
}

void measure_close(struct measure_source *c) { wav_stream_close(&c->in); }

/* ------------------------------------------------------------------ measuring */

static bool find_loudness(const char *path, const struct measure_form *form, struct measure *m, struct err *e)
{
    struct measure_source c;
    double x[PIECE], lufs, silence[PIECE] = {0};
    struct loudness *l = loudness_open(m->channels, m->rate, true);
    if (!l) return err_set(e, ERR_MEMORY, "the loudness meter cannot be set up at %g Hz", m->rate);
    bool ok = measure_open(&c, path, form, e);
    for (long n = 1; ok && n > 0;) {
        ok = measure_read(&c, x, PIECE / c.in.channels, &n, e);
        for (long i = 0; ok && i < n * c.in.channels; i++)
            x[i] /= m->peak; /* BS.1770's gate is absolute: the sound is brought to peak 1 first */
        if (ok && n > 0) loudness_add(l, x, (size_t)n);
    }
    if (ok && loudness_read(l, &lufs)) m->lufs = lufs + 20 * real_log10(m->peak);
    for (int i = 0; ok && i < BEHIND; i++)
        loudness_add(l, silence, 1);
    m->true_peak = ok ? fmax(1, loudness_true_peak(l)) * m->peak : NAN; /* of a sound brought to peak 1 */
    measure_close(&c);
    loudness_close(l);
    return ok;
}

static bool find_rest(struct measure_source *c, struct measure *m, struct err *e)
{
    struct hash hash = hash_start();
    double x[PIECE], squares = 0;
    bool ok = true;
    *m = (struct measure){.rate = c->in.rate,
                          .channels = c->in.channels,
                          .frames = c->frames,
                          .own = c->own,
                          .lufs = NAN,
                          .true_peak = NAN};
    distance_hash_add(&hash, (const double[2]){m->rate, m->channels}, 2);
    for (long n = 1; ok && n > 0;) {
        ok = measure_read(c, x, PIECE / m->channels, &n, e);
        for (long i = 0; ok && i < n * m->channels; i++) {
            m->peak = fmax(m->peak, fabs(x[i]));
            squares += x[i] * x[i];
        }
        if (ok && n > 0) distance_hash_add(&hash, x, (size_t)(n * m->channels));
    }
    hash_end(&hash, m->audio);
    m->end = c->end;
    m->before = c->before;
    m->rms = sqrt(squares / fmax(1, (double)m->frames * m->channels));
    return ok;
}

bool measure_cut(const char *path, const struct measure_form *form, bool loud, struct measure *m, struct err *e)
{
    struct measure_source c;
    bool ok = measure_open(&c, path, form, e);
    if (ok && c.in.channels > PIECE) ok = err_set(e, ERR_SCENE, "%s: has %d channels", path, c.in.channels);
    ok = ok && find_rest(&c, m, e);
    measure_close(&c);
    return ok && (!loud || m->peak == 0 || find_loudness(path, form, m, e));
}
