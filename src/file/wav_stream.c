/* See wav_stream.h. */
#include "file/wav_stream.h"

#include <errno.h>
#include <sndfile.h>

#include "base/memory.h"
#include "file/wav_check.h"

bool wav_stream_open(struct wav_stream *w, const char *path, struct err *e)
{
    SF_INFO i = {0};
    *w = (struct wav_stream){.path = path};
    if (!wav_check(path, e)) return false;
    memory_spare(1 << 16); /* see wav_read.c */
    errno = 0;
    SNDFILE *f = sf_open(path, SFM_READ, &i);
    if (!f && errno == ENOMEM) return err_set(e, ERR_MEMORY, "%s: out of memory", path);
    if (!f) return err_set(e, ERR_SCENE, "%s: is not a sound file that can be read: %s", path, sf_strerror(NULL));
    *w = (struct wav_stream){f, path, i.samplerate, i.channels, (long)i.frames};
    return true;
}

bool wav_stream_read(struct wav_stream *w, double *x, long most, long *n, struct err *e)
{
    long wanted = w->frames < most ? w->frames : most;
    *n = wanted > 0 ? (long)sf_readf_double(w->file, x, wanted) : 0;
    w->frames -= *n;
    return *n == wanted || err_set(e, ERR_SCENE, "%s: ends %ld frames before its header says", w->path, w->frames);
}

void wav_stream_close(struct wav_stream *w)
{
    if (w->file) sf_close(w->file);
    w->file = NULL;
}
