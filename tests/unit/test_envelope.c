/* envelope: against the plain maximum over every height there is, which must be the same number to the last bit and the same place, and
   the closed forms of a plane's and a spike's envelope. */
#include "surface/envelope.h"

#include <stdbool.h>

#include "unit.h"

static double plain(const double *z, long columns, long rows, long x, long y, double radius, double pitch, long at[2])
{
    double most = -HUGE_VAL;
    for (long j = 0; j < rows; j++)
        for (long i = 0; i < columns; i++) {
            double dx = (double)(i - x), dy = (double)(j - y), square = (dx * dx + dy * dy) * (pitch * pitch);
            double reached = square > radius * radius
                                 ? -HUGE_VAL
                                 : z[j * columns + i] - square / (radius + sqrt(radius * radius - square));
            if (reached > most) most = reached, at[0] = i, at[1] = j;
        }
    return most;
}

/* Heights of a piece, about which there are none. */
enum { WIDE = 83, FLAT = -1000 };

struct piece {
    long columns, rows;
    double *z;
};

static void piece_heights(void *self, long column, long row, double *z)
{
    const struct piece *p = self;
    for (long j = 0; j < ENVELOPE_HEIGHTS; j++)
        for (long i = 0; i < ENVELOPE_HEIGHTS; i++) {
            long x = column * ENVELOPE_HEIGHTS + i, y = row * ENVELOPE_HEIGHTS + j;
            bool in = x >= 0 && x < p->columns && y >= 0 && y < p->rows;
            z[j * ENVELOPE_HEIGHTS + i] = in ? p->z[y * p->columns + x] : FLAT;
        }
}

/* Roughness of three kinds: small noise, noise with rare spikes, and steps; balls from smaller than the pitch to larger
 * than the piece. */
static double rough(int kind)
{
    double noise = 1e-6 * (drand48() - 0.5);
    return kind == 0   ? noise
           : kind == 1 ? noise + (drand48() < 0.002 ? 5e-5 * drand48() : 0)
                       : 3e-5 * floor(3 * drand48());
}

enum { SQUARE = ENVELOPE_POINTS * ENVELOPE_POINTS };

static void check_piece(long rows, int kind, double radius, long finer)
{
    struct arena *a = arena_open();
    struct piece p = {WIDE, rows, ARENA_TAKE(a, double, WIDE *rows)};
    for (long i = 0; i < WIDE * rows; i++)
        p.z[i] = rough(kind);
    long reach = radius / 5e-6 < 2 * WIDE ? (long)ceil(radius / 5e-6) : 2 * WIDE;
    struct envelope *e = envelope_make(a, radius, 5e-6, reach, finer, piece_heights, &p);
    for (int k = 0; k < 4; k++) {
        double reached[SQUARE];
        long places[SQUARE][2], across = WIDE / finer / ENVELOPE_POINTS + 1, column = k % across,
                                row = (long)(drand48() * (double)rows) / finer / ENVELOPE_POINTS;
        envelope_square(e, column, row, reached, places);
        for (long i = k; i < SQUARE; i += 17) {
            long x = (column * ENVELOPE_POINTS + i % ENVELOPE_POINTS) * finer,
                 y = (row * ENVELOPE_POINTS + i / ENVELOPE_POINTS) * finer, first[2] = {-1, -1};
            if (x >= WIDE || y >= rows) continue;
            ck_assert(reached[i] == plain(p.z, WIDE, rows, x, y, radius, 5e-6, first));
            ck_assert(places[i][0] == first[0] && places[i][1] == first[1]);
        }
    }
    arena_close(a);
}

START_TEST(the_plain_maximum)
{
    static const double radii[] = {2e-6, 5e-6, 3e-5, 1e-4, 1e-3, 0.5};
    srand48(1);
    for (int kind = 0; kind < 3; kind++)
        for (int k = 0; k < 6; k++)
            for (long finer = 1; finer < 6; finer += 2) {
                check_piece(67, kind, radii[k], finer);
                check_piece(1, kind, radii[k], finer);
            }
}
END_TEST

/* Ground as high everywhere as the ball: every height bears it alike somewhere, no bound tells them apart, and lists are
   taken in pieces. */
START_TEST(as_hollow_as_the_ball)
{
    enum { SIDE = 161 };
    struct arena *a = arena_open();
    double radius = 4e-4;
    struct piece p = {WIDE, SIDE, ARENA_TAKE(a, double, WIDE *SIDE)};
    for (long i = 0; i < WIDE * SIDE; i++) {
        double x = (double)(i % WIDE - 40) * 5e-6, y = (double)(i / WIDE - 80) * 5e-6, square = x * x + y * y;
        p.z[i] = square < radius * radius ? square / (radius + sqrt(radius * radius - square)) : radius;
    }
    struct envelope *e = envelope_make(a, radius, 5e-6, 80, 1, piece_heights, &p);
    double reached[SQUARE];
    long places[SQUARE][2];
    envelope_square(e, 2, 5, reached, places);
    for (long i = 0; i < SQUARE; i++) {
        long first[2] = {-1, -1};
        ck_assert(reached[i] ==
                  plain(p.z, WIDE, SIDE, 32 + i % ENVELOPE_POINTS, 80 + i / ENVELOPE_POINTS, radius, 5e-6, first));
        ck_assert(places[i][0] == first[0] && places[i][1] == first[1]);
    }
    arena_close(a);
}
END_TEST

struct slope {
    double pitch, x, y;
};

static void slope_heights(void *self, long column, long row, double *z)
{
    const struct slope *s = self;
    for (long i = 0; i < ENVELOPE_HEIGHTS * ENVELOPE_HEIGHTS; i++)
        z[i] = s->pitch * (s->x * (double)(column * ENVELOPE_HEIGHTS + i % ENVELOPE_HEIGHTS) +
                           s->y * (double)(row * ENVELOPE_HEIGHTS + i / ENVELOPE_HEIGHTS));
}

/* On a slope s the ball touches R s / sqrt(1 + s^2) uphill, and its lowest point is R (sqrt(1 + s^2) - 1) above the
   slope; the lattice misses at most pitch^2/8 (1 + s^2)^(3/2) / R of it. */
START_TEST(a_slope)
{
    struct arena *a = arena_open();
    struct slope s = {2e-6, 0.2, -0.1};
    double radius = 4e-4, s2 = s.x * s.x + s.y * s.y, reached[SQUARE];
    long places[SQUARE][2];
    envelope_square(envelope_make(a, radius, s.pitch, 200, 1, slope_heights, &s), -3, 7, reached, places);
    for (long i = 0; i < SQUARE; i++) {
        double z = s.pitch * (s.x * (double)(i % ENVELOPE_POINTS - 3 * ENVELOPE_POINTS) +
                              s.y * (double)(i / ENVELOPE_POINTS + 7 * ENVELOPE_POINTS));
        double more = reached[i] - z - radius * (sqrt(1 + s2) - 1);
        ck_assert(more <= 1e-18 && more >= -2 * s.pitch * s.pitch / 8 * pow(1 + s2, 1.5) / radius);
    }
    arena_close(a);
}
END_TEST

static void spike_heights(void *self, long column, long row, double *z)
{
    (void)self;
    for (long i = 0; i < ENVELOPE_HEIGHTS * ENVELOPE_HEIGHTS; i++)
        z[i] =
            column * ENVELOPE_HEIGHTS + i % ENVELOPE_HEIGHTS == 10 && row * ENVELOPE_HEIGHTS + i / ENVELOPE_HEIGHTS == 5
                ? 2e-4
                : 0;
}

/* Around a spike the envelope is the ball itself, the sphere and not the paraboloid: at 0.9 R they are 0.16 R apart. */
START_TEST(a_spike_is_the_ball)
{
    struct arena *a = arena_open();
    double radius = 1e-4, pitch = 1e-6, reached[SQUARE];
    long places[SQUARE][2];
    struct envelope *e = envelope_make(a, radius, pitch, 100, 1, spike_heights, NULL);
    for (long row = -7; row <= 7; row++)
        for (long column = -7; column <= 7; column++) {
            envelope_square(e, column, row, reached, places);
            for (long i = 0; i < SQUARE; i++) {
                double x = (double)(column * ENVELOPE_POINTS + i % ENVELOPE_POINTS - 10),
                       y = (double)(row * ENVELOPE_POINTS + i / ENVELOPE_POINTS - 5),
                       d2 = (x * x + y * y) * pitch * pitch;
                double want =
                    d2 <= radius * radius * (1 + 1e-15) ? 2e-4 + sqrt(fmax(radius * radius - d2, 0)) - radius : 0;
                ck_assert_double_eq_tol(reached[i], want, 1e-17 + (fabs(d2 - radius * radius) < 1e-20 ? 1e-9 : 0));
            }
        }
    arena_close(a);
}
END_TEST

UNIT("envelope", the_plain_maximum, as_hollow_as_the_ball, a_slope, a_spike_is_the_ball)
