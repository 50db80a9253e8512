#include "unit.h"

#include <unistd.h>

#include "response/modes.h"

#define HEAD "# poles: shared\n# quantity: velocity\n# source: a test\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n"

static struct arena *arena;

/* Reads a table from text; false with the message in e. */
static bool read_text(const char *text, int strongest, struct modes *m, struct err *e)
{
    char path[] = "modes.XXXXXX";
    int fd = mkstemp(path);
    ck_assert_int_ge(fd, 0);
    ck_assert_int_eq(write(fd, text, strlen(text)), (int)strlen(text));
    close(fd);
    *e = (struct err){0};
    arena = arena_open();
    bool ok = modes_read(path, strongest, arena, m, e);
    unlink(path);
    return ok;
}

/* Refused with that exit code, and the message holds that text. */
static void refused(const char *text, const char *says)
{
    struct modes m;
    struct err e;
    bool ok = read_text(text, 50, &m, &e);
    ck_assert_msg(!ok, "accepted, but should say: %s", says);
    ck_assert_msg(strstr(e.text, says) != NULL, "\"%s\" does not say \"%s\"", e.text, says);
    ck_assert_int_eq(e.kind, ERR_SCENE);
    arena_close(arena);
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
    struct modes m;
    struct err e;
    ck_assert_msg(read_text(table, 50, &m, &e), "%s", e.text);
    ck_assert(m.n == 2 && m.places == 3 && m.quantity == MODES_VELOCITY);
    ck_assert(m.frequency[0] == 2000 && m.frequency[1] == 100 && m.decay[0] == 20 && m.decay[1] == 10);
    for (int p = 0; p < 3; p++) {
        ck_assert_double_eq_tol(m.along[p], 0.5 * p, 1e-12);
        ck_assert_double_eq_tol(m.gain_re[2 * p], 10 * (p + 1) * cos(1.5), 1e-12);
        ck_assert_double_eq_tol(m.gain_im[2 * p], 10 * (p + 1) * sin(1.5), 1e-12);
    }
    ck_assert(m.gain_re[1] == 1 && m.gain_re[3] == 2 && m.gain_re[5] == -3 && m.gain_im[5] == 0);
    arena_close(arena);
}
END_TEST

START_TEST(gains_between_and_beyond)
{
    struct modes m;
    struct err e;
    double re[2], im[2];
    ck_assert(read_text(table, 50, &m, &e));
    ck_assert(modes_gains_at(&m, 1.15, 1.2, re, im) == 0);
    ck_assert_double_eq_tol(re[1], 1.5, 1e-12);
    ck_assert(modes_gains_at(&m, 1.3 + 0.24, 1.4 + 0.32, re, im) == 0); /* 0.4 of 0.5 m on the way: 2 + 0.8 (-3 - 2) */
    ck_assert_double_eq_tol(re[1], -2.0, 1e-12);
    ck_assert_double_eq_tol(im[0], 28 * sin(1.5), 1e-12);
    ck_assert_double_eq_tol(modes_gains_at(&m, 1 - 0.06, 1 - 0.08, re, im), 0.1, 1e-12); /* before the first place */
    ck_assert_double_eq_tol(re[1], 1, 1e-12);
    ck_assert_double_eq_tol(modes_gains_at(&m, 1.6 + 3, 1.8 + 4, re, im), 5, 1e-12); /* beyond the last */
    ck_assert_double_eq_tol(re[1], -3, 1e-12);
    ck_assert_double_eq_tol(modes_gains_at(&m, 1.3 - 0.8, 1.4 + 0.6, re, im), 1, 1e-12); /* beside the line: its foot */
    ck_assert_double_eq_tol(re[1], 2, 1e-12);
    ck_assert(modes_gains_at(&m, 1 - 5e-10, 1, re, im) == 0); /* rounding of a path is not outside */
    arena_close(arena);
}
END_TEST

START_TEST(one_place_is_everywhere)
{
    struct modes m;
    struct err e;
    double re, im;
    ck_assert(read_text(HEAD "1,0.2,0.3,1,440,5,2,0\n", 50, &m, &e));
    ck_assert(modes_gains_at(&m, 7, -3, &re, &im) == 0 && re == 2 && im == 0);
    ck_assert(m.places == 1 && m.along[0] == 0);
    arena_close(arena);
}
END_TEST

/* Energy gain^2/(4 decay): a mode that is weak but long may be the stronger; one without decay beats all, unless it is silent. */
START_TEST(the_strongest_are_kept)
{
    struct modes m;
    struct err e;
    ck_assert(read_text(HEAD "1,0,0,a,100,400,2,0\n1,0,0,b,200,4,1,0\n1,0,0,c,300,0,1e-9,0\n1,0,0,d,400,0,0,0\n1,0,0,e,500,4,-1,0\n", 4, &m, &e));
    ck_assert_int_eq(m.n, 4);
    ck_assert(m.frequency[0] == 300 && m.frequency[1] == 200 && m.frequency[2] == 500 && m.frequency[3] == 100);
    ck_assert(m.gain_re[2] == -1);
    ck_assert(isinf(modes_ring_time(&m, 60)));
    arena_close(arena);
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

/* Strength is that energy, summed over the places: not the gain, not gain / decay, not the place where a mode is loudest, nor the gains' sum,
   in which signs cancel. The closed form leaves out what the phase does within a period, decay / omega of it: below 1e-2 here, while
   energies are all 3e-2 apart. */
START_TEST(strength_is_energy_over_all_places)
{
    enum { MODES = 7, PLACES = 3, KEPT = 5 };
    static const double decay[MODES] = {20, 5, 60, 10, 40, 8, 15},
                        gain[MODES][PLACES] = {{2, 2, 2}, {1.1, -1.1, 1.1}, {5.8, 0, 0}, {1.5, -1.6, 0}, {-2.6, 2.6, 2.6}, {0, 0, 1.7}, {0.5, 0.5, 0.5}};
    char text[4096] = HEAD;
    double energy[MODES];
    int order[MODES];
    struct modes m;
    struct err e;
    for (int i = 0; i < MODES; i++) {
        energy[i] = 0;
        order[i] = i;
        for (int p = 0; p < PLACES; p++) {
            energy[i] += summed_energy(1000 + i, decay[i], gain[i][p], 0.7 * i);
            sprintf(text + strlen(text), "p%d,%d,0,m%d,%d,%g,%g,%g\n", p, p, i, 1000 + i, decay[i], gain[i][p], 0.7 * i);
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
    ck_assert_msg(read_text(text, KEPT, &m, &e), "%s", e.text);
    ck_assert_int_eq(m.n, KEPT);
    for (int i = 0; i < KEPT; i++)
        ck_assert_msg(m.frequency[i] == 1000 + order[i], "rank %d: %g Hz, expected %d", i, m.frequency[i], 1000 + order[i]);
    arena_close(arena);
}
END_TEST

START_TEST(drops_above_nyquist)
{
    struct modes m;
    struct err e;
    double re[3], im[3];
    ck_assert(read_text(HEAD "1,0,0,a,100,1,1,0\n1,0,0,b,23953,1,3,0\n1,0,0,c,23951,2,2,0\n"
                             "2,1,0,a,100,1,4,0\n2,1,0,b,23953,1,6,0\n2,1,0,c,23951,2,5,0\n", 50, &m, &e));
    ck_assert_int_eq(modes_drop_above(&m, 48000), 1);
    ck_assert(m.n == 2 && m.frequency[0] == 100 && m.frequency[1] == 23951 && m.decay[1] == 2);
    ck_assert(modes_gains_at(&m, 0.5, 0, re, im) == 0 && re[0] == 2.5 && re[1] == 3.5);
    ck_assert_int_eq(modes_drop_above(&m, 48000), 0);
    ck_assert_double_eq_tol(modes_ring_time(&m, 60), log(1000.0), 1e-12); /* T60 = ln(1000)/decay */
    ck_assert_int_eq(modes_drop_above(&m, 10), 2);
    ck_assert(m.n == 0 && modes_ring_time(&m, 60) == 0);
    arena_close(arena);
}
END_TEST

START_TEST(bad_tables_are_refused)
{
    static const char columns[] = "place,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n";
    static const struct {
        const char *text, *says;
    } rows[] = {
        {"1,0,0,1,440,5,1,0\n1,0,0,1,440,5,1,0\n", ":6: place '1' has mode '1' again, after line 5"},
        {"1,0,0,1,440,5,1,0\n1,0,0,2,450,5,1,0\n2,1,0,2,450,5,1,0\n", ":7: place '2', which starts here, has no mode '1'"},
        {"1,0,0,1,440,5,1,0\n2,1,0,1,440,5,1,0\n2,1,0,x,450,5,1,0\n", ":5: place '1', which starts here, has no mode 'x'"},
        {"1,0,0,1,440,5,1,0\n1,0,0,2,450,5,1,0\n2,1,0,1,440,5,1,0\n", ":7: place '2', which starts here, has no mode '2'"},
        {"1,0,0,1,0,5,1,0\n", ":5: frequency_hz 0 must be above 0"},
        {"1,0,0,1,-2,5,1,0\n", "must be above 0"},
        {"1,0,0,1,440,-5,1,0\n", ":5: decay_per_s -5 must not be negative"},
        {"1,0,0,1,440,5,nan,0\n", ":5"},
        {"1,0,0,1,440,5,inf,0\n", ":5"},
        {"1,0,0,1,440,5,loud,0\n", "'gain'"},
        {"1,0,0,1,440,5,1\n", ":5"},
        {"1,0,0,1,440,5,1,0\n2,1,0,1,440.1,5,1,0\n", "with shared poles they are the same at every place"},
        {"1,0,0,1,440,5,1,0\n2,1,0,1,440,5.001,1,0\n", ":6: mode '1' has frequency 440 Hz and decay 5.001/s here"},
        {"1,0,0,1,440,5,1,0\n1,0.1,0,2,450,5,1,0\n", ":6: place '1' is at (0.1, 0) m here and at (0, 0) m in line 5"},
        {"1,0,0,1,440,5,1,0\n2,0,0,1,440,5,1,0\n", "place '2' is at the same point"},
        {"1,0,0,1,440,5,1,0\n2,1,0,1,440,5,1,0\n3,0.5,1e-6,1,440,5,1,0\n", ":7: place '3' lies beside the line"},
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
    snprintf(text, sizeof text, "# poles: shared\n# poles: shared\n# quantity: velocity\n%s1,0,0,1,440,5,1,0\n", columns);
    refused(text, "more than once");
    snprintf(text, sizeof text, "# poles: separate\n# quantity: velocity\n%s1,0,0,1,440,5,1,0\n", columns);
    refused(text, "separate poles need morphing, which this version does not offer");
    snprintf(text, sizeof text, "# poles: some\n# quantity: velocity\n%s1,0,0,1,440,5,1,0\n", columns);
    refused(text, "neither shared nor separate");
    snprintf(text, sizeof text, "# poles: shared\n# quantity: loudness\n%s1,0,0,1,440,5,1,0\n", columns);
    refused(text, "'loudness' is not displacement, velocity or acceleration");
    refused("# poles: shared\n# quantity: velocity\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain\n1,0,0,1,440,5,1\n", "column 'phase_rad'");
    refused("# poles: shared\n# quantity: velocity\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad,q\n1,0,0,1,440,5,1,0,9\n",
            "remove the others");
}
END_TEST

START_TEST(missing_file)
{
    struct modes m;
    struct err e = {0};
    struct arena *a = arena_open();
    ck_assert(!modes_read("no-such-file.csv", 50, a, &m, &e));
    ck_assert_int_eq(e.kind, ERR_INPUT);
    arena_close(a);
}
END_TEST

/* The tables that ship: how many modes there are below 20 kHz, and the lowest frequency worked out apart from the script. */
START_TEST(shipped_tables)
{
    static const struct {
        const char *name;
        int modes, places;
        double lowest; /* Hz */
    } tables[] = {{"basswood_plank", 61, 33, 492.06}, {"poplar_plank", 54, 33, 591.25}, {"ceramic_tile", 58, 33, 584.62}, {"pvc_rod", 14, 1, 208.5},
                  {"poplar_rod", 6, 1, 863.64}};
    const char *root = getenv("ROOT");
    for (size_t i = 0; i < 5; i++) {
        char path[4096];
        struct modes m;
        struct err e = {0};
        struct arena *a = arena_open();
        snprintf(path, sizeof path, "%s/irs/%s.csv", root ? root : ".", tables[i].name);
        ck_assert_msg(modes_read(path, 1000, a, &m, &e), "%s", e.text);
        ck_assert_int_eq(m.n, tables[i].modes);
        ck_assert_int_eq(m.places, tables[i].places);
        double lowest = 1e9;
        for (int k = 0; k < m.n; k++) {
            lowest = fmin(lowest, m.frequency[k]);
            ck_assert(m.frequency[k] < 20000 && m.decay[k] > 0);
        }
        ck_assert_double_eq_tol(lowest, tables[i].lowest, 0.1);
        arena_close(a);
    }
}
END_TEST

UNIT("modes", reads_any_order, gains_between_and_beyond, one_place_is_everywhere, the_strongest_are_kept, strength_is_energy_over_all_places, drops_above_nyquist,
     bad_tables_are_refused, missing_file, shipped_tables)
