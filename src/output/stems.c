/* force     the contact force, summed over the contacts that are heard, in newtons: 1.0 is 1 N. Always one channel of
   32-bit floating point, whatever output.encoding is, so that any force fits; no ramps, no envelope, no level. surface
   what the surfaces, scraper   what the scrapers and ball      what the balls (weights included) put into the sound,
   all contacts times their gains, with the sound's own gain, ramps, envelope, channels and encoding: surface + scraper
   + ball is the sound, but for the rounding of each. A part may be louder than the whole: where the encoding has no
   room for it, that is an error. */
#include "output/stems.h"

#include <stdio.h>
#include <string.h>

#include "output/sound.h"
#include "output/track.h"
#include "response/listener.h"

const char *const stems_names[STEMS] = {"force", "surface", "scraper", "ball"};

struct stems {
    const struct scene *scene;
    struct track tracks[STEMS];
    bool open[STEMS];
};

bool stems_asked(const struct output *o, enum stem stem)
{
    for (int i = 0; o->stems && o->stems[i]; i++)
        if (strcmp(o->stems[i], stems_names[stem]) == 0) return true;
    return false;
}

int stems_channels(const struct output *o, enum stem stem) { return stem == STEM_FORCE ? 1 : listener_channels(o); }

static bool comment(const struct stems *o, struct track *t, double gain, struct err *e)
{
    char text[80];
    sound_comment(o->scene, gain, text);
    return track_note(t, text, e);
}

struct stems *stems_open(const struct scene *s, const char *const paths[STEMS], long frames, struct arena *a,
                         struct err *e)
{
    struct stems *o = ARENA_TAKE(a, struct stems, 1);
    o->scene = s;
    for (int k = 0; k < STEMS && e->kind == ERR_NONE; k++) {
        struct track *t = &o->tracks[k];
        struct track_format f = sound_format(s, frames);
        double gain = sound_known_gain(s);
        if (!stems_asked(&s->output, (enum stem)k)) continue;
        f.key = "output.stems: a part of the sound may be louder than the whole: use output.encoding: float32, or a "
                "lower level";
        if (k == STEM_FORCE) {
            gain = 1;
            f.places = f.channels = 1, f.bits = -32, f.ramp = 0, f.recede = 0, f.waits = false;
            f.key = "output.stems: force";
        }
        o->open[k] = track_open(t, paths[k], &f, gain, a, e);
        if (o->open[k] && k == STEM_FORCE)
            track_note(t, "rasp: contact force, 1.0 is 1 N", e);
        else if (o->open[k] && !f.waits)
            comment(o, t, gain, e);
    }
    if (e->kind == ERR_NONE) return o;
    stems_drop(o);
    return NULL;
}

bool stems_add(struct stems *o, enum stem stem, double *x, long n, struct err *e)
{
    return track_add(&o->tracks[stem], x, n, e);
}

bool stems_finish(struct stems *o, double gain, struct err *e)
{
    for (int k = 0; k < STEMS; k++) {
        struct track *t = &o->tracks[k];
        if (o->open[k] && t->spool && !(comment(o, t, gain, e) && track_finish(t, gain, e))) return false;
    }
    return true;
}

struct track *stems_track(struct stems *o, enum stem stem) { return &o->tracks[stem]; }

void stems_drop(struct stems *o)
{
    for (int k = 0; o && k < STEMS; k++)
        if (o->open[k]) track_drop(&o->tracks[k]);
}
