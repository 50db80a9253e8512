/* Lists of points: see scene_points.h. */
#include "scene/scene_points.h"

#include <math.h>
#include <string.h>

#include "scene/scene_example.h"
#include "scene/scene_values.h"
#include "scene/units.h"

#define DISTINCT 1e-9 /* m, of one point of a path from the next */

static const struct kind {
    int least, most;
    const char *one, *many, *form, *example; /* example: of the coordinates after x */
} kinds[] = {{2, 10000, "point", "points", "a pair [x, y]", "0"},
             {1, 64, "place", "places", "three numbers [x, y, z]", "0, 1 m"}};

struct points {
    const struct scene_part *part;
    const struct key *key;
    const char *label;
    const struct kind *kind;
    int width;
};

static bool point_read(const struct points *p, const struct yaml_node *node, int number, double *point)
{
    struct yaml *y = p->part->yaml;
    struct arena *a = y->arena;
    const char *label = arena_format(a, "%s %d of %s", p->kind->one, number, p->label);
    const struct yaml_node *item = node->first;
    bool good = true;
    if (node->kind != YAML_LIST || node->n != p->width)
        return diag_add(
            y->diag, node->at,
            arena_format(a, "write for instance: [%s, %s]", units_example(p->key->dimension), p->kind->example),
            "%s must be %s, not %s", label, p->kind->form,
            node->kind == YAML_LIST ? arena_format(a, "a list of %d", node->n) : scene_values_kind(y, node));
    for (int i = 0; i < p->width; i++, item = item->next)
        good =
            scene_values_number(p->part, p->key, item, arena_format(a, "%c of %s", "xyz"[i], label), &point[i]) && good;
    return good;
}

static bool point_differs(const struct points *p, const struct yaml_node *node, int number, const double *point)
{
    double x = point[0] - point[-2], y = point[1] - point[-1];
    return sqrt(x * x + y * y) >= DISTINCT ||
           diag_add(p->part->yaml->diag, node->at, "remove one of the two", "point %d of %s lies where point %d does",
                    number, p->label, number - 1);
}

static bool list_check(const struct points *p, const struct yaml_node *list)
{
    struct yaml *y = p->part->yaml;
    if (list->kind == YAML_LIST && list->n >= p->kind->least && list->n <= p->kind->most) return true;
    return diag_add(y->diag, list->at, arena_format(y->arena, "write for instance: %s", scene_example(y, p->key)),
                    "%s must be a list of %d to %d %s %s, not %s", p->label, p->kind->least, p->kind->most,
                    p->kind->many, strchr(p->kind->form, '['),
                    list->kind == YAML_LIST ? arena_format(y->arena, "of %d", list->n) : scene_values_kind(y, list));
}

const double *scene_points_read(const struct scene_part *part, const struct key *k, const struct yaml_node *list,
                                const char *label, int *n)
{
    const int width = keys_points_width(k);
    const struct points p = {part, k, label, &kinds[width == 3], width};
    bool good = true, before = false;
    int i = 0;
    *n = 0;
    if (!list_check(&p, list)) return NULL;
    double *all = ARENA_TAKE(part->yaml->arena, double, (size_t)width *(size_t)list->n);
    for (const struct yaml_node *item = list->first; item; item = item->next, i++) {
        bool read = point_read(&p, item, i + 1, all + width * i);
        good = read && (!before || k->type == KEY_PLACES || point_differs(&p, item, i + 1, all + width * i)) && good;
        before = read;
    }
    *n = good ? i : 0;
    return good ? all : NULL;
}
