/* The judge is the defining sum y[n] = sum_m h_{x(m)}[n-m] f[m], O(N L), with the response of every sample's own place. */
#include "convolution/overlap_add.h"

enum { N = 9000, LENGTH = 2500, MODES = 30, ROOM = 40000, TOP = 200 };

#include "moving.h"

static void brute(const struct body *b, size_t length)
{
    double *h = calloc(length, sizeof *h);
    memset(judge, 0, sizeof judge);
    for (int m = 0; m < N; m++) {
        if (m == 0 || b->speed != 0)
            response(b, m, h, length);
        for (size_t k = 0; k < length; k++)
            judge[m + k] += h[k] * force[m];
    }
    free(h);
}

static void run(struct body *b, size_t length, int order, int hop, int cut)
{
    b->hop = hop;
    b->asked = 0;
    struct overlap_add *o = overlap_add_open(length, order, hop, at_node, b);
    long total = N + (long)length;
    ck_assert_int_le(total + overlap_add_ahead(o), N + ROOM);
    memset(sound, 0, sizeof sound);
    for (long at = 0, n = cut; at < total; at += n, n = cut > 0 ? cut : n % 700 + 37) {
        if (n <= 0)
            n = 1;
        overlap_add_run(o, force + at, sound + at, at + n < total ? n : total - at);
    }
    overlap_add_close(o);
}

/* Exact to the rounding of FFTs: -300 dB of the loudest; demanded: 1e-12 = -240 dB. */
START_TEST(at_rest_is_exact)
{
    static const size_t lengths[] = {1, 2, 1023, 1024, 1025, 2500, 5000};
    make();
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++) {
        struct body b = {.speed = 0};
        brute(&b, lengths[i]);
        run(&b, lengths[i], 0, 0, 777);
        printf("length %zu: %.0f dB\n", lengths[i], apart(lengths[i]));
        ck_assert_int_eq(b.asked, 1);
        ck_assert_double_lt(apart(lengths[i]), -240);
    }
}
END_TEST

START_TEST(order_1)
{
    converges(1, 256, 3, 6.02);
}
END_TEST

START_TEST(order_2)
{
    converges(2, 256, 3, 12.04);
}
END_TEST

START_TEST(order_4)
{
    converges(4, 128, 3, 24.08);
}
END_TEST

START_TEST(exact_cases)
{
    exact_at_every_sample();
    exact_at_rest(LENGTH);
}
END_TEST

START_TEST(cuts_do_not_matter)
{
    for (int order = 0; order <= 4; order += order ? order : 1)
        cuts_alike(order);
}
END_TEST

/* No force, no node; and what was in y stays. */
START_TEST(silence_costs_nothing)
{
    struct body b = {.speed = 0};
    make();
    memset(force, 0, sizeof force);
    force[5000] = 1;
    run(&b, LENGTH, 4, 100, 512);
    ck_assert_int_le(b.asked, 4);
    for (int i = 0; i < 4000; i++)
        ck_assert(sound[i] == 0.0);
    struct overlap_add *o = overlap_add_open(10, 2, 8, at_node, &b);
    double f[64] = {0}, y[16];
    for (int i = 0; i < 16; i++)
        y[i] = i;
    overlap_add_run(o, f, y, 16);
    for (int i = 0; i < 16; i++)
        ck_assert(y[i] == i);
    overlap_add_close(o);
}
END_TEST

UNIT("overlap_add", at_rest_is_exact, order_1, order_2, order_4, exact_cases, cuts_do_not_matter, silence_costs_nothing)
