/* The files of a stimulus whose raw sound gets its gain: each made beside its raw file, none with a name before all are complete. */
#ifndef BATCH_LEVEL_FILES_H
#define BATCH_LEVEL_FILES_H
#include "base/outfile.h"
#include "batch/job.h"
#include "file/wav.h"
#include "scene/scene.h"

struct level_files {
    const char *folder;
    const struct record *record;  /* with raw files, and the gain that it gets */
    struct scene scene;           /* as it will be effective */
    struct record_file *made;     /* [n], as they will be */
    const char **raw, **paths;    /* [n] */
    struct wav_out **sounds;      /* [n]; NULL: none */
    struct outfile *texts;        /* [n]; fd < 0 and no target: none */
    int n, told;                  /* remarks of the raw sound */
    struct arena *arena;
};

/* ERR_INPUT, ERR_SCENE (clips), ERR_CREATE, ERR_IO */
bool level_files_make(struct level_files *f, const struct job_kit *k, struct record *r, struct arena *a, struct err *e);

/* Gives them their names; tables, which no gain changes, are moved. ERR_IO */
bool level_files_commit(struct level_files *f, struct err *e);

void level_files_drop(struct level_files *f);   /* of what is not committed */
void level_files_forget(struct level_files *f); /* takes the raw files away */

#endif
