/* See wav.h. libsndfile scales integers so that 2^(bits-1) is 1, which is exact in double. */
#include <errno.h>
#include <math.h>
#include <sndfile.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "file/wav.h"
#include "file/wav_check.h"

static int integer_bits(int format)
{
    switch (format & SF_FORMAT_SUBMASK) {
    case SF_FORMAT_PCM_S8:
    case SF_FORMAT_PCM_U8:
        return 8;
    case SF_FORMAT_PCM_16:
        return 16;
    case SF_FORMAT_PCM_24:
        return 24;
    case SF_FORMAT_PCM_32:
        return 32;
    default:
        return 0;
    }
}

/* A hostile header may claim more than any machine holds; no encoding gets 32768 samples out of a byte. */
static bool check_info(const char *path, const SF_INFO *i, struct err *e)
{
    struct stat s;
    if (i->frames <= 0) return err_set(e, ERR_SCENE, "%s: has no samples: name another file", path);
    if (stat(path, &s) != 0 || (double)i->frames * i->channels > 32768.0 * (double)s.st_size)
        return err_set(e, ERR_SCENE, "%s: its header says %lld frames, more than the file can hold", path,
                       (long long)i->frames);
    return true;
}

static bool check_finite(const char *path, const struct wav *w, struct err *e)
{
    for (size_t i = 0; i < w->frames * (size_t)w->channels; i++)
        if (!isfinite(w->x[i]))
            return err_set(e, ERR_SCENE, "%s: frame %zu, channel %d: %g is not finite: mend it", path,
                           i / (size_t)w->channels, (int)(i % (size_t)w->channels) + 1, w->x[i]);
    return true;
}

static bool read_samples(const char *path, SNDFILE *f, struct wav *w, struct err *e)
{
    sf_count_t got = sf_readf_double(f, w->x, (sf_count_t)w->frames);
    if (got != (sf_count_t)w->frames)
        return err_set(e, ERR_SCENE, "%s: ends at frame %lld of %zu", path, (long long)got, w->frames);
    return check_finite(path, w, e);
}

bool wav_read(const char *path, struct arena *a, struct wav *w, struct err *e)
{
    SF_INFO i = {0};
    if (!wav_check(path, e)) return false;
    memory_spare(1 << 16); /* libsndfile 1.2 writes through a null pointer where it cannot note a WAV's chunks */
    errno = 0;
    SNDFILE *f = sf_open(path, SFM_READ, &i);
    if (!f)
        return errno == ENOMEM
                   ? err_set(e, ERR_MEMORY, "%s: out of memory", path)
                   : err_set(e, ERR_SCENE, "%s: is not a sound file that can be read: %s", path, sf_strerror(NULL));
    bool ok = check_info(path, &i, e);
    if (ok) {
        *w = (struct wav){
            .rate = i.samplerate, .channels = i.channels, .frames = (size_t)i.frames, .bits = integer_bits(i.format)};
        w->x = ARENA_TAKE(a, double, w->frames *(size_t)w->channels);
        ok = read_samples(path, f, w, e);
    }
    sf_close(f);
    return ok;
}
