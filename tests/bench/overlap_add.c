/* Convolution with responses of 1 s at 44.1 kHz, whole seconds of noise: time and how many times faster than real time,
   for responses passed one after the other (two at once have a share), for shares that all responses have all the time,
   and for one alone. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bench.h"
#include "convolution/overlap_add.h"

enum { RATE = 44100, FRAMES = 10 * RATE, ROOM = FRAMES + 65536, REPEATS = 5, CALL = 1024 };

static double force[ROOM], sound[ROOM];

static void response(void *self, long k, double *h, size_t length)
{
    (void)self;
    for (size_t i = 0; i < length; i++)
        h[i] = (double)((i * 2654435761u + (size_t)k * 977) % 1001) / 1001 - 0.5;
}

/* Linear between neighbours, from the first to the last in the whole time. */
static int passing(void *self, long first, int n, int k, double *w)
{
    int keys = *(int *)self, any = 0;
    for (int i = 0; i < n; i++) {
        double away = fabs((double)(first + i) / FRAMES * (keys - 1) - k);
        w[i] = away < 1 ? 1 - away : 0;
        any |= away < 1;
    }
    return any;
}

static int everywhere(void *self, long first, int n, int k, double *w)
{
    for (int i = 0; i < n; i++)
        w[i] = 1.0 / (*(int *)self + k + (int)(first & 1));
    return 1;
}

static double convolved(int keys, overlap_add_share *share)
{
    double best = HUGE_VAL;
    for (int r = 0; r < REPEATS; r++) {
        struct overlap_add *p = overlap_add_open(&(struct overlap_add_source){keys, RATE, share, response, &keys});
        double start = bench_seconds();
        for (long at = 0; at + CALL <= FRAMES; at += CALL)
            overlap_add_run(p, force + at, sound + at, CALL);
        best = fmin(best, bench_seconds() - start);
        overlap_add_close(p);
    }
    return best;
}

static void row(const char *name, int keys, double seconds)
{
    printf("%s,%d,%.1f,%.0f\n", name, keys, 1e3 * seconds, 10 / seconds);
}

int main(void)
{
    static const int counts[] = {2, 8, 32, 128};
    for (int i = 0; i < FRAMES; i++)
        force[i] = rand() / (double)RAND_MAX - 0.5;
    printf("what,responses,ms_per_10_s,times_real_time\n");
    row("one that gets all", 1, convolved(1, NULL));
    for (int i = 0; i < 4; i++)
        row("passed one after the other", counts[i], convolved(counts[i], passing));
    for (int i = 0; i < 4; i++)
        row("all at once", counts[i], convolved(counts[i], everywhere));
    return 0;
}
