/* What a render has to say: remarks, and the JSON beside the WAV. */
#ifndef PIPELINE_SUMMARY_H
#define PIPELINE_SUMMARY_H
#include "pipeline/render.h"

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

#endif
