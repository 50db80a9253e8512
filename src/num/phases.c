/* PHASES_WIDE outputs at a time, so that inputs and taps are loaded once for all and no sum over lanes is left: with a
   sum over the lanes of each output it took half as long again. The additions of one register wait for each other,
   those of four do not. Inputs are sorted by their remainder by `each`, so that those of one tap lie side by side. */
#include "num/phases.h"

#include <limits.h>
#include <math.h>
#include <string.h>

struct phases phases_make(struct arena *a, const struct filter *f, int each, long outputs)
{
    int turns = (f->taps + each - 1) / each;
    struct phases p = {f->reach, f->taps, each, turns, outputs + turns, ARENA_TAKE(a, double, (long)turns *each)};
    memcpy(p.tap, f->tap, (size_t)f->taps * sizeof *f->tap);
    return p;
}

long phases_room(const struct phases *p) { return p->each * p->row + PHASES_WIDE; }

/* n <= PHASES_WIDE values; all of them by a size that the compiler knows, or it calls for each. */
static inline void move(double *to, const double *from, long n)
{
    if (n == PHASES_WIDE)
        memcpy(to, from, PHASES_WIDE * sizeof *to);
    else
        memcpy(to, from, (size_t)n * sizeof *to);
}

/* Turns in which all taps meet zeros are left out: x is 0 but for first <= each i + j < end. */
LANES_CLONES
static void add_taps(const struct phases *p, const double *x, long first, long end, long n, bool adds, double *y)
{
    const double *tap = p->tap;
    long each = p->each, row = p->row;
    for (long i = 0; i < n; i += PHASES_WIDE) {
        double sum[4][LANES] = {{0}};
        long some = n - i < PHASES_WIDE ? n - i : PHASES_WIDE, from = first / each - (i + PHASES_WIDE - 1),
             to = (end - 1) / each + 1 - i;
        if (adds) move(sum[0], y + i, some);
        for (long k = from > 0 ? from : 0; k < to && k < p->turns; k++)
            for (long r = 0; r < each; r++)
#pragma omp simd
                for (int l = 0; l < LANES; l++) {
                    const double *at = x + i + k + r * row + l;
                    double by = tap[k * each + r];
                    sum[0][l] = fma(by, at[0], sum[0][l]);
                    sum[1][l] = fma(by, at[LANES], sum[1][l]);
                    sum[2][l] = fma(by, at[2 * LANES], sum[2][l]);
                    sum[3][l] = fma(by, at[3 * LANES], sum[3][l]);
                }
        move(y + i, sum[0], some);
    }
}

void phases_run(const struct phases *p, const double *x, long first, long end, long n, bool adds, double *y,
                double *room)
{
    for (int r = 0; r < p->each; r++)
        for (long i = 0; i < n + p->turns; i++)
            room[r * p->row + i] = x[i * p->each + r];
    add_taps(p, room, first, end, n, adds, y);
}

void phases_add(const double *tap, int taps, int stride, const double *x, long n, double *y)
{
    struct phases p = {.each = taps, .turns = 1, .row = stride, .tap = (double *)tap};
    add_taps(&p, x, 0, LONG_MAX / 2, n, true, y);
}
