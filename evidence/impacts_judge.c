/* What evidence/impacts.md holds against rasp without a line of rasp's: what a floored ARMA(1,1) process must give, and measures of forces and sounds.

     statistics DRAWS RHO DEPTH       of impacts_series draw: mean, variance, share at the floor and correlations at lags 1 to 5 of amplitudes and intervals, each as: predicted
                                      (difference over its standard error). Predicted of prototype roll, S = V = 0.5: DEPTH 0 from the Gaussian law censored at its floor, means and
                                      shares closed, correlations by quadrature of the bivariate law; else the amplitudes' correlations by 1e7 impacts of a recursion with GSL's
                                      generator. Standard errors from the scatter of batches of 1e4 impacts. On the standard error: the largest such number
     bands FILE                       third octaves from 100 Hz: Hz, dB of the force's power
     compare FILE FILE                the same force at two rates, below 9 kHz: largest difference between their third octaves, dB; largest of the difference's power over the power, dB
     white FILE INTERVAL DURATION DEVIATION [1]   third octaves against 2 deviation^2 / interval |Phi|^2: largest difference, dB, rms over its statistical error, number of bands;
                                      with 1 the bands: Hz, dB, dB of the law
     exact FILE LISTING               the force's transform against the sum of its listing's raised cosines, in closed form, at 40 frequencies: largest difference over the rms
     moments FILE                     rms, centroid of the power (Hz, from 20 Hz on), excess kurtosis, peak over rms
     bend FILE PIECES                 largest second difference in each piece
     click FILE AT SIZE TO            the sound with a step of SIZE at AT s
     modulation FILE FILE             rate and depth of 1 + m sin(2 pi nu t + phase) in the ratio of their rms over 10 ms, by least squares
     image FILE                       s, Hz, dB in sixths of octaves every 50 ms
     samples FILE TO                  s, sample, up to TO s
     hertz                            ticks a second of the processor's counter, in millions

   WAVs of doubles. Spectra by Welch: Hann windows of 0.1 s, every 33 ms. */
#include <complex.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <x86intrin.h>

#include <fftw3.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <sndfile.h>

static void die(const char *what)
{
    fprintf(stderr, "impacts_judge: %s\n", what);
    exit(1);
}

/* ------------------------------------------------------------------ the floored process */

enum { BATCH = 10000, LAGS = 5, RESULTS = 3 + LAGS, KNOWN = 1000 };
static const double rate_of_modulation = 3, least_interval = 22.6757e-6;

struct process {
    double mean, deviation, a1, b1, least; /* of the white process: deviation */
    double spread;                         /* of the series, stationary       */
};

/* papers/002 table I. */
static void processes(double rho, struct process p[2])
{
    static const double table[2][2][4] = {{{0.43, 0.04, -0.97, 0.07}, {0.27, 0.04, -0.93, 0.32}}, {{3.1e-3, 0.19e-3, -0.97, -0.34}, {6.4e-3, 0.85e-3, -0.93, 0.35}}};
    for (int k = 0; k < 2; k++) {
        double v[4];
        for (int i = 0; i < 4; i++)
            v[i] = table[k][0][i] + rho * (table[k][1][i] - table[k][0][i]);
        p[k] = (struct process){v[0], v[1], v[2], v[3], k ? least_interval : 0.01 * v[0], v[1] * sqrt((1 + v[3] * v[3] - 2 * v[2] * v[3]) / (1 - v[2] * v[2]))};
    }
}

/* E max(N(m, s^2), f) and E max(N, f)^2. */
static double censored_mean(double m, double s, double f)
{
    double z = (m - f) / s;
    return f + (m - f) * gsl_cdf_ugaussian_P(z) + s * gsl_ran_ugaussian_pdf(z);
}
static double censored_square(double m, double s, double f)
{
    double z = (m - f) / s;
    return f * f * gsl_cdf_ugaussian_Q(z) + (m * m + s * s) * gsl_cdf_ugaussian_P(z) + s * (m + f) * gsl_ran_ugaussian_pdf(z);
}

struct pair {
    const struct process *p;
    double r;
};
static double pair_product(double z, void *of)
{
    const struct pair *q = of;
    const struct process *p = q->p;
    return gsl_ran_ugaussian_pdf(z) * fmax(p->mean + p->spread * z, p->least) * censored_mean(p->mean + p->spread * q->r * z, p->spread * sqrt(1 - q->r * q->r), p->least);
}

static void predict(const struct process *p, double depth, double out[RESULTS])
{
    gsl_integration_workspace *w = gsl_integration_workspace_alloc(1000);
    double mean = censored_mean(p->mean, p->spread, p->least), square = censored_square(p->mean, p->spread, p->least), edge = (p->least - p->mean) / p->spread, error, part[2];
    double r = (1 - p->a1 * p->b1) * (p->b1 - p->a1) / (1 + p->b1 * p->b1 - 2 * p->a1 * p->b1);
    out[0] = mean;
    out[1] = square * (1 + 0.5 * depth * depth) - mean * mean;
    out[2] = gsl_cdf_ugaussian_P(edge);
    for (int k = 0; k < LAGS; k++, r *= -p->a1) {
        struct pair q = {p, r};
        gsl_function f = {pair_product, &q};
        gsl_integration_qags(&f, -9, edge, 0, 1e-9, 1000, w, &part[0], &error);
        gsl_integration_qags(&f, edge, 9, 0, 1e-9, 1000, w, &part[1], &error);
        out[3 + k] = (part[0] + part[1] - mean * mean) / (square - mean * mean);
    }
    gsl_integration_workspace_free(w);
}

/* ------------------------------------------------------------------ batches */

struct batches {
    double sum[KNOWN][RESULTS]; /* means over a batch: x, x^2, floored, x x_k; x about the predicted mean */
    double past[LAGS];
    long n;
};

static void batches_add(struct batches *b, double x, bool floored)
{
    double *s = b->sum[b->n / BATCH];
    if (b->n / BATCH >= KNOWN)
        die("too many impacts");
    s[0] += x / BATCH;
    s[1] += x * x / BATCH;
    s[2] += (floored ? 1.0 : 0) / BATCH;
    for (int k = 0; k < LAGS; k++)
        s[3 + k] += (b->n > k) ? x * b->past[k] / BATCH : 0;
    memmove(&b->past[1], b->past, (LAGS - 1) * sizeof *b->past);
    b->past[0] = x;
    b->n++;
}

static void batches_end(const struct batches *b, double value[RESULTS], double error[RESULTS])
{
    long n = b->n / BATCH;
    for (int i = 0; i < RESULTS; i++) {
        double mean = 0, square = 0, power = 0, residual = 0;
        for (long k = 0; k < n; k++) {
            mean += b->sum[k][i] / n;
            power += b->sum[k][1] / n;
        }
        value[i] = i < 3 ? mean : mean / power;
        for (long k = 0; k < n; k++) {
            residual = i < 3 ? b->sum[k][i] - mean : (b->sum[k][i] - value[i] * b->sum[k][1]) / power;
            square += residual * residual;
        }
        error[i] = sqrt(square / (n - 1) / n);
    }
}

/* 1e7 impacts: ten runs, each warmed up. */
static void simulate(const struct process p[2], double depth, double mean, struct batches *b)
{
    gsl_rng *g = gsl_rng_alloc(gsl_rng_mt19937);
    for (unsigned long run = 1; run <= 10; run++) {
        double x[2] = {0}, e[2] = {0}, v[2], phase;
        gsl_rng_set(g, run);
        phase = gsl_rng_uniform(g);
        for (long n = -4000; n < 1000000; n++) {
            double w = gsl_ran_gaussian_ziggurat(g, 1);
            for (int k = 0; k < 2; k++) {
                x[k] = -p[k].a1 * x[k] + p[k].deviation * (w + p[k].b1 * e[k]);
                e[k] = w;
                v[k] = fmax(p[k].mean + x[k], p[k].least);
            }
            if (n >= 0)
                batches_add(b, v[0] * (1 + depth * sin(2 * M_PI * phase)) - mean, false);
            phase = fmod(phase + rate_of_modulation * v[1], 1);
        }
    }
    gsl_rng_free(g);
}

static double row_print(const double known[RESULTS], const double slack[RESULTS], const struct batches *b, double unit)
{
    double value[RESULTS], error[RESULTS], most = 0;
    batches_end(b, value, error);
    value[0] += known[0];
    for (int i = 0; i < RESULTS; i++) {
        double scale = i == 0 ? unit : i == 1 ? unit * unit : i == 2 ? 100 : 1, off = value[i] - known[i], z = error[i] > 0 ? off / hypot(error[i], slack[i]) : 0;
        printf(i == 2 ? " %.4f (%+.1f) |" : " %.5g (%+.1f) |", scale * known[i], z);
        most = fmax(most, fabs(z));
    }
    putchar('\n');
    return most;
}

static void statistics(const char *file, double rho, double depth)
{
    struct process p[2];
    struct batches *b = calloc(3, sizeof *b);
    FILE *f = fopen(file, "rb");
    double known[2][RESULTS], slack[RESULTS] = {0}, scratch[RESULTS], row[3], most = 0;
    if (!f || !b)
        die(file);
    processes(rho, p);
    for (int k = 0; k < 2; k++)
        predict(&p[k], k ? 0 : depth, known[k]);
    while (fread(row, sizeof row, 1, f) == 1)
        for (int k = 0; k < 2; k++)
            batches_add(&b[k], row[k] - known[k][0], (int)row[2] >> k & 1);
    if (depth > 0) {
        simulate(p, depth, known[0][0], &b[2]);
        batches_end(&b[2], scratch, slack);
        memcpy(&known[0][3], &scratch[3], LAGS * sizeof *scratch);
        memset(slack, 0, 3 * sizeof *slack);
    }
    for (int k = 0; k < (depth > 0 ? 1 : 2); k++) {
        printf("| %g | %g | %s |", rho, depth, k ? "dT (ms)" : "A");
        most = fmax(most, row_print(known[k], slack, &b[k], k ? 1e3 : 1));
    }
    fprintf(stderr, "%.2f\n", most);
    fclose(f);
    free(b);
}

/* ------------------------------------------------------------------ sounds */

struct sound {
    long n;
    double rate, *x;
};

static struct sound sound_read(const char *file)
{
    SF_INFO info = {0};
    SNDFILE *f = sf_open(file, SFM_READ, &info);
    if (!f || info.channels != 1)
        die(file);
    struct sound s = {info.frames, info.samplerate, malloc(info.frames * sizeof(double))};
    if (!s.x || sf_readf_double(f, s.x, s.n) != s.n)
        die(file);
    sf_close(f);
    return s;
}

/* Calls `take` with the transform of each window; bins are 10 Hz apart, the unit is that of x times s. */
static void sound_windows(const struct sound *s, const struct sound *other, long hop, void (*take)(const fftw_complex *, const fftw_complex *, double, void *), void *of)
{
    long n = lrint(0.1 * s->rate), m = other ? lrint(0.1 * other->rate) : 0;
    double *in = fftw_alloc_real(n), *in2 = fftw_alloc_real(m + 1);
    fftw_complex *out = fftw_alloc_complex(n / 2 + 1), *out2 = fftw_alloc_complex(m / 2 + 1);
    fftw_plan plan = fftw_plan_dft_r2c_1d(n, in, out, FFTW_ESTIMATE), plan2 = fftw_plan_dft_r2c_1d(m + 1 - (m > 0), in2, out2, FFTW_ESTIMATE);
    for (long k = 0; k * n / hop + n <= s->n && (!other || k * m / hop + m <= other->n); k++) {
        for (long i = 0; i < n; i++)
            in[i] = s->x[k * n / hop + i] * (0.5 - 0.5 * cos(2 * M_PI * i / n)) / s->rate;
        for (long i = 0; i < m; i++)
            in2[i] = other->x[k * m / hop + i] * (0.5 - 0.5 * cos(2 * M_PI * i / m)) / other->rate;
        fftw_execute(plan);
        if (other)
            fftw_execute(plan2);
        take(out, out2, (double)k / hop / 10, of);
    }
    fftw_destroy_plan(plan);
    fftw_destroy_plan(plan2);
    fftw_free(in);
    fftw_free(in2);
    fftw_free(out);
    fftw_free(out2);
}

enum { BINS = 10000 };          /* of 10 Hz */
struct power {
    double one[BINS], two[BINS], apart[BINS];
    double rate;                /* the lower one: beyond half of it nothing counts */
    bool both;
    long n;
};

static void power_take(const fftw_complex *a, const fftw_complex *b, double t, void *of)
{
    struct power *p = of;
    (void)t;
    p->n++;
    for (int i = 0; i < BINS && i * 10 <= p->rate / 2; i++) {
        p->one[i] += creal(a[i] * conj(a[i]));
        if (p->both) {
            p->two[i] += creal(b[i] * conj(b[i]));
            p->apart[i] += creal((a[i] - b[i]) * conj(a[i] - b[i]));
        }
    }
}

static struct power *power_of(const struct sound *s, const struct sound *other)
{
    struct power *p = calloc(1, sizeof *p);
    if (!p)
        die("no memory");
    p->rate = other ? fmin(s->rate, other->rate) : s->rate;
    p->both = other != NULL;
    sound_windows(s, other, 3, power_take, p);
    return p;
}

/* Bins of third octave k after that of 100 Hz. False: it goes beyond `end`. */
static bool band_bins(int k, double end, int *from, int *to)
{
    *from = (int)ceil(10 * pow(10, 0.1 * (k - 0.5)));
    *to = (int)ceil(10 * pow(10, 0.1 * (k + 0.5)));
    return 10 * (*to - 1) <= end;
}

static double band_sum(const double *x, int from, int to)
{
    double sum = 0;
    for (int i = from; i < to; i++)
        sum += x[i];
    return sum;
}

static double decibel(double power) { return 10 * log10(power); }

static void bands(const char *file)
{
    struct sound s = sound_read(file);
    struct power *p = power_of(&s, NULL);
    for (int k = 0, from, to; band_bins(k, 0.45 * s.rate, &from, &to); k++)
        printf("%.0f %.3f\n", 100 * pow(10, 0.1 * k), decibel(band_sum(p->one, from, to) / p->n * 10 / (0.0375)));
    free(p);
    free(s.x);
}

static void compare(const char *one, const char *two)
{
    struct sound s = sound_read(one), t = sound_read(two);
    struct power *p = power_of(&s, &t);
    double level = 0, apart = 0;
    for (int k = 0, from, to; band_bins(k, 9000, &from, &to); k++) {
        double here = band_sum(p->one, from, to);
        level = fmax(level, fabs(decibel(band_sum(p->two, from, to) / here)));
        apart = fmax(apart, band_sum(p->apart, from, to) / here);
    }
    printf("%.1e %.0f\n", level, decibel(apart));
    free(p);
    free(s.x);
    free(t.x);
}

/* Transform of a raised cosine of area 1. */
static double cosine_transform(double f, double duration)
{
    double q = f * duration;
    if (fabs(q) < 1e-9)
        return 1;
    if (fabs(q - 1) < 1e-6)
        return 0.5;
    return sin(M_PI * q) / (M_PI * q * (1 - q * q));
}

static void white(const char *file, double interval, double duration, double deviation, bool list)
{
    struct sound s = sound_read(file);
    struct power *p = power_of(&s, NULL);
    double most = 0, square = 0;
    int n = 0;
    for (int k = 0, from, to; band_bins(k, 0.45 * s.rate, &from, &to); k++, n++) {
        double is = band_sum(p->one, from, to) / p->n, must = 0, off;
        for (int i = from; i < to; i++)
            must += pow(0.5 * duration * cosine_transform(10.0 * i, duration) * deviation, 2) / interval * 0.0375;
        off = decibel(is / must);
        most = fmax(most, fabs(off));
        square += pow(off * log(10) / 10, 2) / (1 / (s.n / s.rate * 10 * (to - from)) + 3 * interval / (s.n / s.rate)); /* Gaussian noise; shots */
        if (list)
            printf("%.0f %.3f %.3f\n", 100 * pow(10, 0.1 * k), decibel(2 * is / 0.0375 / (to - from)), decibel(2 * must / 0.0375 / (to - from)));
    }
    if (!list)
        printf("%.2f %.2f %d\n", most, sqrt(square / n), n);
    free(p);
    free(s.x);
}

/* ------------------------------------------------------------------ the sum itself */

struct listing {
    long n, room;
    double (*row)[4];           /* s, N, s, s, as in the file */
};

static void listing_read(const char *file, struct listing *l)
{
    FILE *f = fopen(file, "r");
    char line[200];
    *l = (struct listing){0};
    while (f && fgets(line, sizeof line, f)) {
        if (l->n == l->room) {
            l->room = 2 * l->room + 1000;
            l->row = realloc(l->row, l->room * sizeof *l->row);
        }
        double *r = l->row[l->n];
        l->n += sscanf(line, "%lf,%lf,%lf,%lf", &r[0], &r[1], &r[2], &r[3]) == 4;
    }
    if (!f || fclose(f) || !l->n)
        die(file);
}

/* What of an impact that is under way at time 0 comes after it, by the midpoint rule. */
static double complex cut_transform(const double *r, double f)
{
    enum { PARTS = 10000 };
    double h = (r[0] + 0.5 * r[3]) / PARTS;
    double complex sum = 0;
    for (int i = 0; i < PARTS; i++) {
        double t = (i + 0.5) * h;
        sum += 0.5 * r[1] * (1 + cos(2 * M_PI * (t - r[0]) / r[3])) * cexp(-2 * M_PI * f * t * I) * h;
    }
    return sum;
}

static double complex listing_transform(const struct listing *l, double f)
{
    double complex sum = 0;
    for (long i = 0; i < l->n; i++) {
        const double *r = l->row[i];
        sum += r[0] < 0.5 * r[3] ? cut_transform(r, f) : 0.5 * r[1] * r[3] * cosine_transform(f, r[3]) * cexp(-2 * M_PI * f * r[0] * I);
    }
    return sum;
}

static void exact(const char *file, const char *listing)
{
    enum { TRIED = 40 };
    struct sound s = sound_read(file);
    struct listing l;
    double most = 0, power = 0;
    listing_read(listing, &l);
    for (int k = 0; k < TRIED; k++) {
        double f = 20 * pow(fmin(0.4 * s.rate, 18000) / 20, (k + 0.5) / TRIED);
        double complex is = 0, turn = cexp(-2 * M_PI * f / s.rate * I), at = 1, must = listing_transform(&l, f);
        for (long i = 0; i < s.n; i++, at = i % 1000 ? at * turn : cexp(-2 * M_PI * f * i / s.rate * I))
            is += s.x[i] * at / s.rate;
        most = fmax(most, cabs(is - must));
        power += creal(must * conj(must)) / TRIED;
    }
    printf("%.1e\n", most / sqrt(power));
    free(l.row);
    free(s.x);
}

/* ------------------------------------------------------------------ measures */

static void moments(const char *file)
{
    struct sound s = sound_read(file);
    struct power *p = power_of(&s, NULL);
    double sum[5] = {0}, most = 0, below = 0, above = 0;
    for (int i = 2; 10 * i <= 0.45 * s.rate; i++) {
        below += p->one[i];
        above += 10.0 * i * p->one[i];
    }
    for (long i = 0; i < s.n; i++)
        sum[1] += s.x[i] / s.n;
    for (long i = 0; i < s.n; i++) {
        double d = s.x[i] - sum[1];
        sum[2] += d * d / s.n;
        sum[4] += d * d * d * d / s.n;
        most = fmax(most, fabs(s.x[i]));
    }
    double rms = sqrt(sum[2] + sum[1] * sum[1]);
    printf("%.4g %.0f %.3g %.3g\n", rms, above / below, sum[4] / sum[2] / sum[2] - 3, most / rms);
    free(p);
    free(s.x);
}

static void bend(const char *file, int pieces)
{
    struct sound s = sound_read(file);
    for (int k = 0; k < pieces; k++) {
        double most = 0;
        for (long i = fmax(2, (double)k * s.n / pieces); i < (double)(k + 1) * s.n / pieces; i++)
            most = fmax(most, fabs(s.x[i] - 2 * s.x[i - 1] + s.x[i - 2]));
        printf("%.6g\n", most);
    }
    free(s.x);
}

static void click(const char *file, double at, double size, const char *to)
{
    struct sound s = sound_read(file);
    SF_INFO info = {.samplerate = (int)s.rate, .channels = 1, .format = SF_FORMAT_WAV | SF_FORMAT_DOUBLE};
    SNDFILE *f = sf_open(to, SFM_WRITE, &info);
    if (!f)
        die(to);
    for (long i = lrint(at * s.rate); i < s.n; i++)
        s.x[i] += size;
    sf_writef_double(f, s.x, s.n);
    sf_close(f);
    free(s.x);
}

/* Weighted least squares of y = c0 + c1 sin + c2 cos at one rate: what is left. */
static double sinusoid(const double *y, const double *weight, int n, double rate, double *depth)
{
    double m[3][4] = {{0}}, left = 0;
    for (int i = 0; i < n; i++) {
        double a = 2 * M_PI * rate * 0.01 * i, v[4] = {1, sin(a), cos(a), y[i]};
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 4; c++)
                m[r][c] += weight[i] * v[r] * v[c];
        left += weight[i] * y[i] * y[i];
    }
    double x[3] = {m[0][3], m[1][3], m[2][3]}, right[3] = {x[0], x[1], x[2]};
    for (int p = 0; p < 3; p++)
        for (int r = 0; r < 3; r++) {
            double share = m[r][p] / m[p][p];
            for (int c = 0; c < 3 && r != p; c++)
                m[r][c] -= share * m[p][c];
            x[r] -= r != p ? share * x[p] : 0;
        }
    for (int r = 0; r < 3; r++) {
        x[r] /= m[r][r];
        left -= x[r] * right[r];
    }
    *depth = hypot(x[1], x[2]) / x[0];
    return left;
}

static void modulation(const char *one, const char *two)
{
    struct sound s = sound_read(one), t = sound_read(two);
    long frame = lrint(0.01 * s.rate), n = (s.n < t.n ? s.n : t.n) / frame;
    double *y = calloc(n, sizeof *y), *weight = calloc(n, sizeof *y), least = HUGE_VAL, best = 0, depth = 0, depth_here;
    for (long k = 0; k < n; k++) {
        double a = 0, b = 0;
        for (long i = k * frame; i < (k + 1) * frame; i++) {
            a += s.x[i] * s.x[i];
            b += t.x[i] * t.x[i];
        }
        y[k] = b > 0 ? sqrt(a / b) : 0;
        weight[k] = b;
    }
    for (double rate = 0.1; rate < 40; rate += 0.005) {
        double left = sinusoid(y, weight, n, rate, &depth_here);
        if (left < least) {
            least = left;
            best = rate;
            depth = depth_here;
        }
    }
    printf("%.3f %.3f\n", best, depth);
    free(y);
    free(weight);
    free(s.x);
    free(t.x);
}

static void image_take(const fftw_complex *a, const fftw_complex *b, double t, void *of)
{
    double end = *(double *)of;
    (void)b;
    for (int k = 0; 100 * pow(2, (k + 0.5) / 6) < end; k++) {
        double sum = 0, width = 0;
        for (int i = (int)ceil(10 * pow(2, (k - 0.5) / 6)); i < 10 * pow(2, (k + 0.5) / 6); i++, width++)
            sum += creal(a[i] * conj(a[i]));
        printf("%.3f %.4f %.1f\n", t + 0.05, log10(100 * pow(2, k / 6.0)), decibel(sum / width + 1e-30));
    }
    putchar('\n');
}

static void samples(const char *file, double to)
{
    struct sound s = sound_read(file);
    for (long i = 0; i < to * s.rate; i++)
        printf("%.6f %.6g\n", i / s.rate, s.x[i]);
    free(s.x);
}

static void hertz(void)
{
    struct timespec from, to;
    unsigned long long ticks = __rdtsc();
    double s;
    clock_gettime(CLOCK_MONOTONIC, &from);
    do {
        clock_gettime(CLOCK_MONOTONIC, &to);
        s = (double)(to.tv_sec - from.tv_sec) + 1e-9 * (double)(to.tv_nsec - from.tv_nsec);
    } while (s < 0.2);
    printf("%.1f\n", (double)(__rdtsc() - ticks) / s / 1e6);
}

int main(int count, char **word)
{
    const char *what = count > 1 ? word[1] : "";
    if (count == 5 && strcmp(what, "statistics") == 0)
        statistics(word[2], atof(word[3]), atof(word[4]));
    else if (count == 3 && strcmp(what, "bands") == 0)
        bands(word[2]);
    else if (count == 4 && strcmp(what, "compare") == 0)
        compare(word[2], word[3]);
    else if (count >= 6 && strcmp(what, "white") == 0)
        white(word[2], atof(word[3]), atof(word[4]), atof(word[5]), count > 6);
    else if (count == 4 && strcmp(what, "exact") == 0)
        exact(word[2], word[3]);
    else if (count == 3 && strcmp(what, "moments") == 0)
        moments(word[2]);
    else if (count == 4 && strcmp(what, "bend") == 0)
        bend(word[2], atoi(word[3]));
    else if (count == 6 && strcmp(what, "click") == 0)
        click(word[2], atof(word[3]), atof(word[4]), word[5]);
    else if (count == 4 && strcmp(what, "modulation") == 0)
        modulation(word[2], word[3]);
    else if (count == 3 && strcmp(what, "image") == 0) {
        struct sound s = sound_read(word[2]);
        double end = 0.45 * s.rate;
        sound_windows(&s, NULL, 2, image_take, &end);
        free(s.x);
    } else if (count == 4 && strcmp(what, "samples") == 0)
        samples(word[2], atof(word[3]));
    else if (strcmp(what, "hertz") == 0)
        hertz();
    else
        return fputs("usage: see the head of impacts_judge.c\n", stderr), 64;
    return 0;
}
