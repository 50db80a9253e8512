/* decimal_9g beside printf's %.9g, in the same run: 20 million numbers, signs and exponents at random, of which none
   may be written differently.

       cc -O2 -std=c11 -D_GNU_SOURCE -Isrc tests/bench/decimal.c src/num/decimal.c -lm */
#include "num/decimal.h"

#include <math.h>
#include <stdio.h>

#include "bench.h"

enum { COUNT = 100000, ROUNDS = 200 };

static double x[COUNT];
static char ours[COUNT][DECIMAL_ROOM], theirs[COUNT][32];
static size_t length[COUNT];

int main(void)
{
    uint64_t seed = 1;
    double least[2] = {HUGE_VAL, HUGE_VAL}, bytes = 0;
    long differing = 0;
    for (int round = 0; round < ROUNDS; round++) {
        for (int i = 0; i < COUNT; i++)
            x[i] = ldexp(bench_draw(&seed), (int)(16 * bench_draw(&seed)));
        double start = bench_seconds(), middle;
        for (int i = 0; i < COUNT; i++)
            length[i] = decimal_9g(x[i], ours[i]);
        middle = bench_seconds();
        bytes = 0;
        for (int i = 0; i < COUNT; i++)
            bytes += snprintf(theirs[i], sizeof theirs[i], "%.9g", x[i]) + 1;
        least[0] = fmin(least[0], middle - start);
        least[1] = fmin(least[1], bench_seconds() - middle);
        for (int i = 0; i < COUNT; i++)
            differing += strlen(theirs[i]) != length[i] || memcmp(ours[i], theirs[i], length[i]) != 0;
    }
    printf("%%.9g: %.0f MB/s, %.1f ns a number; printf %.0f MB/s, %.1f ns: %.1f times faster; %ld of %d differ\n",
           bytes / least[0] / 1e6, 1e9 * least[0] / COUNT, bytes / least[1] / 1e6, 1e9 * least[1] / COUNT,
           least[1] / least[0], differing, COUNT * ROUNDS);
    return differing != 0;
}
