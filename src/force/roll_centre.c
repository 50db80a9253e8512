/* The way of a rolling ball's centre: the parts of papers/000 equation 16, rho = R - r cos(x/R) + S.

     S      height of the limited trajectory over the ball's rolling curve, m (force/slope.c, surface/tip.c), here less the level that the limiter gives it
     rise   -r cos(theta), m: height of the centre of mass over the geometric centre (trajectory/spin.h)
     bulge  of a ball that is not quite round, m: how much further from the centre the rim is where it touches; not in the paper

   S is what the ground does, in micrometres and many times in each millimetre. rise and bulge are slow, once or a few times in each turn: the ball follows them
   and stays on the ground, so that they are no part of what the surface meets, and act through the normal force (force/roll.c).

   Departures. The paper writes x/R for theta in equations 16 and 17, and equation 18 for theta itself: theta is solved
   from that, and only rho under penetration: paper has cos(x/R) as it is printed, x being that of equation 18, counted
   from where the centre of mass is lowest. Its place x is that of the centre of mass; the point that touches is r
   sin(theta) away, and S is read at x all the same, as equation 16 has it. */
#include "force/roll_centre.h"

#include <string.h>

struct roll_centre roll_centre_make(const struct contact *c)
{
    return (struct roll_centre){.spin = spin_make(c), .round = c->ball.offset == 0 && c->ball.lobe_height == 0,
                                .printed = c->contact.roll.penetration == PENETRATION_PAPER};
}

void roll_centre_follow(struct roll_centre *m, const struct slope *s, int n)
{
    m->at[0] = m->height;
    memcpy(m->at + 1, s->heights, (size_t)n * sizeof *m->at);
    m->height = m->at[n];
    for (int k = 0; k < SLOPE_LEVELS; k++) {
        m->lifts[k][0] = m->lift[k];
        memcpy(m->lifts[k] + 1, s->lifts[k], (size_t)n * sizeof *m->lifts[k]);
        m->lift[k] = m->lifts[k][n];
    }
}

void roll_centre_run(struct roll_centre *m, const struct slope *s, const struct board *b, long first, int n)
{
    double bulge[WAY_CHUNK + 1];
    roll_centre_follow(m, s, n);
    if (m->round)
        return;
    spin_at(&m->spin, (size_t)n + 1, way_values(b, ITEM_POSITION, first), way_values(b, ITEM_VELOCITY, first), NULL,
            &(struct spin_out){.rise = m->rise, .printed = m->printed ? m->in_rho : NULL, .bulge = bulge});
    for (int i = 0; i <= n; i++) {
        m->rise[i] += bulge[i];
        m->in_rho[i] += m->printed ? bulge[i] : 0;
    }
}

void roll_centre_level(double *at, long n, double *const lifts[SLOPE_LEVELS], const double level[SLOPE_LEVELS])
{
    for (long i = 0; i < n; i++)
        at[i] -= level[0] * lifts[0][i] + level[1] * lifts[1][i];
}
