/* Separate poles between places: against the formulas of papers/000 section 2.4 written out with libm, mode by mode;
   continuity over the edges of triangles; pairing; fading where a place lacks a mode and at half the sample rate. */
#include "tables.h"

#include "response/places.h"

static struct arena *arena;
static const double pi = 3.14159265358979323846;

static void setup(void)
{
    arena = arena_open();
    srand48(5);
}
static void teardown(void) { arena_close(arena); }

enum { MODES = 23, PLACES = 9 };

/* frequency <= 0: the place lacks the mode */
struct known {
    double x, y, f[MODES], d[MODES], g[MODES], phase[MODES];
};

static char *text_of(const struct known *k, int places, const char *head)
{
    static char text[100000];
    snprintf(text, sizeof text, "%s%s", head, COLUMNS);
    for (int p = 0; p < places; p++)
        for (int i = 0; i < MODES; i++)
            if (k[p].f[i] > 0)
                sprintf(text + strlen(text), "%d,%.17g,%.17g,m%d,%.17g,%.17g,%.17g,%.17g\n", p, k[p].x, k[p].y, i,
                        k[p].f[i], k[p].d[i], k[p].g[i], k[p].phase[i]);
    return text;
}

static void fill(struct known *k, int places, double missing)
{
    for (int p = 0; p < places; p++)
        for (int i = 0; i < MODES; i++) {
            double f = 200 * pow(1.2, i) * exp(0.06 * (drand48() - 0.5));
            k[p].f[i] = drand48() < missing ? -1 : f;
            k[p].d[i] = exp(1 + 3 * drand48());
            k[p].g[i] = (drand48() < 0.5 ? -1 : 1) * exp(4 * drand48());
            k[p].phase[i] = 20 * (drand48() - 0.5);
        }
    k[0].f[MODES - 1] = 200 * pow(1.2, MODES - 1); /* known somewhere */
}

/* Shorter turn from a to b, in rad. */
static double turn(double a, double b)
{
    double t = fmod(b - a, 2 * pi);
    return t > pi ? t - 2 * pi : t < -pi ? t + 2 * pi : t;
}

static double angle(const struct known *k, int i) { return k->phase[i] + (k->g[i] < 0 ? pi : 0); }

/* Which component is mode i: the one whose frequency at place p is k[p].f[i]. */
static int component(const struct modes *m, const struct known *k, int p, int i)
{
    struct modes_point at = modes_point_make(arena, m->n);
    int found = -1;
    table_at(m, k[p].x, k[p].y, &at);
    for (int c = 0; c < m->n; c++)
        if (fabs(at.frequency[c] / k[p].f[i] - 1) < 1e-12) {
            ck_assert_int_lt(found, 0);
            found = c;
        }
    ck_assert_int_ge(found, 0);
    return found;
}

static void check(const struct modes_point *at, int c, double f, double d, double size, double phase)
{
    ck_assert_double_eq_tol(at->frequency[c] / f, 1, 1e-13);
    ck_assert_double_eq_tol(at->decay[c] / d, 1, 1e-13);
    ck_assert_double_eq_tol(at->re[c], size * cos(phase), 2e-13 * size + 1e-300);
    ck_assert_double_eq_tol(at->im[c], size * sin(phase), 2e-13 * size + 1e-300);
}

/* Two places: every mode at every share, those that one of them lacks too. */
START_TEST(on_a_line)
{
    static struct known k[2];
    setup();
    k[1].x = 0.3;
    for (int trial = 0; trial < 20; trial++) {
        fill(k, 2, 0.2);
        for (int i = 0; i < MODES; i++)
            if (k[1].f[i] < 0 && k[0].f[i] < 0) k[1].f[i] = 200 * pow(1.2, i);
        struct modes m = table_of(text_of(k, 2, "# pairing: ids\n" SEPARATE), MODES, arena);
        struct modes_point at = modes_point_make(arena, m.n);
        ck_assert(!m.shared && m.moves && m.n == MODES);
        for (int i = 0; i < MODES; i++) {
            int c = component(&m, k, k[0].f[i] > 0 ? 0 : 1, i);
            for (int s = 0; s <= 8; s++) {
                double w = s / 8.0;
                ck_assert(table_at(&m, 0.3 * w, 0, &at) == 0);
                if (k[0].f[i] > 0 && k[1].f[i] > 0)
                    check(&at, c, pow(k[0].f[i], 1 - w) * pow(k[1].f[i], w), pow(k[0].d[i], 1 - w) * pow(k[1].d[i], w),
                          pow(fabs(k[0].g[i]), 1 - w) * pow(fabs(k[1].g[i]), w),
                          angle(&k[0], i) + w * turn(angle(&k[0], i), angle(&k[1], i)));
                else {
                    int p = k[0].f[i] > 0 ? 0 : 1;
                    check(&at, c, k[p].f[i], k[p].d[i], (p ? w : 1 - w) * fabs(k[p].g[i]), angle(&k[p], i));
                }
            }
        }
    }
    teardown();
}
END_TEST

/* The table's own values at its places, and frequency, decay where the mode is strongest as the modes' own. */
START_TEST(at_the_places)
{
    static struct known k[PLACES];
    setup();
    for (int p = 0; p < PLACES; p++)
        k[p].x = drand48(), k[p].y = drand48();
    fill(k, PLACES, 0);
    struct modes m = table_of(text_of(k, PLACES, SEPARATE), MODES, arena);
    struct modes_point at = modes_point_make(arena, m.n);
    for (int i = 0; i < MODES; i++) {
        int c = component(&m, k, 0, i), best = 0;
        double slowest = 1e9;
        for (int p = 0; p < PLACES; p++) {
            ck_assert(table_at(&m, k[p].x, k[p].y, &at) == 0);
            check(&at, c, k[p].f[i], k[p].d[i], fabs(k[p].g[i]), angle(&k[p], i));
            best = k[p].g[i] * k[p].g[i] / k[p].d[i] > k[best].g[i] * k[best].g[i] / k[best].d[i] ? p : best;
            slowest = fmin(slowest, k[p].d[i]);
        }
        ck_assert(m.frequency[c] == k[best].f[i] && m.decay[c] == k[best].d[i] && m.slowest[c] == slowest);
    }
    teardown();
}
END_TEST

/* Three places. Phases within a third of a turn of each other: no edge goes the other way round. */
START_TEST(in_a_triangle)
{
    static struct known k[3];
    setup();
    k[1].x = 0.3, k[2].y = 0.2;
    for (int trial = 0; trial < 20; trial++) {
        fill(k, 3, 0.2);
        for (int i = 0; i < MODES; i++)
            for (int p = 0; p < 3; p++) {
                k[p].phase[i] = 5 * i + 1.1 * drand48() - (k[p].g[i] < 0 ? pi : 0);
                if (p == 2 && k[0].f[i] < 0 && k[1].f[i] < 0 && k[2].f[i] < 0) k[2].f[i] = 200 * pow(1.2, i);
            }
        struct modes m = table_of(text_of(k, 3, "# pairing: ids\n" SEPARATE), MODES, arena);
        struct modes_point at = modes_point_make(arena, m.n);
        for (int s = 0; s < 20; s++) {
            double w[3], u = drand48(), v = drand48();
            w[1] = u + v > 1 ? 1 - u : u, w[2] = u + v > 1 ? 1 - v : v, w[0] = 1 - w[1] - w[2];
            for (int i = 0; i < MODES; i++) {
                double share = 0, f = 0, d = 0, g = 0, phase = 0;
                int first = -1, c = -1;
                for (int p = 0; p < 3; p++)
                    if (k[p].f[i] > 0) {
                        first = first < 0 ? p : first;
                        share += w[p];
                        f += w[p] * log(k[p].f[i]);
                        d += w[p] * log(k[p].d[i]);
                        g += w[p] * log(fabs(k[p].g[i]));
                        phase += w[p] * turn(angle(&k[first], i), angle(&k[p], i));
                    }
                c = component(&m, k, first, i);
                ck_assert(table_at(&m, 0.3 * w[1], 0.2 * w[2], &at) == 0);
                check(&at, c, exp(f / share), exp(d / share), share * exp(g / share),
                      angle(&k[first], i) + phase / share);
            }
        }
    }
    teardown();
}
END_TEST

/* Any phases, signs and missing modes on a grid: nothing jumps over an edge, and along an edge only its two ends count.
 */
START_TEST(continuous_everywhere)
{
    static struct known k[PLACES];
    setup();
    for (int p = 0; p < PLACES; p++)
        k[p].x = 0.1 * (p % 3), k[p].y = 0.1 * (p / 3);
    for (int trial = 0; trial < 6; trial++) {
        fill(k, PLACES, trial % 2 ? 0.2 : 0);
        for (int p = 0; p < PLACES; p++)
            for (int i = 0; trial % 3 == 0 && i < MODES; i++)
                k[p].phase[i] = 0.3; /* real gains of both signs */
        struct modes m = table_of(text_of(k, PLACES, "# pairing: ids\n" SEPARATE), MODES, arena);
        struct modes_point at[2] = {modes_point_make(arena, m.n), modes_point_make(arena, m.n)};
        for (int way = 0; way < 30; way++) {
            double x = 0.2 * drand48(), y = 0.2 * drand48(), dx = 0.2 * drand48() - x, dy = 0.2 * drand48() - y,
                   worst = 0;
            if (way % 3 == 0) /* along lines of the grid, on both sides of which there are triangles */
                dx = 0, x = 0.1;
            for (int s = 0; s <= 4000; s++) {
                struct modes_point *now = &at[s % 2], *before = &at[1 - s % 2];
                table_at(&m, x + dx * s / 4000, y + dy * s / 4000, now);
                for (int i = 0; s > 0 && i < m.n; i++)
                    worst = fmax(worst, fmax(fabs(now->re[i] - before->re[i]), fabs(now->im[i] - before->im[i])));
            }
            ck_assert_double_lt(
                worst, 60 * 0.01); /* the largest gain is exp(4), a change of sign takes 1/3 of the way or more */
            for (int side = -1; way % 3 == 0 && side <= 1; side += 2) {
                table_at(&m, 0.1, y, &at[0]);
                table_at(&m, 0.1 + side * 1e-9, y, &at[1]);
                for (int i = 0; i < m.n; i++) {
                    ck_assert_double_eq_tol(at[0].re[i], at[1].re[i], 60 * 1e-6);
                    ck_assert_double_eq_tol(at[0].im[i], at[1].im[i], 60 * 1e-6);
                }
            }
        }
    }
    teardown();
}
END_TEST

/* Phases 0, 120, 240 degrees at the corners: linear on every edge, and a zero inside. */
START_TEST(a_vortex_has_a_zero)
{
    static struct known k[3];
    setup();
    k[1].x = 1, k[2].x = 0.5, k[2].y = sqrt(0.75);
    for (int p = 0; p < 3; p++)
        for (int i = 0; i < MODES; i++)
            k[p].f[i] = 100 * (i + 1), k[p].d[i] = 3, k[p].g[i] = 2, k[p].phase[i] = 2 * pi * p / 3;
    struct modes m = table_of(text_of(k, 3, SEPARATE), MODES, arena);
    struct modes_point at = modes_point_make(arena, m.n);
    for (int s = 0; s <= 16; s++) {
        table_at(&m, s / 16.0, 0, &at);
        ck_assert_double_eq_tol(at.re[0], 2 * cos(2 * pi / 3 * s / 16), 1e-14);
        ck_assert_double_eq_tol(at.im[0], 2 * sin(2 * pi / 3 * s / 16), 1e-14);
    }
    table_at(&m, 0.5, sqrt(0.75) / 3, &at);
    ck_assert_double_lt(sqrt(at.re[0] * at.re[0] + at.im[0] * at.im[0]), 1e-12);
    teardown();
}
END_TEST

/* Poles that are equal everywhere are so to the last bit, wherever the contact is: what `glide`, `launch` and `readout`
 * agree on. */
START_TEST(equal_poles_stay)
{
    static struct known k[PLACES];
    setup();
    for (int p = 0; p < PLACES; p++)
        k[p].x = drand48(), k[p].y = drand48();
    fill(k, PLACES, 0);
    for (int p = 0; p < PLACES; p++)
        for (int i = 0; i < MODES; i++)
            k[p].f[i] = k[0].f[i], k[p].d[i] = k[0].d[i];
    struct modes m = table_of(text_of(k, PLACES, SEPARATE), MODES, arena);
    struct modes_point at = modes_point_make(arena, m.n);
    for (int s = 0; s < 200; s++) {
        table_at(&m, drand48(), drand48(), &at);
        ck_assert(memcmp(at.frequency, m.frequency, MODES * sizeof(double)) == 0 &&
                  memcmp(at.decay, m.decay, MODES * sizeof(double)) == 0);
    }
    teardown();
}
END_TEST

/* A gain below -120 dB of the mode's largest is taken for that; one of 0 is a mode that is missing: it fades linearly.
 */
START_TEST(very_weak_gains)
{
    setup();
    struct modes m = table_of(SEPARATE COLUMNS "1,0,0,a,100,1,8,0\n2,1,0,a,110,2,1e-30,0\n1,0,0,b,300,1,8,0\n2,1,0,b,"
                                               "310,2,0,0\n1,0,0,c,500,9,0,0\n2,1,0,c,500,9,0,0\n",
                              9, arena);
    struct modes_point p = modes_point_make(arena, m.n);
    table_at(&m, 1, 0, &p);
    ck_assert_double_eq_tol(p.re[0], 8e-6, 1e-18);
    ck_assert(p.re[1] == 0 && p.im[1] == 0);
    table_at(&m, 0.5, 0, &p);
    ck_assert_double_eq_tol(p.re[0], 8e-3, 1e-15);
    ck_assert_double_eq_tol(p.re[1], 4, 1e-14);
    ck_assert(p.frequency[1] == 300 && p.decay[1] == 1);
    ck_assert(p.re[2] == 0 && p.im[2] == 0 && p.frequency[2] == 500 && p.decay[2] == 9); /* silent everywhere */
    teardown();
}
END_TEST

/* A mode whose frequency crosses 0.45 to 0.5 of the rate, 48 kHz: the raised cosine; what nowhere lies below 0.45 is
 * dropped. */
START_TEST(fades_at_half_the_rate)
{
    setup();
    struct modes m =
        table_of(SEPARATE COLUMNS "1,0,0,a,20000,5,2,0\n2,1,0,a,26000,5,2,0\n1,0,0,b,23960,5,1,0\n2,1,0,b,24100,5,1,0\n"
                                  "1,0,0,c,900,7,1,0\n2,1,0,c,950,6,1,1\n",
                 9, arena);
    struct modes_point p = modes_point_make(arena, m.n);
    ck_assert_int_eq(modes_drop_above(&m, 48000), 1);
    ck_assert(m.n == 2 && m.frequency[0] == 20000 && m.slowest[1] == 6);
    for (int s = 0; s <= 100; s++) {
        double w = s / 100.0, f = 20000 * pow(1.3, w), u = fmin(fmax((f / 48000 - 0.45) / 0.05, 0), 1);
        table_at(&m, w, 0, &p);
        ck_assert_double_eq_tol(p.frequency[0], f, 1e-9);
        ck_assert_double_eq_tol(p.re[0], 2 * 0.5 * (1 + cos(pi * u)), 1e-12);
        ck_assert_double_eq_tol(p.re[1], cos(w), 1e-13);
        ck_assert_double_eq_tol(p.frequency[1], 900 * pow(950 / 900.0, w), 1e-10);
    }
    ck_assert(p.re[0] == 0);
    teardown();
}
END_TEST

/* Half a turn could go either way: it goes the one that does not pass 2 pi, from both ends. */
START_TEST(a_change_of_sign_turns)
{
    setup();
    struct modes m =
        table_of(SEPARATE COLUMNS "1,0,0,a,100,5,1,0.5\n2,1,0,a,100,5,-1,0.5\n3,2,0,a,100,5,1,0.5\n", 9, arena);
    struct modes_point p = modes_point_make(arena, m.n);
    for (int k = 0; k <= 20; k++) {
        double w = k / 10.0, angle = 0.5 + pi * (w < 1 ? w : 2 - w);
        table_at(&m, w, 0, &p);
        ck_assert_double_eq_tol(p.re[0], cos(angle), 1e-14);
        ck_assert_double_eq_tol(p.im[0], sin(angle), 1e-14);
    }
    teardown();
}
END_TEST

/* Ids that are not the same everywhere: modes are paired by frequency, unless the table says ids; the gate is that
 * asked for. */
START_TEST(pairing_of_a_table)
{
    setup();
    static const char rows[] =
        "1,0,0,a,100,5,1,0\n1,0,0,b,200,5,1,0\n1,0,0,c,300,5,1,0\n2,1,0,a,201,5,1,0\n2,1,0,b,303,5,1,0\n";
    char text[600];
    struct modes m;
    struct err e;
    snprintf(text, sizeof text, "%s%s%s", SEPARATE, COLUMNS, rows);
    m = table_of(text, 9, arena);
    struct modes_point p = modes_point_make(arena, 9);
    ck_assert_int_eq(m.n, 3);
    table_at(&m, 1, 0, &p);
    for (int i = 0; i < 3; i++) {
        double size = sqrt(p.re[i] * p.re[i] + p.im[i] * p.im[i]), f = p.frequency[i];
        ck_assert((fabs(f - 100) < 1e-9 && size == 0) || (fabs(f - 201) < 1e-9 && size > 0.99) ||
                  (fabs(f - 303) < 1e-9 && size > 0.99));
    }
    ck_assert(
        csv_table_read(text, &(struct modes_ask){.strongest = 9, .pairing = 0.006, .rate = 48000}, arena, &m, &e) &&
        m.n == 4); /* 200, 201 pair; 300, 303 do not */
    snprintf(text, sizeof text, "# pairing: ids\n%s%s%s", SEPARATE, COLUMNS, rows);
    m = table_of(text, 9, arena);
    ck_assert_int_eq(m.n, 3);
    table_at(&m, 0.5, 0, &p);
    ck_assert_double_eq_tol(p.frequency[0] * p.frequency[1] * p.frequency[2] / 300, sqrt(100 * 201) * sqrt(200 * 303),
                            1e-6);
    snprintf(text, sizeof text,
             "%s%s1,0,0,a,100,5,1,0\n1,0,0,b,200,5,1,0\n1,0,0,c,300,5,1,0\n2,1,0,a,105,5,1,0\n2,1,0,c,320,5,1,0\n",
             SEPARATE, COLUMNS);
    m = table_of(text, 9, arena); /* one is lacking, the others' names hold, farther apart than the gate */
    ck_assert(m.n == 3 && m.note && strstr(m.note, "paired by name"));
    snprintf(text, sizeof text,
             "# pairing: frequency\n%s%s1,0,0,a,100,5,1,0\n1,0,0,b,200,5,1,0\n2,1,0,a,200,5,1,0\n2,1,0,b,100,5,1,0\n",
             SEPARATE, COLUMNS);
    m = table_of(text, 9, arena);
    table_at(&m, 0.3, 0, &p);
    ck_assert(m.n == 2 &&
              ((p.frequency[0] == 100 && p.frequency[1] == 200) || (p.frequency[1] == 100 && p.frequency[0] == 200)));
    teardown();
}
END_TEST

/* Slopes are matched by order of decay, whatever their numbers; a place with fewer lacks the later ones. */
START_TEST(slopes_between_places)
{
    setup();
    struct modes m = table_of(
        SEPARATE
        "place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad,slope\n"
        "1,0,0,a,100,50,1,0,1\n1,0,0,a,100,5,4,0,2\n2,1,0,a,121,20,1,0,1\n2,1,0,a,121,200,9,0,2\n3,2,0,a,100,8,3,0,1\n",
        1, arena);
    struct modes_point p = modes_point_make(arena, m.n);
    ck_assert_int_eq(m.n, 2);
    table_at(&m, 0.5, 0, &p);
    for (int i = 0; i < 2; i++)
        ck_assert_double_eq_tol(p.frequency[i], 110, 1e-11);
    ck_assert_double_eq_tol(p.decay[0], 10, 1e-13);
    ck_assert_double_eq_tol(p.re[0], 2, 1e-13);
    ck_assert_double_eq_tol(p.decay[1], 100, 1e-12);
    ck_assert_double_eq_tol(p.re[1], 3, 1e-13);
    table_at(&m, 1.75, 0, &p);
    ck_assert_double_eq_tol(p.re[1], 9 * 0.25, 1e-12);
    ck_assert(p.decay[1] == 200);
    teardown();
}
END_TEST

/* Any phases, decays, signs and missing modes on a grid: a mirrored table is the same, mirrored; nothing is larger than
 * the largest of a cell's corners, nor has a pole beyond theirs. */
START_TEST(grids_are_symmetric)
{
    enum { NX = 4, NY = 3 };
    static struct known k[NX * NY], mirror[NX * NY];
    setup();
    for (int trial = 0; trial < 24; trial++) {
        fill(k, NX * NY, trial % 2 ? 0.2 : 0);
        for (int p = 0; p < NX * NY; p++) {
            k[p].x = 0.1 * (p % NX) + 0.02 * (p % NX == 2), k[p].y = 0.1 * (p / NX);
            for (int i = 0; trial % 3 == 0 && i < MODES; i++)
                k[p].phase[i] = 0.3; /* changes of sign alone */
        }
        for (int p = 0; p < NX * NY; p++) {
            mirror[NX * NY - 1 - p] = k[p]; /* in another order, too */
            if (trial % 4 < 2)
                mirror[NX * NY - 1 - p].x = 0.3 - k[p].x;
            else
                mirror[NX * NY - 1 - p].y = 0.2 - k[p].y;
        }
        struct modes m = table_of(text_of(k, NX * NY, "# pairing: ids\n" SEPARATE), MODES, arena),
                     o = table_of(text_of(mirror, NX * NY, "# pairing: ids\n" SEPARATE), MODES, arena);
        struct modes_point a = modes_point_make(arena, m.n), b = modes_point_make(arena, m.n),
                           at = modes_point_make(arena, m.n);
        ck_assert(places_kind(m.places) == PLACES_GRID && m.n == MODES && o.n == MODES);
        for (int q = 0; q < 500; q++) {
            double x = 0.3 * drand48(), y = 0.2 * drand48(), most[MODES] = {0}, low[MODES], high[MODES] = {0};
            for (int i = 0; i < MODES; i++)
                low[i] = 1e9;
            table_at(&m, x, y, &a);
            table_at(&o, trial % 4 < 2 ? 0.3 - x : x, trial % 4 < 2 ? y : 0.2 - y, &b);
            for (int p = 0; p < NX * NY; p++) {
                int column = x < 0.1 ? 0 : x < 0.22 ? 1 : 2, row = y < 0.1 ? 0 : 1;
                if (p % NX < column || p % NX > column + 1 || p / NX < row || p / NX > row + 1) continue;
                table_at(&m, k[p].x, k[p].y, &at);
                for (int i = 0; i < MODES; i++) {
                    double size = sqrt(at.re[i] * at.re[i] + at.im[i] * at.im[i]);
                    most[i] = fmax(most[i], size);
                    high[i] = size > 0 ? fmax(high[i], at.frequency[i]) : high[i];
                    low[i] = size > 0 ? fmin(low[i], at.frequency[i]) : low[i];
                }
            }
            for (int i = 0; i < MODES; i++) {
                double size = sqrt(a.re[i] * a.re[i] + a.im[i] * a.im[i]);
                ck_assert_double_eq_tol(a.re[i], b.re[i], 1e-10 * (most[i] + 1e-3));
                ck_assert_double_eq_tol(a.im[i], b.im[i], 1e-10 * (most[i] + 1e-3));
                ck_assert_double_eq_tol(a.frequency[i], b.frequency[i], 1e-11 * a.frequency[i]);
                ck_assert_double_le(size, most[i] * (1 + 1e-12));
                if (high[i] > 0 && size > 1e-9)
                    ck_assert(a.frequency[i] <= high[i] * (1 + 1e-12) && a.frequency[i] >= low[i] * (1 - 1e-12));
            }
        }
    }
    teardown();
}
END_TEST

/* Complex gains of separate poles on a line: cubics of the place come out as they are, gains through zero, poles in the
   logarithm; a place that lacks a mode has it with a gain of 0 and the poles it has where it is strongest; what nears
   half the rate fades. Logarithmic gains of the same table turn at the change of sign. */
START_TEST(complex_gains)
{
    enum { N = 7 };
    char text[2000], *to = text;
    setup();
    to += sprintf(to, "# gains: complex\n%s%s", SEPARATE, COLUMNS);
    for (int i = 0; i < N; i++) {
        double x = 0.1 * i, u = x - 0.23;
        to += sprintf(to, "%d,%.17g,0,a,%.17g,%.17g,%.17g,0.3\n", i + 1, x, 500 * exp(u * u * u), 20 * exp(u - u * u),
                      u * (1 + u * u));
        if (i != 2) to += sprintf(to, "%d,%.17g,0,b,%.17g,%.17g,2,1\n", i + 1, x, 3000.0, 30.0);
        to += sprintf(to, "%d,%.17g,0,c,22800,40,1.5,0\n", i + 1, x);
    }
    struct modes m = table_of(text, 9, arena);
    struct modes_point p = modes_point_make(arena, m.n);
    ck_assert(m.n == 3 && !m.shared);
    for (int q = 0; q <= 60; q++) {
        double x = 0.01 * q, u = x - 0.23;
        table_at(&m, x, 0, &p);
        for (int i = 0; i < 3; i++) {
            bool a = p.frequency[i] < 1000, b = !a && p.frequency[i] < 5000;
            if (a) {
                ck_assert_double_eq_tol(p.frequency[i] / (500 * exp(u * u * u)), 1, 1e-13);
                ck_assert_double_eq_tol(p.decay[i] / (20 * exp(u - u * u)), 1, 1e-13);
                ck_assert_double_eq_tol(p.re[i], u * (1 + u * u) * cos(0.3), 1e-14);
                ck_assert_double_eq_tol(p.im[i], u * (1 + u * u) * sin(0.3), 1e-14);
            } else if (b) {
                ck_assert(fabs(p.frequency[i] / 3000 - 1) < 1e-14 && fabs(p.decay[i] / 30 - 1) < 1e-14);
                ck_assert(q != 20 || (p.re[i] == 0 && p.im[i] == 0));
                ck_assert(q % 10 || q == 20 || fabs(p.re[i] - 2 * cos(1)) < 1e-14);
            } else
                ck_assert_double_eq_tol(p.re[i], 1.5 * 0.5,
                                        1e-13); /* 22.8 kHz: in the middle of 0.45 to 0.5 of 48 kHz */
        }
    }
    m = table_of(strchr(text, '\n') + 1, 9, arena);
    table_at(&m, 0.25, 0, &p);
    for (int i = 0; i < 3; i++)
        ck_assert(p.frequency[i] > 1000 || hypot(p.re[i], p.im[i]) > 0.02); /* there the cubic is at 0.02 */
    teardown();
}
END_TEST

UNIT("morph", on_a_line, at_the_places, in_a_triangle, continuous_everywhere, a_vortex_has_a_zero, equal_poles_stay,
     very_weak_gains, fades_at_half_the_rate, a_change_of_sign_turns, pairing_of_a_table, slopes_between_places,
     grids_are_symmetric, complex_gains)
