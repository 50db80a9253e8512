/* libsndfile scales integers so that 2^(bits-1) is 1, which is exact in double.

   Integers are made here, because libsndfile truncates and clips doubles: rint(x 2^(bits-1)), handed over in the upper
   bits of an int, which libsndfile shifts back. libsndfile's own RF64 with automatic downgrade is not used: it writes
   WAVE_FORMAT_EXTENSIBLE, which Python's wave module and others refuse, and a PEAK chunk with the time of day that
   cannot be switched off there. So the file starts as plain RIFF; when its samples outgrow that, they are copied to an
   RF64 file that goes on from there, and the time stamp of its PEAK chunk is put to zero at the end. */
#include "file/wav.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <sndfile.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/memory.h"
#include "base/outfile.h"
#include "base/text.h"
#include "file/bytes.h"
#include "num/lanes.h"
#include "num/real.h"

/* Bytes by which a RIFF or RF64 file is shorter than its data chunk says; 0 for other files and for a length left open
   by a program that wrote into a pipe. */
static double missing_bytes(FILE *f)
{
    unsigned char head[12], long_data[28];
    double length = 0, size, open_end = 4294967295.0;
    if (fread(head, 1, 12, f) != 12 || memcmp(head + 8, "WAVE", 4) != 0 ||
        (memcmp(head, "RIFF", 4) && memcmp(head, "RF64", 4)))
        return 0;
    while (fread(head, 1, 8, f) == 8) {
        size = (double)bytes_word(head + 4, 4);
        if (!memcmp(head, "data", 4)) {
            off_t at = ftello(f);
            fseeko(f, 0, SEEK_END);
            size = size == open_end ? length : size;
            return fmax(0, (double)at + size - (double)ftello(f));
        }
        if (!memcmp(head, "ds64", 4) && size >= 28 && fread(long_data, 1, 28, f) == 28) {
            length = (double)bytes_word(long_data + 8, 8);
            size -= 28;
        }
        if (fseeko(f, (off_t)(size + fmod(size, 2)), SEEK_CUR) != 0) break;
    }
    return 0;
}

/* libsndfile scales integers so that 2^(bits-1) is 1, which is exact in double. */

static const struct {
    int bits, format; /* below 0: of floating point */
} encodings[] = {{16, SF_FORMAT_PCM_16}, {24, SF_FORMAT_PCM_24}, {-32, SF_FORMAT_FLOAT}, {-64, SF_FORMAT_DOUBLE},
                 {32, SF_FORMAT_PCM_32}, {8, SF_FORMAT_PCM_S8},  {8, SF_FORMAT_PCM_U8}};
enum { WRITTEN = 4, ENCODINGS = sizeof encodings / sizeof encodings[0] }; /* the first of them */

/* Those whose samples are what was written. Decoders of MP3 and Opus give other bits on another CPU; and libsndfile
   looks for MP3 in all that it does not know, which a few bytes can make take for ever. */
bool wav_begins(const char head[4])
{
    static const char lossless[][5] = {"RIFF", "RIFX", "RF64", "FORM", "fLaC", ".snd", "dns.", "caff", "riff"};
    for (size_t k = 0; k < sizeof lossless / sizeof lossless[0]; k++)
        if (!memcmp(head, lossless[k], 4)) return true;
    return false;
}

bool wav_is_name(const char *file) { return text_ends(file, ".wav") || text_ends(file, ".flac"); }

static SNDFILE *sound_read(const char *path, SF_INFO *i, struct err *e)
{
    /* libsndfile shortens a truncated RIFF file without a word: the data chunk's length is held against the file's */
    struct stat s;
    bool special = stat(path, &s) == 0 && !S_ISREG(s.st_mode); /* to open a pipe is to wait for who writes into it */
    FILE *raw = special ? NULL : memory_fopen(path, "rb");
    if (!raw) {
        err_set(e, special ? ERR_INPUT : err_system(ERR_INPUT), "%s: %s", path,
                special ? "is not a file" : strerror(errno));
        return NULL;
    }
    char head[4];
    bool known = fread(head, 1, 4, raw) == 4 && wav_begins(head);
    rewind(raw);
    double missing = known ? missing_bytes(raw) : 0;
    fclose(raw);
    if (!known) {
        err_set(e, ERR_SCENE,
                "%s: is not a sound file that can be read: export it as WAV, FLAC, AIFF, AU, CAF or W64; MP3 and Ogg "
                "are not "
                "decoded alike everywhere",
                path);
        return NULL;
    }
    if (missing > 0) {
        err_set(e, ERR_SCENE, "%s: is truncated: its last %.0f bytes are missing: copy or export it again", path,
                missing);
        return NULL;
    }
    memory_available(1 << 16); /* libsndfile 1.2 writes through a null pointer where it cannot note a WAV's chunks */
    errno = 0;
    SNDFILE *f = sf_open(path, SFM_READ, i);
    if (!f && errno == ENOMEM)
        err_set(e, ERR_MEMORY, "%s: out of memory", path);
    else if (!f)
        err_set(e, ERR_SCENE, "%s: is not a sound file that can be read: %s", path, sf_strerror(NULL));
    return f;
}

bool wav_read(const char *path, struct arena *a, struct wav *w, struct err *e)
{
    SF_INFO i = {0};
    SNDFILE *f = sound_read(path, &i, e);
    struct stat s;
    bool ok = f && (i.frames > 0 || err_set(e, ERR_SCENE, "%s: has no samples: name another file", path));
    /* A hostile header may claim more than any machine holds; no encoding gets 32768 samples out of a byte. */
    if (ok && (stat(path, &s) != 0 || (double)i.frames * i.channels > 32768.0 * (double)s.st_size))
        ok = err_set(e, ERR_SCENE, "%s: its header says %lld frames, more than the file can hold", path,
                     (long long)i.frames);
    if (ok) {
        *w = (struct wav){.rate = i.samplerate, .channels = i.channels, .frames = (size_t)i.frames};
        for (int k = 0; k < ENCODINGS; k++)
            if ((i.format & SF_FORMAT_SUBMASK) == encodings[k].format && encodings[k].bits > 0)
                w->bits = encodings[k].bits;
        w->x = ARENA_TAKE(a, double, w->frames *(size_t)w->channels);
        sf_count_t got = sf_readf_double(f, w->x, i.frames);
        ok = got == i.frames || err_set(e, ERR_SCENE, "%s: ends at frame %lld of %zu", path, (long long)got, w->frames);
    }
    for (size_t k = 0; ok && k < w->frames * (size_t)w->channels; k++)
        if (!isfinite(w->x[k]))
            ok = err_set(e, ERR_SCENE, "%s: frame %zu, channel %d: %g is not finite: mend it", path,
                         k / (size_t)w->channels, (int)(k % (size_t)w->channels) + 1, w->x[k]);
    if (f) sf_close(f);
    return ok;
}

bool wav_stream_open(struct wav_stream *w, const char *path, struct err *e)
{
    SF_INFO i = {0};
    SNDFILE *f = sound_read(path, &i, e);
    *w = (struct wav_stream){f, path, i.samplerate, i.channels, (long)i.frames};
    return f;
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

enum { PIECE = 4096 /* samples converted at a time */, COPY = 1 << 16 /* bytes; at least one frame */ };

#define FULL_SCALE (1 + 1e-12) /* a peak that was asked to be 1 is 1 but for rounding */

struct wav_out {
    struct arena *arena; /* it lies in it */
    SNDFILE *sound;
    struct outfile out;
    struct wav_format format;
    const char *path;
    double frames, riff_bytes;
    bool flac;
    bool long_file; /* RF64 already */
    bool *audible;  /* [channels] */
    int silent;     /* channels */
    double beyond, peak;
};

static int encoding(int bits)
{
    for (int i = 0; i < WRITTEN; i++)
        if (encodings[i].bits == bits) return encodings[i].format;
    return 0;
}

static bool text_given(const char *s) { return s && *s; }

/* Why libsndfile did not do it: the system's reason, if there was one, is plainer than its own. */
static const char *reason(SNDFILE *sound) { return errno ? strerror(errno) : sf_strerror(sound); }

/* Says so, if that was why; returns false. */
static bool out_of_memory(const struct wav_out *w, struct err *e)
{
    return errno == ENOMEM && err_set(e, ERR_MEMORY, "%s: out of memory", w->path);
}

/* Starts a sound on w->out. */
static bool sound_open(struct wav_out *w, int container, struct err *e)
{
    const struct wav_format *f = &w->format;
    SF_INFO i = {.samplerate = (int)f->rate, .channels = f->channels, .format = container | encoding(f->bits)};
    errno = 0;
    w->sound = sf_open_fd(w->out.fd, SFM_WRITE, &i, 0);
    if (!w->sound)
        return out_of_memory(w, e) ||
               err_set(e, ERR_CREATE,
                       "%s: the sound file cannot be begun, of %d channel%s at %g Hz: %s; is the disk full, or the "
                       "size of files limited? Make room, or write elsewhere with -o",
                       w->path, f->channels, f->channels == 1 ? "" : "s", f->rate, reason(NULL));
    sf_command(w->sound, SFC_SET_ADD_PEAK_CHUNK, NULL, SF_FALSE);
    if ((text_given(f->title) && sf_set_string(w->sound, SF_STR_TITLE, f->title)) ||
        (text_given(f->comment) && sf_set_string(w->sound, SF_STR_COMMENT, f->comment)))
        return out_of_memory(w, e) || err_set(e, ERR_CREATE,
                                              "%s: the scene's title, or the comment that says the gain, cannot be "
                                              "written into the sound file: %s; shorten title, or leave it out",
                                              w->path, reason(w->sound));
    return true;
}

void wav_drop(struct wav_out *w)
{
    if (!w) return;
    if (w->sound) sf_close(w->sound);
    outfile_drop(&w->out);
    arena_close(w->arena);
}

struct wav_out *wav_create(const char *path, const struct wav_format *f, struct err *e)
{
    if (!encoding(f->bits))
        err_set(e, ERR_SCENE, "%s: %d bits: only 16 and 24 (integers), -32 and -64 (floating point) can be written",
                path, f->bits);
    else if (!(f->rate >= 1 && f->rate <= 1e7) || f->rate != floor(f->rate))
        err_set(e, ERR_SCENE, "%s: a WAV's sample rate is a whole number of Hz up to 1e7, not %.9g", path, f->rate);
    else if (text_ends(path, ".flac") && f->bits < 0)
        err_set(e, ERR_SCENE, "%s: a FLAC holds integers, of 16 or 24 bits", path);
    else if (f->channels < 1 || f->channels > 1024)
        err_set(e, ERR_SCENE, "%s: a WAV has 1 to 1024 channels, not %d", path, f->channels);
    if (e->kind) return NULL;
    struct arena *a = arena_open();
    struct wav_out *w = ARENA_TAKE(a, struct wav_out, 1);
    double header = 4096 + (double)((f->title ? strlen(f->title) : 0) + (f->comment ? strlen(f->comment) : 0));
    *w = (struct wav_out){.arena = a,
                          .format = *f,
                          .path = arena_text(a, path),
                          .flac = text_ends(path, ".flac"),
                          .riff_bytes = f->riff_bytes > 0 ? f->riff_bytes : 4294967295.0 - header,
                          .audible = ARENA_TAKE(a, bool, f->channels),
                          .silent = f->channels};
    w->format.title = f->title ? arena_text(a, f->title) : NULL;
    w->format.comment = f->comment ? arena_text(a, f->comment) : NULL;
    if (outfile_open_fd(&w->out, path, e) && sound_open(w, w->flac ? SF_FORMAT_FLAC : SF_FORMAT_WAV, e)) return w;
    wav_drop(w);
    return NULL;
}

bool wav_comment(struct wav_out *w, const char *text, struct err *e)
{
    w->format.comment = arena_text(w->arena, text);
    errno = 0;
    if (w->frames > 0 || sf_set_string(w->sound, SF_STR_COMMENT, text))
        return out_of_memory(w, e) ||
               err_set(
                   e, ERR_CREATE,
                   "%s: the comment that says the gain cannot be written into the sound file: %s; is the disk full?",
                   w->path, reason(w->sound));
    return true;
}

static bool write_failed(const struct wav_out *w, struct err *e)
{
    const char *why = reason(w->sound);
    return err_set(e, ERR_IO, "%s: cannot be written: %s", w->path, why);
}

static int frame_bytes(const struct wav_out *w) { return abs(w->format.bits) / 8 * w->format.channels; }

/* Copies the sound data of the short file `from` to w, byte by byte. */
static bool copy_data(struct wav_out *w, SNDFILE *from, struct err *e)
{
    sf_count_t frame = frame_bytes(w), most = COPY / frame * frame;
    double left = w->frames * (double)frame;
    char *piece = memory_take((size_t)most);
    bool ok = true;
    while (ok && left > 0) {
        sf_count_t n = left < (double)most ? (sf_count_t)left : most;
        errno = 0;
        if (sf_read_raw(from, piece, n) != n)
            ok = err_set(e, ERR_IO, "%s: what has been written cannot be read back", w->path);
        else if (sf_write_raw(w->sound, piece, n) != n)
            ok = write_failed(w, e);
        left -= (double)n;
    }
    free(piece);
    return ok;
}

static bool go_long(struct wav_out *w, struct err *e)
{
    SF_INFO i = {0};
    struct outfile was = w->out;
    bool closed = sf_close(w->sound) == 0;
    w->sound = NULL;
    w->long_file = true;
    if (!closed) return err_set(e, ERR_IO, "%s: cannot be written", w->path);
    if (!outfile_open_fd(&w->out, w->path, e)) {
        outfile_drop(&was);
        return false;
    }
    SNDFILE *from = lseek(was.fd, 0, SEEK_SET) == 0 ? sf_open_fd(was.fd, SFM_READ, &i, 0) : NULL;
    bool ok = from || err_set(e, ERR_IO, "%s: what has been written cannot be read back", w->path);
    ok = ok && sound_open(w, SF_FORMAT_RF64, e) && copy_data(w, from, e);
    if (from) sf_close(from);
    outfile_drop(&was);
    return ok;
}

static bool sample_bad(const struct wav_out *w, size_t i, double x, struct err *e)
{
    int channels = w->format.channels, bits = w->format.bits;
    double frame = w->frames + (double)(i / (size_t)channels), seconds = frame / w->format.rate;
    int channel = (int)(i % (size_t)channels) + 1;
    if (!isfinite(x))
        return err_set(e, ERR_NUMBERS, "%s: frame %.0f (%.6f s), channel %d: the sample is %g", w->path, frame, seconds,
                       channel, x);
    if (bits < 0)
        return err_set(e, ERR_SCENE,
                       "%s: frame %.0f (%.6f s), channel %d: %g is too large for 32-bit floating point; lower the "
                       "level, or what the force comes from",
                       w->path, frame, seconds, channel, x);
    return err_set(e, ERR_SCENE,
                   "%s: frame %.0f (%.6f s), channel %d: %.6f is %+.2f dB re full scale, beyond the range of %d-bit "
                   "integers; lower the level (a larger full_scale) or write floating point (encoding: float32)",
                   w->path, frame, seconds, channel, x, 20 * real_log10(fabs(x)), bits);
}

/* Every x rounded to nearest, ties to even, in the upper bits of y; false where one does not fit. Adding and
   subtracting 1.5 2^52 rounds what could fit, and leaves the rest too large; a call of rint for each took as long as
   all else in this file. */
LANES_CLONES
static int integers_of(const double *x, size_t n, int bits, int *y)
{
    double scale = (double)(1 << (bits - 1));
    int up = 1 << (32 - bits), bad = 0;
#pragma omp simd reduction(| : bad)
    for (size_t i = 0; i < n; i++) {
        double v = x[i] * scale + 0x1.8p52 - 0x1.8p52;
        int fits = (v >= -scale) & (v <= scale - 1);
        bad |= !fits;
        y[i] = (int)lanes_select(fits, v, 0) * up;
    }
    return !bad;
}

/* Sample i of a piece, which begins with a frame, is not 0. */
static void note_audible(struct wav_out *w, size_t i)
{
    bool *audible = &w->audible[i % (size_t)w->format.channels];
    w->silent -= !*audible;
    *audible = true;
}

LANES_CLONES
static void look_beyond(const double *x, size_t n, double *beyond, double *peak)
{
    double most = *peak, count = 0;
#pragma omp simd reduction(+ : count) reduction(max : most)
    for (size_t i = 0; i < n; i++) {
        double size = fabs(x[i]), above = size > FULL_SCALE ? size : 0;
        count += above > 0 ? 1 : 0;
        most = above > most ? above : most;
    }
    *beyond += count;
    *peak = most;
}

static bool write_integers(struct wav_out *w, const double *x, size_t n, struct err *e)
{
    int y[PIECE];
    if (!integers_of(x, n, w->format.bits, y)) {
        size_t i = 0;
        while (integers_of(x + i, 1, w->format.bits, y))
            i++;
        return sample_bad(w, i, x[i], e);
    }
    for (size_t i = 0; w->silent && i < n; i++)
        if (y[i]) note_audible(w, i);
    errno = 0;
    return sf_write_int(w->sound, y, (sf_count_t)n) == (sf_count_t)n || write_failed(w, e);
}

static bool write_floats(struct wav_out *w, const double *x, size_t n, struct err *e)
{
    double y[PIECE], most = w->format.bits == -32 ? FLT_MAX : DBL_MAX;
    for (size_t i = 0; i < n; i++) {
        if (!(fabs(x[i]) <= most)) return sample_bad(w, i, x[i], e);
        y[i] = w->format.bits == -32 ? (float)x[i] : x[i];
    }
    for (size_t i = 0; w->silent && i < n; i++)
        if (y[i] != 0) note_audible(w, i);
    look_beyond(y, n, &w->beyond, &w->peak);
    errno = 0;
    return sf_write_double(w->sound, y, (sf_count_t)n) == (sf_count_t)n || write_failed(w, e);
}

bool wav_write(struct wav_out *w, const double *x, size_t frames, struct err *e)
{
    size_t channels = (size_t)w->format.channels, most = PIECE / channels;
    if (!w->flac && !w->long_file && (w->frames + (double)frames) * frame_bytes(w) > w->riff_bytes && !go_long(w, e))
        return false;
    for (size_t done = 0, n; done < frames; done += n) {
        n = frames - done < most ? frames - done : most;
        if (!(w->format.bits > 0 ? write_integers : write_floats)(w, x + done * channels, n * channels, e))
            return false;
        w->frames += (double)n;
    }
    return true;
}

struct wav_written wav_written(const struct wav_out *w)
{
    return (struct wav_written){w->format.channels, w->frames, w->audible, w->beyond, w->peak};
}

bool wav_written_audible(const struct wav_written *w)
{
    for (int k = 0; k < w->channels; k++)
        if (w->audible[k]) return true;
    return false;
}

bool wav_finish(struct wav_out *w, struct err *e)
{
    if (!w->sound) return true;
    errno = 0;
    bool ok = sf_error(w->sound) == 0 || write_failed(w, e);
    if (sf_close(w->sound) != 0) ok = err_set(e, ERR_IO, "%s: cannot be written", w->path);
    w->sound = NULL;
    /* the time stamp of an RF64 file's PEAK chunk becomes zero: behind "RF64", size, "WAVE" come chunks of name, size,
       content */
    unsigned char head[8], zero[4] = {0};
    for (off_t at = 12; ok && w->long_file && pread(w->out.fd, head, 8, at) == 8 && memcmp(head, "data", 4) != 0;) {
        off_t size = (off_t)bytes_word(head + 4, 4);
        if (!memcmp(head, "PEAK", 4) && pwrite(w->out.fd, zero, 4, at + 12) != 4) ok = write_failed(w, e);
        at += 8 + size + size % 2;
    }
    return ok && outfile_finalise(&w->out, e);
}

const char *wav_temporary(const struct wav_out *w) { return w->out.temporary; }

bool wav_commit(struct wav_out *w, struct err *e)
{
    bool ok = wav_finish(w, e) && outfile_commit(&w->out, e);
    wav_drop(w);
    return ok;
}
