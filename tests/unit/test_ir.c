#include "unit.h"

#include <unistd.h>

#include "file/wav.h"
#include "response/ir.h"

enum { MODES = 51, LENGTH = 96000 };

static double frequency[MODES], decay[MODES], gain_re[MODES], gain_im[MODES], h[LENGTH];

static const struct modes_point point = {frequency, decay, gain_re, gain_im};

static void make(double shift)
{
    for (int i = 0; i < MODES; i++) {
        frequency[i] = 31.7 * pow(740, i / (MODES - 1.0)) + (i % 3 ? 0 : shift); /* up to 23.46 kHz = 0.489 x 48 kHz */
        decay[i] = 0.3 + 1.7 * (i % 7);
        gain_re[i] = cos(3.1 * i);
        gain_im[i] = 0.7 * sin(1.7 * i);
    }
}

static long double closed_form(int n, double rate)
{
    long double t = n / (long double)rate, sum = 0, pi = acosl(-1.0L);
    for (int i = 0; i < MODES; i++)
        sum += expl(-decay[i] * t) *
               (gain_re[i] * sinl(2 * pi * frequency[i] * t) + gain_im[i] * cosl(2 * pi * frequency[i] * t));
    return sum / rate * (n ? 1 : 0.5L);
}

/* Against long double; the header promises 1e-12 of the sum of |gain|. */
START_TEST(samples_modes)
{
    make(0);
    struct arena *a = arena_open();
    struct ir_sampler *s = ir_sampler_make(a, MODES, 48000);
    double sum = 0, worst = 0;
    for (int i = 0; i < MODES; i++)
        sum += sqrt(gain_re[i] * gain_re[i] + gain_im[i] * gain_im[i]);
    ir_sample(s, MODES_VELOCITY, &point, h, LENGTH);
    for (int n = 0; n < LENGTH; n += n < 600 ? 1 : 37)
        worst = fmax(worst, fabs(h[n] - (double)closed_form(n, 48000)));
    printf("worst error %.2e of the sum of gains\n", worst * 48000 / sum);
    ck_assert_double_lt(worst * 48000 / sum, 1e-12);
    static double again[1001];
    again[1000] = 7;
    ir_sample(s, MODES_VELOCITY, &point, again,
              1000); /* shorter, after a longer one: the same samples, and none beyond */
    ck_assert(memcmp(h, again, 1000 * sizeof *h) == 0 && again[1000] == 7);
    arena_close(a);
}
END_TEST

/* Poles may be others at every call, some of them or all: what a sampler has had before makes no difference, to the
 * last bit. */
START_TEST(poles_move)
{
    static double other[2000];
    struct arena *a = arena_open();
    struct ir_sampler *s = ir_sampler_make(a, MODES, 48000);
    for (int k = 0; k < 6; k++) {
        make(k / 2); /* every second time only a decay */
        decay[k] *= 1 + k;
        ir_sample(s, MODES_VELOCITY, &point, h, 2000);
        ir_sample(ir_sampler_make(a, MODES, 48000), MODES_VELOCITY, &point, other, 2000);
        ck_assert(memcmp(h, other, sizeof other) == 0);
        for (int n = 0; n < 2000; n += 99)
            ck_assert_double_eq_tol(h[n], (double)closed_form(n, 48000), 1e-12 * MODES / 48000);
    }
    arena_close(a);
}
END_TEST

/* An acceleration, or a pressure, adds its direct term to the first sample, whole. */
START_TEST(direct_term)
{
    make(0);
    struct arena *a = arena_open();
    double hv, ha, d = modes_direct(MODES_ACCELERATION, MODES, frequency, decay, &point);
    struct ir_sampler *s = ir_sampler_make(a, MODES, 48000);
    ir_sample(s, MODES_VELOCITY, &point, &hv, 1);
    for (int quantity = MODES_ACCELERATION; quantity <= MODES_PRESSURE; quantity++) {
        ir_sample(s, quantity, &point, &ha, 1);
        ck_assert(d != 0);
        ck_assert_double_eq_tol(ha - hv, d, 1e-15);
    }
    arena_close(a);
}
END_TEST

START_TEST(lengths)
{
    ck_assert_uint_eq(ir_length(48000, 0.25), 12000);
    ck_assert_uint_eq(ir_length(44100, 0.1), 4410); /* t < t0: the sample at t0 itself is left out */
    ck_assert_uint_eq(ir_length(44100, 0.1 + 1e-6), 4411);
    ck_assert_uint_eq(ir_length(48000, 1e-9), 1);
}
END_TEST

static const char *shipped(const char *name)
{
    static char path[4096];
    const char *root = getenv("ROOT");
    snprintf(path, sizeof path, "%s/irs/%s", root ? root : ".", name);
    return path;
}

/* The tap that ships is the tile's thirteenth place, sampled by awk and rounded to single precision. */
START_TEST(wav_is_the_table)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct modes m;
    struct ir ir, cut;
    ck_assert_msg(ir_read(&(struct ir_ask){shipped("ceramic_tile_tap.wav"), 48000, NAN, NULL}, a, &ir, &e), "%s",
                  e.text);
    ck_assert_msg(ir_read(&(struct ir_ask){shipped("ceramic_tile_tap.wav"), 48000, 0.1, NULL}, a, &cut, &e), "%s",
                  e.text);
    ck_assert_msg(modes_table(shipped("ceramic_tile.csv"),
                              &(struct modes_ask){.strongest = 1000, .pairing = 0.03, .rate = 48000}, a, &m, &e),
                  "%s", e.text);
    ck_assert_uint_eq(ir.length, 12000);
    ck_assert_uint_eq(cut.length, 4800);
    struct modes_point p = {m.frequency, m.decay, ARENA_TAKE(a, double, m.n), ARENA_TAKE(a, double, m.n)};
    ck_assert(modes_at(&m, &(struct modes_where){0.15, 0, 0}, &p) == 0);
    ir_sample(ir_sampler_make(a, m.n, 48000), m.quantity, &p, h, ir.length);
    double peak = 0, worst = 0;
    for (size_t n = 0; n < ir.length; n++) {
        peak = fmax(peak, fabs(h[n]));
        worst = fmax(worst, fabs(h[n] - ir.h[n]));
    }
    printf("peak %.3g, worst difference %.2e of it\n", peak, worst / peak);
    ck_assert_double_lt(worst, peak * 6e-8); /* half a unit of 24 bits */
    ck_assert(memcmp(ir.h, cut.h, cut.length * sizeof *cut.h) == 0);
    arena_close(a);
}
END_TEST

static void refused(int channels, double level, double rate, double t0, const char *says)
{
    struct err e = {0};
    struct arena *a = arena_open();
    struct wav_format format = {.rate = 44100, .channels = channels, .bits = -64};
    double x[200] = {0};
    struct ir ir;
    x[150] = level;
    struct wav_out *w = wav_create("ir.tmp.wav", &format, &e);
    ck_assert(w && wav_write(w, x, 200 / (size_t)channels, &e) && wav_commit(w, &e));
    ck_assert(!ir_read(&(struct ir_ask){"ir.tmp.wav", rate, t0, NULL}, a, &ir, &e));
    unlink("ir.tmp.wav");
    ck_assert_int_eq(e.kind, ERR_SCENE);
    ck_assert_msg(strstr(e.text, says) != NULL, "%s", e.text);
    arena_close(a);
}

START_TEST(bad_files_are_refused)
{
    struct arena *a = arena_open();
    struct err e = {0};
    struct ir ir;
    ck_assert(!ir_read(&(struct ir_ask){"no-such.wav", 48000, NAN, NULL}, a, &ir, &e));
    ck_assert_int_eq(e.kind, ERR_INPUT);
    arena_close(a);
    refused(2, 1, 44100, NAN, "has 2 channels; an impulse response is mono");
    refused(1, 0, 44100, NAN, "is silent");
    refused(1, 1, 44100, 0.001, "is silent before response_length");
}
END_TEST

UNIT("ir", samples_modes, poles_move, direct_term, lengths, wav_is_the_table, bad_files_are_refused)
