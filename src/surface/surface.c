/* The surface under the contact: an empty relief to which the stages behind this one add their parts. */
#include "stage.h"
#include "surface/relief.h"

static bool surface_wanted(const struct contact *c, const struct scene *s)
{
    (void)c, (void)s;
    return true;
}

static bool surface_open(struct stage_run *r, struct err *e)
{
    (void)e;
    r->board->relief = ARENA_TAKE(r->arena, struct relief, 1);
    r->board->relief->along = r->contact->surface.along;
    for (int k = 0; k < 2 && r->contact->surface.along != ALONG_PATH; k++)
        r->board->relief->origin[k] = r->contact->surface.origin[k];
    return true;
}

const struct stage surface_stage = {
    .name = "surface",
    .does = "the surface, as the sum of what follows",
    .paper = "000 sec. 2.2",
    .idle = "",
    .gives = ITEM_BIT(ITEM_SURFACE),
    .wanted = surface_wanted,
    .open = surface_open,
};
