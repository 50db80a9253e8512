/* Between two edges x0, x1 the function is the quintic with the exact value, slope and second derivative at both
   (Hermite); the integral over a piece is Gauss-Legendre quadrature with 8 points on three parts of it.

   A piece is halved until, at 0.3 and 0.6 of it, the quintic agrees with the quadrature to 5e-14 (units of the
   integral) and two roundings of x, and quadrature of the whole with that of the parts. The quintic's error is h^6
   f/46080 at most, in the middle; the parts' quadrature is then better by 2^17. Pieces over which an integral grows by
   less than 5e-14 are kept as they are: so a kink (|g| at a zero) ends after 20 halvings. Where g' jumps is to be a
   break; derivatives are taken just inside a piece's ends. Edges are summed with their rounding errors (Neumaier), so
   that the error does not grow with the number of pieces. */
#include "trajectory/panels.h"

#include <math.h>
#include <string.h>

#include "base/stopwatch.h"

enum { GAUSS = 8, PARTS = 3, DEEPEST = 60 };

static const double TOLERANCE = 5e-14;
static const double PART[PARTS + 1] = {0, 0.3, 0.6, 1};

static const double GAUSS_AT[GAUSS / 2] = {0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959,
                                           0.96028985649753623168};
static const double GAUSS_WEIGHT[GAUSS / 2] = {0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054,
                                               0.10122853629037625915};

struct piece {
    double x0, x1, g[2], dg[2]; /* slopes at the ends, derivatives just inside them */
    double part[PARTS];         /* integrals */
    double inner[2];            /* slope at the two inner ends */
    double whole;               /* integral at once */
};

struct build {
    const struct panels_slope *slope;
    struct arena *arena;
    struct panels *p;
    bool inverse;
    double least, where, sum, lost; /* integral so far, and what its rounding lost */
};

static void gauss_nodes(double a, double b, double *x)
{
    for (int k = 0; k < GAUSS / 2; k++) {
        x[2 * k] = 0.5 * (a + b) - 0.5 * (b - a) * GAUSS_AT[k];
        x[2 * k + 1] = 0.5 * (a + b) + 0.5 * (b - a) * GAUSS_AT[k];
    }
}

static double gauss_sum(double a, double b, const double *g)
{
    double sum = 0;
    for (int k = GAUSS / 2 - 1; k >= 0; k--)
        sum += GAUSS_WEIGHT[k] * (g[2 * k] + g[2 * k + 1]);
    return 0.5 * (b - a) * sum;
}

/* Everything about a piece, in one call of the slope. */
static void piece_measure(const struct build *b, struct piece *w)
{
    enum { N = GAUSS * (PARTS + 1) + 6 };
    double x[N], g[N], dg[N], h = w->x1 - w->x0,
                              inside = fmin(1e-12 * h + 0x1p-50 * fmax(fabs(w->x0), fabs(w->x1)), 1e-3 * h),
                              edge[PARTS + 1];
    for (int k = 0; k <= PARTS; k++)
        edge[k] = k == PARTS ? w->x1 : w->x0 + PART[k] * h;
    for (int k = 0; k < PARTS; k++)
        gauss_nodes(edge[k], edge[k + 1], x + GAUSS * k);
    gauss_nodes(w->x0, w->x1, x + GAUSS * PARTS);
    double *ends = x + GAUSS * (PARTS + 1);
    ends[0] = w->x0, ends[1] = w->x1, ends[2] = w->x0 + inside, ends[3] = w->x1 - inside, ends[4] = edge[1],
    ends[5] = edge[2];
    b->slope->at(b->slope->self, N, x, g, dg);
    for (int k = 0; k < PARTS; k++)
        w->part[k] = gauss_sum(edge[k], edge[k + 1], g + GAUSS * k);
    w->whole = gauss_sum(w->x0, w->x1, g + GAUSS * PARTS);
    for (int k = 0; k < 2; k++) {
        w->g[k] = g[N - 6 + k];
        w->dg[k] = dg[N - 4 + k];
        w->inner[k] = g[N - 2 + k];
    }
}

/* The quintic on 0 <= q <= 1 that rises by `rise`, with slopes v and second derivatives a (per q) at the ends. */
static void quintic(double rise, const double v[2], const double a[2], double c[6])
{
    double p = rise - v[0] - 0.5 * a[0], q = v[1] - v[0] - a[0], r = a[1] - a[0];
    c[0] = 0;
    c[1] = v[0];
    c[2] = 0.5 * a[0];
    c[3] = 10 * p - 4 * q + 0.5 * r;
    c[4] = -15 * p + 7 * q - r;
    c[5] = 6 * p - 3 * q + 0.5 * r;
}

static double quintic_at(const double c[6], double q)
{
    return c[0] + q * (c[1] + q * (c[2] + q * (c[3] + q * (c[4] + q * c[5]))));
}

/* The piece's quintic, from 0; whether it is good. */
static bool piece_fit(const struct build *b, const struct piece *w, double c[6])
{
    double h = w->x1 - w->x0, rise = w->part[0] + w->part[1] + w->part[2], v[2], a[2], worst = fabs(w->whole - rise);
    for (int k = 0; k < 2; k++) {
        v[k] = b->inverse ? rise / w->g[k] : h * w->g[k];
        a[k] = b->inverse ? -rise * rise * w->dg[k] / (w->g[k] * w->g[k] * w->g[k]) : h * h * w->dg[k];
    }
    quintic(b->inverse ? h : rise, v, a, c);
    for (int k = 0; k < 2; k++) {
        double grown = k == 0 ? w->part[0] : w->part[0] + w->part[1];
        double off = b->inverse ? (quintic_at(c, grown / rise) - PART[k + 1] * h) * w->inner[k]
                                : quintic_at(c, PART[k + 1]) - grown;
        worst = fmax(worst, fabs(off));
    }
    return worst <= TOLERANCE + 0x1p-51 * fabs(w->x1) * fmax(w->g[0], w->g[1]);
}

/* The next piece. */
static struct panels_piece *build_piece(struct build *b)
{
    struct panels *p = b->p;
    size_t k = p->n / PANELS_BLOCK;
    if (k == p->room) {
        struct panels_piece **more = ARENA_TAKE(b->arena, struct panels_piece *, 2 * p->room + 8);
        if (p->room > 0) memcpy(more, p->block, p->room * sizeof *more);
        p->block = more;
        p->room = 2 * p->room + 8;
    }
    if (!p->block[k]) p->block[k] = ARENA_TAKE(b->arena, struct panels_piece, PANELS_BLOCK);
    return &p->block[k][p->n++ % PANELS_BLOCK];
}

static void build_add(struct build *b, const struct piece *w, const double c[6])
{
    struct panels_piece *piece = build_piece(b);
    double rise = w->part[0] + w->part[1] + w->part[2], before = b->sum + b->lost, sum = b->sum + rise;
    b->lost += fabs(b->sum) >= fabs(rise) ? (b->sum - sum) + rise : (rise - sum) + b->sum;
    b->sum = sum;
    memcpy(piece->c, c, sizeof piece->c);
    piece->edge = b->inverse ? before : w->x0;
    piece->c[0] = b->inverse ? w->x0 : before;
    b->p->end = b->inverse ? b->sum + b->lost : w->x1;
}

#define PIECE 2500.0 /* predicted cycles of one that is measured */

static bool build_between(struct build *b, double x0, double x1)
{
    double left[DEEPEST + 1], start = x0; /* right ends of the pieces that wait */
    int depth = 0;
    left[0] = x1;
    while (depth >= 0) {
        struct piece w = {.x0 = x0, .x1 = left[depth]};
        double c[6];
        piece_measure(b, &w);
        stopwatch_spend(PIECE);
        for (int k = 0; k < 2 && b->inverse; k++)
            if (!(w.g[k] > b->least) || !(w.inner[k] > b->least)) {
                b->where = w.g[k] > b->least ? w.x0 + PART[k + 1] * (w.x1 - w.x0) : k == 0 ? w.x0 : w.x1;
                return false;
            }
        bool tiny = w.x1 - w.x0 <= 1e-12 * (x1 - start) ||
                    (!b->inverse && depth > 6 && fabs(w.part[0]) + fabs(w.part[1]) + fabs(w.part[2]) < TOLERANCE);
        if (!piece_fit(b, &w, c) && !tiny) {
            left[depth + 1] = w.x0 + 0.5 * (w.x1 - w.x0);
            depth++;
            continue;
        }
        build_add(b, &w, c);
        x0 = w.x1;
        depth--;
    }
    return true;
}

static bool build_all(struct build *b, const double *breaks, size_t n_breaks)
{
    *b->p = (struct panels){0};
    for (size_t i = 0; i + 1 < n_breaks; i++)
        if (!build_between(b, breaks[i], breaks[i + 1])) return false;
    return true;
}

void panels_integral(const struct panels_slope *slope, const double *breaks, size_t n_breaks, struct arena *a,
                     struct panels *p)
{
    struct build b = {.slope = slope, .arena = a, .p = p};
    build_all(&b, breaks, n_breaks);
}

bool panels_inverse(const struct panels_slope *slope, const double *breaks, size_t n_breaks, double least,
                    struct arena *a, struct panels *p, double *where)
{
    struct build b = {.slope = slope, .arena = a, .p = p, .inverse = true, .least = least};
    bool good = build_all(&b, breaks, n_breaks);
    *where = b.where;
    return good;
}

static size_t panels_find(const struct panels *p, double x)
{
    size_t low = 0, high = p->n - 1; /* the piece is among [low, high] */
    while (low < high) {
        size_t middle = (low + high + 1) / 2;
        if (panels_piece(p, middle)->edge <= x)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

void panels_at(const struct panels *p, size_t n, const double *x, double *f, double *df, double *ddf)
{
    size_t i = 0;
    double low = HUGE_VAL, high = -HUGE_VAL, first = panels_edge(p, 0);
    const double *c = NULL;
    for (size_t k = 0; k < n; k++) {
        double at = x[k] < first ? first : x[k] > p->end ? p->end : x[k];
        if (!(at >= low && at < high)) {
            i = k > 0 && i + 1 < p->n && at >= high && at < panels_edge(p, i + 2 < p->n ? i + 2 : p->n)
                    ? i + 1
                    : panels_find(p, at);
            c = panels_piece(p, i)->c;
            low = panels_edge(p, i);
            high = panels_edge(p, i + 1);
        }
        double h = high - low, q = (at - low) / h;
        if (f) f[k] = quintic_at(c, q);
        if (df) df[k] = (c[1] + q * (2 * c[2] + q * (3 * c[3] + q * (4 * c[4] + q * 5 * c[5])))) / h;
        if (ddf) ddf[k] = (2 * c[2] + q * (6 * c[3] + q * (12 * c[4] + q * 20 * c[5]))) / (h * h);
    }
}

double panels_last(const struct panels *p) { return quintic_at(panels_piece(p, p->n - 1)->c, 1); }
