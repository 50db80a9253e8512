/* impacts: the sub-intervals' means against quadrature of the sum of raised cosines, all momentum at many rates, the
   same force whatever the blocks and an hour into the scene, memory, what is reported, and which impacts take place. */
#include <gsl/gsl_integration.h>
#include <jansson.h>

#include "contacts.h"
#include "force/impact_series.h"
#include "impacts.h"

extern const struct stage impact_series_stage;

static const double rates[] = {8000, 22050, 48000, 192000};
enum { RATES = sizeof rates / sizeof rates[0] };

static struct contact series(int prototype, double duration)
{
    struct contact c = shot_contact(CONTACT_IMPACTS, duration);
    struct contact own = impacts_contact(prototype);
    *impacts_in(&c) = *impact_law_given(&own);
    return c;
}

/* Impacts of either sign whose durations lie between some 0.1 and 20 ms, so that many overlap. */
static struct contact crowd(double duration)
{
    struct contact c = series(PROTOTYPE_CUSTOM, duration);
    impacts_in(&c)->amplitude = (struct impact_draws){.mean = 0, .deviation = 0.5, .a1 = -0.5, .b1 = 0.2};
    impacts_in(&c)->interval = (struct impact_draws){.mean = 1e-3, .deviation = 0.3e-3, .a1 = -0.2, .b1 = 0};
    impacts_in(&c)->zeta = 1e-3;
    impacts_in(&c)->theta = 0.6;
    return c;
}

static struct contact even(double interval, double lasts, double duration)
{
    struct contact c = series(PROTOTYPE_CUSTOM, duration);
    impacts_in(&c)->amplitude = (struct impact_draws){.mean = 0.7, .deviation = 0, .a1 = 0, .b1 = 0};
    impacts_in(&c)->interval = (struct impact_draws){.mean = interval, .deviation = 0, .a1 = 0, .b1 = 0};
    impacts_in(&c)->zeta = lasts;
    impacts_in(&c)->theta = 0;
    return c;
}

/* All impacts that take place, anew. */
static struct impact *drawn(struct shot *s, long *n)
{
    struct impact_train t;
    long room = 1000;
    struct impact *all = malloc((size_t)room * sizeof *all);
    ck_assert_msg(impact_series_train(&s->run, &t, &s->e), "%s", s->e.text);
    for (*n = 0; t.any; ++*n) {
        if (*n == room) all = realloc(all, (size_t)(room *= 2) * sizeof *all);
        all[*n] = impact_series_take(&t);
    }
    return all;
}

/* ------------------------------------------------------------------ means */

static double cosine_at(double t, void *self)
{
    const struct impact *i = self;
    return 0.5 * i->amplitude * (1 + cos(2 * M_PI * (t - i->time) / i->duration));
}

/* What one impact adds to the mean over [low, high]. */
static double mean_of(struct impact *i, double low, double high, gsl_integration_glfixed_table *g)
{
    double from = fmax(low, i->time - i->duration / 2), to = fmin(high, i->time + i->duration / 2);
    gsl_function f = {cosine_at, i};
    return to > from ? gsl_integration_glfixed(&f, from, to, g) / (high - low) : 0;
}

/* 40 points over a whole impact at most: exact to rounding. A share is good to 4e-16 (pulse.h), times impact and
   sub-interval: an impact of 20 ms over sub-intervals of 7 us makes that 1e-12 of its amplitude, which is below 3;
   times within 50 ms are good to 7e-18 s. */
START_TEST(means_are_those_of_the_sum)
{
    gsl_integration_glfixed_table *g = gsl_integration_glfixed_table_alloc(40);
    struct contact c = crowd(0.05);
    struct shot s;
    long n;
    ck_assert_msg(shot_open(&s, &impact_series_stage, &c, 48000, 3), "%s", s.e.text);
    const double *force = shot_force(&s, 3000), dt = 1.0 / (3 * 48000);
    struct impact *all = drawn(&s, &n);
    double worst = 0, peak = 0;
    ck_assert_int_ge(n, 30);
    for (long k = 0; k < 3000 * 3; k++) {
        double want = 0;
        for (long i = 0; i < n; i++)
            want += mean_of(&all[i], (double)k * dt, (double)(k + 1) * dt, g);
        worst = fmax(worst, fabs(force[k] - want));
        peak = fmax(peak, fabs(want));
    }
    ck_assert_double_ge(peak, 0.3);
    ck_assert_double_le(worst, 1e-11);
    gsl_integration_glfixed_table_free(g);
    free(all);
    arena_close(s.arena);
}
END_TEST

/* ------------------------------------------------------------------ momentum */

/* Share of an impact that comes after 0: the whole, but of one under way there. */
static double after_start(const struct impact *i)
{
    double q = -i->time / i->duration;
    return q <= -0.5 ? 1 : q >= 0.5 ? 0 : 0.5 - q - sin(2 * M_PI * q) / (2 * M_PI);
}

/* Sum of the sub-intervals, and of the decimated samples, against sum A t0 / 2: rounding of as many terms; the
   decimator's gain at 0 Hz is 1 to rounding, and of what it leaves of the images 2e-7 remains. A series that is under
   way at the start is cut there at full height, and what the decimator would spread before it is in the first samples.
   Of signed series a share of sum |A| t0 / 2. */
START_TEST(momentum_is_kept)
{
    for (int r = 0; r < RATES; r++)
        for (int over = 1; over <= 32; over *= 32)
            for (int prototype = PROTOTYPE_ROLL; prototype <= PROTOTYPE_CUSTOM; prototype++) {
                struct contact c = prototype == PROTOTYPE_CUSTOM ? crowd(0.1) : series(prototype, 0.1);
                struct shot s;
                double want = 0, whole = 0, sum = 0, all = 0;
                long n, frames = (long)(0.15 * rates[r]);
                ck_assert_msg(shot_open(&s, &impact_series_stage, &c, rates[r], over), "%s", s.e.text);
                struct impact *list = drawn(&s, &n);
                for (long i = 0; i < n; i++) {
                    want += list[i].amplitude * list[i].duration / 2 * after_start(&list[i]);
                    whole += fabs(list[i].amplitude) * list[i].duration / 2;
                }
                const double *force = shot_decimated(&s, frames), *means = board_at(&s.board, ITEM_SUBFORCE, 0);
                for (long i = 0; i < frames * over; i++)
                    sum += means[i];
                for (long i = 0; i < frames; i++)
                    all += force[i];
                ck_assert_double_gt(whole, 0);
                ck_assert_double_eq_tol(sum / (rates[r] * over), want, 1e-12 * whole);
                ck_assert_double_eq_tol(all / rates[r], want, 1e-6 * whole);
                free(list);
                arena_close(s.arena);
            }
}
END_TEST

/* ------------------------------------------------------------------ the same force */

static json_t *reported(const struct shot *s) { return impact_series_stage.report(&s->run, s->arena).value; }

static long reported_count(const json_t *report, const char *key)
{
    return (long)json_integer_value(json_object_get(report, key));
}

/* Blocks of 1 to 1021 frames and of 1024: the same bits. */
START_TEST(blocks_do_not_matter)
{
    struct contact c = crowd(0.2);
    struct shot a, b;
    ck_assert(shot_open(&a, &impact_series_stage, &c, 44100, 4) && shot_open(&b, &impact_series_stage, &c, 44100, 4));
    const double *x = shot_force(&a, 9000), *y;
    shot_room(&b, ITEM_SUBFORCE, 4, 9216);
    for (long from = 0; from < 9216; from += STAGE_BLOCK)
        ck_assert(impact_series_stage.run(&b.run, from, from + STAGE_BLOCK, &b.e));
    y = board_at(&b.board, ITEM_SUBFORCE, 0);
    ck_assert_int_eq(memcmp(x, y, 9000 * 4 * sizeof *x), 0);
    json_t *of[2] = {reported(&a), reported(&b)};
    ck_assert(json_equal(of[0], of[1]));
    json_decref(of[0]);
    json_decref(of[1]);
    arena_close(a.arena);
    arena_close(b.arena);
}
END_TEST

static double block_of(struct shot *s, long from, double out[500])
{
    double peak = 0;
    s->board.signals[ITEM_SUBFORCE].first = from;
    ck_assert(impact_series_stage.run(&s->run, from, from + 500, &s->e));
    memcpy(out, board_at(&s->board, ITEM_SUBFORCE, from), 500 * sizeof *out);
    for (int i = 0; i < 500; i++)
        peak = fmax(peak, fabs(out[i]));
    return peak;
}

/* An impact every 1/16 s of 3 ms at 8 kHz: one falls on every 500th frame. At 3600 s a time is known to 4.5e-13
   s, 1.5e-10 of its duration, which moves a mean by pi times as much of the peak at most. And what an hour takes is not
   more than what its first minute does. */
START_TEST(an_hour_later)
{
    struct contact c = even(1.0 / 16, 3e-3, 3700);
    struct shot s;
    double early[500], late[500];
    size_t minute = 0;
    ck_assert_msg(shot_open(&s, &impact_series_stage, &c, 8000, 1), "%s", s.e.text);
    shot_room(&s, ITEM_SUBFORCE, 1, 1000);
    double peak = block_of(&s, 0, early);
    peak = fmax(peak, block_of(&s, 500, early));
    ck_assert_double_eq_tol(peak, 0.7, 0.01);
    for (long from = 1000; from < 28800000; from += 500) {
        block_of(&s, from, late);
        if (from == 480000) minute = arena_bytes(s.arena);
    }
    for (int i = 0; i < 500; i++)
        ck_assert_double_eq_tol(late[i], early[i], 5e-10 * peak);
    ck_assert_uint_eq(arena_bytes(s.arena), minute);
    arena_close(s.arena);
}
END_TEST

/* 10 s of crossing impacts: the queue has its length after a second. */
START_TEST(memory_does_not_grow)
{
    struct contact c = crowd(10);
    struct shot s;
    size_t second = 0;
    ck_assert(shot_open(&s, &impact_series_stage, &c, 48000, 4));
    shot_room(&s, ITEM_SUBFORCE, 4, 2000);
    for (long from = 0; from < 480000; from += 1000) {
        s.board.signals[ITEM_SUBFORCE].first = from;
        ck_assert(impact_series_stage.run(&s.run, from, from + 1000, &s.e));
        if (from == 48000) second = arena_bytes(s.arena);
    }
    ck_assert_uint_le(arena_bytes(s.arena), second + 100000);
    arena_close(s.arena);
}
END_TEST

/* ------------------------------------------------------------------ which take place, and what is told */

/* From the first that is not over at 0 to the last before the end, as they follow each other; they do not depend on the
 * rate. */
START_TEST(impacts_that_take_place)
{
    for (int prototype = PROTOTYPE_ROLL; prototype <= PROTOTYPE_CUSTOM; prototype++) {
        struct contact c = prototype == PROTOTYPE_CUSTOM ? crowd(0.3) : series(prototype, 0.3);
        struct shot s[2];
        long n[2];
        ck_assert(shot_open(&s[0], &impact_series_stage, &c, 22050, 1) && shot_open(&s[1], &impact_series_stage, &c, 192000, 32));
        struct impact *a = drawn(&s[0], &n[0]), *b = drawn(&s[1], &n[1]);
        ck_assert_int_eq(n[0], n[1]);
        ck_assert_int_gt(n[0], 5);
        ck_assert(a[0].time + a[0].duration / 2 > 0 && a[n[0] - 1].time < 0.3 &&
                  a[n[0] - 1].time + a[n[0] - 1].interval >= 0.3);
        for (long i = 0; i < n[0]; i++) {
            ck_assert_int_eq(memcmp(&a[i].time, &b[i].time, 4 * sizeof(double)), 0);
            ck_assert(i == 0 || a[i].time == a[i - 1].time + a[i - 1].interval);
        }
        free(a);
        free(b);
        arena_close(s[0].arena);
        arena_close(s[1].arena);
    }
}
END_TEST

/* The report against the list; impacts that follow each other without a gap do not overlap, those that last a hair
 * longer do. */
START_TEST(report)
{
    const double lasts[] = {4e-3, 4.001e-3};
    struct contact c = crowd(2);
    struct shot s;
    long n, crossing = 0;
    double sum = 0;
    ck_assert(shot_open(&s, &impact_series_stage, &c, 8000, 1));
    shot_force(&s, 20000);
    json_t *o = reported(&s);
    struct impact *all = drawn(&s, &n);
    for (long i = 0; i < n; i++) {
        crossing += i > 0 && all[i].time - all[i].duration / 2 < all[i - 1].time + all[i - 1].duration / 2;
        sum += all[i].interval;
    }
    ck_assert_int_eq(reported_count(o, "count"), n);
    ck_assert_int_eq(reported_count(o, "overlaps"), crossing);
    ck_assert_int_gt(crossing, 100);
    ck_assert(json_real_value(json_object_get(o, "per_second")) == (double)n / 2);
    ck_assert_double_eq_tol(json_real_value(json_object_get(o, "mean_interval_s")), sum / (double)n, 1e-15);
    json_decref(o);
    free(all);
    arena_close(s.arena);
    for (int k = 0; k < 2; k++) {
        struct contact e = even(4e-3, lasts[k], 0.999);
        ck_assert(shot_open(&s, &impact_series_stage, &e, 8000, 1));
        shot_force(&s, 9000);
        o = reported(&s);
        ck_assert_int_eq(reported_count(o, "overlaps"), k ? reported_count(o, "count") - 1 : 0);
        json_decref(o);
        arena_close(s.arena);
    }
}
END_TEST

START_TEST(too_long_a_one_is_refused)
{
    struct contact c = crowd(1);
    struct shot s;
    impacts_in(&c)->theta = 2;
    impacts_in(&c)->zeta = 0.1;
    ck_assert(!shot_open(&s, &impact_series_stage, &c, 48000, 1));
    ck_assert_int_eq(s.e.kind, ERR_SCENE);
    ck_assert_msg(strstr(s.e.text, "an impact of the least amplitude would last") != NULL, "%s", s.e.text);
    arena_close(s.arena);
}
END_TEST

UNIT("impacts", means_are_those_of_the_sum, momentum_is_kept, blocks_do_not_matter, an_hour_later, memory_does_not_grow,
     impacts_that_take_place, report, too_long_a_one_is_refused)
