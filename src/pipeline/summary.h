/* What a render has to say: remarks, and the JSON beside the WAV. */
#ifndef PIPELINE_SUMMARY_H
#define PIPELINE_SUMMARY_H
#include "pipeline/render.h"
#include <jansson.h>

/* What each contact that rolls, and each series of impacts, did, in words. One run per contact, NULL for a muted one.
 */
void summary_notes(const struct scene *s, const struct run *const *runs, struct render_report *report, struct arena *a);

/* Gathers the runs' remarks, and those on the whole. */
void summary_warnings(const struct scene *s, const struct run *const *runs, struct render_report *report,
                      struct arena *a);

/* JSON: sound, level, cost per stage, remarks, and which files were written, with the hashes of all but the WAV. Times
   make it differ from run to run; nothing in it reaches a sample. times: false leaves them out, and what an earlier
   render left, for a record of a set: the same bytes from every run. */
const char *summary_text(const struct scene *s, const struct run *const *runs, const struct render_report *report,
                         bool times, struct arena *a);

/* What the WAVs of a render hold, as they were written: silence, and samples beyond full scale. In words, and in the
 * summary. */
/* "the sound is silent: ...", also of single channels of it; NULL: every channel is heard, or the file is no WAV. peak:
 * of the sound, re full scale, before it was rounded to its encoding. */
const char *summary_silent(const struct scene *s, const struct render_file *f, double peak, struct arena *a);

/* "the sound: 10 of 1000 samples lie beyond full scale, ..."; NULL: none does. A stem of the force is in newtons, and
 * has no full scale. */
const char *summary_beyond(const struct scene *s, const struct render_file *f, struct arena *a);

/* Puts "silent" and "samples_beyond_full_scale" (null of a force) into an object, of a WAV. */
void summary_written(const struct render_file *f, json_t *to);

/* The sound's file among those of a render that has one. */
const struct render_file *summary_sound(const struct render_report *report);

#endif
