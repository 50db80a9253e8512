/* See envelope.h. The ball is the sphere itself, not the paraboloid that touches it: its cap is

     cap(d) = sqrt(R^2 - d^2) - R = -d^2 / (R + sqrt(R^2 - d^2))  <=  -d^2 / (2 R)

   The search goes down a pyramid of the largest heights of 4 x 4, 16 x 16 ... samples and leaves out whatever lies,
   with the paraboloid's cap at its nearest corner, below the best so far, which begins with where the ball touched at
   the point before: on a rough surface it rests on the same asperity for most of its way. Being the largest of the same
   numbers in any order, the result does not depend on the path of the search; the bound is loosened by 1e-14 so that
   its rounding leaves nothing out. */
#include "surface/envelope.h"

#include <math.h>

#include "num/lanes.h"

enum { FACTOR = 4, LEVELS = 16 };

struct level {
    long columns, rows; /* whole blocks of the next level: what lies beyond the heights is -HUGE_VAL */
    double span;        /* samples of a side */
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

static long shrunk(long n, long factor) { return (n + factor - 1) / factor; }

struct envelope *envelope_make(struct arena *a, double radius, double pitch, long columns, long rows)
{
    struct envelope *e = ARENA_TAKE(a, struct envelope, 1);
    *e = (struct envelope){.radius = radius,
                           .square = radius * radius,
                           .loose = (1 - 1e-14) / (2 * radius),
                           .unit = pitch * pitch,
                           .tall = rows > 1 ? FACTOR : 1};
    for (double span = 1;; span *= FACTOR) {
        long wide = shrunk(columns, FACTOR) * FACTOR, high = shrunk(rows, e->tall) * e->tall;
        struct level *l = &e->levels[e->top];
        *l = (struct level){wide, high, span, ARENA_TAKE(a, double, wide *high)};
        for (long i = 0; i < wide * high; i++)
            l->most[i] = -HUGE_VAL;
        columns = wide / FACTOR;
        rows = high / e->tall;
        if ((columns == 1 && rows == 1) || e->top == LEVELS - 1) return e;
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

/* Of two that reach alike the first row's and column's counts: where the ball touches depends on nothing else. */
static void try(struct envelope *e, long x, long y)
{
    const struct level *l = &e->levels[0];
    double dx = (double)x - e->x, dy = (double)y - e->y, square = (dx * dx + dy * dy) * e->unit;
    double reached = l->most[y * l->columns + x] - square / (e->radius + sqrt(e->square - square));
    if (reached > e->best || (reached == e->best && (y < e->seed_y || (y == e->seed_y && x < e->seed_x)))) {
        e->best = reached;
        e->seed_x = x;
        e->seed_y = y;
    }
}

/* Square of the distance from `at`, in samples, to the nearest of those from `first` to `first` + last. */
static inline __attribute__((always_inline)) double distance_squared(double first, double last, double at)
{
    double from = first - at, d = lanes_select(from > 0, from, lanes_select(from + last < 0, from + last, 0));
    return d * d;
}

/* What the ball can reach at most in each of the FACTOR x tall blocks from (x, y) on; bit k of what is returned: block
 * k is within its radius, and that is more than the best so far. */
LANES_CLONES
static int promising(const struct envelope *e, const struct level *l, long x, long y, double *bound)
{
    static const double nth[FACTOR] = {0, 1, 2, 3},
                        bits[FACTOR * FACTOR] = {1,   2,   4,    8,    16,   32,   64,    128,
                                                 256, 512, 1024, 2048, 4096, 8192, 16384, 32768};
    double left[FACTOR], below[FACTOR], found[FACTOR] = {0}, column = (double)x, row = (double)y, last = l->span - 1;
#pragma omp simd
    for (int i = 0; i < FACTOR; i++) {
        left[i] = distance_squared((column + nth[i]) * l->span, last, e->x);
        below[i] = distance_squared((row + nth[i]) * l->span, last, e->y);
    }
    for (int j = 0; j < e->tall; j++) {
        const double *most = l->most + (y + j) * l->columns + x;
#pragma omp simd
        for (int i = 0; i < FACTOR; i++) {
            double square = (left[i] + below[j]) * e->unit, b = most[i] - square * e->loose;
            bound[j * FACTOR + i] = b;
            found[i] += lanes_select((b >= e->best) & (square <= e->square), bits[j * FACTOR + i], 0);
        }
    }
    return (int)((found[0] + found[1]) + (found[2] + found[3]));
}

/* Block (column, row) of the level above `level`. */
static void search(struct envelope *e, int level, long column, long row)
{
    double bound[FACTOR * FACTOR];
    long x = column * FACTOR, y = row * e->tall;
    for (int left = promising(e, &e->levels[level], x, y, bound); left; left &= left - 1) {
        int k = __builtin_ctz((unsigned)left);
        if (bound[k] < e->best) continue;
        if (level == 0)
            try(e, x + k % FACTOR, y + k / FACTOR);
        else
            search(e, level - 1, x + k % FACTOR, y + k / FACTOR);
    }
}

double envelope_at(struct envelope *e, long column, long row, long place[2])
{
    const struct level *l = &e->levels[0];
    long x = e->seed_x, y = e->seed_y;
    double dx = (double)(column - x), dy = (double)(row - y);
    e->x = (double)column;
    e->y = (double)row;
    e->best = l->most[row * l->columns + column];
    e->seed_x = column;
    e->seed_y = row;
    if ((dx * dx + dy * dy) * e->unit <= e->square) try(e, x, y);
    const struct level *top = &e->levels[e->top];
    for (long j = 0; j < top->rows / e->tall; j++)
        for (long i = 0; i < top->columns / FACTOR; i++)
            search(e, e->top, i, j);
    place[0] = e->seed_x;
    place[1] = e->seed_y;
    return e->best;
}
