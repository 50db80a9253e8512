/* A box: x in [0, length], y in [0, width], z in [0, thickness]. Cells are about square in the plane. */
#include <math.h>

#include "fem/shapes_kinds.h"

enum { LENGTH, WIDTH, THICKNESS };

struct box {
    double size[3];
    int n[3];
};

static void place(const void *shape, int which, const double c[3], double at[3])
{
    (void)which;
    const struct box *b = shape;
    for (int i = 0; i < 3; i++)
        at[i] = b->size[i] * (c[i] / b->n[i]);
}

/* At least so many cells in each direction. */
static void box_blocks(const struct shapes_ask *q, const int least[3], struct arena *a, struct shapes_blocks *s)
{
    static const char *const names[3][2] = {{"x0", "x1"}, {"y0", "y1"}, {"z0", "z1"}};
    struct box *b = ARENA_TAKE(a, struct box, 1);
    *s = (struct shapes_blocks){.place = place, .shape = b};
    for (int i = 0; i < 3; i++) {
        b->size[i] = q->length[i];
        b->n[i] = shapes_kinds_cells(q, q->length[i], least[i]);
        s->size = fmax(s->size, b->size[i]);
    }
    struct shapes_block *k = shapes_blocks_add(s, 0, b->n[0], b->n[1], b->n[2]);
    for (int i = 0; i < 6; i++)
        k->side[i / 2][i % 2] = names[i / 2][i % 2];
}

static void plate_blocks(const struct shapes_ask *q, struct arena *a, struct shapes_blocks *s)
{
    int across = (q->fineness + 1) / 2;
    box_blocks(q, (int[3]){across, across, across}, a, s);
}

static void bar_blocks(const struct shapes_ask *q, struct arena *a, struct shapes_blocks *s)
{
    box_blocks(q, (int[3]){4 * q->fineness, q->fineness, q->fineness}, a, s);
}

static bool check(struct shapes_ask *q, struct err *e)
{
    (void)q, (void)e;
    return true;
}

const struct shapes_kind shapes_plate = {"plate", {"length", "width", "thickness"}, 3, 3, 18000, check, plate_blocks};
const struct shapes_kind shapes_plate_bar = {"bar", {"length", "width", "thickness"}, 3, 3, 11000, check, bar_blocks};
