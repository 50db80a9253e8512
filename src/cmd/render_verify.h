/* rasp render --verify: what was kept of the accuracy that was asked for. */
#ifndef CMD_RENDER_VERIFY_H
#define CMD_RENDER_VERIFY_H
#include "cmd/cmd.h"
#include "pipeline/render.h"

/* Renders the scene twice more, each in a process of its own and as doubles: with the knobs that it was rendered with, and with the reference's (preset reference, or
   twice as fine as those); adds a note and, in the summary on disk and in the report, accuracy.measured_db: their difference over the reference, rms, in dB.
   The note says of which knobs there is nothing twice as fine, so that their error is not or not wholly in it. ERR_DIFFERS: it is more than accuracy.error; the files stay. Else as renders. */
bool render_verify(struct cmd_call *c, const char *file, const struct scene *asked, struct render_report *r, struct err *e);

#endif
