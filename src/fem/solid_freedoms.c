/* Faces that are held, as freedoms that are left out.

   Clamped: u = 0 at the face's nodes. Supported: u along the face = 0, u along its normal n is free; at a node of
   several faces n is the mean of their normals there (curved faces meet smoothly). Where one of them leans more than 20
   degrees from the mean, faces meet in an edge: what each holds together is everything. A normal that is an axis leaves
   that axis; any other gets a frame of its own, n and two directions across.

   Rigid motions left over: of the six u = t + w x r those that have nothing along any held direction d. The rows (d, r
   x d), r from the middle of the box in units of its half diagonal, have rank 6 - rigid; squared singular values below
   1e-12 of the largest are zero (files hold normals to about 9 digits). */
#include "fem/solid_freedoms.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct known_face {
    int corner[3], face; /* corners rising */
};

struct holding {
    const struct solid_net *net;
    struct known_face *known; /* [b->n] sorted */
    double (*normal)[3];      /* [nodes] of supported faces: sum, then mean, unit */
    bool *supported, *clamped;
};

static void rise(int c[3])
{
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < 2; i++)
            if (c[i] > c[i + 1]) {
                int t = c[i];
                c[i] = c[i + 1], c[i + 1] = t;
            }
}

static int compare(const void *x, const void *y)
{
    const struct known_face *a = (const struct known_face *)x, *b = (const struct known_face *)y;
    for (int i = 0; i < 3; i++)
        if (a->corner[i] != b->corner[i]) return a->corner[i] < b->corner[i] ? -1 : 1;
    return 0;
}

static void know(struct holding *h, struct arena *a)
{
    const struct boundary *b = h->net->boundary;
    h->known = ARENA_TAKE(a, struct known_face, b->n + 1);
    for (int i = 0; i < b->n; i++) {
        memcpy(h->known[i].corner, b->face[i], sizeof h->known[i].corner);
        rise(h->known[i].corner);
        h->known[i].face = i;
    }
    qsort(h->known, (size_t)b->n, sizeof *h->known, compare);
}

static double unit(double v[3])
{
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3 && length > 0.0; k++)
        v[k] /= length;
    return length;
}

static void cross(const double x[3], const double y[3], double z[3])
{
    for (int k = 0; k < 3; k++)
        z[k] = x[(k + 1) % 3] * y[(k + 2) % 3] - x[(k + 2) % 3] * y[(k + 1) % 3];
}

static double dot(const double x[3], const double y[3]) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }

/* Unit normal of the curved face at its i-th node: along x_u cross x_v. */
static void normal_at(const struct solid_net *net, int which, int i, double n[3])
{
    const struct mesh *m = net->mesh;
    const int *face = net->boundary->face[which], *part = net->lattice.face[i];
    double u = (double)part[1] / net->lattice.order, v = (double)part[2] / net->lattice.order, l = 1.0 - u - v,
           along[2][3] = {{0}};
    const double du[6] = {1 - 4 * l, 4 * u - 1, 0, 4 * (l - u), 4 * v, -4 * v},
                 dv[6] = {1 - 4 * l, 0, 4 * v - 1, -4 * u, 4 * u, 4 * (l - v)};
    for (int a = 0; a < 6; a++)
        for (int k = 0; k < 3; k++) {
            along[0][k] += du[a] * m->at[face[a]][k];
            along[1][k] += dv[a] * m->at[face[a]][k];
        }
    cross(along[0], along[1], n);
    unit(n);
}

enum step { SUM, LEAN };

/* SUM adds the normal to each node's, or clamps the node; LEAN clamps nodes from whose mean normal the face's leans
 * away. */
static void hold_face(struct holding *h, int which, int hold, enum step step)
{
    const int nodes = h->net->lattice.on_face, *face = h->net->face + (size_t)which * (size_t)nodes;
    const double most = 0.93969262078590838; /* cos 20 degrees */
    for (int i = 0; i < nodes; i++) {
        double n[3];
        if (hold == SOLID_CLAMPED) {
            h->clamped[face[i]] = true;
            continue;
        }
        normal_at(h->net, which, i, n);
        h->supported[face[i]] = true;
        if (step == LEAN && dot(n, h->normal[face[i]]) < most) h->clamped[face[i]] = true;
        for (int k = 0; k < 3 && step == SUM; k++)
            h->normal[face[i]][k] += n[k];
    }
}

static bool hold_all(struct holding *h, const struct solid_ask *ask, enum step step, struct err *e)
{
    for (int i = 0; i < ask->n_held; i++) {
        const struct solid_held *held = &ask->held[i];
        for (int k = 0; k < held->n && held->hold != SOLID_FREE; k++) {
            struct known_face want = {{0}, 0}, *found;
            memcpy(want.corner, held->corner[k], sizeof want.corner);
            rise(want.corner);
            found = (struct known_face *)bsearch(&want, h->known, (size_t)h->net->boundary->n, sizeof want, compare);
            if (!found) {
                const double *at = h->net->mesh->at[want.corner[0]];
                return err_set(e, ERR_SCENE,
                               "%s: a face that is to be held, at %g %g %g m, is not on the surface of the solid",
                               h->net->mesh->name, at[0], at[1], at[2]);
            }
            hold_face(h, found->face, held->hold, step);
        }
    }
    return true;
}

/* n, and two directions across it. Exact axes for a normal that is one (to 1e-9). */
static void frame_of(const double n[3], double d[3][3])
{
    int least = 0;
    for (int k = 1; k < 3; k++)
        least = fabs(n[k]) < fabs(n[least]) ? k : least;
    double axis[3] = {0};
    axis[least] = 1.0;
    memcpy(d[0], n, sizeof d[0]);
    cross(n, axis, d[1]);
    unit(d[1]);
    cross(d[0], d[1], d[2]);
}

static int axis_of(const double n[3])
{
    for (int k = 0; k < 3; k++)
        if (fabs(n[k]) > 0.9 && fabs(n[(k + 1) % 3]) < 1e-9 && fabs(n[(k + 2) % 3]) < 1e-9) return k;
    return -1;
}

/* Which directions of a node's frame are free. */
static void free_of(const struct holding *h, int node, struct solid_freedoms *f, int *frames, bool moves[3])
{
    f->frame[node] = -1;
    moves[0] = moves[1] = moves[2] = !h->clamped[node] && !h->supported[node];
    if (h->clamped[node] || !h->supported[node]) return;
    int axis = axis_of(h->normal[node]);
    if (axis >= 0) {
        moves[axis] = true;
        return;
    }
    moves[0] = true;
    f->frame[node] = *frames;
    frame_of(h->normal[node], f->frames[(*frames)++]);
}

static void direction(const struct solid_freedoms *f, int node, int k, double d[3])
{
    memset(d, 0, 3 * sizeof *d);
    d[k] = 1.0;
    if (f->frame[node] >= 0) memcpy(d, f->frames[f->frame[node]][k], 3 * sizeof *d);
}

static int rigid_left(const struct solid_net *net, const struct solid_freedoms *f)
{
    const struct boundary *b = net->boundary;
    double c[6][6] = {{0}}, middle[3], size = 0.0, value[6];
    for (int k = 0; k < 3; k++) {
        middle[k] = 0.5 * (b->low[k] + b->high[k]);
        size += 0.25 * (b->high[k] - b->low[k]) * (b->high[k] - b->low[k]);
    }
    size = sqrt(size);
    for (int i = 0; i < net->nodes; i++)
        for (int k = 0; k < 3; k++) {
            if (f->of[i][k] >= 0) continue;
            double row[6], r[3];
            for (int j = 0; j < 3; j++)
                r[j] = (net->at[i][j] - middle[j]) / size;
            direction(f, i, k, row);
            cross(r, row, row + 3);
            for (int p = 0; p < 36; p++)
                c[p / 6][p % 6] += row[p / 6] * row[p % 6];
        }
    if (LAPACKE_dsyev(LAPACK_ROW_MAJOR, 'N', 'L', 6, c[0], 6, value) != 0) return -1;
    int rigid = 0;
    for (int i = 0; i < 6; i++)
        rigid += value[i] <= 1e-12 * value[5];
    return rigid;
}

static bool hold(struct holding *h, const struct solid_ask *ask, struct arena *a, struct err *e)
{
    size_t n = (size_t)h->net->nodes;
    h->normal = (double(*)[3])arena_take(a, n, sizeof *h->normal);
    h->supported = ARENA_TAKE(a, bool, n);
    h->clamped = ARENA_TAKE(a, bool, n);
    know(h, a);
    if (!hold_all(h, ask, SUM, e)) return false;
    for (size_t i = 0; i < n; i++)
        if (h->supported[i] && unit(h->normal[i]) < 1e-6) h->clamped[i] = true;
    return hold_all(h, ask, LEAN, e);
}

bool solid_freedoms_make(const struct solid_net *net, const struct solid_ask *ask, struct arena *a,
                         struct solid_freedoms *f, struct err *e)
{
    struct holding h = {.net = net};
    int frames = 0;
    if (!hold(&h, ask, a, e)) return false;
    for (int i = 0; i < net->nodes; i++)
        frames += h.supported[i];
    *f = (struct solid_freedoms){.nodes = net->nodes,
                                 .of = (int(*)[3])arena_take(a, (size_t)net->nodes, sizeof *f->of),
                                 .frame = ARENA_TAKE(a, int, net->nodes)};
    f->frames = (double(*)[3][3])arena_take(a, (size_t)frames + 1, sizeof *f->frames);
    frames = 0;
    for (int i = 0; i < net->nodes; i++) {
        bool moves[3];
        free_of(&h, i, f, &frames, moves);
        for (int k = 0; k < 3; k++)
            f->of[i][k] = moves[k] ? f->n++ : -1;
    }
    if (f->n == 0)
        return err_set(e, ERR_SCENE, "%s: every node of the solid is held: leave some of it free, or use a finer mesh",
                       net->mesh->name);
    f->rigid = rigid_left(net, f);
    return true;
}

void solid_freedoms_spread(const struct solid_freedoms *f, const double *q, double *u)
{
    memset(u, 0, 3 * (size_t)f->nodes * sizeof *u);
    for (int i = 0; i < f->nodes; i++)
        for (int k = 0; k < 3; k++) {
            double d[3];
            if (f->of[i][k] < 0) continue;
            direction(f, i, k, d);
            for (int j = 0; j < 3; j++)
                u[3 * i + j] += d[j] * q[f->of[i][k]];
        }
}
