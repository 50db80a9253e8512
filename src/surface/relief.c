/* See relief.h. */
#include "surface/relief.h"

#include <math.h>
#include <string.h>

#include "base/stopwatch.h"
#include "scene/rows.h"
#include "stage.h"

void relief_add(struct relief *r, struct relief_part *part)
{
    struct relief_part **end = &r->first;
    while (*end)
        end = &(*end)->next;
    *end = part;
}

struct relief_part *relief_endless(struct arena *a, const char *name, double finest,
                                   void (*add)(struct relief_part *, const struct relief_points *,
                                               const struct relief_values *),
                                   void *state)
{
    struct relief_part *part = ARENA_TAKE(a, struct relief_part, 1);
    *part = (struct relief_part){.name = name,
                                 .finest = finest,
                                 .from = {-HUGE_VAL, -HUGE_VAL},
                                 .to = {HUGE_VAL, HUGE_VAL},
                                 .reading = 20,
                                 .add = add,
                                 .state = state};
    return part;
}

void relief_close(struct stage_run *r)
{
    struct relief_part *part = r->state;
    if (part && part->close) part->close(part);
}

double relief_shift(const struct relief *r, int axis)
{
    return r->along == ALONG_PLANE || (r->along == ALONG_X && axis == 0) ? r->origin[axis] : 0;
}

enum { SHIFTED = 256 };

static double *advanced(double *x, size_t by) { return x ? x + by : NULL; }

/* In the surface's own coordinates, some points at a time. */
static void relief_shifted(const struct relief *r, const struct relief_points *p, const struct relief_values *v)
{
    double x[SHIFTED], y[SHIFTED], dx = relief_shift(r, 0), dy = relief_shift(r, 1);
    for (size_t first = 0, n; first < p->n; first += n) {
        n = p->n - first < SHIFTED ? p->n - first : SHIFTED;
        for (size_t i = 0; i < n; i++) {
            x[i] = p->x[first + i] - dx;
            y[i] = p->y ? p->y[first + i] - dy : 0;
        }
        struct relief_points points = {n, x, p->y ? y : NULL};
        struct relief_values values = {advanced(v->z, first),  advanced(v->x, first),  advanced(v->y, first),
                                       advanced(v->xx, first), advanced(v->xy, first), advanced(v->yy, first)};
        for (struct relief_part *part = r->first; part; part = part->next)
            part->add(part, &points, &values);
    }
}

void relief_at(const struct relief *r, const struct relief_points *p, const struct relief_values *v)
{
    double reading = 5;
    for (const struct relief_part *part = r->first; part; part = part->next)
        reading += part->reading;
    stopwatch_spend(reading * (double)p->n);
    double *all[6] = {v->z, v->x, v->y, v->xx, v->xy, v->yy};
    for (int k = 0; k < 6; k++)
        if (all[k]) memset(all[k], 0, p->n * sizeof(double));
    if (relief_shift(r, 0) != 0 || relief_shift(r, 1) != 0) {
        relief_shifted(r, p, v);
        return;
    }
    for (struct relief_part *part = r->first; part; part = part->next)
        part->add(part, p, v);
}

void relief_decide(struct relief *r, const struct contact *c)
{
    if (r->along == ALONG_AUTO) r->along = relief_along(c);
}

double relief_finest(const struct relief *r)
{
    double finest = HUGE_VAL;
    for (const struct relief_part *p = r->first; p; p = p->next) {
        finest = fmin(finest, p->finest);
        for (int k = 0; k < 2; k++)
            finest = p->pitch[k] > 0 ? fmin(finest, p->pitch[k]) : finest;
    }
    return finest;
}

double relief_kinks(const struct relief *r)
{
    double kinks = 0;
    for (const struct relief_part *p = r->first; p; p = p->next)
        if (p->kinks > 0) kinks = kinks > 0 ? fmin(kinks, p->kinks) : p->kinks;
    return kinks;
}

/* ------------------------------------------------------------------ keys */

static const struct choice alongs[] = {
    [ALONG_AUTO] = {"auto", "plane for a map of several rows, for roughness or ridges with a direction, and under a "
                            "curved motion; else path"},
    [ALONG_PATH] = {"path", "the signed distance along the motion, 0 where it starts"},
    [ALONG_X] = {"x", "the x coordinate; the profile is extruded along y"},
    [ALONG_PLANE] = {"plane", "the surface has two dimensions: what lies at the contact's x and y"},
    {NULL, NULL}};

static const struct key keys[] = {{ROW_FILE(contact, surface.recipe, "surface.recipe"), KEY_NONE, 0, 0, "", NULL,
                                   "YAML file of surface keys (roughness, ridges, grit, ...), such as those in "
                                   "surfaces/; keys of the scene itself win over it",
                                   .example = "rough.yaml", .shown = "plank.yaml"},
                                  {ROW_CHOICE(contact, surface.along, "surface.along"), KEY_NONE, 0, 0, "auto", NULL,
                                   "which coordinates the surface follows", alongs},
                                  {ROW_POINT(contact, surface.origin, "surface.origin"), KEY_LENGTH, -100, 100,
                                   "[0 m, 0 m]", "surface.along=auto|x|plane",
                                   "where the surface begins in the scene's coordinates: the first sample of a height "
                                   "map, x = y = 0 of what is procedural"},
                                  {.path = NULL}};

static const struct params relief_params = {.section = "surface",
                                            .keys = keys,
                                            .alternative = {.applies = "contact.model=scrape|roll|playback",
                                                            .least = 1,
                                                            .most = 5,
                                                            .paths = {"surface.roughness", "surface.height_map", "*"}}};

/* The surface under the contact: an empty relief to which the stages behind this one add their parts. */

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

const struct stage relief_stage = {
    .name = "surface",
    .params = &relief_params,
    .does = "the surface, as the sum of what follows",
    .paper = "000 sec. 2.2",
    .idle = "",
    .gives = ITEM_BIT(ITEM_SURFACE),
    .wanted = surface_wanted,
    .open = surface_open,
};
