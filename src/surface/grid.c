/* See grid.h. */
#include "surface/grid.h"

#include <string.h>

long grid_block(long i, long n) { return i >= 0 ? i / n : -((-i + n - 1) / n); }

void grid_gather(const struct grid *g, const long from[2], const long size[2], double *out, long stride)
{
    for (long by = grid_block(from[1], g->side[1]); by * g->side[1] < from[1] + size[1]; by++)
        for (long bx = grid_block(from[0], g->side[0]); bx * g->side[0] < from[0] + size[0]; bx++) {
            const double *b = kept_at(g->blocks, bx, by);
            long x = bx * g->side[0] - from[0], y = by * g->side[1] - from[1];
            long x0 = x > 0 ? x : 0, x1 = x + g->side[0] < size[0] ? x + g->side[0] : size[0];
            for (long j = y > 0 ? y : 0; j < y + g->side[1] && j < size[1]; j++)
                memcpy(out + j * stride + x0, b + (j - y) * g->side[0] + (x0 - x), (size_t)(x1 - x0) * sizeof *out);
        }
}
