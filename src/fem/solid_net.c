/* A node is known by the corners that it lies between and its whole numbers there (solid_lattice.c): elements that
 * share a corner, an edge or a face share its nodes. */
#include "fem/solid_net.h"

#include <stdlib.h>
#include <string.h>

#include "fem/solid_element.h"

struct key {
    int part[4]; /* rising: corner times 8, plus its whole number; 0: none */
    int place;   /* where in the list of elements; of a known node its number */
};

static int compare(const void *x, const void *y)
{
    const struct key *a = (const struct key *)x, *b = (const struct key *)y;
    for (int i = 0; i < 4; i++)
        if (a->part[i] != b->part[i]) return a->part[i] < b->part[i] ? -1 : 1;
    return 0;
}

static int compare_place(const void *x, const void *y)
{
    int order = compare(x, y);
    return order ? order : ((const struct key *)x)->place - ((const struct key *)y)->place;
}

static struct key key_of(const int *corner, const int *a, int corners)
{
    struct key k = {{0}, 0};
    for (int i = 0; i < corners; i++) {
        int part = a[i] ? corner[i] * 8 + a[i] : 0, j;
        if (!part) continue;
        for (j = 0; j < 3 && k.part[j + 1] < part; j++)
            k.part[j] = k.part[j + 1];
        k.part[j] = part;
    }
    return k;
}

/* Places [per element] -> numbers of nodes, in the order in which nodes are first met; known: one key for each, sorted.
 * Returns how many. */
static int number(struct key *all, size_t n, int *node, struct key **known, struct arena *a)
{
    int nodes = 0, kept = 0, *first = ARENA_TAKE(a, int, n);
    qsort(all, n, sizeof *all, compare_place);
    for (size_t i = 0, lead = 0; i < n; i++) {
        lead = i > 0 && !compare(&all[i], &all[i - 1]) ? lead : i;
        first[all[i].place] = all[lead].place;
    }
    for (size_t p = 0; p < n; p++)
        node[p] = first[p] == (int)p ? nodes++ : node[first[p]];
    *known = arena_take(a, (size_t)nodes, sizeof **known);
    for (size_t i = 0; i < n; i++)
        if (first[all[i].place] == all[i].place) {
            (*known)[kept] = all[i];
            (*known)[kept++].place = node[all[i].place];
        }
    return nodes;
}

static void place(const struct mesh *m, const int element[10], const int a[4], int order, double at[3])
{
    const double l[3] = {(double)a[1] / order, (double)a[2] / order, (double)a[3] / order};
    double value[10], slope[10][3];
    solid_element_shapes(l, value, slope);
    memset(at, 0, 3 * sizeof *at);
    for (int i = 0; i < 10; i++)
        for (int k = 0; k < 3; k++)
            at[k] += value[i] * m->at[element[i]][k];
}

static void lift(struct solid_net *net, struct arena *a)
{
    const struct mesh *m = net->mesh;
    const struct boundary *b = net->boundary;
    const struct solid_lattice *t = &net->lattice;
    size_t n = (size_t)m->elements * (size_t)t->n;
    struct key *all = arena_take(a, n, sizeof *all), *known;
    int *element = ARENA_TAKE(a, int, n), *face = ARENA_TAKE(a, int, (size_t)b->n *(size_t)t->on_face + 1);
    for (size_t i = 0; i < n; i++) {
        all[i] = key_of(m->element[i / (size_t)t->n], t->at[i % (size_t)t->n], 4);
        all[i].place = (int)i;
    }
    net->nodes = number(all, n, element, &known, a);
    net->at = arena_take(a, (size_t)net->nodes, sizeof *net->at);
    for (size_t i = 0; i < n; i++)
        place(m, m->element[i / (size_t)t->n], t->at[i % (size_t)t->n], t->order, net->at[element[i]]);
    for (int i = 0; i < b->n * t->on_face; i++) {
        struct key want = key_of(b->face[i / t->on_face], t->face[i % t->on_face], 3);
        face[i] = ((struct key *)bsearch(&want, known, (size_t)net->nodes, sizeof want, compare))->place;
    }
    net->element = element;
    net->face = face;
}

void solid_net_make(const struct mesh *m, const struct boundary *b, int order, struct arena *a, struct solid_net *net)
{
    *net = (struct solid_net){.mesh = m, .boundary = b, .lattice = solid_lattice_make(order)};
    if (order > 2)
        lift(net, a);
    else {
        net->nodes = m->nodes;
        net->at = m->at;
        net->element = m->element[0];
        net->face = b->n ? b->face[0] : NULL;
    }
}
