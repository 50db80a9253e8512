/* A whole file in memory, texts that come through a pipe, and numbers as bytes. */
#ifndef FILE_BYTES_H
#define FILE_BYTES_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "base/arena.h"
#include "base/err.h"

struct bytes {
    char *at; /* at[n] is 0, so that text is a string */
    size_t n;
};

/* Also from pipes. ERR_INPUT: missing, a folder, or unreadable; "path: why". */
bool bytes_read(const char *path, struct arena *a, struct bytes *b, struct err *e);

/* What is left of a stream, of more than `most` bytes not all; room: how many there are, about. false: errno */
bool bytes_stream(FILE *f, size_t room, size_t most, struct arena *a, struct bytes *b);

/* The text without blanks before and behind it, in place. */
char *bytes_trim(char *s);

/* `size` bytes, lowest first, as unsigned. */
uint64_t bytes_word(const void *bytes, size_t size);
double bytes_f64(const void *bytes);
/* The same as a number: kind f (floating point, of 4 or 8 bytes), i (with a sign), u. */
double bytes_number(const void *bytes, char kind, size_t size);

/* The other way round; a failed write shows in the stream. */
void bytes_put(FILE *f, uint64_t value, size_t size);
void bytes_put_f64(FILE *f, double value);

/* A file of the same folder whose name is nearly that, where there is none of that name; NULL: none. */
const char *bytes_near(const char *file, struct arena *a);

/* Texts (scenes, designs, recipes) that come through a pipe: each is read once, until its end, and kept for whoever
   reads it again.

   What a pipe brings has no folder: file names in it start at the working folder. Data that a scene names (maps,
   sounds, tables) are files: they are read in pieces, more than once, and by their hash. */

/* Is it no file of a folder: a pipe, or whatever is opened by /dev/stdin, /dev/fd/3 or <(...) of a shell? */
bool bytes_piped(const char *file);

/* The whole text; of more than `most` bytes that many and one. It waits for who writes into it until a signal comes
 * (base/interrupt.h). NULL: errno. The text stays as long as the program. */
const char *bytes_piped_read(const char *file, size_t most, size_t *size);

#endif
