/* The judge is the defining sum y[n] = sum_m h_{x(n)}[n - m] f[m], O(N L), with the response of every sound sample's own place. */
#include "convolution/readout.h"

enum { N = 6000, LENGTH = 1600, MODES = 12, ROOM = 20000, TOP = 150 };

#include "moving.h"

static void brute(const struct body *b, size_t length)
{
    double *h = calloc(length, sizeof *h);
    memset(judge, 0, sizeof judge);
    for (size_t n = 0; n < N + length; n++) {
        if (n == 0 || b->speed != 0)
            response(b, (double)n, h, length);
        for (size_t k = 0; k < length && k <= n; k++)
            judge[n] += h[k] * force[n - k];
    }
    free(h);
}

static void run(struct body *b, size_t length, int order, int hop, int cut)
{
    b->hop = hop;
    b->asked = 0;
    struct readout *r = readout_open(length, order, hop, at_node, b);
    long total = N + (long)length;
    ck_assert_int_eq(readout_ahead(r), order * hop - 1);
    memset(sound, 0, sizeof sound);
    for (long at = 0, n = cut; at < total; at += n, n = cut > 0 ? cut : n % 700 + 37)
        readout_run(r, force + at, sound + at, at + n < total ? n : total - at);
    readout_close(r);
}

START_TEST(order_1)
{
    converges(1, 128, 3, 6.02);
}
END_TEST

START_TEST(order_2)
{
    converges(2, 128, 3, 12.04);
}
END_TEST

START_TEST(order_4)
{
    converges(4, 64, 3, 24.08);
}
END_TEST

START_TEST(exact_cases)
{
    static const size_t lengths[] = {1, 2, 3, LENGTH};
    exact_at_every_sample();
    for (int i = 0; i < 4; i++)
        exact_at_rest(lengths[i]);
}
END_TEST

/* overlap_add at rest and a readout whose response does not move are the same convolution. */
START_TEST(as_overlap_add_at_rest)
{
    struct body b = {.speed = 0};
    make();
    struct overlap_add *o = overlap_add_open(LENGTH, 0, 0, at_node, &b);
    memset(judge, 0, sizeof judge);
    overlap_add_run(o, force, judge, N + LENGTH);
    overlap_add_close(o);
    for (int order = 1; order <= 4; order += order) {
        run(&b, LENGTH, order, 300, 1000);
        ck_assert_double_lt(apart(LENGTH), -240);
    }
}
END_TEST

START_TEST(cuts_do_not_matter)
{
    for (int order = 1; order <= 4; order += order)
        cuts_alike(order);
}
END_TEST

/* Nodes that no force reaches are not asked for; and what was in y stays. */
START_TEST(silence_costs_nothing)
{
    struct body b = {.speed = 0};
    make();
    memset(force, 0, sizeof force);
    force[3500] = 1;
    run(&b, LENGTH, 4, 100, 512);
    ck_assert_int_le(b.asked, LENGTH / 100 + 5);
    ck_assert_int_ge(b.asked, LENGTH / 100);
    for (int i = 0; i < 3000; i++)
        ck_assert(sound[i] == 0.0);
    double f[64] = {0}, y[16];
    struct readout *r = readout_open(10, 2, 8, at_node, &b);
    for (int i = 0; i < 16; i++)
        y[i] = i;
    readout_run(r, f, y, 16);
    for (int i = 0; i < 16; i++)
        ck_assert(y[i] == i);
    readout_close(r);
}
END_TEST

UNIT("readout", order_1, order_2, order_4, exact_cases, as_overlap_add_at_rest, cuts_do_not_matter, silence_costs_nothing)
