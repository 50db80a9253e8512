/* One WAV on its way: ramps at both ends, an envelope, measures of each channel, and samples that wait in an unnamed
   file while the gain is not known. What the sound (sound.h) and its stems (stems.h) share. */
#ifndef OUTPUT_TRACK_H
#define OUTPUT_TRACK_H
#include <stdbool.h>
#include <stdio.h>

#include "base/arena.h"
#include "base/err.h"
#include "file/wav.h"

enum { TRACK_CHUNK = 4096 }; /* samples */

struct track_format {
    double rate;       /* Hz */
    int bits;          /* as wav_format                                                   */
    int places;        /* channels of what comes in                                       */
    int channels;      /* of the file: as many, or copies of the only one                 */
    long frames, ramp; /* in all; of each ramp, at most half of all                       */
    double recede;     /* of the envelope, see track.c; 0: none                           */
    bool waits;        /* the gain comes with track_finish: until then samples are kept   */
    const char *title; /* NULL: none */
    const char *key;   /* what to change when it clips: "output.level.peak"               */
};

struct track {
    struct track_format format;
    struct wav_out *wav;
    FILE *spool; /* NULL: it does not wait */
    long done;   /* frames */
    double gain;
    double *peak, *squares; /* [places] of what came in, ramped; track_squares */
    double begin, end; /* greatest magnitude under the first and the last ramp (of the first and last frame, where there
                          is none), before these ramps */
    double *wide;      /* a chunk, scaled */
};

/* Opens the file at once. gain: of what does not wait. On an error there is nothing to drop. */
bool track_open(struct track *t, const char *path, const struct track_format *f, double gain, struct arena *a,
                struct err *e);

/* Sets the WAV's comment; before the first frame is written. */
bool track_note(struct track *t, const char *text, struct err *e);

/* The next frames [n][places], ramped and enveloped in place. ERR_SCENE: clipping. */
bool track_add(struct track *t, double *x, long n, struct err *e);

/* Sum of the squares of what came in, ramped. */
double track_squares(const struct track *t, int place);

/* From the beginning of what is kept, the next frames [n][places]; at most TRACK_CHUNK samples, 0 at the end. */
void track_rewind(struct track *t);
long track_read(struct track *t, double *x);

/* Writes what is kept at that gain. */
bool track_finish(struct track *t, double gain, struct err *e);

/* Of all that has been put into the file; as wav_written, for as long as the arena. */
struct wav_written *track_written(const struct track *t, struct arena *a);

/* What is kept is given up; the file is settled, gets its name, or leaves nothing. */
bool track_finalise(struct track *t, struct err *e);
bool track_commit(struct track *t, struct err *e);
void track_drop(struct track *t);

#endif
