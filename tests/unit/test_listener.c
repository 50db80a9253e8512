/* Gains at a listening place: other quantities by numeric differentiation, the monopole by its textbook formula and by
   filtering the velocity numerically, the way through the air. */
#include <complex.h>

#include "response/listener.h"
#include "unit.h"

#define RHO 1.204
#define C 343.2

static const double frequencies[] = {331.0, 1870.0, 9000.0}, decays[] = {9, 40, 300},
                    gains[][2] = {{1.2, 0.4}, {-0.7, 1.1}, {0.3, -0.2}};

static double at_touched(const struct modes *m, const struct modes_where *where, const struct modes_point *p)
{
    (void)where;
    for (int i = 0; i < m->n; i++) {
        p->re[i] = gains[i][0];
        p->im[i] = gains[i][1];
    }
    return 0;
}

/* A bell without an object, of three modes. */
static struct modes bell(int quantity, double radius)
{
    return (struct modes){.n = 3,
                          .quantity = quantity,
                          .shared = true,
                          .frequency = (double *)frequencies,
                          .decay = (double *)decays,
                          .radius = radius,
                          .name = "bell.csv",
                          .at = at_touched};
}

static struct output heard(int radiator, const double *places, int n)
{
    struct output o = {.quantity = QUANTITY_AUTO, .listen = {true, radiator, places, n, RHO, C}};
    return o;
}

struct heard {
    double f[4], d[4];
    double re[4], im[4];
    int n, quantity;
    long delay;
};

static struct heard listen(const struct output *o, const struct modes *m, int channel, double rate)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct heard h = {.f = {frequencies[0], frequencies[1], frequencies[2]}, .d = {decays[0], decays[1], decays[2]}};
    struct listener_ask ask = {o, channel, (const double[2]){0, 0}, rate, NULL};
    struct listener *l = listener_make(a, &ask, m, &e);
    struct modes_point p = {h.f, h.d, h.re, h.im};
    ck_assert_msg(l != NULL, "%s", e.text);
    m->at(m, &(struct modes_where){0, 0, 0}, &p);
    listener_apply(l, frequencies, decays, &p);
    h.n = m->n + listener_extra(l);
    h.quantity = listener_quantity(l);
    h.delay = listener_delay(l);
    arena_close(a);
    return h;
}

static void refused(const struct output *o, const struct modes *m, const char *why)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct listener_ask ask = {o, 0, (const double[2]){0, 0}, 48e3, NULL};
    ck_assert_ptr_null(listener_make(a, &ask, m, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(strstr(e.text, why) != NULL, "%s", e.text);
    arena_close(a);
}

/* Im sum A e^(s t) */
static long double sound_at(const struct heard *h, long double t)
{
    long double y = 0;
    for (int i = 0; i < h->n; i++)
        y += expl(-h->d[i] * t) * (h->re[i] * sinl(2 * M_PIl * h->f[i] * t) + h->im[i] * cosl(2 * M_PIl * h->f[i] * t));
    return y;
}

/* Asked for nothing else, every bit stays. */
START_TEST(the_contact_is_heard_as_it_is)
{
    struct modes m = bell(MODES_ACCELERATION, NAN);
    struct output o = {.quantity = QUANTITY_AUTO}, same = {.quantity = QUANTITY_ACCELERATION};
    const struct output *const both[] = {&o, &same};
    for (int k = 0; k < 2; k++) {
        struct heard h = listen(both[k], &m, 0, 48e3);
        ck_assert_int_eq(h.n, 3);
        ck_assert_int_eq(h.quantity, MODES_ACCELERATION);
        for (int i = 0; i < 3; i++)
            ck_assert(h.re[i] == gains[i][0] && h.im[i] == gains[i][1]);
    }
    ck_assert_int_eq(listener_channels(&o), 1);
}
END_TEST

/* The derivative of what is heard as displacement is what is heard as velocity, and so on: central differences of order
   4 in long double, steps of 1e-6 s: (w h)^4/30 of 9 kHz is 3e-7 of that mode. Whatever the table holds, three
   quantities fit together. */
START_TEST(quantities_are_derivatives)
{
    for (int held = MODES_DISPLACEMENT; held <= MODES_ACCELERATION; held++) {
        struct modes m = bell(held, NAN);
        struct heard h[3];
        double worst = 0;
        for (int q = 0; q < 3; q++) {
            struct output o = {.quantity = QUANTITY_DISPLACEMENT + q};
            h[q] = listen(&o, &m, 0, 48e3);
            ck_assert_int_eq(h[q].quantity, q);
        }
        for (int i = 0; i < 3; i++)
            ck_assert(h[held].re[i] == gains[i][0] && h[held].im[i] == gains[i][1]);
        for (int q = 0; q < 2; q++)
            for (int n = 0; n < 200; n++) {
                long double t = 1e-4L * n + 1e-5L, step = 1e-6L;
                long double slope = (8 * (sound_at(&h[q], t + step) - sound_at(&h[q], t - step)) -
                                     sound_at(&h[q], t + 2 * step) + sound_at(&h[q], t - 2 * step)) /
                                    (12 * step);
                double size = hypot(h[q + 1].re[0], h[q + 1].im[0]) + hypot(h[q + 1].re[1], h[q + 1].im[1]) +
                              hypot(h[q + 1].re[2], h[q + 1].im[2]);
                worst = fmax(worst, (double)fabsl(slope - sound_at(&h[q + 1], t)) / size);
            }
        printf("held %d: %.3g\n", held, worst);
        ck_assert_double_lt(worst, 1e-6);
    }
}
END_TEST

/* A mode of velocity A that hardly decays, as the pulsating sphere of Kinsler et al. 7.1: |p| = rho c v (a/r) ka /
   sqrt(1 + (ka)^2), which leads the velocity by arctan(1/ka); at three frequencies, and in the limits of a volume flow
   Q = 4 pi a^2 v (|p| = rho f Q / (2 r)) and a plane wave. The formula has real frequencies, the mode's decay of 1e-6
   /s is 1e-9 of them. */
START_TEST(monopole_level_and_phase)
{
    static const double tones[] = {10, 500, 2000, 8000, 20000}, decay[] = {1e-6, 1e-6, 1e-6, 1e-6, 1e-6};
    double place[3] = {0.3, -0.4, 1.2}, r = 1.3, a = 0.04;
    struct output o = heard(RADIATOR_MONOPOLE, place, 1);
    struct arena *arena = arena_open();
    struct err e = {0};
    struct modes m = bell(MODES_VELOCITY, a);
    m.n = 5, m.frequency = (double *)tones, m.decay = (double *)decay;
    struct listener_ask ask = {&o, 0, (const double[2]){0, 0}, 48e3, NULL};
    struct listener *l = listener_make(arena, &ask, &m, &e);
    ck_assert_msg(l != NULL, "%s", e.text);
    double f[6], d[6], re[6] = {1, 1, 1, 1, 1}, im[6] = {0};
    listener_apply(l, tones, decay, &(struct modes_point){f, d, re, im});
    for (int i = 0; i < 5; i++) {
        double ka = 2 * M_PI * tones[i] * a / C, level = RHO * C * a / r * ka / sqrt(1 + ka * ka), phase = atan(1 / ka);
        printf("%g Hz: ka %.4g, %.2f dB re 1 Pa s/m, leads by %.3f rad\n", tones[i], ka,
               20 * log10(hypot(re[i], im[i])), atan2(im[i], re[i]));
        ck_assert_double_eq_tol(hypot(re[i], im[i]) / level, 1, 1e-7);
        ck_assert_double_eq_tol(atan2(im[i], re[i]), phase, 1e-7);
    }
    ck_assert_double_eq_tol(hypot(re[0], im[0]) / (RHO * 10 * 4 * M_PI * a * a / (2 * r)), 1,
                            1e-4);                                             /* (ka)^2/2 = 2.7e-5 */
    ck_assert_double_eq_tol(hypot(re[4], im[4]) / (RHO * C * a / r), 1, 3e-3); /* 1/(2 (ka)^2) = 2.3e-3 */
    arena_close(arena);
}
END_TEST

/* The whole response against the velocity, filtered: H = K s/(s + w) is p = K (v - w q), dq/dt = v - w q, integrated by
   Runge and Kutta's rule in long double, 2e-8 s a step (error (w h)^4 of the fastest, 1e-14). Also of a table of
   displacement, and of acceleration. */
START_TEST(monopole_is_the_filtered_velocity)
{
    double place[3] = {0, 0, 0.5}, a = 0.012;
    struct output o = heard(RADIATOR_MONOPOLE, place, 1);
    for (int held = MODES_DISPLACEMENT; held <= MODES_ACCELERATION; held++) {
        struct modes m = bell(held, a);
        struct output plain = {.quantity = QUANTITY_VELOCITY};
        struct heard v = listen(&plain, &m, 0, 48e3), p = listen(&o, &m, 0, 48e3);
        long double q = 0, h = 2e-8L, w = C / a, worst = 0, most = 0;
        ck_assert_int_eq(p.n, 4);
        ck_assert_int_eq(p.quantity, MODES_PRESSURE);
        ck_assert(p.f[3] == 0 && fabs(p.d[3] / (C / a) - 1) < 1e-15 && p.re[3] == 0);
        for (int n = 0; n < 50000; n++) {
            long double t = n * h, v0 = sound_at(&v, t), v1 = sound_at(&v, t + h / 2), v2 = sound_at(&v, t + h);
            long double k1 = v0 - w * q, k2 = v1 - w * (q + h / 2 * k1), k3 = v1 - w * (q + h / 2 * k2),
                        k4 = v2 - w * (q + h * k3);
            long double want = RHO * C * a / 0.5L * (v0 - w * q);
            worst = fmaxl(worst, fabsl(sound_at(&p, t) - want));
            most = fmaxl(most, fabsl(want));
            q += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        }
        printf("held %d: off by %.3Lg of %.3Lg Pa\n", held, worst, most);
        ck_assert(worst < 1e-12L * most);
    }
}
END_TEST

/* No response at 0 Hz: the direct term of all components together is nothing beside one of them. Of an object whose own
   pole would decay within a sample there is no such component, and the direct term is rho a^2/r times the jump of the
   velocity. */
START_TEST(monopole_has_no_constant_pressure)
{
    double place[3] = {0, 0, 2};
    struct output o = heard(RADIATOR_MONOPOLE, place, 1);
    struct modes large = bell(MODES_VELOCITY, 0.03), small = bell(MODES_VELOCITY, 1e-4);
    struct heard h = listen(&o, &large, 0, 48e3), s = listen(&o, &small, 0, 48e3);
    double one = RHO * 0.03 * 0.03 / 2 * (gains[0][1] + gains[1][1] + gains[2][1]), tiny = one / 9e4;
    ck_assert_double_eq_tol(modes_direct(MODES_PRESSURE, h.n, h.f, h.d, &(struct modes_point){h.f, h.d, h.re, h.im}), 0,
                            1e-15 * one);
    ck_assert_int_eq(s.n, 3);
    /* (s_i + w is w but for 9 kHz: 1.6 %, in quadrature) */
    ck_assert_double_eq_tol(
        modes_direct(MODES_PRESSURE, s.n, s.f, s.d, &(struct modes_point){s.f, s.d, s.re, s.im}) / tiny, 1, 0.02);
}
END_TEST

/* Two listening places: the far one hears the near one's response (but for the level, 1/r) later by (r2 - r1)/c, in
   whole samples and a rest, to rounding; an object elsewhere is nearer to the other one. */
START_TEST(far_places_hear_it_later)
{
    double places[6] = {0, 0, 1, 0.6, 0.9, 1.4}, rate = 44100;
    double r2 = sqrt(0.36 + 0.81 + 1.96), late = (r2 - 1) / C * rate;
    struct output o = heard(RADIATOR_MONOPOLE, places, 2);
    struct modes m = bell(MODES_VELOCITY, 0.05);
    struct heard near = listen(&o, &m, 0, rate), far = listen(&o, &m, 1, rate);
    double most = 0;
    ck_assert_int_eq(listener_channels(&o), 2);
    ck_assert_int_eq(near.delay, 0);
    ck_assert_int_eq(far.delay, (long)ceil(late));
    ck_assert_double_gt(fabs(late - rint(late)), 0.1);
    for (int n = 0; n < 1000; n++)
        most = fmax(most, (double)fabsl(sound_at(&near, n / (long double)rate)));
    for (int n = 0; n < 1000; n++)
        ck_assert_double_eq_tol((double)sound_at(&far, n / (long double)rate) * r2,
                                (double)sound_at(&near, ((double)far.delay + n - late) / rate), 1e-12 * most);
}
END_TEST

START_TEST(what_cannot_be_is_refused)
{
    double inside[3] = {0, 0.01, 0.03}, beyond[3] = {0, 0, 1};
    struct modes unknown = bell(MODES_VELOCITY, NAN), known = bell(MODES_VELOCITY, 0.04);
    struct output o = heard(RADIATOR_MONOPOLE, inside, 1), out = heard(RADIATOR_MONOPOLE, beyond, 1);
    refused(&out, &unknown, "bell.csv does not say how large");
    refused(&o, &known, "inside the sphere of 0.04 m radius");
    out.listen.radiator = RADIATOR_PLATE;
    refused(&out, &known, "not a plate");
    out.listen.radiator = RADIATOR_POINT;
    refused(&out, &known, "mode shapes are known");
    out.listen.radiator = RADIATOR_MONOPOLE;
    out.quantity = QUANTITY_VELOCITY;
    refused(&out, &known, "leave output.quantity out");
}
END_TEST

/* The middle of a box, of a shell, the object's origin: distances by hand. */
START_TEST(distances_are_from_the_middle)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct object bar = {.shape = OBJECT_BAR, .low = {0, 0}, .high = {0.4, 0.02}, .radius = 0.05},
                  shell = {.shape = OBJECT_SHELL, .high = {0.9, 0}, .radius = 0.3};
    struct modes m = bell(MODES_VELOCITY, 0.05), s = bell(MODES_VELOCITY, 0.3);
    double place[3] = {1.2, 2.01, 0.7}, origin[2] = {1, 2}, d[4], f[4], re[2][4] = {{1, 1, 1}, {1, 1, 1}},
           im[2][4] = {{0}};
    struct output o = heard(RADIATOR_MONOPOLE, place, 1);
    struct listener_ask ask = {&o, 0, origin, 48e3, NULL};
    m.object = &bar, s.object = &shell;
    const struct modes *const both[] = {&m, &s};
    const double r[] = {0.7, sqrt(0.2 * 0.2 + 0.01 * 0.01 + 1)};
    for (int k = 0; k < 2; k++) {
        struct listener *l = listener_make(a, &ask, both[k], &e);
        ck_assert_msg(l != NULL, "%s", e.text);
        listener_apply(l, frequencies, decays, &(struct modes_point){f, d, re[k], im[k]});
        double ka = 2 * M_PI * frequencies[1] * both[k]->radius / C;
        ck_assert_double_eq_tol(hypot(re[k][1], im[k][1]), RHO * C * both[k]->radius / r[k] * ka / sqrt(1 + ka * ka),
                                1e-2 * RHO * C * both[k]->radius / r[k]);
    }
    arena_close(a);
}
END_TEST

UNIT("listener", the_contact_is_heard_as_it_is, quantities_are_derivatives, monopole_level_and_phase,
     monopole_is_the_filtered_velocity, monopole_has_no_constant_pressure, far_places_hear_it_later,
     what_cannot_be_is_refused, distances_are_from_the_middle)
