/* See shapes.h. The cells' size is found so that at fineness 2 the lattice of the shape's own order has about its
 * number of nodes (three freedoms each); fineness N makes cells 2/N as long. */
#include "fem/shapes.h"

#include <math.h>
#include <string.h>

#include "base/text.h"
#include "fem/shapes_kinds.h"
#include "scene/units.h"

static const struct shapes_kind *const kinds[] = {&shapes_plate, &shapes_plate_bar, &shapes_rod, &shapes_ring,
                                                  &shapes_bowl,  &shapes_sphere,    &shapes_mug};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

static const double thinnest = 1e-4; /* of the largest length: thinner ones are wrong units rather than objects */

static const char *shape_list(struct arena *a)
{
    const char *all = kinds[0]->name;
    for (int i = 1; i < KINDS; i++)
        all = arena_format(a, "%s, %s", all, kinds[i]->name);
    return all;
}

static const struct shapes_kind *kind_of(const char *name, struct arena *a, struct err *e)
{
    const char *names[KINDS + 1] = {0};
    for (int i = 0; i < KINDS; i++) {
        names[i] = kinds[i]->name;
        if (!strcmp(name, names[i])) return kinds[i];
    }
    const char *near = text_nearest(name, names);
    if (near)
        err_set(e, ERR_USAGE, "no shape '%s'; did you mean '%s'?", name, near);
    else
        err_set(e, ERR_USAGE, "no shape '%s'; shapes are %s", name, shape_list(a));
    return NULL;
}

static const char *key_list(const struct shapes_kind *k, struct arena *a)
{
    const char *all = k->key[0];
    for (int i = 1; k->key[i]; i++)
        all = arena_format(a, "%s, %s", all, k->key[i]);
    return arena_format(a, "%s, fineness", all);
}

/* Index of the key, SHAPES_KINDS_LENGTHS: fineness; -1: none. */
static int key_of(const struct shapes_kind *k, const char *key, struct arena *a, struct err *e)
{
    const char *names[SHAPES_KINDS_LENGTHS + 2] = {0};
    int n = 0;
    for (; k->key[n]; n++) {
        names[n] = k->key[n];
        if (!strcmp(key, k->key[n])) return n;
    }
    names[n] = "fineness";
    if (!strcmp(key, names[n])) return SHAPES_KINDS_LENGTHS;
    const char *near = text_nearest(key, names);
    if (near)
        err_set(e, ERR_USAGE, "%s has no '%s'; did you mean '%s'?", k->name, key, near);
    else
        err_set(e, ERR_USAGE, "%s has no '%s'; it has %s", k->name, key, key_list(k, a));
    return -1;
}

static bool read_value(const struct shapes_kind *k, int key, const char *text, struct shapes_ask *q, struct arena *a,
                       struct err *e)
{
    struct units_fault fault = {0};
    if (key == SHAPES_KINDS_LENGTHS)
        return text_int(text, 1, 6, &q->fineness) ||
               err_set(e, ERR_USAGE,
                       "fineness is '%s', and must be a whole number from 1 (coarse) to 6; 2 is the default", text);
    double *x = &q->length[key];
    if (!isnan(*x)) return err_set(e, ERR_USAGE, "%s: %s is given twice", k->name, k->key[key]);
    if (!units_read(text, KEY_LENGTH, x, a, &fault))
        return err_set(e, ERR_USAGE, "%s: %s %s%s%s", k->name, k->key[key], fault.text, fault.cure ? "; " : "",
                       fault.cure ? fault.cure : "");
    bool none = *x == 0 && !strcmp(k->key[key], "handle");
    return none || *x > 0 || err_set(e, ERR_USAGE, "%s: %s is '%s', and must be above 0", k->name, k->key[key], text);
}

static bool read_pairs(const struct shapes_kind *k, char *text, struct shapes_ask *q, struct arena *a, struct err *e)
{
    while (text) {
        char *next = strchr(text, ','), *equals;
        if (next) *next++ = '\0';
        equals = strchr(text, '=');
        if (!equals)
            return err_set(e, ERR_USAGE, "%s: '%s' is not of the form KEY=LENGTH, such as %s=10cm", k->name, text,
                           k->key[0]);
        *equals = '\0';
        int key = key_of(k, text, a, e);
        if (key < 0 || !read_value(k, key, equals + 1, q, a, e)) return false;
        text = next;
    }
    for (int i = 0; i < k->needed; i++)
        if (isnan(q->length[i]))
            return err_set(e, ERR_USAGE, "%s needs %s= (it has %s)", k->name, k->key[i], key_list(k, a));
    return true;
}

/* No length is lost against another. */
static bool check_proportions(const struct shapes_kind *k, const struct shapes_ask *q, struct err *e)
{
    int low = 0, high = 0;
    for (int i = 1; k->key[i]; i++) {
        if (q->length[i] > 0 && q->length[i] < q->length[low]) low = i;
        if (q->length[i] > q->length[high]) high = i;
    }
    return q->length[low] >= thinnest * q->length[high] ||
           err_set(e, ERR_USAGE,
                   "%s: %s is %g m and %s %g m, more than %g times as much: no mesh of reasonable elements fits; are "
                   "the units right?",
                   k->name, k->key[low], q->length[low], k->key[high], q->length[high], 1 / thinnest);
}

/* The largest cells that give the points wanted at fineness 2, by bisection of their logarithm. */
static void find_cell(const struct shapes_kind *k, struct shapes_ask *q, double longer, struct arena *a,
                      struct shapes_blocks *s)
{
    struct shapes_ask t = *q;
    double low = INFINITY, high = 0;
    for (int i = 0; k->key[i]; i++) {
        low = q->length[i] > 0 ? fmin(low, q->length[i]) : low;
        high = q->length[i] > 0 ? fmax(high, q->length[i]) : high;
    }
    low /= 100;
    t.fineness = 2;
    for (int i = 0; i < 40; i++) {
        t.cell = sqrt(low * high);
        k->blocks(&t, a, s);
        if (shapes_blocks_nodes(s, k->order) > q->nodes)
            low = t.cell;
        else
            high = t.cell;
    }
    q->cell = high * 2 / q->fineness * longer;
    k->blocks(q, a, s);
}

static bool make(const char *text, double longer, struct arena *a, struct mesh *m, struct err *e)
{
    struct shapes_ask q = {.fineness = 2};
    char *copy = arena_text(a, text), *colon = strchr(copy, ':');
    struct shapes_blocks s;
    for (int i = 0; i < SHAPES_KINDS_LENGTHS; i++)
        q.length[i] = NAN;
    if (colon) *colon = '\0';
    const struct shapes_kind *k = kind_of(copy, a, e);
    if (!k) return false;
    if (!colon)
        return err_set(e, ERR_USAGE, "%s needs its lengths, such as %s:%s=10cm,...: it has %s", copy, copy, k->key[0],
                       key_list(k, a));
    q.nodes = k->nodes;
    if (!read_pairs(k, colon + 1, &q, a, e) || !check_proportions(k, &q, e) || !k->check(&q, e) ||
        !check_proportions(k, &q, e))
        return false;
    *m = (struct mesh){.name = arena_text(a, text)};
    find_cell(k, &q, longer, a, &s);
    shapes_blocks_mesh(&s, a, m);
    return true;
}

bool shapes_mesh(const char *text, struct arena *a, struct mesh *m, struct err *e) { return make(text, 1, a, m, e); }

bool shapes_mesh_coarser(const char *text, double longer, struct arena *a, struct mesh *m, struct err *e)
{
    return make(text, longer, a, m, e);
}

int shapes_order(const char *text)
{
    size_t n = strcspn(text, ":");
    for (int i = 0; i < KINDS; i++)
        if (n == strlen(kinds[i]->name) && !memcmp(text, kinds[i]->name, n)) return kinds[i]->order;
    return 3;
}

const char *shapes_help(void)
{
    return "plate:length=,width=,thickness=       x in [0, length], y in [0, width], z in [0, thickness]; groups x0 x1 "
           "y0 y1 z0 z1\n"
           "bar:length=,width=,thickness=         the same solid, meshed for what is slender\n"
           "rod:length=,diameter=[,wall=]         x in [0, length], axis y = z = 0; wall: a tube; groups x0 x1\n"
           "ring:diameter=,width=,thickness=      round the z axis: outer diameter, radial width, z in [0, thickness]; "
           "groups z0 z1\n"
           "bowl:diameter=,height=,thickness=[,foot=]\n"
           "                                      a cap of a sphere, open upwards, rim at z = height, on a flat foot "
           "(default: a third); groups foot rim\n"
           "sphere:diameter=[,wall=]              round the origin; wall: hollow\n"
           "mug:diameter=,height=,wall=[,bottom=][,handle=]\n"
           "                                      round the z axis, bottom at z = 0, as thick as the wall; handle: its "
           "thickness (default: a tenth of the\n"
           "                                      diameter), in the x-z plane at +x; handle=0: none; groups bottom rim "
           "handle\n"
           "any: fineness=N                       1 coarse, 2 default, ... 6";
}
