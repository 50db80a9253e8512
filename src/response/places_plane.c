/* Barycentric coordinates in a triangulation (places_delaunay.h): x = x_0 + l_1 (x_1 - x_0) + l_2 (x_2 - x_0), l_0 = 1
   - l_1 - l_2.

   Finding the triangle: the box around the places is cut into cells, about one per triangle; each knows the triangles
   that reach into it, and the first of them that holds the point counts. No search from where the last one was: the
   answer depends on the point alone.

   Off the hull the nearest point of its sides counts. The hull is convex, so along a straight way that point moves
   linearly as long as it stays on one side or at one corner; it changes over at the perpendiculars on each side at its
   ends. */
#include "response/places_plane.h"

#include <math.h>
#include <stdlib.h>

#include "response/places_delaunay.h"

static const double inside = -1e-12, touching = 1e-9; /* share; m */

struct triangle {
    const int *corner;
    double origin[2], to[2][2]; /* l_1 = to[0] . (x - origin), l_2 = to[1] . ... */
};

struct places_plane {
    const double *xy;
    int triangles, edges, sides;
    struct triangle *triangle;
    int (*edge)[2];
    int (*side)[2];              /* of the hull, anticlockwise */
    double low[2], per_metre[2]; /* cells */
    int cells[2];
    int *start, *held; /* held[start[cell] .. start[cell + 1]): triangles */
};

/* ------------------------------------------------------------------ making */

static struct triangle triangle_make(const double *xy, const int *corner)
{
    const double *o = xy + 2 * corner[0], *p = xy + 2 * corner[1], *q = xy + 2 * corner[2];
    double a = p[0] - o[0], b = q[0] - o[0], c = p[1] - o[1], d = q[1] - o[1], area = a * d - b * c;
    return (struct triangle){corner, {o[0], o[1]}, {{d / area, -b / area}, {-c / area, a / area}}};
}

struct side {
    int low, high, from, to;
};

static int by_ends(const void *a, const void *b)
{
    const struct side *p = a, *q = b;
    return p->low != q->low ? (p->low > q->low) - (p->low < q->low) : (p->high > q->high) - (p->high < q->high);
}

static void find_edges(struct arena *a, struct places_plane *p)
{
    int n = 3 * p->triangles;
    struct side *s = ARENA_TAKE(a, struct side, n);
    for (int i = 0; i < n; i++) {
        const int *k = p->triangle[i / 3].corner;
        int from = k[i % 3], to = k[(i + 1) % 3];
        s[i] = (struct side){from < to ? from : to, from < to ? to : from, from, to};
    }
    qsort(s, (size_t)n, sizeof *s, by_ends);
    p->edge = arena_take(a, (size_t)n, sizeof *p->edge);
    p->side = arena_take(a, (size_t)n, sizeof *p->side);
    for (int i = 0; i < n; i++) {
        bool twice = i + 1 < n && by_ends(&s[i], &s[i + 1]) == 0;
        p->edge[p->edges][0] = s[i].low;
        p->edge[p->edges++][1] = s[i].high;
        if (!twice) {
            p->side[p->sides][0] = s[i].from;
            p->side[p->sides++][1] = s[i].to;
        }
        i += twice;
    }
}

static int cell_of(const struct places_plane *p, int c, double x)
{
    double cell = floor((x - p->low[c]) * p->per_metre[c]);
    return cell < 0.0 ? 0 : cell < p->cells[c] ? (int)cell : p->cells[c] - 1;
}

/* Adds a triangle to the cells its box reaches: counts them, or with `held` writes it down. */
static void enter(struct places_plane *p, int t, int *held)
{
    int low[2], high[2];
    for (int c = 0; c < 2; c++) {
        double x[3];
        for (int k = 0; k < 3; k++)
            x[k] = p->xy[2 * p->triangle[t].corner[k] + c];
        low[c] = cell_of(p, c, fmin(fmin(x[0], x[1]), x[2]));
        high[c] = cell_of(p, c, fmax(fmax(x[0], x[1]), x[2]));
    }
    for (int j = low[1]; j <= high[1]; j++)
        for (int i = low[0]; i <= high[0]; i++) {
            int *next = &p->start[j * p->cells[0] + i + 1];
            if (held) held[*next] = t;
            ++*next;
        }
}

static void lay_cells(const double *xy, int n, struct places_plane *p)
{
    int side = (int)sqrt((double)p->triangles) + 1;
    for (int c = 0; c < 2; c++) {
        double low = xy[c], high = xy[c];
        for (int i = 1; i < n; i++) {
            low = fmin(low, xy[2 * i + c]);
            high = fmax(high, xy[2 * i + c]);
        }
        p->low[c] = low;
        p->cells[c] = side;
        p->per_metre[c] = side / (high - low);
    }
}

/* Counts, then sums (start[cell + 1] is where a cell's list begins), then writes: start[cell + 1] has then moved to its
 * end. */
static void fill_cells(struct arena *a, struct places_plane *p)
{
    int cells = p->cells[0] * p->cells[1], sum = 0;
    p->start = ARENA_TAKE(a, int, cells + 1);
    for (int t = 0; t < p->triangles; t++)
        enter(p, t, NULL);
    for (int k = 1; k <= cells; k++) {
        int count = p->start[k];
        p->start[k] = sum;
        sum += count;
    }
    p->held = ARENA_TAKE(a, int, sum);
    for (int t = 0; t < p->triangles; t++)
        enter(p, t, p->held);
}

struct places_plane *places_plane_make(struct arena *a, int n, const double *xy)
{
    struct places_plane *p = ARENA_TAKE(a, struct places_plane, 1);
    const int(*corner)[3];
    p->xy = xy;
    p->triangles = places_delaunay(a, n, xy, &corner);
    if (p->triangles == 0) return NULL;
    p->triangle = ARENA_TAKE(a, struct triangle, p->triangles);
    for (int t = 0; t < p->triangles; t++)
        p->triangle[t] = triangle_make(xy, corner[t]);
    find_edges(a, p);
    lay_cells(xy, n, p);
    fill_cells(a, p);
    return p;
}

/* ------------------------------------------------------------------ where */

static bool in_triangle(const struct triangle *t, double x, double y, struct places_mix *mix)
{
    double dx = x - t->origin[0], dy = y - t->origin[1];
    double v = t->to[0][0] * dx + t->to[0][1] * dy, w = t->to[1][0] * dx + t->to[1][1] * dy, u = 1.0 - v - w;
    if (!(u >= inside && v >= inside && w >= inside)) return false;
    u = fmax(u, 0.0), v = fmax(v, 0.0), w = fmax(w, 0.0);
    double sum = u + v + w;
    *mix = (struct places_mix){3, {t->corner[0], t->corner[1], t->corner[2]}, {u / sum, v / sum, w / sum}};
    return true;
}

/* Nearest point of a stretch from p to q: its share of q. */
static double nearest(const double *p, const double *q, double x, double y, double *distance)
{
    double a = q[0] - p[0], b = q[1] - p[1], dx = x - p[0], dy = y - p[1];
    double w = fmin(fmax((a * dx + b * dy) / (a * a + b * b), 0.0), 1.0);
    double ex = dx - w * a, ey = dy - w * b;
    *distance = sqrt(ex * ex + ey * ey);
    return w;
}

static double off_hull(const struct places_plane *p, double x, double y, struct places_mix *mix)
{
    double least = HUGE_VAL;
    for (int s = 0; s < p->sides; s++) {
        int i = p->side[s][0], j = p->side[s][1];
        double distance, w = nearest(p->xy + 2 * i, p->xy + 2 * j, x, y, &distance);
        if (distance < least) {
            least = distance;
            *mix = (struct places_mix){2, {i, j, i}, {1.0 - w, w, 0.0}};
        }
    }
    return least > touching ? least : 0.0;
}

double places_plane_at(const struct places_plane *p, double x, double y, struct places_mix *mix)
{
    int cell = cell_of(p, 1, y) * p->cells[0] + cell_of(p, 0, x);
    for (int k = p->start[cell]; k < p->start[cell + 1]; k++)
        if (in_triangle(&p->triangle[p->held[k]], x, y, mix)) return 0.0;
    return off_hull(p, x, y, mix);
}

int places_plane_edges(const struct places_plane *p, const int (**edge)[2])
{
    *edge = (const int(*)[2])p->edge;
    return p->edges;
}
