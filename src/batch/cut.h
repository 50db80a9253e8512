/* A recording as it will lie in its file: cut to a length under a ramp, or continued by silence; read piece by piece. */
#ifndef BATCH_CUT_H
#define BATCH_CUT_H
#include "file/wav_stream.h"

struct cut_form {
    double seconds;      /* NAN: its own length */
    double ramp;         /* s, raised cosine, at the end of one that is cut; at most half of what is left */
};

struct cut {
    struct wav_stream in;
    long own, frames;    /* what it has, and what is read of it or after it */
    long ramp, done;
    double end, before;  /* of what was read: greatest magnitude where the ramp is (without one, of the last sample), before it; and of all, before it */
};

/* form NULL: as it is. path must live as long. As wav_stream_open. */
bool cut_open(struct cut *c, const char *path, const struct cut_form *form, struct err *e);

/* The next frames [n][in.channels] of at most `most`; *n 0 at the end. As wav_stream_read. */
bool cut_read(struct cut *c, double *x, long most, long *n, struct err *e);

void cut_close(struct cut *c);

#endif
