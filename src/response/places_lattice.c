/* Interpolation on the crossings of lines, axis by axis; a line of places is a grid of one row.

   A coordinate lies in the interval [x_i, x_(i+1)] of its axis, h long, at the share u. Linear shares are 1 - u and u.
   Smooth ones are those of the cubic spline through the places (places_spline.h), written with its slopes m at them:

       f = (1 - u)^2 (1 + 2 u) f_i + u^2 (3 - 2 u) f_(i+1) + h u (1 - u) ((1 - u) m_i - u m_(i+1)),

   so that at a place its own value comes out to the last bit, and along a line whose values are all zero the
   result is zero. In the plane it is the tensor product: values, slopes along x, slopes along y, and slopes along x of
   slopes along y at the four corners of the cell, 16 numbers. Two lines are linear and three a parabola. An axis whose
   distances are so uneven that an error of one value might come out 6 times as large stays linear
   (PLACES_SPLINE_GROWS).

   Why a spline: between 33 x 23 places the gains of the 50 lowest modes of a supported plate, heard at another place,
   are off by -25 dB with linear shares, -43 with four-point Lagrange, -41 by Hermite's form with parabolas' slopes, -56
   with five-point slopes, -52 with the spline; of 100 modes -20, -32, -33, -41, -40 dB. Of a free plate -30, -52, -48,
   -59, -65, and -23, -40, -37, -47, -55 dB. An error of 1 becomes 2.2 with five-point slopes and 2.0 with the spline
   where places are even, and at worst 25 and 10 where distances go up and down by factors of 2.

   Kinks are the lines: of linear shares the slope jumps there, of the spline the third derivative. Beyond the outermost
   lines the nearest point counts. */
#include "response/places_lattice.h"

#include <math.h>
#include <stdlib.h>

#include "response/places_plane.h"
#include "response/places_spline.h"

static const double touching = 1e-9; /* m */

struct axis {
    int n;
    double *at; /* [n] m, increasing                           */
    bool smooth;
    struct places_spline spline;
};

struct places_lattice {
    double base[2], along[2];
    int places;
    struct axis axis[2];
    int *place; /* [n of y][n of x] the caller's index         */
    int (*edge)[2], edges;
};

/* Coordinates along both axes. */
static void coordinates(const double base[2], const double along[2], const double *xy, double s[2])
{
    double dx = xy[0] - base[0], dy = xy[1] - base[1];
    s[0] = dx * along[0] + dy * along[1];
    s[1] = dy * along[0] - dx * along[1];
}

/* ------------------------------------------------------------------ making */

static int up(const void *a, const void *b)
{
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

/* The lines at which the coordinates s[n] (sorted here) are: those nearer than `same` to the one before are of its
 * line, which lies in the middle of them. */
static struct axis lines_of(struct arena *a, int n, double *s, double same)
{
    struct axis x = {.at = ARENA_TAKE(a, double, n)};
    qsort(s, (size_t)n, sizeof *s, up);
    for (int i = 0, first = 0; i < n; i++) {
        if (i > 0 && s[i] - s[i - 1] > same) first = i;
        x.n += first == i;
        x.at[x.n - 1] = 0.5 * (s[first] + s[i]);
    }
    return x;
}

/* Index k of the interval [at[k], at[k + 1]] that holds s, n >= 2. */
static int interval(const struct axis *x, double s)
{
    int low = 0, high = x->n - 1;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        *(x->at[middle] <= s ? &low : &high) = middle;
    }
    return low;
}

static int nearest_line(const struct axis *x, double s)
{
    if (x->n == 1) return 0;
    int k = interval(x, s);
    return k + (s - x->at[k] > x->at[k + 1] - s);
}

/* Each crossing is one place. */
static bool fill_crossings(struct arena *a, struct places_lattice *l, const struct places_lattice_ask *ask)
{
    l->place = ARENA_TAKE(a, int, ask->n);
    for (int i = 0; i < ask->n; i++)
        l->place[i] = -1;
    for (int i = 0; i < ask->n; i++) {
        double s[2];
        coordinates(l->base, l->along, ask->xy + 2 * i, s);
        int *at = &l->place[nearest_line(&l->axis[1], s[1]) * l->axis[0].n + nearest_line(&l->axis[0], s[0])];
        if (*at >= 0) return false;
        *at = ask->order[i];
    }
    return true;
}

static void make_smooth(struct arena *a, struct axis *x)
{
    if (x->n < 3) return;
    struct arena *work = arena_open();
    x->spline = places_spline_make(a, x->n, x->at);
    x->smooth = places_spline_grows(&x->spline, work) <= PLACES_SPLINE_GROWS;
    arena_close(work);
}

static void find_edges(struct arena *a, struct places_lattice *l)
{
    int nx = l->axis[0].n, ny = l->axis[1].n;
    l->edge = arena_take(a, 2 * (size_t)l->places, sizeof *l->edge);
    for (int j = 0; j < ny; j++)
        for (int i = 0; i < nx; i++) {
            const int *at = l->place + j * nx + i;
            if (i + 1 < nx) l->edge[l->edges][0] = at[0], l->edge[l->edges++][1] = at[1];
            if (j + 1 < ny) l->edge[l->edges][0] = at[0], l->edge[l->edges++][1] = at[nx];
        }
}

struct places_lattice *places_lattice_make(struct arena *a, const struct places_lattice_ask *ask)
{
    struct places_lattice *l = ARENA_TAKE(a, struct places_lattice, 1);
    struct arena *work = arena_open();
    double *s[2] = {ARENA_TAKE(work, double, ask->n), ARENA_TAKE(work, double, ask->n)}, at[2];
    *l = (struct places_lattice){
        .base = {ask->base[0], ask->base[1]}, .along = {ask->axis[0], ask->axis[1]}, .places = ask->n};
    for (int i = 0; i < ask->n; i++) {
        coordinates(l->base, l->along, ask->xy + 2 * i, at);
        s[0][i] = at[0];
        s[1][i] = ask->one_row ? 0 : at[1];
    }
    for (int c = 0; c < 2; c++)
        l->axis[c] = lines_of(a, ask->n, s[c], ask->one_row ? 0 : ask->same);
    arena_close(work);
    if ((long)l->axis[0].n * l->axis[1].n != ask->n || (!ask->one_row && (l->axis[0].n < 2 || l->axis[1].n < 2)) ||
        !fill_crossings(a, l, ask))
        return NULL;
    for (int c = 0; c < 2; c++)
        make_smooth(a, &l->axis[c]);
    find_edges(a, l);
    return l;
}

/* ------------------------------------------------------------------ reading */

struct cell {         /* along one axis */
    int at, lines;    /* 1 or 2 */
    double share[2];  /* linear, of the lines    */
    double step, off; /* m; m beyond the lines   */
};

static struct cell cell_at(const struct axis *x, double s)
{
    double on = fmin(fmax(s, x->at[0]), x->at[x->n - 1]);
    if (x->n == 1) return (struct cell){0, 1, {1, 0}, 0, s - on};
    int k = interval(x, on);
    double h = x->at[k + 1] - x->at[k];
    return (struct cell){k, 2, {(x->at[k + 1] - on) / h, (on - x->at[k]) / h}, h, s - on};
}

static double cells_at(const struct places_lattice *l, double x, double y, struct cell c[2])
{
    double s[2];
    coordinates(l->base, l->along, (const double[2]){x, y}, s);
    for (int k = 0; k < 2; k++)
        c[k] = cell_at(&l->axis[k], s[k]);
    double off = sqrt(c[0].off * c[0].off + c[1].off * c[1].off);
    return off > touching ? off : 0.0;
}

double places_lattice_at(const struct places_lattice *l, double x, double y, struct places_mix *mix)
{
    static const int corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    struct cell c[2];
    double off = cells_at(l, x, y, c);
    *mix = (struct places_mix){0};
    for (int k = 0; k < 4; k++) {
        int i = corner[k][0], j = corner[k][1];
        if (i >= c[0].lines || j >= c[1].lines) continue;
        mix->index[mix->n] = l->place[(c[1].at + j) * l->axis[0].n + c[0].at + i];
        mix->weight[mix->n++] = c[0].share[i] * c[1].share[j];
    }
    return off;
}

/* Shares of values and of slopes, [slope][line]. */
static void shares_of(const struct axis *x, const struct cell *c, double share[2][2])
{
    double v = c->share[0], u = c->share[1];
    share[0][0] = x->smooth ? v * v * (v + 3 * u) : v;
    share[0][1] = x->smooth ? u * u * (u + 3 * v) : u;
    share[1][0] = x->smooth ? c->step * u * v * v : 0;
    share[1][1] = x->smooth ? -c->step * u * u * v : 0;
}

int places_lattice_rows(const struct places_lattice *l)
{
    return l->places * (l->axis[0].smooth ? 2 : 1) * (l->axis[1].smooth ? 2 : 1);
}

/* Of slopes along x (i) and y (j): which of the terms. */
static int term(const struct places_lattice *l, int i, int j) { return i + j * (l->axis[0].smooth ? 2 : 1); }

double places_lattice_smooth_at(const struct places_lattice *l, double x, double y, struct places_sum *sum)
{
    struct cell c[2];
    double off = cells_at(l, x, y, c), share[2][2][2];
    for (int k = 0; k < 2; k++)
        shares_of(&l->axis[k], &c[k], share[k]);
    sum->n = 0;
    for (int slope = 0; slope < 4; slope++)
        for (int corner = 0; corner < 4; corner++) {
            int p = slope & 1, q = slope >> 1, i = corner & 1, j = corner >> 1;
            double w = share[0][p][i] * share[1][q][j];
            if (w == 0) continue;
            sum->index[sum->n] = term(l, p, q) * l->places + l->place[(c[1].at + j) * l->axis[0].n + c[0].at + i];
            sum->weight[sum->n++] = w;
        }
    return off;
}

/* Slopes along axis c of the rows of term `from`, as those of term `to`. */
static void fill_slopes(const struct places_lattice *l, int c, int from, int to, int n, double *rows)
{
    struct arena *a = arena_open();
    int lines = l->axis[c].n, across = l->axis[1 - c].n, nx = l->axis[0].n;
    const double **f = ARENA_TAKE(a, const double *, lines);
    double **m = ARENA_TAKE(a, double *, lines);
    for (int j = 0; j < across; j++) {
        for (int k = 0; k < lines; k++) {
            size_t place = (size_t)l->place[c == 0 ? j * nx + k : k * nx + j], all = (size_t)l->places;
            f[k] = rows + ((size_t)from * all + place) * (size_t)n;
            m[k] = rows + ((size_t)to * all + place) * (size_t)n;
        }
        places_spline_slopes(&l->axis[c].spline, n, f, m);
    }
    arena_close(a);
}

void places_lattice_fill(const struct places_lattice *l, int n, double *rows)
{
    bool x = l->axis[0].smooth, y = l->axis[1].smooth;
    if (y) fill_slopes(l, 1, 0, term(l, 0, 1), n, rows);
    if (x) fill_slopes(l, 0, 0, term(l, 1, 0), n, rows);
    if (x && y) fill_slopes(l, 0, term(l, 0, 1), term(l, 1, 1), n, rows);
}

/* ------------------------------------------------------------------ edges */

int places_lattice_edges(const struct places_lattice *l, const int (**edge)[2])
{
    *edge = (const int(*)[2])l->edge;
    return l->edges;
}

void places_lattice_ends(const struct places_lattice *l, int ends[2])
{
    ends[0] = l->place[0];
    ends[1] = l->place[l->places - 1];
}
