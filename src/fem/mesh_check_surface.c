/* The surface of a solid is one or more closed skins: two faces at every edge, one fan of faces at every node. A skin
   of negative volume bounds a cavity; one of next to none is a gap between faces that should be shared; one of six
   faces or fewer is where one or two elements are missing. */
#include <math.h>
#include <stdlib.h>

#include "fem/mesh_check_parts.h"
#include "fem/roots.h"

enum { MISSING = 6 };
static const double no_gap = 1e-9; /* volume over area^1.5 */

struct side_edge {                        /* one edge of one outer face */
    int low, high, face, at_low, at_high; /* slots 3 face + corner */
};

struct surface {
    struct mesh *m;
    int n;
    int (*corner)[3];
    struct side_edge *edge; /* [3 n] sorted */
};

static int by_edge(const void *p, const void *q)
{
    const struct side_edge *a = p, *b = q;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    return (a->face > b->face) - (a->face < b->face);
}

static void collect(struct surface *s, const struct faces_face *f, struct arena *a)
{
    int n = 4 * s->m->elements;
    s->corner = arena_take(a, (size_t)n, sizeof *s->corner);
    for (int i = 0, alike; i < n; i += alike) {
        alike = faces_alike(f + i, n - i);
        for (int c = 0; alike == 1 && c < 3; c++)
            s->corner[s->n][c] = s->m->element[f[i].element][faces_nodes[f[i].side][c]];
        s->n += alike == 1;
    }
    s->edge = ARENA_TAKE(a, struct side_edge, 3 * (size_t)s->n);
    for (int i = 0; i < 3 * s->n; i++) {
        int p = i, q = i - i % 3 + (i + 1) % 3, *c = s->corner[0];
        bool up = c[p] < c[q];
        s->edge[i] = (struct side_edge){up ? c[p] : c[q], up ? c[q] : c[p], i / 3, up ? p : q, up ? q : p};
    }
    qsort(s->edge, 3 * (size_t)s->n, sizeof *s->edge, by_edge);
}

static bool touching(const struct surface *s, int node, const char *what, struct err *e)
{
    const double *p = s->m->at[node];
    return err_set(e, ERR_SCENE,
                   "%s: at (%.4g, %.4g, %.4g) m the surface touches itself in %s: the solid hangs together by nothing "
                   "there; join its parts by faces, or leave a gap",
                   s->m->name, p[0], p[1], p[2], what);
}

/* Joins faces in skin, and the corners of faces round a node in fan. */
static bool join(const struct surface *s, int *skin, int *fan, struct err *e)
{
    for (int i = 0, n; i < 3 * s->n; i += n) {
        const struct side_edge *d = &s->edge[i];
        for (n = 1; i + n < 3 * s->n && d[n].low == d->low && d[n].high == d->high;)
            n++;
        if (n != 2) return touching(s, d->low, "an edge", e);
        roots_join(skin, d[0].face, d[1].face);
        roots_join(fan, d[0].at_low, d[1].at_low);
        roots_join(fan, d[0].at_high, d[1].at_high);
    }
    return true;
}

static bool check_fans(const struct surface *s, int *fan, struct arena *a, struct err *e)
{
    int *root = ARENA_TAKE(a, int, s->m->nodes); /* 1 + the fan's; 0: none yet */
    for (int i = 0; i < 3 * s->n; i++) {
        int *known = &root[s->corner[i / 3][i % 3]], r = 1 + roots_of(fan, i);
        if (*known != 0 && *known != r) return touching(s, s->corner[i / 3][i % 3], "a node", e);
        *known = r;
    }
    return true;
}

/* Adds a face's part to area and volume. */
static void add_face(const struct surface *s, int face, double *area, double *volume)
{
    const double *p = s->m->at[s->corner[face][0]], *q = s->m->at[s->corner[face][1]],
                 *r = s->m->at[s->corner[face][2]], *o = s->m->at[0];
    double n[3];
    for (int c = 0; c < 3; c++) {
        int d = (c + 1) % 3, f = (c + 2) % 3;
        n[c] = (q[d] - p[d]) * (r[f] - p[f]) - (q[f] - p[f]) * (r[d] - p[d]);
        *volume += n[c] * (p[c] - o[c]) / 6;
    }
    *area += 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

static bool check_skins(const struct surface *s, int *skin, struct arena *a, struct err *e)
{
    int *faces = ARENA_TAKE(a, int, s->n), cavities = 0;
    double *area = ARENA_TAKE(a, double, s->n), *volume = ARENA_TAKE(a, double, s->n), hollow = 0;
    for (int i = 0; i < s->n; i++) {
        int r = roots_of(skin, i);
        add_face(s, i, &area[r], &volume[r]);
        faces[r]++;
    }
    for (int i = 0; i < s->n; i++) {
        const double *p = s->m->at[s->corner[i][0]];
        if (faces[i] == 0) continue;
        if (fabs(volume[i]) < no_gap * area[i] * sqrt(area[i]))
            return err_set(e, ERR_SCENE,
                           "%s: at (%.4g, %.4g, %.4g) m %d faces that should be shared are not: neighbours there do "
                           "not have the same nodes; mesh again as one solid",
                           s->m->name, p[0], p[1], p[2], faces[i]);
        if (volume[i] < 0 && faces[i] <= MISSING)
            return err_set(
                e, ERR_SCENE,
                "%s: at (%.4g, %.4g, %.4g) m there is a hole of %d faces inside: elements are missing; mesh again",
                s->m->name, p[0], p[1], p[2], faces[i]);
        cavities += volume[i] < 0;
        hollow += volume[i] < 0 ? -volume[i] : 0;
    }
    if (cavities > 0)
        mesh_check_note(s->m, a,
                        arena_format(a, "the solid has %d closed cavit%s inside, %.3g m^3", cavities,
                                     cavities == 1 ? "y" : "ies", hollow));
    return true;
}

/* Elements whose corners all lie on the surface reach across; at edges of a thick solid there are few. */
static void note_thin(const struct surface *s, struct arena *a)
{
    bool *outer = ARENA_TAKE(a, bool, s->m->nodes);
    int across = 0;
    for (int i = 0; i < 3 * s->n; i++)
        outer[s->corner[i / 3][i % 3]] = true;
    for (int i = 0; i < s->m->elements; i++) {
        const int *t = s->m->element[i];
        across += outer[t[0]] && outer[t[1]] && outer[t[2]] && outer[t[3]];
    }
    if (2 * across > s->m->elements)
        mesh_check_note(s->m, a,
                        arena_format(a,
                                     "%.0f %% of the elements reach from one side of the solid to the other: one "
                                     "element across bends right only while it is not much longer than "
                                     "thick; see whether a finer mesh changes the frequencies",
                                     100. * across / s->m->elements));
}

bool mesh_check_surface(struct mesh *m, const struct faces_face *f, struct arena *a, struct err *e)
{
    struct surface s = {.m = m};
    collect(&s, f, a);
    int *skin = roots_open(s.n, a), *fan = roots_open(3 * s.n, a);
    if (!join(&s, skin, fan, e) || !check_fans(&s, fan, a, e) || !check_skins(&s, skin, a, e)) return false;
    note_thin(&s, a);
    return true;
}
