/* A set of stimuli, planned: all scenes of a design are read, and their inputs opened, before anything is rendered. */
#ifndef BATCH_SET_H
#define BATCH_SET_H
#include "base/file_cache.h"
#include "batch/design.h"
#include "batch/folder.h"

struct set {
    const struct design *design;
    const char *program; /* what the program is called in the manifest, and what its results depend on  */
    const char *sha256;  /* of the design, with its scenes and what they read                           */
    int n;               /* stimuli                                                                     */
    int level_rule;      /* enum design_level_rule                                                      */
    struct level level;
    double length;            /* s, output.duration of every stimulus; NAN: each has its own                 */
    double rate;              /* Hz                                                                          */
    int channels, encoding;   /* of the WAVs: recordings must have them; encoding is an enum encoding        */
    double ramp;              /* s, of a recording that is cut                                               */
    double *cost, *lengths;   /* [n] predicted cycles, above 0; s                                            */
    char (*means)[HASH_TEXT]; /* [n] as set_means; of a recording nothing                                    */
};

/* What the text of the design tells; the rest set_plan finds. */
struct set set_make(const struct design *d, const char *program);

/* Does the gain wait for the whole set? */
bool set_waits(const struct set *s);

/* Lays the set's length and level over a scene of it. A sound that waits for its gain has full_scale 1. */
void set_lay(const struct set *s, struct scene *over);

/* "common peak -3 dB", for the manifest. */
const char *set_level_text(const struct set *s, struct arena *a);

/* SHA-256 of what a stimulus with that scene is besides its seed and the set's length: its effective scene, with the
   set's level, and with its inputs, as they are seen from the design. The scene has its file cache. */
void set_means(const struct set *s, const struct scene *scene, struct arena *a, char hex[HASH_TEXT]);

/* SHA-256 of the texts one after the other, each with its length. */
const char *set_hash(const char *const *texts, int n, struct arena *a);

/* ------------------------------------------------------------------ the plan */

struct set_fault {
    struct arena *arena;     /* what it is said with                      */
    const struct diag *diag; /* of the scene's text                       */
    const char *messages;    /* the same as text; "": it is the error     */
    const struct err *err;
    const char *name; /* of the first stimulus that has it         */
    int n;            /* how many have it                          */
};

struct set_warning {         /* what a render will warn of, as far as it is known beforehand */
    const char *text, *name; /* name: of the first stimulus that has it */
};

enum { SET_FAULTS = 64 /* that are reported apart; the next one stands for all others, whatever they say */ };

struct set_plan_ask {
    int threads;
    struct file_cache *file_cache; /* for what the scenes read                  */
    const char *folder;            /* where the set goes; NULL: it is not said  */
    bool replace;                  /* what is there already may be anybody's    */
    bool links;                    /* symbolic links are written through        */
};

struct set_plan {
    double seconds;          /* of sound, all stimuli                     */
    int n_sounds;            /* how many make any                         */
    int shortest, longest;   /* of those, before they are made equal      */
    double least, most;      /* s, of these two                           */
    double bytes, raw_bytes; /* of the WAVs; of what waits for a level    */
    double cycles;           /* predicted, of all                         */
    struct set_fault *faults;
    int n_faults;                            /* 0: nothing is wrong */
    enum err_kind worst;                     /* of all                                    */
    struct set_warning warnings[SET_FAULTS]; /* the first that differ      */
    int n_warnings;
    struct folder_inputs *inputs; /* what the set is made from             */
};

/* Completes the set. Replicates of a cell differ in their noise alone: the first one is read for all. False: there are
   faults (*e: the gravest kind and a summary), or ERR_INTERRUPTED, or an output would take the place of an input, or of
   a file that nothing says to be this design's (ERR_CREATE). */
bool set_plan(struct set *s, const struct set_plan_ask *ask, struct arena *a, struct set_plan *p, struct err *e);
void set_plan_close(struct set_plan *p);

/* "each 9.45 s, as long as the longest (NAME; the shortest, NAME, is 2.6 s by itself); length: own, or a time, in the
   design"; NULL: the design has another rule, or they differ by less than a hundredth. */
const char *set_lengths_text(const struct set *s, const struct set_plan *p, struct arena *a);

/* ------------------------------------------------------------------ shards */

enum { SET_SHARDS = 10000 /* at most */ };

struct set_shard { /* a part of a set, "i/n" with i from 1 */
    int i, n;      /* 1/1: all of it                       */
};

/* "3/7". ERR_USAGE */
bool set_shard_read(const char *text, struct set_shard *s, struct err *e);

/* to[i]: the shard of stimulus i, from 1. In the order of the names' hashes stimuli are dealt in turn: shards have
 * equal numbers, and a stimulus more moves few others. */
void set_deal(const struct set *s, int shards, int *to);

/* ------------------------------------------------------------------ the common gain */

struct set_loudest { /* of the stimuli that were added */
    double peak, rms, lufs;
    int encoding; /* the coarsest */
    bool any;     /* one that is not silent */
};

struct set_measured { /* of one stimulus at full_scale 1 */
    double peak, rms, lufs;
    int encoding;
    bool sounds; /* else the rest does not count */
};

/* lufs -infinity, encoding the finest, the rest 0. */
struct set_loudest set_loudest(void);
void set_loudest_add(struct set_loudest *l, const struct set_measured *m);

/* The largest value of an encoding. */
double set_largest(int encoding);

/* output.level.full_scale of the whole set (set_waits). 1 if all are silent. ERR_SCENE: the loudness of none can be
 * measured */
bool set_gain(const struct set *s, const struct set_loudest *l, double *full_scale, struct err *e);

#endif
