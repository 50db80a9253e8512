/* A set written down, DIR/.rasp/set.json: shards leave it, so that they can be merged without the design. */
#ifndef BATCH_SET_FILE_H
#define BATCH_SET_FILE_H
#include "batch/set.h"

/* ERR_CREATE, ERR_IO */
bool set_file_save(const struct set *s, const char *path, struct err *e);

/* ERR_INPUT: it is not there; ERR_SCENE: it is no such file. */
bool set_file_load(const char *path, struct arena *a, struct set *s, struct err *e);

#endif
