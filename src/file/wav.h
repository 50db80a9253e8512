/* Sound files through libsndfile: whole-file reading, streamed writing under a name that appears only when it is
 * complete. */
#ifndef FILE_WAV_H
#define FILE_WAV_H
#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/err.h"

struct wav {
    double rate; /* Hz                                                     */
    int channels;
    size_t frames;
    double *x; /* [frames][channels]; integers scaled so that 2^(bits-1) = 1 */
    int bits;  /* 8, 16, 24, 32 of an integer file; 0: anything else     */
};

/* Is that how a sound file begins that can be read here: WAV, RF64, AIFF, FLAC, AU, CAF, W64? */
bool wav_begins(const char head[4]);

/* Is the file called as the sounds are that are written here: .wav or .flac? */
bool wav_is_name(const char *file);

/* Whatever libsndfile reads. Errors: ERR_INPUT missing or unreadable, ERR_SCENE not a sound file, truncated, no
   samples, or not finite. */
bool wav_read(const char *path, struct arena *a, struct wav *w, struct err *e);

struct wav_out;

struct wav_format {
    double rate;
    int channels, bits;          /* bits 16 or 24: PCM; -32 or -64: floating point */
    const char *title, *comment; /* INAM and ICMT; NULL: none             */
    double riff_bytes; /* samples beyond this make it RF64; 0: as late as RIFF allows, 4 GiB less the header (tests set
                          it) */
};

/* Opens at once (so that a path that cannot be written fails before any work), writes frames [n][channels], and gives
   the file its name in wav_commit; wav_drop leaves nothing. PCM is rounded to nearest, ties to even, from x 2^(bits-1);
   a sample beyond the integer range is an error (ERR_SCENE: says which and by how many dB), never clipped; one that is
   not finite is ERR_NUMBERS. A name that ends in .flac is a FLAC: the same samples, in the bytes of a version of
   libFLAC, which names itself. A WAV has no PEAK chunk and no dates: same samples, same bytes. Plain RIFF; beyond 4 GiB
   RF64. Other errors: ERR_CREATE, ERR_IO, ERR_SCENE (a format that cannot be). After an error only wav_drop may follow;
   commit and drop free w. */
struct wav_out *wav_create(const char *path, const struct wav_format *f, struct err *e);

bool wav_write(struct wav_out *w, const double *x, size_t frames, struct err *e);

/* Sets the comment (ICMT) before the first frame is written. */
bool wav_comment(struct wav_out *w, const char *text, struct err *e);

/* What the samples are that have been written, as the file holds them: rounded to its encoding. */
struct wav_written {
    int channels;
    double frames;
    const bool *audible; /* [channels] some sample of it is not 0; lasts as long as w */
    double beyond, peak; /* samples beyond full scale (of floating point, by more than 1e-12 of it), and the greatest of
                            them; 0: none */
};

struct wav_written wav_written(const struct wav_out *w);

bool wav_written_audible(const struct wav_written *w); /* some sample of any channel is not 0 */

bool wav_finish(struct wav_out *w, struct err *e); /* as outfile_finalise */

const char *wav_temporary(const struct wav_out *w); /* where it lies once it is settled, until it is committed */

bool wav_commit(struct wav_out *w, struct err *e);

void wav_drop(struct wav_out *w);

/* A sound file read piece by piece, so that memory does not grow with it. */
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
