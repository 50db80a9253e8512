/* What `rasp batch` and `rasp merge` say of a set. */
#ifndef CMD_BATCH_H
#define CMD_BATCH_H
#include <jansson.h>

#include "batch/batch.h"
#include "cmd/cmd.h"

/* Failures of single stimuli, each error once, and remarks of those that were rendered now, as errors and warnings. file: the design's, NULL: not known. */
void batch_tell(struct cmd_call *c, const char *command, const char *file, const struct results *all);

/* What is wrong with the design's own text, if anything is: *e then says that it cannot be used. */
void batch_tell_unread(struct cmd_call *c, const char *file, const struct batch_report *r, struct err *e);

/* What renders will warn of, as far as it is known beforehand. */
void batch_tell_remarks(struct cmd_call *c, const struct prepare *p);

/* What is wrong with scenes and recordings of a set, found before any was rendered: each fault once. file: the design. */
void batch_tell_faults(struct cmd_call *c, const char *command, const char *file, const struct prepare *p);

/* What is too much to be told one by one, as an error. */
void batch_tell_more(struct cmd_call *c, const char *command, enum err_kind kind, const char *text);

/* What is left over in the folder, as a warning. */
void batch_tell_left(struct cmd_call *c, const char *folder, const struct leftover *l);

/* {"stimuli": 6, "ok": 6, "failed": [{"stimulus": ..., "code": 70, "error": ...}], ...} */
json_t *batch_json(const struct set *s, const struct outcome *outcomes, double full_scale);

/* Their names. */
json_t *batch_left_json(const struct leftover *l);

/* How many threads do best, 1 to 256. */
int batch_cores(void);

/* --jobs: none: as many as there are cores. ERR_USAGE */
bool batch_threads(const struct cmd_call *c, int *threads, struct err *e);

/* The folder of -o, without a slash at its end. */
const char *batch_folder(struct arena *a, const char *given);

/* One object on stdout. ERR_IO */
bool batch_print_json(json_t *j, struct err *e);

#endif
