/* Lists of points: see scene_points.h. */
#include "scene/scene_points.h"

#include <math.h>

#include "scene/scene_example.h"
#include "scene/scene_values.h"
#include "scene/units.h"

enum { LEAST = 2, MOST = 10000 };
#define APART 1e-9 /* m, of one from the next */

struct points {
    const struct scene_part *part;
    const struct key *key;
    const char *label;
};

static bool point_read(const struct points *p, const struct yaml_node *node, int number, double point[2])
{
    struct yaml *y = p->part->yaml;
    struct arena *a = y->arena;
    const char *label = arena_format(a, "point %d of %s", number, p->label);
    if (node->kind != YAML_LIST || node->n != 2)
        return diag_add(y->diag, node->at, arena_format(a, "write for instance: [%s, 0]", units_example(p->key->dimension)),
                        "%s must be a pair [x, y], not %s", label,
                        node->kind == YAML_LIST ? arena_format(a, "a list of %d", node->n) : scene_values_kind(y, node));
    bool x = scene_values_number(p->part, p->key, node->first, arena_format(a, "x of %s", label), &point[0]);
    return scene_values_number(p->part, p->key, node->last, arena_format(a, "y of %s", label), &point[1]) && x;
}

static bool point_differs(const struct points *p, const struct yaml_node *node, int number, const double *point)
{
    double x = point[0] - point[-2], y = point[1] - point[-1];
    return sqrt(x * x + y * y) >= APART || diag_add(p->part->yaml->diag, node->at, "remove one of the two", "point %d of %s lies where point %d does",
                                                    number, p->label, number - 1);
}

static bool list_check(const struct points *p, const struct yaml_node *list)
{
    struct yaml *y = p->part->yaml;
    if (list->kind == YAML_LIST && list->n >= LEAST && list->n <= MOST)
        return true;
    return diag_add(y->diag, list->at, arena_format(y->arena, "write for instance: %s", scene_example(y, p->key)),
                    "%s must be a list of %d to %d points [x, y], not %s", p->label, LEAST, MOST,
                    list->kind == YAML_LIST ? arena_format(y->arena, "of %d", list->n) : scene_values_kind(y, list));
}

const double *scene_points_read(const struct scene_part *part, const struct key *k, const struct yaml_node *list, const char *label, int *n)
{
    const struct points p = {part, k, label};
    bool good = true, before = false;
    int i = 0;
    *n = 0;
    if (!list_check(&p, list))
        return NULL;
    double *all = ARENA_TAKE(part->yaml->arena, double, 2 * (size_t)list->n);
    for (const struct yaml_node *item = list->first; item; item = item->next, i++) {
        bool read = point_read(&p, item, i + 1, all + 2 * i);
        good = read && (!before || point_differs(&p, item, i + 1, all + 2 * i)) && good;
        before = read;
    }
    *n = good ? i : 0;
    return good ? all : NULL;
}
