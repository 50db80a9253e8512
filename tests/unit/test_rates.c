/* The sound does not depend on the sample rate: random scenes at two rates in third octaves, and the whole pipeline
 * against transfer functions in continuous time. */
#include <complex.h>
#include <unistd.h>

#include "rates.h"
#include "rig.h"

static char folder[] = "/tmp/test_rates.XXXXXX";

static double *render(int seed, int rate, long *frames)
{
    char text[4000], *end;
    rates_scene(seed, folder, text, sizeof text - 50);
    end = text + strlen(text);
    snprintf(end, 50, ", sample_rate: %d}\n", rate);
    struct scene s = rig_scene(rig_arena(), text);
    *frames = (long)((strstr(text, "duration: 0.15") ? 0.65 : 0.75) * rate);
    struct rig *g = rig_record(&s, ITEM_SOUND, *frames, 1024);
    double *x = g->x;
    g->x = NULL;
    rig_close(g);
    return x;
}

static void forget(void)
{
    char path[100];
    for (int seed = 0; seed <= 20; seed++)
        for (int k = 0; k < 2; k++) {
            snprintf(path, sizeof path, "%s/%s%d.csv", folder, k ? "table" : "force", seed);
            unlink(path);
        }
}

/* Of the twenty scenes of evidence/rates.md those that were off by more than 1 dB, up to 46, while the strongest modes
   were chosen below half the rate and what sampling folds in was left in: shells, plates, disks, rods and tables, given
   forces, impacts and scrapes, velocity and acceleration. 0.5 dB are asked, 0.005 measured; 0.05 leaves room for
   neither. */
START_TEST(third_octaves)
{
    static const int seeds[] = {4, 5, 6, 10, 11, 13, 17, 18, 19};
    for (size_t i = 0; i < sizeof seeds / sizeof seeds[0]; i++) {
        double level[2][RATES_BANDS];
        int band;
        for (int k = 0; k < 2; k++) {
            long n;
            double *x = render(seeds[i], k ? 96000 : 44100, &n);
            rates_bands(x, n, k ? 96000 : 44100, level[k]);
            free(x);
        }
        double apart = rates_apart(level[0], level[1], 44100, &band);
        printf("scene %d: %.4f dB at %.0f Hz\n", seeds[i], apart, rates_centre(band));
        ck_assert_double_lt(apart, 0.05);
    }
    forget();
}
END_TEST

/* ------------------------------------------------------------------ transfer functions */

enum { MODES = 40, RATE = 44100, FRAMES = 1 << 15 };

struct pole {
    double f, d;
    double complex A; /* of velocity */
};

static void table(struct pole *m)
{
    char path[100];
    struct rates_dice d = rates_dice(77);
    snprintf(path, sizeof path, "%s/table0.csv", folder);
    FILE *f = fopen(path, "w");
    ck_assert_ptr_nonnull(f);
    fputs("# poles: shared\n# quantity: velocity\nplace,x_m,y_m,mode,frequency_hz,decay_per_s,gain,phase_rad\n", f);
    for (int i = 0; i < MODES; i++) {
        double gain = rates_log(&d, 0.1, 10), phase = i % 3 ? rates_draw(&d, 0, 6.2) : 1.5707963267948966;
        m[i].f = rates_log(&d, 100, 0.449 * RATE);
        m[i].d = rates_draw(&d, 60, 600);
        m[i].A = gain * cexp(I * phase);
        fprintf(f, "1,0,0,%d,%.17g,%.17g,%.17g,%.17g\n", i, m[i].f, m[i].d, gain, phase);
    }
    fclose(f);
}

/* The force that the modes get: a pulse of 50 us, as it comes down to the audio rate. */
static struct rig *heard(const char *quantity, const char *engine, enum item item)
{
    char text[1000];
    snprintf(text, sizeof text,
             "rasp: 1\nsurface: {response: %s/table0.csv, convolution: %s}\nscraper: {mass: 1 g}\nmotion: {path: "
             "still, duration: 0.01 s}\n"
             "contact: {model: strike, strike: {pulse: half_sine, stiffness: 4 MN/m, speed: 1 m/s, first: 3 "
             "ms}}\noutput: {quantity: %s, sample_rate: %d}\n",
             folder, engine, quantity, RATE);
    struct scene s = rig_scene(rig_arena(), text);
    return rig_record(&s, item, FRAMES, 1024);
}

static double complex spectrum(const double *x, double omega)
{
    double complex sum = 0, z = cexp(-I * omega / RATE), turn = 1;
    for (int n = 0; n < FRAMES; n++, turn = n % 256 ? turn * z : cexp(-I * omega / RATE * n))
        sum += x[n] * turn;
    return sum;
}

/* Sound over force at 200 frequencies from 5 Hz to 0.4 of the rate, where sampled modes are their transfer functions:
   within 1e-4 (alias.c) of the sum of |A|/rate, added up; and below the first mode, at 5 to 50 Hz, within 1e-8: the
   fit's error falls with the third power of omega towards 0 Hz, and responses are cut at -160 dB. */
START_TEST(transfer_functions)
{
    static const char *const quantities[] = {"displacement", "velocity", "acceleration"}, *const engines[] = {
                                                                                              "resonators",
                                                                                              "overlap_add"};
    struct pole m[MODES];
    table(m);
    for (int q = 0; q < 3; q++)
        for (int e = 0; e < 2; e++) {
            struct rig *sound = heard(quantities[q], engines[e], ITEM_SOUND),
                       *force = heard(quantities[q], engines[e], ITEM_FORCE);
            double worst = 0, low = 0, unit = 0;
            for (int i = 0; i < MODES; i++)
                unit += cabs(m[i].A * cpow(-m[i].d + 2 * M_PI * I * m[i].f, q - 1)) / RATE;
            for (int k = 0; k < 200; k++) {
                double f = k < 20 ? 5 * pow(10, k / 20.0) : 50 * pow(0.4 * RATE / 50, (k - 20) / 179.0);
                double complex w = 2 * M_PI * I * f, H = 0;
                for (int i = 0; i < MODES; i++) {
                    double complex s = -m[i].d + 2 * M_PI * I * m[i].f, A = m[i].A * cpow(s, q - 1);
                    H += (A / (w - s) - conj(A) / (w - conj(s))) / (2 * I) + (q == 2 ? cimag(A / s) : 0);
                }
                double off = cabs(spectrum(sound->x, 2 * M_PI * f) / spectrum(force->x, 2 * M_PI * f) - H) / unit;
                worst = fmax(worst, off);
                low = k < 20 ? fmax(low, off) : low;
            }
            printf("%s, %s: off by %.2g, below 50 Hz %.2g of the modes' sum\n", quantities[q], engines[e], worst, low);
            ck_assert_double_lt(worst, 1e-4);
            ck_assert_double_lt(low, 1e-8);
            rig_close(sound);
            rig_close(force);
        }
    forget();
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {third_octaves, transfer_functions};
    if (!mkdtemp(folder)) abort();
    int failed = unit_run("rates", tests, sizeof tests / sizeof tests[0]);
    rmdir(folder);
    return failed;
}
