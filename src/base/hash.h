/* SHA-256, as 64 lower-case hexadecimal digits. */
#ifndef BASE_HASH_H
#define BASE_HASH_H
#include <stdbool.h>
#include <stddef.h>

#include "base/err.h"

#define HASH_TEXT 65 /* bytes of a hash as text, with its end */

/* Piece by piece: hash_start, hash_add any number of times, hash_end. Nothing is to be freed. */
struct hash {
    long state[16]; /* SHA256_CTX */
};
struct hash hash_start(void);
void hash_add(struct hash *h, const void *data, size_t size);
void hash_text(struct hash *h, const char *text); /* with the 0 at its end */
void hash_end(struct hash *h, char hex[HASH_TEXT]);

void hash_bytes(const void *data, size_t size, char hex[HASH_TEXT]);

/* ERR_INPUT: missing, not a regular file, or unreadable. Reads in pieces: memory does not grow with the file. */
bool hash_file(const char *path, char hex[HASH_TEXT], struct err *e);

#endif
