/* See lift.h. The force jumps where the normal force N(t) passes through 0, at the share q0 = a / (a - b) of a
   sub-interval in which N goes from a to b. A force f = f_0 + g q has

     early = integral of (1 - q) f dq = f_0/2 + g/6        late = integral of q f dq = f_0/2 + g/3

   and of these the integrals from 0 to q0, or from q0 to 1, are taken instead. What is left out is f'' dt^2 and N''
   dt^2 over the one sub-interval: a jump, whose place is known to second order. */
#include "force/lift.h"

#include <math.h>

#include "force/way.h"

const double *lift_load(const struct board *b, long first)
{
    return board_has(b, ITEM_LOAD) ? way_values(b, ITEM_LOAD, first) : NULL;
}

double lift_pressed(double a, double b)
{
    double most = fmax(a, b), least = fmin(a, b);
    return least >= 0 ? 1 : most > 0 ? most / (most - least) : 0;
}

void lift_cut(double a, double b, double *early, double *late)
{
    double share = lift_pressed(a, b), from = a < 0 ? 1 - share : 0, to = a < 0 ? 1 : share;
    if (share == 1) return;
    double start = 4 * *early - 2 * *late, rise = 6 * (*late - *early), square = to * to - from * from,
           cube = to * to * to - from * from * from;
    double whole = start * share + 0.5 * rise * square;
    *late = 0.5 * start * square + rise * cube / 3;
    *early = whole - *late;
}

void lift_count(struct board *b, long first, int n)
{
    const double *load = lift_load(b, first);
    for (int i = 0; load && i < n; i++)
        if ((first + i) / b->over < b->moving - 1)
            b->lifted += (1 - lift_pressed(load[i], load[i + 1])) / (b->rate * b->over);
}
