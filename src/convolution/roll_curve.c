/* See roll_curve.h. */
#include "convolution/roll_curve.h"

#include <math.h>

#include "surface/relief.h"
#include "trajectory/trajectory.h"

enum { STRETCHES = 16 };

void roll_curve_make(struct roll_curve *c, const struct stage_run *r, long room)
{
    double **all[] = {&c->t, &c->s, &c->u, &c->du, &c->x, &c->y, &c->rise, &c->bulge};
    *c = (struct roll_curve){.board = r->board,
                             .spin = spin_make(r->contact),
                             .turns = r->contact->ball.offset != 0 || r->contact->ball.lobe_height != 0};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++)
        *all[k] = ARENA_TAKE(r->arena, double, room);
}

void roll_curve_read(const struct roll_curve *c, size_t n)
{
    const struct relief *z = c->board->relief;
    bool path = z->along == ALONG_PATH, plane = z->along == ALONG_PLANE;
    trajectory_at(c->board->trajectory, n, c->t,
                  (struct trajectory_out){.u = c->u, .du = c->du, .x = path ? NULL : c->x, .y = plane ? c->y : NULL});
    relief_at(z, &(struct relief_points){n, path ? c->u : c->x, plane ? c->y : NULL},
              &(struct relief_values){.z = c->s});
    if (!c->turns) return;
    spin_at(&c->spin, n, c->u, c->du, NULL, &(struct spin_out){.rise = c->rise, .bulge = c->bulge});
    for (size_t i = 0; i < n; i++)
        c->s[i] += c->bulge[i] + c->rise[i];
}

double roll_curve_fastest(const struct roll_curve *c)
{
    const struct board *b = c->board;
    double dt = 1 / (b->rate * b->over), room = b->trajectory->duration - dt * (ROLL_CURVE_LEAST - 1), fastest = 0;
    for (int k = 0; k < STRETCHES && (k == 0 || room > 0); k++) {
        for (int i = 0; i < ROLL_CURVE_LEAST; i++)
            c->t[i] = fmax(room, 0) * k / (STRETCHES - 1) + i * dt;
        roll_curve_read(c, ROLL_CURVE_LEAST);
        for (int i = 1; i < ROLL_CURVE_LEAST; i++)
            fastest = fmax(fastest, fabs(c->s[i] - c->s[i - 1]) / dt);
    }
    return fastest;
}
