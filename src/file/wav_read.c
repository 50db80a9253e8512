/* See wav.h. libsndfile scales integers so that 2^(bits-1) is 1, which is exact in double. It shortens a truncated RIFF file
   without a word, so the data chunk's length is held against the file's length here. */
#include <errno.h>
#include <math.h>
#include <sndfile.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "file/wav.h"

static int integer_bits(int format)
{
    switch (format & SF_FORMAT_SUBMASK) {
    case SF_FORMAT_PCM_S8:
    case SF_FORMAT_PCM_U8: return 8;
    case SF_FORMAT_PCM_16: return 16;
    case SF_FORMAT_PCM_24: return 24;
    case SF_FORMAT_PCM_32: return 32;
    default: return 0;
    }
}

static double little_endian(const unsigned char *p, int n)
{
    double v = 0;
    while (n-- > 0)
        v = 256 * v + p[n];
    return v;
}

/* Bytes by which a RIFF or RF64 file is shorter than its data chunk says; 0 for other files and for a length left open by a
   program that wrote into a pipe. */
static double missing_bytes(FILE *f)
{
    unsigned char head[12], long_data[28];
    double length = 0, size, open_end = 4294967295.0;
    if (fread(head, 1, 12, f) != 12 || memcmp(head + 8, "WAVE", 4) != 0 || (memcmp(head, "RIFF", 4) && memcmp(head, "RF64", 4)))
        return 0;
    while (fread(head, 1, 8, f) == 8) {
        size = little_endian(head + 4, 4);
        if (!memcmp(head, "data", 4)) {
            off_t at = ftello(f);
            fseeko(f, 0, SEEK_END);
            size = size == open_end ? length : size;
            return fmax(0, (double)at + size - (double)ftello(f));
        }
        if (!memcmp(head, "ds64", 4) && size >= 28 && fread(long_data, 1, 28, f) == 28) {
            length = little_endian(long_data + 8, 8);
            size -= 28;
        }
        if (fseeko(f, (off_t)(size + fmod(size, 2)), SEEK_CUR) != 0)
            break;
    }
    return 0;
}

static bool check_file(const char *path, struct err *e)
{
    struct stat s;
    FILE *f = fopen(path, "rb");
    if (!f)
        return err_set(e, ERR_INPUT, "%s: %s", path, strerror(errno));
    bool is_file = fstat(fileno(f), &s) == 0 && S_ISREG(s.st_mode);
    double missing = is_file ? missing_bytes(f) : 0;
    fclose(f);
    if (!is_file)
        return err_set(e, ERR_INPUT, "%s: is not a file", path);
    if (missing > 0)
        return err_set(e, ERR_SCENE, "%s: is truncated: its last %.0f bytes are missing", path, missing);
    return true;
}

/* A hostile header may claim more than any machine holds; no encoding gets 32768 samples out of a byte. */
static bool check_info(const char *path, const SF_INFO *i, struct err *e)
{
    struct stat s;
    if (i->frames <= 0)
        return err_set(e, ERR_SCENE, "%s: has no samples", path);
    if (stat(path, &s) != 0 || (double)i->frames * i->channels > 32768.0 * (double)s.st_size)
        return err_set(e, ERR_SCENE, "%s: its header says %lld frames, more than the file can hold", path, (long long)i->frames);
    return true;
}

static bool check_finite(const char *path, const struct wav *w, struct err *e)
{
    for (size_t i = 0; i < w->frames * (size_t)w->channels; i++)
        if (!isfinite(w->x[i]))
            return err_set(e, ERR_SCENE, "%s: frame %zu, channel %d: %g is not finite", path, i / (size_t)w->channels,
                           (int)(i % (size_t)w->channels) + 1, w->x[i]);
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
    if (!check_file(path, e))
        return false;
    SNDFILE *f = sf_open(path, SFM_READ, &i);
    if (!f)
        return err_set(e, ERR_SCENE, "%s: is not a sound file that can be read: %s", path, sf_strerror(NULL));
    bool ok = check_info(path, &i, e);
    if (ok) {
        *w = (struct wav){.rate = i.samplerate, .channels = i.channels, .frames = (size_t)i.frames, .bits = integer_bits(i.format)};
        w->x = ARENA_TAKE(a, double, w->frames * (size_t)w->channels);
        ok = read_samples(path, f, w, e);
    }
    sf_close(f);
    return ok;
}
