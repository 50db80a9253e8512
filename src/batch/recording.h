/* A supplied WAV as a stimulus: see recording.c for what is done to it. */
#ifndef BATCH_RECORDING_H
#define BATCH_RECORDING_H
#include "batch/record.h"
#include "batch/set.h"
#include "file/wav.h"

/* Its length in s; rate and channels must be the set's (rate 0: they become so). ERR_INPUT, ERR_SCENE: says how to
 * convert it. */
bool recording_check(const char *file, double *rate, int *channels, double *seconds, struct err *e);

/* Can it have the set's level? Its loudness is measured for that, if the level is one, over as much of it as is kept.
 * ERR_INPUT, ERR_SCENE: it has none. */
bool recording_check_level(const char *file, const struct set *s, struct err *e);

/* Of an enum encoding, as wav_format has them. */
int recording_bits(int encoding);

/* Of all that its bytes depend on; sha256: the file's. */
const char *recording_key(const struct set *s, const char *sha256, struct arena *a);

/* Its WAV, settled, for wav_commit; fills in what is known of it. NULL: *e. ERR_INPUT, ERR_SCENE, ERR_CREATE, ERR_IO */
struct wav_out *recording_make(const struct set *set, const char *file, const char *path, struct record *r,
                               struct arena *a, struct err *e);

#endif
