/* See written.h. Integers round what is less than half a step to 0; what is beyond their range they refuse
 * (file/wav.h). Floating point holds both. */
#include "pipeline/written.h"

#include <math.h>
#include <string.h>

#include "num/real.h"
#include "output/stems.h"
#include "scene/keys.h"

static const char *sound_silent(const struct scene *s, double peak, struct arena *a)
{
    if (peak > 0)
        return arena_format(a,
                            "the sound is silent: every sample is 0 in %s, for its peak is %.1f dB re full scale: give "
                            "a higher level (%s)%s",
                            keys_find("output.encoding")->choices[s->output.encoding].word, 20 * real_log10(peak),
                            sound_level_key(s),
                            s->output.encoding <= ENCODING_PCM24 ? ", or write float32 (output.encoding)" : "");
    return isnan(sound_known_gain(s)) || s->output.level.later ? "the sound is silent: no level was set"
                                                               : "the sound is silent: every sample is 0";
}

const char *written_silent(const struct scene *s, const struct render_file *f, double peak, struct arena *a)
{
    const struct wav_written *w = f->written;
    const char *silent = "";
    int n = 0;
    if (!w) return NULL;
    for (int k = 0; k < w->channels; k++)
        if (!w->audible[k]) silent = arena_format(a, "%s%s%d", silent, n++ ? ", " : "", k + 1);
    if (n == w->channels)
        return f->stem ? arena_format(a, "the stem %s is silent: every sample is 0", f->stem)
                       : sound_silent(s, peak, a);
    return n == 0 || f->stem ? NULL
                             : arena_format(a, "channel%s %s of %d %s silent: every sample there is 0",
                                            n == 1 ? "" : "s", silent, w->channels, n == 1 ? "is" : "are");
}

static bool has_full_scale(const struct render_file *f)
{
    return !f->stem || strcmp(f->stem, stems_names[STEM_FORCE]) != 0;
}

const char *written_beyond(const struct scene *s, const struct render_file *f, struct arena *a)
{
    const struct wav_written *w = f->written;
    if (!w || !has_full_scale(f) || !(w->beyond > 0)) return NULL;
    return arena_format(a,
                        "the %s%s: %.0f of %.0f samples lie beyond full scale, by up to %.2f dB: floating point holds "
                        "them, but whatever plays them, or makes integers of them, clips: give a lower "
                        "level (%s)",
                        f->stem ? "stem " : "sound", f->stem ? f->stem : "", w->beyond, w->frames * w->channels,
                        20 * real_log10(w->peak), sound_level_key(s));
}

void written_tell(const struct render_file *f, json_t *to)
{
    if (!f->written) return;
    json_object_set_new(to, "silent", json_boolean(!wav_written_audible(f->written)));
    json_object_set_new(to, "samples_beyond_full_scale",
                        has_full_scale(f) ? json_integer((json_int_t)f->written->beyond) : json_null());
}

const struct render_file *written_sound(const struct render_report *report)
{
    const struct render_file *f = report->files;
    while (!f->written || f->stem)
        f++;
    return f;
}
