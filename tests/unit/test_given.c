/* given_samples, given_table: what a file holds comes through bit for bit at its own rate, as the same signal at
   another; means of a table against its integral in closed form; where it ends, and what is refused, with file and
   line. */
#include <unistd.h>

#include "contacts.h"
#include "file/wav.h"

static char folder[] = "/tmp/rasp-given-XXXXXX";

static const char *path(const char *name)
{
    static char all[4][100];
    static int k;
    if (strstr(folder, "XXXXXX")) ck_assert(mkdtemp(folder));
    k = (k + 1) % 4;
    snprintf(all[k], sizeof all[k], "%s/%s", folder, name);
    return all[k];
}

static void gone(const char *name)
{
    unlink(path(name));
    rmdir(folder);
}

static void write_wav(const char *name, double rate, int channels, int bits, const double *x, size_t frames)
{
    struct err e = {0};
    struct wav_format f = {.rate = rate, .channels = channels, .bits = bits};
    struct wav_out *w = wav_create(path(name), &f, &e);
    ck_assert_msg(w && wav_write(w, x, frames, &e) && wav_finish(w, &e) && wav_commit(w, &e), "%s", e.text);
}

static void write_text(const char *name, const char *text, size_t n)
{
    FILE *f = fopen(path(name), "wb");
    ck_assert(f && fwrite(text, 1, n, f) == n && fclose(f) == 0);
}

static void write_npy(const char *name, const char *shape, const double *x, size_t n)
{
    static char all[20000];
    char text[119];
    memset(all, ' ', 128);
    memcpy(all, "\x93NUMPY\x01\x00\x76\x00", 10); /* version 1.0, a header of 118 bytes */
    int length = snprintf(text, sizeof text, "{'descr': '<f8', 'fortran_order': False, 'shape': (%s), }", shape);
    memcpy(all + 10, text, (size_t)length);
    memcpy(all + 128, x, n * sizeof *x);
    write_text(name, all, 128 + n * sizeof *x);
}

static struct contact giver(const char *file, double duration)
{
    struct contact c = shot_contact(CONTACT_GIVEN, duration);
    shot_given(&c)->file = file;
    return c;
}

/* ------------------------------------------------------------------ samples */

/* Second channel of three, float64 and 24 bits, a power of two as its scale and 1: not a bit changes. */
START_TEST(wav_at_its_own_rate)
{
    enum { N = 5000 };
    static double x[N][3];
    for (int i = 0; i < N; i++)
        for (int k = 0; k < 3; k++)
            x[i][k] = rint(8388607 * (drand48() - 0.5)) / 8388608;
    for (int bits = -64; bits <= 24; bits += 88)
        for (double scale = 1; scale < 2000; scale *= 1024) {
            write_wav("a.wav", 44100, 3, bits, x[0], N);
            struct contact c = giver(path("a.wav"), 1);
            struct shot s;
            shot_given(&c)->channel = 2;
            shot_given(&c)->scale = scale;
            ck_assert_msg(shot_open(&s, &given_samples_stage, &c, 44100, 4), "%s", s.e.text);
            const double *force = shot_force(&s, N + 100);
            for (int i = 0; i < N; i++)
                ck_assert_double_eq(force[i], scale * x[i][1]);
            for (int i = N; i < N + 100; i++)
                ck_assert_double_eq(force[i], 0);
            arena_close(s.arena);
        }
    gone("a.wav");
}
END_TEST

START_TEST(npy_at_its_own_rate)
{
    enum { N = 1000 };
    static double x[N];
    for (int i = 0; i < N; i++)
        x[i] = drand48() - 0.5;
    write_npy("a.npy", "1000,", x, N);
    struct contact c = giver(path("a.npy"), 1);
    struct shot s;
    shot_given(&c)->rate = 48000;
    ck_assert_msg(shot_open(&s, &given_samples_stage, &c, 48000, 4), "%s", s.e.text);
    ck_assert_int_eq(s.board.n_warnings, 0);
    ck_assert_mem_eq(shot_force(&s, N), x, sizeof x);
    arena_close(s.arena);
    gone("a.npy");
}
END_TEST

/* A sine of 997 Hz under a Hann window of 0.1 s, which is band-limited as far as 1e-9 of it matters, at other rates:
 * within -120 dB. */
START_TEST(resampled_is_the_same_signal)
{
    static const double rates[] = {22050, 44100, 96000, 192000};
    enum { N = 4801 };
    static double x[N];
    for (int i = 0; i < N; i++)
        x[i] = sin(2 * M_PI * 997 * i / 48000.0) * (0.5 - 0.5 * cos(2 * M_PI * i / 4800.0));
    write_wav("a.wav", 48000, 1, -64, x, N);
    for (int r = 0; r < 4; r++) {
        struct contact c = giver(path("a.wav"), 1);
        struct shot s;
        shot_given(&c)->scale = 3;
        ck_assert_msg(shot_open(&s, &given_samples_stage, &c, rates[r], 4), "%s", s.e.text);
        long n = (long)(0.1 * rates[r]);
        const double *force = shot_force(&s, n + 10);
        for (long i = 0; i < n; i++) {
            double t = (double)i / rates[r];
            ck_assert_double_eq_tol(force[i], 3 * sin(2 * M_PI * 997 * t) * (0.5 - 0.5 * cos(2 * M_PI * t / 0.1)),
                                    3e-6);
        }
        arena_close(s.arena);
    }
    gone("a.wav");
}
END_TEST

/* ------------------------------------------------------------------ tables */

/* Integral of the table from its start to t, in long double. */
static long double table_integral(size_t n, const double *t, const double *f, long double end)
{
    long double sum = 0;
    for (size_t i = 0; i + 1 < n && t[i] < end; i++) {
        long double stop = fminl(t[i + 1], end), d = stop - t[i],
                    slope = ((long double)f[i + 1] - f[i]) / ((long double)t[i + 1] - t[i]);
        sum += d * (f[i] + slope * d / 2);
    }
    return sum;
}

/* 200 rows at distances from 1 us to 10 ms, so that sub-intervals hold none or many. Times are rounded once, to 1e-13 s
   (1e-8 of a sub-interval), which moves a knot; over one sub-interval that is 1e-9 of what the force varies by. */
START_TEST(table_means_are_exact)
{
    enum { N = 200 };
    static char text[N * 60];
    double t[N], f[N];
    int length = snprintf(text, sizeof text, "time_s,force_n,other\n");
    srand48(3);
    for (int i = 0; i < N; i++) {
        t[i] = (i ? t[i - 1] : 0.0003) + 1e-6 * pow(1e4, drand48());
        f[i] = 20 * (drand48() - 0.3);
        length += snprintf(text + length, sizeof text - (size_t)length, "%.17g,%.17g,x\n", t[i], f[i]);
    }
    write_text("a.csv", text, (size_t)length);
    for (int over = 1; over <= 32; over *= 4) {
        struct contact c = giver(path("a.csv"), 1);
        struct shot s;
        long double sum = 0, per_second = 44100.0L * over;
        ck_assert_msg(shot_open(&s, &given_table_stage, &c, 44100, over), "%s", s.e.text);
        long frames = (long)(t[N - 1] * 44100) + 10;
        const double *force = shot_force(&s, frames);
        for (long i = 0; i < frames * over; i++) {
            long double want =
                (table_integral(N, t, f, (i + 1) / per_second) - table_integral(N, t, f, i / per_second)) * per_second;
            ck_assert_double_eq_tol(force[i], (double)want, 1e-9);
            sum += force[i];
        }
        ck_assert_double_eq_tol((double)(sum / per_second), (double)table_integral(N, t, f, 1), 1e-14);
        arena_close(s.arena);
    }
    gone("a.csv");
}
END_TEST

/* A ramp whose ends fall on sub-intervals, at a rate that is a power of two: every mean is the value at its middle, to
 * rounding. */
START_TEST(ramp_means)
{
    const char *text = "# a ramp\ntime_s,push\n0,1\n0.25,5\n";
    write_text("a.csv", text, strlen(text));
    struct contact c = giver(path("a.csv"), 0.25);
    struct shot s;
    shot_given(&c)->column = "push";
    shot_given(&c)->scale = 2;
    shot_ramp = 0.26; /* the ramp's largest force is its last */
    ck_assert_msg(shot_open(&s, &given_table_stage, &c, 8192, 4), "%s", s.e.text);
    ck_assert(s.board.n_warnings == 1 &&
              strstr(s.board.warnings[0], "the largest force comes 0.25 s after the scene's start"));
    const double *force = shot_force(&s, 2100);
    for (int i = 0; i < 2100 * 4; i++)
        ck_assert_double_eq_tol(force[i], i < 8192 ? 2 * (1 + 4 * (i + 0.5) / 8192) : 0, 4e-15);
    arena_close(s.arena);
    gone("a.csv");
}
END_TEST

/* Decimated, a slow table is what it says: the filter is flat within 2e-6 (num/filter.h). */
START_TEST(table_decimated)
{
    static char text[200000];
    int length = snprintf(text, sizeof text, "time_s,force_n\n");
    for (int i = 0; i <= 4000; i++) /* rows 50 us apart: (2 pi 40 5e-5)^2 / 8 = 2e-5 off a straight line */
        length += snprintf(text + length, sizeof text - (size_t)length, "%.17g,%.17g\n", i * 5e-5,
                           sin(2 * M_PI * 40 * i * 5e-5));
    write_text("a.csv", text, (size_t)length);
    struct contact c = giver(path("a.csv"), 0.2);
    struct shot s;
    ck_assert_msg(shot_open(&s, &given_table_stage, &c, 22050, 4), "%s", s.e.text);
    const double *force = shot_decimated(&s, 4410);
    for (int i = 300; i < 4100; i++)
        ck_assert_double_eq_tol(force[i], sin(2 * M_PI * 40 * i / 22050.0), 4e-5);
    arena_close(s.arena);
    gone("a.csv");
}
END_TEST

/* ------------------------------------------------------------------ from the first sample on */

/* Tables that begin at full height, or stand there and fall at once: sum of the force over the rate against the
   integral. */
START_TEST(table_momentum_from_the_start)
{
    static const char *const tables[] = {"0,1\n0.01,1\n", "0,5\n1e-6,0\n", "0,-2\n0.0101,3\n0.013,0\n",
                                         "0,1\n3.3e-5,7\n3.3001e-5,0\n", "4e-6,9\n2e-5,9\n"};
    static const double integrals[] = {0.01, 2.5e-6, 0.5 * (-2 + 3) * 0.0101 + 1.5 * 0.0029, 4 * 3.3e-5 + 3.5e-9,
                                       9 * 1.6e-5};
    static const double sizes[] = {0.01, 2.5e-6, 0.017, 1.3e-4, 1.44e-4};
    static const double rates[] = {22050, 44100, 48000, 192000};
    for (int k = 0; k < 20; k++)
        for (int over = 1; over <= 64; over *= 4) {
            char text[200];
            int length = snprintf(text, sizeof text, "time_s,force_n\n%s", tables[k / 4]);
            write_text("a.csv", text, (size_t)length);
            struct contact c = giver(path("a.csv"), 0.02);
            struct shot s;
            ck_assert_msg(shot_open(&s, &given_table_stage, &c, rates[k % 4], over), "%s", s.e.text);
            long n = (long)(0.03 * rates[k % 4]);
            const double *force = shot_decimated(&s, n);
            double sum = 0;
            for (long i = 0; i < n; i++)
                sum += force[i] / rates[k % 4];
            ck_assert_double_eq_tol(sum, integrals[k / 4], 1e-6 * sizes[k / 4]);
            arena_close(s.arena);
        }
    gone("a.csv");
}
END_TEST

/* Samples that begin and end at full height, at other rates. */
START_TEST(samples_momentum_from_the_start)
{
    static const double rates[] = {22050, 44100, 47999, 96000};
    enum { N = 700 };
    static double x[N];
    double want = 0;
    srand48(9);
    for (int i = 0; i < N; i++)
        want += (x[i] = 1 + drand48()) / 48000;
    write_wav("a.wav", 48000, 1, -64, x, N);
    for (int r = 0; r < 4; r++) {
        struct contact c = giver(path("a.wav"), 1);
        struct shot s;
        double sum = 0;
        shot_given(&c)->scale = 1;
        ck_assert_msg(shot_open(&s, &given_samples_stage, &c, rates[r], 4), "%s", s.e.text);
        long n = (long)(0.03 * rates[r]);
        const double *force = shot_force(&s, n);
        for (long i = 0; i < n; i++)
            sum += force[i] / rates[r];
        ck_assert_double_eq_tol(sum, want, 1e-8 * want);
        arena_close(s.arena);
    }
    gone("a.wav");
}
END_TEST

/* ------------------------------------------------------------------ refusals */

static void refused(const struct stage *stage, const struct contact *c, const char *says)
{
    struct shot s;
    ck_assert_msg(!shot_open(&s, stage, c, 48000, 4), "accepted: %s", says);
    ck_assert_msg(s.e.kind == ERR_SCENE && strstr(s.e.text, says), "%s, not %s", s.e.text, says);
    arena_close(s.arena);
}

START_TEST(wavs_refused)
{
    static double x[96000];
    write_wav("a.wav", 48000, 2, 24, x, 48000);
    struct contact c = giver(path("a.wav"), 0.5);
    refused(&given_samples_stage, &c, "contact.given.scale must be given");
    shot_given(&c)->scale = 100;
    refused(&given_samples_stage, &c, "lasts 0.999979167 s, but the motion lasts 0.5 s");
    c.motion.duration = 1;
    struct shot s;
    ck_assert(shot_open(&s, &given_samples_stage, &c, 48000, 4)); /* a second fits into a second */
    arena_close(s.arena);
    shot_given(&c)->channel = 3;
    refused(&given_samples_stage, &c, "is 3, but");
    shot_given(&c)->channel = 1;
    shot_given(&c)->rate = 48000;
    refused(&given_samples_stage, &c, "contact.given.rate means nothing");
    gone("a.wav");
}
END_TEST

START_TEST(npys_refused)
{
    double x[6] = {0, 1, 2, NAN, 4, 5};
    write_npy("a.npy", "6,", x, 6);
    struct contact c = giver(path("a.npy"), 1);
    refused(&given_samples_stage, &c, "element 3 is not a finite number");
    x[3] = 3;
    write_npy("a.npy", "6,", x, 6);
    refused(&given_samples_stage, &c, "contact.given.rate must be given");
    shot_given(&c)->rate = 1000;
    write_npy("a.npy", "2, 3", x, 6);
    refused(&given_samples_stage, &c, "2 x 3; a force has one dimension");
    shot_given(&c)->channel = 2;
    refused(&given_samples_stage, &c, "contact.given.channel means nothing");
    gone("a.npy");
}
END_TEST

START_TEST(tables_refused)
{
    static const struct {
        const char *text, *says;
    } bad[] = {{"time_s,force_n\n0,1\n", "at least 2 are needed"},
               {"time_s,force_n\n0,1\n0.1,nan\n", "a.csv:3: column 'force_n'"},
               {"time_s,force_n\n0,1\n0.1,2\n0.1,3\n", "a.csv:4: column 'time_s': 0.1 s comes after 0.1 s"},
               {"time_s,f\n0,1\n0.1,2\n", "no column 'force_n'"},
               {"time_s,force_n\n-0.1,1\n0.1,2\n", "a.csv:2: column 'time_s': -0.1 s lies before"},
               {"time_s,force_n\n0,1\n2,2\n", "lasts 2 s, but the motion lasts 1 s"}};
    struct contact c = giver(path("a.csv"), 1);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        write_text("a.csv", bad[i].text, strlen(bad[i].text));
        refused(&given_table_stage, &c, bad[i].says);
    }
    shot_given(&c)->rate = 10;
    refused(&given_table_stage, &c, "contact.given.rate means nothing");
    gone("a.csv");
}
END_TEST

/* A missing file is another kind of error. */
START_TEST(missing)
{
    struct contact wav = giver("/nowhere/a.wav", 1), csv = giver("/nowhere/a.csv", 1);
    struct shot s;
    ck_assert(!shot_open(&s, &given_samples_stage, &wav, 48000, 4));
    ck_assert_int_eq(s.e.kind, ERR_INPUT);
    arena_close(s.arena);
    ck_assert(!shot_open(&s, &given_table_stage, &csv, 48000, 4));
    ck_assert_int_eq(s.e.kind, ERR_INPUT);
    arena_close(s.arena);
}
END_TEST

UNIT("given", wav_at_its_own_rate, npy_at_its_own_rate, resampled_is_the_same_signal, table_means_are_exact, ramp_means,
     table_decimated, table_momentum_from_the_start, samples_momentum_from_the_start, wavs_refused, npys_refused,
     tables_refused, missing)
