/* What is in a WAV, cut or continued: against closed forms. */
#include "batch/recording.h"

#include <unistd.h>

#include "base/arena.h"
#include "file/wav.h"
#include "unit.h"

enum { RATE = 48000, CHANNELS = 2 };

static char file[] = "/tmp/rasp-measure-XXXXXX.wav";

/* Of both channels the same, but the second half as loud. */
static void make(long frames, double (*of)(long i, double how), double how)
{
    struct err e = {0};
    struct wav_format f = {.rate = RATE, .channels = CHANNELS, .bits = -64};
    struct wav_out *out = wav_create(file, &f, &e);
    ck_assert_ptr_nonnull(out);
    for (long i = 0; i < frames; i++) {
        double x = of(i, how), both[2] = {x, x / 2};
        ck_assert(wav_write(out, both, 1, &e));
    }
    ck_assert(wav_commit(out, &e));
}

static double constant(long i, double how)
{
    (void)i;
    return how;
}

/* how: Hz; 45 degrees from a zero; slowly from nothing, as a step rings. */
static double sine(long i, double how)
{
    return fmin(1, (double)i / 4800) * sin(2 * M_PI * how * (double)i / RATE + M_PI / 4);
}

/* The same, and slowly to nothing at half a second. */
static double swell(long i, double how) { return fmin(1, (double)(RATE / 2 - i) / 4800) * sine(i, how); }

static struct measure of(double seconds, double ramp, bool loud)
{
    struct err e = {0};
    struct measure m;
    ck_assert_msg(recording_measure(file, &(struct measure_form){seconds, ramp}, loud, &m, &e), "%s", e.text);
    return m;
}

/* sin^4 at the middles of n equal parts of a quarter turn has the mean 3/8 for n of 3 or more. To a rounding of the
 * sums. */
START_TEST(levels_are_those_of_the_whole_file)
{
    static const struct {
        double seconds, ramp, frames, kept, ramped;
    } rows[] = {
        {NAN, 0.01, 4800, 4800, 0},                                 /* as it is */
        {0.1, 0.01, 4800, 4800, 0},                                 /* the same */
        {0.2, 0.01, 9600, 4800, 0},                                 /* silence behind it */
        {0.05, 0.01, 2400, 1920, 480},                              /* cut */
        {0.05, 0, 2400, 2400, 0},      {0.01, 0.02, 480, 240, 240}, /* half of it at most */
    };
    close(mkstemps(file, 4));
    make(4800, constant, 0.5);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct measure m = of(rows[i].seconds, rows[i].ramp, false);
        double power = (1 + 0.25) / 2 * 0.25 * (rows[i].kept + rows[i].ramped * 3 / 8) / rows[i].frames;
        ck_assert_double_eq((double)m.frames, rows[i].frames);
        ck_assert_int_eq(m.own, 4800);
        ck_assert_double_eq_tol(m.rms, sqrt(power), 1e-12);
        ck_assert_double_eq(m.peak, 0.5);
        ck_assert_double_eq(m.before, 0.5);
        ck_assert_double_eq(m.end, rows[i].seconds > 0.1 ? 0 : 0.5);
        ck_assert(isnan(m.lufs) && isnan(m.true_peak));
    }
    unlink(file);
}
END_TEST

/* At a quarter of the rate the samples are 3.01 dB below the peak between them; BS.1770-4 Annex 2 allows 0.17 dB there
 * for four times as many. Times scale. */
START_TEST(peaks_between_samples)
{
    static const struct {
        double frequency, below;
    } rows[] = {{100, 0.01}, {997, 0.01}, {12000, 0.17}};
    close(mkstemps(file, 4));
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        make(RATE / 2, swell, rows[i].frequency);
        struct measure m = of(NAN, 0, true);
        printf("%g Hz: sample %.4f, true %.4f, %.3f LUFS\n", rows[i].frequency, m.peak, m.true_peak, m.lufs);
        ck_assert_double_ge(20 * log10(m.true_peak), -rows[i].below);
        ck_assert_double_le(20 * log10(m.true_peak), 0.05);
        if (rows[i].frequency == 12000) ck_assert_double_eq_tol(m.peak, sqrt(0.5), 1e-9);
    }
    unlink(file);
}
END_TEST

/* Where a sound ends abruptly it rings between the samples, whether the file goes on in silence or not. */
START_TEST(peaks_at_the_end)
{
    close(mkstemps(file, 4));
    make(RATE / 2 + 7, sine, 997);
    double own = of(NAN, 0, true).true_peak, longer = of(1, 0, true).true_peak;
    ck_assert_double_eq(own, longer);
    ck_assert_double_ge(own, of(0.499, 0.01, true).true_peak + 1e-4);
    unlink(file);
}
END_TEST

/* BS.1770: a sine of 997 Hz and peak 1 in one channel of two has -3.01 LUFS; here the second adds a quarter of the
   power, +0.97. What is behind it is silent, and its blocks do not count; those that overlap its end do. */
START_TEST(loudness_is_that_of_the_parts_that_sound)
{
    close(mkstemps(file, 4));
    make(4 * RATE, sine, 997);
    ck_assert_double_eq_tol(of(NAN, 0, true).lufs, -3.01 + 0.97, 0.05); /* 0.1 s of a rising sine in it */
    double cut = of(2, 0.01, true).lufs, longer = of(8, 0.01, true).lufs;
    ck_assert_double_eq_tol(cut, -3.01 + 0.97, 0.1);
    ck_assert_double_eq_tol(longer, -3.01 + 0.97, 0.4);
    ck_assert_double_lt(longer, cut - 0.01);
    ck_assert(isnan(of(0.3, 0, true).lufs));
    unlink(file);
}
END_TEST

UNIT("measure", levels_are_those_of_the_whole_file, peaks_between_samples, peaks_at_the_end,
     loudness_is_that_of_the_parts_that_sound)
