/* What is in a WAV that is done. */
#ifndef BATCH_MEASURE_H
#define BATCH_MEASURE_H
#include <stdbool.h>

#include "base/err.h"
#include "base/hash.h"
#include "batch/cut.h"

struct measure {
    double rate;         /* Hz                                                        */
    int channels;
    long frames, own;    /* own: of the file; others where it is cut or continued   */
    double end, before;  /* as of struct cut                                          */
    double peak, rms;    /* re full scale, of all channels                            */
    double lufs;         /* integrated; NAN: shorter than 0.4 s, or silent, or not asked for */
    double true_peak;    /* re full scale; NAN: silent, or not asked for              */
    char audio[HASH_TEXT]; /* of the decoded samples, as rasp compare --hash has it   */
};

/* loud: loudness and true peak are measured, too, at the cost of as much again. Two passes over the file, the second for the loudness. ERR_INPUT, ERR_SCENE */
bool measure_file(const char *path, bool loud, struct measure *m, struct err *e);

/* The same of what becomes of it by a cut. */
bool measure_cut(const char *path, const struct cut_form *form, bool loud, struct measure *m, struct err *e);

#endif
