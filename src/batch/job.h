/* One stimulus of a set: is it there already, else it is rendered.

   Where the gain is known beforehand, a render goes into the output folder. Where it waits for the whole set (a common peak, rms or loudness), the sound is rendered
   at full_scale 1 to float64 under DIR/.rasp/raw, so that the one multiplication that is left gives the very bytes that a render of the effective scene with the
   set's full_scale gives (batch/level.h does it). */
#ifndef BATCH_JOB_H
#define BATCH_JOB_H
#include "batch/design.h"
#include "batch/journal.h"
#include "batch/record.h"
#include "batch/set.h"

struct job_kit {             /* what all jobs share; several threads read it */
    const struct design *design;
    const struct set *set;
    const char *folder;
    struct journal *journal;
    struct shelf *shelf;     /* what stimuli share of their inputs */
    bool force;              /* what is there does not count */
    bool again;              /* what waits for its gain is rendered again, though it is there with another gain */
};

struct job_result {
    const struct record *record; /* NULL: it failed; else in the arena that job_do was given */
    struct journal_ref ref;      /* the same                                                 */
    bool kept;                   /* it was there */
};

/* ERR_SCENE and what rendering gives. */
bool job_do(const struct job_kit *k, int i, struct arena *a, struct job_result *r, struct err *e);

/* The scene of stimulus i with the set's length and level; messages as of scene_read. */
bool job_scene(const struct job_kit *k, int i, struct arena *a, struct scene *s, struct err *e);

/* What is the matter with the first file of the record (*file) that is not there with the bytes that it had: "is missing", "was changed"; NULL: nothing is. */
const char *job_differs(const char *folder, const struct record *r, struct arena *a, const char **file);

/* Is all known of it that the set's level asks for? */
bool job_tells_enough(const struct set *s, const struct record *r);

/* Are all files of the record there, with the bytes that they had? */
bool job_is_there(const char *folder, const struct record *r, struct arena *a);

/* "DIR/NAME" and "DIR/.rasp/raw/NAME" */
const char *job_base(const char *folder, const char *name, bool raw, struct arena *a);

/* Fills in what the WAV in the folder holds. loud: its loudness, too. */
bool job_measure(const char *folder, bool loud, struct record *r, struct err *e);

/* Of what the samples and files depend on: the texts one after the other, each with its length. */
const char *job_hash(const char *const *texts, int n, struct arena *a);

#endif
