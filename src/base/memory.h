/* No memory left: one line on standard error, and the program ends with exit code 71 (ERR_MEMORY). Outputs are unnamed
   files until they are complete (base/outfile.h), so that nothing half-written stays behind. */
#ifndef BASE_MEMORY_H
#define BASE_MEMORY_H
#include <stddef.h>
#include <stdio.h>

/* "FFT of 4096 points": what it was wanted for. */
_Noreturn void memory_out(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* malloc. */
void *memory_take(size_t bytes);

/* realpath, for free; NULL: errno says why. */
char *memory_realpath(const char *path);

/* fopen, to whose other errors the caller sees. */
FILE *memory_fopen(const char *path, const char *mode);

/* Ends the program unless so many bytes can be had: before a library is called that crashes where it gets none. */
void memory_available(size_t bytes);

/* A text that is written like a file: *text is there when memory_stream_end has closed the stream, and is freed by
 * free. */
FILE *memory_stream(char **text, size_t *size);
void memory_stream_end(FILE *f, char *const *text);

#endif
