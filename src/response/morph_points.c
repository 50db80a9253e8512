/* See morph_points.h. */
#include "response/morph_points.h"

#include <math.h>
#include <string.h>

#include "num/real.h"
#include "response/morph.h"

#define NO_RATE 1e12 /* Hz */

static double size_of(const struct modes_point *p, int i)
{
    return sqrt(p->re[i] * p->re[i] + p->im[i] * p->im[i]);
}

static void shared(const struct morph_points_ask *ask, struct arena *a, struct morph *p)
{
    size_t all = (size_t)places_terms(p->places) * (size_t)p->rows * (size_t)p->n;
    p->re = ARENA_TAKE(a, double, all);
    p->im = ARENA_TAKE(a, double, all);
    for (int row = 0; row < p->rows; row++) {
        memcpy(p->re + (size_t)row * (size_t)p->n, ask->at[row].re, (size_t)p->n * sizeof *p->re);
        memcpy(p->im + (size_t)row * (size_t)p->n, ask->at[row].im, (size_t)p->n * sizeof *p->im);
    }
    morph_slopes(p);
}

/* The modes' own poles are those where they are largest. */
static void survey(const struct morph_points_ask *ask, struct modes *m, struct morph *p, int i)
{
    p->lowest[i] = HUGE_VAL;
    for (int row = 0; row < p->rows; row++) {
        const struct modes_point *at = &ask->at[row];
        double size = size_of(at, i);
        p->lowest[i] = fmin(p->lowest[i], at->frequency[i]);
        p->highest[i] = fmax(p->highest[i], at->frequency[i]);
        if (row > 0 && size <= p->largest[i])
            continue;
        p->largest[i] = size;
        m->frequency[i] = at->frequency[i];
        m->decay[i] = at->decay[i];
    }
}

static void separate(const struct morph_points_ask *ask, struct arena *a, struct modes *m, struct morph *p)
{
    double **rows[] = {&p->frequency, &p->decay, &p->gain, &p->phase, &p->there},
           **work[] = {&p->share, &p->amplitude, &p->torn, &p->size, &p->sine, &p->cosine};
    double **single[] = {&p->lowest, &p->highest, &p->largest};
    for (int c = 0; c < 5; c++)
        *rows[c] = ARENA_TAKE(a, double, (size_t)p->rows * (size_t)p->n);
    for (int c = 0; c < 6; c++)
        *work[c] = ARENA_TAKE(a, double, 4 * (size_t)p->n);
    for (int c = 0; c < 3; c++)
        *single[c] = ARENA_TAKE(a, double, p->n);
    p->high = ARENA_TAKE(a, int, p->n);
    for (int i = 0; i < p->n; i++) {
        survey(ask, m, p, i);
        for (int row = 0; row < p->rows; row++) {
            const struct modes_point *at = &ask->at[row];
            double size = size_of(at, i), phase = size > 0 ? real_atan2(at->im[i], at->re[i]) : 0;
            morph_put(p, m, row, i, (double[4]){at->frequency[i], at->decay[i], size, phase});
        }
    }
    morph_settle(p);
}

bool morph_points(const struct morph_points_ask *ask, struct arena *a, struct modes *m, struct err *e)
{
    struct morph *p = ARENA_TAKE(a, struct morph, 1);
    int bad;
    *p = (struct morph){.n = ask->n, .rows = ask->places, .rate = NO_RATE};
    *m = (struct modes){.n = ask->n,
                        .shared = ask->shared,
                        .moves = ask->places > 1,
                        .frequency = ARENA_TAKE(a, double, ask->n),
                        .decay = ARENA_TAKE(a, double, ask->n),
                        .self = p,
                        .at = ask->shared ? morph_shared : morph_separate};
    if (!places_make(a, ask->places, &ask->xy[0][0], &p->places, &bad, e))
        return false;
    m->places = p->places;
    if (ask->shared)
        shared(ask, a, p);
    else
        separate(ask, a, m, p);
    return true;
}
