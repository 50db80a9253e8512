/* One gain for a whole set: found when all of it has been rendered, and laid over the raw sounds. */
#ifndef BATCH_LEVEL_H
#define BATCH_LEVEL_H
#include "batch/job.h"

struct level_greatest {  /* of the stimuli looked at so far */
    double peak, rms, lufs;
    int encoding;        /* the coarsest */
    bool sounds, unmeasured; /* unmeasured: of one the loudness is not known */
};

/* lufs -infinity, encoding the finest, the rest 0. */
struct level_greatest level_start(void);

/* Recordings, which have levels of their own, are not looked at. */
void level_look(struct level_greatest *g, const struct record *r);

/* output.level.full_scale of the whole set (set_waits), once all of it has been looked at. 1 if all are silent. ERR_SCENE: the loudness of none can be measured; ERR_INPUT: that of one was not. */
bool level_find(const struct set *set, const struct level_greatest *g, double *full_scale, struct err *e);

/* Makes the files of a stimulus from its raw sound, as a render of its effective scene with that full_scale would: NAME.wav and stems are scaled, NAME.scene.yaml and
   NAME.json say so, tables are copied: until the record is noted the raw sound is whole. Then the raw files are taken away, and *done is the record of what has been made. ERR_INPUT: a raw file is not there (any more);
   ERR_SCENE: a sound clips; ERR_CREATE, ERR_IO. */
bool level_apply(const struct job_kit *k, const struct record *raw, double full_scale, struct arena *a, struct journal_ref *done, struct err *e);

#endif
