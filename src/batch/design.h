/* A design: the YAML that says which stimuli a set has (rasp-design(5)), and its stimuli, each a scene of its own.

   Reading it gives everything that follows from the text alone: factors and levels, cells without the excluded ones,
   replicates, seeds, names and the order. The scenes are read one at a time (design_scene), so that memory does not
   grow with a set's size. */
#ifndef BATCH_DESIGN_H
#define BATCH_DESIGN_H
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "base/arena.h"
#include "base/err.h"
#include "base/hash.h"
#include "scene/scene.h"

struct design_level {
    const char *label; /* in names and lists: its text, or what the design calls it                     */
    const char *value; /* in the manifest's column: the number in the column's unit, or the label        */
    const char **set;  /* "motion.rate=3 Hz": what it lays over the base scene, in order; ends with NULL.
                          NULL: the label alone is the value of the factor's key (design_made.c)        */
    const char *base;  /* a scene that takes the place of the design's; NULL: none does                 */
    const char *text;  /* what the stimulus' text says of it (YAML: text); NULL: its label              */
    bool recorded;     /* only recordings have it (YAML: of: recordings): no cell is crossed with it     */
};

struct design_factor {
    const char *name;    /* a dotted key of the scene, or a word                                          */
    const char *column;  /* of the manifest: lower_snake with its unit's suffix, "motion_rate_hz"          */
    const char *unit;    /* "Hz"; NULL: none, or words                                                    */
    const char *meaning; /* for the side-car; NULL: none                                                  */
    bool independent;    /* its levels take part in the noise seed                                        */
    bool numbers;        /* all levels' values are */
    bool drawn;          /* each sample has a level of its own that is drawn                               */
    const char *rule;    /* of the levels that nobody wrote out, "uniform from 1 Hz to 4 Hz"; NULL: they are listed */
    struct design_level *levels;
    int n_levels;
};

struct design_stimulus {
    const char *name;  /* its files' name without ending: [0-9A-Za-z+_.-] and / for folders             */
    int *level;        /* [n_factors]; -1: a recording that has no level of that factor                  */
    int replicate;     /* from 1                                                                        */
    int sample;        /* from 1; 0: nothing is drawn                                                   */
    long cell;         /* from 0, in the order of the design (names count from 1); replicates of a cell share it */
    uint64_t seed;     /* of its scene: a hash of the design's seed, the replicate, the sample, and independent factors'
                         labels */
    const char *split; /* "train"; NULL: the set is not divided */
    const char *recording; /* a WAV that is taken as it is; NULL: it is rendered                            */
};

enum design_level_rule { DESIGN_LEVEL_COMMON, DESIGN_LEVEL_EACH, DESIGN_LEVEL_SCENE };
enum design_length_rule { DESIGN_LENGTH_LONGEST, DESIGN_LENGTH_FIXED, DESIGN_LENGTH_OWN };

enum design_task { DESIGN_TASK_RATE, DESIGN_TASK_CHOOSE, DESIGN_TASK_COMPARE };
enum design_role { DESIGN_ROLE_TEST, DESIGN_ROLE_REFERENCE, DESIGN_ROLE_ANCHOR };

extern const char *const design_trials_tasks[], *const design_trials_roles[]; /* their words; end with NULL */

struct design_answer {
    const char *label, *text; /* in tables; for those who listen */
};

struct design_trials {                   /* what listeners do with the stimuli (YAML: trials)              */
    enum design_task task;               /* rate: each sound of a trial; choose: an answer; compare: two sounds  */
    const char *question, *instructions; /* NULL: none                                                           */
    bool *within;                        /* [n_factors] differ within a trial                                    */
    int asked;                           /* the factor whose level is the right answer; -1: none                 */
    struct design_answer *answers;       /* of RATE: words of the scale, from 0 to 100 at equal distances        */
    int n_answers;
    int session, block;      /* factors whose levels are in different sessions, blocks; -1: none                 */
    int training;            /* trials that are drawn to begin each session with                                 */
    enum design_role *roles; /* [n_stimuli] what each is for                                                     */
    bool *for_training;      /* [n_stimuli] it is in trials of training alone                                    */
};

struct design {
    const char *file, *title;
    uint64_t seed;
    const char *base; /* path as seen from here; NULL: every level of some factor has its own          */
    const char **set; /* laid over every scene, before the levels'; ends with NULL                      */
    struct design_factor *factors;
    int n_factors;
    int replicates;
    int samples;              /* of each cell; 0: nothing is drawn                                           */
    bool samples_independent; /* the sample's number takes part in the noise seed                             */
    const char **splits;      /* names of the parts that the set is divided into; ends with NULL. NULL: it is not */
    const char *text;         /* template of the stimuli's texts, "{motion} of a {scraper}." (YAML: text); NULL: none */
    struct design_stimulus *stimuli; /* in the order of presentation                                         */
    int n_stimuli;
    bool shuffled; /* by order_seed; else the stimuli are in the order of the design                */
    uint64_t order_seed;
    int level_rule; /* enum design_level_rule. COMMON: one gain, such that the greatest peak (or rms, or loudness) of
                       the set is level's */
    struct level level; /* of scene.h: exactly one of peak, rms, lufs, full_scale, dbfs_at_1_pa           */
    int length_rule;    /* enum design_length_rule                                                       */
    double length;      /* s, of FIXED                                                                   */
    const struct design_trials *trials; /* NULL: the design has none                                          */
    const char **sources;   /* every text file that was read for the design; ends with NULL                   */
    char sha256[HASH_TEXT]; /* of what the design means: two designs that differ in comments alone share it   */
    const struct design_texts *texts; /* of design.c                                                          */
    const struct diag *diag; /* what design_read reported, as of struct scene; a stimulus's scene has its own     */
};

/* Reads and checks a design: its form, its keys against the scene's (factors that are dotted keys must be keys of
   scenes), names that are distinct and stay within the output folder. No scene is read. Messages as of scene_read.
   ERR_INPUT, ERR_SCENE. */
bool design_read(const char *file, struct arena *a, struct design *d, const char **messages, struct err *e);

/* The scene of stimulus i, with the design's level and length not yet laid over it (they may depend on the whole set):
   base, set, levels, seed. Errors are reported with the place in the design where what is wrong comes from. ERR_USAGE:
   a recording has none. */
bool design_scene(const struct design *d, int i, struct arena *a, struct scene *s, const char **messages,
                  struct err *e);

/* Puts the place at which the design names recording i before an error that is about it; returns false. */
bool design_scene_recording(const struct design *d, int i, struct err *e);

/* Where the design's level and length stand, where it gives them, for a scene that they are laid over: errors are
   reported with those places. */
void design_scene_places(const struct design *d, struct scene *s, struct arena *a);

/* A level's label in stimulus i, or what the manifest has in the factor's column; "n/a" where it has none. */
const char *design_label(const struct design *d, int i, int factor);
const char *design_value(const struct design *d, int i, int factor);

/* What the stimulus is for those who listen: the design's text with each {factor} replaced by its level's text, and
   {replicate}; a recording may have its own (text:). NULL: the design has none, or a factor that it names has no level
   here. */
const char *design_text(const struct design *d, int i, struct arena *a);

/* The stimuli, one a line under a head: number, name, labels of the factors, replicate, seed, recording. For people
 * (rasp batch --dry-run). mine: [n_stimuli] those that are listed; NULL: all. states: [n_stimuli] a word of each; NULL:
 * none. */
void design_print(const struct design *d, const bool *mine, const char *const *states, FILE *f);

/* Has the file's text a top-level key rasp-design? False: it has none, or cannot be read. */
bool design_is(const char *file);

#endif
