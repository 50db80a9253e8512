/* Rayleigh's integral over mode shapes: Wallace's closed form of supported plates' modes, the baffled circular piston
   on its axis and far away, slow plain sums of another rule close by. Objects here are the test's own. */
#include <complex.h>

#include "response/listener.h"
#include "response/radiator.h"
#include "unit.h"

#define RHO 1.204
#define C 343.2
#define LX 0.42
#define LY 0.27

enum { MODES = 3 };

struct bodywork {
    struct object object;
    struct modes modes;
    double listen[2], origin[2], frequency[MODES], decay[MODES];
    double (*shape)(int mode, double x, double y);
};

/* The mode's complex velocity per phi phi / m: whatever it is, it must not matter. */
static const double complex velocity[MODES] = {0.3 - 0.1 * I, -1.7 * I, 2.2 + 0.4 * I};

static const int waves[MODES][2] = {{1, 1}, {3, 2}, {2, 5}};

static double supported(int mode, double x, double y)
{
    return sin(waves[mode][0] * M_PI * x / LX) * sin(waves[mode][1] * M_PI * y / LY);
}

static double piston(int mode, double x, double y)
{
    (void)mode, (void)x, (void)y;
    return 2;
}

/* Far more waves than the number of modes lets expect. */
static double ripples(int mode, double x, double y)
{
    return sin((23 + mode) * M_PI * x / LX) * sin((19 - mode) * M_PI * y / LY);
}

/* Of a disk: no, one and three nodal diameters. */
static double petals(int mode, double x, double y)
{
    double r = hypot(x, y) / 0.12, angle = atan2(y, x);
    return mode == 0 ? 1 - 1.4 * r * r : mode == 1 ? (r - 0.5 * r * r * r) * cos(angle) : r * r * r * sin(3 * angle);
}

static double shapes_at(const struct object *o, double x, double y, double *phi)
{
    const struct bodywork *b = o->self;
    for (int i = 0; i < o->n; i++)
        phi[i] = b->shape(i, x, y);
    return o->shape == OBJECT_DISK && hypot(x, y) > o->high[0] ? hypot(x, y) - o->high[0] : 0;
}

static double at_touched(const struct modes *m, const struct modes_where *where, const struct modes_point *p)
{
    const struct bodywork *b = m->self;
    for (int i = 0; i < m->n; i++) {
        double complex v = velocity[i] * b->shape(i, where->x - b->origin[0], where->y - b->origin[1]) *
                           b->shape(i, b->listen[0], b->listen[1]);
        p->re[i] = creal(v);
        p->im[i] = cimag(v);
    }
    return 0;
}

/* An object of such shapes, its modes made to be heard where the listener wants it. */
static void bodywork_make(struct bodywork *b, int shape, double (*phi)(int, double, double), struct arena *a)
{
    bool round = shape == OBJECT_DISK;
    b->shape = phi;
    b->object = (struct object){.n = MODES,
                                .shape = shape,
                                .frequency = b->frequency,
                                .decay = b->decay,
                                .flat = true,
                                .shapes = shapes_at,
                                .self = b};
    for (int k = 0; k < 2; k++) {
        b->object.low[k] = round ? -0.12 : 0;
        b->object.high[k] = round ? 0.12 : k ? LY : LX;
    }
    b->modes = (struct modes){.n = MODES,
                              .quantity = MODES_VELOCITY,
                              .shared = true,
                              .frequency = b->frequency,
                              .decay = b->decay,
                              .radius = 0.1,
                              .object = &b->object,
                              .name = "surface.object",
                              .at = at_touched,
                              .self = b};
    radiator_plate_reference(&b->object, a, b->listen);
}

static struct radiator_plate from(const struct bodywork *b, double x, double y, double z)
{
    return (struct radiator_plate){
        &b->modes, &b->object, {b->listen[0], b->listen[1]}, {b->origin[0], b->origin[1]}, {x, y, z}, RHO, C};
}

/* Pressure per velocity of the shape as it is (not over the reference's). */
static double complex pressure(const struct radiator_plate *p, int mode)
{
    struct arena *a = arena_open();
    struct err e = {0};
    const struct bodywork *b = p->modes->self;
    double re[MODES], im[MODES];
    ck_assert_msg(radiator_plate(p, a, re, im, &e), "%s", e.text);
    arena_close(a);
    return (re[mode] + I * im[mode]) * b->shape(mode, b->listen[0], b->listen[1]);
}

/* int_0^L sin(p pi x / L) e^(j kx (x - L/2)) dx: the factor of Wallace (1972), equation 5, about the middle. */
static double complex wallace(int p, double length, double kx)
{
    double alpha = kx * length, q = alpha / (p * M_PI);
    return length / (p * M_PI) * cexp(-0.5 * I * alpha) * (1 - (p % 2 ? -1 : 1) * cexp(I * alpha)) / (1 - q * q);
}

/* Far field of a supported plate's modes: level and phase, in seven directions, below, near and above coincidence. 3e4
   m away the nearest terms left out, k L^2/(8 R), are 4e-5 rad. */
START_TEST(supported_plates_radiate_as_wallace_has_it)
{
    static const double directions[][2] = {{0, 0},     {0.3, 0.2}, {0.7, 1.1}, {1.0, -2.3},
                                           {1.3, 0.6}, {1.5, 3.0}, {1.57, 1.5}},
                        tones[] = {120, 900, 5300};
    struct arena *a = arena_open();
    struct bodywork b = {.origin = {0.3, -0.2}, .frequency = {tones[0], tones[1], tones[2]}};
    double r = 3e4;
    bodywork_make(&b, OBJECT_PLATE, supported, a);
    for (int i = 0; i < MODES; i++)
        for (int d = 0; d < 7; d++) {
            double e[3] = {sin(directions[d][0]) * cos(directions[d][1]), sin(directions[d][0]) * sin(directions[d][1]),
                           cos(directions[d][0])};
            double k = 2 * M_PI * tones[i] / C,
                   most = RHO * C * k / (2 * M_PI * r) * LX * LY * 4 / (M_PI * M_PI * waves[i][0] * waves[i][1]);
            struct radiator_plate p = from(&b, 0.3 + LX / 2 + r * e[0], -0.2 + LY / 2 + r * e[1], r * e[2]);
            double complex want = I * RHO * C * k / (2 * M_PI * r) * wallace(waves[i][0], LX, k * e[0]) *
                                  wallace(waves[i][1], LY, k * e[1]);
            double complex is = pressure(&p, i);
            if (d == 2)
                printf("(%d,%d) %g Hz at 40 degrees: %.3f dB re the most, Wallace %.3f\n", waves[i][0], waves[i][1],
                       tones[i], 20 * log10(cabs(is) / most), 20 * log10(cabs(want) / most));
            ck_assert_double_lt(cabs(is - want), 1e-4 * most);
        }
    arena_close(a);
}
END_TEST

/* A piston on its axis, exactly at any distance and also of a decaying motion: p = rho c v (1 - e^(-s (sqrt(z^2 + a^2)
   - z) / c)) after the delay of its centre; of no decay its level is 2 rho c v |sin(k/2 (sqrt(z^2 + a^2) - z))|. From 1
   mm to 10 m, to 1e-9 of 2 rho c v. */
START_TEST(piston_on_its_axis)
{
    static const double heights[] = {1e-3, 0.01, 0.05, 0.3, 1, 10}, tones[MODES] = {200, 3000, 16000};
    struct arena *a = arena_open();
    struct bodywork b = {.frequency = {tones[0], tones[1], tones[2]}, .decay = {0, 50, 900}};
    double worst = 0;
    bodywork_make(&b, OBJECT_DISK, piston, a);
    for (int h = 0; h < 6; h++)
        for (int i = 0; i < MODES; i++) {
            double way = sqrt(heights[h] * heights[h] + 0.12 * 0.12) - heights[h], k = 2 * M_PI * tones[i] / C;
            struct radiator_plate p = from(&b, 0, 0, heights[h]);
            double complex s = -b.decay[i] + 2 * M_PI * I * tones[i], is = pressure(&p, i) / 2;
            worst = fmax(worst, cabs(is - RHO * C * (1 - cexp(-s * way / C))) / (2 * RHO * C));
            if (i == 0) ck_assert_double_eq_tol(cabs(is), 2 * RHO * C * fabs(sin(k / 2 * way)), 1e-6 * RHO * C);
        }
    printf("off by %.3g\n", worst);
    ck_assert_double_lt(worst, 1e-9);
    arena_close(a);
}
END_TEST

/* Far away 2 J1(x)/x, x = k a sin(theta), at three frequencies, also past its zeros. k a^2/(2 r) of 16 kHz 3e4 m away:
 * 7e-5 rad. */
START_TEST(piston_directivity)
{
    static const double tones[MODES] = {200, 3000, 16000};
    struct arena *a = arena_open();
    struct bodywork b = {.frequency = {tones[0], tones[1], tones[2]}};
    double r = 3e4;
    bodywork_make(&b, OBJECT_DISK, piston, a);
    for (int i = 0; i < MODES; i++)
        for (int d = 1; d <= 6; d++) {
            double theta = 0.25 * d, x = 2 * M_PI * tones[i] / C * 0.12 * sin(theta),
                   most = RHO * tones[i] * M_PI * 0.12 * 0.12 / r;
            struct radiator_plate p = from(&b, r * sin(theta) * 0.6, r * sin(theta) * 0.8, r * cos(theta));
            double complex is = pressure(&p, i) / 2;
            if (d == 3)
                printf("%g Hz, 43 degrees: %.3f dB, 2 J1(x)/x %.3f dB\n", tones[i], 20 * log10(cabs(is) / most),
                       20 * log10(fabs(2 * j1(x) / x)));
            ck_assert_double_lt(cabs(is / (I * most) - 2 * j1(x) / x), 1e-4);
        }
    arena_close(a);
}
END_TEST

/* The same integral by a plain sum of many cells, each Gauss-Legendre's rule of 4 points (error (h/z)^8 and less), in
 * long double. */
static long double complex slow(const struct bodywork *b, int mode, const double place[3], int cells)
{
    static const long double node[4] = {-0.861136311594052575L, -0.339981043584856265L, 0.339981043584856265L,
                                        0.861136311594052575L};
    static const long double weight[4] = {0.347854845137453857L, 0.652145154862546143L, 0.652145154862546143L,
                                          0.347854845137453857L};
    bool round = b->object.shape == OBJECT_DISK;
    double low[2] = {0, 0}, high[2] = {round ? 0.12 : LX, round ? 2 * M_PI : LY},
           middle[2] = {round ? 0 : LX / 2, round ? 0 : LY / 2};
    long double far = hypotl(hypotl(place[0] - middle[0], place[1] - middle[1]), place[2]);
    long double complex sum = 0, s = -b->decay[mode] + 2 * M_PIl * I * b->frequency[mode];
    for (int i = 0; i < 4 * cells; i++)
        for (int k = 0; k < 4 * cells; k++) {
            long double u = low[0] + (high[0] - low[0]) * (i / 4 + 0.5L + 0.5L * node[i % 4]) / cells,
                        v = low[1] + (high[1] - low[1]) * (k / 4 + 0.5L + 0.5L * node[k % 4]) / cells;
            long double area = (high[0] - low[0]) * (high[1] - low[1]) / (4.0L * cells * cells) * weight[i % 4] *
                               weight[k % 4] * (round ? u : 1);
            long double x = round ? u * cosl(v) : u, y = round ? u * sinl(v) : v,
                        R = hypotl(hypotl(place[0] - x, place[1] - y), place[2]);
            sum += area * b->shape(mode, (double)x, (double)y) * cexpl(-s * (R - far) / C) / R;
        }
    return s * RHO / (2 * M_PIl) * sum;
}

/* Close by, off the middle and off the edge: to 1e-8 of what the shape could make at most, as refining the slow sum
 * says it is itself. */
START_TEST(close_by_it_is_the_slow_sum)
{
    static const double places[][3] = {{0.1, 0.05, 0.03}, {0.5, 0.3, 0.05}, {-0.06, 0.1, 0.4}};
    struct arena *a = arena_open();
    double worst = 0, own = 0;
    for (int k = 0; k < 2; k++) {
        struct bodywork b = {.frequency = {150, 1700, 9000}, .decay = {3, 60, 700}};
        bodywork_make(&b, k ? OBJECT_DISK : OBJECT_PLATE, k ? petals : supported, a);
        for (int i = 0; i < 3; i++)
            for (int mode = 0; mode < MODES; mode++) {
                struct radiator_plate p = from(&b, places[i][0], places[i][1], places[i][2]);
                long double complex want = slow(&b, mode, places[i], 64);
                double size = RHO * b.frequency[mode] * (k ? 0.12 * 0.12 * M_PI : LX * LY) /
                              hypot(hypot(places[i][0], places[i][1]), places[i][2]);
                worst = fmax(worst, (double)cabsl(pressure(&p, mode) - want) / size);
                if (i == 0 && mode == 2) own = fmax(own, (double)cabsl(slow(&b, mode, places[i], 45) - want) / size);
            }
    }
    printf("off by %.3g; the slow sum, refined from 45 to 64 cells, moves by %.3g\n", worst, own);
    ck_assert_double_lt(worst, 1e-8);
    arena_close(a);
}
END_TEST

/* The first panels follow from the number of modes; where shapes have more waves, they are halved until the sum
 * settles. */
START_TEST(panels_are_halved_until_it_settles)
{
    struct arena *a = arena_open();
    struct bodywork b = {.frequency = {150, 200, 260}};
    double place[3] = {0.1, 0.05, 0.25}, worst = 0;
    bodywork_make(&b, OBJECT_PLATE, ripples, a);
    for (int mode = 0; mode < MODES; mode++) {
        struct radiator_plate p = from(&b, place[0], place[1], place[2]);
        double size = RHO * b.frequency[mode] * LX * LY / 0.3;
        worst = fmax(worst, (double)cabsl(pressure(&p, mode) - slow(&b, mode, place, 64)) / size);
    }
    printf("off by %.3g\n", worst);
    ck_assert_double_lt(worst, 1e-8);
    arena_close(a);
}
END_TEST

/* The listener: which place it wants the modes made for, what it makes of a strike at any place of the plate (the sign
   of the shape included), the direct term that leaves no constant pressure, the delay to the farther of two places. */
START_TEST(a_struck_plate_is_heard)
{
    struct arena *a = arena_open();
    struct bodywork b = {.origin = {1, 2}, .frequency = {150, 1700, 9000}, .decay = {3, 60, 700}};
    double places[6] = {1.1, 2.3, 0.4, 1.5, 1.4, 0.9}, wanted[2], origin[2] = {1, 2};
    struct output o = {.quantity = QUANTITY_AUTO, .listen = {true, RADIATOR_PLATE, places, 2, RHO, C}};
    struct listener_ask ask[2] = {{&o, 0, origin, 48e3, b.listen}, {&o, 1, origin, 48e3, b.listen}},
                        touched = {&o, 0, origin, 48e3, NULL};
    struct err e = {0};
    bodywork_make(&b, OBJECT_PLATE, supported, a);
    ck_assert(listener_place(&ask[0], &b.object, a, wanted));
    ck_assert(wanted[0] == b.listen[0] && wanted[1] == b.listen[1]);
    struct listener *near = listener_make(a, &ask[0], &b.modes, &e), *far = listener_make(a, &ask[1], &b.modes, &e);
    ck_assert_msg(near && far, "%s", e.text);
    ck_assert(!listener_make(a, &touched, &b.modes, &e) && strstr(e.text, "is not the surface") != NULL);
    double late = (hypot(hypot(0.29, 1.4 - 2 - LY / 2), 0.9) - hypot(hypot(0.11, 0.3 - LY / 2), 0.4)) / C * 48e3;
    ck_assert_int_eq(listener_delay(near), 0);
    ck_assert_int_eq(listener_delay(far), (long)ceil(late));
    ck_assert_int_eq(listener_quantity(near), MODES_PRESSURE);
    for (int k = 0; k < 2; k++) {
        double struck[2] = {k ? 0.31 : 0.05, k ? 0.11 : 0.2}, re[MODES], im[MODES];
        struct modes_point p = {NULL, NULL, re, im};
        modes_at(&b.modes, &(struct modes_where){1 + struck[0], 2 + struck[1], 0}, &p);
        listener_apply(near, b.frequency, b.decay, &p);
        for (int i = 0; i < MODES; i++) {
            double complex want = velocity[i] * supported(i, struck[0], struck[1]) *
                                  (double complex)slow(&b, i, (double[3]){0.1, 0.3, 0.4}, 30);
            ck_assert_double_lt(cabs(re[i] + I * im[i] - want), 1e-7 * RHO * b.frequency[i] * LX * LY);
        }
    }
    arena_close(a);
}
END_TEST

/* A point of the object is heard as the modes were made for it; one beside it is refused. */
START_TEST(a_point_lies_on_the_object)
{
    struct arena *a = arena_open();
    struct bodywork b = {.origin = {1, 2}, .frequency = {150, 1700, 9000}};
    double places[6] = {1.3, 2.1, 0, 1.3, 1.99, 0}, wanted[2], origin[2] = {1, 2}, re[MODES] = {1, 2, 3},
           im[MODES] = {4, 5, 6};
    struct output o = {.quantity = QUANTITY_AUTO, .listen = {true, RADIATOR_POINT, places, 2, RHO, C}};
    struct listener_ask on = {&o, 0, origin, 48e3, NULL}, beside = {&o, 1, origin, 48e3, NULL};
    struct err e = {0};
    bodywork_make(&b, OBJECT_DISK, petals, a);
    ck_assert(listener_place(&on, &b.object, a, wanted));
    ck_assert(fabs(wanted[0] - 0.3) < 1e-15 && fabs(wanted[1] - 0.1) < 1e-15);
    origin[0] = 1.25;
    struct listener *l = listener_make(a, &on, &b.modes, &e);
    ck_assert_msg(l != NULL && listener_quantity(l) == MODES_VELOCITY && listener_extra(l) == 0, "%s", e.text);
    listener_apply(l, b.frequency, b.decay, &(struct modes_point){NULL, NULL, re, im});
    ck_assert(re[1] == 2 && im[2] == 6);
    origin[0] = 1;
    ck_assert(!listener_make(a, &beside, &b.modes, &e) && e.kind == ERR_SCENE);
    ck_assert_msg(strstr(e.text, "place 2, [1.3, 1.99] m, is 0.18 m beside surface.object") != NULL, "%s", e.text);
    arena_close(a);
}
END_TEST

START_TEST(behind_the_baffle_nothing_is_heard)
{
    struct arena *a = arena_open();
    struct err e = {0};
    double re[MODES], im[MODES];
    struct bodywork b = {.frequency = {150, 1700, 9000}};
    bodywork_make(&b, OBJECT_PLATE, supported, a);
    struct radiator_plate p = from(&b, 0, 0, 0), close = from(&b, 0.1, 0.1, 1e-9);
    ck_assert(!radiator_plate(&p, a, re, im, &e) && e.kind == ERR_SCENE);
    ck_assert_msg(strstr(e.text, "z must be above 0 m") != NULL, "%s", e.text);
    ck_assert_msg(radiator_plate(&close, a, re, im, &(struct err){0}),
                  "panels grow like the logarithm of the distance");
    arena_close(a);
}
END_TEST

UNIT("radiation", supported_plates_radiate_as_wallace_has_it, piston_on_its_axis, piston_directivity,
     close_by_it_is_the_slow_sum, panels_are_halved_until_it_settles, a_struck_plate_is_heard,
     a_point_lies_on_the_object, behind_the_baffle_nothing_is_heard)
