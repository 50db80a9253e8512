/* Ramps are raised cosines over output.ramp at both ends of the total, sin^2(pi/2 (n + 1/2) / N), shortened to half the sound if need be.

   Level. `full_scale` is physical: file = sound / full_scale, written as it comes. `peak`, `rms` and `lufs` scale the file once the whole is
   known: samples spool to an unnamed file of doubles in the meantime, so that memory does not grow. Nothing given: peak -3 dBFS. A peak of
   0 dB is the largest value the encoding has. Loudness is BS.1770 integrated, mono counted on two ears (libebur128); it is rounded to 1e-6
   LU before it becomes a gain, because its filter's coefficients come from libm (src/README.md, "same bytes"). A silent sound stays silent
   (reported), whatever level is asked. */
#include "output/sound.h"

#include <ebur128.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/scratch.h"
#include "file/wav.h"
#include "num/real.h"
#include "scene/rules.h"

enum { SOUND_CHUNK = 4096 };

struct sound {
    const struct scene *scene;
    struct wav_out *wav;
    FILE *spool;              /* NULL: the gain is known beforehand */
    ebur128_state *meter;     /* NULL: loudness is not needed       */
    long frames, done, ramp;
    double peak, squares, gain;
    double *wide;             /* a chunk on all channels            */
};

static double sound_bits(int encoding)
{
    const int bits[] = {[ENCODING_PCM16] = 16, [ENCODING_PCM24] = 24, [ENCODING_FLOAT32] = -32, [ENCODING_FLOAT64] = -64};
    return bits[encoding];
}

static bool sound_spool_open(struct sound *o, struct err *e)
{
    const struct level *level = &o->scene->output.level;
    o->gain = 1 / level->full_scale;
    if (isnan(level->full_scale) && !(o->spool = scratch_open()))
        return err_set(e, ERR_CREATE, "no temporary file can be made for the samples in %s: %s (set TMPDIR to a folder with space)",
                       scratch_folder(), strerror(errno));
    if (isnan(level->lufs))
        return true;
    o->meter = ebur128_init(1, (unsigned long)o->scene->output.sample_rate, EBUR128_MODE_I);
    if (!o->meter || ebur128_set_channel(o->meter, 0, EBUR128_DUAL_MONO) != EBUR128_SUCCESS)
        return err_set(e, ERR_MEMORY, "the loudness meter cannot be set up at %g Hz", o->scene->output.sample_rate);
    return true;
}

/* The gain goes into the WAV before its first sample. */
static bool sound_note(struct sound *o, struct err *e)
{
    char text[80];
    snprintf(text, sizeof text, "rasp: gain %.9g per unit of the response (%.4f dB)", o->gain, 20 * real_log10(o->gain));
    return wav_comment(o->wav, text, e);
}

struct sound *sound_open(const struct scene *s, const char *path, long frames, struct arena *a, struct err *e)
{
    struct sound *o = ARENA_TAKE(a, struct sound, 1);
    struct wav_format f = {.rate = s->output.sample_rate, .channels = s->output.channels, .bits = (int)sound_bits(s->output.encoding),
                           .title = s->title};
    long ramp = (long)rint(s->output.ramp * s->output.sample_rate);
    *o = (struct sound){.scene = s, .frames = frames, .ramp = ramp < frames / 2 ? ramp : frames / 2,
                        .wide = ARENA_TAKE(a, double, SOUND_CHUNK * s->output.channels)};
    if ((o->wav = wav_create(path, &f, e)) && sound_spool_open(o, e) && (o->spool || sound_note(o, e)))
        return o;
    sound_drop(o);
    return NULL;
}

static void sound_ramp(const struct sound *o, double *x, long n)
{
    for (long i = 0; i < n; i++) {
        long at = o->done + i, rest = o->frames - 1 - at, edge = at < rest ? at : rest;
        if (edge >= o->ramp)
            continue;
        double s = real_sinpi(0.5 * ((double)edge + 0.5) / (double)o->ramp);
        x[i] *= s * s;
    }
}

/* The key that sets it. */
static const char *sound_level(const struct level *level)
{
    return !isnan(level->full_scale) ? "full_scale" : !isnan(level->rms) ? "rms" : !isnan(level->lufs) ? "lufs" : "peak";
}

static bool sound_write(struct sound *o, const double *x, long n, struct err *e)
{
    int channels = o->scene->output.channels;
    for (long i = 0; i < n; i += SOUND_CHUNK) {
        long some = n - i < SOUND_CHUNK ? n - i : SOUND_CHUNK;
        for (long k = 0; k < some * channels; k++)
            o->wide[k] = o->gain * x[i + k / channels];
        if (!wav_write(o->wav, o->wide, (size_t)some, e))
            return e->kind == ERR_SCENE ? err_at(e, "output.level.%s", sound_level(&o->scene->output.level)) : false;
    }
    return true;
}

bool sound_add(struct sound *o, double *x, long n, struct err *e)
{
    sound_ramp(o, x, n);
    o->done += n;
    for (long i = 0; i < n; i++) {
        o->peak = fmax(o->peak, fabs(x[i]));
        o->squares += x[i] * x[i];
    }
    if (!o->spool)
        return sound_write(o, x, n, e);
    if (fwrite(x, sizeof *x, (size_t)n, o->spool) != (size_t)n)
        return err_set(e, ERR_IO, "samples cannot be kept in a temporary file in %s: %s (set TMPDIR to a folder with space)", scratch_folder(),
                       strerror(errno));
    return true;
}

/* Loudness of the whole spool in LUFS, brought to peak 1 first: BS.1770's gate at -70 LUFS is absolute. */
static bool sound_loudness(struct sound *o, double *lufs, struct err *e)
{
    double x[SOUND_CHUNK];
    size_t n;
    rewind(o->spool);
    while ((n = fread(x, sizeof *x, SOUND_CHUNK, o->spool)) > 0) {
        for (size_t i = 0; i < n; i++)
            x[i] /= o->peak;
        ebur128_add_frames_double(o->meter, x, n);
    }
    if (ebur128_loudness_global(o->meter, lufs) != EBUR128_SUCCESS || !isfinite(*lufs))
        return err_set(e, ERR_SCENE,
                       "output.level.lufs: BS.1770 loudness cannot be measured on this sound (%.3g s; it needs 0.4 s that are not nearly "
                       "silent): use output.level.rms or output.level.peak",
                       (double)o->frames / o->scene->output.sample_rate);
    *lufs = rint(*lufs * 1e6) / 1e6;
    return true;
}

static bool sound_gain(struct sound *o, double rms, struct err *e)
{
    const struct level *level = &o->scene->output.level;
    double bits = sound_bits(o->scene->output.encoding), lufs;
    double largest = bits > 0 ? 1 - ldexp(1, 1 - (int)bits) : 1;
    if (!isnan(level->rms))
        o->gain = real_exp10(level->rms / 20) / rms;
    else if (isnan(level->lufs))
        o->gain = fmin(real_exp10((isnan(level->peak) ? RULES_PEAK : level->peak) / 20), largest) / o->peak;
    else if (sound_loudness(o, &lufs, e))
        o->gain = real_exp10((level->lufs - lufs) / 20) / o->peak;
    else
        return false;
    return true;
}

bool sound_finish(struct sound *o, struct sound_report *report, struct err *e)
{
    double x[SOUND_CHUNK], rms = sqrt(o->squares / (double)(o->frames > 0 ? o->frames : 1));
    size_t n;
    *report = (struct sound_report){.ramp = (double)o->ramp / o->scene->output.sample_rate, .peak = o->peak, .rms = rms, .lufs = o->scene->output.level.lufs, .silent = o->peak == 0};
    if (o->spool && o->peak == 0)
        o->gain = 1;
    else if (o->spool && !sound_gain(o, rms, e))
        return false;
    report->gain = o->gain;
    if (!o->spool)
        return true;
    if (!sound_note(o, e))
        return false;
    rewind(o->spool);
    while ((n = fread(x, sizeof *x, SOUND_CHUNK, o->spool)) > 0)
        if (!sound_write(o, x, (long)n, e))
            return false;
    return ferror(o->spool) ? err_set(e, ERR_IO, "samples cannot be read back from the temporary file") : true;
}

static void sound_release(struct sound *o)
{
    if (o->spool)
        fclose(o->spool);
    if (o->meter)
        ebur128_destroy(&o->meter);
    o->spool = NULL;
}

bool sound_settle(struct sound *o, struct err *e)
{
    sound_release(o);
    return wav_settle(o->wav, e);
}

bool sound_commit(struct sound *o, struct err *e)
{
    struct wav_out *w = o->wav;
    sound_release(o);
    o->wav = NULL;
    return wav_commit(w, e);
}

void sound_drop(struct sound *o)
{
    if (!o)
        return;
    sound_release(o);
    if (o->wav)
        wav_drop(o->wav);
    o->wav = NULL;
}
