/* WAVs of a set: what is in one, as it is or cut to a length, read piece by piece and measured; and a supplied one as a
   stimulus, see recording.c for what is done to it. */
#ifndef BATCH_RECORDING_H
#define BATCH_RECORDING_H
#include "batch/record.h"
#include "batch/set.h"
#include "file/wav.h"

enum { MEASURE_CHANNELS = 4096 /* at most */ };

struct measure_form {
    double seconds; /* NAN: its own length */
    double ramp;    /* s, raised cosine, at the end of one that is cut; at most half of what is left */
};

struct measure_source { /* a WAV that is cut to a length under a ramp, or continued by silence */
    struct wav_stream in;
    long own, frames; /* what it has, and what is read of it or after it */
    long ramp, done;
    double end, before; /* of what was read: greatest magnitude where the ramp is (without one, of the last sample),
                           before it; and of all, before it */
};

/* form NULL: as it is. path must live as long. As wav_stream_open. */
bool recording_open(struct measure_source *c, const char *path, const struct measure_form *form, struct err *e);

/* All that is left, times the gain. As wav_stream_read and wav_write. */
bool recording_copy(struct measure_source *c, struct wav_out *out, double gain, struct err *e);

struct measure {
    double rate; /* Hz                                                        */
    int channels;
    long frames, own;      /* own: of the file; others where it is cut or continued   */
    double end, before;    /* as of struct measure_source                                */
    double peak, rms;      /* re full scale, of all channels                            */
    double lufs;           /* integrated; NAN: shorter than 0.4 s, or silent, or not asked for */
    double true_peak;      /* re full scale; NAN: silent, or not asked for              */
    char audio[HASH_TEXT]; /* of the decoded samples, as rasp compare --hash has it   */
};

/* form NULL: the file as it is. loud: loudness and true peak are measured, too, in a second pass, at the cost of as
 * much again. ERR_INPUT, ERR_SCENE */
bool recording_measure(const char *path, const struct measure_form *form, bool loud, struct measure *m, struct err *e);

/* Its length in s; rate and channels must be the set's (rate 0: they become so). ERR_INPUT, ERR_SCENE: says how to
 * convert it. */
bool recording_check(const char *file, double *rate, int *channels, double *seconds, struct err *e);

/* Can it have the set's level? Its loudness is measured for that, if the level is one, over as much of it as is kept.
 * ERR_INPUT, ERR_SCENE: it has none. */
bool recording_check_level(const char *file, const struct set *s, struct err *e);

/* Of all that its bytes depend on; sha256: the file's. */
const char *recording_key(const struct set *s, const char *sha256, struct arena *a);

/* Its WAV, settled, for wav_commit; fills in what is known of it. NULL: *e. ERR_INPUT, ERR_SCENE, ERR_CREATE, ERR_IO */
struct wav_out *recording_make(const struct set *set, const char *file, const char *path, struct record *r,
                               struct arena *a, struct err *e);

#endif
