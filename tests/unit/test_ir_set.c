/* Folders of responses: what is read, and what is refused with its file and line; and single WAVs at another rate. */
#include "unit.h"

#include <sys/stat.h>
#include <unistd.h>

#include "file/wav.h"
#include "response/ir.h"

enum { LENGTH = 4000 };
static char folder[64];

static void path_of(char *path, size_t size, const char *name) { snprintf(path, size, "%s/%s", folder, name); }

static void write_wav(const char *name, double rate, int channels, const double *x, size_t n)
{
    struct err e = {0};
    char path[128];
    struct wav_format format = {.rate = rate, .channels = channels, .bits = -64};
    path_of(path, sizeof path, name);
    struct wav_out *w = wav_create(path, &format, &e);
    ck_assert_msg(w && wav_write(w, x, n / (size_t)channels, &e) && wav_commit(w, &e), "%s", e.text);
}

static void write_index(const char *text)
{
    char path[128];
    path_of(path, sizeof path, "index.csv");
    FILE *f = fopen(path, "w");
    ck_assert(f && fputs(text, f) >= 0 && fclose(f) == 0);
}

/* u^8 e^-u sin, u = 3000 t: soft at the start, band-limited to 1e-8 at both rates. */
static double soft(double t, double f)
{
    double u = t * 3000;
    return pow(u / 8, 8) * exp(8 - u) * sin(2 * M_PI * f * t);
}

static void make_folder(void)
{
    static double x[LENGTH], y[LENGTH / 2], z[LENGTH], silent[100];
    strcpy(folder, "ir_set.XXXXXX");
    ck_assert(mkdtemp(folder) != NULL);
    for (int n = 0; n < LENGTH; n++) {
        x[n] = exp(-n / 300.0) * cos(0.3 * n);
        z[n] = soft(n / 44100.0, 3000);
    }
    for (int n = 0; n < LENGTH / 2; n++)
        y[n] = exp(-n / 100.0) * sin(0.5 * n);
    write_wav("a.wav", 48000, 1, x, LENGTH);
    write_wav("b.wav", 48000, 1, y, LENGTH / 2);
    write_wav("other rate.wav", 44100, 1, z, LENGTH);
    write_wav("stereo.wav", 48000, 2, x, LENGTH);
    write_wav("silent.wav", 48000, 1, silent, 100);
}

static void remove_folder(void)
{
    static const char *const files[] = {"a.wav", "b.wav", "other rate.wav", "stereo.wav", "silent.wav", "index.csv"};
    char path[128];
    for (int i = 0; i < 6; i++) {
        path_of(path, sizeof path, files[i]);
        unlink(path);
    }
    ck_assert_int_eq(rmdir(folder), 0);
}

START_TEST(reads)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct ir_set s;
    struct ir alone;
    struct places_mix mix;
    char path[128];
    make_folder();
    write_index("# plank: oak\nfile_name,x_m,y_m,gain_db,z_m\nb.wav,0.1,0,-20,0\na.wav,0,0,0,0.0\n\"other "
                "rate.wav\",0.05,0.02,6,0\n");
    ck_assert_msg(ir_set_read(&(struct ir_ask){folder, 48000, NAN, NULL}, a, &s, &e), "%s", e.text);
    ck_assert_int_eq(s.n, 3);
    ck_assert(places_kind(s.places) == PLACES_PLANE); /* by x: a.wav, "other rate.wav", b.wav */
    path_of(path, sizeof path, "a.wav");
    ck_assert(ir_read(&(struct ir_ask){path, 48000, NAN, NULL}, a, &alone, &e));
    ck_assert_uint_eq(s.ir[0].length, LENGTH);
    ck_assert_mem_eq(s.ir[0].h, alone.h, LENGTH * sizeof *alone.h);
    ck_assert(alone.h[0] == 0.5 / 48000); /* cos 0, half */
    ck_assert_uint_eq(s.ir[2].length, LENGTH / 2);
    for (int n = 0; n < LENGTH / 2; n++)
        ck_assert_double_eq_tol(s.ir[2].h[n], 0.1 * exp(-n / 100.0) * sin(0.5 * n) / 48000, 1e-20);
    places_at(s.places, 0.1, 0, &mix);
    for (int k = 0; k < mix.n; k++)
        ck_assert_double_eq_tol(mix.weight[k], mix.index[k] == 2, 1e-12);
    ck_assert_uint_eq(s.ir[1].length, (size_t)ceil(LENGTH / 44100.0 * 48000));
    for (size_t n = 0; n < s.ir[1].length; n++)
        ck_assert_double_eq_tol(s.ir[1].h[n], pow(10, 0.3) * soft((double)n / 48000, 3000) / 48000, 1e-8 / 48000);
    ck_assert_ptr_nonnull(s.note);
    ck_assert_msg(strstr(s.note, "other rate.wav: resampled from 44100 Hz to 48000 Hz"), "%s", s.note);
    remove_folder();
    arena_close(a);
}
END_TEST

/* One place holds everywhere; a cut; a folder at one rate has no note, several resampled files are counted. */
START_TEST(one_and_cut)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct ir_set s;
    struct places_mix mix;
    make_folder();
    write_index("file_name,x_m,y_m\na.wav,0.3,0.1\n");
    ck_assert_msg(ir_set_read(&(struct ir_ask){folder, 48000, 0.01, NULL}, a, &s, &e), "%s", e.text);
    ck_assert(places_kind(s.places) == PLACES_ONE && s.note == NULL);
    ck_assert_uint_eq(s.ir[0].length, 480);
    places_at(s.places, -7, 3, &mix);
    ck_assert(mix.n == 1 && mix.index[0] == 0 && mix.weight[0] == 1);
    write_index("file_name,x_m,y_m\na.wav,0.3,0.1\n./b.wav,0,0\n");
    ck_assert_msg(ir_set_read(&(struct ir_ask){folder, 44100, NAN, NULL}, a, &s, &e), "%s", e.text);
    ck_assert_msg(strstr(s.note, "b.wav: resampled from 48000 Hz to 44100 Hz (and 1 more of the folder's 2 responses)"),
                  "%s", s.note);
    remove_folder();
    arena_close(a);
}
END_TEST

static void refused(const char *index, const char *says)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct ir_set s;
    write_index(index);
    ck_assert_msg(!ir_set_read(&(struct ir_ask){folder, 48000, NAN, NULL}, a, &s, &e), "read: %s", index);
    ck_assert_int_ne(e.kind, ERR_NONE);
    ck_assert_msg(strstr(e.text, says) != NULL, "'%s' instead of '%s'", e.text, says);
    arena_close(a);
}

START_TEST(refusals)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct ir_set s;
    make_folder();
    ck_assert(!ir_set_read(&(struct ir_ask){folder, 48000, NAN, NULL}, a, &s, &e));
    ck_assert_int_eq(e.kind, ERR_INPUT);
    ck_assert_ptr_nonnull(strstr(e.text, "index.csv"));
    refused("file_name,x_m\na.wav,0\n", "index.csv: no column 'y_m'");
    refused("file_name,x_m,y_m,gain\na.wav,0,0,0\n", "index.csv: column 'gain' is not known");
    refused("file_name,x_m,y_m\n", "index.csv: has no rows");
    refused("file_name,x_m,y_m\na.wav,0,0\n../b.wav,1,0\n", "index.csv:3: '../b.wav' leads out of the folder");
    refused("file_name,x_m,y_m\nx/../../b.wav,1,0\n", "index.csv:2: 'x/../../b.wav' leads out");
    refused("file_name,x_m,y_m\nx/..,1,0\n", "leads out");
    refused("file_name,x_m,y_m\n/etc/b.wav,1,0\n", "leads out");
    refused("file_name,x_m,y_m\n\"\",1,0\n", "index.csv:2: file_name is empty");
    refused("file_name,x_m,y_m\na.wav,0,0\nb.wav,1,0\na.wav,2,0\n", "index.csv:4: 'a.wav' is in line 2 already");
    refused("file_name,x_m,y_m\na.wav,0.5,0.25\nb.wav,0.5,0.25\n", "index.csv:3: is at the same point");
    refused("file_name,x_m,y_m,z_m\na.wav,0,0,0.01\n", "index.csv:2: z_m is 0.01");
    refused("file_name,x_m,y_m\na.wav,zero,0\n", "index.csv:2: column 'x_m': 'zero' is not a");
    refused("file_name,x_m,y_m,gain_db\na.wav,0,0,1e9\n", "index.csv:2: gain_db is 1e+09");
    refused("file_name,x_m,y_m\nnone.wav,0,0\n", "index.csv:2: ");
    refused("file_name,x_m,y_m\nstereo.wav,0,0\n", "has 2 channels");
    refused("file_name,x_m,y_m\nsilent.wav,0,0\n", "is silent");
    refused("file_name,x_m,y_m\n..hidden.wav,0,0\n", "No such file"); /* a name may begin with dots */
    remove_folder();
    arena_close(a);
}
END_TEST

/* sum of h[n] e^(-i 2 pi f n / rate), less the same of the exponential's samples with half of the first, over their
   rate: in units of 1/low. */
static double spectrum_off(const struct ir *ir, double rate, const double *x, double f, double low)
{
    double re = 0, im = 0;
    for (size_t n = 0; n < ir->length; n++) {
        re += ir->h[n] * cos(2 * M_PI * f * (double)n / rate);
        im += ir->h[n] * sin(2 * M_PI * f * (double)n / rate);
    }
    for (int n = 0; n < 8820; n++) {
        re -= (n ? 1 : 0.5) * x[n] / 44100 * cos(2 * M_PI * f * n / 44100);
        im -= (n ? 1 : 0.5) * x[n] / 44100 * sin(2 * M_PI * f * n / 44100);
    }
    return hypot(re, im) * low;
}

/* A jump at the first sample, h = e^(-200 t). What it makes ring before 0 is folded into the first samples: the
   operator's spectrum stays what it is, but for what cannot be kept without a lead, 2e-4 h(0+) over the lower rate at
   0.01 of it, 4e-3 at 0.05, 0.016 at 0.1 (cut off: 0.01 h(0+) and more throughout). Far from it stand the samples of
   the exponential; and the integral is 1/200 s, up to the trapezium rule's error, 200/12 over the file's rate squared.
   */
START_TEST(jump)
{
    static const double rates[] = {48000, 96000, 88200, 22050, 44101};
    static double x[8820];
    static const double at[] = {0.01, 0.05, 0.1}, most[] = {2e-4, 4e-3, 1.6e-2};
    make_folder();
    for (int n = 0; n < 8820; n++)
        x[n] = exp(-200.0 * n / 44100);
    write_wav("a.wav", 44100, 1, x, 8820);
    for (int k = 0; k < 5; k++) {
        struct arena *a = arena_open();
        struct err e = {0};
        struct ir ir;
        char path[128];
        double sum = 0, middle = 0, low = fmin(rates[k], 44100);
        path_of(path, sizeof path, "a.wav");
        ck_assert_msg(ir_read(&(struct ir_ask){path, rates[k], NAN, NULL}, a, &ir, &e), "%s", e.text);
        for (size_t n = 0; n < ir.length; n++)
            sum += ir.h[n];
        for (size_t n = (size_t)(0.01 * rates[k]); n < ir.length / 2;
             n++) /* far from the jump: the samples of the exponential */
            middle = fmax(middle, fabs(ir.h[n] * rates[k] - exp(-200.0 * (double)n / rates[k])));
        printf("%g Hz: integral short by %.3f h(0+)/lower rate, far off by %.1e, h[0] R = %.4f\n", rates[k],
               (0.005 - sum) * low, middle, ir.h[0] * rates[k]);
        ck_assert_double_eq_tol(sum, 0.005, 2 * 200.0 / 12 / (44100.0 * 44100));
        ck_assert_double_lt(middle, 1e-8);
        for (int i = 0; i < 3; i++) {
            double off = spectrum_off(&ir, rates[k], x, at[i] * low, low);
            printf("   at %g of the lower rate off by %.1e h(0+)/lower rate\n", at[i], off), fflush(stdout);
            ck_assert_double_lt(off, most[i]);
        }
        arena_close(a);
    }
    write_index("");
    remove_folder();
}
END_TEST

UNIT("ir_set", reads, one_and_cut, refusals, jump)
