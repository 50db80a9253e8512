/* places: weights against the linear functions they must reproduce, triangulations against the definition (no place
   inside a triangle's circle) checked by brute force, the hull's distance against a dense search, the mix itself. */
#include "response/places.h"

#include "unit.h"

static struct arena *arena;

static struct places *made(int n, const double *xy, enum places_kind kind)
{
    struct err e = {0};
    struct places *p;
    int bad;
    ck_assert_msg(places_make(arena, n, xy, &p, &bad, &e), "%s", e.text);
    ck_assert_int_eq(places_kind(p), kind);
    return p;
}

static void setup(void)
{
    arena = arena_open();
    srand48(7);
}
static void teardown(void) { arena_close(arena); }

/* Weights are a mix, and reproduce x and y where the point is on the hull. */
static double check_mix(const struct places *p, const double *xy, double x, double y)
{
    struct places_mix m;
    double off = places_at(p, x, y, &m), sx = 0, sy = 0, sum = 0;
    ck_assert(m.n >= 1 && m.n <= 3);
    for (int k = 0; k < m.n; k++) {
        ck_assert(m.weight[k] >= 0 && m.weight[k] <= 1);
        sum += m.weight[k];
        sx += m.weight[k] * xy[2 * m.index[k]];
        sy += m.weight[k] * xy[2 * m.index[k] + 1];
    }
    ck_assert_double_eq_tol(sum, 1, 4e-16);
    if (off == 0) {
        ck_assert_double_eq_tol(sx, x, 2e-9); /* within 1e-9 m is on it */
        ck_assert_double_eq_tol(sy, y, 2e-9);
    } else
        ck_assert_double_eq_tol(sqrt((sx - x) * (sx - x) + (sy - y) * (sy - y)), off, 1e-12);
    return off;
}

START_TEST(one_place)
{
    setup();
    double xy[] = {0.3, 0.4};
    struct places_mix m;
    const int(*edge)[2];
    struct places *p = made(1, xy, PLACES_ONE);
    ck_assert(places_at(p, 9, 9, &m) == 0 && m.n == 1 && m.index[0] == 0 && m.weight[0] == 1);
    ck_assert(places_edges(p, &edge) == 0);
    teardown();
}
END_TEST

/* Places in any order on a slanted line; also beside it and beyond its ends; the coordinates as given, to the last bit.
 */
START_TEST(a_line)
{
    setup();
    double xy[] = {1.3, 1.4, 1, 1, 1.6, 1.8, 1.06, 1.08};
    struct places *p = made(4, xy, PLACES_LINE);
    struct places_mix m;
    for (int i = 0; i < 1000; i++) {
        double s = 2 * drand48() - 0.5, off = check_mix(p, xy, 1 + 0.6 * s, 1 + 0.8 * s);
        ck_assert_double_eq_tol(off, s < 0 ? -s : s > 1 ? s - 1 : 0, 1e-9);
    }
    ck_assert_double_eq_tol(places_at(p, 1.3 - 0.8, 1.4 + 0.6, &m), 1, 1e-15); /* beside: its foot is the place 0 */
    ck_assert_double_eq_tol(m.weight[0] * (m.index[0] == 0) + m.weight[1] * (m.index[1] == 0), 1, 1e-12);
    ck_assert(places_at(p, 1 - 5e-10, 1, &m) == 0); /* rounding of a path is not outside */
    const int(*edge)[2];
    ck_assert(places_edges(p, &edge) == 3 && edge[0][0] == 1 && edge[0][1] == 3 && edge[1][1] == 0 && edge[2][1] == 2);
    double bent[] = {0, 0, 1, 0, 0.5, 2e-9}, straight[] = {0, 0, 1, 0, 0.5, 9e-10};
    made(3, bent, PLACES_PLANE);
    made(3, straight, PLACES_LINE);
    teardown();
}
END_TEST

/* The triangles from the edges: every three that are joined and hold no other place. */
static int triangles(const struct places *p, int n, int (*t)[3])
{
    static bool joined[400][400];
    const int(*edge)[2];
    int count = 0, edges = places_edges(p, &edge);
    memset(joined, 0, sizeof joined);
    for (int k = 0; k < edges; k++) {
        ck_assert(edge[k][0] != edge[k][1] && !joined[edge[k][0]][edge[k][1]]);
        joined[edge[k][0]][edge[k][1]] = joined[edge[k][1]][edge[k][0]] = true;
    }
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++)
            for (int k = j + 1; joined[i][j] && k < n; k++)
                if (joined[i][k] && joined[j][k]) {
                    t[count][0] = i, t[count][1] = j, t[count++][2] = k;
                    ck_assert_int_lt(count, 4000);
                }
    return count;
}

/* How far (relative to its radius) d lies inside the circle through a, b, c. */
static double in_circle(const double *a, const double *b, const double *c, const double *d)
{
    long double bx = b[0] - (long double)a[0], by = b[1] - (long double)a[1], cx = c[0] - (long double)a[0],
                cy = c[1] - (long double)a[1];
    long double area = 2 * (bx * cy - by * cx), bb = bx * bx + by * by, cc = cx * cx + cy * cy;
    long double ux = (cy * bb - by * cc) / area, uy = (bx * cc - cx * bb) / area, dx = d[0] - a[0] - ux,
                dy = d[1] - a[1] - uy;
    return (double)(1 - sqrtl((dx * dx + dy * dy) / (ux * ux + uy * uy)));
}

/* What places_at mixes at random points is a triangle whose circle holds no place (the definition of Delaunay's
   triangulation); every triangle is found, since the points are dense; slack for cocircular places. */
static void check_delaunay(const struct places *p, int n, const double *xy, double low, double high)
{
    double worst = -1;
    for (int i = 0; i < 4000; i++) {
        double x = low + (high - low) * drand48(), y = low + (high - low) * drand48();
        struct places_mix m;
        double off = check_mix(p, xy, x, y);
        places_at(p, x, y, &m);
        if (off > 0) continue;
        ck_assert_int_eq(m.n, 3);
        for (int k = 0; k < n; k++)
            if (k != m.index[0] && k != m.index[1] && k != m.index[2])
                worst =
                    fmax(worst, in_circle(xy + 2 * m.index[0], xy + 2 * m.index[1], xy + 2 * m.index[2], xy + 2 * k));
    }
    ck_assert_double_lt(worst, 1e-9);
}

START_TEST(random_places_are_delaunays)
{
    setup();
    static double xy[2 * 200];
    static int t[4000][3];
    for (int n = 3; n <= 200; n = n * 3 / 2 + 1) {
        for (int i = 0; i < 2 * n; i++)
            xy[i] = 5 + 0.1 * drand48(); /* away from the origin */
        struct places *p = made(n, xy, PLACES_PLANE);
        check_delaunay(p, n, xy, 4.98, 5.12);
        const int(*edge)[2];
        int count = triangles(p, n, t), edges = places_edges(p, &edge),
            hull = 2 * edges - 3 * (edges - n + 1); /* Euler */
        ck_assert_int_ge(count, 2 * n - 2 - hull);  /* joined threes may also surround others */
        long double area = 0;
        for (int i = 0; i < 20000; i++)
            area += places_at(p, 5 + 0.1 * drand48(), 5 + 0.1 * drand48(), &(struct places_mix){0}) == 0 ? 0.01L / 20000
                                                                                                         : 0;
        ck_assert(area > 0 && area <= 0.0101L);
        ck_assert(n < 100 || area > 0.008L);
    }
    teardown();
}
END_TEST

/* Grids without one of their crossings (every cell's corners lie on one circle), also turned and of rounded
 * coordinates: triangles, in whatever order the places are. */
START_TEST(holed_grids)
{
    setup();
    static double xy[2 * 400], other[2 * 400];
    for (int kind = 0; kind < 3; kind++) {
        int columns = kind == 1 ? 3 : 20, rows = kind == 1 ? 3 : 17, n = 0, shift = 0;
        double c = kind == 2 ? cos(0.3) : 1, s = kind == 2 ? sin(0.3) : 0;
        for (int i = 0; i < columns * rows; i++) {
            double x = 0.1 + 0.03 * (i % columns), y = 0.02 * (i / columns);
            if (i == columns + 1) continue;
            xy[2 * n] = c * x - s * y;
            xy[2 * n++ + 1] = s * x + c * y;
        }
        struct places *p = made(n, xy, PLACES_PLANE), *q;
        check_delaunay(p, n, xy, -0.2, 0.8);
        for (int i = 0; i < n; i++) { /* 37 is no divisor of either number */
            shift = (shift + 37) % n;
            memcpy(other + 2 * i, xy + 2 * shift, 2 * sizeof *xy);
        }
        q = made(n, other, PLACES_PLANE);
        for (int i = 0; i < 2000; i++) {
            struct places_mix m, o;
            double x = 0.8 * drand48() - 0.2, y = 0.8 * drand48() - 0.2;
            ck_assert(places_at(p, x, y, &m) == places_at(q, x, y, &o) && m.n == o.n);
            for (int k = 0; k < m.n; k++)
                ck_assert(m.weight[k] == o.weight[k] && xy[2 * m.index[k]] == other[2 * o.index[k]] &&
                          xy[2 * m.index[k] + 1] == other[2 * o.index[k] + 1]);
        }
    }
    teardown();
}
END_TEST

/* All places on one circle, of which every triangulation is Delaunay's, and a circle with its centre. */
START_TEST(circles)
{
    setup();
    double xy[2 * 41];
    for (int i = 0; i < 40; i++) {
        xy[2 * i] = 0.1 * cos(0.05 * 3.14159265358979 * i);
        xy[2 * i + 1] = 0.1 * sin(0.05 * 3.14159265358979 * i);
    }
    xy[80] = xy[81] = 0;
    const int(*edge)[2];
    for (int n = 40; n <= 41; n++) {
        struct places *p = made(n, xy, PLACES_PLANE);
        ck_assert_int_eq(places_edges(p, &edge), 3 * n - 3 - 40);
        check_delaunay(p, n, xy, -0.12, 0.12);
    }
    teardown();
}
END_TEST

/* Round a middle, symmetric: many places lie one above the other, but for 1e-17 of the sines' rounding. */
START_TEST(symmetric_rings)
{
    setup();
    static double xy[2 * 1000];
    for (int rings = 2; rings <= 12; rings++) {
        int n = 1;
        for (int j = 1; j <= rings; j++)
            for (int k = 0, count = 4 * (j + 1); k < count; k++, n++) {
                xy[2 * n] = 0.1 * sin(0.9 * j / rings) * cos(2 * 3.14159265358979 * k / count);
                xy[2 * n + 1] = 0.1 * sin(0.9 * j / rings) * sin(2 * 3.14159265358979 * k / count);
            }
        check_delaunay(made(n, xy, PLACES_PLANE), n, xy, -0.12, 0.12);
    }
    teardown();
}
END_TEST

/* Off the hull: against the nearest of many points of it. */
START_TEST(distance_to_the_hull)
{
    setup();
    double xy[2 * 30];
    struct places_mix m;
    for (int i = 0; i < 60; i++)
        xy[i] = drand48();
    struct places *p = made(30, xy, PLACES_PLANE);
    for (int i = 0; i < 50; i++) {
        double x = 4 * drand48() - 1.5, y = 4 * drand48() - 1.5, off = places_at(p, x, y, &m), least = 1e9;
        for (int a = 0; a < 30;
             a++) /* segments between any two places fill the hull's boundary and more, none of it outside */
            for (int b = 0; b < a; b++)
                for (int k = 0; k <= 1000; k++) {
                    double dx = xy[2 * a] + (xy[2 * b] - xy[2 * a]) * k / 1000 - x,
                           dy = xy[2 * a + 1] + (xy[2 * b + 1] - xy[2 * a + 1]) * k / 1000 - y;
                    least = fmin(least, dx * dx + dy * dy);
                }
        if (off > 0)
            ck_assert_double_eq_tol(off, sqrt(least), 1e-3 / fmax(off, 1e-3) * 1e-3 + 1e-4);
        else
            ck_assert_double_lt(sqrt(least), 0.3);
    }
    teardown();
}
END_TEST

START_TEST(refused)
{
    setup();
    struct places *p;
    int bad;
    double twice[] = {0, 0, 1, 1, 0.5, 0.2, 1, 1 + 5e-10}, line[] = {0, 0, 1, 0, 0.5, 0, 0.5, 0};
    struct err e = {0};
    ck_assert(!places_make(arena, 4, twice, &p, &bad, &e) && bad == 3);
    ck_assert_str_eq(e.text, "is at the same point as another place: remove one of the two, or mend where it lies");
    ck_assert(!places_make(arena, 4, line, &p, &bad, &e) && bad == 3);
    ck_assert(!places_make(arena, 2, line + 4, &p, &bad, &e) && bad == 1);
    teardown();
}
END_TEST

/* A straight side of rounded coordinates, a sliver's width off or on. */
START_TEST(nearly_straight_sides)
{
    setup();
    double xy[2 * 60];
    for (int trial = 0; trial < 200; trial++) {
        int n = 4 + trial % 50;
        double size = trial % 3 == 0 ? 1e-17 : trial % 3 == 1 ? 1e-10 : 1e-8;
        for (int i = 0; i < n; i++) {
            xy[2 * i] = 0.1 + 0.3 * i / n;
            xy[2 * i + 1] = 0.7 + 0.25 * xy[2 * i] + size * (drand48() - 0.5);
        }
        xy[2 * n] = 0.2, xy[2 * n + 1] = 0.9;
        struct places *p = made(n + 1, xy, PLACES_PLANE);
        for (int i = 0; i < 200; i++)
            check_mix(p, xy, 0.5 * drand48(), 0.6 + 0.5 * drand48());
        for (int i = 0; i <= n; i++) {
            struct places_mix m;
            double there = 0;
            ck_assert(places_at(p, xy[2 * i], xy[2 * i + 1], &m) == 0);
            for (int k = 0; k < m.n; k++)
                there += m.index[k] == i ? m.weight[k] : 0;
            ck_assert_double_eq_tol(there, 1, 1e-6);
        }
    }
    teardown();
}
END_TEST

/* How messages name them; the line's ends are where it runs to, in whatever order the places are. */
START_TEST(told)
{
    setup();
    double plank[] = {0.1, 0.037, 0, 0.037, 0.4, 0.037}, upright[] = {0.02, 0.3, 0.02, -0.1},
           slanting[] = {1.3, 1.4, 1, 1, 1.6, 1.8}, plane[] = {0, 0, 0.2, 0, 0.05, -0.1};
    ck_assert_str_eq(places_text(made(3, plank, PLACES_LINE), arena), "its places lie on 0 <= x <= 40 cm, y = 3.7 cm");
    ck_assert_str_eq(places_text(made(2, upright, PLACES_LINE), arena),
                     "its places lie on x = 2 cm, -10 <= y <= 30 cm");
    ck_assert_str_eq(places_text(made(3, slanting, PLACES_LINE), arena),
                     "its places lie on the line from (100, 100) to (160, 180) cm");
    ck_assert_str_eq(places_text(made(3, plane, PLACES_PLANE), arena),
                     "its places lie within 0 <= x <= 20 cm, -10 <= y <= 0 cm");
    teardown();
}
END_TEST

UNIT("places", one_place, told, a_line, random_places_are_delaunays, holed_grids, circles, symmetric_rings,
     distance_to_the_hull, refused, nearly_straight_sides)
