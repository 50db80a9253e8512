/* See faces.h. */
#include "fem/faces.h"

#include <stdlib.h>
#include <string.h>

const int faces_nodes[4][6] = {{1, 2, 3, 5, 9, 8}, {0, 3, 2, 7, 9, 6}, {0, 1, 3, 4, 8, 7}, {0, 2, 1, 6, 5, 4}};

static int by_corners(const void *p, const void *q)
{
    const struct faces_face *f = p, *g = q;
    for (int i = 0; i < 3; i++)
        if (f->corner[i] != g->corner[i]) return f->corner[i] < g->corner[i] ? -1 : 1;
    if (f->element != g->element) return f->element < g->element ? -1 : 1;
    return (f->side > g->side) - (f->side < g->side);
}

static void order(int *a, int *b)
{
    if (*a > *b) {
        int t = *a;
        *a = *b;
        *b = t;
    }
}

struct faces_face *faces_sorted(const struct mesh *m, struct arena *a)
{
    size_t n = 4 * (size_t)m->elements;
    struct faces_face *f = ARENA_TAKE(a, struct faces_face, n);
    for (size_t i = 0; i < n; i++) {
        f[i].element = (int)(i / 4);
        f[i].side = (int)(i % 4);
        for (int c = 0; c < 3; c++)
            f[i].corner[c] = m->element[i / 4][faces_nodes[i % 4][c]];
        order(&f[i].corner[0], &f[i].corner[1]);
        order(&f[i].corner[1], &f[i].corner[2]);
        order(&f[i].corner[0], &f[i].corner[1]);
    }
    qsort(f, n, sizeof *f, by_corners);
    return f;
}

int faces_alike(const struct faces_face *f, int left)
{
    int n = 1;
    while (n < left && !memcmp(f[n].corner, f[0].corner, sizeof f->corner))
        n++;
    return n;
}
