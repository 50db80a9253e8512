/* Delaunay's triangulation of places: a sweep, then flips.

   1. Sweep. Places are taken by rising x (then y); each is joined to the sides of the hull so far that it sees, which
   are those next to the place before it (as in Sinclair's S-hull, 2010). A side is seen from more than 1e-14 of the
   extent in front of it, so that every triangle has an area. While all places lie on one line the hull is that line,
   there and back.
   2. Flips (Lawson, Software for C1 surface interpolation, 1977). An edge is flipped while the angles alpha and beta
   opposite to it sum to more than pi: cot(alpha) + cot(beta) < -tie. Within the tie the four corners lie on one circle
   (every cell of a regular grid) and both diagonals are Delaunay's: that through the place of lowest index is taken, so
   that a grid's all run the same way, and a polygon on a circle becomes a fan. Such flips lower the sum of the
   triangles' lowest indices, so they end, too.
   3. Slivers that rounded coordinates leave along the hull's straight sides are peeled off from outside.

   Whether it is a triangulation is checked by Euler's formula: triangles = 2 n - 2 - sides of the hull.

   Not libqhull: where places lie on common circles and straight sides, as those of a turned grid in rounded
   coordinates, its merged facets (default, Qt) overlapped in a quarter of our trials, and joggled input (QJ) left
   turned-over triangles; both would need steps 2 and 3 as well. */
#include "response/places_delaunay.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

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

static double length(const double *p, const double *q)
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
    return 2.0 * area(p, q, r) / fmax(fmax(length(p, q), length(q, r)), length(r, p));
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
    return -2.0 * area(a, b, m->xy + 2 * point) > m->least * length(a, b);
}

static void add_triangle(struct mesh *m, const struct corner *side, int point)
{
    if (m->triangles < 2 * m->n)
        memcpy(m->corner[m->triangles++], (int[]){side->after->point, side->point, point}, sizeof *m->corner);
}

/* Joins the next point; returns its corner. spare: two more. */
static struct corner *join(struct mesh *m, struct corner *last, int point, struct corner *spare)
{
    struct corner *from = last, *to = last;
    for (; sees(m, point, to); to = to->after)
        add_triangle(m, to, point);
    for (; sees(m, point, from->before); from = from->before)
        add_triangle(m, from->before, point);
    if (from == to) { /* further along the line */
        to = &spare[1];
        *to = (struct corner){last->point, NULL, last->after};
        to->after->before = to;
    }
    spare[0] = (struct corner){point, from, to};
    from->after = to->before = &spare[0];
    return &spare[0];
}

static void sweep(struct arena *a, struct mesh *m)
{
    struct point *p = ARENA_TAKE(a, struct point, m->n);
    struct corner *spare = ARENA_TAKE(a, struct corner, 2 * (size_t)m->n), *last = spare;
    for (int i = 0; i < m->n; i++)
        p[i] = (struct point){m->xy[2 * i], m->xy[2 * i + 1], i};
    qsort(p, (size_t)m->n, sizeof *p, left_first);
    *last = (struct corner){p[0].index, last, last};
    for (int i = 1; i < m->n; i++)
        last = join(m, last, p[i].index, spare + 2 * (size_t)i);
}

/* ------------------------------------------------------------------ edges */

static int side_order(const void *a, const void *b)
{
    const struct side *p = a, *q = b;
    const int x[4] = {p->low, p->high, p->triangle, p->at}, y[4] = {q->low, q->high, q->triangle, q->at};
    for (int c = 0; c < 4; c++)
        if (x[c] != y[c]) return x[c] < y[c] ? -1 : 1;
    return 0;
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

/* The lowest corner of each triangle first, and triangles by it. */
static void settle(struct mesh *m)
{
    for (int t = 0; t < m->triangles; t++) {
        int *k = m->corner[t], low = k[0] < k[1] ? (k[0] < k[2] ? 0 : 2) : (k[1] < k[2] ? 1 : 2);
        int turned[3] = {k[low], k[(low + 1) % 3], k[(low + 2) % 3]};
        memcpy(k, turned, sizeof turned);
    }
    qsort(m->corner, (size_t)m->triangles, sizeof *m->corner, by_corner);
}

static bool sound(const struct mesh *m)
{
    for (int t = 0; t < m->triangles; t++)
        if (!(height(m, m->corner[t][0], m->corner[t][1], m->corner[t][2]) > 0.0)) return false;
    return m->triangles == 2 * m->n - 2 - m->hull;
}

int places_delaunay(struct arena *a, int n, const double *xy, const int (**corner)[3])
{
    struct mesh m = {.n = n};
    double *moved = ARENA_TAKE(a, double, 2 * (size_t)n), extent = 0.0;
    for (int i = 0; i < 2 * n; i++) {
        moved[i] = xy[i] - xy[i % 2];
        extent = fmax(extent, fabs(moved[i]));
    }
    double step = ldexp(extent, -44); /* above least: rounding of x reverses no order of places one above the other */
    for (int i = 0; i < 2 * n; i++)
        moved[i] = step * rint(moved[i] / step);
    m.xy = moved;
    m.least = 1e-14 * extent;
    m.corner = arena_take(a, 2 * (size_t)n, sizeof *m.corner);
    m.side = ARENA_TAKE(a, struct side, 6 * (size_t)n);
    m.count = ARENA_TAKE(a, int, 2 * (size_t)n);
    sweep(a, &m);
    for (int pass = 0; pass < 4 * n && flip(&m) > 0; pass++)
        ;
    peel(&m);
    settle(&m);
    *corner = (const int(*)[3])m.corner;
    return sound(&m) ? m.triangles : 0;
}
