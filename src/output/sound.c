/* Level. `full_scale` and `dbfs_at_1_pa` are physical: file = sound / full_scale, or sound in pascals times 10^(dB/20),
   written as it comes. `peak`, `rms` and `lufs` scale the file once the whole is known: samples spool to an unnamed
   file of doubles in the meantime, so that memory does not grow. Nothing given: peak -3 dBFS. A peak of 0 dB is the
   largest value the encoding has. Of several channels (listening places) the peak is the largest of all, the mean
   square is that of all together, and one gain serves them all, so that they keep their balance. Loudness is that of
   output/loudness.h, rounded to 1e-6 LU before it becomes a gain (src/README.md, "same bytes"). A silent sound stays
   silent (reported), whatever level is asked. */
#include "output/sound.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "num/real.h"
#include "output/loudness.h"
#include "response/listener.h"

struct sound {
    const struct scene *scene;
    struct track track;
    struct arena *arena;
    struct loudness *meter; /* NULL: loudness is not needed */
};

const char *sound_level_key(const struct scene *s)
{
    const struct level *l = &s->output.level;
    return !isnan(l->full_scale)     ? "output.level.full_scale"
           : !isnan(l->dbfs_at_1_pa) ? "output.level.dbfs_at_1_pa"
           : !isnan(l->rms)          ? "output.level.rms"
           : !isnan(l->lufs)         ? "output.level.lufs"
                                     : "output.level.peak";
}

int sound_bits(int encoding)
{
    static const int bits[] = {[ENCODING_PCM16] = 16,    [ENCODING_PCM24] = 24,  [ENCODING_FLOAT32] = -32,
                               [ENCODING_FLOAT64] = -64, [ENCODING_FLAC16] = 16, [ENCODING_FLAC24] = 24};
    return bits[encoding];
}

const char *sound_ending(int encoding) { return encoding >= ENCODING_FLAC16 ? ".flac" : ".wav"; }

struct track_format sound_format(const struct scene *s, long frames)
{
    const struct output *o = &s->output;
    long ramp = (long)rint(o->ramp * o->sample_rate);
    double recede = o->envelope == ENVELOPE_APPROACH_RECEDE ? sqrt(real_exp10(o->envelope_depth / 10) - 1) : 0;
    int places = listener_channels(o);
    return (struct track_format){.rate = o->sample_rate,
                                 .bits = sound_bits(o->encoding),
                                 .places = places,
                                 .channels = places > 1 ? places : o->channels,
                                 .frames = frames,
                                 .ramp = ramp < frames / 2 ? ramp : frames / 2,
                                 .recede = recede,
                                 .waits = isnan(sound_known_gain(s)),
                                 .title = s->title,
                                 .key = sound_level_key(s)};
}

double sound_known_gain(const struct scene *s)
{
    const struct level *l = &s->output.level;
    return !isnan(l->dbfs_at_1_pa) ? real_exp10(l->dbfs_at_1_pa / 20) : 1 / l->full_scale;
}

void sound_comment(const struct scene *s, double gain, char text[80])
{
    const char *unit = listener_in_pascals(&s->output)        ? "Pa"
                       : s->output.quantity == QUANTITY_FORCE ? "N"
                                                              : "unit of the response";
    snprintf(text, 80, "rasp: gain %.9g per %s (%.4f dB)", gain, unit, 20 * real_log10(gain));
}

/* The gain goes into the WAV before its first sample. */
static bool note(struct sound *o, double gain, struct err *e)
{
    char text[80];
    sound_comment(o->scene, gain, text);
    return track_note(&o->track, text, e);
}

bool sound_long_enough(const struct scene *s, long frames, struct err *e)
{
    return isnan(s->output.level.lufs) || frames >= loudness_least(s->output.sample_rate) ||
           err_set(e, ERR_SCENE,
                   "output.level.lufs: BS.1770 loudness needs 0.4 s, and the sound is %.3g s long: use "
                   "output.level.rms or output.level.peak",
                   (double)frames / s->output.sample_rate);
}

struct sound *sound_open(const struct scene *s, const char *path, long frames, struct arena *a, struct err *e)
{
    struct sound *o = ARENA_TAKE(a, struct sound, 1);
    struct track_format f = sound_format(s, frames);
    double gain = sound_known_gain(s);
    *o = (struct sound){.scene = s, .arena = a};
    if (f.places > 1 && s->output.channels > 1) {
        err_set(e, ERR_SCENE,
                "output.channels: each of the %d listening places is a channel of its own: leave output.channels out",
                f.places);
        return NULL;
    }
    if (!sound_long_enough(s, frames, e) || !track_open(&o->track, path, &f, gain, a, e)) return NULL;
    if (!isnan(s->output.level.lufs) && !(o->meter = loudness_open(f.places, s->output.sample_rate, false)))
        err_set(e, ERR_MEMORY, "the loudness meter cannot be set up at %g Hz", s->output.sample_rate);
    else if (f.waits || note(o, gain, e))
        return o;
    sound_drop(o);
    return NULL;
}

bool sound_add(struct sound *o, double *x, long n, struct err *e) { return track_add(&o->track, x, n, e); }

/* Loudness of the whole in LUFS, brought to peak 1 first: BS.1770's gate at -70 LUFS is absolute. */
static bool find_loudness(struct sound *o, double peak, double *lufs, struct err *e)
{
    double x[TRACK_CHUNK];
    long n;
    track_rewind(&o->track);
    while ((n = track_read(&o->track, x)) > 0) {
        for (long i = 0; i < n * o->track.format.places; i++)
            x[i] /= peak;
        loudness_add(o->meter, x, (size_t)n);
    }
    if (!loudness_read(o->meter, lufs))
        return err_set(e, ERR_SCENE,
                       "output.level.lufs: BS.1770 loudness cannot be measured on this sound (%.3g s; it needs 0.4 s "
                       "that are not nearly "
                       "silent): use output.level.rms or output.level.peak",
                       (double)o->track.format.frames / o->scene->output.sample_rate);
    return true;
}

static struct sound_report report_make(const struct sound *o)
{
    const struct track *t = &o->track;
    int channels = t->format.places;
    double squares = 0, frames = (double)(t->format.frames > 0 ? t->format.frames : 1);
    struct sound_report r = {.channels = channels,
                             .channel_peak = ARENA_TAKE(o->arena, double, channels),
                             .channel_rms = ARENA_TAKE(o->arena, double, channels),
                             .lufs = o->scene->output.level.lufs,
                             .ramp = (double)t->format.ramp / o->scene->output.sample_rate};
    for (int k = 0; k < channels; k++) {
        squares += track_squares(t, k);
        r.peak = fmax(r.peak, t->peak[k]);
        r.channel_peak[k] = t->peak[k];
        r.channel_rms[k] = sqrt(track_squares(t, k) / frames);
    }
    r.rms = sqrt(squares / (frames * channels));
    r.silent = r.peak == 0;
    r.end = t->end;
    r.before_ramps = fmax(r.peak, fmax(t->begin, t->end));
    return r;
}

/* A level that the whole sound decides, and integers do not hold: which one they would. beyond: the peak over the
   largest sample. */
static bool fits(const struct sound *o, double beyond, struct err *e)
{
    const struct level *level = &o->scene->output.level;
    bool loudness = isnan(level->rms);
    double asked = loudness ? level->lufs : level->rms, over = 20 * real_log10(beyond);
    if (o->track.format.bits <= 0 || isnan(asked) || beyond <= 1) return true;
    return err_set(
        e, ERR_SCENE,
        "%s: the peak would be %+.2f dB re full scale, beyond the range of %d-bit integers; ask for %.1f %s, "
        "which fits, or write floating point (output.encoding: float32)",
        o->track.format.key, over, o->track.format.bits, floor(10 * (asked - over)) / 10, loudness ? "LUFS" : "dB");
}

bool sound_finish(struct sound *o, struct sound_report *report, struct err *e)
{
    struct track *t = &o->track;
    const struct level *level = &o->scene->output.level;
    double lufs, largest = t->format.bits > 0 ? 1 - ldexp(1, 1 - t->format.bits) : 1;
    *report = report_make(o);
    report->gain = t->gain;
    if (!t->spool) return true;
    if (report->silent) /* the gain that the level asks for */
        report->gain = 1;
    else if (!isnan(level->rms))
        report->gain = real_exp10(level->rms / 20) / report->rms;
    else if (isnan(level->lufs))
        report->gain = fmin(real_exp10((isnan(level->peak) ? SOUND_PEAK : level->peak) / 20), largest) / report->peak;
    else if (find_loudness(o, report->peak, &lufs, e))
        report->gain = real_exp10((level->lufs - lufs) / 20) / report->peak;
    else
        return false;
    return fits(o, report->gain * report->peak / largest, e) && note(o, report->gain, e) &&
           track_finish(t, report->gain, e);
}

struct track *sound_track(struct sound *o) { return &o->track; }

void sound_drop(struct sound *o)
{
    if (!o) return;
    loudness_close(o->meter);
    o->meter = NULL;
    track_drop(&o->track);
}
