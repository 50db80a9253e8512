/* See stopwatch.h: clock_gettime, nanosecond resolution; differences of two readings are what counts. */
#include "base/stopwatch.h"

#include <time.h>

static double read_clock(clockid_t clock)
{
    struct timespec t = {0};
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double stopwatch_wall(void) { return read_clock(CLOCK_MONOTONIC); }

double stopwatch_cpu(void) { return read_clock(CLOCK_THREAD_CPUTIME_ID); }

static _Thread_local double spent;

double stopwatch_cycles(void) { return spent; }

void stopwatch_spend(double cycles) { spent += cycles; }
