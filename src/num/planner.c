/* See planner.h. FFTW stops a program that has no memory left with SIGABRT: the function that it calls then is this
   one, as a program's own definition comes before a library's when the dynamic linker binds FFTW. */
#include "num/planner.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

static pthread_mutex_t planner = PTHREAD_MUTEX_INITIALIZER;

/* The name, and what it is given, are FFTW's (kernel/assert.c); `p` is what its allocation gave. */
void fftw_assertion_failed(const char *what, int line, const char *file);
void fftw_assertion_failed(const char *what, int line, const char *file)
{
    if (strcmp(what, "p") == 0) memory_out("for a plan of FFTW");
    fprintf(stderr, "fftw: %s:%d: assertion failed: %s\n", file, line, what);
    abort();
}

void planner_lock(void) { pthread_mutex_lock(&planner); }

void planner_unlock(void) { pthread_mutex_unlock(&planner); }
