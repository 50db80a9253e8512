/* Interpolation between responses at Chebyshev's places, which converges faster than any power of their distance.

   A piece [a, b] has K = n + 1 Chebyshev-Lobatto nodes, u_k = (a + b)/2 - (b - a)/2 cos(phi_k), phi_k = pi k/n. With u = (a + b)/2 -
   (b - a)/2 cos(phi) the Lagrange polynomial of node k is the barycentric formula with its node polynomial in closed form (T_n' =
   n sin(n phi)/sin(phi); Trefethen, Approximation Theory and Approximation Practice, 2013, ch. 5):

       l_k = (-1)^k sin(phi) sin(n phi) / (c_k n (cos(phi_k) - cos(phi))),   c_0 = c_n = 2, else 1.

   All but the last factor is the same for all k: a share is one division. Rounding: places are measured from the nearer end, e = 1 - cos(phi),
   so that nodes that crowd there stay apart; near the nearest node j, n phi = pi (j + d), |d| <= 1/2, its own share is

       l_j = sin(phi) sin(pi d) / (c_j n 2 sin(pi (j + d/2)/n) sin(pi d/(2 n))),

   in which nothing cancels. At a node, exactly or as far as n phi tells, it is 1 and the others 0. */
#include "convolution/nodes.h"

#include <stdbool.h>
#include <string.h>

#include "num/lanes.h"
#include "num/real.h"

struct piece {
    double a, b;
    int first, n;       /* global index of its first node; degree: nodes - 1          */
    double *e;          /* [n + 1] 1 - cos(pi k/n), in half lengths, from either end  */
};

struct nodes {
    struct arena *arena;
    int pieces, n;
    struct piece *piece;
    double *place;      /* [n]                                                              */
    int count, room;    /* places located                                                   */
    int *in, *nearest;  /* piece; global index of the nearest node                          */
    int *right;         /* e is measured from the right end                                 */
    double *e, *v;      /* distance from the nearer end; sin(phi) sin(n phi)/n from there   */
    double *near;       /* share of the nearest node                                        */
};

/* ------------------------------------------------------------------ making */

static void make_piece(struct nodes *n, struct piece *p)
{
    double middle = 0.5 * (p->a + p->b), half = 0.5 * (p->b - p->a);
    p->e = ARENA_TAKE(n->arena, double, p->n + 1);
    for (int k = 0; k <= p->n; k++) {
        double s = real_sinpi(0.5 * k / p->n);
        p->e[k] = 2.0 * s * s;
        n->place[p->first + k] = 2 * k == p->n ? middle : 2 * k < p->n ? p->a + half * p->e[k] : 0.0;
    }
    for (int k = 0; 2 * k < p->n; k++)
        n->place[p->first + p->n - k] = p->b - half * p->e[k];
}

struct nodes *nodes_make(struct arena *a, int pieces, const double *breaks, const int *count)
{
    struct nodes *n = ARENA_TAKE(a, struct nodes, 1);
    *n = (struct nodes){.arena = a, .pieces = pieces, .n = 1, .piece = ARENA_TAKE(a, struct piece, pieces)};
    for (int q = 0; q < pieces; q++) {
        n->piece[q] = (struct piece){.a = breaks[q], .b = breaks[q + 1], .first = n->n - 1, .n = count[q] < 2 ? 1 : count[q] - 1};
        n->n += n->piece[q].n;
    }
    n->place = ARENA_TAKE(a, double, n->n);
    for (int q = 0; q < pieces; q++)
        make_piece(n, &n->piece[q]);
    return n;
}

int nodes_n(const struct nodes *n)
{
    return n->n;
}

double nodes_place(const struct nodes *n, int k)
{
    return n->place[k];
}

/* ------------------------------------------------------------------ places */

static void make_room(struct nodes *n, int count)
{
    if (count <= n->room)
        return;
    n->room = count;
    n->in = ARENA_TAKE(n->arena, int, count);
    n->nearest = ARENA_TAKE(n->arena, int, count);
    n->right = ARENA_TAKE(n->arena, int, count);
    n->e = ARENA_TAKE(n->arena, double, count);
    n->v = ARENA_TAKE(n->arena, double, count);
    n->near = ARENA_TAKE(n->arena, double, count);
}

/* From the piece of the place before: motions are steady. */
static int find_piece(const struct nodes *n, int q, double u)
{
    while (q > 0 && u < n->piece[q].a)
        q--;
    while (q + 1 < n->pieces && u >= n->piece[q].b)
        q++;
    return q;
}

/* Place i, `e` half lengths from the end it is nearer to and `other` from the other. */
static void locate(struct nodes *n, int i, const struct piece *p, double e, double other)
{
    double t = 2.0 / REAL_PI * p->n * real_atan2(sqrt(e), sqrt(other)), j = rint(t), d = t - j, sine = sqrt(e * other), half = 0.5 * d;
    double c = j == 0.0 || j == p->n ? 2.0 : 1.0, turn = real_sinpi(d);
    int k = p->first + (n->right[i] ? p->n - (int)j : (int)j);
    n->e[i] = e;
    n->nearest[i] = k;
    if (fabs(d) < 1e-30) { /* a node as far as can be told: 0/0 below */
        n->v[i] = 0.0;
        n->near[i] = 1.0;
        return;
    }
    n->v[i] = (fmod(j, 2.0) == 0.0 ? sine : -sine) * turn / p->n;
    n->near[i] = sine * turn / (c * p->n * 2.0 * real_sinpi((j + half) / p->n) * real_sinpi(half / p->n));
}

void nodes_locate(struct nodes *n, int count, const double *u)
{
    make_room(n, count);
    n->count = count;
    for (int i = 0, q = 0; i < count; i++) {
        double end = n->piece[n->pieces - 1].b, at = u[i] < n->piece[0].a ? n->piece[0].a : u[i] > end ? end : u[i];
        q = find_piece(n, q, at);
        const struct piece *p = &n->piece[q];
        double from = (at - p->a) / (0.5 * (p->b - p->a)), to = (p->b - at) / (0.5 * (p->b - p->a));
        n->in[i] = q;
        n->right[i] = to < from;
        locate(n, i, p, fmin(from, to), fmax(from, to));
        if (at == n->place[n->nearest[i]]) {
            n->v[i] = 0.0;
            n->near[i] = 1.0;
        }
    }
}

/* ------------------------------------------------------------------ shares */

struct member {         /* a node in one of its pieces, seen from the left and from the right end */
    int piece, k;
    double e[2], weight[2];
};

LANES_CLONES
static int share_in(const struct nodes *n, struct member m, double *restrict w)
{
    int any = 0;
    const int *restrict in = n->in, *restrict nearest = n->nearest, *restrict right = n->right;
    const double *restrict e = n->e, *restrict v = n->v, *restrict near = n->near;
#pragma omp simd reduction(| : any)
    for (int i = 0; i < n->count; i++) {
        double away = e[i] - (right[i] ? m.e[1] : m.e[0]), far = v[i] * (right[i] ? m.weight[1] : m.weight[0]) / away;
        double share = nearest[i] == m.k ? near[i] : far;
        w[i] = in[i] == m.piece ? share : w[i];
        any |= w[i] != 0.0;
    }
    return any;
}

static bool holds(const struct piece *p, int k)
{
    return k >= p->first && k <= p->first + p->n;
}

int nodes_share(const struct nodes *n, int k, double *w)
{
    int any = 0, q = 0;
    memset(w, 0, (size_t)n->count * sizeof *w);
    while (!holds(&n->piece[q], k))
        q++;
    for (; q < n->pieces && holds(&n->piece[q], k); q++) {
        const struct piece *p = &n->piece[q];
        int left = k - p->first, right = p->n - left;
        double weight = left == 0 || right == 0 ? 0.5 : 1.0;
        any |= share_in(n, (struct member){q, k, {p->e[left], p->e[right]}, {left % 2 ? -weight : weight, right % 2 ? -weight : weight}}, w);
    }
    return any;
}
