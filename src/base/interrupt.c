#include "base/interrupt.h"

#include <errno.h>
#include <ftw.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/err.h"
#include "base/memory.h"

#define DISMISSED                                                                                                      \
    SIGRTMIN /* wakes the thread that waits; not pthread_cancel, whose unwinding the address sanitizer takes for a     \
                fault */
#define GRACE 250000000 /* ns */
enum { AGAIN = 20 };    /* passes over a folder in which another thread still makes files */
#define WORDS 100000000 /* ns: for who is telling it, and ends the program then */

struct temporary {
    struct temporary *next;
    char path[];
};

static sigset_t signals; /* set once, before the thread is there */
static pthread_t waiter;
static atomic_bool dismissed; /* it is to go */
static bool waits;            /* there is such a thread */
static atomic_bool seen;
static atomic_flag reported = ATOMIC_FLAG_INIT;
static atomic_int child; /* 0: none */
static pthread_rwlock_t names =
    PTHREAD_RWLOCK_WRITER_NONRECURSIVE_INITIALIZER_NP; /* held by all who hold, and for ever by the one who ends */
static _Thread_local int depth;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* of the list */
static struct temporary *temporaries;

/* ------------------------------------------------------------------ what must be whole */

void interrupt_hold(void)
{
    if (depth++ == 0) pthread_rwlock_rdlock(&names);
}

void interrupt_go(void)
{
    if (--depth == 0) pthread_rwlock_unlock(&names);
}

void interrupt_temporary(const char *path)
{
    size_t n = strlen(path) + 1;
    struct temporary *t = memory_take(sizeof *t + n);
    memcpy(t->path, path, n);
    pthread_mutex_lock(&lock);
    t->next = temporaries;
    temporaries = t;
    pthread_mutex_unlock(&lock);
}

void interrupt_forget(const char *path)
{
    pthread_mutex_lock(&lock);
    struct temporary **at = &temporaries;
    while (*at && strcmp((*at)->path, path) != 0)
        at = &(*at)->next;
    struct temporary *removed = *at;
    if (removed) *at = removed->next;
    pthread_mutex_unlock(&lock);
    free(removed);
}

void interrupt_child(pid_t pid) { child = pid > 0 ? pid : 0; }

/* Whoever ends the program has killed the child, perhaps: then nobody gets beyond the hold. */
pid_t interrupt_wait(pid_t pid, int *status, struct rusage *used)
{
    pid_t over;
    do
        over = wait4(pid, status, 0, used);
    while (over < 0 && errno == EINTR);
    interrupt_hold();
    child = 0;
    interrupt_go();
    return over;
}

/* ------------------------------------------------------------------ the end */

static int remove_one(const char *path, const struct stat *s, int kind, struct FTW *where)
{
    (void)s, (void)kind, (void)where;
    remove(path);
    return 0;
}

void interrupt_report(void)
{
    while (atomic_flag_test_and_set(&reported))
        pause();
}

/* A file goes without an allocation, which nftw needs; the list stays locked, as the program ends. */
void interrupt_remove(void)
{
    pthread_mutex_lock(&lock);
    for (const struct temporary *t = temporaries; t; t = t->next)
        for (int k = 0; remove(t->path) != 0 && k < AGAIN && nftw(t->path, remove_one, 16, FTW_DEPTH | FTW_PHYS) == 0;
             k++)
            continue; /* until it is not there: another thread may still have made a file in the folder */
}

static _Noreturn void end(void)
{
    pthread_rwlock_wrlock(&names);
    if (atomic_flag_test_and_set(&reported))
        nanosleep(&(struct timespec){.tv_nsec = WORDS}, NULL);
    else
        err_last_words(ERR_INTERRUPTED, "interrupted; run the same command again");
    if (child > 0) {
        kill(child, SIGKILL);
        waitpid(child, NULL, 0);
    }
    interrupt_remove();
    _exit(ERR_INTERRUPTED);
}

static void *wait_for_signals(void *unused)
{
    int number = DISMISSED;
    sigset_t all = signals;
    (void)unused;
    sigaddset(&all, DISMISSED);
    while (number == DISMISSED) {
        if (dismissed) return NULL;
        sigwait(&all, &number);
    }
    seen = true;
    while (sigtimedwait(&signals, NULL, &(struct timespec){.tv_nsec = GRACE}) < 0 &&
           errno == EINTR) /* it was stopped, and goes on */
        continue;
    end();
}

/* Without the thread, signals do what they do to any program. */
void interrupt_catch(void)
{
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    signal(SIGINT, SIG_DFL); /* who started us in the background may have had them ignored */
    signal(SIGTERM, SIG_DFL);
    sigset_t all = signals;
    sigaddset(&all, DISMISSED);
    pthread_sigmask(SIG_BLOCK, &all, NULL);
    dismissed = false;
    waits = pthread_create(&waiter, NULL, wait_for_signals, NULL) == 0;
    if (!waits) pthread_sigmask(SIG_UNBLOCK, &signals, NULL);
}

/* Signals stay blocked, and wait for the next program's thread. */
bool interrupt_pass_on(void)
{
    if (waits) {
        dismissed = true;
        pthread_kill(waiter, DISMISSED);
        pthread_join(waiter, NULL);
        waits = false;
    }
    return !seen;
}

bool interrupt_seen(void) { return seen; }
