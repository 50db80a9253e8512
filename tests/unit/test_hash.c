/* base/hash.c against the vectors of FIPS 180-4 (NIST, "SHA-256 examples" and the million a's). */
#include "unit.h"

#include <unistd.h>

#include "base/hash.h"

static const char EMPTY[] = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
static const char ABC[] = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
static const char MILLION[] = "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";

START_TEST(test_bytes)
{
    char hex[HASH_TEXT];
    hash_bytes("", 0, hex);
    ck_assert_str_eq(hex, EMPTY);
    hash_bytes("abc", 3, hex);
    ck_assert_str_eq(hex, ABC);
}
END_TEST

START_TEST(test_piece_by_piece)
{
    char hex[HASH_TEXT], piece[1000];
    struct hash h = hash_start(), other = hash_start();
    memset(piece, 'a', sizeof piece);
    for (int i = 0; i < 1000; i++) {
        hash_add(&h, piece, 400); /* two at once do not mix */
        hash_add(&other, "b", i == 0);
        hash_add(&h, piece, 600);
    }
    hash_end(&h, hex);
    ck_assert_str_eq(hex, MILLION);
    hash_end(&other, hex);
    ck_assert_str_eq(hex, "3e23e8160039594a33894f6564e1b1348bbd7a0088d42c4acb73eeaed59c009d"); /* "b", by sha256sum */
}
END_TEST

START_TEST(test_file_longer_than_a_piece)
{
    char hex[HASH_TEXT], name[] = "/tmp/rasp-hash-XXXXXX";
    struct err e = {0};
    FILE *f = fdopen(mkstemp(name), "w");
    for (int i = 0; i < 1000000; i++)
        fputc('a', f);
    fclose(f);
    ck_assert(hash_file(name, hex, &e));
    unlink(name);
    ck_assert_str_eq(hex, MILLION);
}
END_TEST

START_TEST(test_missing_and_folder)
{
    char hex[HASH_TEXT];
    struct err e = {0};
    ck_assert(!hash_file("/nowhere/at/all", hex, &e));
    ck_assert_int_eq(e.kind, ERR_INPUT);
    ck_assert_ptr_nonnull(strstr(e.text, "/nowhere/at/all: No such file"));
    e = (struct err){0};
    ck_assert(!hash_file("/tmp", hex, &e));
    ck_assert_int_eq(e.kind, ERR_INPUT);
}
END_TEST

UNIT("hash", test_bytes, test_piece_by_piece, test_file_longer_than_a_piece, test_missing_and_folder)
