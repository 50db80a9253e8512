/* What `rasp batch` and `rasp check` say of a design. */
#ifndef CMD_BATCH_H
#define CMD_BATCH_H
#include "batch/batch.h"
#include "cmd/cmd.h"

/* What is wrong with the design's own text, if anything is: *e then says that it cannot be used. */
void batch_tell_unread(struct cmd_call *c, const char *file, const struct batch_report *r, struct err *e);

/* What renders will warn of, as far as it is known beforehand. */
void batch_tell_warnings(struct cmd_call *c, const struct set_plan *p);

/* What is wrong with scenes and recordings of a set, found before any was rendered: each fault once. file: the design.
 */
void batch_tell_faults(struct cmd_call *c, const char *command, const char *file, const struct set_plan *p);

/* How many threads do best, 1 to 256. */
int batch_cores(void);

/* --jobs: none: as many as there are cores. ERR_USAGE */
bool batch_threads(const struct cmd_call *c, int *threads, struct err *e);

/* The folder of -o, without a slash at its end. */
const char *batch_folder(struct arena *a, const char *given);

#endif
