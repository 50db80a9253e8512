/* ringing: nothing comes from noise. */
#include "ringing_found.h"

/* White, and coloured by a one-pole filter (26 dB from bottom to top). */
START_TEST(test_noise)
{
    enum { N = 600 };
    for (unsigned long seed = 1; seed <= 30; seed++) {
        struct arena *a = arena_open();
        struct ringing_modes m;
        double h[N] = {0}, y[N];
        gsl_rng *g = generator(seed);
        series_noise(g, 1, N, h);
        for (int i = 0; i < N; i++)
            y[i] = h[i] + (i > 0 ? (seed % 2 ? 0.9 : 0) * y[i - 1] : 0);
        find((const double *const[]){y}, 1, N, a, &m);
        ck_assert_msg(m.n == 0, "seed %lu: %d, %g Hz, %g 1/s", seed, m.n, m.mode[0].frequency, m.mode[0].decay);
        gsl_rng_free(g);
        arena_close(a);
    }
}
END_TEST

UNIT("ringing_noise", test_noise)
