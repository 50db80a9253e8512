/* Strikes on a made-up object: two modes, struck by raised cosines at known times. The sound is a plain convolution in
 * time. */
#include "unit.h"

#include "analysis/strikes.h"
#include "num/real.h"

enum { RATE = 16000, LENGTH = 6400, N = 32000, PULSE = 12 };

struct made {
    struct arena *a;
    double *h, *sound, *force;
    struct strikes_recording r;
};

static double noise(unsigned *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)*state / 4294967296.0 - 0.5;
}

/* peaks[k] N at times at[k]; the sound comes `late` samples after the force. */
static struct made make(int strikes, const long *at, const double *peak, long late, double noisy)
{
    struct made m = {.a = arena_open()};
    unsigned state = 1;
    m.h = ARENA_TAKE(m.a, double, LENGTH);
    m.sound = ARENA_TAKE(m.a, double, N);
    m.force = ARENA_TAKE(m.a, double, N);
    for (long i = 0; i < LENGTH; i++) {
        double t = (double)i / RATE;
        m.h[i] = 3.0 * real_exp(-40.0 * t) * real_sin(2.0 * REAL_PI * 310.0 * t) +
                 2.0 * real_exp(-60.0 * t) * real_sin(2.0 * REAL_PI * 720.0 * t);
    }
    for (int k = 0; k < strikes; k++)
        for (long i = 0; i < PULSE; i++) {
            double f = peak[k] * (0.5 - 0.5 * real_cos(2.0 * REAL_PI * (double)i / PULSE));
            m.force[at[k] + i] += f;
            for (long j = 0; j < LENGTH && at[k] + i + j + late < N; j++)
                m.sound[at[k] + i + j + late] += f * m.h[j] / RATE;
        }
    for (long i = 0; i < N; i++)
        m.sound[i] += noisy * noise(&state);
    m.r = (struct strikes_recording){.name = "made",
                                     .sound = {.x = m.sound, .full = INFINITY},
                                     .force = {.x = m.force, .full = INFINITY},
                                     .n = N,
                                     .rate = RATE};
    return m;
}

static void solve(struct made *m, struct strikes *s)
{
    struct err e = {0};
    ck_assert_msg(strikes_find(&m->r, 20.0, m->a, s, &e), "%s", e.text);
}

static int used(const struct strikes *s)
{
    int n = 0;
    for (int k = 0; k < s->n; k++)
        n += !s->strike[k].left_out;
    return n;
}

static const double peaks[] = {10.0, 25.0, 16.0};

/* Onsets within a pulse's first 0.5 % (2 samples) and the 4 beside it; momentum is peak PULSE/2 samples, but for its
 * foot (2e-3). */
START_TEST(apart)
{
    const long at[] = {3000, 13000, 23000};
    struct made m = make(3, at, peaks, 0, 0.0);
    struct strikes s;
    solve(&m, &s);
    ck_assert_int_eq(s.n, 3);
    for (int k = 0; k < 3; k++) {
        ck_assert_int_le(labs(s.strike[k].onset - at[k]), 6);
        ck_assert_double_eq_tol(s.strike[k].momentum, peaks[k] * PULSE / 2 / RATE, 2e-3 * peaks[k] * PULSE / 2 / RATE);
    }
    arena_close(m.a);
}
END_TEST

/* The second strike falls into the ringing of the first, 75 ms before it. */
START_TEST(overlapping)
{
    struct made m = make(3, (const long[]){3000, 4200, 16000}, peaks, 0, 0.0);
    struct strikes s;
    solve(&m, &s);
    ck_assert_int_eq(s.n, 3);
    arena_close(m.a);
}
END_TEST

/* Upside down: the same. */
START_TEST(turned)
{
    struct made m = make(2, (const long[]){3000, 16000}, peaks, 0, 0.0);
    struct strikes s;
    for (long i = 0; i < N; i++)
        m.force[i] = -m.force[i];
    solve(&m, &s);
    ck_assert_ptr_nonnull(s.note);
    ck_assert_double_eq(m.r.force.x[3005], -m.force[3005]);
    arena_close(m.a);
}
END_TEST

/* 7 samples of way, found within what a pulse's edges are worth. */
START_TEST(late)
{
    struct made m = make(2, (const long[]){3000, 16000}, peaks, 7, 0.0);
    struct strikes s;
    solve(&m, &s);
    ck_assert_double_eq_tol(strikes_delay(&m.r, &s), 7.0 / RATE, 5.0 / RATE);
    arena_close(m.a);
}
END_TEST

/* A strike that the file could not hold is left out, and the others say all. */
START_TEST(clipped)
{
    struct made m = make(3, (const long[]){3000, 13000, 23000}, peaks, 0, 0.0);
    struct strikes s;
    m.r.force.full = 20.0;
    for (long i = 0; i < N; i++)
        m.force[i] = fmin(m.force[i], 20.0);
    solve(&m, &s);
    ck_assert(s.strike[1].clipped && !s.strike[0].clipped && !s.strike[2].clipped);
    ck_assert_int_eq(used(&s), 2);
    ck_assert_str_eq(s.strike[1].left_out, "clipped");
    arena_close(m.a);
}
END_TEST

/* By the sound alone: onsets within 1 ms; the response has the shape of h through a pulse, so only its strikes are
 * compared. */
START_TEST(without_force)
{
    const long at[] = {3000, 13000, 23000};
    struct made m = make(3, at, peaks, 0, 1e-5);
    struct strikes s;
    m.r.force.x = NULL;
    solve(&m, &s);
    ck_assert_int_eq(s.n, 3);
    for (int k = 0; k < 3; k++)
        ck_assert_int_le(labs(s.strike[k].onset - at[k]), 16);
    arena_close(m.a);
}
END_TEST

/* Offsets of a tenth and more of the greatest sample and force, and a hum in the pauses, leave the three strikes what
 * they are. */
START_TEST(offset_and_hum)
{
    struct made m = make(3, (const long[]){3000, 13000, 23000}, peaks, 0, 1e-5);
    struct strikes s;
    double most = 0.0;
    for (long i = 0; i < N; i++)
        most = fmax(most, fabs(m.sound[i]));
    for (long i = 0; i < N; i++) {
        m.sound[i] += 0.2 * most;
        m.force[i] += 2.5;
    }
    solve(&m, &s);
    ck_assert(s.note && strstr(s.note, "the sound stands beside 0") &&
              strstr(s.note, "the force stands beside 0, by 2.5"));
    ck_assert_int_eq(s.n, 3);
    ck_assert_int_eq(used(&s), 3);
    for (long i = 0; i < N; i++)
        m.sound[i] += 0.06 * most * real_sin(2.0 * REAL_PI * 50.0 * (double)i / RATE) - 0.2 * most;
    m.r.sound.x = m.sound;
    solve(&m, &s);
    ck_assert_int_eq(used(&s), 3);
    arena_close(m.a);
}
END_TEST

/* A hum with even harmonics is longer above 0 than below, its mean none: no offset, with a quiet part or, rung over
   throughout, without. The median is beside 0 by 0.016 of the peak. A true offset under it comes off as what it is. */
START_TEST(hum_is_no_offset)
{
    struct made m = make(3, (const long[]){3000, 13000, 23000}, peaks, 0, 1e-5);
    double most = 0.0, *hum = ARENA_TAKE(m.a, double, N);
    for (long i = 0; i < N; i++)
        most = fmax(most, fabs(m.sound[i]));
    for (long i = 0; i < N; i++)
        for (int k = 0; k < 3; k++)
            hum[i] += most * (const double[]){0.1, 0.05, 0.02}[k] *
                      real_cos(2.0 * REAL_PI * 50.0 * (k + 1) * (double)i / RATE);
    for (int k = 0; k < 3; k++) {
        double offset = k == 2 ? 0.03 * most : 0.0, *sound = ARENA_TAKE(m.a, double, N);
        struct strikes_recording r = m.r;
        struct strikes s;
        struct err e = {0};
        for (long i = 0; i < N; i++)
            sound[i] = m.sound[i] + hum[i] + offset +
                       (k == 1 ? 3.0 * most * real_sin(2.0 * REAL_PI * 310.0 * (double)i / RATE) : 0.0);
        r.sound.x = sound;
        r.force.x = NULL;
        strikes_find(&r, 20.0, m.a, &s, &e);
        ck_assert_msg(k == 2 || !s.note || !strstr(s.note, "beside 0"), "%s", s.note);
        ck_assert_double_eq_tol(r.sound.offset, offset, 1e-3 * most);
    }
    arena_close(m.a);
}
END_TEST

/* 16 bits, and nothing at all but the strike: the last bit that comes and goes as it rings out is no strike. */
START_TEST(last_bit_is_no_strike)
{
    struct made m = make(1, (const long[]){3000}, peaks, 0, 0.0);
    struct strikes s;
    double most = 0.0, step;
    for (long i = 0; i < N; i++)
        most = fmax(most, fabs(m.sound[i]));
    step = most / 300;
    for (long i = 0; i < N; i++)
        m.sound[i] = step * rint(m.sound[i] / step);
    for (long i = 0; i < 40; i++)
        m.sound[3000 + LENGTH + 2000 + 90 * (i / 8) + i % 8] = i % 2 ? step : 0.0;
    m.r.force.x = NULL;
    solve(&m, &s); /* a file of floats: the step is seen in the samples */
    ck_assert_int_eq(s.n, 1);
    ck_assert_double_eq_tol(m.r.rounding, step / sqrt(12.0), 1e-6 * step);
    m.sound[3500] += 0.3 * step;
    solve(&m, &s);
    ck_assert_int_eq(s.n, 1);
    m.r.rounding = 0.0;
    solve(&m, &s);
    ck_assert_int_eq(s.n, 2);
    arena_close(m.a);
}
END_TEST

/* Scaled after it clipped, so that nothing reaches what the file holds: a row of equal extremes, above or below. A slow
 * sine in 20 steps has such rows, and does not clip. */
START_TEST(clipped_and_scaled)
{
    struct made m = make(3, (const long[]){3000, 13000, 23000}, peaks, 0, 0.0);
    struct strikes s;
    unsigned state = 5;
    double *slow = ARENA_TAKE(m.a, double, N);
    struct strikes_recording r = {.name = "slow", .sound = {.x = slow, .full = INFINITY}, .n = N, .rate = RATE};
    struct err e = {0};
    for (long i = 0; i < N; i++)
        m.force[i] = 0.7 * fmin(m.force[i] + 1e-3 * noise(&state), 20.0);
    solve(&m, &s);
    ck_assert_ptr_null(s.note);
    ck_assert_double_eq_tol(m.r.force.clip[1], 14.0, 1e-9);
    ck_assert_double_eq(m.r.sound.clip[0], 0.0);
    ck_assert_double_eq(m.r.sound.clip[1], 0.0);
    ck_assert(s.strike[1].clipped && !s.strike[0].clipped && !s.strike[2].clipped);
    for (long i = 0; i < N; i++)
        slow[i] = rint(20.0 * real_sin(2.0 * REAL_PI * 50.0 * (double)i / RATE));
    ck_assert(strikes_response(&r, 0.0, m.a, &s, &e) && !s.note);
    ck_assert(r.sound.clip[0] == 0.0 && r.sound.clip[1] == 0.0);
    for (long i = 0; i < N; i++)
        slow[i] = fmax(-0.5, real_sin(2.0 * REAL_PI * 310.0 * (double)i / RATE));
    ck_assert(strikes_response(&r, 0.0, m.a, &s, &e) && strstr(s.note, "may be clipped"));
    ck_assert(r.sound.clip[0] == -0.5 && r.sound.clip[1] == 0.0);
    for (long i = 0; i < N; i++) /* clipped before the delay alone */
        slow[i] = i < 2000 ? fmax(-0.5, real_sin(2.0 * REAL_PI * 310.0 * (double)i / RATE))
                           : 0.3 * real_sin(2.0 * REAL_PI * 310.0 * (double)i / RATE);
    ck_assert(strikes_response(&r, 4000.0 / RATE, m.a, &s, &e) && strstr(s.note, "may be clipped"));
    arena_close(m.a);
}
END_TEST

/* One sample as large as the file can hold is what normalising makes; two neighbours are clipped. */
START_TEST(as_loud_as_can_be)
{
    struct made m = make(1, (const long[]){3000}, peaks, 0, 1e-6);
    struct strikes s;
    struct err e = {0};
    long at = 0;
    for (long i = 0; i < N; i++)
        at = fabs(m.sound[i]) > fabs(m.sound[at]) ? i : at;
    m.r.sound.full = fabs(m.sound[at]);
    solve(&m, &s);
    ck_assert_int_eq(used(&s), 1);
    m.sound[at + 1] = m.sound[at];
    ck_assert(!strikes_find(&m.r, 20.0, m.a, &s, &e) && strstr(e.text, "clipped"));
    arena_close(m.a);
}
END_TEST

/* An impulse response behind 20 ms of noise, 20 to 50 dB below its greatest sample, and an offset: its onset is found,
   to the one sample that stays, from 30 dB on, and else it is said that it is not. */
START_TEST(response_in_noise)
{
    for (int dB = 20; dB <= 50; dB += 5) {
        struct made m = make(1, (const long[]){100}, peaks, 0, 0.0);
        double *x = ARENA_TAKE(m.a, double, N), rms = real_exp10(-dB / 20.0);
        struct strikes_recording r = {.name = "r", .sound = {.x = x, .full = INFINITY}, .n = N, .rate = RATE};
        struct strikes s;
        struct err e = {0};
        unsigned state = 7;
        for (long i = 0; i < N; i++)
            x[i] = 0.05 + rms * sqrt(12.0) * noise(&state);
        for (long i = 320; i < N; i++)
            x[i] +=
                real_exp(-40.0 * (double)(i - 320) / RATE) * real_cos(2.0 * REAL_PI * 310.0 * (double)(i - 320) / RATE);
        ck_assert_msg(strikes_response(&r, NAN, m.a, &s, &e), "%s", e.text);
        if (dB >= 30) ck_assert_int_eq(s.strike->onset, 319);
        if (s.strike->onset == 0) ck_assert(s.note && strstr(s.note, "no clear onset"));
        ck_assert(s.strike->onset == 0 || s.strike->onset == 319);
        ck_assert_double_eq_tol(r.sound.offset, 0.05, 0.1 * rms + 1e-3);
        arena_close(m.a);
    }
}
END_TEST

/* Behind silence, a mode that rises within a sample or within a millisecond begins at its first sample, to two. */
START_TEST(response_that_rises)
{
    for (double f = 40.0; f < 4000.0; f *= 1.07) {
        struct arena *a = arena_open();
        double *x = ARENA_TAKE(a, double, N);
        struct strikes_recording r = {.name = "r", .sound = {.x = x, .full = INFINITY}, .n = N, .rate = RATE};
        struct strikes s;
        struct err e = {0};
        for (long i = 320; i < N; i++)
            x[i] = real_exp(-20.0 * (double)(i - 320) / RATE) * real_sin(2.0 * REAL_PI * f * (double)(i - 320) / RATE);
        ck_assert_msg(strikes_response(&r, NAN, a, &s, &e), "%s", e.text);
        ck_assert_int_le(labs(s.strike->onset - 320), 2);
        arena_close(a);
    }
}
END_TEST

/* A single strike, with its force and without. */
START_TEST(single)
{
    struct made m = make(1, (const long[]){3000}, peaks, 0, 1e-5);
    struct strikes s;
    for (int force = 1; force >= 0; force--) {
        m.r.force.x = force ? m.force : NULL;
        solve(&m, &s);
        ck_assert_int_eq(s.n, 1);
    }
    arena_close(m.a);
}
END_TEST

/* What is refused says why. */
START_TEST(refused)
{
    struct made m = make(1, (const long[]){3000}, peaks, 0, 0.0);
    struct strikes s;
    struct err e = {0};
    m.r.n = 100;
    ck_assert(!strikes_find(&m.r, 20.0, m.a, &s, &e) && e.kind == ERR_SCENE && strstr(e.text, "10 ms"));
    m.r.n = 2900;
    e = (struct err){0};
    ck_assert(!strikes_find(&m.r, 20.0, m.a, &s, &e) && strstr(e.text, "silent"));
    m.r.n = N;
    m.r.sound.full = 1e-9;
    e = (struct err){0};
    ck_assert(!strikes_find(&m.r, 20.0, m.a, &s, &e) && strstr(e.text, "clipped"));
    m.r.force.x = NULL;
    m.r.sound.full = INFINITY;
    unsigned state = 3;
    for (long i = 0; i < N; i++)
        m.sound[i] = noise(&state);
    e = (struct err){0};
    ck_assert(!strikes_find(&m.r, 20.0, m.a, &s, &e) && strstr(e.text, "no strike"));
    arena_close(m.a);
}
END_TEST

/* What the sound is not good enough for: a strike 35 dB below a bang, one of 100 steps, a gap in the ringing. */
START_TEST(not_good_enough)
{
    struct made m = make(1, (const long[]){3000}, peaks, 0, 1e-6);
    struct strikes s;
    struct err e = {0};
    double most = 0.0, *sound = ARENA_TAKE(m.a, double, N);
    for (long i = 0; i < N; i++)
        most = fmax(most, fabs(m.sound[i]));
    memcpy(sound, m.sound, N * sizeof *sound);
    m.r.sound.x = sound;
    sound[20000] = 60.0 * most;
    ck_assert(!strikes_find(&m.r, 20.0, m.a, &s, &e) && strstr(e.text, "30 dB quieter"));
    sound[20000] = 0.0;
    e = (struct err){0};
    m.r.rounding = most / 100.0 / sqrt(12.0);
    ck_assert(!strikes_find(&m.r, 20.0, m.a, &s, &e) && strstr(e.text, "steps high"));
    m.r.rounding = 0.0;
    e = (struct err){0};
    for (long i = 3800; i < 3800 + RATE / 100; i++)
        sound[i] = 0.0;
    ck_assert(!strikes_find(&m.r, 20.0, m.a, &s, &e) && strstr(e.text, "gap"));
    arena_close(m.a);
}
END_TEST

/* 40 and 60/s from 1 to noise of 3e-4: some 0.2 s, and what 20 dB more take; never less than a quarter of a second. */
START_TEST(ringing)
{
    struct made m = make(3, (const long[]){3000, 13000, 23000}, peaks, 0, 1e-5);
    struct strikes s;
    solve(&m, &s);
    double t = strikes_ringing(&m.r, &s);
    ck_assert_double_ge(t, 0.25);
    ck_assert_double_le(t, 0.45);
    arena_close(m.a);
}
END_TEST

UNIT("test_strikes", not_good_enough, ringing, apart, overlapping, turned, late, clipped, without_force, offset_and_hum,
     hum_is_no_offset, last_bit_is_no_strike, clipped_and_scaled, as_loud_as_can_be, response_in_noise,
     response_that_rises, single, refused)
