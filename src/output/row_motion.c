/* Instants are read ROW_MOTION_SOME at a time: at the audio rate that takes a third of what one by one does. alpha is
 * that of the force without approach and release. */
#include "output/row_motion.h"

#include <math.h>

#include "scene/rules.h"
#include "surface/limiter.h"

static const enum column told[] = {TIME, X, Y, VX, VY, STROKE, SPEED, VELOCITY, ACCELERATION, NORMAL, ALPHA};

static double *asked(struct row_motion *m, enum column k) { return m->wanted[k] ? m->value[k] : NULL; }

static void row_motion_fill(struct row_motion *m, const struct stage_run *r, long row)
{
    double at[ROW_MOTION_SOME], *v[COLUMNS],
        start = (double)rules_first_frame(r->contact, r->board->rate) / r->board->rate;
    m->first = row;
    m->n = m->rows - row < ROW_MOTION_SOME ? m->rows - row : ROW_MOTION_SOME;
    for (int k = 0; k < COLUMNS; k++)
        v[k] = m->value[k];
    for (long i = 0; i < m->n; i++) {
        at[i] = (double)(row + i) / r->scene->output.diagnostics.rate;
        v[TIME][i] = start + at[i];
    }
    trajectory_at(r->board->trajectory, (size_t)m->n, at,
                  (struct trajectory_out){.u = v[STROKE],
                                          .du = v[VELOCITY],
                                          .ddu = asked(m, ACCELERATION),
                                          .x = asked(m, X),
                                          .y = asked(m, Y),
                                          .vx = asked(m, VX),
                                          .vy = asked(m, VY)});
    for (long i = 0; i < m->n; i++)
        v[SPEED][i] = fabs(v[VELOCITY][i]);
    double load[ROW_MOTION_SOME];
    if (!m->load || (!m->wanted[NORMAL] && !m->wanted[ALPHA])) return;
    load_along(m->load, r->board->trajectory, (size_t)m->n, at, load);
    for (long i = 0; i < m->n; i++) {
        load[i] = fmax(load[i], 0);
        m->value[NORMAL][i] = load[i] * load_lowered(m->load, at[i]);
        m->value[ALPHA][i] = m->alpha;
    }
    if (r->board->limiter && m->wanted[ALPHA]) limiter_alpha(r->board->limiter, (size_t)m->n, load, m->value[ALPHA]);
}

void row_motion_take(struct row_motion *m, const struct stage_run *r, long row, double value[COLUMNS])
{
    if (row >= m->first + m->n) row_motion_fill(m, r, row);
    for (size_t k = 0; k < sizeof told / sizeof told[0]; k++)
        value[told[k]] = m->value[told[k]][row - m->first];
}
