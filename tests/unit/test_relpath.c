/* base/relpath.c: the relative name, opened from the folder, must be the same file (same inode) as the name it was made
 * from. */
#include "unit.h"

#include <sys/stat.h>
#include <unistd.h>

#include "base/relpath.h"

static const char *const folders[] = {"a", "a/b", "a/b/c", "a/bc", "d"}, *const files[] = {"a/file", "a/b/file",
                                                                                           "d/file", "file"};
enum { FOLDERS = sizeof folders / sizeof folders[0], FILES = sizeof files / sizeof files[0] };
static char root[] = "/tmp/rasp-relpath-XXXXXX";

/* The folders and files above, and a link l -> a/b, in a folder of their own, which becomes the current one. */
static void make_tree(void)
{
    ck_assert_ptr_nonnull(mkdtemp(root));
    ck_assert_int_eq(chdir(root), 0);
    for (int i = 0; i < FOLDERS; i++)
        ck_assert_int_eq(mkdir(folders[i], 0700), 0);
    for (int i = 0; i < FILES; i++)
        fclose(fopen(files[i], "w"));
    ck_assert_int_eq(symlink("a/b", "l"), 0);
}

static void remove_tree(void)
{
    for (int i = FILES - 1; i >= 0; i--)
        unlink(files[i]);
    unlink("l");
    for (int i = FOLDERS - 1; i >= 0; i--)
        rmdir(folders[i]);
    ck_assert_int_eq(rmdir(root), 0);
}

static void same_file(const char *file, const char *folder, const char *want)
{
    struct arena *a = arena_open();
    const char *name = relpath_make(file, folder, a);
    struct stat x, y;
    ck_assert_msg(!strcmp(name, want), "%s from %s is %s, not %s", file, folder ? folder : "(null)", name, want);
    ck_assert_int_eq(stat(file, &x), 0);
    ck_assert_int_eq(stat(name[0] == '/' ? name : arena_format(a, "%s/%s", folder && *folder ? folder : ".", name), &y),
                     0);
    ck_assert(x.st_ino == y.st_ino && x.st_dev == y.st_dev);
    arena_close(a);
}

START_TEST(test_same_file)
{
    make_tree();
    same_file("file", NULL, "file");
    same_file("./a/../file", "", "file");
    same_file("a/file", ".", "a/file");
    same_file("a/file", "a", "file");
    same_file("a/file", "a/b", "../file");
    same_file("a/file", "a/b/c", "../../file");
    same_file("a/b/file", "a/bc", "../b/file");
    same_file("d/file", "a/b/", "../../d/file");
    same_file("d/file", "l", "../../d/file");
    same_file("l/file", "a", "b/file");
    same_file("l/file", "d", "../a/b/file");
    remove_tree();
}
END_TEST

START_TEST(test_absolute)
{
    make_tree();
    char here[4096], file[4200];
    ck_assert_ptr_nonnull(getcwd(here, sizeof here));
    snprintf(file, sizeof file, "%s/d/file", here);
    same_file(file, "a", "../d/file");
    same_file("d/file", "/usr", file);
    same_file("d/file", "/", file);
    same_file("d/file", "/no/such/folder", file);
    same_file("/etc/passwd", "a", "/etc/passwd");
    remove_tree();
}
END_TEST

/* What is not there is called as it was when it was there. */
START_TEST(test_missing)
{
    static const char *const file_of[] = {"d/file", "a/b/../../d/file", "./d/./file", "l/../../d//file", "d/../d/file"},
                             *const folder_of[] = {"", "a/b", "l", "d", "a/b/../../d"};
    char here[4096];
    const char *before[5][5];
    struct arena *a = arena_open();
    make_tree();
    ck_assert_ptr_nonnull(getcwd(here, sizeof here));
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < 5; i++)
            for (int k = 0; k < 5; k++) {
                const char *file = i == 4 ? arena_format(a, "%s/%s", here, file_of[i]) : file_of[i],
                           *name = relpath_make(file, folder_of[k], a);
                ck_assert_msg(pass == 0 || !strcmp(name, before[i][k]), "%s from %s is %s, not %s", file, folder_of[k],
                              name, before[i][k]);
                before[i][k] = name;
            }
        ck_assert_int_eq(rename(pass == 0 ? "d" : "away", pass == 0 ? "away" : "d"), 0);
    }
    ck_assert_str_eq(before[1][1], "../../d/file");
    ck_assert_str_eq(relpath_make("no/such/../file", "a", a), "../no/file");
    ck_assert_str_eq(relpath_make("/../no/../x", "/y", a), "/x");
    remove_tree();
    arena_close(a);
}
END_TEST

UNIT("relpath", test_same_file, test_absolute, test_missing)
