/* A sound file read piece by piece, so that memory does not grow with it. */
#ifndef FILE_WAV_STREAM_H
#define FILE_WAV_STREAM_H
#include <stdbool.h>

#include "base/err.h"

struct wav_stream {
    void *file;       /* SNDFILE */
    const char *path; /* must live as long */
    double rate;      /* Hz */
    int channels;
    long frames;
};

/* ERR_INPUT, ERR_SCENE as wav_read: a truncated file is refused. */
bool wav_stream_open(struct wav_stream *w, const char *path, struct err *e);

/* The next frames [n][channels] of at most `most`; *n 0 at the end. ERR_SCENE: fewer than the header says. */
bool wav_stream_read(struct wav_stream *w, double *x, long most, long *n, struct err *e);
void wav_stream_close(struct wav_stream *w);

#endif
