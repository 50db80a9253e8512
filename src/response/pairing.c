/* Pairing modes.

   Assignment: shortest augmenting paths with potentials u (rows), v (columns) (Kuhn's Hungarian method in the form of
   Jonker and Volgenant, Computing 38, 1987). One row after the other is brought in by the alternating path of least
   reduced cost c - u - v >= 0. A row without partner is paired with a spare column of cost 2 alone: that both of a pair
   stay alone costs alone + alone, and the columns' share of it is constant but for the pairs made.

   Cost of a pair: |log f - log f'| + small g d/(1 + d), d = |log decay - log decay'|, g = log(1 + gate), small = 1e-3:
   decay decides only between what frequency leaves equal to a thousandth of the gate. Alone costs g, so that two modes
   within the gate with no others near are always a pair, and a chain of pairs is given up for another only where that
   saves more than what becomes alone.

   Modes farther apart than the gate cannot be partners, so the sorted frequencies of both places fall into blocks, each
   a problem of its own.

   Sorting by frequency and pairing by rank, as is often done, pairs everything above a missing mode wrongly
   (tests/unit/test_pairing.c). */
#include "response/pairing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "num/real.h"

/* ------------------------------------------------------------------ assignment */

struct problem {
    int rows, columns; /* columns: the real ones; then as many spare ones as rows */
    const double *cost;
    double spare;
    double *u, *v, *least; /* potentials; least reduced cost to each column so far */
    int *row, *from;       /* of a column: its row (-1: free), the column before it on the path (-1: the new row) */
    char *done;
};

static double reduced(const struct problem *p, int row, int column)
{
    double cost = column < p->columns ? p->cost[(size_t)row * p->columns + column] : p->spare;
    return cost - p->u[row] - p->v[column];
}

/* Looks from a row that a path of `column` (-1: none) has led to; returns the nearest column not done. */
static int look(struct problem *p, int row, int column)
{
    int nearest = -1;
    for (int j = 0; j < p->columns + p->rows; j++) {
        if (p->done[j]) continue;
        double cost = reduced(p, row, j);
        if (cost < p->least[j]) {
            p->least[j] = cost;
            p->from[j] = column;
        }
        if (nearest < 0 || p->least[j] < p->least[nearest]) nearest = j;
    }
    return nearest;
}

/* All that is on the tree comes nearer by `step`. */
static void shift(struct problem *p, int first, double step)
{
    p->u[first] += step;
    for (int j = 0; j < p->columns + p->rows; j++)
        if (p->done[j]) {
            p->u[p->row[j]] += step;
            p->v[j] -= step;
        } else
            p->least[j] -= step;
}

static void bring_in(struct problem *p, int first)
{
    int column = -1, all = p->columns + p->rows;
    for (int j = 0; j < all; j++) {
        p->least[j] = HUGE_VAL;
        p->done[j] = 0;
    }
    do {
        if (column >= 0) p->done[column] = 1;
        column = look(p, column < 0 ? first : p->row[column], column);
        shift(p, first, p->least[column]);
    } while (p->row[column] >= 0);
    for (int before; column >= 0; column = before) {
        before = p->from[column];
        p->row[column] = before < 0 ? first : p->row[before];
    }
}

static void solve(struct arena *a, int rows, int columns, const double *cost, double alone, int *column)
{
    int all = rows + columns;
    struct problem p = {.rows = rows, .columns = columns, .cost = cost, .spare = 2.0 * alone};
    p.u = ARENA_TAKE(a, double, rows);
    p.v = ARENA_TAKE(a, double, all);
    p.least = ARENA_TAKE(a, double, all);
    p.row = ARENA_TAKE(a, int, all);
    p.from = ARENA_TAKE(a, int, all);
    p.done = ARENA_TAKE(a, char, all);
    for (int j = 0; j < all; j++)
        p.row[j] = -1;
    for (int i = 0; i < rows; i++) {
        bring_in(&p, i);
        column[i] = -1;
    }
    for (int j = 0; j < columns; j++)
        if (p.row[j] >= 0) column[p.row[j]] = j;
}

void pairing_assign(int rows, int columns, const double *cost, double alone, int *column)
{
    struct arena *a = arena_open();
    solve(a, rows, columns, cost, alone, column);
    arena_close(a);
}

/* ------------------------------------------------------------------ two places */

struct entry {
    double f, d; /* logarithms */
    int index;
};

static int by_frequency(const void *a, const void *b)
{
    const struct entry *p = a, *q = b;
    if (p->f != q->f) return p->f < q->f ? -1 : 1;
    return (p->index > q->index) - (p->index < q->index);
}

static struct entry *sorted(struct arena *a, const struct pairing_list *l)
{
    struct entry *s = ARENA_TAKE(a, struct entry, l->n);
    for (int i = 0; i < l->n; i++)
        s[i] = (struct entry){real_log(l->frequency[i]), real_log(l->decay[i]), i};
    qsort(s, (size_t)l->n, sizeof *s, by_frequency);
    return s;
}

static double pair_cost(const struct entry *p, const struct entry *q, double g)
{
    double f = fabs(p->f - q->f), d = fabs(p->d - q->d);
    return f > g + 1e-12 ? HUGE_VAL : f + 1e-3 * g * d / (1.0 + d);
}

static void block(const struct entry *p, int rows, const struct entry *q, int columns, double g, int *column)
{
    struct arena *a = arena_open();
    double *cost = ARENA_TAKE(a, double, (size_t)rows *columns);
    int *partner = ARENA_TAKE(a, int, rows);
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < columns; j++)
            cost[(size_t)i * columns + j] = pair_cost(&p[i], &q[j], g);
    solve(a, rows, columns, cost, g + 1e-9, partner);
    for (int i = 0; i < rows; i++)
        column[p[i].index] = partner[i] < 0 ? -1 : q[partner[i]].index;
    arena_close(a);
}

void pairing_modes(const struct pairing_list *row, const struct pairing_list *other, double gate, int *column)
{
    struct arena *a = arena_open();
    const struct entry *p = sorted(a, row), *q = sorted(a, other);
    double g = real_log1p(gate), last = -HUGE_VAL;
    int i = 0, j = 0, i0 = 0, j0 = 0;
    while (i < row->n || j < other->n) {
        bool left = j == other->n || (i < row->n && p[i].f <= q[j].f);
        double f = left ? p[i].f : q[j].f;
        if (f - last > g + 1e-12) {
            block(p + i0, i - i0, q + j0, j - j0, g, column);
            i0 = i, j0 = j;
        }
        last = f;
        i += left;
        j += !left;
    }
    block(p + i0, i - i0, q + j0, j - j0, g, column);
    arena_close(a);
}

/* ------------------------------------------------------------------ from place to place */

struct follow {
    int places, n; /* n tracks so far */
    const double *xy;
    const struct pairing_list *list;
    int *const *track;
    bool *met;                 /* [places] */
    double *frequency, *decay; /* [all modes] what a track is on its way to the next place */
    double *nearest;           /* [all modes] m, from where */
    int *column;               /* [all modes] */
};

static double apart(const struct follow *f, int p, int q)
{
    double x = f->xy[2 * p] - f->xy[2 * q], y = f->xy[2 * p + 1] - f->xy[2 * q + 1];
    return sqrt(x * x + y * y);
}

/* Each track as it is at the place nearest to `place` that has it. */
static void gather(struct follow *f, int place)
{
    for (int t = 0; t < f->n; t++)
        f->nearest[t] = HUGE_VAL;
    for (int p = 0; p < f->places; p++) {
        double distance = apart(f, p, place);
        for (int i = 0; f->met[p] && i < f->list[p].n; i++) {
            int t = f->track[p][i];
            if (distance < f->nearest[t]) {
                f->nearest[t] = distance;
                f->frequency[t] = f->list[p].frequency[i];
                f->decay[t] = f->list[p].decay[i];
            }
        }
    }
}

static void meet(struct follow *f, int place, double gate)
{
    const struct pairing_list *here = &f->list[place];
    gather(f, place);
    pairing_modes(here, &(struct pairing_list){f->n, f->frequency, f->decay}, gate, f->column);
    for (int i = 0; i < here->n; i++)
        f->track[place][i] = f->column[i] < 0 ? f->n++ : f->column[i];
    f->met[place] = true;
}

/* The place not met that a shortest edge joins to one that is; -1: none is left. */
static int next(const struct follow *f, int edges, const int (*edge)[2])
{
    int best = -1;
    double least = HUGE_VAL;
    for (int k = 0; k < edges; k++) {
        int p = edge[k][0], q = edge[k][1];
        if (f->met[p] == f->met[q] || apart(f, p, q) >= least) continue;
        least = apart(f, p, q);
        best = f->met[p] ? q : p;
    }
    return best;
}

int pairing_tracks(const struct places *p, int places, const double *xy, const struct pairing_list *list, double gate,
                   int *const *track)
{
    struct arena *a = arena_open();
    const int(*edge)[2];
    int edges = places_edges(p, &edge), all = 0, place = 0;
    struct follow f = {.places = places, .xy = xy, .list = list, .track = track};
    for (int k = 0; k < places; k++) {
        all += list[k].n;
        place = list[k].n > list[place].n ? k : place;
    }
    f.met = ARENA_TAKE(a, bool, places);
    f.frequency = ARENA_TAKE(a, double, all);
    f.decay = ARENA_TAKE(a, double, all);
    f.nearest = ARENA_TAKE(a, double, all);
    f.column = ARENA_TAKE(a, int, all);
    for (; place >= 0; place = next(&f, edges, edge))
        meet(&f, place, gate);
    arena_close(a);
    return f.n;
}
