/* See morph_points.h. */
#include "response/morph_points.h"

#include "response/morph.h"

#define NO_RATE 1e12 /* Hz */

/* Separate poles: the modes' own are those of the first place. */
static void fill(const struct morph_points_ask *ask, struct arena *a, struct modes *m, struct morph *p)
{
    double **single[] = {&p->lowest, &p->highest};
    for (int c = 0; c < 2; c++)
        *single[c] = ARENA_TAKE(a, double, p->n); /* 0: nothing fades */
    morph_begin(p, ask->shared, a);
    for (int i = 0; i < p->n && !ask->shared; i++) {
        m->frequency[i] = ask->at[0].frequency[i];
        m->decay[i] = ask->at[0].decay[i];
    }
    for (int row = 0; row < p->rows; row++)
        for (int i = 0; i < p->n; i++) {
            const struct modes_point *at = &ask->at[row];
            morph_set(p, m, row, i, &(struct morph_pole){at->frequency[i], at->decay[i], at->re[i], at->im[i]});
        }
    morph_slopes(p);
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
                        .at = morph_complex};
    if (!places_make(a, ask->places, &ask->xy[0][0], &p->places, &bad, e)) return false;
    m->places = p->places;
    fill(ask, a, m, p);
    return true;
}
