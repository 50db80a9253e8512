/* envelope: against the plain maximum over every height there is, which must be the same number to the last bit and the same place, and
   the closed forms of a plane's and a spike's envelope. */
#include "surface/envelope.h"

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

enum { COLUMNS = 83, ROWS = 67 };

/* Roughness of three kinds: small noise, noise with rare spikes, and steps; balls from smaller than the pitch to larger
 * than the piece. */
static double rough(int kind)
{
    double noise = 1e-6 * (drand48() - 0.5);
    return kind == 0   ? noise
           : kind == 1 ? noise + (drand48() < 0.002 ? 5e-5 * drand48() : 0)
                       : 3e-5 * floor(3 * drand48());
}

static void check_piece(long columns, long rows, int kind, double radius)
{
    struct arena *a = arena_open();
    struct envelope *e = envelope_make(a, radius, 5e-6, columns, rows);
    long stride;
    double *held = envelope_heights(e, &stride), *z = ARENA_TAKE(a, double, columns *rows);
    for (int piece = 0; piece < 2; piece++) { /* the second one into the same memory */
        for (long i = 0; i < columns * rows; i++)
            held[i / columns * stride + i % columns] = z[i] = rough(kind);
        envelope_prepare(e);
        for (int k = 0; k < 400; k++) {
            long x = k < 200 ? k % columns : (long)(drand48() * (double)columns),
                 y = k < 200 ? k / 40 % rows : (long)(drand48() * (double)rows);
            long at[2], first[2] = {-1, -1};
            ck_assert(envelope_at(e, x, y, at) == plain(z, columns, rows, x, y, radius, 5e-6, first));
            ck_assert(at[0] == first[0] && at[1] == first[1]);
        }
    }
    arena_close(a);
}

START_TEST(the_plain_maximum)
{
    static const double radii[] = {2e-6, 5e-6, 3e-5, 1e-4, 1e-3, 0.5};
    srand48(1);
    for (int kind = 0; kind < 3; kind++)
        for (int k = 0; k < 6; k++) {
            check_piece(COLUMNS, ROWS, kind, radii[k]);
            check_piece(COLUMNS * 5, 1, kind, radii[k]);
            check_piece(1, 1, kind, radii[k]);
        }
}
END_TEST

/* On a slope s the ball touches R s / sqrt(1 + s^2) uphill, and its lowest point is R (sqrt(1 + s^2) - 1) above the
   slope; the lattice misses at most pitch^2/8 (1 + s^2)^(3/2) / R of it. */
START_TEST(a_slope)
{
    struct arena *a = arena_open();
    double radius = 4e-4, pitch = 2e-6, gx = 0.2, gy = -0.1, s2 = gx * gx + gy * gy;
    struct envelope *e = envelope_make(a, radius, pitch, 201, 201);
    long stride;
    double *z = envelope_heights(e, &stride);
    for (long j = 0; j < 201; j++)
        for (long i = 0; i < 201; i++)
            z[j * stride + i] = pitch * (gx * (double)i + gy * (double)j);
    envelope_prepare(e);
    for (long k = 90; k < 110; k++) {
        long at[2];
        double more = envelope_at(e, k, 100, at) - z[100 * stride + k] - radius * (sqrt(1 + s2) - 1);
        ck_assert(more <= 1e-18 && more >= -2 * pitch * pitch / 8 * pow(1 + s2, 1.5) / radius);
    }
    arena_close(a);
}
END_TEST

/* Around a spike the envelope is the ball itself, the sphere and not the paraboloid: at 0.9 R they are 0.16 R apart. */
START_TEST(a_spike_is_the_ball)
{
    struct arena *a = arena_open();
    double radius = 1e-4, pitch = 1e-6;
    struct envelope *e = envelope_make(a, radius, pitch, 301, 301);
    long stride;
    double *z = envelope_heights(e, &stride);
    for (long i = 0; i < 301 * 301; i++)
        z[i / 301 * stride + i % 301] = i == 150 * 301 + 150 ? 2e-4 : 0;
    envelope_prepare(e);
    for (long j = 0; j < 301; j += 3)
        for (long i = 0; i < 301; i += 3) {
            long at[2];
            double d2 = ((double)((i - 150) * (i - 150)) + (double)((j - 150) * (j - 150))) * pitch * pitch;
            double want = d2 <= radius * radius * (1 + 1e-15) ? 2e-4 + sqrt(fmax(radius * radius - d2, 0)) - radius : 0;
            ck_assert_double_eq_tol(envelope_at(e, i, j, at), want,
                                    1e-17 + (fabs(d2 - radius * radius) < 1e-20 ? 1e-9 : 0));
        }
    arena_close(a);
}
END_TEST

UNIT("envelope", the_plain_maximum, a_slope, a_spike_is_the_ball)
