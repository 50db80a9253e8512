/* SHA-256 (FIPS 180-4) by libcrypto, which uses the CPU's instructions for it where there are some. */
#include "base/hash.h"

#include <errno.h>
#include <openssl/evp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* libcrypto fails here only when it is out of memory or broken: nothing a caller could mend. */
static void must(int ok)
{
    if (ok == 1)
        return;
    fprintf(stderr, "rasp: error: SHA-256 is not available from libcrypto\n");
    exit(ERR_MEMORY);
}

struct hash hash_start(void)
{
    EVP_MD_CTX *m = EVP_MD_CTX_new();
    must(m && EVP_DigestInit_ex(m, EVP_sha256(), NULL));
    return (struct hash){m};
}

void hash_add(struct hash *h, const void *data, size_t size)
{
    must(EVP_DigestUpdate(h->state, data, size));
}

void hash_end(struct hash *h, char hex[HASH_TEXT])
{
    unsigned char digest[32];
    must(EVP_DigestFinal_ex(h->state, digest, NULL));
    EVP_MD_CTX_free(h->state);
    h->state = NULL;
    for (int i = 0; i < 32; i++)
        snprintf(hex + 2 * i, 3, "%02x", digest[i]);
}

void hash_bytes(const void *data, size_t size, char hex[HASH_TEXT])
{
    struct hash h = hash_start();
    hash_add(&h, data, size);
    hash_end(&h, hex);
}

static bool hash_stream(FILE *f, struct hash *h)
{
    unsigned char piece[1 << 16];
    size_t n;
    while ((n = fread(piece, 1, sizeof piece, f)) > 0)
        hash_add(h, piece, n);
    return !ferror(f);
}

bool hash_file(const char *path, char hex[HASH_TEXT], struct err *e)
{
    struct stat s;
    if (stat(path, &s) != 0)
        return err_set(e, ERR_INPUT, "%s: %s", path, strerror(errno));
    if (!S_ISREG(s.st_mode))
        return err_set(e, ERR_INPUT, "%s: is not a file", path);
    FILE *f = fopen(path, "rb");
    if (!f)
        return err_set(e, ERR_INPUT, "%s: %s", path, strerror(errno));
    struct hash h = hash_start();
    bool ok = hash_stream(f, &h);
    int why = errno;
    fclose(f);
    hash_end(&h, hex);
    return ok || err_set(e, ERR_INPUT, "%s: %s", path, strerror(why));
}
