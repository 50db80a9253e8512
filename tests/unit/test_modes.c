/* modes_table: reading in any order, gains at and between places, strength against energies summed sample by sample,
   slopes, envelopes, all that is refused. What separate poles do between places is in test_morph.c. */
#include "tables.h"

static struct arena *arena;

static void setup(void) { arena = arena_open(); }
static void teardown(void) { arena_close(arena); }

/* Refused with that exit code, and the message holds that text. */
static void refused(const char *text, const char *says)
{
    struct modes m;
    struct err e;
    bool ok = csv_table_read(text, &(struct modes_ask){.strongest = 50, .pairing = 0.03, .rate = 48000}, arena, &m, &e);
    ck_assert_msg(!ok, "accepted, but should say: %s", says);
    ck_assert_msg(strstr(e.text, says) != NULL, "\"%s\" does not say \"%s\"", e.text, says);
    ck_assert_int_eq(e.kind, ERR_SCENE);
}

/* Three places in any order on a slanted line, modes in any order; gains by place a: 1, 10; b: 2, 20; c: -3, 30. */
static const char table[] = HEAD "b,1.3,1.4,hi,2000,20,20,1.5\n"
                                 "a,1,1,lo,100,10,1,0\n"
                                 "c,1.6,1.8,hi,2000,20,30,1.5\n"
                                 "a,1,1,hi,2000,20,10,1.5\n"
                                 "c,1.6,1.8,lo,100,10,-3,0\n"
                                 "b,1.3,1.4,lo,100,10,2,0\n";

START_TEST(reads_any_order)
{
    setup();
    struct modes m = table_of(table, 50, arena);
    struct modes_point p = modes_point_make(arena, m.n);
    ck_assert(m.n == 2 && m.quantity == MODES_VELOCITY && m.shared && m.moves && !m.travels && !m.object && !m.note &&
              isnan(m.radius));
    ck_assert(m.frequency[0] == 2000 && m.frequency[1] == 100 && m.decay[0] == 20 && m.decay[1] == 10 &&
              m.slowest[0] == 20 && m.slowest[1] == 10);
    ck_assert(m.home[0] == 1 && m.home[1] == 1);
    for (int k = 0; k < 3; k++) {
        ck_assert(table_at(&m, 1 + 0.3 * k, 1 + 0.4 * k, &p) == 0);
        ck_assert_double_eq_tol(p.re[0], 10 * (k + 1) * cos(1.5), 1e-12);
        ck_assert_double_eq_tol(p.im[0], 10 * (k + 1) * sin(1.5), 1e-12);
        ck_assert_double_eq_tol(p.re[1], k < 2 ? k + 1 : -3, 1e-12);
        ck_assert(p.im[1] == 0 && p.frequency[0] == 0); /* shared poles are left alone */
    }
    table_at(&m, 1, 1, &(struct modes_point){NULL, NULL, p.re, p.im});
    ck_assert(p.re[1] == 1);
    teardown();
}
END_TEST

START_TEST(gains_between_and_beyond)
{
    setup();
    struct modes m = table_of(table, 50, arena);
    struct modes_point p = modes_point_make(arena, m.n);
    ck_assert(table_at(&m, 1.15, 1.2, &p) == 0);
    ck_assert_double_eq_tol(p.re[1], 2.25, 1e-12);            /* the parabola through 1, 2, -3: 1 + u - 3 u (u - 1) */
    ck_assert(table_at(&m, 1.3 + 0.24, 1.4 + 0.32, &p) == 0); /* u = 1.8 */
    ck_assert_double_eq_tol(p.re[1], 1 + 1.8 - 3 * 1.8 * 0.8, 1e-12);
    ck_assert_double_eq_tol(p.im[0], 28 * sin(1.5), 1e-12);
    ck_assert_double_eq_tol(table_at(&m, 1 - 0.06, 1 - 0.08, &p), 0.1, 1e-12); /* before the first place */
    ck_assert_double_eq_tol(p.re[1], 1, 1e-12);
    ck_assert_double_eq_tol(table_at(&m, 1.6 + 3, 1.8 + 4, &p), 5, 1e-12); /* beyond the last */
    ck_assert_double_eq_tol(p.re[1], -3, 1e-12);
    ck_assert_double_eq_tol(table_at(&m, 1.3 - 0.8, 1.4 + 0.6, &p), 1, 1e-12); /* beside the line: its foot */
    ck_assert_double_eq_tol(p.re[1], 2, 1e-12);
    ck_assert(table_at(&m, 1 - 5e-10, 1, &p) == 0); /* rounding of a path is not outside */
    teardown();
}
END_TEST

/* Signed gains in the plane are the plane through a triangle's corners; nodal lines are crossed with their sign. */
START_TEST(gains_in_the_plane)
{
    setup();
    char text[4096] = HEAD;
    for (int i = 0; i < 9;
         i++) /* places on a grid of 0.1 m; the gain is 1 + 20 x - 30 y: linear everywhere, whatever the triangles */
        sprintf(text + strlen(text), "%d,%g,%g,m,500,3,%.17g,0.25\n", i, 0.1 * (i % 3), 0.1 * (i / 3),
                1 + 20 * 0.1 * (i % 3) - 30 * 0.1 * (i / 3));
    struct modes m = table_of(text, 50, arena);
    struct modes_point p = modes_point_make(arena, m.n);
    for (int i = 0; i < 100; i++) {
        double x = 0.2 * drand48(), y = 0.2 * drand48(), gain = 1 + 20 * x - 30 * y;
        ck_assert(table_at(&m, x, y, &p) == 0);
        ck_assert_double_eq_tol(p.re[0], gain * cos(0.25), 1e-13);
        ck_assert_double_eq_tol(p.im[0], gain * sin(0.25), 1e-13);
    }
    ck_assert_double_eq_tol(table_at(&m, 0.1, 0.5, &p), 0.3, 1e-15);
    ck_assert_double_eq_tol(p.re[0], (1 + 2 - 6) * cos(0.25), 1e-14);
    teardown();
}
END_TEST

START_TEST(one_place_is_everywhere)
{
    setup();
    static const char *const heads[2] = {HEAD, SEPARATE COLUMNS};
    for (int k = 0; k < 2; k++) {
        char text[500];
        snprintf(text, sizeof text, "%s1,0.2,0.3,1,440,%d,2,0\n", heads[k], 5 - 5 * k);
        struct modes m = table_of(text, 50, arena);
        struct modes_point p = modes_point_make(arena, m.n);
        ck_assert(table_at(&m, 7, -3, &p) == 0 && p.re[0] == 2 && p.im[0] == 0);
        ck_assert(m.shared && !m.moves && m.decay[0] == 5 - 5 * k && m.home[0] == 0.2 && m.home[1] == 0.3);
    }
    teardown();
}
END_TEST

/* Energy gain^2/(4 decay): a mode that is weak but long may be the stronger; one without decay beats all, unless it is
 * silent. */
START_TEST(the_strongest_are_kept)
{
    setup();
    struct modes m = table_of(
        HEAD "1,0,0,a,100,400,2,0\n1,0,0,b,200,4,1,0\n1,0,0,c,300,0,1e-9,0\n1,0,0,d,400,0,0,0\n1,0,0,e,500,4,-1,0\n", 4,
        arena);
    struct modes_point p = modes_point_make(arena, m.n);
    ck_assert_int_eq(m.n, 4);
    ck_assert(m.frequency[0] == 300 && m.frequency[1] == 200 && m.frequency[2] == 500 && m.frequency[3] == 100);
    table_at(&m, 0, 0, &p);
    ck_assert(p.re[2] == -1);
    ck_assert(isinf(modes_ring_time(&m, 60)));
    teardown();
}
END_TEST

/* Energy of one impulse by summation, over as long as the slowest mode needs. */
static double summed_energy(double frequency, double decay, double gain, double phase)
{
    double sum = 0, step = 1e-5;
    for (double t = step / 2; t < 8 / decay; t += step) {
        double h = gain * exp(-decay * t) * sin(2 * 3.14159265358979323846 * frequency * t + phase);
        sum += h * h * step;
    }
    return sum;
}

/* Strength is that energy, summed over the places: not the gain, not gain / decay, not the place where a mode is
   loudest, nor the gains' sum, in which signs cancel. The closed form leaves out what the phase does within a period,
   decay / omega of it: below 1e-2 here, while energies are all 3e-2 apart. */
START_TEST(strength_is_energy_over_all_places)
{
    enum { MODES = 7, PLACES = 3, KEPT = 5 };
    static const double decay[MODES] = {20, 5, 60, 10, 40, 8, 15},
                        gain[MODES][PLACES] = {{2, 2, 2},        {1.1, -1.1, 1.1}, {5.8, 0, 0},    {1.5, -1.6, 0},
                                               {-2.6, 2.6, 2.6}, {0, 0, 1.7},      {0.5, 0.5, 0.5}};
    char text[4096] = HEAD;
    double energy[MODES];
    int order[MODES];
    setup();
    for (int i = 0; i < MODES; i++) {
        energy[i] = 0;
        order[i] = i;
        for (int p = 0; p < PLACES; p++) {
            energy[i] += summed_energy(1000 + i, decay[i], gain[i][p], 0.7 * i);
            sprintf(text + strlen(text), "p%d,%d,0,m%d,%d,%g,%g,%g\n", p, p, i, 1000 + i, decay[i], gain[i][p],
                    0.7 * i);
        }
    }
    for (int i = 0; i < MODES; i++)
        for (int k = i + 1; k < MODES; k++)
            if (energy[order[k]] > energy[order[i]]) {
                int swap = order[i];
                order[i] = order[k], order[k] = swap;
            }
    for (int i = 1; i < MODES; i++)
        ck_assert_double_lt(energy[order[i]], 0.97 * energy[order[i - 1]]);
    struct modes m = table_of(text, KEPT, arena);
    ck_assert_int_eq(m.n, KEPT);
    for (int i = 0; i < KEPT; i++)
        ck_assert_msg(m.frequency[i] == 1000 + order[i], "rank %d: %g Hz, expected %d", i, m.frequency[i],
                      1000 + order[i]);
    teardown();
}
END_TEST

#define SLOPES "place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad,slope\n"

/* A mode of two slopes is one mode in the strongest, two components; its energy is that of the sum of its slopes, in
 * which they interfere. */
START_TEST(slopes_are_one_mode)
{
    setup();
    static const char text[] = SHARED SLOPES "1,0,0,a,700,4,0.3,0,1\n1,0,0,a,700,40,2,0,2\n1,0,0,b,800,20,1.2,0,1\n"
                                             "1,0,0,c,900,5,3,3.14159265358979,2\n1,0,0,c,900,4,3,0,1\n";
    double two = 0, one = summed_energy(800, 20, 1.2, 0), c = 0, step = 1e-5;
    for (double t = step / 2; t < 4; t += step) {
        double x = (0.3 * exp(-4 * t) + 2 * exp(-40 * t)) * sin(2 * acos(-1.0) * 700 * t),
               y = 3 * (exp(-4 * t) - exp(-5 * t)) * sin(2 * acos(-1.0) * 900 * t);
        two += x * x * step;
        c += y * y * step;
    }
    ck_assert(two > one && one > 1.3 * c &&
              9 / 16.0 > 10 * one); /* c's slopes nearly cancel: weakest, though each alone would be the strongest */
    struct modes m = table_of(text, 2, arena);
    struct modes_point p = modes_point_make(arena, m.n);
    ck_assert_int_eq(m.n, 3);
    ck_assert(m.frequency[0] == 700 && m.frequency[1] == 700 && m.frequency[2] == 800);
    ck_assert(m.decay[0] == 4 && m.decay[1] == 40 && m.decay[2] == 20);
    table_at(&m, 0, 0, &p);
    ck_assert(p.re[0] == 0.3 && p.re[1] == 2 && p.re[2] == 1.2);
    m = table_of(text, 50, arena);
    ck_assert(m.n == 5 && m.frequency[4] == 900 && m.decay[3] == 4);
    ck_assert_double_eq_tol(modes_ring_time(&m, 60), log(1000) / 4, 1e-12);
    teardown();
}
END_TEST

#define ENVELOPE "place,x_m,y_m,mode,frequency_hz,time_s,amplitude,phase_rad\n"

/* Envelopes of two shared decays at two places, one with an attack: the components' sum is the envelope, also between
 * the places. */
START_TEST(envelopes_become_slopes)
{
    setup();
    static char text[40000];
    for (int separate = 0; separate < 2; separate++) {
        snprintf(text, sizeof text, "%s%s", separate ? SEPARATE : SHARED, ENVELOPE);
        for (int i = 0; i < 100; i++)
            for (int p = 0; p < 2; p++) {
                double t = 0.005 * (i * 37 % 100),
                       a = p ? 0.5 * exp(-5 * t) + 3 * exp(-50 * t) : 2 * (exp(-5 * t) - exp(-50 * t));
                sprintf(text + strlen(text), "%c,%d,0,x,300,%.17g,%.17g,0.5\n", 'a' + p, p, t, a);
            }
        struct modes m = table_of(text, 1, arena);
        struct modes_point p = modes_point_make(arena, m.n);
        ck_assert(m.n == 2 && m.note == NULL);
        ck_assert_double_eq_tol(m.decay[0], 5, 1e-4);
        ck_assert_double_eq_tol(m.decay[1], 50, 1e-3);
        table_at(&m, 0, 0, &p);
        ck_assert_double_eq_tol(p.re[0] / cos(0.5), 2, 1e-4);
        ck_assert_double_eq_tol(p.im[1] / sin(0.5), -2, 1e-4);
        table_at(&m, 1, 0, &p);
        ck_assert_double_eq_tol(p.re[0] / cos(0.5), 0.5, 1e-4);
        ck_assert_double_eq_tol(p.re[1] / cos(0.5), 3, 1e-4);
    }
    teardown();
}
END_TEST

/* What decaying exponentials do not meet: a warning above -40 dB, an error above -20 dB, both with the line of the
 * mode. */
START_TEST(envelopes_out_of_reach)
{
    setup();
    static char text[20000];
    for (int kind = 0; kind < 2; kind++) {
        snprintf(text, sizeof text, "%s%s1,0,0,q,100,0,1,0\n1,0,0,q,100,1,0.5,0\n", SHARED, ENVELOPE);
        for (int i = 0; i < 100; i++) {
            double t = 0.01 * i, a = kind ? t < 0.5 : exp(-3 * t) * (1 + 0.05 * sin(40 * t));
            sprintf(text + strlen(text), "1,0,0,x,300,%.17g,%.17g,0\n", t, a);
        }
        if (kind) {
            refused(text, ":7: the envelope of mode 'x' is met by decaying exponentials to -1");
            continue;
        }
        struct modes m = table_of(text, 50, arena);
        ck_assert_msg(m.note && strstr(m.note, ":7: the envelope of mode 'x' is met by decaying exponentials to -3") &&
                          strstr(m.note, "1 of 2 "),
                      "%s", m.note);
    }
    teardown();
}
END_TEST

/* The strongest of the band, whatever the rate: its lower end counts, its upper does not, each to 1e-9; of separate
 * poles a mode that is somewhere inside. */
START_TEST(the_strongest_of_a_band)
{
    setup();
    const char *text =
        HEAD "1,0,0,a,1000,1,1,0\n1,0,0,b,2000,1,9,0\n1,0,0,c,1500,1,2,0\n1,0,0,d,999.9999,1,9,0\n1,0,0,e,1999,1,3,0\n";
    const char *moving = SEPARATE COLUMNS "1,0,0,a,900,1,1,0\n2,1,0,a,1000,1,1,0\n1,0,0,b,2000,1,2,0\n2,1,0,b,1999,1,2,"
                                          "0\n1,0,0,c,2001,1,9,0\n2,1,0,c,2000,1,9,0\n";
    struct modes m[4];
    struct err e = {0};
    for (int k = 0; k < 2; k++) {
        double rate = k ? 192000 : 4000, shift = k ? 1 - 3e-10 : 1 + 3e-10;
        struct modes_ask ask = {.strongest = 2, .band = {1000 * shift, 2000 * shift}, .pairing = 0.2, .rate = rate};
        ck_assert_msg(csv_table_read(text, &ask, arena, &m[k], &e), "%s", e.text);
        ck_assert(m[k].n == 2 && m[k].frequency[0] == 1999 && m[k].frequency[1] == 1500);
        ask.strongest = 50;
        ck_assert_msg(csv_table_read(text, &ask, arena, &m[k], &e), "%s", e.text);
        ck_assert(m[k].n == 3 && m[k].frequency[2] == 1000);
        ck_assert_msg(csv_table_read(moving, &ask, arena, &m[2 + k], &e), "%s", e.text);
        ck_assert_int_eq(m[2 + k].n, 2);
    }
    struct modes_ask none = {.strongest = 50, .band = {2001, 3000}, .pairing = 0.03, .rate = 48000};
    ck_assert(!csv_table_read(text, &none, arena, &m[0], &e));
    ck_assert(e.kind == ERR_SCENE && strstr(e.text, "none of its modes lies from 2001 Hz to below 3000 Hz"));
    teardown();
}
END_TEST

START_TEST(drops_what_cannot_be_sampled)
{
    setup();
    struct modes m = table_of(HEAD "1,0,0,a,100,1,1,0\n1,0,0,b,21601,1,3,0\n1,0,0,c,21599,2,2,0\n"
                                   "2,1,0,a,100,1,4,0\n2,1,0,b,21601,1,6,0\n2,1,0,c,21599,2,5,0\n",
                              50, arena);
    struct modes_point p = modes_point_make(arena, m.n);
    ck_assert_int_eq(modes_drop_above(&m, 48000), 1);
    ck_assert(m.n == 2 && m.frequency[0] == 100 && m.frequency[1] == 21599 && m.decay[1] == 2 && m.slowest[1] == 2);
    ck_assert(table_at(&m, 0.5, 0, &p) == 0 && p.re[0] == 2.5 && p.re[1] == 3.5);
    ck_assert_int_eq(modes_drop_above(&m, 48000), 0);
    ck_assert_double_eq_tol(modes_ring_time(&m, 60), log(1000.0), 1e-12); /* T60 = ln(1000)/decay */
    ck_assert_int_eq(modes_drop_above(&m, 10), 2);
    ck_assert(m.n == 0 && modes_ring_time(&m, 60) == 0);
    ck_assert_int_eq(modes_drop_above(&(struct modes){.n = 3}, 10), 0); /* a source that has nothing to drop */
    teardown();
}
END_TEST

/* The direct term is minus the integral of the response from 0 on: force and motion balance at low frequencies.
 * Integral of Im(A e^(st)) = -Im(A/s). */
START_TEST(direct_term_balances)
{
    double f[2] = {30, 55}, d[2] = {20, 35}, re[2] = {1, -0.5}, im[2] = {0.3, 0.7}, sum = 0, step = 1e-6;
    struct modes_point p = {f, d, re, im};
    for (double t = step / 2; t < 2; t += step)
        for (int i = 0; i < 2; i++)
            sum += step * exp(-d[i] * t) *
                   (re[i] * sin(2 * acos(-1.0) * f[i] * t) + im[i] * cos(2 * acos(-1.0) * f[i] * t));
    ck_assert_double_eq_tol(modes_direct(MODES_ACCELERATION, 2, f, d, &p), -sum, 1e-9);
    ck_assert(modes_direct(MODES_PRESSURE, 2, f, d, &p) == modes_direct(MODES_ACCELERATION, 2, f, d, &p));
    ck_assert(modes_direct(MODES_VELOCITY, 2, f, d, &p) == 0 && modes_direct(MODES_DISPLACEMENT, 2, f, d, &p) == 0);
}
END_TEST

START_TEST(bad_tables_are_refused)
{
    setup();
    static const char columns[] = "place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n";
    static const struct {
        const char *text, *says;
    } rows[] = {
        {"1,0,0,1,440,5,1,0\n1,0,0,1,440,5,1,0\n",
         ":6: place '1' has mode '1' again, after line 5: remove one of the two"},
        {"1,0,0,1,440,5,1,0\n1,0,0,2,450,5,1,0\n2,1,0,2,450,5,1,0\n",
         ":7: place '2', which starts here, has no mode '1'"},
        {"1,0,0,1,440,5,1,0\n2,1,0,1,440,5,1,0\n2,1,0,x,450,5,1,0\n",
         ":5: place '1', which starts here, has no mode 'x'"},
        {"1,0,0,1,440,5,1,0\n1,0,0,2,450,5,1,0\n2,1,0,1,440,5,1,0\n",
         ":7: place '2', which starts here, has no mode '2'"},
        {"1,0,0,1,0,5,1,0\n", ":5: frequency_hz is 0, and must be above 0"},
        {"1,0,0,1,-2,5,1,0\n", "must be above 0"},
        {"1,0,0,1,440,-5,1,0\n", ":5: decay_per_s -5 must not be negative"},
        {"1,0,0,1,440,5,nan,0\n", ":5"},
        {"1,0,0,1,440,5,inf,0\n", ":5"},
        {"1,0,0,1,440,5,loud,0\n", "'gain'"},
        {"1,0,0,1,440,5,1\n", ":5"},
        {"1,0,0,1,440,5,1,0\n2,1,0,1,440.1,5,1,0\n", "with shared poles they are the same at every place"},
        {"1,0,0,1,440,5,1,0\n2,1,0,1,440,5.001,1,0\n", ":6: mode '1' has frequency 440 Hz and decay 5.001/s here"},
        {"1,0,0,1,440,5,1,0\n1,0.1,0,2,450,5,1,0\n",
         ":6: place '1' is at (0.1, 0) m here and at (0, 0) m in line 5: make both the same"},
        {"1,0,0,1,440,5,1,0\n2,0,0,1,440,5,1,0\n",
         ":6: place '2' is at the same point as another place: remove one of the two, or mend where it lies"},
        {"1,1e300,0,1,440,5,1,0\n", "farther than 1000 m"},
        {"", "without modes"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char text[1000];
        snprintf(text, sizeof text, "%s%s", HEAD, rows[i].text);
        refused(text, rows[i].says);
    }
    char text[1000];
    snprintf(text, sizeof text, "# quantity: velocity\n%s1,0,0,1,440,5,1,0\n", columns);
    refused(text, "'# poles: ...' is missing");
    snprintf(text, sizeof text, "# poles: shared\n%s1,0,0,1,440,5,1,0\n", columns);
    refused(text, "'# quantity: ...' is missing");
    snprintf(text, sizeof text, "# poles: shared\n# poles: shared\n# quantity: velocity\n%s1,0,0,1,440,5,1,0\n",
             columns);
    refused(text, "more than once");
    snprintf(text, sizeof text, "# poles: some\n# quantity: velocity\n%s1,0,0,1,440,5,1,0\n", columns);
    refused(text, "'some' is neither shared nor separate");
    snprintf(text, sizeof text, "# poles: shared\n# quantity: loudness\n%s1,0,0,1,440,5,1,0\n", columns);
    refused(text, "'loudness' is not displacement, velocity or acceleration (per N s): write one of them");
    refused(
        "# poles: shared\n# quantity: velocity\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain\n1,0,0,1,440,5,1\n",
        "column 'phase_rad'");
    refused("# poles: shared\n# quantity: "
            "velocity\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad,q\n1,0,0,1,440,5,1,0,9\n",
            "remove the others");
    teardown();
}
END_TEST

START_TEST(bad_forms_are_refused)
{
    setup();
    refused(SEPARATE COLUMNS "1,0,0,1,440,5,1,0\n2,1,0,1,450,0,1,0\n",
            ":6: decay_per_s is 0: separate poles are interpolated");
    refused("# pairing: frequency\n" HEAD "1,0,0,1,440,5,1,0\n", "pairing: frequency is for separate poles");
    refused("# pairing: names\n" SEPARATE COLUMNS "1,0,0,1,440,5,1,0\n", "'names' is neither ids nor frequency");
    refused("# pairing: ids\n# pairing: ids\n" SEPARATE COLUMNS "1,0,0,1,440,5,1,0\n", "more than once");
    refused("# radius_m: big\n" HEAD "1,0,0,1,440,5,1,0\n", "radius_m: 'big' is not a number above 0");
    refused("# radius_m: 0\n" HEAD "1,0,0,1,440,5,1,0\n", "radius_m: '0' is not a number above 0");
    refused(SHARED SLOPES "1,0,0,1,440,5,1,0,1.5\n", ":5: slope 1.5 is not a whole number from 1 to 100");
    refused(SHARED SLOPES "1,0,0,1,440,5,1,0,1\n1,0,0,1,440,9,1,0,1\n",
            ":6: place '1' has slope 1 of mode '1' again, after line 5: remove one of the two");
    refused(SHARED SLOPES "1,0,0,1,440,5,1,0,1\n1,0,0,1,441,9,1,0,2\n",
            ":6: mode '1' of place '1' has frequency 441 Hz and phase 0 here");
    refused(SHARED SLOPES "1,0,0,1,440,5,1,0,1\n1,0,0,1,440,9,1,0,2\n2,1,0,1,440,5,1,0,1\n",
            ":7: mode '1' has 1 slopes at this place, 2 at that of line 5");
    refused(SHARED SLOPES "1,0,0,1,440,5,1,0,1\n1,0,0,1,440,9,1,0,2\n2,1,0,1,440,5,1,0,1\n2,1,0,1,440,8,1,0,2\n",
            "decay 8/s here, 440 Hz and 9/s in line 5");
    refused(SHARED ENVELOPE "1,0,0,1,440,0,1,0\n", ":5: the envelope of mode '1' at place '1' has one sample");
    refused(SHARED ENVELOPE "1,0,0,1,440,-1,1,0\n1,0,0,1,440,0,1,0\n", ":5: time_s -1 must lie between 0");
    refused(SHARED ENVELOPE "1,0,0,1,440,1,1,0\n1,0,0,1,440,1,2,0\n",
            ":6: place '1' has the time 1 s of mode '1' again, after line 5: remove one of the two");
    refused(SHARED ENVELOPE "1,0,0,1,440,1,1,0\n1,0,0,1,440,2,1,0.5\n",
            "an envelope belongs to one frequency and phase");
    refused(SHARED "place,x_m,y_m,mode,frequency_hz,time_s,gain,phase_rad\n1,0,0,1,440,1,1,0\n",
            "a table of envelopes needs the column 'amplitude'");
    refused(SHARED "place,x_m,y_m,mode,frequency_hz,time_s,amplitude,phase_rad,slope\n1,0,0,1,440,1,1,0,1\n",
            "9 columns where a mode table has 8");
    struct modes m = table_of("# radius_m: 0.125\n" HEAD "1,0,0,1,440,5,1,0\n", 50, arena);
    ck_assert(m.radius == 0.125);
    teardown();
}
END_TEST

START_TEST(missing_file)
{
    struct modes m;
    struct err e = {0};
    setup();
    ck_assert(!modes_table("no-such-file.csv", &(struct modes_ask){.strongest = 50, .pairing = 0.03, .rate = 48000},
                           arena, &m, &e));
    ck_assert_int_eq(e.kind, ERR_INPUT);
    teardown();
}
END_TEST

/* The tables that ship: how many modes there are below 20 kHz, and the lowest frequency worked out apart from the
 * program. */
START_TEST(shipped_tables)
{
    static const struct {
        const char *name;
        int modes;
        bool moves;
        double lowest; /* Hz */
    } tables[] = {{"basswood_plank", 61, true, 492.06},
                  {"poplar_plank", 54, true, 591.25},
                  {"ceramic_tile", 58, true, 584.62},
                  {"pvc_rod", 14, false, 208.5},
                  {"poplar_rod", 6, false, 863.64}};
    const char *root = getenv("ROOT");
    for (size_t i = 0; i < 5; i++) {
        char path[4096];
        struct modes m;
        struct err e = {0};
        setup();
        snprintf(path, sizeof path, "%s/irs/%s.csv", root ? root : ".", tables[i].name);
        ck_assert_msg(
            modes_table(path, &(struct modes_ask){.strongest = 1000, .pairing = 0.03, .rate = 48000}, arena, &m, &e),
            "%s", e.text);
        ck_assert_int_eq(m.n, tables[i].modes);
        ck_assert(m.shared && m.moves == tables[i].moves);
        double lowest = 1e9;
        for (int k = 0; k < m.n; k++) {
            lowest = fmin(lowest, m.frequency[k]);
            ck_assert(m.frequency[k] < 20000 && m.decay[k] > 0);
        }
        ck_assert_double_eq_tol(lowest, tables[i].lowest, 0.1);
        teardown();
    }
}
END_TEST

UNIT("modes", reads_any_order, gains_between_and_beyond, gains_in_the_plane, one_place_is_everywhere,
     the_strongest_are_kept, strength_is_energy_over_all_places, slopes_are_one_mode, envelopes_become_slopes,
     envelopes_out_of_reach, the_strongest_of_a_band, drops_what_cannot_be_sampled, direct_term_balances,
     bad_tables_are_refused, bad_forms_are_refused, missing_file, shipped_tables)
