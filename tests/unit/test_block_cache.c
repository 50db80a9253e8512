/* block_cache: against a plain list of blocks in the order in which they were asked for last. */
#include "surface/block_cache.h"

#include <stdbool.h>

#include "unit.h"

enum { SIZE = 3, MOST = 64 };

static int fills;

static void numbers_of(long column, long row, double *out)
{
    out[0] = (double)column;
    out[1] = (double)row;
    out[2] = (double)(column * 1000003 + row);
}

static void filled(void *self, long column, long row, double *out)
{
    ck_assert_ptr_eq(self, &fills);
    fills++;
    numbers_of(column, row, out);
}

/* Newest first. */
struct list {
    int n;
    long at[MOST][2];
};

/* Asks for a block; is it made? */
static bool asked(struct list *l, int capacity, long column, long row)
{
    int i = 0;
    while (i < l->n && (l->at[i][0] != column || l->at[i][1] != row))
        i++;
    bool made = i == l->n;
    if (made && l->n < capacity) l->n++;
    i = i < l->n ? i : l->n - 1;
    memmove(l->at[1], l->at[0], (size_t)i * sizeof l->at[0]);
    l->at[0][0] = column;
    l->at[0][1] = row;
    return made;
}

static void compared(int capacity, bool walks)
{
    struct arena *a = arena_open();
    struct block_cache *k = block_cache_make(a, SIZE, (size_t)capacity, filled, &fills);
    struct list l = {0};
    long column = -5, row = 1L << 40, want = fills = 0;
    for (int n = 0; n < 20000; n++) {
        double told[SIZE];
        column = walks ? column + lrand48() % 3 - 1 : lrand48() % 11 - 5;
        row = walks ? row + lrand48() % 3 - 1 : (1L << 40) * (lrand48() % 7 - 3);
        want += asked(&l, capacity, column, row);
        const double *got = block_cache_at(k, column, row);
        numbers_of(column, row, told);
        ck_assert_msg(memcmp(got, told, sizeof told) == 0, "capacity %d: block %ld, %ld has another's numbers",
                      capacity, column, row);
        ck_assert_msg(fills == want, "capacity %d, asked %d times: %d blocks made, not %ld", capacity, n + 1, fills,
                      want);
    }
    ck_assert_uint_le(arena_bytes(a), block_cache_bytes(SIZE, (size_t)capacity));
    arena_close(a);
}

START_TEST(oldest_goes_first)
{
    static const int capacities[] = {1, 2, 3, 7, 16, 40, MOST};
    srand48(5);
    for (int i = 0; i < 7; i++) {
        compared(capacities[i], false);
        compared(capacities[i], true);
    }
}
END_TEST

/* To and fro over more than is held: what was met last is there at once. */
START_TEST(to_and_fro)
{
    enum { WAY = 100, HELD = 60, TURNS = 10 };
    struct arena *a = arena_open();
    struct block_cache *k = block_cache_make(a, SIZE, HELD, filled, &fills);
    fills = 0;
    for (long n = 0; n < TURNS * WAY; n++)
        block_cache_at(k, n / WAY % 2 ? WAY - 1 - n % WAY : n % WAY, 0);
    ck_assert_int_eq(fills, WAY + (TURNS - 1) * (WAY - HELD));
    arena_close(a);
}
END_TEST

UNIT("block_cache", oldest_goes_first, to_and_fro)
