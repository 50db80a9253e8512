/* tiles_patches: whatever was read before, a patch has the coefficients that a store which holds nothing makes, and those
   that its neighbours have; it is made once while there is room. That they are the sum of the bands is tested in
   test_tiles. */
#include "surface/tiles.h"

#include <stdbool.h>

#include "unit.h"

enum { BANDS = 7, SQUARE = PATCH_SIDE * PATCH_SIDE, SHARED = PATCH_SIDE - PATCH_CELLS };

static double lines[BANDS][TILE_SIDE * TILE_ROW];
static const double *tiles[BANDS];
static struct noise streams[BANDS];
static const struct patches_plan ground = {BANDS, tiles, streams, false};

static void ground_make(void)
{
    srand48(11);
    for (int b = 0; b < BANDS; b++) {
        for (int j = 0; j < TILE_SIDE; j++)
            for (int i = 0; i < TILE_ROW; i++)
                lines[b][j * TILE_ROW + i] = i < TILE_SIDE ? drand48() - 0.5 : lines[b][j * TILE_ROW + i - TILE_SIDE];
        tiles[b] = lines[b];
        streams[b] = (struct noise){(uint64_t)(77 + b)};
    }
}

static void check_alone(struct patches *p, long column, long row)
{
    struct arena *a = arena_open();
    const double *got = tiles_patch(p, column, row), *want = tiles_patch(tiles_patches(a, &ground), column, row);
    ck_assert_msg(memcmp(got, want, SQUARE * sizeof *got) == 0, "patch %ld, %ld is not what it is by itself", column,
                  row);
    arena_close(a);
}

static void check_neighbours(struct patches *p, long column, long row)
{
    double own[SQUARE];
    memcpy(own, tiles_patch(p, column, row), sizeof own);
    const double *right = tiles_patch(p, column + 1, row);
    for (int j = 0; j < PATCH_SIDE; j++)
        ck_assert(memcmp(own + j * PATCH_SIDE + PATCH_CELLS, right + j * PATCH_SIDE, SHARED * sizeof *own) == 0);
    const double *above = tiles_patch(p, column, row + 1);
    ck_assert(memcmp(own + PATCH_CELLS * PATCH_SIDE, above, SHARED * PATCH_SIDE * sizeof *own) == 0);
}

/* Some 60 000 patches, to and fro over some place, then elsewhere: more than are held. */
START_TEST(the_same_in_any_order)
{
    ground_make();
    struct arena *a = arena_open();
    struct patches *p = tiles_patches(a, &ground);
    size_t before = arena_bytes(a);
    for (int n = 0; n < 300; n++) {
        long column = lrand48() % 2000 - 1000, row = lrand48() % 2000 - 1000, far = lrand48() % 100,
             dx = lrand48() % 3 - 1, dy = lrand48() % 3 - 1;
        for (long i = 0; i < 2 * far; i++)
            tiles_patch(p, column + dx * (i < far ? i : 2 * far - i), row + dy * (i < far ? i : 2 * far - i));
        for (int j = 0; j < 30; j++)
            tiles_patch(p, column + lrand48() % 20, row + lrand48() % 20);
        check_alone(p, column, row);
        check_alone(p, column + lrand48() % 20, row + lrand48() % 20);
        check_neighbours(p, column, row);
    }
    ck_assert_uint_le(before, tiles_bytes(BANDS, false));
    ck_assert_uint_le(arena_bytes(a), tiles_bytes(BANDS, false));
    ck_assert_uint_ge(arena_bytes(a), tiles_bytes(BANDS, false) / 2);
    arena_close(a);
}
END_TEST

/* A line to and fro: each patch that is met is made once, of the finest band and of those that they are made of: half
   as many of each coarser band, and one more at each step of a row. Far longer than what is held, and what was met last
   is still there. */
START_TEST(made_once)
{
    ground_make();
    struct arena *a = arena_open();
    struct patches *p = tiles_patches(a, &ground);
    enum { WAY = 1500, LONG = 6000, THERE = 3000 };
    for (long i = 0; i < WAY; i++)
        tiles_patch(p, i, i / 3);
    size_t once = tiles_patches_made(p);
    ck_assert_uint_ge(once, WAY);
    ck_assert_uint_le(once, WAY + 2 * (WAY / 2 + WAY / 3));
    for (long i = 0; i < 8 * WAY; i++)
        tiles_patch(p, i / WAY % 2 ? i % WAY : WAY - 1 - i % WAY, (i / WAY % 2 ? i % WAY : WAY - 1 - i % WAY) / 3);
    ck_assert_uint_eq(tiles_patches_made(p), once);
    for (long i = 0; i < LONG; i++)
        tiles_patch(p, i, 1000);
    once = tiles_patches_made(p);
    for (long i = 0; i < THERE; i++)
        tiles_patch(p, LONG - 1 - i, 1000);
    ck_assert_uint_eq(tiles_patches_made(p), once);
    arena_close(a);
}
END_TEST

UNIT("tiles_patches", the_same_in_any_order, made_once)
