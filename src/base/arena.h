/* Memory that lives as long as one render (or one command) and is freed at once.
   A request that cannot be met ends the program with exit code 71 (ERR_MEMORY) and a message: outputs are unnamed
   files until they are complete (base/outfile.h), so that nothing half-written stays behind. */
#ifndef BASE_ARENA_H
#define BASE_ARENA_H
#include <stddef.h>

struct arena;

struct arena *arena_open(void);
void arena_close(struct arena *a);

/* count * size bytes, zeroed, aligned to 64 bytes, never NULL. */
void *arena_take(struct arena *a, size_t count, size_t size);

/* A copy of a string, or of printf's text. */
char *arena_text(struct arena *a, const char *s);
char *arena_format(struct arena *a, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Lines of text (NULL: none yet) and another one. */
const char *arena_line(struct arena *a, const char *lines, const char *line);

/* Bytes handed out so far (what was asked for, rounded up to the alignment). */
size_t arena_bytes(const struct arena *a);

/* The list of n with room for one more at its end: a new one that holds it where n is 0 or a power of two from 4 on. */
void *arena_more(struct arena *a, const void *list, int n, size_t size);

#define ARENA_TAKE(a, type, n) ((type *)arena_take((a), (size_t)(n), sizeof(type)))

#endif
