/* See ring_along.h. Where the motion rests at its end, as strokes do, it is taken to come back as it went: x ~ t^2 goes on without a kink. A gain that is nearly zero at the end, or turns by more than a quarter of a turn, has no logarithm to go on in: it goes on straight. */
#include "convolution/ring_along.h"

#include <math.h>
#include <string.h>

#include "scene/ablation.h"

struct ring_along ring_along_make(const struct modes *m, const struct trajectory *tr, bool stays, struct arena *a)
{
    return (struct ring_along){m, tr, stays, modes_point_make(a, m->n)};
}

struct modes_where ring_along_where(const struct trajectory *tr, double t)
{
    double place[2];
    trajectory_continued(tr, t, place);
    return (struct modes_where){place[0], place[1], tr->duration > 0 ? t / tr->duration : 0};
}

struct modes_where ring_along_first(const struct contact *c, const struct trajectory *tr)
{
    const double *place = c->ablation.place;
    return ablation_one_place(c) && !isnan(place[0]) ? (struct modes_where){place[0], place[1], 0} : ring_along_where(tr, 0);
}

/* The power of two at the larger of two gains: in such units they can be squared and multiplied, whatever their size, with the same bits as in any other. */
static double unit_of(const struct modes_point *p, const struct modes_point *q, int i)
{
    double most = fmax(fmax(fabs(p->re[i]), fabs(p->im[i])), fmax(fabs(q->re[i]), fabs(q->im[i])));
    int exponent = 0;
    frexp(most, &exponent);
    return exponent > -1000 && exponent < 1000 ? ldexp(1, exponent) : 1;
}

void ring_along_mirror(int n, const struct modes_point *end, const struct modes_point *p)
{
    for (int i = 0; i < n; i++) {
        double unit = unit_of(end, p, i), per = 1 / unit;
        double re = end->re[i] * per, im = end->im[i] * per, x = p->re[i] * per, y = p->im[i] * per, square = x * x + y * y, to = re * re + im * im;
        double lean = re * x + im * y, turn = im * x - re * y; /* end / p = (lean + j turn) / square */
        bool steady = square > 1e-6 * to && lean > 0;
        p->re[i] = unit * (steady ? (re * lean - im * turn) / square : 2 * re - x);
        p->im[i] = unit * (steady ? (re * turn + im * lean) / square : 2 * im - y);
        if (p->frequency) {
            p->frequency[i] = p->frequency[i] > 0 ? end->frequency[i] * end->frequency[i] / p->frequency[i] : 0;
            p->decay[i] = p->decay[i] > 0 ? end->decay[i] * end->decay[i] / p->decay[i] : 0;
        }
    }
}

bool ring_along_returns(const struct modes *m, const struct trajectory *tr, double t)
{
    return !m->travels && (t < 0 ? tr->starts_at_rest : tr->ends_at_rest);
}

static void inside_at(const struct ring_along *g, double t, const struct modes_point *p)
{
    const struct modes *m = g->modes;
    struct modes_where where = ring_along_where(g->trajectory, t);
    if (m->shared) {
        memcpy(p->frequency, m->frequency, (size_t)m->n * sizeof *p->frequency);
        memcpy(p->decay, m->decay, (size_t)m->n * sizeof *p->decay);
    }
    modes_at(m, &where, p);
}

void ring_along_at(const struct ring_along *g, double t, const struct modes_point *p)
{
    double last = g->trajectory->duration, end = t < 0 ? 0 : last;
    if (g->stays || (t >= 0 && t <= last)) {
        inside_at(g, fmin(fmax(t, 0), last), p);
        return;
    }
    inside_at(g, fmin(fmax(2 * end - t, 0), last), p);
    if (ring_along_returns(g->modes, g->trajectory, t))
        return;
    inside_at(g, end, &g->end);
    ring_along_mirror(g->modes->n, &g->end, p);
}
