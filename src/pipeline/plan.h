/* Which stages a contact runs: those the scene wants and whose results something later needs. */
#ifndef PIPELINE_PLAN_H
#define PIPELINE_PLAN_H
#include <stdio.h>

#include "base/arena.h"
#include "base/err.h"
#include "stage.h"

enum plan_verdict { PLAN_RUNS, PLAN_UNWANTED, PLAN_UNNEEDED };

struct plan_row {
    const struct stage *stage;
    enum plan_verdict verdict;
    unsigned reads; /* items, when it runs                                             */
    unsigned knobs; /* of scene/accuracy.def that it depends on, when it runs          */
    double work;    /* predicted cycles per audio sample while it works (one core with 256-bit vectors) */
    double once;    /* and of opening it; plan_scene                                   */
    double frames;  /* for which it works; plan_scene                                  */
};

struct plan {
    const struct contact *contact;
    unsigned targets, alive; /* items asked for; items that something reads */
    int n;
    struct plan_row *rows; /* one per stage of the table, in its order    */
};

/* What a scene asks of a contact: its sound when it has a response and a gain, with the stems that are asked for; its
   force, when that stem is asked for, also without a response; rows of diagnostics when they are asked for. A contact
   muted by gain 0 may have no targets, and then runs nothing. */
unsigned plan_targets(const struct contact *c, const struct scene *s);

/* Walks the table (ends with NULL) backwards from the targets, a compiler's liveness analysis. ERR_SCENE: nothing gives
   an item that is needed; two stages give it; nothing is asked for. */
bool plan_make(const struct stage *const *table, const struct contact *c, const struct scene *s, struct arena *a,
               struct plan *p, struct err *e);

/* Is the predicted work of every stage that runs a number? It is read from keys, and a key that is not given is NAN.
 * ERR_NUMBERS: a fault of the program. */
bool plan_known(const struct plan *p, struct err *e);

/* The knobs of scene/accuracy.def that something which runs depends on, as a set: all others change no bit. */
unsigned plan_knobs(const struct plan *p);

/* "oversampling, gain_ramp", in the table's order; "none". */
const char *plan_knobs_text(unsigned knobs, struct arena *a);

/* Predicted cycles of a stage in the whole render. */
double plan_row_cycles(const struct plan_row *r);

/* The plan as text: what runs, from what to what, at what share of the predicted cost; what does not run, and why not.
 */
void plan_print(const struct plan *p, FILE *out);

/* "an item", for messages. */
const char *plan_item(enum item item);

struct render_length { /* frames of the whole                                            */
    long motion;       /* until the last motion's end, also of a muted contact             */
    long natural;      /* with the tail of what rings                                      */
    long frames;       /* as output.duration wants it; without it the natural length       */
};

/* What a render does in no stage. */
enum plan_beside { PLAN_CHOOSES, PLAN_READS, PLAN_WRITES, PLAN_BESIDE };
extern const char *const plan_beside_does[PLAN_BESIDE];

struct plan_scene_estimate {
    const struct plan *plans; /* [s->n_contacts] */
    struct render_length length;
    double once[PLAN_BESIDE], work[PLAN_BESIDE]; /* predicted cycles, and those per audio sample, in no stage */
    double cycles;                               /* predicted, of the whole render: of one core with 256-bit vectors */
    bool sounds;                                 /* there is a WAV */
    int quantity;                                /* of the sound, enum modes_quantity; -1: not stated */
    const char **warnings;                       /* what the render warns of before its first sample; ends with NULL */
};

/* The plans of all contacts as a render would have them, after all that it does before its first sample: every file is
   there (pipeline/inputs.h), every stage can begin; and what it will cost. ERR_INPUT, ERR_SCENE and what stages give.
   Nothing is written. */
bool plan_scene(const struct scene *s, struct arena *a, struct plan_scene_estimate *x, struct err *e);

/* How long the render will be and what it will cost; as plan_scene otherwise, but a sound that is too short for its
 * level is none of its errors. What it takes to choose knobs is not known here, and counts as 0. */
bool plan_scene_estimate(const struct scene *s, struct arena *a, struct plan_scene_estimate *x, struct err *e);

/* The knobs of scene/accuracy.def that some contact's plan depends on: as the scene stands, or in one of the presets
   (which may choose other engines; one that cannot be planned counts for nothing). Responses are read, stages are not
   opened. ERR_SCENE and what reading gives: of the scene as it stands. */
bool plan_scene_knobs(const struct scene *s, struct arena *a, unsigned *knobs, struct err *e);

#endif
