/* Places on a line, and which of line and plane they are (places_plane.c has the plane).

   The line runs between the two places farthest apart (the farthest from the farthest from the first), towards +x, or +y when it is upright;
   a point's coordinate is that of its foot. */
#include "response/places.h"

#include <math.h>
#include <stdlib.h>

#include "response/places_plane.h"

static const double same = 1e-9; /* m */

struct places {
    enum places_kind kind;
    int n;
    double *xy;                /* [n][2] */
    double base[2], axis[2];   /* line: base + along axis, axis a unit vector */
    int *index;                /* [n] places in order along it */
    double *along;             /* [n] m, increasing */
    int (*edge)[2];            /* [n - 1] */
    double *work;              /* [n] kinks */
    struct places_plane *plane;
};

/* ------------------------------------------------------------------ making */

struct rank {
    double key;
    int index;
};

static int rank_up(const void *a, const void *b)
{
    const struct rank *p = a, *q = b;
    if (p->key != q->key)
        return p->key < q->key ? -1 : 1;
    return (p->index > q->index) - (p->index < q->index);
}

static double distance(const double *p, const double *q)
{
    double x = q[0] - p[0], y = q[1] - p[1];
    return sqrt(x * x + y * y);
}

static int farthest(const struct places *p, int from)
{
    int best = from;
    for (int k = 0; k < p->n; k++)
        if (distance(p->xy + 2 * from, p->xy + 2 * k) > distance(p->xy + 2 * from, p->xy + 2 * best))
            best = k;
    return best;
}

static void find_line(struct places *p)
{
    int u = farthest(p, 0), v = farthest(p, u);
    const double *a = p->xy + 2 * u, *b = p->xy + 2 * v;
    if (b[0] < a[0] || (b[0] == a[0] && b[1] < a[1])) {
        const double *swap = a;
        a = b;
        b = swap;
    }
    double length = distance(a, b);
    for (int c = 0; c < 2; c++) {
        p->base[c] = a[c];
        p->axis[c] = length > 0.0 ? (b[c] - a[c]) / length : 1.0 - c;
    }
}

/* Coordinate along the line; *off: m beside it, with its sign. */
static double foot(const struct places *p, double x, double y, double *off)
{
    double dx = x - p->base[0], dy = y - p->base[1];
    *off = dy * p->axis[0] - dx * p->axis[1];
    return dx * p->axis[0] + dy * p->axis[1];
}

/* Sorts along the line; true: all lie on it. */
static bool order(struct places *p, struct rank *r)
{
    double off, most = 0.0;
    for (int i = 0; i < p->n; i++) {
        r[i] = (struct rank){foot(p, p->xy[2 * i], p->xy[2 * i + 1], &off), i};
        most = fmax(most, fabs(off));
    }
    qsort(r, (size_t)p->n, sizeof *r, rank_up);
    return most <= same;
}

/* A place that is where another one is, or -1: such two are neighbours but for those with the same foot. */
static int doubled(const struct places *p, const struct rank *r)
{
    for (int i = 1; i < p->n; i++)
        for (int k = i - 1; k >= 0 && r[i].key - r[k].key <= same; k--)
            if (distance(p->xy + 2 * r[i].index, p->xy + 2 * r[k].index) <= same)
                return r[i].index > r[k].index ? r[i].index : r[k].index;
    return -1;
}

static void make_line(struct arena *a, struct places *p, const struct rank *r)
{
    p->kind = p->n == 1 ? PLACES_ONE : PLACES_LINE;
    p->index = ARENA_TAKE(a, int, p->n);
    p->along = ARENA_TAKE(a, double, p->n);
    p->work = ARENA_TAKE(a, double, p->n);
    p->edge = arena_take(a, (size_t)p->n, sizeof *p->edge);
    for (int i = 0; i < p->n; i++) {
        p->index[i] = r[i].index;
        p->along[i] = r[i].key;
        if (i > 0) {
            p->edge[i - 1][0] = r[i - 1].index;
            p->edge[i - 1][1] = r[i].index;
        }
    }
}

static bool make_plane(struct arena *a, struct places *p, struct err *e)
{
    p->kind = PLACES_PLANE;
    p->plane = places_plane_make(a, p->n, p->xy);
    return p->plane || err_set(e, ERR_SCENE, "the places cannot be triangulated: they lie almost, but not within 1e-9 m, on one line, or almost at the "
                               "same point: write them with more digits, or take one place of those that are close");
}

bool places_make(struct arena *a, int n, const double *xy, struct places **places, int *bad, struct err *e)
{
    struct places *p = ARENA_TAKE(a, struct places, 1);
    struct rank *r = ARENA_TAKE(a, struct rank, n);
    *places = p;
    p->n = n;
    p->xy = ARENA_TAKE(a, double, 2 * (size_t)n);
    for (int i = 0; i < 2 * n; i++)
        p->xy[i] = xy[i];
    find_line(p);
    bool straight = order(p, r);
    *bad = doubled(p, r);
    if (*bad >= 0)
        return err_set(e, ERR_SCENE, "is at the same point as another place");
    if (!straight)
        return make_plane(a, p, e);
    make_line(a, p, r);
    return true;
}

enum places_kind places_kind(const struct places *p)
{
    return p->kind;
}

/* ------------------------------------------------------------------ reading */

/* Index k of the interval [along[k], along[k + 1]] that holds s, n >= 2. */
static int interval(const struct places *p, double s)
{
    int low = 0, high = p->n - 1;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (p->along[middle] <= s)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static double line_at(const struct places *p, double x, double y, struct places_mix *mix)
{
    double beside, s = foot(p, x, y, &beside);
    double on = fmin(fmax(s, p->along[0]), p->along[p->n - 1]);
    int k = interval(p, on);
    double w = (on - p->along[k]) / (p->along[k + 1] - p->along[k]);
    *mix = (struct places_mix){2, {p->index[k], p->index[k + 1], p->index[k]}, {1.0 - w, w, 0.0}};
    double off = sqrt((s - on) * (s - on) + beside * beside);
    return off > same ? off : 0.0;
}

double places_at(const struct places *p, double x, double y, struct places_mix *mix)
{
    if (p->kind == PLACES_PLANE)
        return places_plane_at(p->plane, x, y, mix);
    if (p->kind == PLACES_LINE)
        return line_at(p, x, y, mix);
    *mix = (struct places_mix){1, {0, 0, 0}, {1.0, 0.0, 0.0}};
    return 0.0;
}

int places_kinks(const struct places *p, const double from[2], const double to[2], double *u, int most)
{
    if (p->kind == PLACES_PLANE)
        return places_plane_kinks(p->plane, from, to, u, most);
    double off, start = foot(p, from[0], from[1], &off), by = foot(p, to[0], to[1], &off) - start;
    int n = 0;
    for (int k = 0; p->kind == PLACES_LINE && k < p->n; k++) {
        double at = by != 0.0 ? (p->along[k] - start) / by : 0.0;
        if (at > 1e-12 && at < 1.0 - 1e-12)
            p->work[n++] = at;
    }
    n = places_plane_sort(p->work, n);
    for (int i = 0; i < n && i < most; i++)
        u[i] = p->work[i];
    return n;
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
    return most - least <= same ? arena_format(a, "%c = %.6g cm", name, 100 * least) : arena_format(a, "%.6g <= %c <= %.6g cm", 100 * least, name, 100 * most);
}

const char *places_told(const struct places *p, struct arena *a)
{
    bool slanting = p->kind == PLACES_LINE && fabs(p->axis[0]) > same && fabs(p->axis[1]) > same;
    if (!slanting)
        return arena_format(a, "its places lie %s %s, %s", p->kind == PLACES_PLANE ? "within" : "on", extent(p, 0, a), extent(p, 1, a));
    const double *from = p->xy + 2 * p->index[0], *to = p->xy + 2 * p->index[p->n - 1];
    return arena_format(a, "its places lie on the line from (%.6g, %.6g) to (%.6g, %.6g) cm", 100 * from[0], 100 * from[1], 100 * to[0], 100 * to[1]);
}

int places_edges(const struct places *p, const int (**edge)[2])
{
    if (p->kind == PLACES_PLANE)
        return places_plane_edges(p->plane, edge);
    *edge = (const int(*)[2])p->edge;
    return p->n - 1;
}
