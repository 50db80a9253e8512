/* The unit disc as a square of m x m cells, its sides bulged, and four rings of cells between its sides and the circle.
 */
#ifndef FEM_SHAPES_DISC_H
#define FEM_SHAPES_DISC_H

/* Of the square: a, b in [-1, 1]. */
void shapes_disc_core(double a, double b, double p[2]);

/* Beside side 0 to 3 (+x, +y, -x, -y): along it from -1 to 1 counterclockwise, out from 0 (the square) to 1 (the
 * circle, at the angle given, degrees). */
void shapes_disc_ring(int side, double along, double out, double angle, double p[2]);

/* (cos, sin) of degrees, exact at multiples of 90. */
void shapes_disc_turn(double degrees, double p[2]);

#endif
