/* A file_cache: what is made of a file is made once, however many threads ask, and anew when the file has changed. */
#include "base/file_cache.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/hash.h"
#include "unit.h"

static struct arena *a;

__attribute__((constructor)) static void open_arena(void) { a = arena_open(); }

static atomic_int made;

static bool make_text(const char *file, const void *how, struct arena *arena, void *thing, struct err *e)
{
    (void)arena, (void)how;
    made++;
    usleep(2000);
    FILE *f = fopen(file, "r");
    size_t n = f ? fread(thing, 1, 15, f) : 0;
    if (f) fclose(f);
    return n > 0 || err_set(e, ERR_INPUT, "%s: empty", file);
}

static const struct file_cache_kind texts = {"text", 16, make_text, false},
                                    others = {"other text", 16, make_text, false};

static char path[64];

static const void *take(struct file_cache *s, const struct file_cache_kind *kind, struct arena *arena, struct err *e)
{
    return file_cache_take(s, &(struct file_cache_ask){.kind = kind, .file = path}, arena, e);
}

static void put(const char *text)
{
    FILE *f = fopen(path, "w");
    ck_assert_ptr_nonnull(f);
    fputs(text, f);
    fclose(f);
}

static void begin(const char *text)
{
    strcpy(path, "/tmp/rasp-test-XXXXXX");
    close(mkstemp(path));
    put(text);
    made = 0;
}

static void *asks(void *file_cache)
{
    struct arena *own = arena_open();
    struct err e = {0};
    for (int i = 0; i < 50; i++)
        if (strcmp(take(file_cache, &texts, own, &e), "one") != 0) abort();
    arena_close(own);
    return NULL;
}

START_TEST(many_threads_make_it_once)
{
    pthread_t threads[4];
    begin("one");
    struct file_cache *s = file_cache_open(1 << 20);
    for (int i = 0; i < 4; i++)
        ck_assert_int_eq(pthread_create(&threads[i], NULL, asks, s), 0);
    for (int i = 0; i < 4; i++)
        pthread_join(threads[i], NULL);
    ck_assert_int_eq(made, 1);
    struct err e = {0};
    ck_assert_ptr_ne(take(s, &others, a, &e), take(s, &texts, a, &e));
    ck_assert_int_eq(made, 2);
    file_cache_close(s);
    unlink(path);
}
END_TEST

START_TEST(a_file_that_has_changed_is_read_anew)
{
    struct err e = {0};
    begin("one");
    struct file_cache *s = file_cache_open(1 << 20);
    const char *old = take(s, &texts, a, &e);
    put("other");
    ck_assert_str_eq(take(s, &texts, a, &e), "other");
    ck_assert_str_eq(old, "one");
    put("");
    ck_assert_ptr_null(take(s, &texts, a, &e));
    ck_assert_int_eq(e.kind, ERR_INPUT);
    put("more");
    e = (struct err){0};
    ck_assert_str_eq(take(s, &texts, a, &e), "more");
    ck_assert_ptr_nonnull(strstr(file_cache_changed(s, a), "rasp-test-")); /* since "one" */
    file_cache_close(s);
    s = file_cache_open(1 << 20);
    take(s, &texts, a, &e);
    ck_assert_ptr_null(file_cache_changed(s, a));
    unlink(path);
    ck_assert_ptr_nonnull(strstr(file_cache_changed(s, a), "rasp-test-"));
    file_cache_close(s);
    unlink(path);
}
END_TEST

/* A file_cache that is full, and none, leave each to himself. */
START_TEST(what_has_no_room_is_made_for_each)
{
    struct err e = {0};
    begin("one");
    struct file_cache *s = file_cache_open(0);
    ck_assert_str_eq(take(s, &texts, a, &e), "one");
    ck_assert_str_eq(take(s, &texts, a, &e), "one");
    ck_assert_str_eq(take(NULL, &texts, a, &e), "one");
    ck_assert_int_eq(made, 3);
    file_cache_close(s);
    unlink(path);
}
END_TEST

/* A file that was asked for by its hash is watched, full file_cache or not. */
START_TEST(what_is_small_has_room)
{
    struct err e = {0};
    begin("one");
    struct file_cache *s = file_cache_open(0);
    take(s, &texts, a, &e);
    put("other");
    ck_assert_ptr_null(file_cache_changed(s, a));
    ck_assert_ptr_eq(file_cache_sha256(s, path, a, &e), file_cache_sha256(s, path, a, &e));
    ck_assert_ptr_null(file_cache_changed(s, a));
    put("third");
    ck_assert_ptr_nonnull(strstr(file_cache_changed(s, a), "rasp-test-"));
    file_cache_close(s);
    unlink(path);
}
END_TEST

/* sha256sum of "one". */
START_TEST(hashes_are_those_of_the_file)
{
    struct err e = {0};
    begin("one");
    struct file_cache *s = file_cache_open(1 << 20);
    ck_assert_str_eq(file_cache_sha256(s, path, a, &e),
                     "7692c3ad3540bb803c020b3aee66cd8887123234ea0c6e7143c0add73ff431ed");
    ck_assert_ptr_eq(file_cache_sha256(s, path, a, &e), file_cache_sha256(s, path, a, &e));
    unlink(path);
    ck_assert_ptr_null(file_cache_sha256(s, path, a, &e));
    file_cache_close(s);
}
END_TEST

UNIT("file_cache", many_threads_make_it_once, a_file_that_has_changed_is_read_anew, what_has_no_room_is_made_for_each,
     what_is_small_has_room, hashes_are_those_of_the_file)
