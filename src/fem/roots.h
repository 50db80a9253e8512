/* Which things belong together, as pairs are joined (union and find with path halving; the least index is the root). */
#ifndef FEM_ROOTS_H
#define FEM_ROOTS_H
#include "base/arena.h"

static inline int *roots_open(int n, struct arena *a)
{
    int *root = ARENA_TAKE(a, int, n);
    for (int i = 0; i < n; i++)
        root[i] = i;
    return root;
}

static inline int roots_of(int *root, int i)
{
    while (root[i] != i)
        i = root[i] = root[root[i]];
    return i;
}

static inline void roots_join(int *root, int i, int j)
{
    i = roots_of(root, i);
    j = roots_of(root, j);
    root[i > j ? i : j] = i > j ? j : i;
}

#endif
