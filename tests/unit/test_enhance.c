/* enhance: the filter's transfer function, measured from its impulse response, against its closed form; its gain at the
   modes; what it makes of a mode in series, against the gammatone. */
#include <complex.h>
#include <unistd.h>

#include "convolution/gammatone.h"
#include "rig.h"

enum { RATE = 44100, MODES = 4, FRAMES = 1 << 16 };

static const double frequency[MODES] = {310, 1220, 3105, 9600}, decay[MODES] = {9, 25, 40, 80},
                    gain[MODES] = {0.5, -2, 1, 0.25};
static char folder[] = "/tmp/test_enhance.XXXXXX";

static FILE *file_open(const char *name)
{
    char path[200];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "w");
    ck_assert_ptr_nonnull(f);
    return f;
}

/* A table of one place, and of two of which the second has the same modes half as strong. */
static void folder_make(void)
{
    ck_assert_ptr_nonnull(mkdtemp(folder));
    FILE *f = file_open("modes.csv"), *g = file_open("two.csv");
    fprintf(f, "# poles: shared\n# quantity: velocity\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n");
    fprintf(g, "# poles: shared\n# quantity: velocity\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n");
    for (int i = 0; i < MODES; i++)
        fprintf(f, "0,0,0,%d,%.17g,%.17g,%.17g,0\n", i + 1, frequency[i], decay[i], gain[i]);
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < MODES; i++)
            fprintf(g, "%d,%d,0,%d,%.17g,%.17g,%.17g,0\n", k, k, i + 1, frequency[i], decay[i], k ? gain[i] : 0);
    fclose(f);
    fclose(g);
    f = file_open("impulse.npy");
    char head[129] = {0};
    int used = snprintf(head + 10, 110, "{'descr': '<f8', 'fortran_order': False, 'shape': (%d,), }", 1000);
    memcpy(head, "\x93NUMPY\x01\x00\x76\x00", 10);
    memset(head + 10 + used, ' ', (size_t)(118 - used));
    head[127] = '\n';
    double x[1000] = {0};
    x[3] = 1;
    fwrite(head, 1, 128, f);
    fwrite(x, sizeof *x, 1000, f);
    fclose(f);
}

static void folder_remove(void)
{
    static const char *const names[] = {"modes.csv", "two.csv", "impulse.npy"};
    char path[200];
    for (int i = 0; i < 3; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        unlink(path);
    }
    rmdir(folder);
}

static struct rig *render(const char *table, const char *enhance, const char *quantity, enum item item, int block)
{
    struct scene s = rig_scene(
        rig_arena(),
        arena_format(
            rig_arena(),
            "rasp: 1\nsurface: {response: %s/%s}\nmotion: {path: line, from: [0, 0], to: [1, 0], duration: 0.1 s}\n"
            "contact: {model: given, given: {file: %s/impulse.npy, rate: %d}%s%s}\n"
            "output: {sample_rate: %d, quantity: %s}\n",
            folder, table, folder, RATE, *enhance ? ", enhance: " : "", enhance, RATE, quantity));
    return rig_record(&s, item, FRAMES, block);
}

static double complex spectrum(const double *x, double f)
{
    double complex sum = 0, turn = cexp(-2 * I * M_PI * f / RATE), now = 1;
    for (int n = 3; n < FRAMES; n++, now *= turn)
        sum += x[n] * now;
    return sum;
}

/* The closed form: 1 + sum g_i B_i, for the `most` strongest. */
static double complex closed(double f, double db, int most)
{
    static const int order[MODES] = {1, 2, 0, 3};
    double complex sum = 1, z = cexp(-2 * I * M_PI * f / RATE);
    for (int k = 0; k < most; k++) {
        int i = order[k];
        double r = exp(-decay[i] / RATE), theta = 2 * M_PI * frequency[i] / RATE;
        sum += (pow(10, db / 20) - 1) * fabs(gain[i]) / 2 * (1 - r * r) / 2 * (1 - z * z) /
               (1 - 2 * r * cos(theta) * z + r * r * z * z);
    }
    return sum;
}

/* 1.5 s of an impulse response that decays at 9/s at least: 1e-6 is left out. */
START_TEST(transfer_function)
{
    folder_make();
    for (int most = 1; most <= MODES; most += 3) {
        struct rig *g =
            render("modes.csv", arena_format(rig_arena(), "{gain: 26 dB, modes: %d}", most), "force", ITEM_FORCE, 777);
        double worst = 0;
        for (double f = 1; f < 22050; f *= 1.01)
            worst = fmax(worst, cabs(spectrum(g->x, f) - closed(f, 26, most)));
        printf("%d modes: off by %.1e of the direct force\n", most, worst);
        ck_assert_double_le(worst, 1e-4);
        double at = 20 * log10(cabs(spectrum(g->x, 1220)));
        printf("at the strongest mode: %.3f dB\n", at);
        ck_assert_double_eq_tol(at, 26, 0.05); /* the others' skirts */
        rig_close(g);
    }
    folder_remove();
}
END_TEST

/* 2 sigma s/(s^2 + 2 sigma s + sigma^2 + omega^2) near the modes: to 1 % of the greatest from half to twice the
 * frequency. */
START_TEST(as_an_analogue_filter)
{
    for (int i = 0; i < 3; i++)
        for (double f = frequency[i] / 2; f < 2 * frequency[i]; f *= 1.01) {
            double r = exp(-decay[i] / RATE), theta = 2 * M_PI * frequency[i] / RATE, omega = 2 * M_PI * frequency[i];
            double complex z = cexp(-2 * I * M_PI * f / RATE), s = 2 * I * M_PI * f;
            double complex digital = (1 - r * r) / 2 * (1 - z * z) / (1 - 2 * r * cos(theta) * z + r * r * z * z);
            double complex analogue =
                2 * decay[i] * s / (s * s + 2 * decay[i] * s + decay[i] * decay[i] + omega * omega);
            ck_assert_double_le(cabs(digital - analogue), 0.01);
        }
}
END_TEST

/* What B adds, in series with the mode: sigma t |a| e^(-sigma t) sin(omega t + phase) times g, which is |a| g/e times
   Hermes' gammatone of gamma 2, but for shares of about 1/(omega tau) and of the modes' skirts in each other. */
START_TEST(a_double_pole_is_a_gammatone)
{
    folder_make();
    struct rig *with = render("modes.csv", "{gain: 40 dB, modes: 1}", "velocity", ITEM_SOUND, 1024),
               *without = render("modes.csv", "", "velocity", ITEM_SOUND, 1024);
    double g = pow(10, 2) - 1, wrong = 0, whole = 0;
    for (int n = 3; n < FRAMES; n++) {
        double t = (n - 3.0) / RATE, x = decay[1] * t,
               want = g * gain[1] / M_E * x * exp(1 - x) * sin(2 * M_PI * frequency[1] * t) / RATE;
        wrong += pow(with->x[n] - without->x[n] - want, 2);
        whole += want * want;
    }
    printf("against the gammatone: %.2e, 1/(omega tau) is %.2e\n", sqrt(wrong / whole),
           decay[1] / (2 * M_PI * frequency[1]));
    ck_assert_double_le(sqrt(wrong / whole), 0.02);
    rig_close(with);
    rig_close(without);
    folder_remove();
}
END_TEST

/* Gains are those of the way: of a table in which all is silent at the start, the end's. */
START_TEST(strongest_on_the_way)
{
    folder_make();
    struct rig *one = render("modes.csv", "{gain: 20 dB, modes: 4}", "force", ITEM_FORCE, 1024),
               *two = render("two.csv", "{gain: 20 dB, modes: 4}", "force", ITEM_FORCE, 64);
    ck_assert(memcmp(one->x, two->x, FRAMES * sizeof *one->x) == 0);
    rig_close(one);
    rig_close(two);
    folder_remove();
}
END_TEST

UNIT("enhance", UNIT_LONG(transfer_function), as_an_analogue_filter, a_double_pole_is_a_gammatone, strongest_on_the_way)
