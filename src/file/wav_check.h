/* A sound file before libsndfile has it: it shortens a truncated RIFF file without a word, so the data chunk's length
 * is held against the file's length here. */
#ifndef FILE_WAV_CHECK_H
#define FILE_WAV_CHECK_H
#include <stdbool.h>

#include "base/err.h"

/* ERR_INPUT: missing, unreadable, or not a file; ERR_SCENE: truncated. Whether it is a sound file at all is not looked
 * at. */
bool wav_check(const char *path, struct err *e);

#endif
