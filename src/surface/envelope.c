/* See envelope.h. The ball is the sphere itself, not the paraboloid that touches it: its cap is

     cap(d) = sqrt(R^2 - d^2) - R = -d^2 / (R + sqrt(R^2 - d^2))  <=  -d^2 / (2 R)

   The search goes down a pyramid of the largest heights of 4 x 4, 16 x 16 ... samples and leaves out whatever lies, with the paraboloid's cap at
   its nearest corner, below the best so far, which begins with where the ball touched at the point before: on a rough surface it rests on the
   same asperity for most of its way. Being the largest of the same numbers in any order, the result does not depend on the path of the search;
   the bound is loosened by 1e-14 so that its rounding leaves nothing out. */
#include "surface/envelope.h"

#include <math.h>

#include "num/lanes.h"

enum { FACTOR = 4, LEVELS = 16 };

struct level {
    long columns, rows;     /* whole blocks of the next level: what lies beyond the heights is -HUGE_VAL */
    double span;            /* samples of a side */
    double *most;
};

struct envelope {
    double radius, square, loose, unit; /* R, R^2, a bit less than 1/(2 R), pitch^2 */
    int top, tall;                      /* tall: rows of a block, 1 or FACTOR       */
    struct level levels[LEVELS];        /* level 0: the heights */
    long seed_x, seed_y;                /* where the ball touched last */
    double x, y;                        /* where it is, in samples */
    double best;
};

static long shrunk(long n, long factor)
{
    return (n + factor - 1) / factor;
}

struct envelope *envelope_make(struct arena *a, double radius, double pitch, long columns, long rows)
{
    struct envelope *e = ARENA_TAKE(a, struct envelope, 1);
    *e = (struct envelope){.radius = radius, .square = radius * radius, .loose = (1 - 1e-14) / (2 * radius), .unit = pitch * pitch,
                           .tall = rows > 1 ? FACTOR : 1};
    for (double span = 1;; span *= FACTOR) {
        long wide = shrunk(columns, FACTOR) * FACTOR, high = shrunk(rows, e->tall) * e->tall;
        struct level *l = &e->levels[e->top];
        *l = (struct level){wide, high, span, ARENA_TAKE(a, double, wide * high)};
        for (long i = 0; i < wide * high; i++)
            l->most[i] = -HUGE_VAL;
        columns = wide / FACTOR;
        rows = high / e->tall;
        if ((columns == 1 && rows == 1) || e->top == LEVELS - 1)
            return e;
        e->top++;
    }
}

double *envelope_heights(struct envelope *e, long *stride)
{
    *stride = e->levels[0].columns;
    return e->levels[0].most;
}

/* The largest of FACTOR rows, column by column; then of FACTOR columns. */
LANES_CLONES
static void level_shrink(const struct level *fine, struct level *l, int tall, long columns)
{
    double row[4096];
    for (long y = 0; y < fine->rows / tall; y++)
        for (long first = 0; first < columns; first += 4096 / FACTOR) {
            long n = (columns - first < 4096 / FACTOR ? columns - first : 4096 / FACTOR) * FACTOR;
            for (long x = 0; x < n; x++)
                row[x] = fine->most[y * tall * fine->columns + first * FACTOR + x];
            for (int k = 1; k < tall; k++) {
                const double *from = fine->most + (y * tall + k) * fine->columns + first * FACTOR;
#pragma omp simd
                for (long x = 0; x < n; x++)
                    row[x] = from[x] > row[x] ? from[x] : row[x];
            }
            for (long x = 0; x < n / FACTOR; x++) {
                double a = row[4 * x] > row[4 * x + 1] ? row[4 * x] : row[4 * x + 1];
                double b = row[4 * x + 2] > row[4 * x + 3] ? row[4 * x + 2] : row[4 * x + 3];
                l->most[y * l->columns + first + x] = a > b ? a : b;
            }
        }
}

void envelope_prepare(struct envelope *e)
{
    for (int k = 1; k <= e->top; k++)
        level_shrink(&e->levels[k - 1], &e->levels[k], e->tall, e->levels[k - 1].columns / FACTOR);
    e->seed_x = e->seed_y = 0;
}

static void try(struct envelope *e, long x, long y, double square)
{
    const struct level *l = &e->levels[0];
    double reached = l->most[y * l->columns + x] - square / (e->radius + sqrt(e->square - square));
    if (reached > e->best) {
        e->best = reached;
        e->seed_x = x;
        e->seed_y = y;
    }
}

/* Squares of the distances to the nearest sample of the FACTOR x tall blocks from (x, y) on, and what the ball can reach there at most. */
LANES_CLONES
static void bounds(const struct envelope *e, const struct level *l, long x, long y, double *square, double *bound)
{
    double left[FACTOR], last = l->span - 1;
    for (int i = 0; i < FACTOR; i++) {
        double from = (double)(x + i) * l->span - e->x, d = from > 0 ? from : from + last < 0 ? from + last : 0;
        left[i] = d * d;
    }
    for (int j = 0; j < e->tall; j++) {
        double from = (double)(y + j) * l->span - e->y, d = from > 0 ? from : from + last < 0 ? from + last : 0, below = d * d;
        const double *most = l->most + (y + j) * l->columns + x;
#pragma omp simd
        for (int i = 0; i < FACTOR; i++) {
            square[j * FACTOR + i] = (left[i] + below) * e->unit;
            bound[j * FACTOR + i] = most[i] - square[j * FACTOR + i] * e->loose;
        }
    }
}

/* Block (column, row) of the level above `level`. */
static void search(struct envelope *e, int level, long column, long row)
{
    double square[FACTOR * FACTOR], bound[FACTOR * FACTOR];
    long x = column * FACTOR, y = row * e->tall;
    bounds(e, &e->levels[level], x, y, square, bound);
    for (int k = 0; k < FACTOR * e->tall; k++) {
        if (bound[k] <= e->best || square[k] > e->square)
            continue;
        if (level == 0)
            try(e, x + k % FACTOR, y + k / FACTOR, square[k]);
        else
            search(e, level - 1, x + k % FACTOR, y + k / FACTOR);
    }
}

double envelope_at(struct envelope *e, long column, long row)
{
    const struct level *l = &e->levels[0];
    long x = e->seed_x, y = e->seed_y;
    double dx = (double)(column - x), dy = (double)(row - y), square = (dx * dx + dy * dy) * e->unit;
    e->x = (double)column;
    e->y = (double)row;
    e->best = l->most[row * l->columns + column];
    e->seed_x = column;
    e->seed_y = row;
    if (square <= e->square)
        try(e, x, y, square);
    const struct level *top = &e->levels[e->top];
    for (long j = 0; j < top->rows / e->tall; j++)
        for (long i = 0; i < top->columns / FACTOR; i++)
            search(e, e->top, i, j);
    return e->best;
}
