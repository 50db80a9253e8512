/* A recording is copied sample by sample, in the encoding of the set, times a gain:

     level common or each, by peak, rms or lufs    brought to that level by itself: a recording has no quantity that a
   common gain could scale, and its own gain says nothing level full_scale or dbfs_at_1_pa, level scene its samples as
   they are, gain 1

   (a silent one has no level, which is a warning, as it is of a render)

   and cut to the set's length under the set's ramp, or continued by silence (batch/measure.c). Its level is that of the
   whole file then, as a render's is. It must have the set's sample rate and channels: converting is left to programs
   made for it. */
#include "batch/recording.h"

#include <math.h>

#include "batch/measure.h"
#include "num/real.h"
#include "scene/keys_yaml.h"

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
    return isnan(s->level.lufs) || (measure_cut(file, &form, true, &m, e) && find_gain(s, file, &m, &gain, e));
}

/* A cut where the sound is less than 80 dB below its peak is told, as it is of a render. */
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
            (double)m->frames / m->rate, (double)m->own / m->rate, fmax(0, -20 * real_log10(m->end / m->before)));
    return all;
}

int recording_bits(int encoding)
{
    static const int bits[] = {
        [ENCODING_PCM16] = 16, [ENCODING_PCM24] = 24, [ENCODING_FLOAT32] = -32, [ENCODING_FLOAT64] = -64};
    return bits[encoding];
}

/* Its own samples, times the gain, with its warnings. */
static struct wav_out *copy(const struct set *set, const char *file, const char *path, const struct measure *m,
                            struct record *r, struct arena *a, struct err *e)
{
    char comment[80];
    struct measure_source c;
    struct measure_form form = form_of(set);
    if (!measure_open(&c, file, &form, e)) return NULL;
    snprintf(comment, sizeof comment, "rasp: recording, gain %.9g (%.4f dB)", r->gain, 20 * real_log10(r->gain));
    struct wav_format f = {
        .rate = c.in.rate, .channels = c.in.channels, .bits = recording_bits(set->encoding), .comment = comment};
    struct wav_out *out = wav_create(path, &f, e);
    bool ok = out && measure_copy(&c, out, r->gain, e) && wav_finish(out, e);
    measure_close(&c);
    r->frames = c.frames;
    r->rate = c.in.rate;
    r->ramp = c.ramp > 0 ? (double)c.ramp / c.in.rate : 0;
    if (ok) {
        struct wav_written w = wav_written(out);
        r->warnings = warnings_of(m, &w, a);
        r->beyond = w.beyond;
        return out;
    }
    if (out) wav_drop(out);
    return NULL;
}

struct wav_out *recording_make(const struct set *set, const char *file, const char *path, struct record *r,
                               struct arena *a, struct err *e)
{
    struct measure m;
    struct measure_form form = form_of(set);
    if (!measure_cut(file, &form, !isnan(set->level.lufs), &m, e) || !find_gain(set, file, &m, &r->gain, e))
        return NULL;
    r->peak = m.peak, r->rms = m.rms, r->lufs = m.lufs;
    r->encoding = set->encoding;
    r->channels = m.channels;
    return copy(set, file, path, &m, r, a, e);
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
