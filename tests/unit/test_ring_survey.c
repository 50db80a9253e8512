/* Instants drawn along a motion: their weights make integrals of sums, wherever the draws crowd. */
#include "convolution/ring_survey.h"

#include "num/real.h"
#include "unit.h"

static double bent_at(const struct modes *m, const struct modes_where *where, const struct modes_point *p)
{
    (void)m;
    p->frequency[0] = 1000 + 20 * fmax(where->x - 0.0337, 0);
    p->decay[0] = 20;
    p->re[0] = exp(20 * where->x);
    p->im[0] = 0;
    return 0;
}

/* places_kinks of places at 0, 0.0337 and 1 m. */
static int one_kink(const struct modes *m, const double from[2], const double to[2], double *u, int most)
{
    double at = (0.0337 - from[0]) / (to[0] - from[0]);
    (void)m, (void)most;
    u[0] = at;
    return at > 0 && at < 1;
}

static struct ring_survey survey_of(const struct motion *motion, bool by_speed, bool stays, struct arena *a)
{
    static double one[1] = {1};
    struct trajectory *tr = ARENA_TAKE(a, struct trajectory, 1);
    struct modes *m = ARENA_TAKE(a, struct modes, 1);
    struct err e = {0};
    struct ring_survey s;
    *m = (struct modes){.n = 1, .moves = true, .frequency = one, .decay = one, .slowest = one, .at = bent_at, .kinks = one_kink};
    ck_assert_msg(trajectory_make(motion, 1, a, tr, &e), "%s", e.text);
    ring_survey(&(struct ring_survey_ask){m, tr, by_speed, stays, true}, a, &s);
    return s;
}

static const struct motion motions[] = {
    {.path = PATH_BACK_AND_FORTH, .to = {0.1, 0}, .rate = 7, .speed = NAN, .duration = 1.93},
    {.path = PATH_LINE, .to = {0.1, 0}, .rate = NAN, .speed = NAN, .duration = 0.7},
    {.path = PATH_LINE, .to = {0.1, 0}, .rate = NAN, .speed = NAN, .duration = 0.7, .law = SPEED_MINIMUM_JERK},
};

/* 1, t, a wave, over the whole; 512 draws of a mixture leave 3 %. With some of the reach beyond the ends, which does not count. */
START_TEST(test_integrals)
{
    struct ring_survey_instant *at = malloc(RING_SURVEY_INSTANTS * sizeof *at);
    for (int i = 0; i < 3; i++)
        for (int by_speed = 0; by_speed < 2; by_speed++)
            for (double reach = 1e-4; reach < 1; reach *= 7) {
                struct arena *a = arena_open();
                struct ring_survey s = survey_of(&motions[i], by_speed, false, a);
                double sum[3] = {0}, T = s.duration;
                int n = ring_survey_draw(&s, reach, at);
                ck_assert_int_gt(n, RING_SURVEY_INSTANTS / 2);
                for (int k = 0; k < n; k++) {
                    ck_assert(at[k].t >= 0 && at[k].t <= T && at[k].weight > 0);
                    sum[0] += at[k].weight;
                    sum[1] += at[k].weight * at[k].t;
                    sum[2] += at[k].weight * pow(sin(5 * M_PI * at[k].t / T), 2);
                }
                ck_assert_msg(fabs(sum[0] / T - 1) < 0.03 && fabs(sum[1] / T / T - 0.5) < 0.03 && fabs(sum[2] / T - 0.5) < 0.03,
                              "motion %d, reach %g: %g %g %g", i, reach, sum[0] / T, sum[1] / T / T, sum[2] / T);
                arena_close(a);
            }
    free(at);
}
END_TEST

/* Of 27 passes over the kink some tenths of a millisecond around each get an eighth of the draws or more, and still their right weight: to 15 %,
   as the mean of some 80 draws has it that are not independent. */
START_TEST(test_kinks)
{
    struct ring_survey_instant *at = malloc(RING_SURVEY_INSTANTS * sizeof *at);
    struct arena *a = arena_open();
    struct ring_survey s = survey_of(&motions[0], false, false, a);
    double near = 0, T = s.duration, pass = acos(1 - 2 * 0.337) / (2 * M_PI * 7);
    int passes = 0;
    for (int k = 0; k < 28; k++)
        passes += (k % 2 ? (k / 2 + 1) / 7.0 - pass : k / 2 / 7.0 + pass) < T;
    for (double reach = 1e-4; reach < 2.95e-4; reach += 1e-5) {
        int drawn = 0, n = ring_survey_draw(&s, reach, at);
        for (int k = 0; k < n; k++) {
            double in = fmod(at[k].t, 1 / 7.0);
            if (fmin(fabs(in - pass), fabs(in - (1 / 7.0 - pass))) < reach) {
                drawn++;
                near += at[k].weight / (2 * reach * passes) / 20;
            }
        }
        ck_assert_int_gt(drawn, 64);
    }
    ck_assert_double_eq_tol(near, 1, 0.15);
    free(at);
    arena_close(a);
}
END_TEST

/* What stays is also looked at behind its end; the force is silent there and before the start, and goes with the square of speed where that is asked. */
START_TEST(test_ends)
{
    struct ring_survey_instant *at = malloc(RING_SURVEY_INSTANTS * sizeof *at);
    struct arena *a = arena_open();
    struct ring_survey s = survey_of(&motions[0], true, true, a);
    double behind = 0, T = s.duration;
    int n = ring_survey_draw(&s, 0.05, at);
    for (int k = 0; k < n; k++)
        behind += at[k].t > T ? at[k].weight : 0;
    ck_assert_double_eq_tol(behind, 0.05, 0.005);
    ck_assert(ring_survey_loud(&s, -1e-9) == 0 && ring_survey_loud(&s, T + 1e-9) == 0);
    for (double t = 0; t < T; t += 0.0137)
        ck_assert_double_eq_tol(ring_survey_loud(&s, t), 2 * pow(sin(2 * M_PI * 7 * t), 2), 0.02);
    free(at);
    arena_close(a);
}
END_TEST

UNIT("ring_survey", test_integrals, test_kinks, test_ends)
