/* A recording is copied sample by sample, in the encoding of the set, times a gain:

     level common or each, by peak, rms or lufs    brought to that level by itself: a recording has no quantity that a common gain could scale, and its own gain says nothing
     level full_scale or dbfs_at_1_pa, level scene its samples as they are, gain 1

   (a silent one has no level, which is a warning, as it is of a render)

   and cut to the set's length under the set's ramp, or continued by silence (batch/cut.c). Its level is that of the whole file then, as a render's is. It must have
   the set's sample rate and channels: converting is left to programs made for it. */
#include "batch/recording.h"

#include <math.h>

#include "base/stopwatch.h"
#include "base/watch.h"
#include "batch/folder.h"
#include "batch/measure.h"
#include "file/wav.h"
#include "num/real.h"
#include "scene/keys_yaml.h"

enum { PIECE = 4096 };

bool recording_check(const char *file, double *rate, int *channels, double *seconds, struct err *e)
{
    struct wav_stream w;
    if (!wav_stream_open(&w, file, e))
        return false;
    wav_stream_close(&w);
    if (*rate == 0) {
        *rate = w.rate;
        *channels = w.channels;
    }
    *seconds = (double)w.frames / w.rate;
    if (w.frames < 1 || w.channels > PIECE)
        return err_set(e, ERR_SCENE, "%s: has no samples, or too many channels", file);
    if (w.rate == *rate && w.channels == *channels)
        return true;
    return err_set(e, ERR_SCENE, "%s: has %d channel%s at %g Hz, the set has %d at %g Hz: convert it first, as in: sox %s -r %g -c %d converted.wav", file, w.channels,
                   w.channels == 1 ? "" : "s", w.rate, *channels, *rate, file, *rate, *channels);
}

static struct cut_form form_of(const struct set *s)
{
    return (struct cut_form){s->length, s->ramp};
}

/* What the level asks of a recording that holds this. */
static bool find_gain(const struct set *set, const char *file, const struct measure *m, double *gain, struct err *e)
{
    const struct level *l = &set->level;
    *gain = 1;
    if (set->level_rule == DESIGN_LEVEL_SCENE || !isnan(l->full_scale) || !isnan(l->dbfs_at_1_pa))
        return true;
    if (m->peak == 0)
        return true; /* told as a remark, as it is of a render */
    if (!isnan(l->rms))
        *gain = real_exp10(l->rms / 20) / m->rms;
    else if (isnan(l->lufs))
        *gain = fmin(real_exp10(l->peak / 20), set->encoding <= ENCODING_PCM24 ? 1 - ldexp(1, set->encoding == ENCODING_PCM16 ? -15 : -23) : 1) / m->peak;
    else if (isnan(m->lufs))
        return err_set(e, ERR_SCENE, "%s: its loudness cannot be measured: BS.1770 needs 0.4 s that are not nearly silent, and its file in the set has %.3g s: give the level as peak or rms, or leave it out", file,
                       (double)m->frames / m->rate);
    else
        *gain = real_exp10((l->lufs - m->lufs) / 20);
    return true;
}

bool recording_check_level(const char *file, const struct set *s, struct err *e)
{
    struct measure m;
    double gain;
    struct cut_form form = form_of(s);
    return isnan(s->level.lufs) || (measure_cut(file, &form, true, &m, e) && find_gain(s, file, &m, &gain, e));
}

static bool copy_all(struct cut *c, struct wav_out *out, double gain, struct err *e)
{
    double x[PIECE];
    long n, most = PIECE / c->in.channels;
    do {
        if (!cut_read(c, x, most, &n, e))
            return false;
        for (long i = 0; i < n * c->in.channels; i++)
            x[i] *= gain;
        if (n > 0 && !wav_write(out, x, (size_t)n, e))
            return false;
    } while (n > 0);
    return true;
}

/* A cut where the sound is less than 80 dB below its peak is told, as it is of a render. */
static const char **remarks_of(const struct measure *m, const struct wav_written *w, struct arena *a)
{
    const char **all = ARENA_TAKE(a, const char *, 4);
    int n = 0;
    if (m->peak == 0)
        all[n++] = "the recording is silent: no level was set";
    else if (!wav_written_heard(w))
        all[n++] = "the recording is silent in the set's encoding: every sample is 0";
    if (w->beyond > 0)
        all[n++] = arena_format(a, "the recording: %.0f of %.0f samples lie beyond full scale, by up to %.2f dB: floating point holds them, but whatever plays them, or makes integers of them, clips",
                                w->beyond, w->frames * w->channels, 20 * real_log10(w->peak));
    if (m->frames < m->own && m->end > 1e-4 * m->before)
        all[n++] = arena_format(a, "length: the recording is cut at %.4g s of %.4g s, where it is %.1f dB below its peak before the ramp", (double)m->frames / m->rate, (double)m->own / m->rate,
                                fmax(0, -20 * real_log10(m->end / m->before)));
    return all;
}

static bool write_it(const struct set *set, const char *file, const char *path, const struct measure *m, struct record *r, struct arena *a, struct err *e)
{
    static const int bits[] = {[ENCODING_PCM16] = 16, [ENCODING_PCM24] = 24, [ENCODING_FLOAT32] = -32, [ENCODING_FLOAT64] = -64};
    char comment[80];
    struct cut c;
    struct cut_form form = form_of(set);
    if (!cut_open(&c, file, &form, e))
        return false;
    snprintf(comment, sizeof comment, "rasp: recording, gain %.9g (%.4f dB)", r->gain, 20 * real_log10(r->gain));
    struct wav_format f = {.rate = c.in.rate, .channels = c.in.channels, .bits = bits[set->encoding], .comment = comment};
    struct wav_out *out = wav_create(path, &f, e);
    bool ok = out && copy_all(&c, out, r->gain, e);
    cut_close(&c);
    r->frames = c.frames;
    r->rate = c.in.rate;
    r->ramp = c.ramp > 0 ? (double)c.ramp / c.in.rate : 0;
    if (ok) {
        struct wav_written w = wav_written(out);
        r->remarks = remarks_of(m, &w, a);
        r->beyond = w.beyond;
        return wav_commit(out, e);
    }
    if (out)
        wav_drop(out);
    return false;
}

/* What its bytes depend on. */
static const char *key_of(const struct job_kit *k, const char *name, const char *sha256, struct arena *a)
{
    const struct set *s = k->set;
    return job_hash((const char *const[]){"recording", name, s->build, sha256, set_level_text(s, a), isnan(s->length) ? "" : keys_yaml_number(s->length, a),
                                          arena_format(a, "%d", s->encoding), keys_yaml_number(s->ramp, a)}, 8, a);
}

static bool measure(const struct set *s, const char *file, struct measure *m, struct record *r, struct err *e)
{
    struct cut_form form = form_of(s);
    if (!measure_cut(file, &form, !isnan(s->level.lufs), m, e) || !find_gain(s, file, m, &r->gain, e))
        return false;
    r->peak = m->peak, r->rms = m->rms, r->lufs = m->lufs;
    return true;
}

static bool make(const struct job_kit *k, const char *file, struct record *r, struct arena *a, struct err *e)
{
    struct measure m;
    char hex[HASH_TEXT];
    double start[2] = {stopwatch_wall(), stopwatch_cpu()};
    const char *path = arena_format(a, "%s.wav", job_base(k->folder, r->name, false, a));
    if (!folder_make_for(k->folder, r->name, e) || !measure(k->set, file, &m, r, e) || !write_it(k->set, file, path, &m, r, a, e) || !hash_file(path, hex, e))
        return false;
    r->files = ARENA_TAKE(a, struct record_file, 1);
    r->files[r->n_files++] = (struct record_file){"wav", arena_format(a, "%s.wav", r->name), arena_text(a, hex)};
    r->audio = arena_take(a, HASH_TEXT, 1);
    r->sounds = true;
    r->encoding = k->set->encoding;
    r->full_scale = NAN;
    r->wall = stopwatch_wall() - start[0], r->cpu = stopwatch_cpu() - start[1];
    return job_measure(k->folder, true, r, e);
}

/* The copy is called by what the file was before: put back, too, it is none of that. */
static bool still(const struct watch *w, const char *file, struct err *e)
{
    return !watch_changed(w) || err_set(e, ERR_INPUT, "%s: has changed while it was copied: run the same command again", file);
}

static bool do_it(const struct job_kit *k, int i, struct arena *a, struct job_result *result, struct err *e)
{
    char hex[HASH_TEXT];
    const char *file = k->design->stimuli[i].recording;
    struct watch w = watch_begin(&file, 1, a);
    if (!hash_file(file, hex, e))
        return false;
    const char *name = k->set->rows[i].name, *key = key_of(k, name, hex, a);
    const struct record *found = k->force ? NULL : journal_find(k->journal, key, false, a, &result->ref);
    result->kept = found && job_is_there(k->folder, found, a);
    result->record = found;
    if (result->kept)
        return true;
    struct record *r = ARENA_TAKE(a, struct record, 1);
    *r = (struct record){.name = name, .key = key, .job = key, .build = k->set->build};
    result->record = r;
    return make(k, file, r, a, e) && still(&w, file, e) && journal_add(k->journal, r, &result->ref, e);
}

bool recording_do(const struct job_kit *k, int i, struct arena *a, struct job_result *result, struct err *e)
{
    if (do_it(k, i, a, result, e))
        return true;
    return (e->kind == ERR_INPUT || e->kind == ERR_SCENE) && design_scene_recording(k->design, i, e);
}
