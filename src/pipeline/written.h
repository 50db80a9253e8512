/* What the WAVs of a render hold, as they were written: silence, and samples beyond full scale. In words, and in the
 * summary. */
#ifndef PIPELINE_WRITTEN_H
#define PIPELINE_WRITTEN_H
#include <jansson.h>

#include "pipeline/render.h"

/* "the sound is silent: ...", also of single channels of it; NULL: every channel is heard, or the file is no WAV. peak:
 * of the sound, re full scale, before it was rounded to its encoding. */
const char *written_silent(const struct scene *s, const struct render_file *f, double peak, struct arena *a);

/* "the sound: 10 of 1000 samples lie beyond full scale, ..."; NULL: none does. A stem of the force is in newtons, and
 * has no full scale. */
const char *written_beyond(const struct scene *s, const struct render_file *f, struct arena *a);

/* Puts "silent" and "samples_beyond_full_scale" (null of a force) into an object, of a WAV. */
void written_tell(const struct render_file *f, json_t *to);

/* The sound's file among those of a render that has one. */
const struct render_file *written_sound(const struct render_report *report);

#endif
