/* base/file_cache.h: a file that is written anew has changed, though its bytes, its size and the time that programs may set
 * are those of before; one that is only read has not. */
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file_cache.h"
#include "renders.h"

static void put(const char *path, const char *text)
{
    FILE *f = fopen(path, "w");
    ck_assert_ptr_nonnull(f);
    fputs(text, f);
    ck_assert_int_eq(fclose(f), 0);
    usleep(20000); /* clocks of file systems tick every 4 to 10 ms */
}

START_TEST(test_changes)
{
    struct arena *a = folder_make();
    const char *files[] = {folder_path("one"), folder_path("two"), folder_path("three")};
    char text[8];
    put(files[0], "abc");
    put(files[1], "abc");
    struct watch w = file_cache_watch(files, 3, a);
    FILE *f = fopen(files[0], "r");
    ck_assert_ptr_nonnull(fgets(text, sizeof text, f));
    fclose(f);
    ck_assert_ptr_null(file_cache_watch_changed(&w));
    put(files[2], "abc");
    ck_assert_str_eq(file_cache_watch_changed(&w), files[2]);
    unlink(files[2]);
    ck_assert_ptr_null(file_cache_watch_changed(&w));
    struct stat was;
    ck_assert_int_eq(stat(files[1], &was), 0);
    put(files[1], "abd");
    put(files[1], "abc");
    const struct timespec times[2] = {was.st_atim, was.st_mtim};
    ck_assert_int_eq(utimensat(AT_FDCWD, files[1], times, 0), 0);
    ck_assert_str_eq(file_cache_watch_changed(&w), files[1]);
    w = file_cache_watch(files, 2, a);
    ck_assert_ptr_null(file_cache_watch_changed(&w));
    unlink(files[0]);
    ck_assert_str_eq(file_cache_watch_changed(&w), files[0]);
    folder_remove();
}
END_TEST

UNIT("watch", test_changes)
