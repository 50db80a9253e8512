/* See chart.h. */
#include "fem/chart.h"

#include <math.h>
#include <string.h>

#include "num/real.h"

const char *const chart_faces[CHART_FACES + 1] = {"top",   "bottom", "right",  "left", "back",
                                                  "front", "around", "inside", NULL};

static const struct view {
    int across[2], along; /* axes of the place, axis that is looked along */
    double side;          /* of which we look from                        */
} views[] = {[CHART_TOP] = {{0, 1}, 2, 1},   [CHART_BOTTOM] = {{0, 1}, 2, -1}, [CHART_RIGHT] = {{1, 2}, 0, 1},
             [CHART_LEFT] = {{1, 2}, 0, -1}, [CHART_BACK] = {{0, 2}, 1, 1},    [CHART_FRONT] = {{0, 2}, 1, -1}};

void chart_make(const struct mesh *m, const struct boundary *b, int face, struct chart *c)
{
    *c = (struct chart){.mesh = m, .boundary = b, .face = face};
    c->radius = 0.5 * fmin(b->high[0] - b->low[0], b->high[1] - b->low[1]);
    if (face >= CHART_AROUND) {
        c->high[0] = 2.0 * REAL_PI * c->radius;
        c->low[1] = b->low[2];
        c->high[1] = b->high[2];
        return;
    }
    for (int i = 0; i < 2; i++) {
        c->low[i] = b->low[views[face].across[i]];
        c->high[i] = b->high[views[face].across[i]];
    }
}

bool chart_point(const struct chart *c, double x, double y, struct boundary_point *p)
{
    double from[3] = {0, 0, y}, along[3] = {0}, far = 0;
    for (int i = 0; i < 3; i++)
        far += fabs(c->boundary->low[i]) + fabs(c->boundary->high[i]);
    if (c->face >= CHART_AROUND) {
        double side = c->face == CHART_AROUND ? -1 : 1, angle = x / c->radius;
        along[0] = side * real_cos(angle);
        along[1] = side * real_sin(angle);
        for (int i = 0; i < 2 && side < 0; i++)
            from[i] = -far * along[i];
        return boundary_ray(c->mesh, c->boundary, from, along, p);
    }
    const struct view *v = &views[c->face];
    from[v->across[0]] = x;
    from[v->across[1]] = y;
    from[v->along] = v->side * far;
    along[v->along] = -v->side;
    return boundary_ray(c->mesh, c->boundary, from, along, p);
}
