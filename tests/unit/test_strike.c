/* strike: sub-interval means against quadrature of the force itself, momentum and spectra at many rates against closed
   forms, times and momenta of bounce trains against their sums, and what is refused. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_gamma.h>

#include "contacts.h"
#include "force/strike.h"
#include "scene/material.h"

static const double rates[] = {8000, 22050, 44100, 48000, 96000, 192000};
enum { RATES = sizeof rates / sizeof rates[0] };

static struct contact striker(int pulse, double stiffness, double speed)
{
    struct contact c = shot_contact(CONTACT_STRIKE, 1);
    shot_strike(&c)->pulse = pulse;
    shot_strike(&c)->stiffness = stiffness;
    shot_strike(&c)->speed = speed;
    return c;
}

static const struct strike *of(const struct contact *c) { return params_of(c, strike_stage.params); }

/* The stiffness that gives this contact time to c's mass and speed. */
static double stiffness_for(const struct contact *c, double lasts)
{
    double m = c->scraper.mass, v = of(c)->speed;
    return of(c)->pulse == PULSE_HALF_SINE ? m * (M_PI / lasts) * (M_PI / lasts)
                                           : 1.25 * m * v * v / pow(lasts * v / 2.9432751843247045, 2.5);
}

/* ------------------------------------------------------------------ means */

struct pulse_force {
    const struct contact *c;
    double start, lasts;
};

/* The force at an instant, N. Of hertz from the penetration: q = I_u(2/5, 1/2) / 2 is solved for u = y^2.5 by
 * bisection. */
static double force_at(double t, void *self)
{
    const struct pulse_force *p = self;
    double q = (t - p->start) / p->lasts, m = p->c->scraper.mass, v = of(p->c)->speed, k = of(p->c)->stiffness, low = 0,
           high = 1;
    if (q <= 0 || q >= 1) return 0;
    if (of(p->c)->pulse == PULSE_HALF_SINE) return v * sqrt(k * m) * sin(M_PI * q);
    q = q > 0.5 ? 1 - q : q;
    for (int i = 0; i < 60; i++) {
        double u = 0.5 * (low + high);
        if (gsl_sf_beta_inc(0.4, 0.5, u) < 2 * q)
            low = u;
        else
            high = u;
    }
    return k * pow(1.25 * m * v * v / k * low, 0.6);
}

/* Means of 40 sub-intervals per pulse or so, against adaptive quadrature: 1e-12 of the largest force. (The reference of
   hertz, near u = 1, is good to a few 1e-13.) */
START_TEST(means_are_those_of_the_force)
{
    gsl_integration_workspace *w = gsl_integration_workspace_alloc(2000);
    gsl_set_error_handler_off();
    for (int pulse = PULSE_HALF_SINE; pulse <= PULSE_HERTZ; pulse++) {
        struct contact c = striker(pulse, 0, 1.3);
        struct shot s;
        shot_strike(&c)->first = 1.2345e-3;
        shot_strike(&c)->stiffness = stiffness_for(&c, 3.3e-4);
        struct pulse_force p = {&c, 1.2345e-3, 3.3e-4};
        gsl_function f = {force_at, &p};
        ck_assert(shot_open(&s, &strike_stage, &c, 48000, 3));
        const double *force = shot_force(&s, 200);
        double peak = force_at(1.2345e-3 + 1.65e-4, &p), dt = 1.0 / (3 * 48000), worst = 0;
        for (int i = 0; i < 600; i++) {
            double lo = fmax(i * dt, p.start), hi = fmin((i + 1) * dt, p.start + p.lasts), mean = 0, error;
            if (hi > lo) gsl_integration_qags(&f, lo, hi, 1e-14 * peak * dt, 1e-13, 2000, w, &mean, &error);
            worst = fmax(worst, fabs(force[i] - mean / dt) / peak);
        }
        ck_assert_double_le(worst, 1e-12);
        arena_close(s.arena);
    }
    gsl_integration_workspace_free(w);
}
END_TEST

/* Peak force: v sqrt(k m), and k x_m^1.5; a mean over 1/2000 of the pulse is below it by 1e-7 of it or so. */
START_TEST(peak_force)
{
    for (int pulse = PULSE_HALF_SINE; pulse <= PULSE_HERTZ; pulse++) {
        struct contact c = striker(pulse, 0, 0.8);
        struct shot s;
        double k = shot_strike(&c)->stiffness = stiffness_for(&c, 2e-3), m = 0.02, v = 0.8, peak = 0;
        ck_assert(shot_open(&s, &strike_stage, &c, 48000, 21));
        const double *force = shot_force(&s, 400);
        for (int i = 0; i < 400 * 21; i++)
            peak = fmax(peak, force[i]);
        double want = pulse == PULSE_HALF_SINE ? v * sqrt(k * m) : k * pow(1.25 * m * v * v / k, 0.6);
        ck_assert_double_eq_tol(peak, want, 1e-6 * want);
        arena_close(s.arena);
    }
}
END_TEST

/* ------------------------------------------------------------------ the same at any rate */

/* From a tenth of a sample to 2000 samples, at every rate and oversampling, sub-samples and decimated: the sum of n
   terms is 2 m v to a few 1e-16 n; the decimator's gain at 0 is 1 to rounding, and what it leaves of the images of 0 is
   1e-6 of them (num/filter.h). */
START_TEST(momentum_is_kept)
{
    for (int r = 0; r < RATES; r++)
        for (int over = 1; over <= 32; over *= 4)
            for (int pulse = PULSE_HALF_SINE; pulse <= PULSE_HERTZ; pulse++)
                for (double samples = 0.1; samples < 2100; samples *= 9.9) {
                    struct contact c = striker(pulse, 0, 2);
                    struct shot s;
                    double sum = 0, all = 0, want = 2 * 0.02 * 2;
                    shot_strike(&c)->first = 1.7e-3;
                    shot_strike(&c)->stiffness = stiffness_for(&c, samples / rates[r]);
                    ck_assert(shot_open(&s, &strike_stage, &c, rates[r], over));
                    const double *force = shot_decimated(&s, 3500), *means = board_at(&s.board, ITEM_SUBFORCE, 0);
                    for (long i = 0; i < 3500L * over; i++)
                        sum += means[i];
                    for (long i = 0; i < 3500; i++)
                        all += force[i];
                    ck_assert_double_eq_tol(sum / (rates[r] * over), want, 1e-13 * want);
                    ck_assert_double_eq_tol(all / rates[r], want, 1e-6 * want);
                    arena_close(s.arena);
                }
}
END_TEST

/* The same from the contact's first sample on, at random: both pulses, stiffnesses from 1e5 to 1e13, impacts that begin
   0 to 6 samples after the start, some of them there or on a sample, with restitution and without. Time of arrival,
   too, of what the sub-intervals hold: the kernel's images weigh it by 2e-3 of a sample at most (at one sub-interval a
   sample; 5e-4 at more). */
START_TEST(momentum_from_the_start)
{
    srand48(24);
    for (int trial = 0; trial < 400; trial++) {
        double rate = rates[(int)(RATES * drand48())], m = 0.02, v = exp2(6 * drand48() - 4);
        double lost = drand48() < 0.5 ? 1 : drand48(), sum = 0, late = 0, due = 0;
        int over = 1 + (int)(64 * pow(drand48(), 3));
        struct contact c = striker(drand48() < 0.5 ? PULSE_HALF_SINE : PULSE_HERTZ, pow(10, 5 + 8 * drand48()), v);
        struct shot s;
        double first = 6 * drand48() - 1;
        shot_strike(&c)->first = (first < 0 ? 0 : drand48() < 0.2 ? floor(first) : first) / rate;
        shot_strike(&c)->count = 1;
        shot_strike(&c)->restitution = lost;
        ck_assert_msg(shot_open(&s, &strike_stage, &c, rate, over), "%s", s.e.text);
        long n = (long)(0.02 * rate) + 100; /* 1.4 ms of contact at most */
        const double *force = shot_decimated(&s, n), *means = board_at(&s.board, ITEM_SUBFORCE, 0);
        double want = m * v * (1 + lost);
        for (long i = 0; i < n; i++) {
            sum += force[i] / rate;
            late += (double)i * force[i] / rate;
        }
        for (long i = 0; i < n * over; i++)
            due += ((double)i + 0.5) / over * means[i] / (rate * over);
        ck_assert_double_eq_tol(sum, want, 1e-6 * want);
        ck_assert_double_eq_tol(late, due, (over > 1 ? 5e-4 : 2e-3) * want);
        arena_close(s.arena);
    }
}
END_TEST

static double magnitude(const double *x, long n, double rate, double f)
{
    double re = 0, im = 0;
    for (long i = 0; i < n; i++) {
        re += x[i] * cos(2 * M_PI * f * (double)i / rate);
        im += x[i] * sin(2 * M_PI * f * (double)i / rate);
    }
    return sqrt(re * re + im * im) / rate;
}

/* Spectrum of a half sine: 2 m v |cos(pi f t_c) / (1 - (2 f t_c)^2)|, at the third octaves from 50 Hz to 8 kHz. Its
   images from beyond the sub-rate are weaker than 1/(2 f t_c)^2 of it at f = 8 x 22 kHz - 8 kHz, times the means' own
   gain there, f_3/f: 5e-6 of 2 m v. */
START_TEST(spectrum_is_that_of_a_half_sine)
{
    double lasts = 0.7e-3, want = 2 * 0.02 * 1.5;
    for (int r = 1; r < RATES; r++) {
        struct contact c = striker(PULSE_HALF_SINE, 0, 1.5);
        struct shot s;
        shot_strike(&c)->first = 2e-3;
        shot_strike(&c)->stiffness = stiffness_for(&c, lasts);
        ck_assert(shot_open(&s, &strike_stage, &c, rates[r], 8));
        long n = (long)(0.006 * rates[r]);
        const double *force = shot_decimated(&s, n);
        for (int band = 0; band < 23; band++) {
            double f = 1000 * exp2((band - 13) / 3.0), x = 2 * f * lasts;
            double exact = want * fabs(fabs(x - 1) < 1e-9 ? M_PI / 4 : cos(M_PI * f * lasts) / (1 - x * x));
            ck_assert_double_eq_tol(magnitude(force, n, rates[r], f), exact, 5e-6 * want);
        }
        arena_close(s.arena);
    }
}
END_TEST

/* Hertz's spectrum has no closed form: the same at every rate and oversampling, as at the finest. */
START_TEST(hertz_has_one_spectrum)
{
    double finest[23], want = 2 * 0.02 * 1.5;
    for (int r = RATES - 1; r > 0; r--) {
        struct contact c = striker(PULSE_HERTZ, 0, 1.5);
        struct shot s;
        shot_strike(&c)->first = 2e-3;
        shot_strike(&c)->stiffness = stiffness_for(&c, 0.7e-3);
        ck_assert(shot_open(&s, &strike_stage, &c, rates[r], 8));
        long n = (long)(0.006 * rates[r]);
        const double *force = shot_decimated(&s, n);
        for (int band = 0; band < 23; band++) {
            double now = magnitude(force, n, rates[r], 1000 * exp2((band - 13) / 3.0));
            finest[band] = r == RATES - 1 ? now : finest[band];
            ck_assert_double_eq_tol(now, finest[band], 5e-6 * want);
        }
        arena_close(s.arena);
    }
}
END_TEST

/* ------------------------------------------------------------------ several */

START_TEST(bounces_follow_the_sum)
{
    double e = 0.83, v = 1.1, g = 9.80665, m = 0.02, k = 1e8, first = 0.25;
    struct contact c = striker(PULSE_HERTZ, k, v);
    struct strike_train s;
    struct strike_impact i;
    struct err err = {0};
    long n = 0;
    double contacts = 0;
    shot_strike(&c)->first = first;
    shot_strike(&c)->restitution = e;
    ck_assert(strike_make(&c, 100, &s, &err));
    for (; strike_next(&s, &i); n++) {
        double speed = v * pow(e, (double)n),
               start = first + contacts + 2 * v / g * e * (1 - pow(e, (double)n)) / (1 - e);
        ck_assert_double_eq_tol(i.start, start, 1e-13 * start);
        ck_assert_double_eq_tol(i.speed, speed, 1e-13 * speed);
        ck_assert_double_eq_tol(i.lasts, 2.9432751843247 * pow(5 * m / (4 * k), 0.4) * pow(speed, -0.2),
                                1e-13 * i.lasts);
        ck_assert_double_eq_tol(i.momentum, m * speed * (1 + e), 1e-13 * i.momentum);
        contacts += i.lasts;
    }
    /* at rest: the last flight would have been shorter than the contact after it */
    double last = v * pow(e, (double)n - 1);
    ck_assert_int_eq(s.over, STRIKE_RESTS);
    ck_assert_double_lt(2 * e * last / g, 2.9432751843247 * pow(5 * m / (4 * k), 0.4) * pow(e * last, -0.2));
    /* beside the contacts all flights last 2 v e / (g (1 - e)), less those after the end */
    ck_assert_double_eq_tol(i.start - contacts - first, 2 * v / g * e / (1 - e),
                            2 * v / g * e / (1 - e) * pow(e, (double)n) + 1e-12);
}
END_TEST

START_TEST(bounces_hand_over_their_momentum)
{
    double e = 0.6, v = 0.9, m = 0.02, sum = 0;
    for (int over = 1; over <= 8; over *= 8) {
        struct contact c = striker(PULSE_HERTZ, 1e9, v);
        struct shot s;
        shot_strike(&c)->restitution = e;
        shot_strike(&c)->count = 4;
        ck_assert(shot_open(&s, &strike_stage, &c, 44100, over));
        const double *force = shot_force(&s, 40000);
        sum = 0;
        for (long i = 0; i < 40000L * over; i++)
            sum += force[i] / (44100 * over);
        double want = m * v * (1 + e) * (1 - pow(e, 4)) / (1 - e);
        ck_assert_double_eq_tol(sum, want, 1e-12 * want);
        ck_assert_int_eq(s.board.n_warnings, 0);
        arena_close(s.arena);
    }
}
END_TEST

/* Share of a half sine's momentum at q, in closed form. */
static double sine_share(double q) { return q <= 0 ? 0 : q >= 1 ? 1 : 0.5 - 0.5 * cos(M_PI * q); }

/* 1e5 impacts a second at 8 kHz: a dozen in each sub-interval, those at its borders in two; and the n-th begins where
 * it should. */
START_TEST(repeated_impacts)
{
    struct contact c = striker(PULSE_HALF_SINE, 0, 1);
    struct shot s;
    shot_strike(&c)->interval = 1e-5;
    shot_strike(&c)->stiffness = stiffness_for(&c, 0.9e-5);
    ck_assert(shot_open(&s, &strike_stage, &c, 8000, 1));
    const double *force = shot_force(&s, 8000);
    for (int i = 0; i < 7990; i++) {
        double want = 0;
        for (int n = (int)(12.5 * i) - 2; n < 12.5 * i + 15; n++)
            if (n >= 0)
                want +=
                    sine_share(((i + 1) / 8000.0 - n * 1e-5) / 0.9e-5) - sine_share((i / 8000.0 - n * 1e-5) / 0.9e-5);
        ck_assert_double_eq_tol(force[i], 2 * 0.02 * 8000 * want, 1e-6);
    }
    arena_close(s.arena);
    struct strike_train t;
    struct strike_impact i;
    struct err e = {0};
    ck_assert(strike_make(&c, 1, &t, &e));
    for (long n = 0; strike_next(&t, &i); n++)
        ck_assert_double_eq_tol(i.start, 1e-5 * (double)n, 1e-15);
    ck_assert_int_eq(t.number, 100000);
    ck_assert_int_eq(t.over, STRIKE_TIME);
}
END_TEST

/* Where a sub-interval begins does not depend on how late it is. */
START_TEST(an_hour_later_the_same)
{
    struct contact c = striker(PULSE_HERTZ, 1e8, 1);
    struct shot now, later;
    shot_strike(&c)->first = 1.0 / 1024;
    ck_assert(shot_open(&now, &strike_stage, &c, 48000, 4));
    const double *force = shot_force(&now, 100);
    c.motion.duration = 4000;
    shot_strike(&c)->first = 3600 + 1.0 / 1024;
    ck_assert(shot_open(&later, &strike_stage, &c, 48000, 4));
    shot_room(&later, ITEM_SUBFORCE, 4, 100);
    later.board.signals[ITEM_SUBFORCE].first = 3600L * 48000;
    ck_assert(strike_stage.run(&later.run, 3600L * 48000, 3600L * 48000 + 100, &later.e));
    ck_assert_mem_eq(board_at(&later.board, ITEM_SUBFORCE, 3600L * 48000), force, 400 * sizeof *force);
    arena_close(now.arena);
    arena_close(later.arena);
}
END_TEST

/* ------------------------------------------------------------------ how it ends, what is refused */

static const char *warning(struct contact *c)
{
    static char text[300];
    struct shot s;
    ck_assert_msg(shot_open(&s, &strike_stage, c, 48000, 4), "%s", s.e.text);
    snprintf(text, sizeof text, "%s", s.board.n_warnings ? s.board.warnings[0] : "");
    arena_close(s.arena);
    return text;
}

START_TEST(left_out_impacts_are_told)
{
    struct contact c = striker(PULSE_HERTZ, 1e8, 1);
    ck_assert_str_eq(warning(&c), "");
    shot_strike(&c)->interval = 0.3;
    ck_assert_str_eq(warning(&c), "");
    shot_strike(&c)->count = 4;
    ck_assert_str_eq(warning(&c), "");
    shot_strike(&c)->count = 5;
    ck_assert_str_eq(warning(&c),
                     "contact 'tap': 4 of 5 impacts take place: the next one would not be over by the motion's end");
    shot_strike(&c)->interval = NAN;
    shot_strike(&c)->restitution = 0.5;
    shot_strike(&c)->count = 0;
    ck_assert_str_eq(warning(&c), "");
    shot_strike(&c)->count = 1000;
    ck_assert(strstr(warning(&c), "of 1000 impacts take place: what bounces has then come to rest"));
}
END_TEST

/* The ramp at the scene's start: told of what begins within it. */
START_TEST(faded_impacts_are_told)
{
    for (int k = 0; k < 4; k++) {
        struct contact c = striker(PULSE_HERTZ, 1e8, 1);
        shot_strike(&c)->first = k == 1 ? 0.011 : 0.005;
        c.start = k == 2 ? 0.006 : 0;
        struct shot s;
        shot_ramp = k == 3 ? 0 : 0.01;
        ck_assert(shot_open(&s, &strike_stage, &c, 48000, 4));
        ck_assert_int_eq(s.board.n_warnings, k == 0);
        if (k == 0)
            ck_assert(strstr(
                s.board.warnings[0],
                "the first impact comes 0.005 s after the scene's start and is faded in by output.ramp, 0.01 s"));
        arena_close(s.arena);
    }
}
END_TEST

static void refused(const struct contact *c, const char *says)
{
    struct shot s;
    ck_assert_msg(!shot_open(&s, &strike_stage, c, 48000, 4), "accepted: %s", says);
    ck_assert_int_eq(s.e.kind, ERR_SCENE);
    ck_assert_msg(strstr(s.e.text, says) && strstr(s.e.text, "'tap'"), "%s", s.e.text);
    arena_close(s.arena);
}

START_TEST(what_cannot_be_is_refused)
{
    struct contact good = striker(PULSE_HERTZ, 1e8, 1), c = good;
    shot_strike(&c)->count = 2;
    shot_strike(&c)->interval = 1e-5;
    refused(&c, "is shorter than an impact");
    c = good;
    shot_strike(&c)->first = 1;
    refused(&c, "raise motion.duration");
    c = good;
    shot_strike(&c)->stiffness = NAN;
    refused(&c, "scraper.radius");
    c.scraper.radius = 0.01;
    refused(&c, "give scraper.material");
}
END_TEST

/* k = 4/3 sqrt(R) E*: a steel ball of 10 mm radius (200 GPa, 0.29) on glass (70 GPa, 0.22), by hand: 1/E* = 0.9159 /
 * 200e9 + 0.9516 / 70e9 = 1.81738e-11. */
START_TEST(stiffness_of_materials)
{
    struct contact c = striker(PULSE_HERTZ, NAN, 1);
    struct err e = {0};
    double k;
    c.scraper.radius = 0.01;
    c.scraper.response.object =
        (struct object_given){.youngs_modulus = 200e9, .youngs_modulus_across = NAN, .poisson = 0.29};
    c.surface.response.object =
        (struct object_given){.youngs_modulus = 70e9, .youngs_modulus_across = NAN, .poisson = 0.22};
    ck_assert(strike_stiffness(&c, &k, &e));
    ck_assert_double_eq_tol(k, 4.0 / 3 * 0.1 / 1.8173786e-11, 1e-6 * k);
    const struct material *steel = material_find(MATERIAL_STEEL), *oak = material_find(MATERIAL_OAK);
    c.scraper.response.object = (struct object_given){
        .material = MATERIAL_STEEL, .youngs_modulus = NAN, .youngs_modulus_across = NAN, .poisson = NAN};
    c.surface.response.object = (struct object_given){
        .material = MATERIAL_OAK, .youngs_modulus = NAN, .youngs_modulus_across = NAN, .poisson = NAN};
    ck_assert(strike_stiffness(&c, &k, &e));
    double flexible =
        (1 - steel->poisson * steel->poisson) / steel->youngs_modulus + (1 - oak->poisson * oak->poisson) / oak->across;
    ck_assert_double_eq_tol(k, 4.0 / 3 * 0.1 / flexible, 1e-14 * k);
    c.surface.response.object.youngs_modulus = 11e9; /* a key wins over the material, in all directions */
    ck_assert(strike_stiffness(&c, &k, &e));
    flexible = (1 - steel->poisson * steel->poisson) / steel->youngs_modulus + (1 - oak->poisson * oak->poisson) / 11e9;
    ck_assert_double_eq_tol(k, 4.0 / 3 * 0.1 / flexible, 1e-14 * k);
}
END_TEST

UNIT("strike", means_are_those_of_the_force, peak_force, momentum_is_kept, momentum_from_the_start,
     spectrum_is_that_of_a_half_sine, hertz_has_one_spectrum, bounces_follow_the_sum, bounces_hand_over_their_momentum,
     repeated_impacts, an_hour_later_the_same, left_out_impacts_are_told, faded_impacts_are_told,
     what_cannot_be_is_refused, stiffness_of_materials)
