/* Which of line, grid and plane places are. The plane is triangulated here; lines, grids and the smooth interpolation
   on rings are those of places_smooth.c.

   Places are sorted by x, then y, before anything is made of them, so that their order as given tells nothing: where a
   rule takes the first of several (a tie of Delaunay's triangulation), that is the one farthest left.

   The line runs between the two places farthest apart (the farthest from the farthest from the leftmost), towards +x,
   or +y when it is upright; a point's coordinate is that of its foot.

   A grid has its axes along x and y; or turned: the leftmost place is a corner of it, whose nearest place lies along an
   axis. */
#include "response/places.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "response/places_smooth.h"

/* Delaunay's triangulation of places: a sweep, then flips.

   1. Sweep. Places are taken by rising x (then y); each is joined to the sides of the hull so far that it sees, which
   are those next to the
      place before it (as in Sinclair's S-hull, 2010). A side is seen from more than 1e-14 of the extent in front of it,
        so that
      every triangle has an area. While all places lie on one line the hull is that line, there and back.
   2. Flips (Lawson, Software for C1 surface interpolation, 1977). An edge is flipped while the angles alpha and beta
   opposite to it sum to more
      than pi: cot(alpha) + cot(beta) < -tie. Within the tie the four corners lie on one circle (every cell of a regular
        grid) and both
      diagonals are Delaunay's: that through the place of lowest index is taken, so that a grid's all run the same way,
        and a polygon on a
      circle becomes a fan. Such flips lower the sum of the triangles' lowest indices, so they end, too.
   3. Slivers that rounded coordinates leave along the hull's straight sides are peeled off from outside.

   Whether it is a triangulation is checked by Euler's formula: triangles = 2 n - 2 - sides of the hull.

   Not libqhull: where places lie on common circles and straight sides, as those of a turned grid in rounded
   coordinates, its merged facets (default, Qt) overlapped in a quarter of our trials, and joggled input (QJ) left
   turned-over triangles; both would need steps 2 and 3 as well. */

static const double flat = 1e-9; /* m */
static const double tie = 1e-7;  /* of cot(alpha) + cot(beta) */

struct side { /* of a triangle: corner number `at` of it is opposite */
    int low, high, triangle, at;
};

struct mesh {
    const double *xy;
    double least; /* m: height that a triangle has */
    int n, triangles, sides, hull;
    int (*corner)[3];  /* [2 n], anticlockwise */
    struct side *side; /* [sides = 3 triangles], those of an edge together */
    int *count; /* [2 n] of a triangle: how many of its sides are the hull's; when flipping: whether it has changed */
};

/* ------------------------------------------------------------------ triangles */

static double distance(const double *p, const double *q)
{
    return sqrt((q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]));
}

static double area(const double *p, const double *q, const double *r)
{
    return 0.5 * ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
}

/* Above the longest side. */
static double height(const struct mesh *m, int i, int j, int k)
{
    const double *p = m->xy + 2 * i, *q = m->xy + 2 * j, *r = m->xy + 2 * k;
    return 2.0 * area(p, q, r) / fmax(fmax(distance(p, q), distance(q, r)), distance(r, p));
}

/* ------------------------------------------------------------------ sweep */

struct point {
    double x, y;
    int index;
};

static int left_first(const void *a, const void *b)
{
    const struct point *p = a, *q = b;
    if (p->x != q->x) return p->x < q->x ? -1 : 1;
    return (p->y > q->y) - (p->y < q->y);
}

struct corner { /* of the hull, anticlockwise; a place may be there twice while the hull is a line */
    int point;
    struct corner *before, *after;
};

/* Is the side that begins at c seen from the point? */
static bool sees(const struct mesh *m, int point, const struct corner *c)
{
    const double *a = m->xy + 2 * c->point, *b = m->xy + 2 * c->after->point;
    return -2.0 * area(a, b, m->xy + 2 * point) > m->least * distance(a, b);
}

static void add_triangle(struct mesh *m, const struct corner *side, int point)
{
    if (m->triangles < 2 * m->n)
        memcpy(m->corner[m->triangles++], (int[]){side->after->point, side->point, point}, sizeof *m->corner);
}

/* Joins the next point; returns its corner. spare: two more. */
static struct corner *join(struct mesh *m, struct corner *last, int point, struct corner *room)
{
    struct corner *from = last, *to = last;
    for (; sees(m, point, to); to = to->after)
        add_triangle(m, to, point);
    for (; sees(m, point, from->before); from = from->before)
        add_triangle(m, from->before, point);
    if (from == to) { /* further along the line */
        to = &room[1];
        *to = (struct corner){last->point, NULL, last->after};
        to->after->before = to;
    }
    room[0] = (struct corner){point, from, to};
    from->after = to->before = &room[0];
    return &room[0];
}

static void sweep(struct arena *a, struct mesh *m)
{
    struct point *p = ARENA_TAKE(a, struct point, m->n);
    struct corner *room = ARENA_TAKE(a, struct corner, 2 * (size_t)m->n), *last = room;
    for (int i = 0; i < m->n; i++)
        p[i] = (struct point){m->xy[2 * i], m->xy[2 * i + 1], i};
    qsort(p, (size_t)m->n, sizeof *p, left_first);
    *last = (struct corner){p[0].index, last, last};
    for (int i = 1; i < m->n; i++)
        last = join(m, last, p[i].index, room + 2 * (size_t)i);
}

/* ------------------------------------------------------------------ edges */

static int side_order(const void *a, const void *b)
{
    const struct side *p = a, *q = b;
    if (p->low != q->low) return p->low - q->low;
    if (p->high != q->high) return p->high - q->high;
    return p->triangle != q->triangle ? p->triangle - q->triangle : p->at - q->at;
}

/* Whether the side after k is of the same edge. */
static bool twin(const struct mesh *m, int k)
{
    return k + 1 < m->sides && m->side[k].low == m->side[k + 1].low && m->side[k].high == m->side[k + 1].high;
}

static void find_sides(struct mesh *m)
{
    m->sides = 3 * m->triangles;
    m->hull = 0;
    for (int i = 0; i < m->sides; i++) {
        int p = m->corner[i / 3][(i + 1) % 3], q = m->corner[i / 3][(i + 2) % 3];
        m->side[i] = (struct side){p < q ? p : q, p < q ? q : p, i / 3, i % 3};
        m->count[i / 3] = 0;
    }
    qsort(m->side, (size_t)m->sides, sizeof *m->side, side_order);
    for (int k = 0; k < m->sides; k++)
        if (!twin(m, k) && (k == 0 || !twin(m, k - 1))) {
            m->count[m->side[k].triangle]++;
            m->hull++;
        }
}

/* Drops slivers with one side on the hull, as long as there are any. */
static void peel(struct mesh *m)
{
    for (int left = -1; left != m->triangles;) {
        if (left >= 0) m->triangles = left;
        left = 0;
        find_sides(m);
        for (int t = 0; t < m->triangles; t++) {
            const int *k = m->corner[t];
            if (m->count[t] != 1 || height(m, k[0], k[1], k[2]) > flat)
                memmove(m->corner[left++], k, sizeof m->corner[0]);
        }
    }
}

/* ------------------------------------------------------------------ flips */

/* cot(alpha) + cot(beta) of the angles at c and d over the edge from a to b. */
static double angles(const double *a, const double *b, const double *c, const double *d)
{
    double dot_c = (a[0] - c[0]) * (b[0] - c[0]) + (a[1] - c[1]) * (b[1] - c[1]);
    double dot_d = (a[0] - d[0]) * (b[0] - d[0]) + (a[1] - d[1]) * (b[1] - d[1]);
    return dot_c / (2.0 * area(c, a, b)) + dot_d / (2.0 * area(d, b, a));
}

/* Edge from a to b with c on its left and d on its right: is the diagonal c d the better one? */
static bool better(const struct mesh *m, int a, int b, int c, int d)
{
    double sum = angles(m->xy + 2 * a, m->xy + 2 * b, m->xy + 2 * c, m->xy + 2 * d);
    int now = a < b ? a : b, then = c < d ? c : d;
    if (!(sum < -tie || (sum < tie && then < now))) return false;
    return height(m, c, a, d) > m->least && height(m, d, b, c) > m->least;
}

/* Flips what is to be flipped, each triangle once; returns how many. */
static int flip(struct mesh *m)
{
    int flips = 0;
    find_sides(m);
    memset(m->count, 0, (size_t)m->triangles * sizeof *m->count);
    for (int k = 0; k < m->sides; k++) {
        const struct side *s = &m->side[k];
        if (!twin(m, k) || m->count[s[0].triangle] || m->count[s[1].triangle]) continue;
        int *t = m->corner[s[0].triangle], *u = m->corner[s[1].triangle];
        int c = t[s[0].at], a = t[(s[0].at + 1) % 3], b = t[(s[0].at + 2) % 3], d = u[s[1].at];
        if (!better(m, a, b, c, d)) continue;
        t[0] = c, t[1] = a, t[2] = d;
        u[0] = d, u[1] = b, u[2] = c;
        m->count[s[0].triangle] = m->count[s[1].triangle] = 1;
        flips++;
    }
    return flips;
}

static int by_corner(const void *a, const void *b)
{
    const int *p = a, *q = b;
    for (int c = 0; c < 3; c++)
        if (p[c] != q[c]) return p[c] < q[c] ? -1 : 1;
    return 0;
}

/* The triangles of the points xy [n][2] (m, n >= 3, different, not on one line), anticlockwise, and their sides;
   slivers along the hull, within 1e-9 m of a line, are left out. false: no triangulation. */
static bool delaunay(struct arena *a, const double *xy, struct mesh *m)
{
    int n = m->n;
    double *moved = ARENA_TAKE(a, double, 2 * (size_t)n), extent = 0.0;
    for (int i = 0; i < 2 * n; i++) {
        moved[i] = xy[i] - xy[i % 2];
        extent = fmax(extent, fabs(moved[i]));
    }
    double step = ldexp(extent, -44); /* above least: rounding of x reverses no order of places one above the other */
    for (int i = 0; i < 2 * n; i++)
        moved[i] = step * rint(moved[i] / step);
    m->xy = moved;
    m->least = 1e-14 * extent;
    m->corner = arena_take(a, 2 * (size_t)n, sizeof *m->corner);
    m->side = ARENA_TAKE(a, struct side, 6 * (size_t)n);
    m->count = ARENA_TAKE(a, int, 2 * (size_t)n);
    sweep(a, m);
    for (int pass = 0; pass < 4 * n && flip(m) > 0; pass++)
        ;
    peel(m);
    for (int t = 0; t < m->triangles; t++) { /* the lowest corner of each first, and triangles by it */
        int *k = m->corner[t], low = k[0] < k[1] ? (k[0] < k[2] ? 0 : 2) : (k[1] < k[2] ? 1 : 2);
        int turned[3] = {k[low], k[(low + 1) % 3], k[(low + 2) % 3]};
        memcpy(k, turned, sizeof turned);
    }
    qsort(m->corner, (size_t)m->triangles, sizeof *m->corner, by_corner);
    find_sides(m);
    for (int t = 0; t < m->triangles; t++)
        if (!(height(m, m->corner[t][0], m->corner[t][1], m->corner[t][2]) > 0.0)) return false;
    return m->triangles > 0 && m->triangles == 2 * n - 2 - m->hull;
}

/* Barycentric coordinates in a triangulation: x = x_0 + l_1 (x_1 - x_0) + l_2 (x_2 - x_0), l_0 = 1
   - l_1 - l_2.

   Finding the triangle: the box around the places is cut into cells, about one per triangle; each knows the triangles
   that reach into it, and the first of them that holds the point counts. No search from where the last one was: the
   answer depends on the point alone.

   Off the hull the nearest point of its sides counts. The hull is convex, so along a straight way that point moves
   linearly as long as it stays on one side or at one corner; it changes over at the perpendiculars on each side at its
   ends. */

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
    int *start, *holds; /* holds[start[cell] .. start[cell + 1]): triangles */
};

/* ------------------------------------------------------------------ making */

static struct triangle triangle_make(const double *xy, const int *corner)
{
    const double *o = xy + 2 * corner[0], *p = xy + 2 * corner[1], *q = xy + 2 * corner[2];
    double a = p[0] - o[0], b = q[0] - o[0], c = p[1] - o[1], d = q[1] - o[1], area = a * d - b * c;
    return (struct triangle){corner, {o[0], o[1]}, {{d / area, -b / area}, {-c / area, a / area}}};
}

/* Each edge once, by its lower and its higher end. */
static void take_edges(struct arena *a, const struct mesh *m, struct places_plane *p)
{
    p->edge = arena_take(a, (size_t)m->sides, sizeof *p->edge);
    p->side = arena_take(a, (size_t)m->sides, sizeof *p->side);
    for (int k = 0; k < m->sides; k++) {
        const struct side *s = &m->side[k];
        const int *corner = m->corner[s->triangle];
        if (k > 0 && twin(m, k - 1)) continue;
        p->edge[p->edges][0] = s->low;
        p->edge[p->edges++][1] = s->high;
        if (twin(m, k)) continue;
        p->side[p->sides][0] = corner[(s->at + 1) % 3];
        p->side[p->sides++][1] = corner[(s->at + 2) % 3];
    }
}

static int cell_of(const struct places_plane *p, int c, double x)
{
    double cell = floor((x - p->low[c]) * p->per_metre[c]);
    return cell < 0.0 ? 0 : cell < p->cells[c] ? (int)cell : p->cells[c] - 1;
}

/* Adds a triangle to the cells its box reaches: counts them, or with `holds` writes it down. */
static void enter(struct places_plane *p, int t, int *holds)
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
            if (holds) holds[*next] = t;
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
    p->holds = ARENA_TAKE(a, int, sum);
    for (int t = 0; t < p->triangles; t++)
        enter(p, t, p->holds);
}

/* xy [n][2] must stay. NULL: no triangulation. */
static struct places_plane *plane_make(struct arena *a, int n, const double *xy)
{
    struct places_plane *p = ARENA_TAKE(a, struct places_plane, 1);
    struct mesh m = {.n = n};
    p->xy = xy;
    if (!delaunay(a, xy, &m)) return NULL;
    p->triangles = m.triangles;
    p->triangle = ARENA_TAKE(a, struct triangle, p->triangles);
    for (int t = 0; t < p->triangles; t++)
        p->triangle[t] = triangle_make(xy, m.corner[t]);
    take_edges(a, &m, p);
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

/* As places_at, places_edges. */
static double plane_at(const struct places_plane *p, double x, double y, struct places_mix *mix)
{
    int cell = cell_of(p, 1, y) * p->cells[0] + cell_of(p, 0, x);
    for (int k = p->start[cell]; k < p->start[cell + 1]; k++)
        if (in_triangle(&p->triangle[p->holds[k]], x, y, mix)) return 0.0;
    return off_hull(p, x, y, mix);
}

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
    return places_smooth_lattice_make(
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
    p->kind = PLACES_PLANE;
    p->plane = plane_make(a, p->n, p->xy);
    if (!p->plane)
        return err_set(
            e, ERR_SCENE,
            "the places cannot be triangulated: they lie almost, but not within 1e-9 m, on one line, or almost at the "
            "same point: write them with more digits, or take one place of those that are close");
    p->rings =
        places_smooth_rings_make(a, p->n, p->xy, p->order, rounded * distance(p->xy, p->xy + 2 * farthest(p, 0)));
    p->edges = p->plane->edges;
    p->edge = arena_take(a, (size_t)p->edges, sizeof *p->edge);
    for (int k = 0; k < p->edges; k++)
        for (int c = 0; c < 2; c++)
            p->edge[k][c] = p->order[p->plane->edge[k][c]];
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
    double off = p->plane ? plane_at(p->plane, x, y, mix) : places_smooth_lattice_at(p->lattice, x, y, mix);
    for (int k = 0; k < mix->n && p->plane; k++)
        mix->index[k] = p->order[mix->index[k]];
    return p->kind == PLACES_ONE ? 0.0 : off;
}

bool places_smooth(const struct places *p) { return p->rings || places_rows(p) > p->n; }

int places_rows(const struct places *p)
{
    return p->lattice ? places_smooth_lattice_rows(p->lattice) : p->rings ? places_smooth_rings_rows(p->rings) : p->n;
}

void places_fill(const struct places *p, int n, double *rows)
{
    if (p->lattice)
        places_smooth_lattice_fill(p->lattice, n, rows);
    else if (p->rings)
        places_smooth_rings_fill(p->rings, n, rows);
}

double places_smooth_at(const struct places *p, double x, double y, struct places_sum *sum)
{
    struct places_mix mix;
    double off;
    if (p->lattice) {
        off = places_smooth_lattice_smooth_at(p->lattice, x, y, sum);
        return p->kind == PLACES_ONE ? 0.0 : off;
    }
    if (p->rings) return places_smooth_rings_smooth_at(p->rings, x, y, sum);
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

const char *places_text(const struct places *p, struct arena *a)
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
    if (p->lattice) return places_smooth_lattice_edges(p->lattice, edge);
    *edge = (const int(*)[2])p->edge;
    return p->edges;
}
