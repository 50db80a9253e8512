/* Which of line, grid and plane places are. places_lattice.c has the first two, places_plane.c the third, whose
   smooth interpolation, where they lie on rings, is that of places_rings.c.

   Places are sorted by x, then y, before anything is made of them, so that their order as given tells nothing: where a
   rule takes the first of several (a tie of Delaunay's triangulation), that is the one farthest left.

   The line runs between the two places farthest apart (the farthest from the farthest from the leftmost), towards +x,
   or +y when it is upright; a point's coordinate is that of its foot.

   A grid has its axes along x and y; or turned: the leftmost place is a corner of it, whose nearest place lies along an
   axis. */
#include "response/places.h"

#include <math.h>
#include <stdlib.h>

#include "response/places_lattice.h"
#include "response/places_plane.h"
#include "response/places_rings.h"

static const double same = 1e-9;    /* m */
static const double rounded = 1e-4; /* of the extent: what rounding in a file leaves of a grid */

struct places {
    enum places_kind kind;
    int n;
    double *xy;              /* [n][2], sorted */
    int *order;              /* [n] as they were given */
    double base[2], axis[2]; /* line: base + along axis, axis a unit vector */
    struct places_lattice *lattice;
    struct places_plane *plane;
    struct places_rings *rings; /* NULL: the plane's places are none */
    int (*edge)[2], edges;      /* of the plane */
};

/* ------------------------------------------------------------------ making */

struct rank {
    double key, other;
    int index;
};

static int rank_up(const void *a, const void *b)
{
    const struct rank *p = a, *q = b;
    if (p->key != q->key) return p->key < q->key ? -1 : 1;
    if (p->other != q->other) return p->other < q->other ? -1 : 1;
    return (p->index > q->index) - (p->index < q->index);
}

static double distance(const double *p, const double *q)
{
    double x = q[0] - p[0], y = q[1] - p[1];
    return sqrt(x * x + y * y);
}

static void sort(struct arena *a, struct places *p, const double *xy, struct rank *r)
{
    p->xy = ARENA_TAKE(a, double, 2 * (size_t)p->n);
    p->order = ARENA_TAKE(a, int, p->n);
    for (int i = 0; i < p->n; i++)
        r[i] = (struct rank){xy[2 * i], xy[2 * i + 1], i};
    qsort(r, (size_t)p->n, sizeof *r, rank_up);
    for (int i = 0; i < p->n; i++) {
        p->order[i] = r[i].index;
        p->xy[2 * i] = r[i].key;
        p->xy[2 * i + 1] = r[i].other;
    }
}

static int farthest(const struct places *p, int from)
{
    int best = from;
    for (int k = 0; k < p->n; k++)
        if (distance(p->xy + 2 * from, p->xy + 2 * k) > distance(p->xy + 2 * from, p->xy + 2 * best)) best = k;
    return best;
}

static void find_line(struct places *p)
{
    int u = farthest(p, 0), v = farthest(p, u);
    const double *a = p->xy + 2 * (u < v ? u : v), *b = p->xy + 2 * (u < v ? v : u);
    double length = distance(a, b);
    for (int c = 0; c < 2; c++) {
        p->base[c] = a[c];
        p->axis[c] = length > 0.0 ? (b[c] - a[c]) / length : 1.0 - c;
    }
}

/* Coordinate along a line from `base`; *off: m beside it, with its sign. */
static double foot(const double base[2], const double axis[2], const double *xy, double *off)
{
    double dx = xy[0] - base[0], dy = xy[1] - base[1];
    *off = dy * axis[0] - dx * axis[1];
    return dx * axis[0] + dy * axis[1];
}

/* Sorts along the line; true: all lie on it. */
static bool all_on_line(const struct places *p, struct rank *r)
{
    double off, most = 0.0;
    for (int i = 0; i < p->n; i++) {
        r[i] = (struct rank){foot(p->base, p->axis, p->xy + 2 * i, &off), 0, i};
        most = fmax(most, fabs(off));
    }
    qsort(r, (size_t)p->n, sizeof *r, rank_up);
    return most <= same;
}

/* A place that is where another one is, the later as given, or -1: such two are neighbours but for those with the same
 * foot. */
static int doubled(const struct places *p, const struct rank *r, bool straight)
{
    for (int i = 1; i < p->n; i++)
        for (int k = i - 1; k >= 0 && r[i].key - r[k].key <= same; k--)
            if ((straight && r[i].key == r[k].key) ||
                distance(p->xy + 2 * r[i].index, p->xy + 2 * r[k].index) <= same) {
                int one = p->order[r[i].index], other = p->order[r[k].index];
                return one > other ? one : other;
            }
    return -1;
}

static struct places_lattice *lattice_along(struct arena *a, const struct places *p, const double base[2],
                                            const double axis[2], bool one_row)
{
    double extent = distance(p->xy, p->xy + 2 * farthest(p, 0));
    return places_lattice_make(
        a, &(struct places_lattice_ask){p->n, p->xy, p->order, base, axis, rounded * extent, one_row});
}

/* The axis of a turned grid, if it is one: from the leftmost place, a corner, towards its nearest, as exactly as the
 * longer of the two sides at that corner tells. */
static void turned_axis(const struct places *p, double axis[2])
{
    int near = 1, far = 1;
    for (int k = 2; k < p->n; k++)
        near = distance(p->xy, p->xy + 2 * k) < distance(p->xy, p->xy + 2 * near) ? k : near;
    double step = distance(p->xy, p->xy + 2 * near), off;
    for (int c = 0; c < 2; c++)
        axis[c] = (p->xy[2 * near + c] - p->xy[c]) / step;
    for (int k = 1; k < p->n; k++) {
        double along = foot(p->xy, axis, p->xy + 2 * k, &off);
        if (fmin(fabs(along), fabs(off)) < 0.5 * step &&
            distance(p->xy, p->xy + 2 * k) > distance(p->xy, p->xy + 2 * far))
            far = k;
    }
    double length = distance(p->xy, p->xy + 2 * far);
    for (int c = 0; c < 2; c++)
        axis[c] = (p->xy[2 * far + c] - p->xy[c]) / length;
}

static bool make_grid(struct arena *a, struct places *p)
{
    double axis[2] = {1, 0};
    p->kind = PLACES_GRID;
    p->lattice = lattice_along(a, p, p->xy, axis, false);
    if (p->lattice || p->n < 4) return p->lattice;
    turned_axis(p, axis);
    p->lattice = lattice_along(a, p, p->xy, axis, false);
    return p->lattice;
}

static bool make_plane(struct arena *a, struct places *p, struct err *e)
{
    const int(*edge)[2];
    p->kind = PLACES_PLANE;
    p->plane = places_plane_make(a, p->n, p->xy);
    if (!p->plane)
        return err_set(
            e, ERR_SCENE,
            "the places cannot be triangulated: they lie almost, but not within 1e-9 m, on one line, or almost at the "
            "same point: write them with more digits, or take one place of those that are close");
    p->rings = places_rings_make(a, p->n, p->xy, p->order, rounded * distance(p->xy, p->xy + 2 * farthest(p, 0)));
    p->edges = places_plane_edges(p->plane, &edge);
    p->edge = arena_take(a, (size_t)p->edges, sizeof *p->edge);
    for (int k = 0; k < p->edges; k++)
        for (int c = 0; c < 2; c++)
            p->edge[k][c] = p->order[edge[k][c]];
    return true;
}

bool places_make(struct arena *a, int n, const double *xy, struct places **places, int *bad, struct err *e)
{
    struct places *p = ARENA_TAKE(a, struct places, 1);
    struct rank *r = ARENA_TAKE(a, struct rank, n);
    *places = p;
    p->n = n;
    sort(a, p, xy, r);
    find_line(p);
    bool straight = all_on_line(p, r);
    *bad = doubled(p, r, straight);
    if (*bad >= 0)
        return err_set(e, ERR_SCENE,
                       "is at the same point as another place: remove one of the two, or mend where it lies");
    if (!straight) return make_grid(a, p) || make_plane(a, p, e);
    p->kind = n == 1 ? PLACES_ONE : PLACES_LINE;
    p->lattice = lattice_along(a, p, p->base, p->axis, true);
    return true;
}

enum places_kind places_kind(const struct places *p) { return p->kind; }

/* ------------------------------------------------------------------ reading */

double places_at(const struct places *p, double x, double y, struct places_mix *mix)
{
    double off = p->plane ? places_plane_at(p->plane, x, y, mix) : places_lattice_at(p->lattice, x, y, mix);
    for (int k = 0; k < mix->n && p->plane; k++)
        mix->index[k] = p->order[mix->index[k]];
    return p->kind == PLACES_ONE ? 0.0 : off;
}

bool places_smooth(const struct places *p) { return p->rings || places_rows(p) > p->n; }

int places_rows(const struct places *p)
{
    return p->lattice ? places_lattice_rows(p->lattice) : p->rings ? places_rings_rows(p->rings) : p->n;
}

void places_fill(const struct places *p, int n, double *rows)
{
    if (p->lattice)
        places_lattice_fill(p->lattice, n, rows);
    else if (p->rings)
        places_rings_fill(p->rings, n, rows);
}

double places_smooth_at(const struct places *p, double x, double y, struct places_sum *sum)
{
    struct places_mix mix;
    double off;
    if (p->lattice) {
        off = places_lattice_smooth_at(p->lattice, x, y, sum);
        return p->kind == PLACES_ONE ? 0.0 : off;
    }
    if (p->rings) return places_rings_smooth_at(p->rings, x, y, sum);
    off = places_at(p, x, y, &mix);
    sum->n = mix.n;
    for (int k = 0; k < mix.n; k++) {
        sum->index[k] = mix.index[k];
        sum->weight[k] = mix.weight[k];
    }
    return off;
}

/* "0 <= x <= 40 cm", "y = 3.7 cm" */
static const char *extent(const struct places *p, int axis, struct arena *a)
{
    double least = p->xy[axis], most = least;
    for (int i = 1; i < p->n; i++) {
        least = fmin(least, p->xy[2 * i + axis]);
        most = fmax(most, p->xy[2 * i + axis]);
    }
    char name = axis ? 'y' : 'x';
    return most - least <= same ? arena_format(a, "%c = %.6g cm", name, 100 * least)
                                : arena_format(a, "%.6g <= %c <= %.6g cm", 100 * least, name, 100 * most);
}

const char *places_told(const struct places *p, struct arena *a)
{
    bool slanting = p->kind == PLACES_LINE && fabs(p->axis[0]) > same && fabs(p->axis[1]) > same;
    if (!slanting)
        return arena_format(a, "its places lie %s %s, %s", p->kind > PLACES_LINE ? "within" : "on", extent(p, 0, a),
                            extent(p, 1, a));
    const double *from = p->xy, *to = p->xy + 2 * (p->n - 1);
    return arena_format(a, "its places lie on the line from (%.6g, %.6g) to (%.6g, %.6g) cm", 100 * from[0],
                        100 * from[1], 100 * to[0], 100 * to[1]);
}

int places_edges(const struct places *p, const int (**edge)[2])
{
    if (p->lattice) return places_lattice_edges(p->lattice, edge);
    *edge = (const int(*)[2])p->edge;
    return p->edges;
}
