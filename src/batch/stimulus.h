/* One stimulus of a set: whether it is there as it should be, and making it.

   The key of a stimulus is the SHA-256 of all that made it: the format of records, the program, whether and how the
   gain waits for the set, and the effective scene, whose files are named as seen from the design and stand there with
   their hashes. Its name, the folder, the gain of the whole set are not in it.

   A stimulus is there if its record has that key and each of its files has its size and, if the last run ended well and
   the file is older than the record, needs no further look, or its hash.

   Making one: all files are complete before any has its name; then a record says what is about to happen
   (RECORD_MAKING), the files get their names, those of before that are not written any more go unless somebody changed
   them, and the record is done. Whoever is killed in between leaves a record that is not right, and no file that none
   lists.

   Where the gain waits for the whole set (a common peak, rms or loudness), the sound is rendered at full_scale 1 to
   float64 in DIR/.rasp/raw. With F the full_scale, r a raw sample and g = 1/F as a render has it (output/sound.c), a
   sample of the file is g r, rounded once to the encoding: the same two operations on the same numbers as in a render
   of the effective scene. */
#ifndef BATCH_STIMULUS_H
#define BATCH_STIMULUS_H
#include "batch/record.h"
#include "batch/set.h"

struct stimulus_set { /* what all stimuli are made with; several threads read it */
    const struct set *set;
    const char *folder;
    const char *seen_from;         /* folder_place */
    struct file_cache *file_cache; /* what stimuli share of their inputs */
    const struct folder_inputs *inputs;
    bool unfinished; /* the last run did not end well: each file is hashed */
    bool read_only;  /* nothing is written, not even the time of a record */
};

enum stimulus_state {
    STIMULUS_THERE,
    STIMULUS_NEW,  /* there is no record */
    STIMULUS_KEY,  /* it was made from something else */
    STIMULUS_FILE, /* a file of it is missing, or was changed */
    STIMULUS_GAIN  /* it waits for the gain of the set, or has another */
};

/* "there", "new", "key", "file", "gain" */
extern const char *const stimulus_states[];

struct stimulus { /* what became of one */
    enum stimulus_state state;
    bool made;  /* by this run */
    bool waits; /* for its gain */
    struct set_measured measured;
    double full_scale; /* that it has of the set; NAN: none */
    double wall, cpu;  /* s that it took, if it was made */
    const char *key;   /* in the arena that was given */
};

/* Only looks. ERR_INPUT, ERR_SCENE: it cannot be known */
bool stimulus_look(const struct stimulus_set *k, int i, struct arena *a, struct stimulus *s, struct err *e);

enum stimulus_how { STIMULUS_IF_NEEDED, STIMULUS_ANEW, STIMULUS_NEVER /* what is not there s->state tells */ };

/* Makes it. If it is there, and the design lies elsewhere by now, its scene and its record are written again. ERR_SCENE
 * and what rendering gives; s->key is set if it is known. */
bool stimulus_make(const struct stimulus_set *k, int i, enum stimulus_how how, struct arena *a, struct stimulus *s,
                   struct err *e);

/* Gives it the gain of the whole set, from its raw sound; if that is not there any more it is rendered again (`render`;
   else ERR_INPUT). It must be what the gain was found with: ERR_INPUT. ERR_SCENE: it clips. */
bool stimulus_level(const struct stimulus_set *k, int i, double full_scale, bool render, struct arena *a,
                    struct stimulus *s, struct err *e);

#endif
