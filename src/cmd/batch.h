/* What `rasp batch` and `rasp merge` say of a set. */
#ifndef CMD_BATCH_H
#define CMD_BATCH_H
#include <jansson.h>

#include "batch/batch.h"
#include "cmd/cmd.h"

/* Failures of single stimuli, each error once, and remarks of those that were rendered now, as errors and warnings. */
void batch_tell(struct cmd_call *c, const char *command, const struct results *all);

/* What is too much to be told one by one, as an error. */
void batch_tell_more(struct cmd_call *c, const char *command, enum err_kind kind, const char *text);

/* {"stimuli": 6, "ok": 6, "failed": [{"stimulus": ..., "code": 70, "error": ...}], ...} */
json_t *batch_json(const struct set *s, const struct outcome *outcomes, double full_scale);

/* --jobs: 0 or none: as many as there are cores. ERR_USAGE */
bool batch_threads(const struct cmd_call *c, int *threads, struct err *e);

/* The folder of -o, without a slash at its end. */
const char *batch_folder(struct arena *a, const char *given);

/* One object on stdout. ERR_IO */
bool batch_print_json(json_t *j, struct err *e);

#endif
