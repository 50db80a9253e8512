/* A recording is copied sample by sample, in the encoding of the set, times a gain:

     level common or each, by peak, rms or lufs    brought to that level by itself: a recording has no quantity that a
   common gain could scale, and its own gain says nothing level full_scale or dbfs_at_1_pa, level scene its samples as
   they are, gain 1

   (a silent one has no level, which is a warning, as it is of a render)

   and cut to the set's length under the set's ramp, or continued by silence. Its level is that of the
   whole file then, as a render's is. It must have the set's sample rate and channels: converting is left to programs
   made for it. */
#include "batch/recording.h"

#include <math.h>
#include <string.h>

#include "analysis/distance.h"
#include "num/real.h"
#include "output/loudness.h"
#include "output/sound.h"
#include "scene/keys_yaml.h"

enum { PIECE = MEASURE_CHANNELS /* samples */, BEHIND = 32 /* frames: the meter of true peaks is 6 to 12 late */ };

/* ------------------------------------------------------------------ reading */

bool recording_open(struct measure_source *c, const char *path, const struct measure_form *form, struct err *e)
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

static bool read_cut(struct measure_source *c, double *x, long most, long *n, struct err *e)
{
    long some = c->frames - c->done < most ? c->frames - c->done : most, got;
    *n = some;
    memset(x, 0, sizeof *x * (size_t)some * (size_t)c->in.channels);
    if (!wav_stream_read(&c->in, x, some, &got, e)) return false;
    long last = c->ramp > 1 ? c->ramp : 1;
    for (long i = 0; i < some; i++) { /* the ramp, and what is cut off by it */
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
    c->done += some;
    return true;
}

bool recording_copy(struct measure_source *c, struct wav_out *out, double gain, struct err *e)
{
    double x[PIECE];
    long n, most = PIECE / c->in.channels;
    do {
        if (!read_cut(c, x, most, &n, e)) return false;
        for (long i = 0; i < n * c->in.channels; i++)
            x[i] *= gain;
        if (n > 0 && !wav_write(out, x, (size_t)n, e)) return false;
    } while (n > 0);
    return true;
}

/* ------------------------------------------------------------------ measuring */

static bool find_loudness(const char *path, const struct measure_form *form, struct measure *m, struct err *e)
{
    struct measure_source c;
    double x[PIECE], lufs, silence[PIECE] = {0};
    struct loudness *l = loudness_open(m->channels, m->rate, true);
    if (!l) return err_set(e, ERR_MEMORY, "the loudness meter cannot be set up at %g Hz", m->rate);
    bool ok = recording_open(&c, path, form, e);
    for (long n = 1; ok && n > 0;) {
        ok = read_cut(&c, x, PIECE / c.in.channels, &n, e);
        for (long i = 0; ok && i < n * c.in.channels; i++)
            x[i] /= m->peak; /* BS.1770's gate is absolute: the sound is brought to peak 1 first */
        if (ok && n > 0) loudness_add(l, x, (size_t)n);
    }
    if (ok && loudness_read(l, &lufs)) m->lufs = lufs + 20 * real_log10(m->peak);
    for (int i = 0; ok && i < BEHIND; i++)
        loudness_add(l, silence, 1);
    m->true_peak = ok ? fmax(1, loudness_true_peak(l)) * m->peak : NAN; /* of a sound brought to peak 1 */
    wav_stream_close(&c.in);
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
        ok = read_cut(c, x, PIECE / m->channels, &n, e);
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

bool recording_measure(const char *path, const struct measure_form *form, bool loud, struct measure *m, struct err *e)
{
    struct measure_source c;
    bool ok = recording_open(&c, path, form, e);
    if (ok && c.in.channels > PIECE) ok = err_set(e, ERR_SCENE, "%s: has %d channels", path, c.in.channels);
    ok = ok && find_rest(&c, m, e);
    wav_stream_close(&c.in);
    return ok && (!loud || m->peak == 0 || find_loudness(path, form, m, e));
}

/* ------------------------------------------------------------------ as a stimulus */

bool recording_check(const char *file, double *rate, int *channels, double *seconds, struct err *e)
{
    struct wav_stream w;
    if (!wav_stream_open(&w, file, e)) return false;
    wav_stream_close(&w);
    if (*rate == 0) {
        *rate = w.rate;
        *channels = w.channels;
    }
    *seconds = (double)w.frames / w.rate;
    if (w.frames < 1 || w.channels > MEASURE_CHANNELS)
        return err_set(e, ERR_SCENE, "%s: has no samples, or too many channels", file);
    if (w.rate == *rate && w.channels == *channels) return true;
    return err_set(e, ERR_SCENE,
                   "%s: has %d channel%s at %g Hz, the set has %d at %g Hz: convert it first, as in: sox %s -r %g -c "
                   "%d converted.wav",
                   file, w.channels, w.channels == 1 ? "" : "s", w.rate, *channels, *rate, file, *rate, *channels);
}

static struct measure_form form_of(const struct set *s) { return (struct measure_form){s->length, s->ramp}; }

/* What the level asks of a recording that holds this. */
static bool find_gain(const struct set *set, const char *file, const struct measure *m, double *gain, struct err *e)
{
    const struct level *l = &set->level;
    *gain = 1;
    if (set->level_rule == DESIGN_LEVEL_SCENE || !isnan(l->full_scale) || !isnan(l->dbfs_at_1_pa)) return true;
    if (m->peak == 0) return true; /* warned of, as it is of a render */
    if (!isnan(l->rms))
        *gain = real_exp10(l->rms / 20) / m->rms;
    else if (isnan(l->lufs))
        *gain = fmin(real_exp10(l->peak / 20), set_largest(set->encoding)) / m->peak;
    else if (isnan(m->lufs))
        return err_set(e, ERR_SCENE,
                       "%s: its loudness cannot be measured: BS.1770 needs 0.4 s that are not nearly silent, and its "
                       "file in the set has %.3g s: give the level as peak or rms, or leave it out",
                       file, (double)m->frames / m->rate);
    else
        *gain = real_exp10((l->lufs - m->lufs) / 20);
    return true;
}

bool recording_check_level(const char *file, const struct set *s, struct err *e)
{
    struct measure m;
    double gain;
    struct measure_form form = form_of(s);
    return isnan(s->level.lufs) || (recording_measure(file, &form, true, &m, e) && find_gain(s, file, &m, &gain, e));
}

/* A cut where the sound is less than 80 dB below its peak is reported, as it is of a render. */
static const char **warnings_of(const struct measure *m, const struct wav_written *w, struct arena *a)
{
    const char **all = ARENA_TAKE(a, const char *, 4);
    int n = 0;
    if (m->peak == 0)
        all[n++] = "the recording is silent: no level was set";
    else if (!wav_written_audible(w))
        all[n++] = "the recording is silent in the set's encoding: every sample is 0";
    if (w->beyond > 0)
        all[n++] = arena_format(a,
                                "the recording: %.0f of %.0f samples lie beyond full scale, by up to %.2f dB: floating "
                                "point holds them, but whatever plays them, or makes integers of them, clips",
                                w->beyond, w->frames * w->channels, 20 * real_log10(w->peak));
    if (m->frames < m->own && m->end > 1e-4 * m->before)
        all[n++] = arena_format(
            a, "length: the recording is cut at %.4g s of %.4g s, where it is %.1f dB below its peak before the ramp",
            (double)m->frames / m->rate, (double)m->own / m->rate,
            fmax(0, -20 * real_log10(m->end / m->before)) + 0.0); /* not -0 */
    return all;
}

/* Its own samples, times the gain, with its warnings. */
struct wav_out *recording_make(const struct set *set, const char *file, const char *path, struct record *r,
                               struct arena *a, struct err *e)
{
    struct measure m;
    struct measure_form form = form_of(set);
    if (!recording_measure(file, &form, !isnan(set->level.lufs), &m, e) || !find_gain(set, file, &m, &r->gain, e))
        return NULL;
    r->peak = m.peak, r->rms = m.rms, r->lufs = m.lufs;
    r->encoding = set->encoding;
    r->channels = m.channels;
    char comment[80];
    struct measure_source c;
    if (!recording_open(&c, file, &form, e)) return NULL;
    snprintf(comment, sizeof comment, "rasp: recording, gain %.9g (%.4f dB)", r->gain, 20 * real_log10(r->gain));
    struct wav_format f = {
        .rate = c.in.rate, .channels = c.in.channels, .bits = sound_bits(set->encoding), .comment = comment};
    struct wav_out *out = wav_create(path, &f, e);
    bool ok = out && recording_copy(&c, out, r->gain, e) && wav_finish(out, e);
    wav_stream_close(&c.in);
    r->frames = c.frames;
    r->rate = c.in.rate;
    r->ramp = c.ramp > 0 ? (double)c.ramp / c.in.rate : 0;
    if (ok) {
        struct wav_written w = wav_written(out);
        r->warnings = warnings_of(&m, &w, a);
        r->beyond = w.beyond;
        return out;
    }
    wav_drop(out);
    return NULL;
}

const char *recording_key(const struct set *s, const char *sha256, struct arena *a)
{
    const char *const texts[] = {"rasp set 2",
                                 "recording",
                                 s->program,
                                 sha256,
                                 set_level_text(s, a),
                                 isnan(s->length) ? "" : keys_yaml_number(s->length, a),
                                 keys_yaml_number(s->rate, a),
                                 arena_format(a, "%d", s->encoding),
                                 keys_yaml_number(s->ramp, a)};
    return set_hash(texts, sizeof texts / sizeof *texts, a);
}
