/* The judge of modes found in responses (src/analysis/ringing.h): 50 modes, 100 Hz to 12 kHz, 30 dB of levels, 1 s at 44.1 kHz, T60 0.2 to 1.3 s, five pairs 1, 2, 5, 3 and
   10 Hz apart, in white noise; SNR = rms of the first 0.1 s over the noise's. The Cramer-Rao bound is had from the derivatives of every sample
   (tests/unit/ringing_series.h).

     ringing_judge table SEEDS      rows of a table: every level of noise, both methods, with and without second slopes
     ringing_judge missed SEEDS     rows of modes that the bound lets one tell and that were not found
     ringing_judge nothing SEEDS    white noise alone, and noise of one pole: how often something is found
     ringing_judge exact            the 50 modes without noise
     ringing_judge slopes SEEDS     one frequency of two decays: how often both are found
     ringing_judge places SEEDS     one, two and four places: errors against one place's
     ringing_judge many             1000 modes in ten bands, 10 Hz apart
     ringing_judge picture NAME     NAME.spectrum, NAME.modes, NAME.errors, for gnuplot */
#include <stdbool.h>
#include <stdio.h>
#include <time.h>

#include "analysis/ringing.h"
#include "numbers.h"
#include "ringing_series.h"

extern void openblas_set_num_threads(int n);

#define RATE 44100.0
#define TELLS 6.0 /* of a gain over its bound, and of the nearest mode's distance over the frequency's: what can be told from its neighbour and from noise */

enum { LENGTH = 44100, SEEDS_MOST = 100 };

typedef bool method(const struct ringing *, const struct ringing_options *, struct arena *, struct ringing_modes *, struct err *);

struct way {
    method *find;
    bool slopes;
    const char *name;
};

enum { WAYS = 3 };
static const struct way ways[WAYS] = {{ringing_esprit, false, "sub-band ESPRIT"}, {ringing_esprit, true, "the same, --slopes"}, {ringing_spectrogram, false, "spectrogram"}};

struct row {
    int n, found, tell, told, far, far_found, extra, ratios;
    double df[SERIES_MODES * SEEDS_MOST], dd[SERIES_MODES * SEEDS_MOST], frequency, decay, cpu;
    int inside, intervals;
};

static double cpu_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int rising(const void *x, const void *y)
{
    double a = *(const double *)x, b = *(const double *)y;
    return (a > b) - (a < b);
}

/* Hz from the nearest other. */
static double nearest_hertz(const struct truth *m, int i)
{
    double least = HUGE_VAL;
    for (int k = 0; k < SERIES_MODES; k++)
        if (k != i)
            least = fmin(least, fabs(m[k].frequency - m[i].frequency));
    return least;
}

static void row_add(struct row *r, const struct truth *m, const struct ringing_modes *found)
{
    double frequency[4 * SERIES_MODES];
    int of[SERIES_MODES], n = found->n < 4 * SERIES_MODES ? found->n : 4 * SERIES_MODES, all;
    for (int i = 0; i < n; i++)
        frequency[i] = found->mode[i].frequency;
    all = series_match(m, SERIES_MODES, frequency, n, 3, of);
    r->found += all;
    r->extra += found->n - all;
    for (int i = 0; i < SERIES_MODES; i++) {
        bool tells = m[i].gain > TELLS * m[i].bound_gain;
        r->tell += tells;
        r->told += tells && of[i] >= 0;
        bool far = tells && nearest_hertz(m, i) > TELLS * m[i].bound_frequency;
        r->far += far;
        r->far_found += far && of[i] >= 0;
        if (of[i] < 0)
            continue;
        const struct ringing_mode *k = &found->mode[of[i]];
        double df = fabs(k->frequency - m[i].frequency), dd = fabs(k->decay - m[i].decay);
        r->df[r->n] = df;
        r->dd[r->n++] = dd / m[i].decay;
        r->intervals += 2;
        r->inside += (df < 1.96 * k->frequency_error) + (dd < 1.96 * k->decay_error);
        if (!tells)
            continue;
        r->frequency += df * df / (m[i].bound_frequency * m[i].bound_frequency);
        r->decay += dd * dd / (m[i].bound_decay * m[i].bound_decay);
        r->ratios++;
    }
}

static void row_print(struct row *r, const char *name, double decibel, int seeds)
{
    qsort(r->df, (size_t)r->n, sizeof *r->df, rising);
    qsort(r->dd, (size_t)r->n, sizeof *r->dd, rising);
    printf("| %g | %s | %.1f of %d | %.1f of %.1f | %.1f of %.1f | %.1f | %.4f | %.3f (%.2f) | %.2f, %.2f | %.1f | %.2f |\n", decibel, name, (double)r->found / seeds, SERIES_MODES,
           (double)r->told / seeds, (double)r->tell / seeds, (double)r->far_found / seeds, (double)r->far / seeds, (double)r->extra / seeds, r->n ? r->df[r->n / 2] : 0, r->n ? 100 * r->dd[r->n / 2] : 0,
           r->n ? 100 * r->dd[r->n * 9 / 10] : 0, sqrt(r->frequency / fmax(r->ratios, 1)), sqrt(r->decay / fmax(r->ratios, 1)),
           100.0 * r->inside / fmax(r->intervals, 1), r->cpu / seeds);
}

struct series {
    struct truth m[SERIES_MODES];
    double h[LENGTH];
};

/* 50 modes in noise, with their bounds. */
static void series_make(int seed, double decibel, struct series *s)
{
    gsl_rng *g = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(g, (unsigned long)seed);
    series_fifty(g, s->m);
    series_sum(s->m, SERIES_MODES, RATE, LENGTH, s->h);
    double deviation = series_deviation(s->h, RATE, decibel);
    series_bound(s->m, SERIES_MODES, RATE, LENGTH, deviation);
    series_noise(g, deviation, LENGTH, s->h);
    gsl_rng_free(g);
}

static void found_make(const struct way *w, const struct series *s, struct arena *a, struct ringing_modes *found)
{
    struct ringing_options o = ringing_options;
    struct err e = {0};
    o.most = 200;
    o.slope_test = w->slopes ? o.slope_test : 0;
    if (!w->find(&(struct ringing){.places = 1, .n = LENGTH, .rate = RATE, .h = (const double *const[]){s->h}}, &o, a, found, &e)) {
        fprintf(stderr, "ringing_judge: %s\n", e.text);
        exit(1);
    }
}

static void run(const struct way *w, double decibel, int seeds)
{
    static struct row r;
    static struct series s;
    r = (struct row){0};
    for (int seed = 1; seed <= seeds; seed++) {
        struct arena *a = arena_open();
        struct ringing_modes found;
        series_make(seed, decibel, &s);
        double before = cpu_now();
        found_make(w, &s, a, &found);
        r.cpu += cpu_now() - before;
        row_add(&r, s.m, &found);
        arena_close(a);
    }
    row_print(&r, w->name, decibel, seeds);
}

/* Of one response: what was not found, and the components that stand where it and its neighbour are. */
static void missed_print(const struct series *s, const struct way *w, int seed)
{
    struct arena *a = arena_open();
    struct ringing_modes found;
    double frequency[4 * SERIES_MODES];
    int of[SERIES_MODES];
    found_make(w, s, a, &found);
    int n = found.n < 4 * SERIES_MODES ? found.n : 4 * SERIES_MODES;
    for (int i = 0; i < n; i++)
        frequency[i] = found.mode[i].frequency;
    series_match(s->m, SERIES_MODES, frequency, n, 3, of);
    for (int i = 0; i < SERIES_MODES; i++) {
        const struct truth *m = &s->m[i];
        double apart = nearest_hertz(s->m, i);
        if (of[i] >= 0 || !(m->gain > TELLS * m->bound_gain))
            continue;
        printf("| %d | %s | %.2f | %.1f | %.2f | %.1f |", seed, w->name, m->frequency, m->gain / m->bound_gain, apart, apart / m->bound_frequency);
        const char *join = "";
        for (int k = 0; k < n; k++)
            if (fabs(frequency[k] - m->frequency) < 2 * apart) {
                printf("%s %.2f Hz, %.1f 1/s", join, frequency[k], found.mode[k].decay);
                join = ";";
            }
        printf(" |\n");
    }
    arena_close(a);
}

static void missed(int seeds)
{
    static struct series s;
    for (int k = 0; k < 2; k++)
        for (int seed = 1; seed <= seeds; seed++) {
            series_make(seed, 40, &s);
            missed_print(&s, &ways[k], seed);
        }
}

static void find_all(const struct ringing *r, int most, struct arena *a, struct ringing_modes *found)
{
    struct ringing_options o = ringing_options;
    struct err e = {0};
    o.most = most;
    if (!ringing_esprit(r, &o, a, found, &e)) {
        fprintf(stderr, "ringing_judge: %s\n", e.text);
        exit(1);
    }
}

static gsl_rng *generator(int seed)
{
    gsl_rng *g = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(g, (unsigned long)seed);
    return g;
}

static const struct ringing_mode *nearest(const struct ringing_modes *m, double frequency)
{
    const struct ringing_mode *best = &m->mode[0];
    for (int i = 1; i < m->n; i++)
        if (fabs(m->mode[i].frequency - frequency) < fabs(best->frequency - frequency))
            best = &m->mode[i];
    return best;
}

static void table(int seeds)
{
    const double decibels[] = {60, 40, 20};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < WAYS; k++)
            run(&ways[k], decibels[i], seeds);
}

static void nothing(int seeds)
{
    enum { N = 4000 };
    static double h[N];
    for (int coloured = 0; coloured < 2; coloured++) {
        int any = 0, modes = 0;
        for (int seed = 1; seed <= seeds; seed++) {
            struct arena *a = arena_open();
            struct ringing_modes found;
            gsl_rng *g = generator(seed);
            memset(h, 0, sizeof h);
            series_noise(g, 1, N, h);
            for (int i = 1; coloured && i < N; i++)
                h[i] += 0.9 * h[i - 1];
            find_all(&(struct ringing){.places = 1, .n = N, .rate = RATE, .h = (const double *const[]){h}}, 200, a, &found);
            any += found.n > 0;
            modes += found.n;
            gsl_rng_free(g);
            arena_close(a);
        }
        printf("| %s | %d | %d | %d |\n", coloured ? "one pole at 0.9" : "white", seeds, any, modes);
    }
}

static void exact(void)
{
    static double h[LENGTH];
    struct truth m[SERIES_MODES];
    struct arena *a = arena_open();
    struct ringing_modes found;
    gsl_rng *g = generator(1);
    double worst[3] = {0};
    series_fifty(g, m);
    series_sum(m, SERIES_MODES, RATE, LENGTH, h);
    find_all(&(struct ringing){.places = 1, .n = LENGTH, .rate = RATE, .h = (const double *const[]){h}}, 200, a, &found);
    for (int i = 0; i < SERIES_MODES && found.n > 0; i++) {
        const struct ringing_mode *k = nearest(&found, m[i].frequency);
        worst[0] = fmax(worst[0], fabs(k->frequency - m[i].frequency));
        worst[1] = fmax(worst[1], fabs(k->decay / m[i].decay - 1));
        worst[2] = fmax(worst[2], fabs(hypot(k->re[0], k->im[0]) / m[i].gain - 1));
    }
    printf("| %d of %d | %.1e | %.1e | %.1e |\n", found.n, SERIES_MODES, worst[0], worst[1], worst[2]);
    gsl_rng_free(g);
    arena_close(a);
}

/* 1000 Hz, 40/s and 5/s, the second weaker by so many dB, noise 60 dB below the first's peak; and the first alone. */
static void slopes(int seeds)
{
    const double below[] = {10, 20, 30, 1000};
    static double h[LENGTH];
    for (int b = 0; b < 4; b++) {
        int two = 0;
        double squares = 0;
        for (int seed = 1; seed <= seeds; seed++) {
            const struct truth m[] = {{.frequency = 1000, .decay = 40, .gain = 1, .phase = 0.3}, {.frequency = 1000, .decay = 5, .gain = pow(10, -below[b] / 20), .phase = 1}};
            struct arena *a = arena_open();
            struct ringing_modes found;
            gsl_rng *g = generator(seed);
            series_sum(m, 2, RATE, LENGTH, h);
            series_noise(g, 1e-3, LENGTH, h);
            find_all(&(struct ringing){.places = 1, .n = LENGTH, .rate = RATE, .h = (const double *const[]){h}}, 200, a, &found);
            bool both = found.n == 2 && found.modes == 1;
            two += both;
            for (int i = 0; both && i < 2; i++) {
                double z = (found.mode[i].decay - (found.mode[i].decay > 14 ? 40 : 5)) / found.mode[i].decay_error;
                squares += z * z / 2;
            }
            gsl_rng_free(g);
            arena_close(a);
        }
        if (below[b] > 100)
            printf("| none | %d of %d | |\n", two, seeds);
        else
            printf("| %g dB weaker | %d of %d | %.2f |\n", below[b], two, seeds, sqrt(squares / fmax(two, 1)));
    }
}

/* Three modes, 500, 507 and 4000 Hz, gains drawn anew at every place. */
static void places(int seeds)
{
    enum { N = 20000, MOST = 4, COUNT = 3 };
    const double frequency[COUNT] = {500, 507, 4000}, decay[COUNT] = {20, 30, 50};
    static double h[MOST][N];
    for (int n = 1; n <= MOST; n *= 2) {
        double df = 0, dd = 0, z = 0;
        int found_all = 0, count = 0;
        for (int seed = 1; seed <= seeds; seed++) {
            struct arena *a = arena_open();
            struct ringing_modes found;
            gsl_rng *g = generator(seed);
            for (int p = 0; p < n; p++) {
                struct truth m[COUNT];
                for (int i = 0; i < COUNT; i++)
                    m[i] = (struct truth){.frequency = frequency[i], .decay = decay[i], .gain = 0.3 + 0.7 * gsl_rng_uniform(g), .phase = 6 * gsl_rng_uniform(g)};
                series_sum(m, COUNT, RATE, N, h[p]);
                series_noise(g, 0.01, N, h[p]);
            }
            find_all(&(struct ringing){.places = n, .n = N, .rate = RATE, .h = (const double *const[]){h[0], h[1], h[2], h[3]}}, 200, a, &found);
            found_all += found.n == COUNT;
            for (int i = 0; i < COUNT && found.n == COUNT; i++, count++) {
                const struct ringing_mode *k = nearest(&found, frequency[i]);
                df += pow(k->frequency - frequency[i], 2);
                dd += pow(k->decay / decay[i] - 1, 2);
                z += pow((k->decay - decay[i]) / k->decay_error, 2);
            }
            gsl_rng_free(g);
            arena_close(a);
        }
        printf("| %d | %d of %d | %.5f | %.3f | %.2f |\n", n, found_all, seeds, sqrt(df / fmax(count, 1)), 100 * sqrt(dd / fmax(count, 1)), sqrt(z / fmax(count, 1)));
    }
}

/* Ten bands of 100, 10 Hz apart on average; noise 60 dB down, and none. */
static void many(void)
{
    enum { COUNT = 1000 };
    static double h[LENGTH], frequency[4 * COUNT];
    static struct truth m[COUNT];
    static int of[COUNT];
    for (int noise = 1; noise >= 0; noise--) {
        struct arena *a = arena_open();
        struct ringing_modes found;
        gsl_rng *g = generator(1);
        int inside = 0, n = 0;
        double worst = 0;
        for (int i = 0; i < COUNT; i++)
            m[i] = (struct truth){.frequency = 500 + 1900 * (i / 100) + 10 * (i % 100 + 0.2 + 0.6 * gsl_rng_uniform(g)),
                                  .decay = 6.907755 / (0.3 * pow(4, gsl_rng_uniform(g))), .gain = pow(10, -gsl_rng_uniform(g)), .phase = 2 * M_PI * gsl_rng_uniform(g)};
        series_sum(m, COUNT, RATE, LENGTH, h);
        series_noise(g, noise ? series_deviation(h, RATE, 60) : 0, LENGTH, h);
        double before = cpu_now();
        find_all(&(struct ringing){.places = 1, .n = LENGTH, .rate = RATE, .h = (const double *const[]){h}}, 3 * COUNT / 2, a, &found);
        double cpu = cpu_now() - before;
        for (int i = 0; i < found.n && i < 4 * COUNT; i++)
            frequency[n++] = found.mode[i].frequency;
        int matched = series_match(m, COUNT, frequency, n, 3, of);
        for (int i = 0; i < COUNT; i++) {
            if (of[i] < 0)
                continue;
            const struct ringing_mode *k = &found.mode[of[i]];
            worst = fmax(worst, fabs(k->frequency - m[i].frequency));
            inside += (fabs(k->frequency - m[i].frequency) < 1.96 * k->frequency_error) + (fabs(k->decay - m[i].decay) < 1.96 * k->decay_error);
        }
        printf("| %s | %d of %d | %d | %.1e | %.1f | %.0f |\n", noise ? "60 dB" : "none", matched, COUNT, found.n - matched, worst, 50.0 * inside / fmax(matched, 1), cpu);
        gsl_rng_free(g);
        arena_close(a);
    }
}

static FILE *part_open(const char *name, const char *end)
{
    char path[4096];
    snprintf(path, sizeof path, "%s.%s", name, end);
    FILE *f = fopen(path, "w");
    if (!f) {
        fprintf(stderr, "ringing_judge: cannot write %s\n", path);
        exit(1);
    }
    return f;
}

/* Seed 1 at 60 dB: |H| at every hertz from direct sums; modes found; |error| of every decay and its bound at 60, 40 and 20 dB. */
static void picture(const char *name)
{
    static double h[LENGTH];
    FILE *spectrum = part_open(name, "spectrum"), *modes = part_open(name, "modes"), *errors = part_open(name, "errors");
    for (int decibel = 60; decibel > 0; decibel -= 20) {
        struct truth m[SERIES_MODES];
        struct arena *a = arena_open();
        struct ringing_modes found;
        gsl_rng *g = generator(1);
        double frequency[4 * SERIES_MODES];
        int of[SERIES_MODES];
        series_fifty(g, m);
        series_sum(m, SERIES_MODES, RATE, LENGTH, h);
        double deviation = series_deviation(h, RATE, decibel);
        series_bound(m, SERIES_MODES, RATE, LENGTH, deviation);
        series_noise(g, deviation, LENGTH, h);
        find_all(&(struct ringing){.places = 1, .n = LENGTH, .rate = RATE, .h = (const double *const[]){h}}, 200, a, &found);
        for (int i = 0; i < found.n; i++)
            frequency[i] = found.mode[i].frequency;
        series_match(m, SERIES_MODES, frequency, found.n, 3, of);
        for (int i = 0; i < SERIES_MODES; i++)
            if (of[i] >= 0)
                fprintf(errors, "%d %g %g\n", decibel, m[i].bound_decay / m[i].decay, fabs(found.mode[of[i]].decay / m[i].decay - 1));
        for (int hertz = 50; decibel == 60 && hertz < 14000; hertz++) {
            double re = 0, im = 0;
            for (int k = 0; k < LENGTH; k++) {
                double angle = 2 * M_PI * (double)((long)hertz * k % LENGTH) / LENGTH;
                re += h[k] * cos(angle);
                im += h[k] * sin(angle);
            }
            fprintf(spectrum, "%d %.2f\n", hertz, 10 * log10(re * re + im * im) - 20 * log10(RATE));
        }
        for (int i = 0; decibel == 60 && i < found.n; i++)
            fprintf(modes, "%.4f %.2f\n", found.mode[i].frequency, 20 * log10(hypot(found.mode[i].re[0], found.mode[i].im[0]) / (2 * found.mode[i].decay)));
        gsl_rng_free(g);
        arena_close(a);
    }
    fclose(spectrum);
    fclose(modes);
    fclose(errors);
}

int main(int count, char **text)
{
    const char *what = count > 1 ? text[1] : "";
    int seeds = count > 2 && strcmp(what, "picture") ? (int)fmin((double)number_whole(text[2]), 1000) : 8;
    openblas_set_num_threads(1);
    if (!strcmp(what, "table"))
        table(seeds < SEEDS_MOST ? seeds : SEEDS_MOST);
    else if (!strcmp(what, "missed"))
        missed(seeds);
    else if (!strcmp(what, "nothing"))
        nothing(seeds);
    else if (!strcmp(what, "exact"))
        exact();
    else if (!strcmp(what, "slopes"))
        slopes(seeds);
    else if (!strcmp(what, "places"))
        places(seeds);
    else if (!strcmp(what, "many"))
        many();
    else if (!strcmp(what, "picture") && count > 2)
        picture(text[2]);
    else {
        fprintf(stderr, "ringing_judge table|missed|nothing|exact|slopes|places|many|picture\n");
        return 1;
    }
    return 0;
}
