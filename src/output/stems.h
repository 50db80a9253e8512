/* Stems: parts of the sound that are written as WAVs of their own beside it. See stems.c. */
#ifndef OUTPUT_STEMS_H
#define OUTPUT_STEMS_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"
#include "scene/scene.h"

enum stem { STEM_FORCE, STEM_SURFACE, STEM_SCRAPER, STEM_BALL, STEMS };

/* "force", "surface", "scraper", "ball" */
extern const char *const stems_names[STEMS];

/* Does the scene ask for it? */
bool stems_asked(const struct output *o, enum stem stem);

/* Channels of a stem: 1 of the force, else those of the sound. */
int stems_channels(const struct output *o, enum stem stem);

struct stems;
struct track;

/* Opens paths[stem] of those asked for, at once. frames: how many stems_add will bring in all. ERR_CREATE, ERR_IO. */
struct stems *stems_open(const struct scene *s, const char *const paths[STEMS], long frames, struct arena *a,
                         struct err *e);

/* The next n frames of a stem that is asked for, interleaved: newtons, or the sound's quantity. Ramped in place like
 * the sound. */
bool stems_add(struct stems *o, enum stem stem, double *x, long n, struct err *e);

/* gain: the sound's. ERR_SCENE: clipping. */
bool stems_finish(struct stems *o, double gain, struct err *e);

/* The file of a stem that is asked for, once it is finished: to be settled and committed. */
struct track *stems_track(struct stems *o, enum stem stem);

/* Ends them; of files that are not committed nothing is left. */
void stems_drop(struct stems *o);

#endif
