/* Sample-rate conversion by libsoxr, recipe VHQ: 28 bits, linear phase, no delay, unit gain, flat to 0.91 of the lower
   Nyquist frequency, nothing above that frequency. Errors against closed forms, twelve pairs of rates, up to 0.88 of
   that frequency (tests/unit/test_resample.c): -172 dB of the peak or less. Without SOXR_ROLLOFF_NONE libsoxr allows
   itself 0.01 dB in the upper half of the band: -67 dB.

   Same bits on every CPU. Three things in libsoxr 0.1.3 vary, measured over eleven pairs of rates:
   - It has two double-precision engines and picks by CPU: cr64s (AVX), cr64 (plain C); 90 % of samples differ, by up to
     2.4e-15. The
     environment decides before the CPU does, and so `portable` asks for cr64 there, and takes away the variables that
       change filters.
   - Its filters come from libm. Without FMA 16 samples of 674550 differ, by 1.1e-16: rounding the result to a grid
     would make such a flip
     rare, never impossible. So libm's functions are replaced below: then all samples are the same with and
       without FMA.
   - A clock of 32 bits for ratios that are not small fractions: SOXR_HI_PREC_CLOCK makes it exact enough for the figure
     above.
   What remains: another version of libsoxr may differ, as another FFTW may.

   The beginning. libsoxr starts as if nothing could ring before sample 0, and where it has several stages each of them
   drops its own: of an impulse in the first sample 4 % are missing even from what comes after it (44.1 to 48 kHz). So
   the signal is converted behind P samples of silence, which take Q samples out, P/Q being rate_in/rate_out; and what
   then rings before it is folded into the first samples (num/filter.h). P and Q are whole and at most STILL where the
   ratio allows; else P/Q is the best approximation by such (continued fraction), and the signal comes out by less than
   1/STILL of a sample beside its place: -120 dB at the very top of the band.

   One thread at a time: the environment is the whole program's, and so are libsoxr's tables for its FFTs. */
#include "num/resample.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <soxr.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/stopwatch.h"
#include "num/filter.h"
#include "num/real.h"

enum { STILL = 1 << 22, REACH = RESAMPLE_REACH };
enum { MARGIN = 64 }; /* samples of silence behind x, in and out, so that the last ones come out whole */

/* The functions by which libsoxr designs its filters. A program's own definitions come before libm's when the dynamic
   linker binds a shared library (GSL and libebur128 get them too). SLEEF's deterministic ones: at most 1.0 ulp. rasp's
   own objects call none of them (tests/tidy/symbols.sh). */
double exp(double x) { return real_exp(x); }
double log(double x) { return real_log(x); }
double log10(double x) { return real_log10(x); }
double pow(double x, double y) { return real_pow(x, y); }
double sin(double x) { return real_sin(x); }
double cos(double x) { return real_cos(x); }
double asin(double x) { return Sleef_cinz_asind1_u10purec(x); }

static pthread_mutex_t one_at_a_time = PTHREAD_MUTEX_INITIALIZER;

/* Read by soxr_create only, and by nothing else in the program. What is there already stays untouched: another thread
 * may be reading the environment. */
static void portable(void)
{
    static const char *const tunings[] = {"SOXR_MIN_DFT_SIZE", "SOXR_LARGE_DFT_SIZE", "SOXR_COEFS_SIZE",
                                          "SOXR_NUM_THREADS",  "SOXR_COEF_INTERP",    "SOXR_STRICT_BUF",
                                          "SOXR_NOSMALLINTOPT"};
    const char *simd = getenv("SOXR_USE_SIMD");
    if ((!simd || strcmp(simd, "0") != 0) && setenv("SOXR_USE_SIMD", "0", 1) != 0) memory_out("for the environment");
    for (size_t i = 0; i < sizeof tunings / sizeof tunings[0]; i++)
        if (getenv(tunings[i])) unsetenv(tunings[i]);
}

void resample_prepare(void)
{
    pthread_mutex_lock(&one_at_a_time);
    portable();
    pthread_mutex_unlock(&one_at_a_time);
}

static soxr_t open_soxr(double rate_in, double rate_out, struct err *e)
{
    soxr_error_t failure = NULL;
    soxr_io_spec_t io = soxr_io_spec(SOXR_FLOAT64_I, SOXR_FLOAT64_I);
    soxr_quality_spec_t quality = soxr_quality_spec(SOXR_VHQ, SOXR_HI_PREC_CLOCK | SOXR_ROLLOFF_NONE);
    soxr_runtime_spec_t one_thread = soxr_runtime_spec(1);
    portable();
    memory_available(1 << 24); /* libsoxr 0.1.3 designs its filters in memory that it does not know to be there */
    errno = 0;
    soxr_t s = soxr_create(rate_in, rate_out, 1, &failure, &io, &quality, &one_thread);
    if ((failure || !s) && errno == ENOMEM) memory_out("resampling from %g to %g Hz", rate_in, rate_out);
    if (failure || !s) {
        err_set(e, ERR_UNBUILT, "resampling from %g to %g Hz: libsoxr: %s", rate_in, rate_out,
                failure ? failure : "no memory");
        return NULL;
    }
    if (strcmp(soxr_engine(s), "cr64") == 0) return s;
    err_set(e, ERR_UNBUILT,
            "resampling: this libsoxr (engine %s) is built without its portable double-precision engine, cr64",
            soxr_engine(s));
    soxr_delete(s);
    return NULL;
}

/* x[n], then silence until m samples are out. */
static size_t convert(soxr_t s, const double *x, size_t n, double *y, size_t m)
{
    double quiet[MARGIN] = {0};
    size_t in = 0, out = 0, done = 0, taken = 0, idle = 0;
    while (done < m && idle < 1000000) {
        bool left = in < n;
        if (soxr_process(s, left ? x + in : quiet, left ? n - in : MARGIN, &taken, y + done, m - done, &out)) break;
        in += left ? taken : 0;
        done += out;
        idle = out ? 0 : idle + 1;
    }
    return done;
}

static bool convert_alone(const double *x, size_t n, const double rates[2], double *y, size_t m, struct err *e)
{
    size_t done = m;
    pthread_mutex_lock(&one_at_a_time);
    soxr_t s = open_soxr(rates[0], rates[1], e);
    if (s) {
        done = convert(s, x, n, y, m);
        soxr_delete(s);
    }
    pthread_mutex_unlock(&one_at_a_time);
    if (!s || done == m) return s;
    return err_set(e, ERR_NUMBERS, "resampling from %g to %g Hz: libsoxr gave %zu samples of %zu", rates[0], rates[1],
                   done, m);
}

/* Numbers of samples, in and out, that take the same time: the last convergent of the ratio's continued fraction with
   both up to STILL, so often that `least` go in. */
static void even_times(const double rates[2], size_t least, size_t *in, size_t *out)
{
    double ratio = rates[1] / rates[0], rest = ratio, p[2] = {0, 1}, q[2] = {1, 0};
    for (int k = 0; k < 40; k++) {
        double whole = floor(rest), next_p = whole * p[1] + p[0], next_q = whole * q[1] + q[0];
        if (next_p > STILL || next_q > STILL) break;
        p[0] = p[1], p[1] = next_p;
        q[0] = q[1], q[1] = next_q;
        if (p[1] == ratio * q[1] || rest - whole < 1e-12) break;
        rest = 1 / (rest - whole);
    }
    double times = ceil((double)least / q[1]);
    *in = (size_t)(times * q[1]);
    *out = (size_t)(times * p[1]);
}

#define WEIGHED 85.0 /* predicted cycles of a sample that goes in or comes out */

bool resample(struct arena *a, const double *x, size_t n, double rate_in, double rate_out, double **y, size_t *m,
              struct err *e)
{
    const double rates[2] = {rate_in, rate_out}, ratio = rate_out / rate_in, low = fmin(rate_in, rate_out);
    if (!(ratio >= 1e-3 && ratio <= 1e3))
        return err_set(
            e, ERR_SCENE,
            "resampling from %g to %g Hz: rates may differ by a factor of 1000 at most; give another sample rate",
            rate_in, rate_out);
    *m = (size_t)ceil((double)n * rate_out / rate_in);
    *y = ARENA_TAKE(a, double, *m + 1);
    if (rate_in == rate_out) {
        memcpy(*y, x, n * sizeof *x);
        return true;
    }
    /* x behind silence; what comes out before it is folded into y */
    size_t leads = (size_t)ceil(REACH * rate_out / low), still, before;
    even_times(rates, (size_t)ceil(REACH * rate_in / low) + 1, &still, &before);
    struct arena *scratch = arena_open();
    double *late = ARENA_TAKE(scratch, double, still + n), *out = ARENA_TAKE(scratch, double, before + *m);
    double *lead = ARENA_TAKE(scratch, double, leads);
    memcpy(late + still, x, n * sizeof *x);
    stopwatch_spend(WEIGHED * (double)(still + n + before + *m));
    bool ok = convert_alone(late, still + n, rates, out, before + *m, e);
    memcpy(*y, out + before, *m * sizeof *out);
    for (size_t k = 1; k <= leads; k++)
        lead[k - 1] = out[before - k];
    filter_fold_lead(lead, (long)leads, (long)ceil(rate_out / low));
    for (size_t k = 0; k < leads && k < *m; k++)
        (*y)[k] += lead[k];
    arena_close(scratch);
    return ok;
}
