/* SHA-256 (FIPS 180-4) by libcrypto, which uses the CPU's instructions for it where there are some. By SHA256_*, which
   version 3 calls deprecated and keeps: EVP_* first reads libcrypto's configuration and makes its tables of all
   algorithms, a tenth of what a short scene takes. */
#define OPENSSL_SUPPRESS_DEPRECATED
#include "base/hash.h"

#include <errno.h>
#include <openssl/sha.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"

_Static_assert(sizeof(SHA256_CTX) <= sizeof(struct hash), "struct hash has room for SHA-256's state");

/* These functions always succeed. */
struct hash hash_start(void)
{
    struct hash h;
    SHA256_Init((SHA256_CTX *)h.state);
    return h;
}

void hash_add(struct hash *h, const void *data, size_t size) { SHA256_Update((SHA256_CTX *)h->state, data, size); }

void hash_text(struct hash *h, const char *text) { hash_add(h, text, strlen(text) + 1); }

void hash_end(struct hash *h, char hex[HASH_TEXT])
{
    unsigned char digest[SHA256_DIGEST_LENGTH];
    SHA256_Final(digest, (SHA256_CTX *)h->state);
    for (int i = 0; i < SHA256_DIGEST_LENGTH; i++)
        snprintf(hex + 2 * i, 3, "%02x", digest[i]);
}

void hash_bytes(const void *data, size_t size, char hex[HASH_TEXT])
{
    struct hash h = hash_start();
    hash_add(&h, data, size);
    hash_end(&h, hex);
}

bool hash_file(const char *path, char hex[HASH_TEXT], struct err *e)
{
    struct stat s;
    if (stat(path, &s) != 0) return err_set(e, err_system(ERR_INPUT), "%s: %s", path, strerror(errno));
    if (!S_ISREG(s.st_mode)) return err_set(e, ERR_INPUT, "%s: is not a file", path);
    FILE *f = memory_fopen(path, "rb");
    if (!f) return err_set(e, err_system(ERR_INPUT), "%s: %s", path, strerror(errno));
    struct hash h = hash_start();
    unsigned char piece[1 << 16];
    for (size_t n; (n = fread(piece, 1, sizeof piece, f)) > 0;)
        hash_add(&h, piece, n);
    bool ok = !ferror(f);
    int why = errno;
    fclose(f);
    hash_end(&h, hex);
    errno = why;
    return ok || err_set(e, err_system(ERR_INPUT), "%s: %s", path, strerror(why));
}
