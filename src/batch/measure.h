/* What is in a WAV, as it is or cut to a length: read piece by piece, and measured. */
#ifndef BATCH_MEASURE_H
#define BATCH_MEASURE_H
#include <stdbool.h>

#include "base/err.h"
#include "base/hash.h"
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
bool measure_open(struct measure_source *c, const char *path, const struct measure_form *form, struct err *e);

/* The next frames [n][in.channels] of at most `most`; *n 0 at the end. As wav_stream_read. */
bool measure_read(struct measure_source *c, double *x, long most, long *n, struct err *e);

/* All that is left, times the gain. As measure_read and wav_write. */
bool measure_copy(struct measure_source *c, struct wav_out *out, double gain, struct err *e);

void measure_close(struct measure_source *c);

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
bool measure_cut(const char *path, const struct measure_form *form, bool loud, struct measure *m, struct err *e);

#endif
