/* crest, crest_piece, rolling_envelope_part: against the plain maximum over all heights, a search over smooth ground,
 * closed forms, and itself in another order and in other windows. */
#include "surface/rolling_envelope.h"

#include "unit.h"

static double between(double low, double high) { return low + (high - low) * drand48(); }

/* ------------------------------------------------------------------ against the plain maximum */

#define PITCH 2.5e-6

enum { N = 600, PLACES = 700 };

struct plain {
    double e, slope, second; /* the largest; its slope; the second largest */
};

static struct plain plain_at(const double *z, long n, long first, double radius, double x)
{
    struct plain p = {-HUGE_VAL, 0, -HUGE_VAL};
    for (long i = 0; i < n; i++) {
        double d = x - (double)(first + i) * PITCH, s = sqrt(radius * radius - d * d), e = z[i] - d * d / (radius + s);
        if (fabs(d) > radius) continue;
        if (e > p.e)
            p = (struct plain){e, -d / s, p.e};
        else
            p.second = fmax(p.second, e);
    }
    return p;
}

/* Noise, noise with rare spikes, steps, a wave, a walk with cliffs. */
static void ground_make(int kind, double *z)
{
    double walk = 0;
    for (long i = 0; i < N; i++) {
        double noise = 1e-6 * (drand48() - 0.5);
        walk += 1e-5 * (drand48() - 0.5) + (drand48() < 0.02 ? between(-1e-3, 1e-3) : 0);
        z[i] = kind == 0   ? noise
               : kind == 1 ? noise + (drand48() < 0.01 ? between(0, 5e-5) : 0)
               : kind == 2 ? 3e-5 * floor(3 * drand48())
               : kind == 3 ? 2e-5 * cos(2 * M_PI * (double)i / 70)
                           : walk;
    }
}

/* Rounding: of places, 2e-16 of them, by the slope; of heights and caps, by themselves; of crossings, by the length of
   the window and the slopes' difference. At a cliff, where a slope may be anything, the place may be taken 1e-15 m
   away. */
static void check_place(const struct rolling_envelope *c, const double *z, long first, double radius, double x)
{
    double e, slope, close = 1e-15, tolerance = 2e-17;
    rolling_envelope_at(c, 1, &x, &e, &slope);
    struct plain here = plain_at(z, N, first, radius, x), left = plain_at(z, N, first, radius, x - close),
                 right = plain_at(z, N, first, radius, x + close);
    double least = fmin(here.e, fmin(left.e, right.e)), most = fmax(here.e, fmax(left.e, right.e));
    ck_assert_msg(e <= most + tolerance && e >= least - tolerance, "R %g, x %g: %.17g, and the largest is %.17g",
                  radius, x, e, here.e);
    if (here.e - here.second > 1e-14 && most - least < 1e-13)
        ck_assert_double_eq_tol(slope, here.slope, 1e-9 * (1 + fabs(here.slope)));
}

START_TEST(the_plain_maximum)
{
    static const double radii[] = {0.51 * PITCH, 3.01e-6, 2.01e-5, 3.01e-4, 1e-2, 10};
    static double z[N];
    struct arena *a = arena_open();
    srand48(1);
    for (int kind = 0; kind < 5; kind++)
        for (int k = 0; k < 6; k++) {
            struct rolling_envelope *c = rolling_envelope_make(a, radii[k], PITCH, N);
            long first = (long)between(-3000, 3000);
            ground_make(kind, z);
            rolling_envelope_set(c, &(struct envelope_ground){z, NULL, NULL}, N, first);
            for (int i = 0; i < PLACES; i++) {
                double at = i < N ? i : between(0, N - 1);
                check_place(c, z, first, radii[k], ((double)first + at) * PITCH);
            }
        }
    arena_close(a);
}
END_TEST

/* Many places at once, rising, falling and at random, are those one by one. */
START_TEST(many_at_once)
{
    static double z[N], x[PLACES], e[PLACES], slope[PLACES];
    struct arena *a = arena_open();
    struct rolling_envelope *c = rolling_envelope_make(a, 1e-3, PITCH, N);
    srand48(2);
    ground_make(1, z);
    rolling_envelope_set(c, &(struct envelope_ground){z, NULL, NULL}, N, 0);
    for (int kind = 0; kind < 3; kind++) {
        for (int i = 0; i < PLACES; i++)
            x[i] = PITCH * (kind == 0 ? (double)i / 4 : kind == 1 ? (PLACES - i) / 4.0 : between(0, N - 1));
        rolling_envelope_at(c, PLACES, x, e, slope);
        for (int i = 0; i < PLACES; i++) {
            double one[2];
            rolling_envelope_at(c, 1, &x[i], &one[0], &one[1]);
            ck_assert(one[0] == e[i] && one[1] == slope[i]);
        }
    }
    arena_close(a);
}
END_TEST

/* ------------------------------------------------------------------ closed forms */

/* One spike of 20 um on level ground: one arc from -sqrt(2 R H - H^2) to the same on the other side; beside it dips of
 * d^2 / (8 R) between the heights. */
START_TEST(a_spike_is_one_arc)
{
    static double z[N];
    double radius = 1e-3, high = 2e-5, far = sqrt(2 * radius * high - high * high), dip = PITCH * PITCH / 8 / radius;
    struct arena *a = arena_open();
    struct rolling_envelope *c = rolling_envelope_make(a, radius, PITCH, N);
    z[300] = high;
    rolling_envelope_set(c, &(struct envelope_ground){z, NULL, NULL}, N, -300);
    for (int k = 0; k < 1000; k++) {
        double x = between(-290, 290) * PITCH, e, slope, arc = high - x * x / (radius + sqrt(radius * radius - x * x));
        rolling_envelope_at(c, 1, &x, &e, &slope);
        if (fabs(x) < far - PITCH) {
            ck_assert_double_eq_tol(e, arc, 1e-19);
            ck_assert_double_eq_tol(slope, -x / sqrt(radius * radius - x * x), 1e-13);
        } else if (fabs(x) > far + PITCH) {
            ck_assert(e <= 0 && e >= -dip * (1 + 1e-6));
        }
    }
    arena_close(a);
}
END_TEST

/* The curve at a distance of R from a wave of 1 mm and 4 um, whose hollows are far wider than the disc: x = t - R
 * s/sqrt(1 + s^2), E = z(t) + R/sqrt(1 + s^2) - R. */
static double parallel(double x, double radius)
{
    double k = 2 * M_PI / 1e-3, t = x, s = 0;
    for (int i = 0; i < 40; i++) {
        s = -4e-6 * k * sin(k * t);
        t = x + radius * s / sqrt(1 + s * s);
    }
    return 4e-6 * cos(k * t) + radius / sqrt(1 + s * s) - radius;
}

/* Too low by at most d^2/8 (1/R + |z''|), never too high; and at its worst nearly so much. */
START_TEST(a_wave_is_a_parallel_curve)
{
    static double z[N];
    double radius = 1e-3, bend = 4e-6 * pow(2 * M_PI / 1e-3, 2), bound = PITCH * PITCH / 8 * (1 / radius + bend),
           worst = 0;
    struct arena *a = arena_open();
    struct rolling_envelope *c = rolling_envelope_make(a, radius, PITCH, N);
    for (long i = 0; i < N; i++)
        z[i] = 4e-6 * cos(2 * M_PI / 1e-3 * PITCH * (double)(i - 300));
    rolling_envelope_set(c, &(struct envelope_ground){z, NULL, NULL}, N, -300);
    for (int k = 0; k < 2000; k++) {
        double x = between(-200, 200) * PITCH, e;
        rolling_envelope_at(c, 1, &x, &e, NULL);
        ck_assert_double_le(e, parallel(x, radius) + 1e-17);
        worst = fmax(worst, parallel(x, radius) - e);
    }
    ck_assert_msg(worst <= bound * 1.001 && worst > 0.9 * bound, "%g of %g", worst, bound);
    arena_close(a);
}
END_TEST

/* Over two spikes, of any heights, the disc rests on both where it passes from one to the other: its centre is then R
   from either. And over the middle between two alike. */
START_TEST(two_spikes)
{
    double radius = 1e-3, middle[2], z[101];
    struct arena *a = arena_open();
    struct rolling_envelope *c = rolling_envelope_make(a, radius, PITCH, 101);
    for (int k = 0; k < 50; k++) {
        double rise = k == 0 ? 0 : between(-2e-5, 2e-5), low = -HUGE_VAL, high, x;
        for (int i = 0; i < 101; i++)
            z[i] = -1e-3;
        z[0] = 0;
        z[100] = rise;
        rolling_envelope_set(c, &(struct envelope_ground){z, NULL, NULL}, 101, 0);
        for (low = 0, high = 100 * PITCH;
             high - low > 1e-18;) { /* bisection: is the slope still that of the first arc? */
            x = 0.5 * (low + high);
            if (x == low || x == high) break;
            rolling_envelope_at(c, 1, &x, &middle[0], &middle[1]);
            if (middle[1] <= 0 && fabs(middle[1] + x / sqrt(radius * radius - x * x)) < 1e-12)
                low = x;
            else
                high = x;
        }
        rolling_envelope_at(c, 1, &high, &middle[0], NULL);
        double up = middle[0] + radius, d = high - 100 * PITCH;
        ck_assert_double_eq_tol(hypot(high, up), radius, 1e-17);
        ck_assert_double_eq_tol(hypot(d, up - rise), radius, 1e-17);
        if (k == 0) ck_assert_double_eq_tol(high, 50 * PITCH, 1e-18);
    }
    arena_close(a);
}
END_TEST

/* ------------------------------------------------------------------ smooth ground */

struct jets {
    double z[N], slope[N], bend[N];
};

static void ground_set(struct rolling_envelope *c, const struct jets *g, long n, long first)
{
    rolling_envelope_set(c, &(struct envelope_ground){g->z, g->slope, g->bend}, n, first);
}

/* Every derivative of a piece's polynomial from those of its ends by Hermite's own basis (x from 0 to 1). */
static double hermite(const struct jets *g, long i, double x)
{
    double h = PITCH, y = 1 - x, x3 = x * x * x, y3 = y * y * y;
    return g->z[i] * y3 * (1 + 3 * x + 6 * x * x) + g->z[i + 1] * x3 * (1 + 3 * y + 6 * y * y) +
           h * g->slope[i] * x * y3 * (1 + 3 * x) - h * g->slope[i + 1] * y * x3 * (1 + 3 * y) +
           0.5 * h * h * (g->bend[i] * x * x * y3 + g->bend[i + 1] * y * y * x3);
}

static double arc_on(const struct jets *g, double radius, double x, double t)
{
    long i = (long)fmin(floor(t / PITCH), N - 2);
    double d = x - t, square = radius * radius - d * d;
    return square < 0 ? -HUGE_VAL : hermite(g, i, t / PITCH - (double)i) - d * d / (radius + sqrt(square));
}

/* The largest of FINE places in each pitch, then a search between its neighbours by the golden section: off by
 * rounding. */
static double searched(const struct jets *g, double radius, double x)
{
    enum { FINE = 32 };
    double best = -HUGE_VAL, at = 0, step = PITCH / FINE, golden = 0.5 * (sqrt(5) - 1);
    for (long k = 0; k <= (N - 1) * FINE; k++) {
        double e = arc_on(g, radius, x, (double)k * step);
        at = e > best ? (double)k * step : at;
        best = fmax(best, e);
    }
    double low = fmax(at - step, 0), high = fmin(at + step, (N - 1) * PITCH);
    for (int i = 0; i < 60; i++) {
        double a = high - golden * (high - low), b = low + golden * (high - low);
        if (arc_on(g, radius, x, a) > arc_on(g, radius, x, b))
            high = b;
        else
            low = a;
    }
    return fmax(best, arc_on(g, radius, x, 0.5 * (low + high)));
}

/* Waves of which the shortest has 12 places, 4 of them: peaks of all heights, some under the disc, some between two
 * others by a hair. */
static void ground_waves(struct jets *g, double high)
{
    memset(g, 0, sizeof *g);
    for (int w = 0; w < 4; w++) {
        double k = 2 * M_PI / (PITCH * (12 + 9 * w)), phase = between(0, 2 * M_PI), a = high * (1 + w);
        for (long i = 0; i < N; i++) {
            g->z[i] += a * cos(k * PITCH * (double)i + phase);
            g->slope[i] -= a * k * sin(k * PITCH * (double)i + phase);
            g->bend[i] -= a * k * k * cos(k * PITCH * (double)i + phase);
        }
    }
}

/* Discs far smaller and far larger than the waves, on gentle ones, and steep ones (slopes of 1). The search is off by
 * rounding, 1e-16 of the height of a large disc's arc and of z. */
START_TEST(smooth_ground_against_a_search)
{
    static const double radii[] = {2.01e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1};
    static struct jets g;
    struct arena *a = arena_open();
    srand48(11);
    for (int steep = 0; steep < 2; steep++)
        for (int k = 0; k < 6; k++) {
            struct rolling_envelope *c = rolling_envelope_make(a, radii[k], PITCH, N);
            ground_waves(&g, steep ? 1e-6 : 2e-8);
            ground_set(c, &g, N, 0);
            for (int i = 0; i < 150; i++) {
                double x = between(0, N - 1) * PITCH, e, want = searched(&g, radii[k], x);
                rolling_envelope_at(c, 1, &x, &e, NULL);
                ck_assert_msg(fabs(e - want) < 1e-18, "R %g, x %.9g: %.17g, and a search finds %.17g: %g", radii[k], x,
                              e, want, e - want);
            }
        }
    arena_close(a);
}
END_TEST

/* At every switch, where a piece that is left out, or a place that is not quite found, shows: both sides hold the disc,
   and nothing is higher. Places between them say little of either. A switch is found to 1e-6 of half a piece, 1.25e-12
   m, times slopes of about 1. The smallest disc rests on nearly every piece of a ground whose bends jump: there the one
   that the sieve must not leave out is that whose middle is hidden, not its end. */
START_TEST(switches_against_a_search)
{
    static const double radii[] = {1e-5, 3e-5, 1e-4, 1e-3};
    static struct jets g;
    struct arena *a = arena_open();
    int seen = 0;
    srand48(12);
    for (int k = 0; k < 8; k++) {
        struct rolling_envelope *c = rolling_envelope_make(a, radii[k / 2], PITCH, N);
        const double *s;
        ground_waves(&g, k % 2 ? 1e-6 : 2e-7);
        for (long i = 0; i < N && k < 2; i++)
            g.bend[i] += between(-8, 8) / radii[0];
        ground_set(c, &g, N, 0);
        long n = rolling_envelope_between(c, 0, (N - 1) * PITCH, &s);
        double worst = 0, jump = 0;
        for (long i = 1; i < n; i++) {
            double at = s[i * STRETCH_NUMBERS + STRETCH_FROM], e[2];
            if (s[i * STRETCH_NUMBERS + STRETCH_AT] - s[(i - 1) * STRETCH_NUMBERS + STRETCH_AT] < 1.5 * PITCH) continue;
            rolling_envelope_at(c, 2, (const double[2]){nextafter(at, 0), at}, e, NULL);
            jump = fmax(jump, fabs(e[0] - e[1]));
            worst = fmax(worst, fabs(e[1] - searched(&g, radii[k / 2], at)));
            seen++;
        }
        ck_assert_msg(jump < 2e-12 && worst < 2e-12, "R %g, ground %d: the envelope jumps by %g, and is off by %g",
                      radii[k / 2], k % 2, jump, worst);
    }
    ck_assert_int_gt(seen, 50);
    arena_close(a);
}
END_TEST

/* What a wave's parallel curve and the envelope of N places on it, `per` in a wave, are apart at most. */
static double wave_error(double radius, int per)
{
    static struct jets g;
    struct arena *a = arena_open();
    double pitch = 1e-3 / per, k = 2 * M_PI / 1e-3, worst = 0;
    struct rolling_envelope *c = rolling_envelope_make(a, radius, pitch, N);
    for (long i = 0; i < 4 * per; i++) {
        double t = k * pitch * (double)(i - 2 * per);
        g.z[i] = 4e-6 * cos(t), g.slope[i] = -4e-6 * k * sin(t), g.bend[i] = -4e-6 * k * k * cos(t);
    }
    ground_set(c, &g, 4 * per, -2 * per);
    for (int i = 0; i < 2000; i++) {
        double x = between(-1e-3, 1e-3), e;
        rolling_envelope_at(c, 1, &x, &e, NULL);
        worst = fmax(worst, fabs(e - parallel(x, radius)));
    }
    arena_close(a);
    return worst;
}

/* The polynomials' (k d)^6 / 46080 of the amplitude, and of order 6. */
START_TEST(a_smooth_wave_is_a_parallel_curve)
{
    for (int k = 0; k < 3; k++) {
        double radius = (double[]){1e-5, 1e-3, 4e-3}[k], off[3];
        for (int i = 0; i < 3; i++) {
            int per = 8 << i;
            off[i] = wave_error(radius, per);
            ck_assert_double_lt(off[i], 1.05 * 4e-6 * pow(2 * M_PI / per, 6) / 46080 + 1e-20);
        }
        printf("R %g: %g, %g, %g\n", radius, off[0], off[1], off[2]);
        ck_assert_double_gt(off[0] / off[1], 50);
        ck_assert_double_gt(off[1] / off[2], 50);
    }
}
END_TEST

/* A parabola is its own polynomial: the disc on its crown, and on a hollow wider than it, to rounding: at its slope p
 * it rests at p / b + R p/sqrt(1 + p^2). */
START_TEST(a_parabola_is_exact)
{
    static struct jets g;
    double radius = 1e-3;
    struct arena *a = arena_open();
    for (int k = 0; k < 3; k++) {
        double b = (double[]){-2e4, -10, 900}[k];
        struct rolling_envelope *c = rolling_envelope_make(a, radius, PITCH, N);
        for (long i = 0; i < N; i++) {
            double x = PITCH * (double)(i - 300);
            g.z[i] = 0.5 * b * x * x, g.slope[i] = b * x, g.bend[i] = b;
        }
        ground_set(c, &g, N, -300);
        for (int i = 0; i < 1000; i++) {
            double t = between(-290, 290) * PITCH, p = b * t, length = sqrt(1 + p * p), x = t - radius * p / length, e,
                   slope;
            rolling_envelope_at(c, 1, &x, &e, &slope);
            ck_assert_double_eq_tol(e, 0.5 * b * t * t + radius / length - radius, 1e-17 + 1e-15 * fabs(b) * 1e-6);
            ck_assert_double_eq_tol(slope, p, 1e-9 * (1 + p * p));
        }
    }
    arena_close(a);
}
END_TEST

/* Two alike crowns, one higher by `rise`: the disc passes from one to the other where both hold it up. On the parabola
   -b (t - t_0)^2 / 2 it is so gentle that E = z_0 - (x - t_0)^2 / (2 (R + 1/b)) but for (x - t_0)^4 / R^3: the switch
   lies rise (R + 1/b) / D from the middle. */
START_TEST(a_switch_is_where_both_hold)
{
    static struct jets g;
    double radius = 0.1, b = 2e4, apart = 200 * PITCH, wide = radius + 1 / b, rise = 3.3e-8, low = 200 * PITCH,
           high = 400 * PITCH, middle[2];
    struct arena *a = arena_open();
    struct rolling_envelope *c = rolling_envelope_make(a, radius, PITCH, N);
    for (long i = 0; i < N; i++) {
        double left = PITCH * (double)(i - 200), right = PITCH * (double)(i - 400), x = i < 300 ? left : right;
        g.z[i] = -0.5 * b * x * x + (i < 300 ? 0 : rise), g.slope[i] = -b * x, g.bend[i] = -b;
    }
    ground_set(c, &g, N, 0);
    while (high - low > 1e-17) {
        double x = 0.5 * (low + high);
        rolling_envelope_at(c, 1, &x, &middle[0], &middle[1]);
        if (middle[1] < 0)
            low = x;
        else
            high = x;
    }
    ck_assert_double_eq_tol(low, 300 * PITCH + -rise * wide / apart, 1e-4 * rise * wide / apart);
    arena_close(a);
}
END_TEST

/* ------------------------------------------------------------------ as a part */

static double towers, apart; /* m: where one stands, and how far from each other they do, 3.9 mm high; 0: none */

static double rough(double x)
{
    double z = apart > 0 && fabs(remainder(x - towers, apart)) < 0.8e-6 ? 3.9e-3 : 0;
    for (int k = 1; k < 12; k++)
        z += 4e-6 / k * sin(k * k * 3.1e3 * x + k * k);
    return z;
}

static bool smooth; /* is the ground read with its slopes? (then no towers) */

static void rough_add(struct relief_part *part, const struct relief_points *p, const struct relief_values *v)
{
    (void)part;
    for (size_t i = 0; i < p->n; i++) {
        v->z[i] += rough(p->x[i]);
        for (int k = 1; v->xx && k < 12; k++) {
            double wave = k * k * 3.1e3, a = 4e-6 / k, at = wave * p->x[i] + k * k;
            v->x[i] += a * wave * cos(at);
            v->xx[i] -= a * wave * wave * sin(at);
        }
    }
}

struct bed {
    struct arena *arena;
    struct relief relief;
    struct relief_part part, *crest;
    int told;
};

static void told(void *self) { ((struct bed *)self)->told++; }

static void bed_make(struct bed *b, double radius, double pitch, double reach, double span)
{
    struct rolling_plan p = {
        .radius = radius, .pitch = pitch, .reach = reach, .span = span, .points = !smooth, .exceeded = told, .self = b};
    *b = (struct bed){.arena = arena_open(), .relief = {.along = ALONG_PATH}, .part = {.add = rough_add}};
    relief_add(&b->relief, &b->part);
    b->crest = rolling_envelope_part(b->arena, &b->relief, &p);
}

struct jet {
    double z, x, xx;
};

static struct jet bed_read(const struct bed *b, double x)
{
    struct jet j = {0};
    b->crest->add(b->crest, &(struct relief_points){1, &x, NULL},
                  &(struct relief_values){.z = &j.z, .x = &j.x, .xx = &j.xx});
    return j;
}

static void order_check(double radius, double far)
{
    enum { READS = 3000 };
    static double x[READS], all[READS];
    struct bed b, other;
    bed_make(&b, radius, PITCH, fmin(radius, 8e-3), HUGE_VAL);
    bed_make(&other, radius, PITCH, fmin(radius, 8e-3), HUGE_VAL);
    for (int i = 0; i < READS; i++)
        x[i] = i < 2000 ? 1e-5 * (i - 1000) : i % 50 ? x[i - 1] - 1e-4 : between(-far, far);
    memset(all, 0, sizeof all);
    b.crest->add(b.crest, &(struct relief_points){READS, x, NULL}, &(struct relief_values){.z = all});
    for (int i = READS - 1; i >= 0; i--)
        ck_assert(bed_read(&other, x[i]).z == all[i]);
    for (int i = 0; i < READS; i += 601) {
        struct bed alone;
        bed_make(&alone, radius, PITCH, fmin(radius, 8e-3), HUGE_VAL);
        ck_assert(bed_read(&alone, x[i]).z == all[i]);
        arena_close(alone.arena);
    }
    arena_close(b.arena);
    arena_close(other.arena);
}

/* Blocks shorter and longer than the memory's, read forwards, backwards, at random and alone: the same bits. */
START_TEST(order_does_not_matter)
{
    srand48(3);
    for (int k = 0; k < 6; k++) {
        smooth = k % 2;
        order_check((double[]){1e-4, 5e-3, 0.1}[k / 2], k / 2 == 2 ? 30 : 1);
    }
    smooth = false;
}
END_TEST

/* In blocks of 1024 heights and of 5334, about their ends and anywhere: the plain maximum over all heights within R.
   With towers at 0.98 R before or behind the ends, which the disc touches there nearly as far away as it can. As near
   as rounding, 2e-16 of the place by the slope. */
START_TEST(blocks_see_all_heights)
{
    static const double radii[] = {1e-4, 4e-3, 4e-3, 4e-3};
    double pitch = 1.5e-6;
    srand48(4);
    for (int k = 0; k < 4; k++) {
        struct bed b;
        bed_make(&b, radii[k], pitch, radii[k], HUGE_VAL);
        long reach = (long)ceil(radii[k] / pitch), side = 2 * reach > 1024 ? 2 * reach : 1024;
        apart = k > 1 ? (double)side * pitch : 0;
        towers = k == 2 ? 0.98 * radii[k] : -0.98 * radii[k];
        for (int i = 0; i < 120; i++) {
            double x = i < 60 ? (double)(side * (i % 7 - 3)) * pitch + (i - 30) * 0.3 * pitch : between(-5e-2, 5e-2),
                   most = -HUGE_VAL;
            for (long j = (long)floor(x / pitch) - reach - 1; j <= (long)ceil(x / pitch) + reach + 1; j++) {
                double d = x - (double)j * pitch;
                if (fabs(d) <= radii[k])
                    most =
                        fmax(most, rough((double)j * pitch) - d * d / (radii[k] + sqrt(radii[k] * radii[k] - d * d)));
            }
            ck_assert_double_eq_tol(bed_read(&b, x).z, most, k > 1 ? 1e-15 : 2e-17);
        }
        arena_close(b.arena);
    }
}
END_TEST

static double rough_arc(double radius, double x, double t)
{
    double square = radius * radius - (x - t) * (x - t);
    return square < 0 ? -HUGE_VAL : rough(t) - (x - t) * (x - t) / (radius + sqrt(square));
}

/* From t on: three places, and the best of them in the middle again, ever nearer. */
static double rough_top(double radius, double x, double t, double step)
{
    double most = rough_arc(radius, x, t);
    for (step /= 2; step > 1e-12; step /= 2) {
        double l = rough_arc(radius, x, t - step), r = rough_arc(radius, x, t + step);
        t += l > most ? -step : r > most ? step : 0;
        most = fmax(most, fmax(l, r));
    }
    return most;
}

/* Smooth ground, about the ends of blocks and anywhere, against a search over places 1/8 of the pitch apart, and ever
   nearer about the best. The polynomials are off by (k d)^6 / 46080 of 4 um / 11, k = 3.75e5 rad/m the finest wave's,
   and less of each of the rest: 3.8e-13 m. */
START_TEST(blocks_of_smooth_ground)
{
    double pitch = 1.5e-6, fine = pitch / 8;
    smooth = true;
    srand48(6);
    for (int k = 0; k < 2; k++) {
        struct bed b;
        double radius = (double[]){1e-4, 4e-3}[k];
        bed_make(&b, radius, pitch, radius, HUGE_VAL);
        long reach = (long)ceil(radius / pitch), side = 2 * reach > 1024 ? 2 * reach : 1024;
        for (int i = 0; i < 5; i++) {
            double x = i < 4 ? (double)(side * (2 * i - 3)) * pitch + (i - 4) * 0.3 * pitch : between(-5e-2, 5e-2),
                   most = -HUGE_VAL;
            for (double t = x - radius; t <= x + radius; t += fine)
                if (rough_arc(radius, x, t) > most - 1e-9) most = fmax(most, rough_top(radius, x, t, fine));
            ck_assert_double_eq_tol(bed_read(&b, x).z, most, 4e-13);
        }
        arena_close(b.arena);
    }
    smooth = false;
}
END_TEST

/* A reach of sqrt(2 R H) is as good as R. */
START_TEST(a_shorter_reach)
{
    double radius = 1e-2, most = -HUGE_VAL, least = HUGE_VAL;
    for (int i = 0; i < 100000; i++) {
        most = fmax(most, rough(1e-6 * i));
        least = fmin(least, rough(1e-6 * i));
    }
    struct bed all, near;
    bed_make(&all, radius, PITCH, radius, HUGE_VAL);
    bed_make(&near, radius, PITCH, sqrt(2 * radius * 1.2 * (most - least)), 1.2 * (most - least));
    for (int i = 0; i < 5000; i++) {
        double x = between(0, 0.2);
        ck_assert_double_eq_tol(bed_read(&near, x).z, bed_read(&all, x).z, 1e-18);
    }
    ck_assert_int_eq(near.told, 0);
    arena_close(all.arena);
    arena_close(near.arena);
}
END_TEST

START_TEST(a_greater_span_is_told_once)
{
    struct bed b;
    bed_make(&b, 1e-3, PITCH, 1e-4, 5e-6);
    for (int i = 0; i < 10; i++)
        bed_read(&b, 0.1 * i);
    ck_assert_int_eq(b.told, 1);
    arena_close(b.arena);
}
END_TEST

/* Slopes and second derivatives are those of the height between kinks: central differences over 1 nm; those of arcs are
 * more than 1/R bent. */
START_TEST(derivatives_between_kinks)
{
    double step = 1e-9;
    for (int k = 0; k < 2; k++) {
        struct bed b;
        int seen = 0;
        smooth = k == 1;
        bed_make(&b, 1e-3, PITCH / (1 + k), 1e-3, HUGE_VAL);
        srand48(5);
        for (int i = 0; i < 2000; i++) {
            double x = between(-1e-2, 1e-2);
            struct jet l = bed_read(&b, x - step), m = bed_read(&b, x), r = bed_read(&b, x + step);
            if (fabs(r.x - l.x) > 3 * step / 1e-3) /* a kink lies between */
                continue;
            seen++;
            ck_assert_double_eq_tol(m.x, (r.z - l.z) / (2 * step), 1e-7);
            ck_assert_double_eq_tol(m.xx, (r.x - l.x) / (2 * step), smooth ? 1 : 1e-2);
            if (!smooth) ck_assert_double_lt(m.xx, -1 / 1e-3 * (1 - 1e-12));
        }
        ck_assert_int_gt(seen, 1800);
        arena_close(b.arena);
    }
    smooth = false;
}
END_TEST

UNIT("rolling_envelope", the_plain_maximum, many_at_once, a_spike_is_one_arc, a_wave_is_a_parallel_curve, two_spikes,
     smooth_ground_against_a_search, switches_against_a_search, a_smooth_wave_is_a_parallel_curve, a_parabola_is_exact,
     a_switch_is_where_both_hold, order_does_not_matter, blocks_see_all_heights, blocks_of_smooth_ground,
     a_shorter_reach, a_greater_span_is_told_once, derivatives_between_kinks)
