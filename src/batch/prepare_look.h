/* One stimulus, looked at before anything of its set is rendered: its scene is read, its inputs are opened, its length and cost are known. */
#ifndef BATCH_PREPARE_LOOK_H
#define BATCH_PREPARE_LOOK_H
#include "base/shelf.h"
#include "batch/design.h"
#include "batch/set.h"

struct prepare_trial {       /* of one scene, until it is taken; it lies in its own arena */
    struct arena *arena;
    const struct diag *diag;
    const char *messages;    /* as of scene_read */
    struct scene scene;
    char sha256[HASH_TEXT];  /* of what the scene means */
    struct err e;            /* none: it can be rendered */
    const char **warnings;   /* of what is opened; ends with NULL, NULL: not known */
};

struct prepare_look {
    struct prepare_trial *trial; /* NULL: not begun, or taken */
    int fault;               /* from 1; 0: it can be rendered */
    double seconds, cost, rate, ramp;
    int channels, encoding, bits;
    int quantity;            /* of the sound, enum modes_quantity; -1: not stated */
    bool sounds, loud;       /* loud: its level is a loudness */
    bool brief;              /* found to be too short for that */
    bool otherwise;          /* found to be of another form than the set's sounds */
    bool drawn;              /* its seed says where it goes, too, as a scribble's does: replicates differ in more than their noise */
};

struct prepare_view {        /* what all stimuli are looked at with */
    const struct design *design;
    const struct set *set;
    struct shelf *shelf;
};

struct prepare_trial *prepare_look_open(void); /* empty; arena_close(its arena) ends it */

/* Fills in a stimulus that is no recording; l->trial says what is wrong with it. */
void prepare_look_at(const struct prepare_view *v, int i, struct prepare_look *l);

/* Is a sound of so many seconds, looked at before, too short for the loudness that is asked of it? */
bool prepare_look_is_short(const struct prepare_look *l, double seconds);

/* Then l->trial says so. */
void prepare_look_short(const struct prepare_view *v, int i, double seconds, struct prepare_look *l);

struct prepare_form {        /* what the sounds of a set have in common: that of the first of them, and of the first that says its quantity; NULL: none yet */
    const struct prepare_look *first, *stated;
    const char *first_name, *stated_name;
};

/* Is it of another rate, of another number of channels, or, where one gain is common to all, in another quantity? Then l->trial says so. A stimulus that makes no sound is of no form. */
bool prepare_look_otherwise(const struct prepare_view *v, int i, const struct prepare_form *f, struct prepare_look *l);

#endif
