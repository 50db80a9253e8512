/* Small solids for tests: boxes and balls of quadratic tetrahedra on a grid of cells, each cell cut into six along its
 * diagonal away from the middle. */
#ifndef SOLIDS_H
#define SOLIDS_H
#include "fem/solid.h"
#include "unit.h"

#define SOLIDS_PI 3.14159265358979323846

struct solids {
    struct mesh mesh;
    struct boundary boundary;
};

static inline int solids_compare(const void *x, const void *y) { return memcmp(x, y, 3 * sizeof(int)); }

/* Faces that one element has: found by sorting all of them by their corners. */
static inline void solids_boundary(struct solids *s, struct arena *a)
{
    static const int face[4][6] = {{0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {2, 0, 3, 6, 7, 9}};
    struct {
        int corner[3], node[6];
    } *all = arena_take(a, 4 * (size_t)s->mesh.elements, sizeof *all);
    int n = 4 * s->mesh.elements;
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < 6; k++)
            all[i].node[k] = s->mesh.element[i / 4][face[i % 4][k]];
        memcpy(all[i].corner, all[i].node, sizeof all[i].corner);
        for (int p = 0; p < 3; p++)
            for (int k = 0; k < 2; k++)
                if (all[i].corner[k] > all[i].corner[k + 1]) {
                    int t = all[i].corner[k];
                    all[i].corner[k] = all[i].corner[k + 1], all[i].corner[k + 1] = t;
                }
    }
    qsort(all, (size_t)n, sizeof *all, solids_compare);
    s->boundary = (struct boundary){.face = arena_take(a, (size_t)n, sizeof *s->boundary.face),
                                    .box = arena_take(a, (size_t)n, sizeof *s->boundary.box)};
    for (int i = 0; i < n; i++) {
        bool twin =
            (i > 0 && !solids_compare(&all[i], &all[i - 1])) || (i + 1 < n && !solids_compare(&all[i], &all[i + 1]));
        if (!twin) memcpy(s->boundary.face[s->boundary.n++], all[i].node, sizeof all[i].node);
    }
}

/* Box, area and volume (of flat triangles and pyramids under them: to a few per cent for what is curved, which is all
 * that is needed). */
static inline void solids_measure(struct solids *s)
{
    struct boundary *b = &s->boundary;
    for (int k = 0; k < 3; k++) {
        b->low[k] = b->high[k] = s->mesh.at[0][k];
        for (int i = 0; i < s->mesh.nodes; i++) {
            b->low[k] = fmin(b->low[k], s->mesh.at[i][k]);
            b->high[k] = fmax(b->high[k], s->mesh.at[i][k]);
        }
    }
    for (int i = 0; i < b->n; i++) /* of a face's corners, and of where its edges' parabolas are headed */
        for (int k = 0; k < 3; k++) {
            double low = HUGE_VAL, high = -HUGE_VAL;
            for (int j = 0; j < 3; j++) {
                double p = s->mesh.at[b->face[i][j]][k], q = s->mesh.at[b->face[i][(j + 1) % 3]][k],
                       control = 2.0 * s->mesh.at[b->face[i][3 + j]][k] - 0.5 * (p + q);
                low = fmin(low, fmin(p, control));
                high = fmax(high, fmax(p, control));
            }
            b->box[i][0][k] = low;
            b->box[i][1][k] = high;
        }
    b->area = b->volume = 0.0;
    for (int i = 0; i < b->n; i++) {
        const double *p = s->mesh.at[b->face[i][0]], *q = s->mesh.at[b->face[i][1]], *r = s->mesh.at[b->face[i][2]];
        double c[3];
        for (int k = 0; k < 3; k++) {
            int u = (k + 1) % 3, v = (k + 2) % 3;
            c[k] = 0.5 * ((q[u] - p[u]) * (r[v] - p[v]) - (q[v] - p[v]) * (r[u] - p[u]));
            b->volume += c[k] * (p[k] + q[k] + r[k]) / 9.0;
        }
        b->area += sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
    }
}

/* n cells along each side; corners where the diagonal starts are on the side of the middle. */
static inline struct solids solids_box(const int n[3], const double size[3], struct arena *a)
{
    static const int paths[6][2] = {{0, 1}, {0, 2}, {1, 0}, {1, 2}, {2, 0}, {2, 1}};
    static const int ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    struct solids s = {.mesh = {.name = "box"}};
    const int wide[3] = {2 * n[0] + 1, 2 * n[1] + 1, 2 * n[2] + 1};
    s.mesh.nodes = wide[0] * wide[1] * wide[2];
    s.mesh.at = arena_take(a, (size_t)s.mesh.nodes, sizeof *s.mesh.at);
    s.mesh.element = arena_take(a, 6 * (size_t)(n[0] * n[1] * n[2]), sizeof *s.mesh.element);
    for (int i = 0; i < s.mesh.nodes; i++) {
        const int g[3] = {i % wide[0], i / wide[0] % wide[1], i / wide[0] / wide[1]};
        for (int k = 0; k < 3; k++)
            s.mesh.at[i][k] = size[k] * g[k] / (wide[k] - 1);
    }
    for (int cell = 0; cell < n[0] * n[1] * n[2]; cell++)
        for (int p = 0; p < 6; p++) {
            const int c[3] = {cell % n[0], cell / n[0] % n[1], cell / n[0] / n[1]};
            int g[10][3], *node = s.mesh.element[s.mesh.elements++], turned = 0;
            for (int k = 0; k < 3; k++) {
                int up = 2 * c[k] + 1 > n[k] || n[k] == 1, from = up ? 2 * c[k] : 2 * c[k] + 2,
                    to = up ? from + 2 : from - 2;
                turned += !up;
                g[0][k] = from, g[3][k] = to;
                g[1][k] = paths[p][0] == k ? to : from;
                g[2][k] = paths[p][0] == k || paths[p][1] == k ? to : from;
            }
            if ((turned + ((paths[p][1] - paths[p][0] + 3) % 3 == 2)) % 2)
                for (int k = 0; k < 3; k++) {
                    int t = g[1][k];
                    g[1][k] = g[2][k], g[2][k] = t;
                }
            for (int e = 0; e < 6; e++)
                for (int k = 0; k < 3; k++)
                    g[4 + e][k] = (g[ends[e][0]][k] + g[ends[e][1]][k]) / 2;
            for (int i = 0; i < 10; i++)
                node[i] = (g[i][2] * wide[1] + g[i][1]) * wide[0] + g[i][0];
        }
    solids_boundary(&s, a);
    solids_measure(&s);
    return s;
}

/* A cube of n cells (even), swollen to a ball round the origin: midsides on the sphere. */
static inline struct solids solids_ball(int n, double radius, struct arena *a)
{
    struct solids s = solids_box((const int[]){n, n, n}, (const double[]){2, 2, 2}, a);
    for (int i = 0; i < s.mesh.nodes; i++) {
        double *p = s.mesh.at[i], most = 0.0, square = 0.0;
        for (int k = 0; k < 3; k++) {
            p[k] -= 1.0;
            most = fmax(most, fabs(p[k]));
            square += p[k] * p[k];
        }
        double swell = square > 0.0 ? 1.0 - most + most * most / sqrt(square) : 1.0;
        for (int k = 0; k < 3; k++)
            p[k] *= radius * swell;
    }
    solids_measure(&s);
    return s;
}

/* Corners of the faces whose corners all have that coordinate. */
static inline struct solid_fixed solids_hold(const struct solids *s, int hold, int axis, double value, struct arena *a)
{
    struct solid_fixed h = {hold, 0, arena_take(a, (size_t)s->boundary.n, sizeof *h.corner)};
    for (int i = 0; i < s->boundary.n; i++) {
        double off = 0.0;
        for (int k = 0; k < 3; k++)
            off = fmax(off, fabs(s->mesh.at[s->boundary.face[i][k]][axis] - value));
        if (off < 1e-9) memcpy(h.corner[h.n++], s->boundary.face[i], sizeof *h.corner);
    }
    return h;
}

/* Steel: E 200 GPa, nu 0.3, 7850 kg/m^3. */
static inline struct elastic solids_steel(void)
{
    struct elastic steel;
    struct err e = {0};
    ck_assert(solid_element_isotropic(200e9, 0.3, 7850.0, &steel, &e));
    return steel;
}

static inline struct solid_modes solids_modes(const struct solids *s, const struct solid_ask *ask, struct arena *a)
{
    struct solid_modes modes;
    struct err e = {0};
    ck_assert_msg(solid_modes(&s->mesh, &s->boundary, ask, a, &modes, &e), "%s", e.text);
    return modes;
}

static inline double solids_hz(const struct solid_modes *m, int i) { return sqrt(m->lambda[i]) / (2.0 * SOLIDS_PI); }

#define SOLIDS_NEAR(is, want, tolerance)                                                                               \
    do {                                                                                                               \
        double solids_is = (is), solids_want = (want);                                                                 \
        ck_assert_msg(fabs(solids_is - solids_want) <= (tolerance)*fabs(solids_want),                                  \
                      "%s = %.9g, not %.9g (off by %.3g)", #is, solids_is, solids_want,                                \
                      solids_is / solids_want - 1.0);                                                                  \
    } while (0)

#endif
