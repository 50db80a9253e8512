/* Texts (scenes, designs, recipes) that come through a pipe: each is read once, until its end, and kept for whoever
   reads it again.

   What a pipe brings has no folder: file names in it start at the working folder. Data that a scene names (maps,
   sounds, tables) are files: they are read in pieces, more than once, and by their hash. */
#ifndef FILE_PIPED_H
#define FILE_PIPED_H
#include <stdbool.h>
#include <stddef.h>

/* Is it no file of a folder: a pipe, or whatever is opened by /dev/stdin, /dev/fd/3 or <(...) of a shell? */
bool piped_is(const char *file);

/* The whole text; of more than `most` bytes that many and one. It waits for who writes into it until a signal comes
 * (base/interrupt.h). NULL: errno. The text stays as long as the program. */
const char *piped_read(const char *file, size_t most, size_t *size);

#endif
