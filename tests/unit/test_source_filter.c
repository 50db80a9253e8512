/* source_filter: recordings whose modes and impacts are known, made by the sum of the modes' closed forms. */
#include "analysis/source_filter.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "num/noise.h"
#include "rig.h"

#define RATE 32000.0

enum { MODES = 8, LENGTH = 128000, MOST = 2000 };

static const struct source_filter_options options = {
    .most = 40, .low = 40, .high = 14000, .fastest = 600, .rise = 6, .snr = NAN};

struct known {
    double frequency[MODES], decay[MODES], gain[MODES];
    int n;
    double time[MOST], size[MOST];
    double *x; /* [LENGTH] */
};

/* Impacts some `mean` s apart, half of it at least, of sizes 0.5 to 1.5; noise of that rms. */
static struct known *made(uint64_t seed, double mean, double noise)
{
    struct known *k = ARENA_TAKE(rig_arena(), struct known, 1);
    double u[2 * MOST], g[LENGTH], t = 0.02;
    k->x = ARENA_TAKE(rig_arena(), double, LENGTH);
    for (int i = 0; i < 2 * MOST; i++)
        u[i] = noise_uniform(noise_make(seed, "known"), 0, (uint64_t)i);
    for (int i = 0; i < MODES; i++) {
        k->frequency[i] = 300 * pow(1.55, i) * (1 + 0.2 * u[3 * i]);
        k->decay[i] = 15 + 40 * u[3 * i + 1];
        k->gain[i] = 0.3 + u[3 * i + 2];
    }
    for (int n = 0; t < LENGTH / RATE - 0.05; t += mean * (0.5 + u[40 + 2 * n]), k->n = ++n) {
        k->time[n] = t;
        k->size[n] = 0.5 + u[41 + 2 * n];
        for (int i = 0; i < MODES; i++) { /* the closed form every 256 samples, turned on between them: 1e-14 */
            double d = k->decay[i] / RATE, w = 2 * M_PI * k->frequency[i] / RATE, c = exp(-d) * cos(w),
                   sn = exp(-d) * sin(w), re = 0, im = 0;
            long first = (long)ceil(t * RATE);
            for (long s = first; s < LENGTH && (double)s / RATE - t < 0.6; s++) {
                double late = (double)s / RATE - t, next = c * re - sn * im;
                im = sn * re + c * im;
                re = next;
                if ((s - first) % 256 == 0) {
                    re = exp(-k->decay[i] * late) * cos(2 * M_PI * k->frequency[i] * late);
                    im = exp(-k->decay[i] * late) * sin(2 * M_PI * k->frequency[i] * late);
                }
                k->x[s] += k->size[n] * k->gain[i] * im;
            }
        }
    }
    noise_normal(noise_make(seed, "noise"), 0, LENGTH, g);
    for (long s = 0; s < LENGTH; s++)
        k->x[s] += noise * g[s];
    return k;
}

static struct source_filter found(const struct known *k, const struct source_filter_options *o, int m,
                                  const struct source_filter_mode *mode)
{
    struct source_filter f;
    struct err e = {0};
    ck_assert_msg(source_filter_find(k->x, LENGTH, RATE, o, m, mode, rig_arena(), &f, &e), "%s", e.text);
    return f;
}

/* Modes of the truth that one of those found is within 1 Hz and 10 % of. */
static int modes_found(const struct known *k, const struct source_filter *f, double hertz)
{
    int n = 0;
    for (int i = 0; i < MODES; i++) {
        bool one = false;
        for (int j = 0; j < f->m; j++)
            one = one || (fabs(f->mode[j].frequency - k->frequency[i]) < hertz &&
                          fabs(f->mode[j].decay / k->decay[i] - 1) < 0.1);
        n += one;
    }
    return n;
}

/* Share of the impacts that have one within 1 ms, but for a delay that all have; *extra: of those found that are none;
   *ratio: mean of the found sizes over the mean of the true ones; *scatter: of their ratios, over the mean. */
static double impacts_found(const struct known *k, const struct impact_events *v, double *extra, double *scatter)
{
    double best = -1, sum = 0, square = 0;
    int hits = 0;
    for (double late = -1.5e-3; late < 1.5e-3; late += 0.1e-3) {
        double s = 0, q = 0;
        int n = 0;
        for (int i = 0; i < k->n; i++) {
            int near = 0;
            for (int j = 1; j < v->n; j++)
                near = fabs(v->time[j] - late - k->time[i]) < fabs(v->time[near] - late - k->time[i]) ? j : near;
            if (v->n == 0 || fabs(v->time[near] - late - k->time[i]) > 0.5e-3) continue;
            s += v->amplitude[near] / k->size[i];
            q += v->amplitude[near] / k->size[i] * v->amplitude[near] / k->size[i];
            n++;
        }
        if (n <= best) continue;
        best = hits = n;
        sum = s;
        square = q;
    }
    *extra = v->n > 0 ? (double)(v->n - hits) / v->n : 0;
    *scatter = hits > 1 ? sqrt(fmax(square / hits - sum / hits * (sum / hits), 0)) / (sum / hits) : 1;
    return (double)hits / k->n;
}

/* 25 and 120 impacts a second in three noises (each noise once only, unless LONG): all modes within 1 Hz and 10 %, in the
   loudest but one, 95 % of the impacts, sizes within 10 % of each other's. */
START_TEST(taken_apart)
{
    static const double means[] = {40e-3, 8e-3}, noises[] = {1e-3, 1e-2, 0.1};
    const char *all = getenv("LONG");
    for (int c = 0; c < (getenv("SANITIZED") ? 1 : 6); c++) { /* under sanitizers they take a minute each */
        if (!(all && *all) && c != 0 && c != 3 && c != 5) continue;
        struct known *k = made(11 + (uint64_t)c, means[c % 2], noises[c / 2]);
        struct source_filter f = found(k, &options, 0, NULL);
        double extra, scatter, share = impacts_found(k, &f.impacts, &extra, &scatter);
        printf("mean %g ms, noise %g: %d of %d modes, %.1f %% of %d impacts, %.1f %% more, sizes within %.1f %%, "
               "given back %.4f\n",
               1e3 * means[c % 2], noises[c / 2], modes_found(k, &f, 1), f.m, 100 * share, k->n, 100 * extra,
               100 * scatter, f.rings);
        fflush(stdout);
        ck_assert(!f.correlated);
        ck_assert_int_ge(modes_found(k, &f, 1), c < 4 ? MODES : MODES - 1);
        ck_assert_int_le(f.m, MODES + 2);
        ck_assert(share >= 0.95 && extra <= 0.05 && scatter < 0.1);
        ck_assert(f.struck > 0.8 && f.rings > 0.95);
    }
}
END_TEST

/* Modes that are given: the source alone, in their units. */
START_TEST(known_modes)
{
    static const double means[] = {15e-3, 8e-3};
    for (int c = 0; c < (getenv("SANITIZED") ? 1 : 2); c++) {
        struct known *k = made(21 + (uint64_t)c, means[c], c ? 1e-2 : 1e-3);
        struct source_filter_mode mode[MODES];
        for (int i = 0; i < MODES; i++)
            mode[i] = (struct source_filter_mode){
                .frequency = k->frequency[i], .decay = k->decay[i], .gain = {k->gain[i], 0}};
        struct source_filter f = found(k, &options, MODES, mode);
        double extra, scatter, share = impacts_found(k, &f.impacts, &extra, &scatter), mean = 0, true_mean = 0;
        for (int i = 0; i < f.impacts.n; i++)
            mean += f.impacts.amplitude[i] / f.impacts.n;
        for (int i = 0; i < k->n; i++)
            true_mean += k->size[i] / k->n;
        printf("mean %g ms: %.1f %% of %d impacts, %.1f %% more, mean %.4f of %.4f\n", 1e3 * means[c], 100 * share,
               k->n, 100 * extra, mean, true_mean);
        fflush(stdout);
        ck_assert(share >= 0.97 && extra <= 0.03);
        ck_assert_double_eq_tol(mean, true_mean, 0.05 * true_mean);
    }
}
END_TEST

/* One strike is one impact: what it leaves is in the response. */
START_TEST(one_strike)
{
    struct known *k = made(17, 10, 0);
    ck_assert_int_eq(k->n, 1);
    struct source_filter f = found(k, &options, 0, NULL);
    ck_assert_int_eq(f.impacts.n, 1);
    ck_assert_int_eq(f.m, MODES);
    ck_assert_int_eq(modes_found(k, &f, 0.01), MODES);
    ck_assert(isnan(f.reflected));
}
END_TEST

/* 330 impacts a second and one reflection, half as strong, 7.1 ms later: its delay is found. */
START_TEST(reflection)
{
    struct known *k = made(51, 3e-3, 1e-3);
    long late = (long)(7.1e-3 * RATE);
    for (long t = LENGTH - 1; t >= late; t--)
        k->x[t] += 0.5 * k->x[t - late];
    struct source_filter f = found(k, &options, 0, NULL);
    double extra, scatter, share = impacts_found(k, &f.impacts, &extra, &scatter);
    printf("reflection %.2f ms, %.2f; %d of %d modes, %.1f %% of %d impacts, %.1f %% more\n", 1e3 * f.reflected,
           f.reflection, modes_found(k, &f, 1), f.m, 100 * share, k->n, 100 * extra);
    fflush(stdout);
    ck_assert_double_eq_tol(f.reflected, 7.1e-3, 0.2e-3);
}
END_TEST

/* Each impact has gains of its own: frequencies within 1 Hz, and more of the recording than a third. */
START_TEST(own_gains)
{
    struct source_filter_options o = options;
    o.method = SOURCE_FILTER_LEE;
    struct known *k = made(31, 40e-3, 1e-3);
    struct source_filter f = found(k, &o, 0, NULL);
    int near = 0;
    for (int i = 0; i < MODES; i++)
        for (int j = 0; j < f.m; j++)
            if (fabs(f.mode[j].frequency - k->frequency[i]) < 1) {
                near++;
                break;
            }
    printf("%d of %d modes, %d impacts of %d, given back %.3f\n", near, f.m, f.places, k->n, f.rings);
    ck_assert_int_ge(near, MODES - 1);
    ck_assert_int_ge(f.places, k->n * 9 / 10);
    ck_assert(f.rings > 0.8);
}
END_TEST

/* Driven by noise without a pause: the autocorrelation's modes, within 5 Hz and without errors; impacts are little of
   the source. */
START_TEST(driven_by_noise)
{
    struct known *k = made(41, 1, 0);
    double *g = ARENA_TAKE(rig_arena(), double, LENGTH);
    noise_normal(noise_make(41, "force"), 0, LENGTH, g);
    memset(k->x, 0, LENGTH * sizeof *k->x);
    for (int i = 0; i < MODES; i++) {
        double re = 0, im = 0, c = exp(-k->decay[i] / RATE) * cos(2 * M_PI * k->frequency[i] / RATE),
               s = exp(-k->decay[i] / RATE) * sin(2 * M_PI * k->frequency[i] / RATE);
        for (long t = 0; t < LENGTH; t++) {
            double next = c * re - s * im + k->gain[i] * g[t];
            im = s * re + c * im;
            re = next;
            k->x[t] += im;
        }
    }
    struct source_filter f = found(k, &options, 0, NULL);
    int near = 0;
    for (int i = 0; i < MODES; i++)
        for (int j = 0; j < f.m; j++)
            if (fabs(f.mode[j].frequency - k->frequency[i]) < 5) {
                near++;
                break;
            }
    printf("%d modes of %d, %d near; impacts %.2f of the source\n", f.m, MODES, near, f.struck);
    ck_assert(f.correlated);
    ck_assert_int_ge(near, MODES - 2);
    ck_assert(isnan(f.mode[0].frequency_se));
    ck_assert(f.struck < 0.5);
}
END_TEST

/* What nothing can be said of. */
START_TEST(refused)
{
    struct err e = {0};
    struct source_filter f;
    struct source_filter_options lee = options;
    double *x = ARENA_TAKE(rig_arena(), double, LENGTH);
    lee.method = SOURCE_FILTER_LEE;
    noise_normal(noise_make(5, "white"), 0, LENGTH, x);
    ck_assert(!source_filter_find(x, LENGTH, RATE, &lee, 0, NULL, rig_arena(), &f, &e));
    ck_assert_int_eq(e.kind, ERR_SCENE);
}
END_TEST

UNIT("source_filter", taken_apart, known_modes, one_strike, UNIT_PLAIN(reflection), own_gains, driven_by_noise, refused)
