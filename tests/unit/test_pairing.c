/* pairing: the assignment against every assignment there is; modes that sorting by frequency pairs wrongly; tracks over
 * several places. */
#include "response/morph.h"

#include "unit.h"

static double least(int rows, int columns, const double *cost, double alone, int row, unsigned taken, int pairs)
{
    if (row == rows) return alone * (rows + columns - 2 * pairs);
    double best = least(rows, columns, cost, alone, row + 1, taken, pairs);
    for (int j = 0; j < columns; j++)
        if (!(taken >> j & 1) && cost[row * columns + j] < HUGE_VAL)
            best = fmin(best, cost[row * columns + j] +
                                  least(rows, columns, cost, alone, row + 1, taken | 1u << j, pairs + 1));
    return best;
}

/* Random problems up to 7 x 7, also with forbidden pairs and small whole costs (many ties): the sum is the least of
 * all. */
START_TEST(assignment_is_optimal)
{
    srand48(3);
    int paired = 0;
    for (int trial = 0; trial < 600; trial++) {
        int rows = (int)(8 * drand48()), columns = (int)(8 * drand48()), column[7];
        double cost[49], alone = 0.2 + drand48(), sum = 0;
        for (int i = 0; i < rows * columns; i++)
            cost[i] = drand48() < 0.25 ? HUGE_VAL : trial % 3 ? drand48() * (trial % 2 ? 1 : 3) : floor(4 * drand48());
        morph_assign(rows, columns, cost, alone, column);
        unsigned taken = 0;
        int pairs = 0;
        for (int i = 0; i < rows; i++)
            if (column[i] >= 0) {
                ck_assert(column[i] < columns && !(taken >> column[i] & 1));
                taken |= 1u << column[i];
                sum += cost[i * columns + column[i]];
                pairs++;
            }
        sum += alone * (rows + columns - 2 * pairs);
        ck_assert_double_eq_tol(sum, least(rows, columns, cost, alone, 0, 0, 0), 1e-12);
        paired += pairs;
    }
    ck_assert_int_gt(paired, 1000);
}
END_TEST

/* Large and dense, against the known answer: a shuffled copy, a little moved. */
START_TEST(large_assignment)
{
    enum { N = 300 };
    static double f[N], d[N], g[N], h[N];
    int column[N], where[N];
    srand48(4);
    for (int i = 0; i < N; i++) {
        f[i] = 100 * exp(0.01 * i);
        d[i] = 10 + drand48();
        where[i] = i;
    }
    for (int i = N - 1; i > 0; i--) {
        int k = (int)((i + 1) * drand48()), swap = where[i];
        where[i] = where[k], where[k] = swap;
    }
    for (int i = 0; i < N; i++) {
        g[i] = f[where[i]] * (1 + 0.004 * (drand48() - 0.5));
        h[i] = d[where[i]];
    }
    morph_pair(&(struct morph_list){N, g, h}, &(struct morph_list){N, f, d}, 0.03, column);
    for (int i = 0; i < N; i++)
        ck_assert_int_eq(column[i], where[i]);
}
END_TEST

/* One mode is missing at the second place: pairing the sorted frequencies by rank would pair all above it wrongly. */
START_TEST(a_missing_mode_shifts_nothing)
{
    static const double f[6] = {100, 210, 340, 345, 480, 700}, d[6] = {5, 5, 5, 5, 5, 5},
                        g[5] = {101, 339, 346, 478, 702};
    int column[5], wrong = 0, expect[5] = {0, 2, 3, 4, 5};
    morph_pair(&(struct morph_list){5, g, d}, &(struct morph_list){6, f, d}, 0.03, column);
    for (int i = 0; i < 5; i++) {
        ck_assert_int_eq(column[i], expect[i]);
        wrong += i != expect[i];
    }
    ck_assert_int_eq(wrong, 4); /* what sorting would have got wrong */
}
END_TEST

/* The gate is a relative difference of frequencies; what lies beyond it stays alone. */
START_TEST(the_gate)
{
    double f = 1000, d = 1, inside = 1029.9, outside = 1030.1, below = 1000 / 1.0301;
    int column;
    morph_pair(&(struct morph_list){1, &f, &d}, &(struct morph_list){1, &inside, &d}, 0.03, &column);
    ck_assert_int_eq(column, 0);
    morph_pair(&(struct morph_list){1, &f, &d}, &(struct morph_list){1, &outside, &d}, 0.03, &column);
    ck_assert_int_eq(column, -1);
    morph_pair(&(struct morph_list){1, &f, &d}, &(struct morph_list){1, &below, &d}, 0.03, &column);
    ck_assert_int_eq(column, -1);
    morph_pair(&(struct morph_list){1, &f, &d}, &(struct morph_list){1, &f, &d}, 0, &column);
    ck_assert_int_eq(column, 0); /* equal is equal at any gate */
    const double rows[2] = {1000, 1025}, columns[2] = {1050, 1050.1},
                 ones[2] = {1, 1}; /* near each other in a chain: 1000 has no partner all the same */
    int two[2];
    morph_pair(&(struct morph_list){2, rows, ones}, &(struct morph_list){2, columns, ones}, 0.03, two);
    ck_assert(two[0] == -1 && two[1] == 0);
    morph_pair(&(struct morph_list){1, &f, &d}, &(struct morph_list){0, NULL, NULL}, 0.03, &column);
    ck_assert_int_eq(column, -1);
}
END_TEST

/* Two modes of nearly one frequency are told apart by their decay; a clear difference of frequency counts more. */
START_TEST(decay_breaks_ties)
{
    static const double f[2] = {1000, 1000.001}, d[2] = {5, 50}, swapped[2] = {48, 5.1}, g[2] = {1000.0005, 1000.0006};
    static const double apart[2] = {1000, 1005};
    int column[2];
    morph_pair(&(struct morph_list){2, g, swapped}, &(struct morph_list){2, f, d}, 0.03, column);
    ck_assert(column[0] == 1 && column[1] == 0);
    morph_pair(&(struct morph_list){2, apart, swapped}, &(struct morph_list){2, apart, d}, 0.03, column);
    ck_assert(column[0] == 0 && column[1] == 1);
}
END_TEST

/* Five places on a line; frequencies drift by 2 % from one to the next, 8 % in all, more than the gate; some modes are
   missing at some places, also at the place in between, and each place has them in another order. */
START_TEST(tracks_follow_drift)
{
    enum { PLACES = 5, MODES = 8 };
    static const double xy[2 * PLACES] = {0.4, 0, 0, 0, 0.2, 0, 0.1, 0, 0.3, 0};
    double f[PLACES][MODES], d[PLACES][MODES];
    int truth[PLACES][MODES], track[PLACES][MODES], *rows[PLACES], seen[64];
    struct morph_list list[PLACES];
    struct arena *a = arena_open();
    struct places *p;
    struct err e = {0};
    int bad;
    ck_assert(places_make(a, PLACES, xy, &p, &bad, &e));
    for (int k = 0; k < PLACES; k++) {
        list[k] = (struct morph_list){0, f[k], d[k]};
        rows[k] = track[k];
        for (int i = 0; i < MODES; i++) {
            int mode = (3 * i + k) % MODES;
            if ((mode == 2 && xy[2 * k] == 0.2) || (mode == 5 && xy[2 * k] < 0.15) || (mode == 6 && k == 1)) continue;
            f[k][list[k].n] = 100 * pow(1.5, mode) * pow(1.02, xy[2 * k] / 0.1 * (mode % 2 ? 1 : -1));
            if (mode == 2) f[k][list[k].n] = 225 * (1 + 0.05 * xy[2 * k]); /* missing in between: 1 % over the gap */
            d[k][list[k].n] = 3;
            truth[k][list[k].n++] = mode;
        }
    }
    ck_assert_int_eq(morph_tracks(p, PLACES, xy, list, 0.03, rows), MODES);
    for (int mode = 0; mode < MODES; mode++)
        seen[mode] = -1;
    for (int k = 0; k < PLACES; k++)
        for (int i = 0; i < list[k].n; i++) {
            int mode = truth[k][i];
            ck_assert(track[k][i] >= 0 && track[k][i] < MODES);
            ck_assert_msg(seen[mode] < 0 || seen[mode] == track[k][i], "mode %d of place %d", mode, k);
            seen[mode] = track[k][i];
        }
    for (int i = 0; i < MODES; i++)
        for (int k = 0; k < i; k++)
            ck_assert(seen[i] != seen[k]);
    ck_assert_int_eq(morph_tracks(p, PLACES, xy, list, 0.001, rows),
                     list[0].n + list[1].n + list[2].n + list[3].n + list[4].n); /* nothing pairs */
    arena_close(a);
}
END_TEST

UNIT("pairing", assignment_is_optimal, large_assignment, a_missing_mode_shifts_nothing, the_gate, decay_breaks_ties,
     tracks_follow_drift)
