/* The scene's sound on its way to the WAV: ramps, level, and the measures that the summary reports. */
#ifndef OUTPUT_SOUND_H
#define OUTPUT_SOUND_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"
#include "output/track.h"
#include "scene/scene.h"

#define SOUND_PEAK (-3.0) /* dB re full scale: the level of a sound for which none is given */

struct sound;

struct sound_report {
    double peak,
        rms;      /* of the unscaled sound, in the response's quantity: the largest of all channels; of all together */
    int channels; /* listening places */
    double *channel_peak, *channel_rms; /* [channels] */
    double end;                         /* greatest magnitude under the ramp that ends it, before that ramp */
    double before_ramps;                /* peak before both ramps */
    double lufs;                        /* of the file; NAN: not measured                    */
    double gain;                        /* file value per unit of the quantity               */
    bool silent;                        /* nothing was there to be written: the peak is 0 */
    double ramp;                        /* s: less than output.ramp when the sound is too short for it */
};

/* Of an enum encoding: bits as wav_format has them; what the file's name ends in. */
int sound_bits(int encoding);
const char *sound_ending(int encoding);

/* The WAV's format of a scene's sound of so many frames; a stem may have the same. */
struct track_format sound_format(const struct scene *s, long frames);

/* The gain if the scene alone tells it (output.level: full_scale, dbfs_at_1_pa), else NAN. */
double sound_known_gain(const struct scene *s);

/* The WAV's comment at that gain, ended by a 0. */
void sound_comment(const struct scene *s, double gain, char text[80]);

/* Has a sound of so many frames the length that its level asks for? Anything has but for a loudness. ERR_SCENE */
bool sound_long_enough(const struct scene *s, long frames, struct err *e);

/* Opens the WAV at once. frames: how many sound_add will bring in all. ERR_CREATE, ERR_IO. ERR_SCENE: channels that do
   not go together, or sound_long_enough. */
struct sound *sound_open(const struct scene *s, const char *path, long frames, struct arena *a, struct err *e);

/* The next n frames (quantity units), interleaved; they are ramped in place. */
bool sound_add(struct sound *o, double *x, long n, struct err *e);

/* Scales and writes what is not written yet. ERR_SCENE: clipping, or a loudness that cannot be measured. */
bool sound_finish(struct sound *o, struct sound_report *report, struct err *e);

/* The file, once the sound is finished: to be settled and committed. */
struct track *sound_track(struct sound *o);

/* "output.level.full_scale": the key that sets the level. */
const char *sound_level_key(const struct scene *s);

/* Ends it; of a file that is not committed nothing is left. */
void sound_drop(struct sound *o);

#endif
