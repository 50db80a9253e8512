/* How many nodes a straight motion over a response needs: convolution/nodes.h, mode by mode and piece by piece between the kinks that the
   interpolation of places has. */
#include "convolution/ring_nodes.h"

#include <math.h>
#include <string.h>

#include "convolution/nodes.h"
#include "num/real.h"

enum { MOST_KINKS = 4096, LOOKS = 9 };

static void place_at(const struct trajectory *tr, double u, double place[2])
{
    place[0] = tr->from[0] + u * tr->e[0];
    place[1] = tr->from[1] + u * tr->e[1];
}

static void look(const struct modes *m, const struct trajectory *tr, double u, const struct modes_point *p)
{
    double place[2];
    place_at(tr, u, place);
    memcpy(p->frequency, m->frequency, (size_t)m->n * sizeof *m->frequency);
    memcpy(p->decay, m->decay, (size_t)m->n * sizeof *m->decay);
    modes_at(m, &(struct modes_where){place[0], place[1], 0}, p);
}

struct range {
    double low, high;
};

static void widen(struct range *r, double x)
{
    r->low = fmin(r->low, x);
    r->high = fmax(r->high, x);
}

/* Where logarithms go as curves (across the cells of a grid as parabolas, else as splines) the whole piece counts as steep as its steepest part. */
static double steepest(const struct modes_point *at, int i)
{
    double most = 0;
    for (int k = 1; k < LOOKS; k++)
        most = fmax(most, fabs(at[k].frequency[i] - at[k - 1].frequency[i]));
    return 2 * REAL_PI * (LOOKS - 1) * most;
}

/* rad by which the gain of mode i turns from one look to the next. */
static double turn(const struct modes_point *p, const struct modes_point *q, int i)
{
    double lean = p->re[i] * q->re[i] + p->im[i] * q->im[i], across = p->re[i] * q->im[i] - p->im[i] * q->re[i];
    return lean == 0 && across == 0 ? 0 : fabs(real_atan2(across, lean));
}

/* Nodes that mode i needs, seen at LOOKS places of the piece, between which gains are interpolated in the logarithm and turn evenly. */
static int mode_needs(const struct ring_nodes_ask *ask, const struct modes_point *at, int i)
{
    struct range pole = {HUGE_VAL, -HUGE_VAL}, gain = {HUGE_VAL, -HUGE_VAL}, decay = {HUGE_VAL, -HUGE_VAL};
    for (int k = 0; k < LOOKS; k++) {
        double square = at[k].re[i] * at[k].re[i] + at[k].im[i] * at[k].im[i];
        widen(&pole, 2 * REAL_PI * at[k].frequency[i]);
        widen(&decay, at[k].decay[i]);
        if (square > 0)
            widen(&gain, 0.5 * real_log(square));
    }
    double turned = 0, change = gain.high > gain.low ? gain.high - gain.low : 0;
    for (int k = 1; k < LOOKS; k++)
        turned += turn(&at[k - 1], &at[k], i);
    double turns = ask->modes->curved ? steepest(at, i) : pole.high - pole.low;
    return nodes_needed(
        &(struct nodes_ask){
            0.5 * turns, {decay.low, decay.high}, ask->seconds, sqrt(change * change + turned * turned)},
        ask->error);
}

static int piece_needs(const struct ring_nodes_ask *ask, const double u[2], struct modes_point *at)
{
    int most = 2;
    for (int k = 0; k < LOOKS; k++)
        look(ask->modes, ask->trajectory, u[0] + (u[1] - u[0]) * k / (LOOKS - 1), &at[k]);
    for (int i = 0; i < ask->modes->n; i++) {
        int needs = mode_needs(ask, at, i);
        most = needs > most ? needs : most;
    }
    return most;
}

bool ring_nodes(const struct ring_nodes_ask *ask, struct arena *a, struct ring_nodes *n)
{
    const struct modes *m = ask->modes;
    const struct trajectory *tr = ask->trajectory;
    double from[2], to[2], reach = tr->reach[1] - tr->reach[0];
    struct modes_point at[LOOKS];
    bool enough = true;
    *n = (struct ring_nodes){.breaks = ARENA_TAKE(a, double, MOST_KINKS + 2), .count = ARENA_TAKE(a, int, MOST_KINKS + 1), .n = 1};
    place_at(tr, tr->reach[0], from);
    place_at(tr, tr->reach[1], to);
    if (m->kinks)
        n->pieces = m->kinks(m, from, to, n->breaks + 1, MOST_KINKS);
    for (int k = 1; k <= n->pieces; k++)
        n->breaks[k] = tr->reach[0] + n->breaks[k] * reach;
    n->breaks[0] = tr->reach[0];
    n->breaks[++n->pieces] = tr->reach[1];
    for (int k = 0; k < LOOKS; k++)
        at[k] = modes_point_make(a, m->n);
    for (int k = 0; k < n->pieces; k++) {
        n->count[k] = piece_needs(ask, n->breaks + k, at);
        enough = enough && n->count[k] < NODES_MOST;
        n->n += n->count[k] - 1;
    }
    return enough;
}
