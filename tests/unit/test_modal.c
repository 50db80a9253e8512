/* The fit of modes to recordings (analysis/modal.h): its basis against plain sums over samples, what comes back of
 * known modes, and what must not. */
#include "unit.h"

#include "analysis/modal_fit.h"
#include "num/noise.h"

enum { RATE = 16000, N = 12000, MOST = 24 };

struct known {
    double f, d, gain, phase;
};

/* y[n] += sum gain e^(-d t) sin(2 pi f t + phase) of every sample of a force. */
static void sound(const struct known *m, int modes, const double *force, long pulse, long at, long n, double *y)
{
    for (int i = 0; i < modes; i++) {
        cplx p = cplx_exp((cplx){-m[i].d, 2.0 * REAL_PI * m[i].f}, 1.0 / RATE), x = {0};
        for (long k = at; k < n; k++) {
            x = cplx_mul(x, p);
            x.re += k - at < pulse ? force[k - at] : 0.0;
            y[k] += m[i].gain * (x.im * real_cos(m[i].phase) + x.re * real_sin(m[i].phase));
        }
    }
}

static const double one = 1.0;

/* Modes of a response in noise of that rms; its last bits as they fall with another seed. */
static void find(const struct known *m, int modes, double rms, unsigned seed, int flips, struct arena *a,
                 struct modal_result *r)
{
    double *y = ARENA_TAKE(a, double, N + 1), *noise = ARENA_TAKE(a, double, N + 1);
    struct err e = {0};
    sound(m, modes, &one, 1, 0, N + 1, y);
    noise_normal(noise_make(seed, "test"), 1, N + 1, noise);
    for (long i = 0; i <= N; i++)
        y[i] = (double)(float)(y[i] + rms * noise[i]);
    for (int k = 0; k < flips; k++)
        y[(97 + 331 * k) % N] *= 1.0 + 0x1p-24;
    struct modal_stretch s = {.y = y + 1, .first = 1, .n = modal_length(N), .fitted = true, .pulse = {0, 1, &one}};
    struct modal_data d = {.rate = RATE, .places = 1, .stretches = 1, .stretch = &s};
    struct modal_options o = {.most = 50, .low = 20, .high = 7800, .fastest = 0.02 * RATE};
    ck_assert_msg(modal_find(&d, &o, a, r, &e), "%s", e.text);
}

static const struct modal_mode *nearest(const struct modal_result *r, const struct known *m)
{
    const struct modal_mode *best = &r->mode[0];
    for (int i = 1; i < r->n; i++)
        if (fabs(r->mode[i].frequency - m->f) + 0.1 * fabs(r->mode[i].decay - m->d) <
            fabs(best->frequency - m->f) + 0.1 * fabs(best->decay - m->d))
            best = &r->mode[i];
    return best;
}

static double gain_se(const struct modal_mode *m, int g)
{
    return sqrt(m->gain[g].se * m->gain[g].se + m->gain[g].shared * m->gain[g].shared);
}

/* X of a pole, of a force within the stretch, before it and both, is the DFT of the recursion to 1e-10; dX/ds is its
 * slope over 1e-4/s to 1e-6. */
START_TEST(basis)
{
    const double force[3] = {0.3, 1.0, 0.4};
    struct arena *a = arena_open();
    for (long at = 40; at <= 540; at += 250) {
        double *y = ARENA_TAKE(a, double, 2000), room[3][8][MODAL_CHUNK];
        struct modal_stretch s = {.y = y, .first = 300, .n = 960, .fitted = true, .pulse = {at, 3, force}};
        struct modal_data d = {.rate = RATE, .places = 1, .stretches = 1, .stretch = &s};
        struct modal_options o = {.low = 900, .high = 1100, .fastest = 300};
        struct modal_fit f;
        const cplx pole = {-35.0, 2.0 * REAL_PI * 987.6};
        modal_fit_open(&f, &d, &o, a);
        for (int k = 0; k < 3; k++) {
            struct modal_line line = modal_fit_line(&f, 0, (cplx){pole.re + 1e-4 * (k - 1), pole.im});
            modal_fit_basis(&f.bins[0], &line, 0, 8, room[k]);
        }
        cplx p = cplx_exp(pole, 1.0 / RATE), state = {0}, sum[8] = {{0}};
        double largest = 0.0;
        for (long n = 0; n < 1260; n++) {
            state = cplx_mul(state, p);
            state.re += n >= at && n < at + 3 ? force[n - at] : 0.0;
            for (int k = 0; n >= 300 && k < 8; k++)
                sum[k] = cplx_add(
                    sum[k], cplx_mul(state, cplx_exp((cplx){0.0, -f.bins[0].width * (double)(f.bins[0].first + k)},
                                                     (double)(n - 300) / RATE)));
        }
        for (int k = 0; k < 8; k++)
            largest = fmax(largest, cplx_abs(sum[k]));
        for (int k = 0; k < 8; k++) {
            ck_assert_double_eq_tol(room[1][0][k] * sqrt(960.0), sum[k].re, 1e-10 * largest);
            ck_assert_double_eq_tol(room[1][1][k] * sqrt(960.0), sum[k].im, 1e-10 * largest);
            for (int c = 0; c < 2; c++) {
                double slope = (room[2][c][k] - room[0][c][k]) / 2e-4;
                ck_assert_double_eq_tol(room[1][2 + c][k], slope, 1e-6 * (fabs(slope) + largest));
            }
        }
    }
    arena_close(a);
}
END_TEST

/* Twelve random modes from 150 to 7000 Hz, levels over 20 dB, of each seed another draw: all of them, no other,
 * within five standard errors; half of all within 0.67. */
START_TEST(random_modes)
{
    double inside = 0.0, all = 0.0;
    for (unsigned seed = 1; seed <= 4; seed++) {
        struct arena *a = arena_open();
        struct noise source = noise_make(seed, "modes");
        struct known m[12];
        struct modal_result r;
        for (int i = 0; i < 12; i++) /* one in each part of the band, so that the noise lets one tell all */
            m[i] = (struct known){150.0 + 570.0 * (i + 0.7 * noise_uniform(source, 1, (uint64_t)i)),
                                  real_exp(real_log(4.0) + 2.5 * noise_uniform(source, 2, (uint64_t)i)),
                                  real_exp10(-noise_uniform(source, 3, (uint64_t)i)),
                                  6.0 * noise_uniform(source, 4, (uint64_t)i)};
        find(m, 12, 1e-3, seed, 0, a, &r);
        ck_assert_int_eq(r.n, 12);
        for (int i = 0; i < 12; i++) {
            const struct modal_mode *k = nearest(&r, &m[i]);
            double z[3] = {(k->frequency - m[i].f) / k->frequency_se, (k->decay - m[i].d) / k->decay_se,
                           (cplx_abs(k->gain[0].a) - m[i].gain) / gain_se(k, 0)};
            for (int q = 0; q < 3; q++) {
                ck_assert_double_le(fabs(z[q]), 5.0);
                inside += fabs(z[q]) < 0.674;
                all++;
            }
        }
        arena_close(a);
    }
    ck_assert_double_eq_tol(inside / all, 0.5, 4.0 * 0.5 / sqrt(all)); /* four standard deviations of a fair coin */
}
END_TEST

/* Two modes 2 Hz apart, two decays of one frequency, and one that is neither: as they are, under draws of noise and
   flips of last bits, which move a frequency by no more than a tenth of its standard error. */
START_TEST(pairs_and_slopes)
{
    static const struct known m[] = {
        {700, 9, 1, 0.4}, {702, 12, 0.4, 2}, {1500, 5, 0.3, 1}, {1500, 40, 1, 1}, {3000, 20, 0.2, 0}};
    for (unsigned seed = 1; seed <= 4; seed++) {
        struct arena *a = arena_open();
        struct modal_result r, flipped;
        find(m, 5, 1e-3, seed, 0, a, &r);
        find(m, 5, 1e-3, seed, 40, a, &flipped);
        ck_assert_int_eq(r.n, 5);
        ck_assert_int_eq(r.modes, 4);
        ck_assert_int_eq(flipped.n, 5);
        ck_assert(r.note && strstr(r.note, "decays with two slopes"));
        for (int i = 0; i < 5; i++) {
            const struct modal_mode *k = nearest(&r, &m[i]), *l = nearest(&flipped, &m[i]);
            ck_assert_double_eq_tol(k->frequency, m[i].f, 5.0 * k->frequency_se);
            ck_assert_double_eq_tol(k->decay, m[i].d, 5.0 * k->decay_se);
            ck_assert_double_eq_tol(k->frequency, l->frequency, 0.1 * k->frequency_se);
        }
        arena_close(a);
    }
}
END_TEST

/* White noise: nothing. */
START_TEST(noise_alone)
{
    for (unsigned seed = 1; seed <= 8; seed++) {
        struct arena *a = arena_open();
        struct modal_result r;
        find(NULL, 0, 1.0, seed, 0, a, &r);
        ck_assert_int_eq(r.n, 0);
        arena_close(a);
    }
}
END_TEST

/* Two strikes by a half sine, the second 0.15 s behind the first, with a lead that hums: the modes, and no hum. */
START_TEST(strikes_and_hum)
{
    enum { LEAD = 6000, PULSE = 6, GAP = 2400, ALL = 24000 };
    static const struct known m[] = {{310, 15, 1, 0}, {1700, 30, 0.5, 1}, {4400, 60, 0.7, 2}};
    double force[PULSE];
    struct arena *a = arena_open();
    double *y = ARENA_TAKE(a, double, ALL), *noise = ARENA_TAKE(a, double, ALL);
    struct modal_result r;
    struct err e = {0};
    for (int i = 0; i < PULSE; i++)
        force[i] = real_sin(REAL_PI * (i + 0.5) / PULSE);
    sound(m, 3, force, PULSE, LEAD, ALL, y);
    sound(m, 3, force, PULSE, LEAD + GAP, ALL, y);
    noise_normal(noise_make(3, "test"), 1, ALL, noise);
    for (long i = 0; i < ALL; i++)
        y[i] += 1e-3 * noise[i] + 0.02 * real_sin(2.0 * REAL_PI * 150.0 * (double)i / RATE);
    struct modal_stretch s[3] = {{.y = y, .n = modal_length(LEAD - 8), .strike = -1},
                                 {.y = y + LEAD - 8,
                                  .first = LEAD - 8,
                                  .n = modal_length(GAP),
                                  .ringing = 8 + PULSE,
                                  .fitted = true,
                                  .pulse = {LEAD, PULSE, force}},
                                 {.y = y + LEAD + GAP - 8,
                                  .first = LEAD + GAP - 8,
                                  .n = modal_length(ALL - LEAD - GAP),
                                  .ringing = 8 + PULSE,
                                  .strike = 1,
                                  .fitted = true,
                                  .pulse = {LEAD + GAP, PULSE, force}}};
    struct modal_data d = {.rate = RATE, .places = 1, .stretches = 3, .stretch = s};
    struct modal_options o = {.most = 50, .low = 20, .high = 7800, .fastest = 0.02 * RATE};
    ck_assert_msg(modal_find(&d, &o, a, &r, &e), "%s", e.text);
    ck_assert_int_eq(r.n, 3);
    ck_assert(strstr(r.note, "1 line does not decay (hum)"));
    for (int i = 0; i < 3; i++) {
        const struct modal_mode *k = nearest(&r, &m[i]);
        ck_assert_double_eq_tol(k->frequency, m[i].f, 5.0 * k->frequency_se);
        ck_assert_double_eq_tol(k->decay, m[i].d, 5.0 * k->decay_se);
        for (int g = 1; g < 3;
             g++) /* what rings on from the first strike, a tenth of the lowest mode, is none of the second's */
            ck_assert_double_eq_tol(cplx_abs(k->gain[g].a), m[i].gain, 5.0 * gain_se(k, g));
    }
    ck_assert_double_ge(r.explained[1], 0.999);
    arena_close(a);
}
END_TEST

/* Strikes of random levels, up to 20 dB apart, in time with modes that ring through all of them: most of what is heard
   after a strike is that of the ones before. */
START_TEST(strikes_in_time)
{
    enum { STRIKES = 8, PULSE = 6, GAP = 4000, ALL = STRIKES * GAP + 8 };
    static const struct known m[] = {{320, 0.3, 1, 0}, {888, 0.5, 0.7, 1}, {1700, 1, 0.5, 2}};
    for (unsigned seed = 1; seed <= 2; seed++) {
        double force[STRIKES][PULSE], level[STRIKES], draw[STRIKES];
        struct arena *a = arena_open();
        double *y = ARENA_TAKE(a, double, ALL), *noise = ARENA_TAKE(a, double, ALL);
        struct modal_stretch s[STRIKES];
        struct modal_result r;
        struct err e = {0};
        noise_normal(noise_make(seed, "levels"), 1, STRIKES, draw);
        noise_normal(noise_make(seed, "test"), 1, ALL, noise);
        for (int k = 0; k < STRIKES; k++) {
            level[k] = real_exp10(-fmin(fabs(draw[k]), 1.0));
            for (int i = 0; i < PULSE; i++)
                force[k][i] = level[k] * real_sin(REAL_PI * (i + 0.5) / PULSE);
            sound(m, 3, force[k], PULSE, k * GAP + 8, ALL, y);
            s[k] = (struct modal_stretch){.y = y + k * GAP,
                                          .first = k * GAP,
                                          .n = modal_length(GAP),
                                          .ringing = 8 + PULSE,
                                          .strike = k,
                                          .fitted = true,
                                          .pulse = {k * GAP + 8, PULSE, force[k]}};
        }
        for (long i = 0; i < ALL; i++)
            y[i] += 1e-4 * noise[i];
        struct modal_data d = {.rate = RATE, .places = 1, .stretches = STRIKES, .stretch = s};
        struct modal_options o = {.most = 50, .low = 20, .high = 7800, .fastest = 0.02 * RATE};
        ck_assert_msg(modal_find(&d, &o, a, &r, &e), "%s", e.text);
        ck_assert_int_eq(r.n, 3);
        for (int i = 0; i < 3; i++) {
            const struct modal_mode *k = nearest(&r, &m[i]);
            double before = 0.0; /* the squared error of what rings, as a force's */
            ck_assert_double_eq_tol(k->frequency, m[i].f, 5.0 * k->frequency_se);
            ck_assert_double_eq_tol(k->decay, m[i].d, 5.0 * k->decay_se);
            for (int g = 0; g < STRIKES; g++) {
                double se = gain_se(k, g) * level[g];
                ck_assert_double_eq_tol(cplx_abs(k->gain[g].a) * level[g], m[i].gain * level[g],
                                        5.0 * sqrt(before + se * se));
                before += se * se;
            }
        }
        for (int k = 0; k < STRIKES; k++)
            ck_assert_double_ge(r.explained[k], 0.999);
        arena_close(a);
    }
}
END_TEST

/* An object that rests anew each time: eight strikes whose frequencies differ by 5e-4 and decays by a tenth, at 80 dB.
   The modes that there are and no more, which poles that all strikes share would need; their means within 4 standard
   errors, their spread within what chance makes of eight draws (chi squared of 7 degrees beyond 1e-4, the measured one
   drawn to that of all modes). */
START_TEST(strikes_apart)
{
    enum { STRIKES = 8, GAP = 8000, ALL = STRIKES * GAP };
    static const struct known m[] = {{310, 15, 1, 0}, {1700, 30, 0.5, 1}, {2300, 20, 0.3, 2}, {4400, 60, 0.7, 2}};
    for (unsigned seed = 1; seed <= 2; seed++) {
        struct arena *a = arena_open();
        double *y = ARENA_TAKE(a, double, ALL), *noise = ARENA_TAKE(a, double, ALL), draw[STRIKES][8];
        struct modal_stretch s[STRIKES];
        struct modal_result r;
        struct err e = {0};
        noise_normal(noise_make(seed, "test"), 1, ALL, noise);
        for (int k = 0; k < STRIKES; k++) {
            noise_normal(noise_make(seed, "poles"), (unsigned)k + 1, 8, draw[k]);
            for (int i = 0; i < 4; i++) {
                struct known own = m[i];
                own.f *= 1.0 + 5e-4 * draw[k][2 * i];
                own.d *= real_exp(0.1 * draw[k][2 * i + 1]);
                sound(&own, 1, &one, 1, k * GAP + 8, (k + 1) * GAP, y);
            }
            s[k] = (struct modal_stretch){.y = y + k * GAP,
                                          .first = k * GAP,
                                          .n = modal_length(GAP),
                                          .ringing = 9,
                                          .strike = k,
                                          .fitted = true,
                                          .pulse = {k * GAP + 8, 1, &one}};
        }
        for (long i = 0; i < ALL; i++)
            y[i] += 1e-4 * noise[i];
        struct modal_data d = {.rate = RATE, .places = 1, .stretches = STRIKES, .stretch = s};
        struct modal_options o = {.most = 50, .low = 20, .high = 7800, .fastest = 0.02 * RATE};
        ck_assert_msg(modal_find(&d, &o, a, &r, &e), "%s", e.text);
        ck_assert_int_eq(r.n, 4);
        for (int i = 0; i < 4; i++) {
            const struct modal_mode *k = nearest(&r, &m[i]);
            ck_assert_double_eq_tol(k->frequency, m[i].f, 4.0 * 5e-4 * m[i].f / sqrt(STRIKES));
            ck_assert_double_eq_tol(real_log(k->decay / m[i].d), 0.0, 4.0 * 0.1 / sqrt(STRIKES));
            ck_assert_double_ge(k->frequency_between, 0.3 * 5e-4 * m[i].f);
            ck_assert_double_le(k->frequency_between, 2.0 * 5e-4 * m[i].f);
            ck_assert_double_ge(k->decay_between, 0.3 * 0.1 * m[i].d);
            ck_assert_double_le(k->decay_between, 2.0 * 0.1 * m[i].d);
        }
        for (int k = 0; k < STRIKES; k++)
            ck_assert_double_ge(r.explained[k], 0.999);
        arena_close(a);
    }
}
END_TEST

/* Twelve random modes under two strikes 0.15 or 0.3 s apart, of an object that does not rest anew: no spread shows, and
   each strike's poles must come back to the shared ones. All modes, no other, within five standard errors. */
START_TEST(strikes_alike)
{
    enum { PULSE = 5, MODES = 12, ALL = N };
    for (unsigned seed = 1; seed <= 4; seed++) {
        struct arena *a = arena_open();
        struct noise source = noise_make(seed, "two strikes");
        struct known m[MODES];
        struct modal_stretch s[2];
        struct modal_result r;
        struct err e = {0};
        double *y = ARENA_TAKE(a, double, ALL), *noise = ARENA_TAKE(a, double, ALL), force[PULSE];
        long at[3] = {8, 8 + (seed % 2 ? 2400 : 4800), ALL};
        noise_normal(source, 5, ALL, noise);
        for (int i = 0; i < PULSE; i++)
            force[i] = real_sin(REAL_PI * (i + 0.5) / PULSE);
        for (int i = 0; i < MODES; i++)
            m[i] = (struct known){150.0 + 570.0 * (i + 0.7 * noise_uniform(source, 1, (uint64_t)i)),
                                  real_exp(real_log(5.0) + 1.5 * noise_uniform(source, 2, (uint64_t)i)),
                                  real_exp10(-noise_uniform(source, 3, (uint64_t)i)),
                                  6.0 * noise_uniform(source, 4, (uint64_t)i)};
        for (int k = 0; k < 2; k++) {
            sound(m, MODES, force, PULSE, at[k], ALL, y);
            long first = at[k] - 8;
            s[k] = (struct modal_stretch){.y = y + first,
                                          .first = first,
                                          .n = modal_length((k ? ALL : at[1] - 8) - first),
                                          .ringing = 8 + PULSE,
                                          .strike = k,
                                          .fitted = true,
                                          .pulse = {at[k], PULSE, force}};
        }
        for (long i = 0; i < ALL; i++)
            y[i] += (seed % 4 < 2 ? 1e-3 : 1e-4) * noise[i];
        struct modal_data d = {.rate = RATE, .places = 1, .stretches = 2, .stretch = s};
        struct modal_options o = {.most = 50, .low = 20, .high = 7800, .fastest = 0.02 * RATE};
        ck_assert_msg(modal_find(&d, &o, a, &r, &e), "%s", e.text);
        ck_assert_int_eq(r.n, MODES);
        for (int i = 0; i < MODES; i++) {
            const struct modal_mode *k = nearest(&r, &m[i]);
            ck_assert_double_eq_tol(k->frequency, m[i].f, 5.0 * k->frequency_se);
            ck_assert_double_eq_tol(k->decay, m[i].d, 5.0 * k->decay_se);
        }
        arena_close(a);
    }
}
END_TEST

/* What the model leaves is not always white: noise that fades within 20 ms, 30 dB above what stays. Errors of two modes
   over their standard errors, rms over two recordings: 1 if they were those of that noise, 4.5 if it were taken for
   white. */
START_TEST(noise_that_fades)
{
    enum { LONG = 6000 };
    static const struct known m[] = {{800, 20, 1, 0}, {1500, 12, 0.6, 0}};
    double square = 0.0;
    for (unsigned seed = 1; seed <= 2; seed++) {
        struct arena *a = arena_open();
        struct modal_result r;
        struct err e = {0};
        double *y = ARENA_TAKE(a, double, LONG + 1), *noise = ARENA_TAKE(a, double, 2 * (LONG + 1));
        sound(m, 2, &one, 1, 0, LONG + 1, y);
        noise_normal(noise_make(seed, "fades"), 1, 2 * (LONG + 1), noise);
        for (long i = 0; i <= LONG; i++)
            y[i] += 1e-4 * noise[2 * i] + 3e-3 * real_exp(-(double)i / (0.02 * RATE)) * noise[2 * i + 1];
        struct modal_stretch s = {
            .y = y + 1, .first = 1, .n = modal_length(LONG), .fitted = true, .pulse = {0, 1, &one}};
        struct modal_data d = {.rate = RATE, .places = 1, .stretches = 1, .stretch = &s};
        struct modal_options o = {.most = 50, .low = 400, .high = 3900, .fastest = 600};
        ck_assert_msg(modal_find(&d, &o, a, &r, &e), "%s", e.text);
        for (int i = 0; i < 2; i++) {
            const struct modal_mode *k = nearest(&r, &m[i]);
            double off = (k->frequency - m[i].f) / k->frequency_se;
            ck_assert_double_eq_tol(k->frequency, m[i].f, 0.01);
            square += off * off / 4.0;
        }
        arena_close(a);
    }
    ck_assert_double_le(sqrt(square), 2.5);
}
END_TEST

UNIT("test_modal", strikes_apart, strikes_alike, noise_that_fades, basis, UNIT_PLAIN(random_modes),
     UNIT_PLAIN(pairs_and_slopes), noise_alone, strikes_and_hum, UNIT_PLAIN(strikes_in_time))
