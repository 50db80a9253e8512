/* A supplied WAV as a stimulus: see recording.c for what is done to it. */
#ifndef BATCH_RECORDING_H
#define BATCH_RECORDING_H
#include "batch/job.h"

/* As job_do, of a stimulus that is a recording. ERR_INPUT, ERR_SCENE */
bool recording_do(const struct job_kit *k, int i, struct arena *a, struct job_result *result, struct err *e);

/* Its length in s; rate and channels must be the set's (rate 0: they become so). ERR_INPUT, ERR_SCENE: says how to convert it. */
bool recording_check(const char *file, double *rate, int *channels, double *seconds, struct err *e);

/* Can it have the set's level? Its loudness is measured for that, if the level is one, over as much of it as is kept. ERR_INPUT, ERR_SCENE: it has none. */
bool recording_check_level(const char *file, const struct set *s, struct err *e);

#endif
