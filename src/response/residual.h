/* What a struck object sounds besides its modes: the residual of a recording (papers/003 D.1, `rasp modes residual`),
   and its transfer to another object by the modes of both (D.2, algorithm 1).

   A folder FOLDER/residual.yaml names, with their hashes, residual.wav and modes.csv: the residual as an impulse
   response, and the modes that were taken off, both of one strike and in one unit, whatever that is. Its third file,
   strike.wav, is for who looks: the strike's sound in two channels, represented and residual, as loud as recorded. The
   transfer takes the residual's level beside the modes over to the target's, which are per N s. So a recording may be
   of a relative level, or of another quantity than the scene's. */
#ifndef RESPONSE_RESIDUAL_H
#define RESPONSE_RESIDUAL_H
#include <stdbool.h>

#include "base/arena.h"
#include "base/err.h"
#include "num/noise.h"

#define RESIDUAL_FORMAT "rasp_residual" /* key of residual.yaml; its value is RESIDUAL_VERSION */
#define RESIDUAL_VERSION "3"
#define RESIDUAL_YAML "residual.yaml"
#define RESIDUAL_WAV "residual.wav"
#define RESIDUAL_MODES "modes.csv"
#define RESIDUAL_STRIKE "strike.wav"

struct residual_modes { /* as heard; gain: |h| at t = 0 */
    int n;
    double *frequency, *decay, *gain; /* [n] Hz, 1/s */
    double *energy;                   /* [n] of the source's, in the sound of its strike; NULL: as gain^2/decay */
};

struct residual {
    double rate; /* Hz, that was asked for */
    long n;
    double *x;                   /* [n] from the strike on */
    struct residual_modes modes; /* its source's, without those of which nothing was represented */
    const char *note;            /* that it was resampled; NULL: it was not */
};

/* Reads FOLDER/residual.yaml, checks the hashes of what it names, and resamples to `rate` (Hz). ERR_INPUT: a file is
   missing; ERR_SCENE: it is no such file, of a later format, or a file is not the one that was written. */
bool residual_read(const char *yaml, double rate, struct arena *a, struct residual *r, struct err *e);

/* Is it a folder of `rasp modes residual`, with nothing else in it? NULL: yes; else what is wrong with it. */
const char *residual_is_folder(const char *folder, struct arena *a);

/* ------------------------------------------------------------------ transfer (residual_transfer.c) */

enum residual_inverse { RESIDUAL_PHASES, RESIDUAL_NOISE };
enum residual_shift { RESIDUAL_DIFFERENCE, RESIDUAL_RATIO };

enum { RESIDUAL_PAIRS = 30 };

struct residual_ask {
    const struct residual *source;
    const struct residual_modes *target;
    int inverse, shift;
    struct noise stream; /* of RESIDUAL_NOISE */
};

struct residual_transferred {
    long n;
    double *x; /* [n] at the source's rate, per N s if the target's gains are */
    int pairs;
    struct {
        int source, target;
    } pair[RESIDUAL_PAIRS]; /* by the target's frequency */
    double consistency;     /* dB: how far the spectrogram of x is from the one that was asked for; -INFINITY: equal */
    int written[2];         /* least and greatest number of times that a bin was written */
};

/* Pairs of modes: 1 to RESIDUAL_PAIRS, rising in both. Returns how many. */
int residual_transfer_pairs(const struct residual_modes *source, const struct residual_modes *target,
                            struct residual_transferred *t);

/* ERR_SCENE: no mode of the target can be paired with one of the source. */
bool residual_transfer(const struct residual_ask *ask, struct arena *a, struct residual_transferred *t, struct err *e);

#endif
