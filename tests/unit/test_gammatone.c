/* gammatone: bodies that begin softly through the whole pipeline: every engine and reading that can against sums of the
   definition, sample by sample in long double, for a force from a file and tables of two places, whose gains change
   their sign (shared) or whose poles move (separate). */
#include <unistd.h>

#include "convolution/alias.h"
#include "convolution/ring_choice.h"
#include "force_file.h"
#include "rig.h"

enum { RATE = 8000, FRAMES = 2600, FORCED = 1600, MODES = 4, BLOCK = 700 };

static const struct place {
    double f[MODES], d[MODES], g[MODES];
} here = {{180, 420, 955, 1700}, {60, 70, 90, 120}, {1, -0.7, 0.5, 0.4}},
  there = {{183, 413, 975, 1690}, {66, 60, 100, 115}, {0.5, -1, 0.7, 0.3}},
  turned = {{180, 420, 955, 1700}, {60, 70, 90, 120}, {-0.6, 0.9, 0.5, -0.2}};

static char folder[] = "/tmp/test_gammatone.XXXXXX";
static double force[FRAMES];

static void table_write(const char *name, const char *poles, const struct place *p, const struct place *q)
{
    char path[200];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "w");
    ck_assert_ptr_nonnull(f);
    fprintf(f, "# poles: %s\n# quantity: acceleration\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n",
            poles);
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < MODES; i++)
            fprintf(f, "%d,%d,0,%d,%.17g,%.17g,%.17g,0\n", k, k, i, (k ? q : p)->f[i], (k ? q : p)->d[i],
                    (k ? q : p)->g[i]);
    fclose(f);
}

static void force_write(void)
{
    char path[200];
    snprintf(path, sizeof path, "%s/force.npy", folder);
    force_file_write(fopen(path, "w"), force, FORCED);
}

static void folder_make(void)
{
    ck_assert_ptr_nonnull(mkdtemp(folder));
    table_write("separate.csv", "separate", &here, &there);
    table_write("shared.csv", "shared", &here, &turned);
    force_write();
}

static void folder_remove(void)
{
    static const char *const names[] = {"separate.csv", "shared.csv", "force.npy"};
    char path[200];
    for (int i = 0; i < 3; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        unlink(path);
    }
    rmdir(folder);
}

static struct rig *render(const char *table, int gamma, const char *how, const char *accuracy, int block)
{
    char text[1000];
    snprintf(
        text, sizeof text,
        "rasp: 1\nsurface: {response: %s/%s, gammatone: %d, %s}\nmotion: {path: line, from: [0, 0], to: [1, 0], "
        "duration: %.17g}\n"
        "contact: {model: given, given: {file: %s/force.npy, rate: %d}}\naccuracy: {%s}\noutput: {sample_rate: %d}\n",
        folder, table, gamma, how, FORCED / (double)RATE, folder, RATE, accuracy, RATE);
    struct scene s = rig_scene(rig_arena(), text);
    return rig_record(&s, ITEM_SOUND, FRAMES, block);
}

/* ------------------------------------------------------------------ the definition */

static long double between(double a, double b, long double u)
{
    return fabsl((long double)a) * powl(fabsl((long double)b / a), u) * (a < 0 ? -1 : 1);
}

/* h at frame n of the place u, 0 to 1. */
static long double tone(bool shared, int gamma, long double u, long n)
{
    long double t = n / (long double)RATE, sum = 0;
    for (int i = 0; i < MODES; i++) {
        long double f = shared ? here.f[i] : between(here.f[i], there.f[i], u),
                    d = shared ? here.d[i] : between(here.d[i], there.d[i], u);
        long double g = shared ? here.g[i] + u * (turned.g[i] - here.g[i]) : between(here.g[i], there.g[i], u);
        sum += g * powl(t * d / (gamma - 1), gamma - 1) * expl((gamma - 1) - t * d) * sinl(2 * M_PIl * f * t);
    }
    return sum;
}

/* What is taken out of sampling frame n's sound of force frame m, at the place u (test_alias.c): sum of Im(A kappa), A
 * = g (e d/(gamma - 1))^(gamma - 1). */
static long double taken(const struct alias *alias, bool shared, int gamma, long double u, long n)
{
    long double sum = 0;
    for (int i = 0; i < MODES && n >= -ALIAS_REACH && n <= ALIAS_REACH; i++) {
        double re[ALIAS_TAPS], im[ALIAS_TAPS];
        long double f = shared ? here.f[i] : between(here.f[i], there.f[i], u),
                    d = shared ? here.d[i] : between(here.d[i], there.d[i], u);
        long double g = shared ? here.g[i] + u * (turned.g[i] - here.g[i]) : between(here.g[i], there.g[i], u);
        alias_taps(alias, (double)f, (double)d, re, im);
        sum += g * powl(M_El * d / (gamma - 1), gamma - 1) * im[n + ALIAS_REACH];
    }
    return sum;
}

/* Against the sum at every 41st frame: relative rms, dB. */
static double judged(const struct rig *g, bool shared, int gamma, bool readout)
{
    double wrong = 0, whole = 0;
    const struct alias *alias = alias_make(rig_arena(), gamma, RATE);
    for (long n = 5; n < FRAMES; n += 41) {
        long double want = 0;
        for (long m = 0; m <= n && m < FORCED; m++)
            want += force[m] / RATE * tone(shared, gamma, fminl((readout ? n : m) / (long double)FORCED, 1), n - m);
        for (long m = n > ALIAS_REACH ? n - ALIAS_REACH : 0; m <= n + ALIAS_REACH && m < FORCED; m++)
            want += force[m] * taken(alias, shared, gamma, fminl((readout ? n : m) / (long double)FORCED, 1), n - m);
        wrong += (double)((g->x[n] - want) * (g->x[n] - want));
        whole += (double)(want * want);
    }
    return 10 * log10(wrong / whole);
}

static void check(const char *table, int gamma, const char *how, const char *accuracy, double most)
{
    struct rig *g = render(table, gamma, how, accuracy, BLOCK);
    double db = judged(g, strcmp(table, "shared.csv") == 0, gamma, strstr(how, "readout") != NULL);
    printf("gamma %d, %s, %s, %s: %.1f dB\n", gamma, table, how, accuracy, db);
    ck_assert_double_le(db, most);
    rig_close(g);
}

/* Gains are straight lines between the two places, so a ramp has no error but at the motion's end, where they stop,
 * within it. */
START_TEST(fixed)
{
    folder_make();
    for (int gamma = 2; gamma <= 4; gamma++) {
        check("shared.csv", gamma, "moving: fixed", "gain_ramp: 1", -200);
        check("shared.csv", gamma, "moving: fixed", "gain_ramp: 4", -80);
        check("shared.csv", gamma, "moving: fixed, convolution: overlap_add", "gain_ramp: 1", -80);
    }
    folder_remove();
}
END_TEST

/* Poles that move, through computed responses. */
START_TEST(poles_that_move)
{
    folder_make();
    for (int gamma = 2; gamma <= 4; gamma++)
        for (int ramp = 1; ramp <= 64; ramp *= 8) {
            if (gamma != 3 && ramp != 8) continue;
            const char *accuracy = ramp == 1 ? "gain_ramp: 1" : ramp == 8 ? "gain_ramp: 8" : "gain_ramp: 64";
            double fine = ramp == 1 ? 2 : ramp == 8;
            check("separate.csv", gamma, "moving: launch", accuracy, -45 - 32 * fine);
            check("separate.csv", gamma, "moving: readout", accuracy, -34 - 15 * fine);
        }
    folder_remove();
}
END_TEST

/* gamma 1 is what it is without the key, to the bit; so is the sound however it is cut into blocks. */
START_TEST(the_same_bits)
{
    folder_make();
    struct rig *a = render("shared.csv", 1, "moving: fixed", "gain_ramp: 4", BLOCK),
               *b = render("shared.csv", 2, "moving: fixed", "gain_ramp: 4", BLOCK),
               *c = render("shared.csv", 2, "moving: fixed", "gain_ramp: 4", 37);
    struct scene s = a->scene;
    s.contacts[0].surface.response.gammatone = 0; /* not set by any key */
    struct rig *d = rig_record(&s, ITEM_SOUND, FRAMES, BLOCK);
    ck_assert(memcmp(a->x, d->x, FRAMES * sizeof *a->x) == 0);
    ck_assert(memcmp(b->x, c->x, FRAMES * sizeof *a->x) == 0);
    ck_assert(memcmp(a->x, b->x, FRAMES * sizeof *a->x) != 0);
    rig_close(a), rig_close(b), rig_close(c), rig_close(d);
    folder_remove();
}
END_TEST

/* The tail lasts until -80 dB of the slowest mode's gammatone. */
START_TEST(tail)
{
    folder_make();
    for (int gamma = 1; gamma <= 4; gamma++) {
        struct rig *g = render("shared.csv", gamma, "moving: fixed", "gain_ramp: 4", BLOCK);
        double x = g->run.board.ring * 60, m = gamma - 1, db = 8.685889638 * (gamma > 1 ? m * log(x / m) + m - x : -x);
        ck_assert_double_eq_tol(db, -80, 1e-6);
        rig_close(g);
    }
    folder_remove();
}
END_TEST

UNIT("gammatone", fixed, poles_that_move, the_same_bits, tail)
