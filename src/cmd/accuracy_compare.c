/* A render's sound against the reference's, both in the sound's own unit: the level that the scene sets is taken out of each. Where the sound diverges (agreement.h: `high`
   does not follow `reference` to the end), samples are compared up to there, and what comes after by what two sounds of one kind have in common. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "analysis/agreement.h"
#include "analysis/distance.h"
#include "analysis/log_spectral.h"
#include "base/interrupt.h"
#include "cmd/accuracy.h"
#include "num/real.h"

#define WITHIN 60.0 /* dB: third octaves farther below the loudest are left out */

static struct wav part(const struct wav *w, size_t from, size_t to)
{
    struct wav p = *w;
    from = from < w->frames ? from : w->frames;
    to = to < w->frames ? to : w->frames;
    p.x = w->x + from * (size_t)w->channels;
    p.frames = to - from;
    return p;
}

static double level(const struct wav *w)
{
    double sum = 0.0;
    for (size_t i = 0; i < w->frames * (size_t)w->channels; i++)
        sum += w->x[i] * w->x[i];
    return 10.0 * real_log10(sum / (double)w->frames);
}

struct accuracy_error accuracy_compare_sounds(const struct wav *a, const struct wav *b, double until)
{
    struct accuracy_error o = {.snr = NAN, .third = NAN, .third_hz = NAN, .spectral = NAN, .level = NAN, .length = (double)b->frames / b->rate};
    struct arena *arena = arena_open();
    size_t frames = a->frames < b->frames ? a->frames : b->frames, cut = until * a->rate < (double)frames ? (size_t)rint(until * a->rate) : frames, from = cut < frames ? cut : 0;
    struct wav first[2] = {part(a, 0, cut), part(b, 0, cut)}, rest[2] = {part(a, from, frames), part(b, from, frames)};
    struct distance_samples d;
    struct distance_bands bands;
    if (cut > 0) {
        distance_samples(&first[0], &first[1], &d);
        o.snr = d.snr_db;
    }
    distance_bands(&rest[0], &rest[1], WITHIN, arena, &bands);
    o.third = bands.compared ? bands.worst_db : 0.0;
    o.third_hz = bands.compared ? distance_band_nominal(bands.band) : NAN;
    o.spectral = log_spectral(&rest[0], &rest[1]);
    o.level = level(&rest[1]) - level(&rest[0]);
    o.follows = (double)agreement(a, b) / a->rate;
    arena_close(arena);
    return o;
}

static bool sound_read(const char *path, double gain, struct arena *a, struct wav *w, struct err *e)
{
    if (!wav_read(path, a, w, e))
        return false;
    for (size_t i = 0; i < w->frames * (size_t)w->channels; i++)
        w->x[i] /= gain;
    return true;
}

static bool reference_taken(struct accuracy_sweep *s, const char *path, const struct wav *a, struct err *e)
{
    interrupt_hold(); /* it would slip past what removes the folder */
    bool moved = rename(accuracy_child_sound(s), path) == 0;
    interrupt_go();
    if (!moved)
        return err_set(e, ERR_IO, "%s: %s", path, strerror(errno));
    s->rate = a->rate;
    s->channels = a->channels;
    s->length = (double)a->frames / a->rate;
    return true;
}

bool accuracy_compare(struct accuracy_sweep *s, int render, struct err *e)
{
    struct accuracy_render *r = &s->renders[render];
    const char *path = arena_format(s->call->arena, "%s/reference.wav", s->folder);
    struct arena *arena = arena_open();
    struct wav a, b;
    bool is = render == s->reference;
    bool ok = sound_read(accuracy_child_sound(s), r->gain, arena, &b, e) && (is || sound_read(path, s->renders[s->reference].gain, arena, &a, e));
    if (ok && is)
        ok = reference_taken(s, path, &b, e);
    if (ok && !is && (a.channels != b.channels || a.rate != b.rate))
        ok = err_set(e, ERR_NUMBERS, "the renders differ in rate or channels and cannot be compared");
    if (ok && render == s->high && !is) {
        size_t until = agreement(&a, &b);
        s->until = until < a.frames && until < b.frames ? (double)until / a.rate : INFINITY;
    }
    if (ok)
        r->error = accuracy_compare_sounds(is ? &b : &a, &b, s->until);
    arena_close(arena);
    return ok;
}
