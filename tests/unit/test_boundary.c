/* The surface of a mesh: area and volume against closed forms, rays and nearest points against closed forms and a
 * search in small steps. */
#include "fem/boundary.h"
#include "meshes.h"

static struct boundary of(const struct mesh *m)
{
    struct boundary b;
    boundary_make(m, meshes_arena(), &b);
    return b;
}

static double norm(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

START_TEST(test_box)
{
    struct mesh m = meshes_shape("plate:length=30cm,width=20cm,thickness=2cm");
    struct boundary b = of(&m);
    ck_assert_double_eq_tol(b.volume, 0.3 * 0.2 * 0.02, 1e-14); /* rounding */
    ck_assert_double_eq_tol(b.area, 2 * (0.3 * 0.2 + 0.3 * 0.02 + 0.2 * 0.02), 1e-12);
    ck_assert_double_eq_tol(b.outer, b.area, 1e-12);
    ck_assert_double_eq_tol(b.low[0] + b.low[1] + b.low[2], 0, 1e-15);
    ck_assert_double_eq_tol(b.high[0], 0.3, 1e-15);
    ck_assert_double_eq_tol(b.high[2], 0.02, 1e-15);
}
END_TEST

/* A curved element: its volume by its own Jacobian (a cubic polynomial: Gauss' points of a cube folded into the
 * tetrahedron, exact), against the integral over its four faces. */
START_TEST(test_curved_element)
{
    double at[10][3] = {{0, 0, 0},        {1, 0.1, 0},       {0.1, 1, 0},    {0, 0.2, 1},      {0.5, -0.07, 0.02},
                        {0.6, 0.6, -0.1}, {-0.1, 0.5, 0.05}, {0.03, 0, 0.5}, {0.55, 0.1, 0.6}, {0.1, 0.66, 0.55}};
    int element[1][10] = {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}};
    struct mesh m = {.nodes = 10, .elements = 1, .at = at, .element = element};
    struct boundary b = of(&m);
    ck_assert_int_eq(b.n, 4);
    static const double g[4] = {0.06943184420297371, 0.33000947820757187, 0.6699905217924281, 0.9305681557970263},
                        w[4] = {0.17392742256872692, 0.32607257743127307, 0.32607257743127307, 0.17392742256872692};
    static const int ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    double volume = 0;
    for (int q = 0; q < 64; q++) {
        double r = g[q % 4], s = g[q / 4 % 4], t = g[q / 16], l[4] = {0, r, (1 - r) * s, (1 - r) * (1 - s) * t},
               j[3][3] = {{0}};
        l[0] = 1 - l[1] - l[2] - l[3];
        for (int k = 0; k < 3; k++)
            for (int c = 0; c < 3; c++) {
                j[k][c] = (4 * l[k + 1] - 1) * at[k + 1][c] - (4 * l[0] - 1) * at[0][c];
                for (int i = 0; i < 6; i++)
                    for (int end = 0; end < 2; end++)
                        j[k][c] +=
                            4 * l[ends[i][1 - end]] * ((ends[i][end] == k + 1) - (ends[i][end] == 0)) * at[4 + i][c];
            }
        double det = j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
                     j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
                     j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
        volume += w[q % 4] * w[q / 4 % 4] * w[q / 16] * (1 - r) * (1 - r) * (1 - s) * det;
    }
    ck_assert_double_eq_tol(b.volume, volume, 1e-14);
}
END_TEST

START_TEST(test_weights)
{
    static const double node[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
    double w[6];
    for (int i = 0; i < 6; i++) {
        boundary_weights(node[i][0], node[i][1], w);
        for (int k = 0; k < 6; k++)
            ck_assert_double_eq_tol(w[k], i == k, 1e-15);
    }
}
END_TEST

START_TEST(test_ray_plate)
{
    struct mesh m = meshes_shape("plate:length=30cm,width=20cm,thickness=1cm");
    struct boundary b = of(&m);
    struct boundary_point p;
    const double down[3] = {0, 0, -1}, oblique[3] = {0.6, 0, -0.8};
    ck_assert(boundary_ray(&m, &b, (double[3]){0.123, 0.077, 1}, down, &p));
    ck_assert_double_eq_tol(p.at[0], 0.123, 1e-13);
    ck_assert_double_eq_tol(p.at[1], 0.077, 1e-13);
    ck_assert_double_eq_tol(p.at[2], 0.01, 1e-13);
    ck_assert_double_eq_tol(p.normal[2], 1, 1e-13);
    ck_assert(boundary_ray(&m, &b, (double[3]){0.1, 0.05, 0.09}, oblique, &p)); /* 0.08 down: 0.06 on */
    ck_assert_double_eq_tol(p.at[0], 0.16, 1e-13);
    ck_assert(boundary_ray(&m, &b, (double[3]){0.1, 0.05, 0.005}, down, &p)); /* from inside: where it leaves */
    ck_assert_double_eq_tol(p.at[2], 0, 1e-13);
    ck_assert(!boundary_ray(&m, &b, (double[3]){0.31, 0.05, 1}, down, &p));
    ck_assert(!boundary_ray(&m, &b, (double[3]){0.1, 0.05, -1}, down, &p)); /* behind it */
    ck_assert(boundary_ray(&m, &b, (double[3]){0, 0, 1}, down, &p));        /* through a corner of the plate */
}
END_TEST

/* Through nodes, where several faces meet, and again from the other faces' point of view: one face, the same each time,
 * and no hole between them. */
START_TEST(test_ray_edges)
{
    struct mesh m = meshes_fine("sphere:diameter=10cm", 1);
    struct boundary b = of(&m);
    for (int i = 0; i < b.n; i++)
        for (int k = 0; k < 6; k++) {
            const double *x = m.at[b.face[i][k]];
            double r = norm(x), in[3] = {-x[0] / r, -x[1] / r, -x[2] / r}, from[3] = {2 * x[0], 2 * x[1], 2 * x[2]};
            struct boundary_point p, q;
            ck_assert(boundary_ray(&m, &b, from, in, &p));
            for (int c = 0; c < 3; c++) {
                ck_assert_double_eq_tol(p.at[c], x[c], 1e-12);
                from[c] = 1.5 * x[c];
            }
            ck_assert(boundary_ray(&m, &b, from, in, &q));
            ck_assert_int_eq(p.face, q.face);
        }
}
END_TEST

/* Slices of all faces, finely: the first place where a ray comes closest. */
static double slow_nearest(const struct mesh *m, const struct boundary *b, const double place[3])
{
    enum { N = 40 };
    double best = INFINITY, w[6];
    for (int i = 0; i < b->n; i++)
        for (int j = 0; j <= N; j++)
            for (int k = 0; j + k <= N; k++) {
                double d[3] = {-place[0], -place[1], -place[2]};
                boundary_weights((double)j / N, (double)k / N, w);
                for (int q = 0; q < 6; q++)
                    for (int c = 0; c < 3; c++)
                        d[c] += w[q] * m->at[b->face[i][q]][c];
                best = fmin(best, norm(d));
            }
    return best;
}

static double chance(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 9007199254740992.0;
}

START_TEST(test_nearest_search)
{
    static const char *const shapes[] = {"sphere:diameter=10cm,fineness=1",
                                         "bowl:diameter=14cm,height=6cm,thickness=5mm,fineness=1",
                                         "ring:diameter=10cm,width=1cm,thickness=5mm,fineness=1"};
    uint64_t seed = 1;
    for (int s = 0; s < 3; s++) {
        struct mesh m = meshes_shape(shapes[s]);
        struct boundary b = of(&m);
        for (int i = 0; i < 20; i++) {
            double place[3] = {0.2 * chance(&seed) - 0.1, 0.2 * chance(&seed) - 0.1, 0.2 * chance(&seed) - 0.1}, off[3];
            struct boundary_point p;
            double d = boundary_nearest(&m, &b, place, &p), slow = slow_nearest(&m, &b, place);
            ck_assert_double_le(d, slow + 1e-12);
            ck_assert_double_ge(
                d,
                slow -
                    1e-4); /* the search's steps are about 1/40 of 2 cm: 0.5 mm across, (0.25 mm)^2 / 2 d of distance */
            for (int c = 0; c < 3; c++)
                off[c] = place[c] - p.at[c];
            ck_assert_double_eq_tol(norm(off), d, 1e-13);
        }
    }
}
END_TEST

START_TEST(test_nearest_plate)
{
    struct mesh m = meshes_shape("plate:length=30cm,width=20cm,thickness=1cm");
    struct boundary b = of(&m);
    static const double place[5][3] = {
        {0.1, 0.1, 0.5}, {0.1, 0.3, 0.5}, {0.4, 0.3, 0.11}, {0.15, 0.1, 0.0051}, {0.3, 0.2, 0.01}};
    static const double nearest[5][3] = {
        {0.1, 0.1, 0.01}, {0.1, 0.2, 0.01}, {0.3, 0.2, 0.01}, {0.15, 0.1, 0.01}, {0.3, 0.2, 0.01}};
    for (int i = 0; i < 5; i++) {
        struct boundary_point p;
        double d = boundary_nearest(&m, &b, place[i], &p), off[3];
        for (int c = 0; c < 3; c++) {
            ck_assert_double_eq_tol(p.at[c], nearest[i][c], 1e-12);
            off[c] = place[i][c] - nearest[i][c];
        }
        ck_assert_double_eq_tol(d, norm(off), 1e-12);
    }
}
END_TEST

/* Rays and nearest points of a sphere agree with its radius as far as the mesh does, and normals point outwards. */
START_TEST(test_sphere)
{
    struct mesh m = meshes_fine("sphere:diameter=10cm", 3);
    struct boundary b = of(&m);
    uint64_t seed = 7;
    for (int i = 0; i < 200; i++) {
        double v[3] = {2 * chance(&seed) - 1, 2 * chance(&seed) - 1, 2 * chance(&seed) - 1}, r = norm(v), in[3],
               from[3];
        for (int c = 0; c < 3; c++) {
            in[c] = -v[c] / r;
            from[c] = -0.2 * in[c];
        }
        struct boundary_point p, q;
        ck_assert(boundary_ray(&m, &b, from, in, &p));
        ck_assert_double_eq_tol(norm(p.at), 0.05, 0.05 * 2e-3); /* the mesh's own error, quadratic faces of 0.3 rad */
        ck_assert_double_le(p.normal[0] * in[0] + p.normal[1] * in[1] + p.normal[2] * in[2], -0.99);
        ck_assert_double_eq_tol(boundary_nearest(&m, &b, from, &q), 0.2 - 0.05, 0.05 * 2e-3);
        ck_assert_double_le(boundary_nearest(&m, &b, p.at, &q), 1e-12);
    }
}
END_TEST

/* A hollow sphere: pi d^2 outside, pi (d - 2 wall)^2 inside. */
START_TEST(test_outer)
{
    struct mesh m = meshes_fine("sphere:diameter=12cm,wall=2cm", 2);
    struct boundary b = of(&m);
    ck_assert_double_eq_tol(b.outer, M_PI * 0.0144, 1e-3 * M_PI * 0.0144); /* the mesh's own error */
    ck_assert_double_eq_tol(b.area - b.outer, M_PI * 0.0064, 1e-3 * M_PI * 0.0064);
}
END_TEST

UNIT("boundary", test_outer, test_box, test_curved_element, test_weights, test_ray_plate, test_ray_edges,
     test_nearest_search, test_nearest_plate, test_sphere)
