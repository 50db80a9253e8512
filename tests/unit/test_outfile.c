/* outfile: what is in the folder before, during and after; by unnamed file and by hidden name alike. */
#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/outfile.h"
#include "folder.h"

static int entries(const char *folder)
{
    int n = 0;
    DIR *d = opendir(folder);
    ck_assert_ptr_nonnull(d);
    for (struct dirent *x; (x = readdir(d));)
        n += strcmp(x->d_name, ".") && strcmp(x->d_name, "..");
    closedir(d);
    return n;
}

static void check_text(const char *path, const char *want)
{
    char got[64] = {0};
    FILE *f = fopen(path, "r");
    ck_assert_ptr_nonnull(f);
    ck_assert_uint_eq(fread(got, 1, sizeof got - 1, f), strlen(want));
    ck_assert_str_eq(got, want);
    fclose(f);
}

static void put_text(const char *path, const char *text)
{
    struct outfile o;
    struct err e = {0};
    ck_assert_msg(outfile_open(&o, path, &e), "%s", e.text);
    fputs(text, o.stream);
    ck_assert_msg(outfile_commit(&o, &e), "%s", e.text);
}

START_TEST(appears_only_when_complete)
{
    struct outfile o;
    struct err e = {0};
    folder_enter();
    put_text("a", "old");
    ck_assert(outfile_open(&o, "a", &e));
    fputs("new", o.stream);
    fflush(o.stream);
    ck_assert_str_eq(o.temporary, ""); /* the file system of /tmp has unnamed files */
    ck_assert_int_eq(entries("."), 1);
    check_text("a", "old");
    ck_assert(outfile_commit(&o, &e));
    ck_assert_int_eq(entries("."), 1);
    check_text("a", "new");
    unlink("a");
    folder_leave();
}
END_TEST

START_TEST(hidden_name_does_the_same)
{
    struct outfile o, p;
    struct err e = {0};
    folder_enter();
    put_text("a", "old");
    ck_assert(outfile_open_hidden(&o, "a", &e));
    ck_assert(outfile_open_hidden(&p, "a", &e)); /* two at a time do not meet */
    ck_assert_str_ne(o.temporary, p.temporary);
    ck_assert_int_eq(entries("."), 3);
    ck_assert_int_eq(write(o.fd, "new", 3), 3);
    check_text("a", "old");
    ck_assert(outfile_commit(&o, &e));
    outfile_drop(&p);
    ck_assert_int_eq(entries("."), 1);
    check_text("a", "new");
    unlink("a");
    folder_leave();
}
END_TEST

START_TEST(names_taken_by_others_are_passed_by)
{
    struct outfile o;
    struct err e = {0};
    char taken[64];
    folder_enter();
    snprintf(taken, sizeof taken, ".rasp-%ld-0.part", (long)getpid());
    put_text(taken, "left behind");
    ck_assert(outfile_open(&o, "a", &e));
    fputs("new", o.stream);
    ck_assert_msg(outfile_commit(&o, &e), "%s", e.text);
    check_text(taken, "left behind");
    check_text("a", "new");
    unlink("a");
    unlink(taken);
    folder_leave();
}
END_TEST

/* The hash is that of the bytes so far, also of those still in the stream's buffer, and writing goes on behind it. */
START_TEST(hash_of_what_is_written)
{
    char got[HASH_TEXT], want[HASH_TEXT];
    struct outfile o;
    struct err e = {0};
    folder_enter();
    ck_assert_msg(outfile_open(&o, "a", &e), "%s", e.text);
    fputs("half", o.stream);
    ck_assert_msg(outfile_hash(&o, got, &e), "%s", e.text);
    hash_bytes("half", 4, want);
    ck_assert_str_eq(got, want);
    fputs(" whole", o.stream);
    ck_assert_msg(outfile_commit(&o, &e), "%s", e.text);
    check_text("a", "half whole");
    unlink("a");
    folder_leave();
}
END_TEST

START_TEST(drop_leaves_nothing)
{
    struct outfile o, closed = {0};
    struct err e = {0};
    folder_enter();
    ck_assert(outfile_open(&o, "a", &e));
    fputs("x", o.stream);
    outfile_drop(&o);
    outfile_drop(&o);
    ck_assert(outfile_open_hidden(&o, "a", &e));
    outfile_drop(&o);
    outfile_drop(&closed); /* must not close descriptor 0 */
    ck_assert_int_ge(fcntl(0, F_GETFD), 0);
    ck_assert_int_eq(entries("."), 0);
    ck_assert(!outfile_commit(&o, &e));
    folder_leave();
}
END_TEST

START_TEST(killed_writer_leaves_nothing)
{
    folder_enter();
    pid_t child = fork();
    if (child == 0) {
        struct outfile o;
        struct err e = {0};
        if (outfile_open(&o, "a", &e) && fputs("half", o.stream) >= 0 && fflush(o.stream) == 0) kill(getpid(), SIGKILL);
        _exit(1);
    }
    int status;
    waitpid(child, &status, 0);
    ck_assert(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    ck_assert_int_eq(entries("."), 0);
    folder_leave();
}
END_TEST

static void check_refused(const char *target, const char *says)
{
    struct outfile o;
    for (int how = 0; how < 3; how++) {
        struct err e = {0};
        bool ok = how == 0   ? outfile_open(&o, target, &e)
                  : how == 1 ? outfile_open_fd(&o, target, &e)
                             : outfile_open_hidden(&o, target, &e);
        ck_assert(!ok);
        ck_assert_int_eq(e.kind, ERR_CREATE);
        ck_assert_msg(strstr(e.text, says) != NULL, "%s", e.text);
        outfile_drop(&o);
    }
}

START_TEST(refusals)
{
    char long_name[301];
    folder_enter();
    ck_assert_int_eq(mkdir("folder", 0777), 0);
    memset(long_name, 'a', 300);
    long_name[300] = '\0';
    check_refused("folder", "is a folder");
    check_refused("folder/", "is the name of a folder");
    check_refused("missing/a", "folder does not exist");
    check_refused("", "needs a name");
    check_refused("/dev/null", "is not a regular file");
    check_refused("/proc/nothing", "cannot be created");
    put_text("a", "x");
    check_refused("a/b", "Not a directory");
    unlink("a");
    rmdir("folder");
    ck_assert_int_eq(entries("."), 0);
    folder_leave();
}
END_TEST

START_TEST(write_protected_is_refused)
{
    folder_enter();
    put_text("a", "mine");
    chmod("a", 0444);
    pid_t child = fork(); /* permissions do not bind root: as nobody */
    if (child == 0) {
        struct outfile o;
        struct err e = {0};
        if (geteuid() == 0 && (chmod(".", 0777) != 0 || setgid(65534) != 0 || setuid(65534) != 0)) _exit(2);
        bool ok = outfile_open(&o, "a", &e);
        _exit(ok || e.kind != ERR_CREATE || !strstr(e.text, "cannot be written"));
    }
    int status;
    waitpid(child, &status, 0);
    ck_assert(WIFEXITED(status));
    ck_assert_int_eq(WEXITSTATUS(status), 0);
    check_text("a", "mine");
    unlink("a");
    folder_leave();
}
END_TEST

START_TEST(link_target_is_replaced_not_the_link)
{
    struct stat s;
    folder_enter();
    ck_assert_int_eq(mkdir("far", 0777), 0);
    put_text("far/a", "old");
    ck_assert_int_eq(symlink("far/a", "near"), 0);
    put_text("near", "new");
    ck_assert(lstat("near", &s) == 0 && S_ISLNK(s.st_mode));
    check_text("far/a", "new");
    ck_assert_int_eq(entries("far"), 1);
    unlink("near");
    unlink("far/a");
    rmdir("far");
    folder_leave();
}
END_TEST

static void check_full(bool hidden)
{
    struct outfile o;
    struct err e = {0};
    char block[8192] = {1};
    struct rlimit small = {.rlim_cur = 4096, .rlim_max = RLIM_INFINITY}, whole = {RLIM_INFINITY, RLIM_INFINITY};
    signal(SIGXFSZ, SIG_IGN);
    ck_assert(hidden ? outfile_open_hidden(&o, "a", &e) : outfile_open(&o, "a", &e));
    if (hidden) o.stream = fdopen(o.fd, "w");
    ck_assert_int_eq(setrlimit(RLIMIT_FSIZE, &small), 0);
    fwrite(block, 1, sizeof block, o.stream);
    bool ok = outfile_commit(&o, &e);
    setrlimit(RLIMIT_FSIZE, &whole);
    ck_assert(!ok);
    ck_assert_int_eq(e.kind, ERR_IO);
    ck_assert_msg(strstr(e.text, "a: cannot be written: "), "%s", e.text);
    ck_assert_int_eq(entries("."), 0);
}

START_TEST(full_disk)
{
    folder_enter();
    check_full(false);
    check_full(true);
    folder_leave();
}
END_TEST

START_TEST(mode_follows_umask)
{
    struct stat s;
    folder_enter();
    umask(027);
    put_text("a", "x");
    ck_assert_int_eq(stat("a", &s), 0);
    ck_assert_int_eq(s.st_mode & 0777, 0640);
    unlink("a");
    folder_leave();
}
END_TEST

UNIT("outfile", appears_only_when_complete, hidden_name_does_the_same, names_taken_by_others_are_passed_by,
     hash_of_what_is_written, drop_leaves_nothing, killed_writer_leaves_nothing, refusals, write_protected_is_refused,
     link_target_is_replaced_not_the_link, full_disk, mode_follows_umask)
