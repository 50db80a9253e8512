/* The yardstick of pipeline.py, timed between the renders: the core clock (a chain of dependent integer
   multiplications, 3 cycles each on every x86-64 of these years), and seconds a sample that 50 modes take as one would
   write them down, a mode at a time (two multiplications by a pole and a gain; scalar, its chain of additions and
   multiplications bounds it). Prints clock_hz and scalar_s. */
#include <math.h>
#include <stdio.h>

#include "bench.h"

enum { MODES = 50, FRAMES = 64, CALLS = 40, CHAIN = 3000000 };

static double clock_hz(void)
{
    uint64_t x = 3;
    double start = bench_seconds();
    for (int i = 0; i < CHAIN; i++) {
        x *= 6364136223846793005u;
        __asm__ volatile("" : "+r"(x));
    }
    return 3.0 * CHAIN / (bench_seconds() - start);
}

static double scalar_s(void)
{
    static double re[MODES], im[MODES], y[FRAMES];
    double start = bench_seconds();
    for (int c = 0; c < CALLS; c++)
        for (int i = 0; i < MODES; i++) {
            double pr = 0.999 * cos(0.01 * (i + 1)), pi = 0.999 * sin(0.01 * (i + 1));
            for (int j = 0; j < FRAMES; j++) {
                double next = pr * re[i] - pi * im[i] + 1;
                im[i] = pr * im[i] + pi * re[i];
                re[i] = next;
                y[j] += im[i];
            }
        }
    double seconds = bench_seconds() - start;
    return isfinite(y[0]) ? seconds / ((double)CALLS * FRAMES) : 0;
}

int main(void)
{
    double clock = 0, scalar = HUGE_VAL;
    for (int k = 0; k < 5; k++) {
        clock = fmax(clock, clock_hz());
        scalar = fmin(scalar, scalar_s());
    }
    printf("%.0f %.6g\n", clock, scalar);
    return 0;
}
