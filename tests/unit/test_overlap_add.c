/* The judge is the defining double sum y[n] = sum_k sum_m h_k[n - m] w_k[m] f[m]. */
#include "unit.h"

#include "convolution/overlap_add.h"

enum { KEYS = 5, N = 21000, LENGTH = 9000, ROOM = N + LENGTH + 8192 };

static double force[ROOM], sound[ROOM], judge[ROOM], share[KEYS][ROOM], h[KEYS][LENGTH];
static int asked[KEYS], shares_asked;
static size_t length;

static double draw(void)
{
    static unsigned long long seed = 9;
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(seed >> 11) * 0x1p-52 - 1;
}

static void response(void *self, long k, double *to, size_t n)
{
    (void)self;
    ck_assert_uint_eq(n, length);
    asked[k]++;
    memcpy(to, h[k], n * sizeof *to);
}

static int share_of(void *self, long first, int n, int k, double *w)
{
    int any = 0;
    (void)self;
    shares_asked++;
    ck_assert_int_le(n, OVERLAP_ADD_BLOCK);
    for (int i = 0; i < n; i++) {
        w[i] = first + i < ROOM ? share[k][first + i] : 0;
        any |= w[i] != 0;
    }
    if (!any)
        for (int i = 0; i < n; i++)
            w[i] = NAN; /* must not be read */
    return any;
}

/* Linear shares along the keys and back, signed noise in the last one from half-way on, one that never has a share. */
static void make(size_t l)
{
    length = l;
    memset(force, 0, sizeof force);
    memset(asked, 0, sizeof asked);
    shares_asked = 0;
    for (int n = 0; n < N; n++)
        force[n] = draw();
    for (int k = 0; k < KEYS; k++) {
        for (int n = 0; n < ROOM; n++) {
            double at = 1.5 - 1.5 * cos(2 * M_PI * n / N), away = fabs(at - k);
            share[k][n] = k == 4 ? 0 : away < 1 ? 1 - away : 0;
        }
        for (size_t i = 0; i < LENGTH; i++)
            h[k][i] = draw() * exp(-4.0 * (double)i / LENGTH);
    }
    for (int n = 3000; n < N; n++)
        share[2][n] += 0.3 * draw();
}

static void brute(void)
{
    memset(judge, 0, sizeof judge);
    for (int k = 0; k < KEYS; k++)
        for (int m = 0; m < N; m++) {
            double f = share[k][m] * force[m];
            for (size_t i = 0; f != 0 && i < length; i++)
                judge[(size_t)m + i] += h[k][i] * f;
        }
}

static void run(int cut)
{
    struct overlap_add *p = overlap_add_open(
        &(struct overlap_add_source){.n = KEYS, .length = length, .share = share_of, .response = response});
    long total = N + (long)length;
    ck_assert_int_le(total + OVERLAP_ADD_BLOCK - 1, ROOM);
    memset(sound, 0, sizeof sound);
    for (long at = 0, n = cut; at<total; at += n, n = cut> 0 ? cut : n % 700 + 37)
        overlap_add_run(p, force + at, sound + at, at + n < total ? n : total - at);
    overlap_add_close(p);
}

static double apart(void)
{
    double d = 0, s = 0;
    for (size_t i = 0; i < N + length; i++) {
        d += (sound[i] - judge[i]) * (sound[i] - judge[i]);
        s += judge[i] * judge[i];
    }
    return 10 * log10(d / s + 1e-40);
}

/* Exact to the rounding of FFTs, about -300 dB; demanded: 1e-13. */
START_TEST(exact)
{
    static const size_t lengths[] = {1, 2, 4095, 4096, 4097, LENGTH};
    for (int i = 0; i < 6; i++) {
        make(lengths[i]);
        brute();
        run(777);
        printf("length %zu: %.0f dB\n", lengths[i], apart());
        ck_assert_double_lt(apart(), -260);
    }
}
END_TEST

START_TEST(cuts_do_not_matter)
{
    static double whole[ROOM];
    static const int cuts[] = {1, 0, 4096, 5000};
    make(LENGTH);
    run(N + LENGTH);
    memcpy(whole, sound, sizeof whole);
    for (int i = 0; i < 4; i++) {
        run(cuts[i] ? cuts[i] : 64);
        ck_assert(memcmp(whole, sound, sizeof whole) == 0);
    }
}
END_TEST

/* A response without a share is never asked for, the others once; no force, no question; what was in y stays. */
START_TEST(silence_costs_nothing)
{
    make(LENGTH);
    run(512);
    for (int k = 0; k < KEYS; k++)
        ck_assert_int_eq(asked[k], k != 4);
    make(LENGTH);
    memset(force, 0, sizeof force);
    force[9000] = 1;
    run(512);
    ck_assert_int_eq(shares_asked, KEYS);
    for (int i = 0; i < 8192; i++)
        ck_assert(sound[i] == 0.0);
    struct overlap_add *p =
        overlap_add_open(&(struct overlap_add_source){.n = 1, .length = 3, .share = share_of, .response = response});
    double f[OVERLAP_ADD_BLOCK + 16] = {0}, y[16];
    for (int i = 0; i < 16; i++)
        y[i] = i;
    overlap_add_run(p, f, y, 16);
    for (int i = 0; i < 16; i++)
        ck_assert(y[i] == i);
    overlap_add_close(p);
}
END_TEST

/* One response that gets all of the force. */
START_TEST(alone)
{
    static const size_t lengths[] = {1, 2, 4095, 4096, 4097, LENGTH};
    for (int i = 0; i < 6; i++) {
        make(lengths[i]);
        memset(judge, 0, sizeof judge);
        memset(sound, 0, sizeof sound);
        for (int m = 0; m < N; m++)
            for (size_t k = 0; k < length; k++)
                judge[(size_t)m + k] += h[0][k] * force[m];
        struct overlap_add *o =
            overlap_add_open(&(struct overlap_add_source){.n = 1, .length = length, .response = response});
        overlap_add_run(o, force, sound, N + (long)length);
        overlap_add_close(o);
        ck_assert_int_eq(asked[0], 1);
        ck_assert_double_lt(apart(), -260);
    }
}
END_TEST

UNIT("overlap_add", exact, alone, cuts_do_not_matter, silence_costs_nothing)
