/* See shapes_disc.h. The bulge is a share of the smooth map of the square onto the disc, x sqrt(1 - y^2/2): the
 * square's corners then keep clear angles. */
#include "fem/shapes_disc.h"

#include <math.h>

#include "num/real.h"

static const double inner = 0.5, bulge = 0.5; /* half side, of the radius; share of the disc in the square */

void shapes_disc_core(double a, double b, double p[2])
{
    p[0] = inner * a * (1 - bulge + bulge * sqrt(1 - b * b / 2));
    p[1] = inner * b * (1 - bulge + bulge * sqrt(1 - a * a / 2));
}

void shapes_disc_turn(double degrees, double p[2])
{
    double turn = degrees / 180;
    turn -= 2 * floor(turn / 2);
    p[0] = real_cospi(turn);
    p[1] = real_sinpi(turn);
}

void shapes_disc_ring(int side, double along, double out, double angle, double p[2])
{
    static const double corner[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    double core[2], circle[2];
    const double *n = corner[side % 4];
    shapes_disc_core(n[0] - n[1] * along, n[1] + n[0] * along, core);
    shapes_disc_turn(angle, circle);
    for (int i = 0; i < 2; i++)
        p[i] = (1 - out) * core[i] + out * circle[i];
}
