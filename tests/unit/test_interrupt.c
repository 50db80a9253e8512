/* Signals: each test is a process of its own that is sent one, and what it is ended with, when, and what it leaves.
   Machines that run tests are busy: a limit of half a second (base/interrupt.h) is asked of the quickest of three. */
#include <fcntl.h>
#include <glob.h>
#include <pthread.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "base/err.h"
#include "base/interrupt.h"
#include "base/outfile.h"
#include "folder.h"
#include "unit.h"

enum { ORDERLY = 3 };

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void rest(double s)
{
    struct timespec t = {.tv_sec = (time_t)s, .tv_nsec = (long)(1e9 * (s - (double)(time_t)s))};
    nanosleep(&t, NULL);
}

/* Runs `what` in a process, and once it has said that it is ready sends it n signals. Its exit code, -1: a signal ended
 * it; *took: s from the first signal on. */
static int ended(void (*what)(int ready), int number, int n, double *took)
{
    int ends[2], status;
    char byte;
    ck_assert_int_eq(pipe(ends), 0);
    pid_t pid = fork();
    if (pid == 0) {
        close(STDERR_FILENO);
        interrupt_catch();
        what(ends[1]);
        _exit(0);
    }
    close(ends[1]);
    ck_assert_int_eq(read(ends[0], &byte, 1), 1);
    close(ends[0]);
    double start = now();
    for (int i = 0; i < n; i++) {
        if (i) rest(0.02);
        kill(pid, number);
    }
    ck_assert_int_eq(waitpid(pid, &status, 0), pid);
    *took = now() - start;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void ready(int fd)
{
    if (write(fd, "", 1) != 1) _exit(1);
}

/* All three end with the code; the least time of them. */
static double quickest(void (*what)(int), int number, int n, int code)
{
    double least = HUGE_VAL, took;
    for (int i = 0; i < 3; i++) {
        ck_assert_int_eq(ended(what, number, n, &took), code);
        least = fmin(least, took);
    }
    return least;
}

static void computes(int fd)
{
    ready(fd);
    for (volatile long i = 0;; i++)
        continue;
}

static void reads(int fd)
{
    int ends[2];
    char byte;
    if (pipe(ends) == 0) {
        ready(fd);
        while (read(ends[0], &byte, 1) != 1)
            continue;
    }
}

/* As of a shell that runs a script, for what it starts in the background. */
static void ignored_it(int fd)
{
    signal(SIGINT, SIG_IGN);
    interrupt_pass_on();
    interrupt_catch();
    reads(fd);
}

static void *holds(void *unused)
{
    while (!unused) { /* always */
        interrupt_hold();
        interrupt_hold();
        rest(0.001);
        interrupt_go();
        interrupt_go();
    }
    return NULL;
}

static void holds_all_the_time(int fd)
{
    pthread_t thread;
    for (int i = 0; i < 8; i++)
        pthread_create(&thread, NULL, holds, NULL);
    ready(fd);
    holds(NULL);
}

START_TEST(wherever_it_is)
{
    void (*const whats[])(int) = {computes, reads, ignored_it, holds_all_the_time};
    for (size_t i = 0; i < sizeof whats / sizeof *whats; i++) {
        double took = quickest(whats[i], whats[i] == computes ? SIGTERM : SIGINT, 1, ERR_INTERRUPTED);
        ck_assert_msg(took > 0.2 && took < 0.5, "%zu: %g s", i, took);
    }
    double took = quickest(reads, SIGTERM, 2, ERR_INTERRUPTED);
    ck_assert_msg(took < 0.2, "a second signal: %g s", took);
}
END_TEST

static void asks(int fd)
{
    ready(fd);
    while (!interrupt_seen())
        rest(0.001);
    interrupt_report();
    _exit(ORDERLY);
}

START_TEST(in_order)
{
    double took = quickest(asks, SIGINT, 1, ORDERLY);
    ck_assert_msg(took < 0.2, "%g s", took);
}
END_TEST

/* Words take their time, and a second signal does not cut them off; but who does not come to an end is ended. */
static void tells(int fd)
{
    ready(fd);
    while (!interrupt_seen())
        rest(0.001);
    interrupt_report();
    rest(0.06);
    _exit(ORDERLY);
}

static void tells_for_ever(int fd)
{
    ready(fd);
    while (!interrupt_seen())
        rest(0.001);
    interrupt_report();
    for (;;)
        pause();
}

START_TEST(words_are_whole)
{
    quickest(tells, SIGINT, 3, ORDERLY);
    double took = quickest(tells_for_ever, SIGTERM, 1, ERR_INTERRUPTED);
    ck_assert_msg(took < 0.5, "%g s", took);
}
END_TEST

/* ------------------------------------------------------------------ what it leaves */

static void touch(const char *path)
{
    int fd = open(path, O_WRONLY | O_CREAT | O_EXCL, 0666);
    if (fd < 0) _exit(1);
    close(fd);
}

static void leaves(int fd)
{
    mkdir("work", 0777);
    mkdir("work/inner", 0777);
    touch("work/inner/a");
    touch("work/b");
    touch("hidden");
    touch("named");
    touch("not-ours");
    interrupt_hold();
    interrupt_temporary("work");
    interrupt_temporary("named");
    interrupt_temporary("hidden");
    interrupt_temporary("never-made");
    interrupt_go();
    interrupt_forget("named");
    struct outfile one, two;
    struct err e = {0};
    outfile_open_hidden(&one, "sound.wav", &e);
    outfile_open(&two, "table.csv", &e);
    outfile_finalise(&two, &e);
    pid_t child = fork();
    if (child == 0)
        for (;;)
            pause();
    interrupt_child(child);
    FILE *f = fopen("child", "w");
    fprintf(f, "%ld\n", (long)child);
    fclose(f);
    ready(fd);
    interrupt_wait(child, NULL, NULL);
    _exit(1); /* the child was killed, and we should have been ended before */
}

START_TEST(temporaries_go_and_the_child)
{
    double took;
    long child = 0;
    folder_enter();
    ck_assert_int_eq(ended(leaves, SIGTERM, 1, &took), ERR_INTERRUPTED);
    for (const char *const *gone = (const char *const[]){"work", "hidden", "never-made", NULL}; *gone; gone++)
        ck_assert_msg(access(*gone, F_OK) != 0, "%s", *gone);
    ck_assert_int_eq(access("named", F_OK), 0);
    ck_assert_int_eq(access("not-ours", F_OK), 0);
    FILE *f = fopen("child", "r");
    ck_assert_int_eq(fscanf(f, "%ld", &child), 1);
    fclose(f);
    ck_assert_int_ne(kill((pid_t)child, 0), 0);
    glob_t hidden; /* of outputs that were not yet complete, or about to be renamed */
    ck_assert_int_eq(glob(".rasp-*", 0, NULL, &hidden), GLOB_NOMATCH);
    ck_assert_int_ne(access("sound.wav", F_OK), 0);
    ck_assert_int_ne(access("table.csv", F_OK), 0);
    ck_assert_int_eq(unlink("named") | unlink("not-ours") | unlink("child"), 0);
    folder_leave();
}
END_TEST

/* A second signal does not cut it off either. */
static void commits(int fd)
{
    interrupt_hold();
    touch("first");
    ready(fd);
    rest(0.6);
    touch("second");
    interrupt_go();
    for (;;)
        pause();
}

START_TEST(what_is_held_together_is_whole)
{
    double took;
    folder_enter();
    ck_assert_int_eq(ended(commits, SIGTERM, 3, &took), ERR_INTERRUPTED);
    ck_assert_msg(took > 0.59, "%g s", took);
    ck_assert_int_eq(unlink("first") | unlink("second"), 0);
    folder_leave();
}
END_TEST

/* The signal that comes while one program becomes another is the other's. */
static void becomes_another(int fd)
{
    if (!interrupt_pass_on()) _exit(1);
    ready(fd);
    rest(0.1);
    interrupt_catch();
    for (;;)
        pause();
}

START_TEST(passed_on)
{
    double took = quickest(becomes_another, SIGTERM, 1, ERR_INTERRUPTED);
    ck_assert_msg(took > 0.2 && took < 0.6, "%g s", took);
}
END_TEST

UNIT("interrupt", wherever_it_is, in_order, words_are_whole, temporaries_go_and_the_child,
     what_is_held_together_is_whole, passed_on)
